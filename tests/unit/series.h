/* What the tests of the statistics of impacts share: series of ARMA(1,1) from GSL's generator. */
#ifndef TESTS_UNIT_SERIES_H
#define TESTS_UNIT_SERIES_H
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "unit.h"

static inline gsl_rng *series_rng(unsigned long seed)
{
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(g, seed);
    return g;
}

/* x_n = mean + X_n, X_n = -a1 X_(n-1) + E_n + b1 E_(n-1), E normal of that deviation, after 4000 values of warming up.
 */
static inline void series_draw(gsl_rng *g, double mean, double deviation, double a1, double b1, double *x, int n)
{
    double y = 0, before = 0;
    for (int i = -4000; i < n; i++) {
        double now = deviation * gsl_ran_gaussian_ziggurat(g, 1);
        y = -a1 * y + now + b1 * before;
        before = now;
        if (i >= 0) x[i] = mean + y;
    }
}

#endif
