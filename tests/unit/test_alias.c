/* alias: sampled modes and the taps together against the transfer functions in continuous time, for poles and gains
 * that nobody picked. */
#include <complex.h>
#include <math.h>

#include "convolution/alias.h"
#include "unit.h"

#define RATE 48000.0

static double draw(double low, double high)
{
    static unsigned long long x = 88172645463325252ULL;
    x ^= x << 13, x ^= x >> 7, x ^= x << 17;
    return low + (high - low) * ((double)(x >> 11) / 9007199254740992.0);
}

struct mode {
    double f, d;
    double complex A;
};

static struct mode any(double top)
{
    return (struct mode){draw(0, top) * RATE, RATE * pow(10, draw(-6, -0.5)), cexp(I * draw(-M_PI, M_PI))};
}

/* Of t^(gamma-1) Im(A e^(s t)) for f = e^(j omega t): (gamma-1)! A/(j omega - s)^gamma and its mirror. */
static double complex continuous(const struct mode *m, int gamma, double omega)
{
    double complex s = -m->d + 2 * M_PI * I * m->f;
    double all = tgamma(gamma);
    return all * (m->A / cpow(I * omega - s, gamma) - conj(m->A) / cpow(I * omega - conj(s), gamma)) / (2 * I);
}

/* Of its samples: (1/rate) sum' n^(gamma-1) p^n z^n / rate^(gamma-1), of gamma 1 with half of n = 0; sums of powers in
 * closed form. */
static double complex powers(int gamma, double complex x)
{
    double complex q = 1 / (1 - x);
    switch (gamma) {
    case 1:
        return 0.5 * (1 + x) * q;
    case 2:
        return x * q * q;
    case 3:
        return x * (1 + x) * q * q * q;
    default:
        return x * (1 + 4 * x + x * x) * q * q * q * q;
    }
}

static double complex sampled(const struct mode *m, int gamma, double omega)
{
    double complex p = cexp((-m->d + 2 * M_PI * I * m->f) / RATE), z = cexp(-I * omega / RATE);
    return (m->A * powers(gamma, p * z) - conj(m->A) * powers(gamma, conj(p) * z)) / (2 * I) / pow(RATE, gamma);
}

static double complex taps(const struct alias *a, const struct mode *m, double omega)
{
    double re[ALIAS_TAPS], im[ALIAS_TAPS];
    double complex sum = 0;
    alias_taps(a, m->f, m->d, re, im);
    for (int k = 0; k < ALIAS_TAPS; k++)
        sum += cimag(m->A * (re[k] + I * im[k])) * cexp(-I * omega / RATE * (k - ALIAS_REACH));
    return sum;
}

/* From 0 to 0.4 of the rate, poles up to 0.45. The fit leaves 1e-4 of |A|/rate of an exponential; of t^(gamma-1) times
   that the derivatives' (gamma-1)!, and the nearest image, 0.15 of the rate off at most, enters with a higher power:
   4^(gamma-1). Without the taps it is up to 0.6 |A|/rate. */
START_TEST(continuous_up_to_two_fifths_of_the_rate)
{
    struct arena *arena = arena_open();
    for (int gamma = 1; gamma <= 4; gamma++) {
        const struct alias *a = alias_make(arena, gamma, RATE);
        double worst = 0, plain = 0, unit = 1 / pow(RATE, gamma);
        for (int i = 0; i < 300; i++) {
            struct mode m = any(0.45);
            for (int k = 0; k <= 50; k++) {
                double omega = 2 * M_PI * RATE * (k < 50 ? 0.4 * k / 50 : draw(0, 0.4));
                double complex want = continuous(&m, gamma, omega), got = sampled(&m, gamma, omega);
                double near = 1e-12 * cabs(want); /* closed forms' own rounding at a resonance */
                plain = fmax(plain, cabs(got - want) / unit);
                worst = fmax(worst, (cabs(got + taps(a, &m, omega) - want) - 1e3 * near) / unit);
            }
        }
        printf("gamma %d: %.2g without, %.2g with taps\n", gamma, plain, worst);
        ck_assert_double_gt(plain, 0.1);
        ck_assert_double_lt(worst, 1e-4 * pow(4, gamma - 1) * tgamma(gamma));
    }
    arena_close(arena);
}
END_TEST

