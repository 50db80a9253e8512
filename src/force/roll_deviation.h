/* How much the ground under a rolling ball deviates: what its stiffness is made from. */
#ifndef FORCE_ROLL_DEVIATION_H
#define FORCE_ROLL_DEVIATION_H
#include "force/roll_pass.h"

struct roll_spread {
    double mean, square;    /* m, m^2: variance */
};

/* Each of n counts by way[] (m; NULL, or 0 of all: alike). */
struct roll_spread roll_deviation_spread(const double *at, const double *way, long n);

/* To *rms, m: of the ground under r's ball, of which p has just gone the motion (and may be gone on from there). normal: N, mean. Errors as of roll_pass_make. */
bool roll_deviation_of(struct roll_pass *p, const struct stage_run *r, double normal, double *rms, struct err *e);

#endif
