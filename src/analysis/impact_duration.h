/* How long impacts last, as a law of their amplitude: t0 = zeta A^-theta (papers/002 equation 12), A in newtons. */
#ifndef ANALYSIS_IMPACT_DURATION_H
#define ANALYSIS_IMPACT_DURATION_H
#include "analysis/impact_events.h"
#include "base/arena.h"
#include "base/err.h"

enum {
    IMPACT_DURATION_LEAST = 5,
    IMPACT_DURATION_MANY = 20
}; /* impacts from which theta is told; of a series, from which a law is believed */

struct impact_duration {
    double theta;
    double theta_single, theta_error; /* on single impacts, and its standard error; NAN where theta is given */
    double zeta_single;               /* s, on single impacts                                          */
    double r2_single, r2_single_log;  /* of t0, and of its logarithm                              */
    long singles;                     /* impacts that theta is from; 0: given                          */
    double zeta;                      /* s, of the series                                              */
    double r2, r2_log;
    long n; /* impacts of the series whose duration is known                 */
};

/* First step: theta and zeta by linear regression of log t0 on log |A|, over the impacts that stand alone, or over all.
   False, with nothing set but `singles`: fewer than IMPACT_DURATION_LEAST, or amplitudes all alike (their logarithms'
   deviation is below 0.02). */
bool impact_duration_single(const struct impact_events *v, bool only_alone, struct impact_duration *d);

/* Second step: with d->theta as it is, zeta alone, over all impacts whose duration is known. False: there is none. */
bool impact_duration_series(const struct impact_events *v, struct impact_duration *d);

/* In its place where no law holds: theta 0, zeta the median of the durations that are known. False: there is none. */
bool impact_duration_constant(const struct impact_events *v, struct arena *a, struct impact_duration *d);

#endif
