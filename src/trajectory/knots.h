/* Where a place lies among rising knots: which piece of a table or spline it is in. */
#ifndef TRAJECTORY_KNOTS_H
#define TRAJECTORY_KNOTS_H
#include <stddef.h>

/* The piece [at[i], at[i + 1]] of n knots (at least 2) in which x lies, the later one at a knot; the first or last one
 * for x beyond the ends. */
size_t knots_find(size_t n, const double *at, double x);

/* The piece of x when that of the place before it is known: x rises as a rule. */
static inline size_t knots_next(size_t n, const double *at, size_t before, double x)
{
    if (x < at[before] || before + 2 >= n || x >= at[before + 2]) return knots_find(n, at, x);
    return x >= at[before + 1] ? before + 1 : before;
}

#endif
