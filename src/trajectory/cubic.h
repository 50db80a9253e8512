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

/* The piece [at[i], at[i + 1]] of n knots (at least 2) in which x lies, the later one at a knot; the first or last one
 * for x beyond the ends. */
size_t cubic_find(size_t n, const double *at, double x);

/* The piece of x when that of the place before it is known: x rises as a rule. */
static inline size_t cubic_next(size_t n, const double *at, size_t before, double x)
{
    if (x < at[before] || before + 2 >= n || x >= at[before + 2]) return cubic_find(n, at, x);
    return x >= at[before + 1] ? before + 1 : before;
}

/* The C2 spline through y whose second derivative is 0 at both ends. Keeps `at`, copies y. */
void cubic_natural(struct cubic *, size_t n, const double *at, const double *y, struct arena *);

/* y_smooth[n]: the values at the knots of the smoothing spline (Reinsch) whose gain at `cutoff` (cycles per unit of
   `at`, below half of the mean rate of knots) is 1/sqrt 2, half power; n >= 3. */
void cubic_smooth(size_t n, const double *at, const double *y, double cutoff, double *y_smooth, struct arena *);

/* Value and first three derivatives at x, which lies in piece i; beyond the ends the straight line that goes
 * on. */
void cubic_at(const struct cubic *, size_t i, double x, double out[4]);

#endif
