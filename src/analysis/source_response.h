/* Parts of source_filter.h: impacts' pulses, and the recording's response to them: gains, sizes, times, click. */
#ifndef ANALYSIS_SOURCE_RESPONSE_H
#define ANALYSIS_SOURCE_RESPONSE_H
#include "analysis/source_poles.h"

/* Between samples, by the cubic through four: x[0] u on, 0 <= u < 1. */
static inline double source_response_between(const double *x, double u)
{
    return x[0] + u * (x[1] - x[-1] / 3 - x[0] / 2 - x[2] / 6 +
                       u * ((x[-1] + x[1]) / 2 - x[0] + u * ((x[2] - x[-1]) / 6 + (x[0] - x[1]) / 2)));
}

/* Times and sizes of the onsets' pulses in y, what prediction does not foresee, which is as short as an impact: beside
   the one pulse that most are like. Those that are not alike, two at once, say, are none. */
void source_response_pulses(const struct source_filter *f, const double *y, bool both, struct source_response_hits *h,
                            struct arena *a);

/* to[columns] that makes x[n] less the sum of to[p] basis[p][0 .. n - 1] least in squares; x is then that. stride: of
   basis, from column to column. false: there is no one solution, and x is as it was. */
bool source_response_solve(const double *basis, long columns, long stride, long n, double *x, double *to);

/* h[length], the response to an impact of 1 from its time on, that makes x[n] less all impacts' responses least in
   squares: what all impacts have in common, however closely they follow each other. Returns the share of x's energy
   that it is. */
double source_response_mean(const double *x, long n, const struct source_response_hits *hits, double *h, long length);

#endif
