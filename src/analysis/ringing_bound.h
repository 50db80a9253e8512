/* How many components a fit may have. */
#ifndef ANALYSIS_RINGING_BOUND_H
#define ANALYSIS_RINGING_BOUND_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

/* Drops components until `most` are left besides the constant: those without which the residual's energy rises least. Gains are made anew. */
void ringing_bound(struct ringing_fit *f, const struct ringing_noise *noise, int most);

/* The same until no more than o->most modes are in the band that is told of; what lies beside it stays. Whether any went. */
bool ringing_bound_modes(struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_options *o);

#endif
