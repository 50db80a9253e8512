/* A first pass over the whole motion, from which a rolling ball's stiffness and penetration follow. */
#ifndef FORCE_ROLL_REHEARSAL_H
#define FORCE_ROLL_REHEARSAL_H
#include "force/roll_law.h"
#include "force/slope.h"
#include "stage.h"

struct roll_rehearsal {
    double normal;      /* N, mean of max(0, N(t))                                     */
    double rest;        /* m, (N/k)^(2/3)                                              */
    double base;        /* m, rho_0                                                    */
    double deviation;   /* m, rms of S about its mean, of the ground that k is made from */
    double mean;        /* m, mean of S over the motion's way                          */
    double level[SLOPE_LEVELS]; /* 1/m, of the limited curvature, taken out of the height (force/slope.h) */
};

/* Settles l->stiffness, where it is NAN, as k = N / (static_depth rms)^1.5, and base such that over the motion the mean of the force is N to 1e-9;
   l->mu is given. r: of the rolling stage, whose board has trajectory, load and limiter; h: slope_heading_make's of it. Where nothing presses the ball, found->normal is 0 and the
   rest is not found. ERR_SCENE where nothing deviates and no stiffness is given. */
bool roll_rehearsal_run(struct stage_run *r, const struct slope_heading *h, struct roll_law *l, struct roll_rehearsal *found, struct err *e);

/* [n], m, from the normal forces (N) of n instants: by how much they press the ball deeper than its mean one does, rest ((N/mean)^(2/3) - 1). */
void roll_rehearsal_press(const struct roll_rehearsal *f, long n, const double *load, double *deeper);

#endif
