/* Loops of the smoothing (force/smooth.c). */
#include "force/spread.h"

#include <string.h>

#include "num/lanes.h"

struct shares { /* of a segment's elements, for the kernels at its two ends */
    double early[SPREAD_SEGMENT], late[SPREAD_SEGMENT];
};

/* y[i] = sum_j tap[j] x[i + j], SPREAD_WIDE outputs at a time: the additions of one wait for each other, those of four
 * registers hardly. */
LANES_CLONES
void spread_still(const struct filter *f, const double *x, double *y, long n)
{
    int taps = 2 * f->reach + 1;
    for (long i = 0; i < n; i += SPREAD_WIDE) {
        double sum[4][LANES] = {{0}};
        int some = n - i < SPREAD_WIDE ? (int)(n - i) : SPREAD_WIDE;
        for (int j = 0; j < taps; j++)
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                const double *at = x + i + j + l;
                double tap = f->tap[j];
                sum[0][l] += tap * at[0];
                sum[1][l] += tap * at[LANES];
                sum[2][l] += tap * at[2 * LANES];
                sum[3][l] += tap * at[3 * LANES];
            }
        memcpy(y + i, sum, (size_t)some * sizeof *y);
    }
}

/* sum[t] += early[i] k0[t - i] + late[i] k1[t - i] for SPREAD_WIDE places t, and elements first <= i < last in turn. */
LANES_CLONES
static void spread_gather(const struct shares *x, const double *k0, const double *k1, const int range[2], double *sum)
{
    double s[4][LANES];
    memcpy(s, sum, sizeof s);
    for (int i = range[0]; i < range[1]; i++)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            const double *p = k0 - i + l, *q = k1 - i + l;
            double a = x->early[i], b = x->late[i];
            s[0][l] += a * p[0] + b * q[0];
            s[1][l] += a * p[LANES] + b * q[LANES];
            s[2][l] += a * p[2 * LANES] + b * q[2 * LANES];
            s[3][l] += a * p[3 * LANES] + b * q[3 * LANES];
        }
    memcpy(sum, s, sizeof s);
}

/* sum[i + t] += a k0[t] + b k1[t] for every element i of a segment, a and b its shares for the two kernels; by places,
   whose sums stay in registers, not by elements: half the time. The kernels have SPREAD_WIDE zeros on each side. */
void spread_segment(const double *x, double *const kernel[2], double *sum, int taps)
{
    struct shares shares;
    for (int i = 0; i < SPREAD_SEGMENT; i++) {
        double later = (double)i / SPREAD_SEGMENT;
        shares.early[i] = (1 - later) * x[i];
        shares.late[i] = later * x[i];
    }
    for (int t = 0; t < taps + SPREAD_SEGMENT - 1; t += SPREAD_WIDE) {
        int range[2] = {t - taps + 1 > 0 ? t - taps + 1 : 0,
                        t + SPREAD_WIDE < SPREAD_SEGMENT ? t + SPREAD_WIDE : SPREAD_SEGMENT};
        spread_gather(&shares, kernel[0] + t, kernel[1] + t, range, sum + t);
    }
}
