/* How a ball turns as it rolls, papers/000 equation 18 and after: from the way u of its centre of mass to the angle
   theta, and from the angle how high the centre of mass lies and how the ball's rim deviates from a circle. */
#ifndef TRAJECTORY_SPIN_H
#define TRAJECTORY_SPIN_H
#include <stddef.h>

#include "scene/scene.h"

struct spin {
    double radius, offset, start; /* m, m, rad: R, r, theta at u = 0            */
    double lobe_height;           /* m                                          */
    int lobes;
};

struct spin_out {                /* [n] each; NULL: not asked for */
    double *theta;               /* rad; 0: the centre of mass is lowest; not reduced by full turns */
    double *turning;             /* rad/s, d theta / dt                        */
    double *rise, *climb, *lift; /* m, m/s, m/s^2: height of the centre of mass over the geometric centre, -r
                                      cos(theta), and its two derivatives */
    double *rim, *swell, *heave; /* m, m/s, m/s^2: how much further out than R the rim is below the centre,
                                      lobe_height cos(lobes theta), and its two derivatives */
    double *printed;             /* m, -r cos(x/R): what papers/000 equation 16 has for rise, x of equation 18 */
};

struct spin spin_make(const struct contact *c);

/* At n instants, from u (m), du (m/s), ddu (m/s^2) of the motion; ddu may be NULL unless lift or heave is asked for. x
   = R theta - r sin theta is solved to rounding (r < R). Every function of real.h, so the same bits everywhere. */
void spin_at(const struct spin *s, size_t n, const double *u, const double *du, const double *ddu,
             const struct spin_out *out);

#endif
