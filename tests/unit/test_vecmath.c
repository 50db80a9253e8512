/* vecmath against long double (64-bit significand: the references are within 1e-3 ulp of a double), its special values,
   and one hash of all results that every compiler, optimisation level and instruction set must reproduce. */
#include "num/vecmath.h"

#include <fenv.h>
#include <float.h>
#include <math.h>
#include <stdint.h>

#include "unit.h"

enum { BLOCK = 1000, BLOCKS = 120 }; /* 120 000 points per range */

static uint64_t next(uint64_t *state) /* splitmix64, independent of num/noise */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

static double uniform(uint64_t *state, double lo, double hi)
{
    return lo + (hi - lo) * (double)(next(state) >> 11) * 0x1p-53;
}

/* lo..hi, with the ratio of neighbours even: for arguments that span many decades; lo > 0. */
static double decades(uint64_t *state, double lo, double hi)
{
    return (double)(lo * expl(logl((long double)hi / lo) * uniform(state, 0, 1)));
}

static long double ulp(long double reference)
{
    int e;
    frexpl(reference, &e);
    return ldexpl(1, (e < -1021 ? -1021 : e) - 53);
}

struct trial {
    const char *name;
    void (*f)(size_t n, const double *x, double *y);
    long double (*reference)(long double x);
    double lo, hi;
    int by_decades;
    double bound; /* ulp */
};

static double worst(const struct trial *t)
{
    double x[BLOCK], y[BLOCK], most = 0;
    uint64_t state = 1;
    for (int b = 0; b < BLOCKS; b++) {
        for (int i = 0; i < BLOCK; i++)
            x[i] = t->by_decades ? decades(&state, t->lo, t->hi) : uniform(&state, t->lo, t->hi);
        x[0] = t->lo;
        x[1] = t->hi;
        t->f(BLOCK, x, y);
        for (int i = 0; i < BLOCK; i++) {
            long double r = t->reference(x[i]), e = fabsl(y[i] - r) / ulp(r);
            ck_assert_msg(e <= t->bound, "%s(%a) = %a is %.3Lf ulp off", t->name, x[i], y[i], e);
            most = fmax(most, (double)e);
        }
    }
    return most;
}

static long double softplus2l(long double x) { return log1pl(expl(-2 * fabsl(x))); }

/* Bounds: those of num/vecmath.h where it gives ulp; what is measured is printed. */
START_TEST(errors)
{
    static const struct trial trials[] = {
        {"exp", vecmath_exp, expl, -708.39, 709.78, 0, 2},
        {"exp", vecmath_exp, expl, -1, 1, 0, 2},
        {"exp", vecmath_exp, expl, 1e-300, 1, 1, 2},
        {"log", vecmath_log, logl, DBL_TRUE_MIN, DBL_MAX, 1, 2},
        {"log", vecmath_log, logl, 0.5, 2.5, 0, 2},
        {"log", vecmath_log, logl, 1 - 1e-7, 1 + 1e-7, 0, 2},
        {"tanh", vecmath_tanh, tanhl, -2, 2, 0, 4},
        {"tanh", vecmath_tanh, tanhl, 1e-300, 30, 1, 4},
        {"tanh", vecmath_tanh, tanhl, DBL_TRUE_MIN, 1e-290, 1, 4},
        {"tanh", vecmath_tanh, tanhl, 0.1, 25, 0, 4},
        {"softplus2", vecmath_softplus2, softplus2l, -2, 2, 0, 8},
        {"softplus2", vecmath_softplus2, softplus2l, 1e-300, 354, 1, 8},
        {"softplus2", vecmath_softplus2, softplus2l, -354, -2, 0, 8},
    };
    for (size_t i = 0; i < sizeof trials / sizeof trials[0]; i++) {
        const struct trial *t = &trials[i];
        printf("%-10s %11.4g .. %-11.4g %.3f ulp\n", t->name, t->lo, t->hi, worst(t));
    }
}
END_TEST

