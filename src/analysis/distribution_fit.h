/* Gaussian, exponential and gamma densities fitted to values. See distribution_fit.c. */
#ifndef ANALYSIS_DISTRIBUTION_FIT_H
#define ANALYSIS_DISTRIBUTION_FIT_H
#include "analysis/impact_statistics.h"
#include "base/arena.h"
#include <stdbool.h>

/* x[n], n >= 8. All NAN where all values are alike; gamma NAN unless all are above 0; exponential NAN where fewer than
 * 8 are. */
void distribution_fit(const double *x, int n, struct arena *a, struct distribution_fits *f);

/* The density of a sample as a table, straight between its rows. */
struct frequency_polygon {
    int n;
    double *value, *density; /* [n]; density 0 at both ends, its integral 1 */
};

/* Of x[n], n >= 2 not all alike; with mean 0 and the given standard deviation. */
void distribution_fit_polygon(const double *x, int n, double deviation, struct arena *a, struct frequency_polygon *t);

/* Is x not normal? Kolmogorov's distance, with mean and deviation estimated, against Lilliefors' 1 % point 1.031/sqrt
   n, and at least 0.02: less changes nothing that could be heard, however many impacts there are. */
bool distribution_fit_polygon_needed(double distance, int n);

#endif
