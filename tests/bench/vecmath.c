/* Time per element of num/vecmath.h beside the same loop over libm, in the same run: time stamp counter ticks, the
   least of many repetitions over arrays that stay in the first-level cache.

       cc -O2 -std=c11 -D_GNU_SOURCE -ffp-contract=off -fopenmp-simd -Isrc tests/bench/vecmath.c src/num/vecmath.c -lm
 */
#include "num/vecmath.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <x86intrin.h>

enum { COUNT = 1000, REPEATS = 3000 };

#define LIBM(name, expression)                                                                                         \
    static void name(size_t n, const double *x, double *y)                                                             \
    {                                                                                                                  \
        for (size_t i = 0; i < n; i++)                                                                                 \
            y[i] = (expression);                                                                                       \
    }

LIBM(libm_exp, exp(x[i]))
LIBM(libm_log, log(x[i]))
LIBM(libm_pow, pow(x[i], 1.3))
LIBM(libm_sine_and_cosine, sin(3.14159265358979323846 * x[i]) + cos(3.14159265358979323846 * x[i]))
LIBM(libm_tanh, tanh(x[i]))
LIBM(libm_softplus2, log1p(exp(-2 * fabs(x[i]))))

static void our_pow(size_t n, const double *x, double *y) { vecmath_pow(n, x, 1.3, y); }

static void our_sine_and_cosine(size_t n, const double *x, double *y)
{
    static double cosine[COUNT];
    vecmath_sincospi(n, x, y, cosine);
}

static double ticks(void (*f)(size_t, const double *, double *), const double *x, double *y)
{
    uint64_t least = UINT64_MAX;
    for (int r = 0; r < REPEATS; r++) {
        uint64_t start = __rdtsc();
        f(COUNT, x, y);
        uint64_t took = __rdtsc() - start;
        least = took < least ? took : least;
    }
    return (double)least / COUNT;
}

int main(void)
{
    static const struct {
        const char *name;
        void (*ours)(size_t, const double *, double *), (*libm)(size_t, const double *, double *);
        double lo, hi;
    } rows[] = {
        {"exp", vecmath_exp, libm_exp, -20, 20},  {"log", vecmath_log, libm_log, 1e-3, 10},
        {"pow", our_pow, libm_pow, 1e-3, 10},     {"sincospi", our_sine_and_cosine, libm_sine_and_cosine, -10, 10},
        {"tanh", vecmath_tanh, libm_tanh, -3, 3}, {"softplus2", vecmath_softplus2, libm_softplus2, -5, 5},
    };
    static double x[COUNT], y[COUNT];
    printf("%-10s %10s %10s %8s\n", "function", "ticks", "libm", "ratio");
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        for (int i = 0; i < COUNT; i++)
            x[i] = rows[k].lo + (rows[k].hi - rows[k].lo) * fmod(0.6180339887498949 * i, 1);
        double ours = ticks(rows[k].ours, x, y), libm = ticks(rows[k].libm, x, y);
        printf("%-10s %10.2f %10.2f %8.2f\n", rows[k].name, ours, libm, libm / ours);
    }
    return 0;
}
