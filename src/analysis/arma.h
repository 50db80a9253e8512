/* One pole and one zero: X_n = -a1 X_(n-1) + E_n + b1 E_(n-1), X the series less its mean, E white. See arma.c. */
#ifndef ANALYSIS_ARMA_H
#define ANALYSIS_ARMA_H
#include <stdbool.h>

struct arma {
    double mean, deviation; /* of the series; of the white process                                              */
    double a1, b1;          /* |a1|, |b1| < 1: stationary, invertible                                            */
    double covariance[3];   /* of a1 and b1: variance of a1, both, variance of b1                                */
    double mean_variance;   /* of the mean, a1, b1 and deviation as they are                                     */
    double slope[2];        /* of its logarithm (deviation apart) by a1 and b1                                   */
    double gain;            /* n times the logarithm of the energy that white noise leaves over the energy left  */
    bool white;             /* `gain` is below ARMA_GAIN: a1 = b1 = 0 was taken, the errors are those of the search */
    int iterations;
};

#define ARMA_GAIN 9.21 /* 1 % of white series would gain more (chi-squared, two degrees of freedom) */

/* n >= 8 values that are not all alike. */
void arma_fit(const double *x, int n, struct arma *f);

/* w[n]: x, a series of mean 0, whitened from its first value on: innovations over their deviations, the white process'
   deviation being 1. Returns the sum of the logarithms of the innovations' variances. w may be x. */
double arma_whiten(const double *x, int n, double a1, double b1, double *w);

#endif
