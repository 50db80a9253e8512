/* Columns of numbers over time, from a CSV: recorded motions, speeds, normal forces. */
#ifndef TRAJECTORY_SERIES_H
#define TRAJECTORY_SERIES_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

struct series {
    size_t n;
    double *time;     /* [n] s, rising, as the file has it */
    double *x[2];     /* [n] the columns                   */
    const int *lines; /* [n] lines of the file             */
};

/* Reads time_s and the named columns (at most 2; NULL: none) of a file; other columns are left alone. At least 2 rows,
   times rising. ERR_INPUT, ERR_SCENE with file and line. */
bool series_read(const char *file, const char *const columns[2], struct arena *, struct series *, struct err *);

/* For what a cubic is laid through: rows are 1 ns apart or more, so that no slope and no curvature of it is beyond
 * numbers. ERR_SCENE with file and line. */
bool series_spaced(const struct series *, const char *file, struct err *);

/* Natural cubic splines on knots at any distances: interpolation, and smoothing with a chosen cut-off. */
struct cubic {
    size_t n;         /* knots, at least 2                    */
    const double *at; /* [n] rising                           */
    double *y, *bend; /* [n] value and second derivative      */
};

/* The piece [at[i], at[i + 1]] of n knots (at least 2) in which x lies, the later one at a knot; the first or last one
 * for x beyond the ends. */
size_t series_cubic_find(size_t n, const double *at, double x);

/* The piece of x when that of the place before it is known: x rises as a rule. */
static inline size_t series_cubic_next(size_t n, const double *at, size_t before, double x)
{
    if (x < at[before] || before + 2 >= n || x >= at[before + 2]) return series_cubic_find(n, at, x);
    return x >= at[before + 1] ? before + 1 : before;
}

/* The C2 spline through y whose second derivative is 0 at both ends. Keeps `at`, copies y. */
void series_cubic_natural(struct cubic *, size_t n, const double *at, const double *y, struct arena *);

/* y_smooth[n]: the values at the knots of the smoothing spline (Reinsch) whose gain at `cutoff` (cycles per unit of
   `at`, below half of the mean rate of knots) is 1/sqrt 2, half power; n >= 3. */
void series_cubic_smooth(size_t n, const double *at, const double *y, double cutoff, double *y_smooth, struct arena *);

/* Value and first three derivatives at x, which lies in piece i; beyond the ends the straight line that goes
 * on. */
void series_cubic_at(const struct cubic *, size_t i, double x, double out[4]);

/* Least and greatest value of a function of time. */
struct scan {
    void (*at)(const void *self, size_t n, const double *t, double *y);
    const void *self;
};

/* range[2]: least and greatest of y on [from, to]: on steps + 1 instants, then by golden section around each that could
   hold an extreme. Exact to the rounding of y where no two extremes of one kind fall within two steps; else too narrow
   by less than what y varies by in a step. */
void series_range(const struct scan *, double from, double to, long steps, double range[2]);

#endif
