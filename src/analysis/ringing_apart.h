/* Whether two components near each other are two. */
#ifndef ANALYSIS_RINGING_APART_H
#define ANALYSIS_RINGING_APART_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

/* Makes one of two components wherever two do not fit significantly better; level: of the F test. Returns how many went. */
int ringing_apart(struct ringing_fit *f, const struct ringing_noise *noise, double level);

/* The trial by itself: drops component i, polishes, and stays so unless the residual is greater than chance allows, else all is as before. Returns whether it went. */
bool ringing_apart_try(struct ringing_fit *f, const struct ringing_noise *noise, int i, double level);

#endif
