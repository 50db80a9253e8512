/* Arrays times a number, in registers of the CPU's width. */
#ifndef NUM_SCALED_H
#define NUM_SCALED_H
#include <stdbool.h>

/* y[i] = factor x[i], y[i] += factor x[i], i < n; y and x do not overlap. The same bits as the plain loop. */
void scaled_copy(double *y, double factor, const double *x, long n);
void scaled_add(double *y, double factor, const double *x, long n);

/* Sum of x[i]^2, by LANES of num/lanes.h. */
double scaled_squares(const double *x, long n);

/* Are all n values 0? */
bool scaled_is_zero(const double *x, long n);

#endif
