/* A moving response by resonators: every force sample launches the response of its own place (`launch` of rasp-scene(5)); each mode has nodes
   at its own hop, each a resonator that gets the force under its window and then rings out. See launch.c. */
#ifndef CONVOLUTION_LAUNCH_H
#define CONVOLUTION_LAUNCH_H
#include "base/arena.h"
#include "response/modes.h"

struct launch;

/* Poles and gains at frame t (may be negative or beyond the end: where the motion's formula goes on). The point has n components. Frames come
   in no order, each once at most per hop of a component: when its node first gets force. */
typedef void launch_point(void *self, double frame, const struct modes_point *p);

struct launch_ask {
    int n;             /* components */
    int order;         /* 1, 2 or 4 */
    double rate;       /* Hz */
    const double *hop; /* [n] frames between a component's nodes, >= 1; rounded down to powers of two */
    double floor;      /* amplitude relative to the largest of a node at which it is dropped; 0: 1e-200 of the unit */
    int quantity;      /* enum modes_quantity, for the direct term */
};

struct launch *launch_open(const struct launch_ask *ask, launch_point *point, void *self);
void launch_close(struct launch *l);

/* Adds to y[frames] the sound of the next frames under f[frames]; the result does not depend on how the sound is cut into calls. */
void launch_run(struct launch *l, const double *f, double *y, long frames);

/* Resonators that ring at the moment. */
long launch_active(const struct launch *l);

#endif
