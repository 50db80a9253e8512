/* real.h (SLEEF's deterministic scalar functions) against long double, and one hash of all results that every CPU and
   compiler must reproduce: no fused multiply-add, no choice by CPU. */
#include "num/real.h"

#include <stdint.h>

#include "unit.h"

enum { POINTS = 100000 };

static double uniform(uint64_t *state, double lo, double hi)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * (double)(*state >> 11) * 0x1p-53;
}

static long double ulps(double got, long double want)
{
    int e;
    frexpl(want, &e);
    return fabsl(got - want) / ldexpl(1, (e < -1021 ? -1021 : e) - 53);
}

#define ONE(name)                                                                                                      \
    static double one_##name(double x) { return real_##name(x); }
ONE(exp)
ONE(exp10)
ONE(log)
ONE(log10) ONE(log1p) ONE(sin) ONE(cos) ONE(tan) ONE(tanh) ONE(sinpi) ONE(cospi)

    static long double sinpi_reference(long double x)
{
    long double r = remainderl(x, 2), a = fabsl(r) > 0.5L ? copysignl(1 - fabsl(r), r) : r; /* exact: x has 53 bits */
    return sinl(M_PIl * a);
}

static long double cospi_reference(long double x) { return sinl(M_PIl * (0.5L - fabsl(remainderl(x, 2)))); }

static const struct {
    const char *name;
    double (*f)(double);
    long double (*reference)(long double);
    double lo, hi, bound; /* ulp: SLEEF's, u10 = 1.0, u05 = 0.506 for sinpi and cospi; the reference adds 1e-3 */
} functions[] = {
    {"exp", one_exp, expl, -700, 700, 1},
    {"exp10", one_exp10, exp10l, -300, 300, 1.09},
    {"log", one_log, logl, 1e-3, 1e3, 1},
    {"log10", one_log10, log10l, 1e-3, 1e3, 1},
    {"log1p", one_log1p, log1pl, -0.9, 10, 1},
    {"sin", one_sin, sinl, -1e4, 1e4, 1},
    {"cos", one_cos, cosl, -1e4, 1e4, 1},
    {"tan", one_tan, tanl, -1e4, 1e4, 1},
    {"tanh", one_tanh, tanhl, -5, 5, 1},
    {"sinpi", one_sinpi, sinpi_reference, -300, 300, 0.51},
    {"cospi", one_cospi, cospi_reference, -300, 300, 0.51},
};
enum { FUNCTIONS = sizeof functions / sizeof functions[0] };

START_TEST(errors)
{
    for (int k = 0; k < FUNCTIONS; k++) {
        uint64_t state = 1;
        long double most = 0;
        for (int i = 0; i < POINTS; i++) {
            double x = uniform(&state, functions[k].lo, functions[k].hi);
            most = fmaxl(most, ulps(functions[k].f(x), functions[k].reference(x)));
        }
        printf("%-6s %.3Lf ulp\n", functions[k].name, most);
        ck_assert_msg(most <= functions[k].bound + 1e-3L, "%s: %.3Lf ulp", functions[k].name, most);
    }
}
END_TEST

START_TEST(errors_of_two_arguments)
{
    uint64_t state = 2;
    for (int i = 0; i < POINTS; i++) {
        double x = uniform(&state, 0.01, 100), y = uniform(&state, -50, 50), z = uniform(&state, -100, 100);
        ck_assert_double_le((double)ulps(real_pow(x, y), powl(x, y)), 1.001);
        ck_assert_double_le((double)ulps(real_atan2(y, z), atan2l(y, z)), 1.001);
    }
}
END_TEST

START_TEST(exact_values)
{
    ck_assert_double_eq(real_exp(0), 1);
    ck_assert_double_eq(real_exp(-HUGE_VAL), 0);
    ck_assert_double_eq(real_log(1), 0);
    ck_assert_double_eq(real_log(0), -HUGE_VAL);
    ck_assert_double_eq(real_tanh(HUGE_VAL), 1);
    ck_assert_double_eq(real_log1p(1e-300), 1e-300);
    ck_assert_double_eq(real_pow(2, 10), 1024);
    ck_assert_double_eq(real_exp10(3), 1000);
    for (int i = -8; i <= 8; i++) {
        ck_assert_double_eq(real_sinpi(i), 0);
        ck_assert_double_eq(real_cospi(i), i % 2 ? -1 : 1);
        ck_assert_double_eq(real_cospi(i + 0.5), 0);
    }
    ck_assert(isnan(real_log(-1)) && isnan(real_exp(NAN)) && isnan(real_tanh(NAN)));
}
END_TEST

/* The hash was made by this test with SLEEF 3.5.1. */
START_TEST(same_bits_everywhere)
{
    uint64_t h = 0xcbf29ce484222325, state = 3;
    for (int i = 0; i < POINTS; i++)
        for (int k = 0; k < FUNCTIONS + 2; k++) {
            double x = k < FUNCTIONS ? uniform(&state, functions[k].lo, functions[k].hi) : uniform(&state, 0.01, 100),
                   y;
            uint64_t u;
            y = k < FUNCTIONS ? functions[k].f(x) : k == FUNCTIONS ? real_pow(x, 1.7) : real_atan2(x - 50, 3);
            memcpy(&u, &y, sizeof u);
            h = (h ^ u) * 0x100000001b3;
        }
    printf("hash   %016llx\n", (unsigned long long)h);
    ck_assert_uint_eq(h, 0x399a5ffa7626a0e1);
}
END_TEST

UNIT("real", errors, errors_of_two_arguments, exact_values, same_bits_everywhere)