/* The header's bound: 2 for the exponential, and |p log x| times the 2^-54 to which the logarithm is carried. */
START_TEST(power)
{
    static const double powers[] = {0.3, 0.5, 1.5, 2, 3, -1, -0.37, 7.77, 17, 100.1, 2000, -1999, 1e-5, 1};
    double x[BLOCK], y[BLOCK], most = 0;
    uint64_t state = 2;
    for (size_t k = 0; k < sizeof powers / sizeof powers[0]; k++)
        for (int b = 0; b < 60; b++) {
            double p = powers[k], span = fmin(700, 700 / fabs(p));
            for (int i = 0; i < BLOCK; i++)
                x[i] = exp(uniform(&state, -span, span));
            vecmath_pow(BLOCK, x, p, y);
            for (int i = 0; i < BLOCK; i++) {
                long double r = powl(x[i], p), e = fabsl(y[i] - r) / (r * 0x1p-52L);
                ck_assert_msg(e <= 2 + fabs(p * log(x[i])) / 4, "%a^%g = %a is %.3Lf units off", x[i], p, y[i], e);
                most = fmax(most, (double)e);
            }
        }
    printf("pow        |p log x| < 700          %.3f x 2^-52\n", most);
}
END_TEST

START_TEST(sine_and_cosine)
{
    static const double spans[] = {1, 1e-9, 3, 1e6, 0x1p49, 0x1.fffffffffffffp49};
    double x[BLOCK], s[BLOCK], c[BLOCK], most = 0;
    uint64_t state = 3;
    for (size_t k = 0; k < sizeof spans / sizeof spans[0]; k++)
        for (int b = 0; b < 100; b++) {
            for (int i = 0; i < BLOCK; i++)
                x[i] = uniform(&state, -spans[k], spans[k]);
            vecmath_sincospi(BLOCK, x, s, c);
            for (int i = 0; i < BLOCK; i++) {
                long double r = M_PIl * remainderl(x[i], 2), e = fmaxl(fabsl(s[i] - sinl(r)), fabsl(c[i] - cosl(r)));
                ck_assert_msg(e <= 2e-16L, "sincospi(%a) is off by %.3Lg", x[i], e);
                most = fmax(most, (double)e);
            }
        }
    printf("sincospi   |x| < 2^50               %.3g absolute\n", most);
}
END_TEST

START_TEST(sine_and_cosine_exact_at_quarters)
{
    static const double start[] = {-8, 1e6, 0x1p49, -0x1.fffffffffffp49, 0x1.fffffffffffp49};
    static const double sine[4] = {0, 1, 0, -1};
    for (size_t k = 0; k < sizeof start / sizeof start[0]; k++)
        for (int i = 0; i < 32; i++) {
            double x = start[k] + 0.5 * i, s, c;
            int quarter = (int)fmod(fmod(2 * x, 4) + 4, 4);
            vecmath_sincospi(1, &x, &s, &c);
            ck_assert_double_eq(s, sine[quarter]);
            ck_assert_double_eq(c, sine[(quarter + 1) % 4]);
        }
    double far[] = {0x1p50, -0x1p50, HUGE_VAL, NAN}, s[4], c[4];
    vecmath_sincospi(4, far, s, c);
    for (int i = 0; i < 4; i++)
        ck_assert(isnan(s[i]) && isnan(c[i]));
}
END_TEST

/* y is exactly the value wanted, sign of zero included; or both are NaN. */
static void expect(const char *name, double x, double y, double want)
{
    ck_assert_msg((isnan(want) && isnan(y)) || (y == want && signbit(y) == signbit(want)), "%s(%a) = %a, not %a", name,
                  x, y, want);
}

