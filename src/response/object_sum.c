/* Sums of functions with the same weights for many modes at once: the inner loop of mode shapes that are sums. */
#include "num/lanes.h"
#include "response/object_kinds.h"

LANES_CLONES
void object_sum(int n, int modes, const double *rows, const double *weight, double *sum)
{
    for (int i = 0; i < modes; i++)
        sum[i] = 0.0;
    for (int t = 0; t < n; t++) {
        const double *row = rows + (size_t)t * modes;
        double w = weight[t];
#pragma omp simd
        for (int i = 0; i < modes; i++)
            sum[i] += row[i] * w;
    }
}
