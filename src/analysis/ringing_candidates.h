/* Poles that a round of the search offers to the fit. */
#ifndef ANALYSIS_RINGING_CANDIDATES_H
#define ANALYSIS_RINGING_CANDIDATES_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

struct ringing_candidate {
    double decay, omega;      /* 1/s, rad/s */
    double energy;            /* that it alone would take of its band */
    int band;
};

struct ringing_candidates {
    double low, high;         /* rad/s, to look between */
    int decimation;
    long length;              /* samples that are looked at */
    int n;
    struct ringing_candidate *list;
};

/* Of what the fit has left of the response. */
void ringing_candidates_find(const struct ringing_fit *f, const struct ringing_noise *noise, struct ringing_candidates *c, struct arena *a);

/* Keeps those that would take most, at most `room`, in their order. */
void ringing_candidates_strongest(struct ringing_candidates *c, int room);

#endif
