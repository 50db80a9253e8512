/* Components that do not decay by more than chance: hums, or what a fit can do without. */
#ifndef ANALYSIS_RINGING_HUMS_H
#define ANALYSIS_RINGING_HUMS_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

enum ringing_hums_kind { RINGING_HUMS_NONE, RINGING_HUMS_MODE, RINGING_HUMS_HUM, RINGING_HUMS_SURPLUS };

/* kind[m]: NONE decays; MODE does not by more than chance, but is not in the noise before the strike either; HUM; SURPLUS: greater than the response itself, or the second slope of a mode. */
void ringing_hums_kinds(const struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_fit_errors *e, enum ringing_hums_kind *kind);

/* Takes what is surplus out of the fit, one by one, the greatest first, and fits the others anew; with all: hums too. Returns how many went. */
int ringing_hums_drop(struct ringing_fit *f, const struct ringing_noise *noise, bool all);

#endif
