/* Data as judge_reference.py draws them: sums of three uniform numbers of Lehmer's generator, minus their mean. */
#ifndef JUDGE_DRAWN_H
#define JUDGE_DRAWN_H
#include <math.h>
#include <stdlib.h>

#include "judge_reference.h"
#include "unit.h"

#define WITHIN(x, y) ck_assert_double_eq_tol(x, y, 1e-9 * fmax(1, fabs(y)))

static inline double drawn_uniform(long *x)
{
    *x = *x * 48271 % 2147483647;
    return (double)*x / 2147483647.0;
}

static inline void drawn(long seed, int n, double *out)
{
    for (int i = 0; i < n; i++) {
        out[i] = drawn_uniform(&seed);
        out[i] += drawn_uniform(&seed);
        out[i] += drawn_uniform(&seed);
        out[i] -= 1.5;
    }
}

#endif
