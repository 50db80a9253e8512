/* Whether a fit stands still. */
#ifndef ANALYSIS_RINGING_SETTLE_H
#define ANALYSIS_RINGING_SETTLE_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

/* A few more steps; a line that names the modes between low and high (rad/s) that still move by more than their standard errors; NULL: none does. */
const char *ringing_settle(struct ringing_fit *f, const struct ringing_noise *noise, const double band[2], struct arena *a);

#endif
