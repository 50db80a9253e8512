/* Gaussian, exponential and gamma densities fitted to values. See distribution_fit.c. */
#ifndef ANALYSIS_DISTRIBUTION_FIT_H
#define ANALYSIS_DISTRIBUTION_FIT_H
#include "analysis/impact_statistics.h"
#include "base/arena.h"

/* x[n], n >= 8. All NAN where all values are alike; gamma NAN unless all are above 0; exponential NAN where fewer than
 * 8 are. */
void distribution_fit(const double *x, int n, struct arena *a, struct distribution_fits *f);

#endif
