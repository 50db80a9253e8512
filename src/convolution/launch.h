/* A moving response by resonators: every force sample launches the response of its own place (`launch` of
   rasp-scene(5)). See launch.c. */
#ifndef CONVOLUTION_LAUNCH_H
#define CONVOLUTION_LAUNCH_H
#include "base/arena.h"
#include "response/modes.h"

struct launch;

/* Poles and gains of the n components at frame t, which may be negative or beyond the end: there the motion's formula
   goes on. Frames come in no order. */
typedef void launch_point(void *self, double frame, const struct modes_point *p);

struct launch_ask {
    int n;       /* components */
    double rate; /* Hz */
    int hop; /* frames from node to node; fastest where its half, quarter ... is a whole number of 33 to 64 frames */
    double floor; /* amplitude at which a node is dropped, relative to its own when the force leaves it; 0: 1e-200 of
                     the unit */
    int quantity; /* enum modes_quantity, for the direct term */
};

struct launch *launch_open(const struct launch_ask *ask, launch_point *point, void *self);
void launch_close(struct launch *l);

/* Adds to y[frames] the sound of the next frames under f[frames]; the result does not depend on how the sound is cut
   into calls. */
void launch_run(struct launch *l, const double *f, double *y, long frames);

/* Resonators that ring at the moment. */
long launch_active(const struct launch *l);

#endif
