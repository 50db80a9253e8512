/* The density of a sample as a table, straight between its rows. */
#ifndef ANALYSIS_FREQUENCY_POLYGON_H
#define ANALYSIS_FREQUENCY_POLYGON_H
#include <stdbool.h>

#include "base/arena.h"

struct frequency_polygon {
    int n;
    double *value, *density; /* [n]; density 0 at both ends, its integral 1 */
};

/* Of x[n], n >= 2 not all alike; with mean 0 and the given standard deviation. */
void frequency_polygon_make(const double *x, int n, double deviation, struct arena *a, struct frequency_polygon *t);

/* Is x not normal? Kolmogorov's distance, with mean and deviation estimated, against Lilliefors' 1 % point 1.031/sqrt
   n, and at least 0.02: less changes nothing that could be heard, however many impacts there are. */
bool frequency_polygon_needed(double distance, int n);

#endif