START_TEST(special_values)
{
    static const struct {
        const char *name;
        void (*f)(size_t n, const double *x, double *y);
        double x, want;
    } special[] = {
        {"exp", vecmath_exp, 0, 1},
        {"exp", vecmath_exp, -0.0, 1},
        {"exp", vecmath_exp, -HUGE_VAL, 0},
        {"exp", vecmath_exp, HUGE_VAL, HUGE_VAL},
        {"exp", vecmath_exp, -708.4, 0},
        {"exp", vecmath_exp, -1e300, 0},
        {"exp", vecmath_exp, 709.781, HUGE_VAL},
        {"exp", vecmath_exp, 709.8, HUGE_VAL},
        {"exp", vecmath_exp, 1e300, HUGE_VAL},
        {"exp", vecmath_exp, NAN, NAN},
        {"exp", vecmath_exp, __builtin_nan("0xfff"), NAN},
        {"tanh", vecmath_tanh, __builtin_nan("0xfff"), NAN},
        {"log", vecmath_log, 1, 0},
        {"log", vecmath_log, 0, -HUGE_VAL},
        {"log", vecmath_log, -0.0, -HUGE_VAL},
        {"log", vecmath_log, -1, NAN},
        {"log", vecmath_log, -HUGE_VAL, NAN},
        {"log", vecmath_log, HUGE_VAL, HUGE_VAL},
        {"log", vecmath_log, NAN, NAN},
        {"log", vecmath_log, -DBL_TRUE_MIN, NAN},
        {"tanh", vecmath_tanh, 0, 0},
        {"tanh", vecmath_tanh, -0.0, -0.0},
        {"tanh", vecmath_tanh, HUGE_VAL, 1},
        {"tanh", vecmath_tanh, -HUGE_VAL, -1},
        {"tanh", vecmath_tanh, 1e300, 1},
        {"tanh", vecmath_tanh, NAN, NAN},
        {"tanh", vecmath_tanh, -DBL_TRUE_MIN, -DBL_TRUE_MIN},
        {"softplus2", vecmath_softplus2, HUGE_VAL, 0},
        {"softplus2", vecmath_softplus2, -1e300, 0},
        {"softplus2", vecmath_softplus2, NAN, NAN},
        {"softplus2", vecmath_softplus2, 0, 0x1.62e42fefa39efp-1},
    };
    for (size_t i = 0; i < sizeof special / sizeof special[0]; i++) {
        double y;
        special[i].f(1, &special[i].x, &y);
        expect(special[i].name, special[i].x, y, special[i].want);
    }
}
END_TEST

START_TEST(special_powers)
{
    static const struct {
        double x, p, want;
    } special[] = {
        {0, 0.5, 0},
        {0, 2, 0},
        {-0.0, 2, 0},
        {0, -1, HUGE_VAL},
        {0, 0, 1},
        {HUGE_VAL, 0.5, HUGE_VAL},
        {HUGE_VAL, -2, 0},
        {1, 123.4, 1},
        {-1, 0.5, NAN},
        {NAN, 2, NAN},
        {NAN, 0, 1},
        {0.7, 1, 0.7},
        {0, 1, 0},
        {10, 400, HUGE_VAL},
        {10, -400, 0},
        {2, 1023, 0x1p1023},
        {1e300, 1e300, HUGE_VAL},
        {1e300, -1e300, 0},
        {2, NAN, NAN},
    };
    for (size_t i = 0; i < sizeof special / sizeof special[0]; i++) {
        double y;
        vecmath_pow(1, &special[i].x, special[i].p, &y);
        expect("pow", special[i].x, y, special[i].want);
    }
}
END_TEST

/* Arguments in the domain, however far out, raise no exception that the renderer would trap. */
START_TEST(no_exceptions)
{
    double x[] = {0, 1, -1, 1e-300, -1e300, 1e300, 709, -745, 0.3, DBL_TRUE_MIN}, y[10], z[10], positive[10];
    for (int i = 0; i < 10; i++)
        positive[i] = fabs(x[i]) + DBL_MIN;
    feclearexcept(FE_ALL_EXCEPT);
    vecmath_exp(10, x, y);
    vecmath_tanh(10, x, y);
    vecmath_softplus2(10, x, y);
    vecmath_tanh_softplus2(10, x, y, z);
    vecmath_log(10, positive, y);
    vecmath_pow(10, positive, 0.7, y);
    vecmath_sincospi(10, x, y, z);
    ck_assert_int_eq(fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), 0);
}
END_TEST

enum { MANY = 4099 };

