/* Which components are more than noise. */
#ifndef ANALYSIS_RINGING_SELECT_H
#define ANALYSIS_RINGING_SELECT_H
#include "analysis/ringing_fit.h"
#include "analysis/ringing_noise.h"

struct ringing_select {
    double level;      /* greatest probability with which noise makes a component as strong at one place of the spectrum */
    double apart;      /* ... with which one component makes two, their poles free; 1: not asked */
};

/* Drops the least significant component, and all others that fail and are not near it, until none fails; gains are made anew. Returns how many went. */
int ringing_select_drop(struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_select *s);

/* Variances [places][m] and standard errors of the fit as it stands. */
void ringing_select_errors(struct ringing_fit *f, const struct ringing_noise *noise, struct arena *a, struct ringing_fit_errors *e);

#endif
