/* How a rolling ball lies in its contact at rest, and the stiffness that follows: from both bodies and the ground,
   never from the motion. */
#ifndef FORCE_ROLL_STIFFNESS_H
#define FORCE_ROLL_STIFFNESS_H
#include "stage.h"

struct roll_stiffness {
    double normal;    /* N, static normal force, N                                       */
    double rest;      /* m, penetration at rest, delta                                   */
    double stiffness; /* N/m^1.5, k = N / delta^1.5                                      */
    double roughness; /* m, Rq of the ground; NAN: not read, as the scene gives the rest */
    double hertz;     /* m, Hertz's part of delta; 0: a modulus is not known; NAN: as Rq */
    double resonance; /* rad/s, of the ball's mass on the contact, w0                    */
};

/* Of r's contact, whose board has the relief with its tip. Without a static normal force there is neither rest nor
   resonance: both are 0, and the stiffness is the scene's, or NAN. */
struct roll_stiffness roll_stiffness_make(const struct stage_run *r);

/* m, Rq: rms height of the ground by second differences, of waves up to some millimetres. Places are in the ground's
   own coordinates (relief.h, `under` of a tip). */
double roll_stiffness_roughness(const struct relief *ground);

#endif