/* Both at once are each by itself, to the bit, however large x is. */
START_TEST(tanh_and_softplus_together)
{
    static double x[MANY], t[MANY], soft[MANY], tanh_alone[MANY], soft_alone[MANY];
    srand48(3);
    for (int i = 0; i < MANY; i++)
        x[i] = (drand48() < 0.5 ? -1 : 1) * pow(10, 24 * drand48() - 20);
    x[0] = 0, x[1] = -0.0, x[2] = HUGE_VAL, x[3] = -HUGE_VAL, x[4] = 354.1, x[5] = -354.2, x[6] = 22, x[7] = 19.07;
    vecmath_tanh_softplus2(MANY, x, t, soft);
    vecmath_tanh(MANY, x, tanh_alone);
    vecmath_softplus2(MANY, x, soft_alone);
    ck_assert_mem_eq(t, tanh_alone, sizeof t);
    ck_assert_mem_eq(soft, soft_alone, sizeof soft);
    x[0] = NAN;
    vecmath_tanh_softplus2(1, x, t, soft);
    ck_assert(isnan(t[0]) && isnan(soft[0]));
}
END_TEST

static uint64_t hash(uint64_t h, const double *y, int n)
{
    for (int i = 0; i < n; i++) {
        uint64_t u;
        memcpy(&u, &y[i], sizeof u);
        h = (h ^ u) * 0x100000001b3;
    }
    return h;
}

/* Every kind of argument: ordinary, tiny, huge, infinite, not a number. */
static void arguments(double *x)
{
    uint64_t state = 4;
    for (int i = 0; i < MANY; i++) {
        double kinds[] = {uniform(&state, -3, 3), uniform(&state, -750, 750), decades(&state, 1e-300, 1e300), 0.25 * i,
                          1 + 1e-9 * i};
        x[i] = kinds[i % 5];
    }
    x[17] = NAN, x[18] = HUGE_VAL, x[19] = -HUGE_VAL, x[20] = -0.0;
}

/* The hash was made by this test (gcc 12, -O2, AVX-512); it is the promise that no build differs. */
START_TEST(same_bits_in_every_build)
{
    static double x[MANY], y[MANY], z[MANY];
    uint64_t h = 0xcbf29ce484222325;
    arguments(x);
    vecmath_exp(MANY, x, y), h = hash(h, y, MANY);
    vecmath_log(MANY, x, y), h = hash(h, y, MANY);
    vecmath_pow(MANY, x, 0.77, y), h = hash(h, y, MANY);
    vecmath_pow(MANY, x, -3.3, y), h = hash(h, y, MANY);
    vecmath_tanh(MANY, x, y), h = hash(h, y, MANY);
    vecmath_softplus2(MANY, x, y), h = hash(h, y, MANY);
    vecmath_sincospi(MANY, x, y, z), h = hash(hash(h, y, MANY), z, MANY);
    printf("hash       %016llx\n", (unsigned long long)h);
    ck_assert_uint_eq(h, 0x8cd649732760da04);
}
END_TEST

/* One element at a time, in place and at an odd address gives the bits of the whole array. */
START_TEST(same_bits_in_any_piece)
{
    void (*const f[])(size_t, const double *, double *) = {vecmath_exp, vecmath_log, vecmath_tanh, vecmath_softplus2};
    static double x[MANY], y[MANY], one[MANY], in_place[MANY + 1];
    arguments(x);
    for (size_t k = 0; k < sizeof f / sizeof f[0]; k++) {
        f[k](MANY, x, y);
        for (int i = 0; i < MANY; i++)
            f[k](1, &x[i], &one[i]);
        memcpy(in_place + 1, x, sizeof x);
        f[k](MANY, in_place + 1, in_place + 1);
        ck_assert_mem_eq(one, y, sizeof y);
        ck_assert_mem_eq(in_place + 1, y, sizeof y);
    }
}
END_TEST

UNIT("vecmath", errors, power, sine_and_cosine, sine_and_cosine_exact_at_quarters, special_values, special_powers,
     no_exceptions, tanh_and_softplus_together, same_bits_in_every_build, same_bits_in_any_piece)
