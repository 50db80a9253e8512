/* The limiter (papers/000 equations 4, 5) on pieces over which a curvature runs along a parabola: means and first
 * moments in closed form. */
#ifndef SURFACE_LIMITED_H
#define SURFACE_LIMITED_H
#include <stdbool.h>

/* Two chunks of way.h and a little: with arrays of 256, a power of two apart, a render in standard took 2 to 4 % more.
 */
enum { LIMITED_PIECES = 264, LIMITED_POINTS = 2 * LIMITED_PIECES };

struct limited { /* pieces from point at[i] to point at[i] + 1 */
    int n, points;
    const int *at;           /* [n], rising */
    const double *alpha;     /* m, [points] */
    const double *curvature; /* c, 1/m, [points] */
    const double *bulge;     /* 1/m, [n]: c in the middle above the straight line between the ends; NULL: none */
    double *limited;         /* T(c) at the points, 1/m, [points] */
    double *mean;            /* mean of T over the piece, 1/m, [n] */
    double *moment;          /* integral of (s - middle) T ds / length^2, 1/m, [n] */
};

/* Do all n pieces share their points, so that piece i goes from point i to i + 1? at[] rises. */
static inline bool limited_chained(int n, int points, const int *at)
{
    return n > 0 && points == n + 1 && at[0] == 0 && at[n - 1] == n - 1;
}

/* T(c) = tanh(alpha c) / alpha, or T(c) = c when limiter is false. Absolute error of alpha mean below 2e-12, of alpha
   moment below 1e-9; with a bulge b that of alpha mean grows by 0.21 (alpha b)^2 up to 5.2e-5 at alpha |b| = 1/64, from
   where on it grows no more, that of alpha moment by 0.05 alpha |b| up to 8e-4. |mean| <= 1/alpha, but for 2e-8 of it
   and 4 alpha |b| roundings. */
void limited_run(const struct limited *l, bool limiter);

#endif
