/* Elementary functions over arrays: every element goes through the same + - * /, comparisons that select between two
   finished values, and 64-bit integer operations that SSE2 has too, so that gcc and clang vectorise the loops for any
   width and every build gives the same bits.

       exp      x = k log 2 + r, |r| <= log(2)/2;  exp x = 2^k (1 + r + r^2 P(r))
       log      x = 2^k m, m in [sqrt(1/2), sqrt 2), f = m - 1, s = f/(2 + f), z = s^2
                log x = k log 2 + 2 atanh s = k log 2 + f - (h - s (h + z Q(z))),  h = f^2/2
       pow      exp(p log x), the logarithm and the product carried as a sum of two doubles
       sincospi x = n/2 + r, |r| <= 1/4, exactly;  sin pi r = pi r + r^3 S(r^2), cos pi r = 1 + r^2 C(r^2)
       tanh     e = exp(-2|x|) - 1 = 2^k q + (2^k - 1), q = r + r^2 P(r);  tanh |x| = -e/(2 + e)
       softplus log(1 + e), e = exp(-2|x|), by the series of log with f = e or f = (e - 1)/2

   The reductions are Cody and Waite's (Software Manual for the Elementary Functions, 1980): log 2 = LN2_HI + LN2_LO,
   LN2_HI having so few bits that k LN2_HI is exact. P, Q, S and C are minimax polynomials (Remez exchange in 60 digits,
   weighted to the relative error of the function, coefficients then rounded to double); the error each leaves is noted.
   Constants are in hexadecimal, so that no compiler's decimal conversion matters.

   Rounding to the nearest k adds a large constant in whose units of the last place k (or n/2) counts; the low bits of
   the sum are then k itself in two's complement. This needs the default rounding mode.

   Arguments are brought into range before they are used, so that lanes whose result is not taken raise no
   floating-point exception: log and pow of 0, NaN and arguments out of the domain aside, only underflow and inexact are
   raised. */
#include "num/vecmath.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "num/lanes.h"

#define INLINE static inline __attribute__((always_inline))

#define LN2_HI 0x1.62e42fefa3800p-1  /* log 2 rounded down to 42 bits       */
#define LN2_LO 0x1.ef35793c76730p-45 /* log 2 - LN2_HI                      */
#define LOG2E 0x1.71547652b82fep+0   /* 1/log 2                             */
#define ROUND_1 0x1.8p52             /* 1.5 2^52: the last place counts 1   */
#define ROUND_HALF 0x1.8p51          /* 1.5 2^51: the last place counts 1/2 */
#define EXP_MIN (-708.39)            /* exp is normal from here: log DBL_MIN = -708.3964 */
#define EXP_MAX 709.78               /* and finite up to here: log DBL_MAX = 709.7827    */
#define TANH_MAX 22.0                /* tanh rounds to 1 from 19.07 on      */

struct twosum {
    double hi, lo;
};

struct reduced {
    double r, r_lo; /* x + x_lo - k log 2, about r + r_lo  */
    uint64_t k;     /* k in the low 52 bits, for shifting  */
};

INLINE uint64_t bits_of(double x)
{
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    return u;
}

INLINE double of_bits(uint64_t u)
{
    double x;
    memcpy(&x, &u, sizeof x);
    return x;
}

/* test ? a : b by bit masks: of the conditional operator gcc keeps branches, and does not vectorise, where the CPU has
   no masked stores. (For plain SSE2 gcc 12 leaves this scalar too; from SSE4.2 on, and with clang, it is vectorised.)
 */
INLINE double select(int test, double a, double b)
{
    uint64_t mask = -(uint64_t)test;
    return of_bits((bits_of(a) & mask) | (bits_of(b) & ~mask));
}

/* lo or hi in place of what lies beyond them; NaN stays. */
INLINE double within(double x, double lo, double hi)
{
    double y = select(x < lo, lo, x);
    return select(y > hi, hi, y);
}

INLINE struct reduced reduce(double x, double x_lo)
{
    double t = x * LOG2E + ROUND_1, k = t - ROUND_1;
    double a = x - k * LN2_HI, b = k * LN2_LO - x_lo, r = a - b; /* a is exact */
    return (struct reduced){r, (a - r) - b, bits_of(t)};
}

/* exp(r) - 1 - r for |r| <= 0.3468; relative to exp(r) the polynomial is within 3.5e-18. */
INLINE double exp_tail(double r)
{
    double p = 0x1.af85bfc843b39p-26;
    p = fma(p, r, 0x1.28b072c5bdf12p-22);
    p = fma(p, r, 0x1.71dddfa8a2d1bp-19);
    p = fma(p, r, 0x1.a0199667d3d2ap-16);
    p = fma(p, r, 0x1.a01a01baf1f7bp-13);
    p = fma(p, r, 0x1.6c16c185b7130p-10);
    p = fma(p, r, 0x1.111111110d60bp-7);
    p = fma(p, r, 0x1.555555554ffeap-5);
    p = fma(p, r, 0x1.5555555555561p-3);
    p = fma(p, r, 0x1.000000000000cp-1);
    return r * r * p;
}

