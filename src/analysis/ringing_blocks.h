/* A fit of many components, part by part: neighbours in frequency together, the others as they are. */
#ifndef ANALYSIS_RINGING_BLOCKS_H
#define ANALYSIS_RINGING_BLOCKS_H
#include "analysis/ringing_fit.h"

/* Runs act on every part in which something is fresh, up to `sweeps` times over all, until nothing moves; act leaves its part's residual as its poles and gains have it, and says whether
   they moved. A fit of few components is its own only part, and act is run on it once. */
void ringing_blocks_run(struct ringing_fit *f, int sweeps, bool (*act)(struct ringing_fit *part, void *context), void *context);

/* Whether the fit is made in more parts than one. */
bool ringing_blocks_many(const struct ringing_fit *f);

/* All is fresh. */
void ringing_blocks_renew(struct ringing_fit *f);

/* The same with what neither adds nor drops components; what was fresh is so again. */
void ringing_blocks_settle(struct ringing_fit *f, int sweeps, bool (*act)(struct ringing_fit *part, void *context), void *context);

/* Gains of the poles as they are, of the parts in which something is fresh, which stays so. */
void ringing_blocks_gains(struct ringing_fit *f);

#endif