/* Value and slope at 0 Hz are those of continuous time to rounding, so that zeros there, single and double, are kept:
   against differences at +-1e-4 rad, whose own error is a third of the third derivative, 1e-8. */
START_TEST(zeros_at_0_hz)
{
    struct arena *arena = arena_open();
    const struct alias *a = alias_make(arena, 1, RATE);
    for (int i = 0; i < 200; i++) {
        struct mode m = any(0.45);
        double step = 1e-4 * RATE, unit = 1 / RATE;
        double complex off[3];
        for (int k = -1; k <= 1; k++)
            off[k + 1] = (sampled(&m, 1, k * step) + taps(a, &m, k * step) - continuous(&m, 1, k * step)) / unit;
        double size = 1 + cabs(continuous(&m, 1, 0)) / unit;
        ck_assert_double_lt(cabs(off[1]), 1e-11 * size);
        ck_assert_double_lt(cabs(off[2] - off[0]) / 2e-4, 1e-7 * size);
    }
    arena_close(arena);
}
END_TEST

/* A struck mode of velocity g (cos - (d/w) sin), as acceleration: A = g (j - d/w) s, D = Im(A/s) = g. Below its
   resonance it moves as -g omega^2/|s|^2; between 1e-3 and 0.02 of the rate, against the closed form g (j omega)^2/((j
   omega + d)^2 + w^2), to 1e-6 of that. Impulse invariance and D alone: g (w/rate)^2/12. */
START_TEST(an_acceleration_below_its_mode)
{
    struct arena *arena = arena_open();
    const struct alias *a = alias_make(arena, 1, RATE);
    for (int i = 0; i < 100; i++) {
        double f = draw(0.1, 0.45) * RATE, d = draw(1, 500), w = 2 * M_PI * f, g = 0.7;
        struct mode m = {f, d, g * (I - d / w) * (-d + I * w)};
        for (int k = 0; k < 20; k++) {
            double omega = 2 * M_PI * RATE * draw(1e-3, 0.02);
            double complex s = I * omega, want = g * s * s / ((s + d) * (s + d) + w * w),
                           plain = g + sampled(&m, 1, omega);
            ck_assert_double_gt(cabs(plain - want), 0.5 * g * pow(w / RATE, 2) / 12);
            ck_assert_double_lt(cabs(plain + taps(a, &m, omega) - want), 1e-3 * cabs(want) + 1e-11 * g);
        }
    }
    arena_close(arena);
}
END_TEST

/* Taps by interpolation: third differences over STEP = pi/128 leave some 1e-7 of |A|/rate; modes that decay fast get
 * their own. */
START_TEST(interpolated)
{
    struct arena *arena = arena_open();
    for (int gamma = 1; gamma <= 4; gamma++) {
        struct alias *a = alias_make(arena, gamma, RATE);
        double worst[2] = {0};
        for (int i = 0; i < 2000; i++) {
            struct mode m = any(i % 2 ? 0.45 : 0.3);
            double re[ALIAS_TAPS], im[ALIAS_TAPS], to[ALIAS_TAPS] = {0};
            alias_taps(a, m.f, m.d, re, im);
            alias_add(a, m.f, m.d, (double[2]){creal(m.A), cimag(m.A)}, to);
            for (int k = 0; k < ALIAS_TAPS; k++)
                worst[i % 2] = fmax(worst[i % 2], fabs(to[k] - cimag(m.A * (re[k] + I * im[k]))) * pow(RATE, gamma));
        }
        printf("gamma %d: %.2g up to 0.3 of the rate, %.2g up to 0.45\n", gamma, worst[0], worst[1]);
        ck_assert_double_lt(worst[0], 2e-8 * pow(4, gamma - 1) * tgamma(gamma));
        ck_assert_double_lt(worst[1], 2e-6 * pow(4, gamma - 1) * tgamma(gamma));
    }
    arena_close(arena);
}
END_TEST

UNIT("alias", continuous_up_to_two_fifths_of_the_rate, zeros_at_0_hz, an_acceleration_below_its_mode, interpolated)
