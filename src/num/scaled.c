#include "num/scaled.h"

#include "num/lanes.h"

/* Compiled for the least CPU these took 6 to 8 instructions each a sample, of which every sound passes three or four: a quarter of what a finished tail costs. */
LANES_CLONES
void scaled_copy(double *restrict y, double factor, const double *restrict x, long n)
{
#pragma omp simd
    for (long i = 0; i < n; i++)
        y[i] = factor * x[i];
}

LANES_CLONES
void scaled_add(double *restrict y, double factor, const double *restrict x, long n)
{
#pragma omp simd
    for (long i = 0; i < n; i++)
        y[i] += factor * x[i];
}
