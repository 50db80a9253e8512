/* The nodes of launch.h that the force drives at present: `order` resonators per component, each under its own window. */
#ifndef CONVOLUTION_LAUNCH_DRIVEN_H
#define CONVOLUTION_LAUNCH_DRIVEN_H
#include <stdbool.h>

#include "base/arena.h"
#include "num/lanes.h"

struct launch_driven;

/* hop[n]: frames, powers of two. */
struct launch_driven *launch_driven_make(struct arena *a, int n, int order, const int *hop);

struct launch_node {
    double pole_re, pole_im; /* e^(s/rate)                               */
    double gain_re, gain_im; /* per sample of force: divided by the rate */
    double through;          /* what the force itself adds, per N        */
    double re, im;           /* state                                    */
    double largest;          /* |re| + |im| that it has reached          */
};

/* Node `which` (0 the oldest .. order - 1) of component i: pole, gains, through; the rest is kept. */
void launch_driven_set(struct launch_driven *d, int i, int which, const struct launch_node *node);

/* Component i's windows move on by one node: gives the oldest's pole, state and `largest`; the newest has no pole, no gain and no state yet. */
struct launch_node launch_driven_next(struct launch_driven *d, int i);

/* Adds Im of the states, lane by lane, to sums[n][LANES] under f[n], whose first is frame `from` of the block. */
void launch_driven_run(struct launch_driven *d, const double *f, double (*sums)[LANES], int from, int n);

/* After each block of `block` frames: windows go on, states below 1e-200 in both parts become zero. */
void launch_driven_settle(struct launch_driven *d, int block);

/* What the force itself adds: in frame j of the present block of `block` frames f times p[0] + t (p[1] + t (p[2] + t p[3])), t = j/block. */
void launch_driven_through(const struct launch_driven *d, int block, double p[4]);

/* Nodes whose state is not zero. */
long launch_driven_active(const struct launch_driven *d);

#endif