/* exp(x + x_lo), EXP_MIN <= x <= EXP_MAX, |x_lo| tiny beside 1; k is added to the exponent's bits, for 2^1024 is no
 * double. */
INLINE double exp_inside(double x, double x_lo)
{
    struct reduced d = reduce(x, x_lo);
    double p = 1 + (d.r + (exp_tail(d.r) + d.r_lo));
    return of_bits(bits_of(p) + (d.k << 52));
}

INLINE double exp_one(double x, double x_lo)
{
    double inside = exp_inside(within(x, EXP_MIN, EXP_MAX), x_lo);
    double y = select(x < EXP_MIN, 0, select(x > EXP_MAX, HUGE_VAL, inside));
    return select(x == x, y, x);
}

LANES_CLONES
void vecmath_exp(size_t n, const double *x, double *y)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        y[i] = exp_one(x[i], 0);
}

/* log(1 + f) - f + f^2/2 for |f| <= 0.4143, with h = f^2/2; relative to log(1 + f) the polynomial is within 1.3e-18. */
INLINE double log_tail(double f, double h)
{
    double s = f / (2 + f), z = s * s;
    double q = 0x1.2f0978bc035a2p-3;
    q = fma(q, z, 0x1.39a157ec2efddp-3);
    q = fma(q, z, 0x1.74664289a3262p-3);
    q = fma(q, z, 0x1.c71c51f8af8a1p-3);
    q = fma(q, z, 0x1.24924942045b6p-2);
    q = fma(q, z, 0x1.999999997fc75p-2);
    q = fma(q, z, 0x1.5555555555593p-1);
    return s * (h + z * q);
}

/* k log 2 + log(1 + f), exact but for the last steps: |k log 2| is 0 or larger than |f - h|, so both sums are Dekker's.
 */
INLINE struct twosum log_sum(double k, double f)
{
    double h = 0.5 * f * f, d = f - h, d_lo = (f - d) - h;
    double a = k * LN2_HI, hi = a + d;
    return (struct twosum){hi, ((a - hi) + d) + (d_lo + (log_tail(f, h) + k * LN2_LO))};
}

/* x = 2^k (1 + f) of a positive finite x; subnormal numbers are scaled by 2^54 first. The exponent is counted from the
   bits of sqrt(1/2), and made a double by writing it into the last places of 2^52. */
INLINE struct twosum log_inside(double x)
{
    const uint64_t half_root = 0x3fe6a09e667f3bcd, one = 0x3ff0000000000000;
    double normal = x * select(x < DBL_MIN, 0x1p54, 1), shift = select(x < DBL_MIN, 54, 0);
    uint64_t u = bits_of(normal), k = (u + (one - half_root)) >> 52;
    double f = of_bits(u - ((k - 1023) << 52)) - 1;
    return log_sum(of_bits(k | 0x4330000000000000) - (0x1p52 + 1023) - shift, f);
}

INLINE double log_one(double x)
{
    int inside = (x > 0) & (x < HUGE_VAL);
    struct twosum s = log_inside(select(inside, x, 1));
    double outside = select(x == 0, -HUGE_VAL, select(x < 0, (double)NAN, x));
    return select(inside, s.hi + s.lo, outside);
}

LANES_CLONES
void vecmath_log(size_t n, const double *x, double *y)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        y[i] = log_one(x[i]);
}

/* The upper 26 bits: products of two such numbers are exact. */
INLINE double upper(double x) { return of_bits(bits_of(x) & 0xfffffffff8000000); }

/* p log x is carried to 2^-54 of itself: rounding it to a double would cost |p log x|/2 ulp of the result. */
INLINE double pow_one(double x, double p)
{
    int inside = (x > 0) & (x < HUGE_VAL);
    struct twosum s = log_inside(select(inside, x, 1));
    double log_x = s.hi + s.lo, a = upper(log_x), a_lo = (log_x - a) + ((s.hi - log_x) + s.lo);
    double b = upper(p), b_lo = p - b;
    double y = p * log_x, y_lo = (a * b - y) + (p * a_lo + b_lo * a);
    double at_zero = select(p > 0, 0, HUGE_VAL), at_infinity = select(p > 0, HUGE_VAL, 0);
    double outside = select(x == 0, at_zero, select(x > 0, at_infinity, select(x < 0, (double)NAN, x)));
    return select(inside, exp_one(y, y_lo), outside);
}

LANES_CLONES
static void pow_loop(size_t n, const double *x, double p, double *y)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        y[i] = pow_one(x[i], p);
}

