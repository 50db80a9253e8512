/* Convolutions with a kernel that stays the same, and with one that changes. */
#ifndef FORCE_SPREAD_H
#define FORCE_SPREAD_H
#include "num/filter.h"
#include "num/lanes.h"

enum { SPREAD_SEGMENT = 64, SPREAD_WIDE = 4 * LANES };

/* y[i] = sum_j tap[j] x[i + j], i < n, j < 2 reach + 1. x is read up to SPREAD_WIDE values further. */
void spread_still(const struct filter *f, const double *x, double *y, long n);

/* sum[i + t] += x[i] ((1 - q) kernel[0][t] + q kernel[1][t]), q = i / SPREAD_SEGMENT, for all i < SPREAD_SEGMENT, t <
   taps. Before and behind the taps lie SPREAD_WIDE zeros; sum is read and written up to SPREAD_WIDE values further,
   which stay as they are. */
void spread_segment(const double *x, double *const kernel[2], double *sum, int taps);

#endif
