/* Second slopes: two components of one frequency, each with its decay. */
#ifndef ANALYSIS_RINGING_SLOPES_H
#define ANALYSIS_RINGING_SLOPES_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

/* Looks for a second decay at every frequency that stands far above the noise; what is no more than chance (at `level`) is not kept. */
void ringing_slopes_find(struct ringing_fit *f, const struct ringing_noise *noise, double level);

/* Pairs whose frequencies cannot be told apart and whose decays can get one frequency, if two decays fit better at this level of an F test; else, and with
   level 0, one of them goes. */
void ringing_slopes_tie(struct ringing_fit *f, const struct ringing_noise *noise, double level);

#endif