void vecmath_pow(size_t n, const double *x, double p, double *y)
{
    if (p != 0 && p != 1)
        pow_loop(n, x, p, y);
    else
        for (size_t i = 0; i < n; i++) /* exact, and what NaN and negative x give is C's pow as well */
            y[i] = p == 0 ? 1 : x[i];
}

/* sin(pi r) for |r| <= 1/4; relative error of the polynomial 5e-19. */
INLINE double sinpi_inside(double r, double z)
{
    double s = 0x1.e3c370cf7d046p-12;
    s = fma(s, z, -0x1.e2ffddcd5b95dp-8);
    s = fma(s, z, 0x1.50782f2f4fb89p-4);
    s = fma(s, z, -0x1.32d2cce230e40p-1);
    s = fma(s, z, 0x1.466bc67757d80p+1);
    s = fma(s, z, -0x1.4abbce625be3cp+2);
    return r * 0x1.921fb54442d18p+1 + r * z * s;
}

/* cos(pi r) for z = r^2 <= 1/16; error of the polynomial 3.3e-20. */
INLINE double cospi_inside(double z)
{
    double c = -0x1.b26fcb561a389p-14;
    c = fma(c, z, 0x1.f9cc6a72a7ab3p-10);
    c = fma(c, z, -0x1.a6d1ecb6cbf5ap-6);
    c = fma(c, z, 0x1.e1f50683b39f2p-3);
    c = fma(c, z, -0x1.55d3c7e3c95b7p+0);
    c = fma(c, z, 0x1.03c1f081b5ab0p+2);
    c = fma(c, z, -0x1.3bd3cc9be45dep+2);
    return 1 + z * c;
}

/* n mod 4 turns (sin, cos) into (cos, -sin), (-sin, -cos), (-cos, sin). */
LANES_CLONES
void vecmath_sincospi(size_t n, const double *x, double *s, double *c)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        int inside = fabs(x[i]) < 0x1p50;
        double a = select(inside, x[i], 0), t = a + ROUND_HALF;
        double r = a - (t - ROUND_HALF), z = r * r;
        uint64_t quarter = bits_of(t), swap = -(quarter & 1);
        uint64_t u = bits_of(sinpi_inside(r, z)), v = bits_of(cospi_inside(z));
        uint64_t exchange = (u ^ v) & swap;
        double sine = of_bits(u ^ exchange ^ (quarter & 2) << 62);
        double cosine = of_bits(v ^ exchange ^ ((quarter + 1) & 2) << 62);
        s[i] = select(inside, sine, (double)NAN);
        c[i] = select(inside, cosine, (double)NAN);
    }
}

INLINE double tanh_one(double x)
{
    double a = fabs(x), y = -2 * select(a > TANH_MAX, TANH_MAX, a);
    struct reduced d = reduce(y, 0);
    double q = d.r + (exp_tail(d.r) + d.r_lo), two_k = of_bits((d.k + 1023) << 52);
    double e = two_k * q + (two_k - 1), t = -e / (2 + e);
    const uint64_t sign = 0x8000000000000000;
    return select(x == x, of_bits((bits_of(t) & ~sign) | (bits_of(x) & sign)), x);
}

LANES_CLONES
void vecmath_tanh(size_t n, const double *x, double *y)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        y[i] = tanh_one(x[i]);
}

/* log(1 + e), 0 <= e <= 1. A tiny e is its own logarithm; its square would be subnormal, which takes some CPUs three
 * times as long. */
INLINE double softplus_of(double e)
{
    int tiny = e < 0x1p-60;
    double k = select(e > 0.4142, 1, 0), f = select(tiny, 0, select(e > 0.4142, (e - 1) * 0.5, e));
    struct twosum s = log_sum(k, f);
    return select(tiny, e, s.hi + s.lo);
}

INLINE double softplus2_one(double x)
{
    double a = fabs(x);
    return softplus_of(exp_one(-2 * select(a > 400, 400, a), 0));
}

LANES_CLONES
void vecmath_softplus2(size_t n, const double *x, double *y)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        y[i] = softplus2_one(x[i]);
}

/* Of |x| > TANH_MAX 2^k is below 2^-63, and 2^k - 1 is -1. */
LANES_CLONES
void vecmath_tanh_softplus2(size_t n, const double *x, double *t, double *soft)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = x[i], y = -2 * fabs(v);
        struct reduced d = reduce(select(y < EXP_MIN, EXP_MIN, y), 0);
        double q = d.r + (exp_tail(d.r) + d.r_lo), two_k = of_bits((d.k + 1023) << 52);
        double less = two_k * select(y < -2 * TANH_MAX, 0, q) + (two_k - 1),
               e = select(y < EXP_MIN, 0, of_bits(bits_of(1 + q) + (d.k << 52)));
        const uint64_t sign = 0x8000000000000000;
        t[i] = select(v == v, of_bits((bits_of(-less / (2 + less)) & ~sign) | (bits_of(v) & sign)), v);
        soft[i] = select(v == v, softplus_of(e), v);
    }
}
