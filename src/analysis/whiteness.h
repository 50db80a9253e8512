/* Is a series white, and is it driven by what drives another? See whiteness.c. */
#ifndef ANALYSIS_WHITENESS_H
#define ANALYSIS_WHITENESS_H
#include "base/arena.h"

/* out[0 .. lags - 1]: correlation of x[n] with itself that many places on, by n and the mean of all; 1 at lag 0, 0
 * where x is constant. */
void whiteness_correlation(const double *x, int n, int lags, double *out);

/* out[0 .. 2 lags - 2]: of x_n with y_(n+k), k = -(lags - 1) .. lags - 1. */
void whiteness_cross(const double *x, const double *y, int n, int lags, double *out);

/* Ljung and Box's Q over lags 1 .. lags of a correlation, and in *p the probability that white noise gives more;
 * `fitted`: parameters of the filter that whitened it. */
double whiteness_box(const double *correlation, int n, int lags, int fitted, double *p);

/* Spearman's correlation of ranks; NAN where one of them is constant. */
double whiteness_ranks(const double *x, const double *y, int n, struct arena *a);

#endif
