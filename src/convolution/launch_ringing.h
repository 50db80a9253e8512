/* The nodes of launch.h that the force no longer drives: they ring out, many of a component at the price of one. See launch_ringing.c. */
#ifndef CONVOLUTION_LAUNCH_RINGING_H
#define CONVOLUTION_LAUNCH_RINGING_H
#include "base/arena.h"
#include "num/lanes.h"

struct launch_ringing;

enum { LAUNCH_RINGING_BLOCK = 64 }; /* most frames of a block */

/* n components; block: frames. */
struct launch_ringing *launch_ringing_make(struct arena *a, int n, double rate, int block);

struct launch_freed {
    int component;
    long frame;                 /* first without force                             */
    double frequency, decay;    /* Hz, 1/s                                         */
    double re, im;              /* state in the last frame before the coming block */
    double least;               /* size at which it is dropped                     */
};

/* Takes nodes over before a block; no component twice. */
void launch_ringing_add(struct launch_ringing *r, const struct launch_freed *freed, int count);

/* Adds Im of all states in the next block, lane by lane, to sums[block][LANES]. */
void launch_ringing_run(struct launch_ringing *r, double (*sums)[LANES]);

long launch_ringing_active(const struct launch_ringing *r);

#endif
