/* From a fit to the modes that are told of. */
#ifndef ANALYSIS_RINGING_REPORT_H
#define ANALYSIS_RINGING_REPORT_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

/* Checks what both methods demand: finite, long enough; *silent: nothing but 0. */
bool ringing_report_check(const struct ringing *r, const struct ringing_options *o, bool *silent, struct err *e);

/* Numbers modes and slopes, takes the strongest, and says what they explain. */
void ringing_report(struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_options *o, struct arena *a, struct ringing_modes *m);
void ringing_report_silent(const struct ringing *r, struct arena *a, struct ringing_modes *m);

#endif
