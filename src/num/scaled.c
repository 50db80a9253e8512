#include "num/scaled.h"

#include "num/lanes.h"

/* Compiled for the least CPU these took 6 to 8 instructions each a sample, of which every sound passes three or four: a
 * quarter of what a finished tail costs. */
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

LANES_CLONES
double scaled_squares(const double *x, long n)
{
    double sum[LANES] = {0}, all = 0;
    long i = 0;
    for (; i + LANES <= n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] += x[i + l] * x[i + l];
    for (int l = 0; l < LANES; l++)
        all += sum[l];
    for (; i < n; i++)
        all += x[i] * x[i];
    return all;
}

bool scaled_is_zero(const double *x, long n)
{
    for (long i = 0; i < n; i++)
        if (x[i] != 0.0) return false;
    return true;
}
