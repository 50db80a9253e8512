/* Natural cubic splines on knots at any distances: interpolation, and smoothing with a chosen cut-off. */
#ifndef TRAJECTORY_CUBIC_H
#define TRAJECTORY_CUBIC_H
#include <stddef.h>

#include "base/arena.h"

struct cubic {
    size_t n;         /* knots, at least 2                    */
    const double *at; /* [n] rising                           */
    double *y, *bend; /* [n] value and second derivative      */
};

/* The C2 spline through y whose second derivative is 0 at both ends. Keeps `at`, copies y. */
void cubic_natural(struct cubic *, size_t n, const double *at, const double *y, struct arena *);

/* y_smooth[n]: the values at the knots of the smoothing spline (Reinsch) whose gain at `cutoff` (cycles per unit of
   `at`, below half of the mean rate of knots) is 1/sqrt 2, half power; n >= 3. */
void cubic_smooth(size_t n, const double *at, const double *y, double cutoff, double *y_smooth, struct arena *);

/* Value and first three derivatives at x, which lies in piece i (knots.h); beyond the ends the straight line that goes
 * on. */
void cubic_at(const struct cubic *, size_t i, double x, double out[4]);

#endif
