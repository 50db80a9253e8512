/* A rolling ball's way over the whole of its motion, and on beyond it, in grains of its own: what a rehearsal looks at. */
#ifndef FORCE_ROLL_PASS_H
#define FORCE_ROLL_PASS_H
#include "force/roll_centre.h"
#include "stage.h"

enum { ROLL_PASS_RATE = 48000, ROLL_PASS_MOST = 1 << 20 }; /* Hz, least grains per second; grains kept, 84 MB at most while it lasts */

struct roll_pass {
    struct stage_run run;           /* the rolling stage's, on the board below */
    struct board board;
    struct slope slope;
    struct roll_centre centre;
    double *at[2], *lift[2][SLOPE_LEVELS];     /* m, m^2, at the start and the end of each kept grain (force/roll_centre.h) */
    double *way;                    /* m, gone over in each                                                      */
    double *load[2];                /* N; NULL: constant                                                         */
    long grains, stride, next, n;   /* in all; one of so many is kept; which is the next; kept                   */
};

/* Grains per second of a motion of that duration (s) and greatest speed (m/s): a whole number in the duration. */
double roll_pass_rate(const struct contact *c, double duration, double speed);

/* m, the ball's longest way in one grain. */
double roll_pass_grain(const struct contact *c);

/* Of r's contact, whose board has trajectory, load, limiter and relief; p stays where it is. p->slope.turned.heading: slope_heading_make's of r, the caller's to set
   before, p else zeroed. Errors as of slope_make. */
bool roll_pass_make(struct roll_pass *p, const struct stage_run *r, struct arena *a, struct err *e);

/* As though accuracy.tip_heights were 1, whatever it is: to be called before it goes. Of a relief with a tip. Errors as of the tip's stage. */
bool roll_pass_plain(struct roll_pass *p, struct err *e);

/* Goes the whole motion. */
bool roll_pass_motion(struct roll_pass *p, struct err *e);

/* Then, on from where the motion ended, n grains of `step` m under the normal force `normal` (N): to[0][n] S, to[1 + k][n] lifts, at their starts. False:
   the motion goes nowhere. */
bool roll_pass_beyond(struct roll_pass *p, long n, double step, double normal, double *const to[1 + SLOPE_LEVELS]);

#endif
