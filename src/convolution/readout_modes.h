/* readout.h for modes, each with hops of its own: no impulse responses, but resonators that are told all that the force has been. */
#ifndef CONVOLUTION_READOUT_MODES_H
#define CONVOLUTION_READOUT_MODES_H
#include "base/arena.h"
#include "convolution/launch.h"

struct readout_modes;

struct readout_modes_ask {
    int n, order;      /* components; 1, 2 or 4 */
    double rate;       /* Hz */
    const double *hop; /* [n] frames between a component's nodes, >= 1; rounded down to powers of two */
    double decibel;    /* force is forgotten when its response has decayed by so much (> 0) ... */
    double seconds;    /* ... and after so long */
    int quantity;      /* enum modes_quantity, for the direct term */
};

/* As launch_open; frames in no order, each once per hop at most. */
struct readout_modes *readout_modes_open(const struct readout_modes_ask *ask, launch_point *point, void *self);
void readout_modes_close(struct readout_modes *r);

/* Adds to y[frames] the sound of the next frames under f[frames]; the result does not depend on how the sound is cut into calls. */
void readout_modes_run(struct readout_modes *r, const double *f, double *y, long frames);

#endif
