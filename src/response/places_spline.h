/* Cubic splines on knots at any distances, as far as their knots alone decide: the slopes at the knots of what is known
 * there. */
#ifndef RESPONSE_PLACES_SPLINE_H
#define RESPONSE_PLACES_SPLINE_H
#include "base/arena.h"

struct places_spline {
    int n;                         /* knots                                                                  */
    double *step;                  /* [n - 1] distances                                                      */
    double *below, *pivot, *above; /* [n] the slopes' equations, eliminated: row k less below[k] of row k - 1 */
};

/* at[n], increasing, n >= 3. */
struct places_spline places_spline_make(struct arena *a, int n, const double *at);

/* Slopes m[k][count] at the knots from the values f[k][count]. */
void places_spline_slopes(const struct places_spline *s, int count, const double *const *f, double *const *m);

/* How many times as large as the values' largest error the spline's may become, at eighths of the intervals. */
double places_spline_grows(const struct places_spline *s, struct arena *a);

/* Where they are so uneven that an error may come out more than so many times as large, all that is made of places
 * stays linear. */
#define PLACES_SPLINE_GROWS 6.0

#endif
