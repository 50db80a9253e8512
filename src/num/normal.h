/* The standard normal distribution, by arithmetic that gives the same bits everywhere (num/real.h). */
#ifndef NUM_NORMAL_H
#define NUM_NORMAL_H

/* exp(-x^2/2) / sqrt(2 pi); relative error <= 1e-15 while it is normal (|x| <= 37.6). */
double normal_density(double x);

/* P(Z <= x); relative error <= 4e-15 for -37 <= x, so that normal_cdf(-x) is the other tail without loss; below -38.6
 * it is 0. */
double normal_cdf(double x);

/* normal_cdf and, into `density`, normal_density, in the time of one. */
double normal_cdf_density(double x, double *density);

/* x with P(Z <= x) = w, 0 < w < 1; relative error <= 2e-15 (of x; near w = 1/2 of w - 1/2). w = 0 and 1 give -inf and
 * inf. */
double normal_quantile(double w);

#endif
