/* Whether two components near each other are two. */
#ifndef ANALYSIS_RINGING_APART_H
#define ANALYSIS_RINGING_APART_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

/* Makes one of two components wherever two do not fit significantly better; level: of the F test. Returns how many went. */
int ringing_apart(struct ringing_fit *f, const struct ringing_noise *noise, double level);

/* The trial by itself: drops component i, polishes, and stays so unless the residual is greater than chance allows, else all is as before. Returns whether it went. */
bool ringing_apart_try(struct ringing_fit *f, const struct ringing_noise *noise, int i, double level);

/* The other trial: gives pair[1], the weaker of two components, the frequency of pair[0], polishes, and stays so unless the residual rises by `least` noise
   variances (chi squared of 1 degree if there is but one frequency), else all is as before. Returns whether they are tied. */
bool ringing_apart_tie(struct ringing_fit *f, const struct ringing_noise *noise, const int pair[2], double least);

/* Which of two is the weaker: energy, of what the response's length holds. */
double ringing_apart_strength(const struct ringing_fit *f, int i);

#endif
