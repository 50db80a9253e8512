/* slopes: sums of exponentials recovered, the stated error against one worked out here, gains against the normal
 * equations' optimum. */
#include "response/slopes.h"

#include "unit.h"

enum { N = 400 };

static double time[N], amplitude[N];

static void even(int n, double longest)
{
    for (int i = 0; i < n; i++)
        time[i] = longest * i / (n - 1);
}

/* rms of what the fit leaves, relative, over all series. */
static double left(const struct slopes_fit *f, const struct slopes_series *s, int count)
{
    double sum = 0, all = 0;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < s[k].n; i++) {
            double r = s[k].amplitude[i];
            all += r * r;
            for (int j = 0; j < f->n; j++)
                r -= s[k].gain[j] * exp(-f->decay[j] * s[k].time[i]);
            sum += r * r;
        }
    return sqrt(sum / all);
}

static struct slopes_fit fitted(struct slopes_series *s, int count)
{
    struct slopes_fit f = slopes_fit(s, count);
    ck_assert(f.n >= 1 && f.n <= SLOPES_MOST);
    for (int k = 0; k < f.n; k++)
        ck_assert(f.decay[k] > (k ? f.decay[k - 1] : 0));
    /* Gains of 1e10 may cancel, of slopes that are nearly alike: the last bits of their exponentials, here by libm, are
       1e-5 of what is left then. */
    ck_assert_double_eq_tol(f.error, left(&f, s, count), 1e-9 + 5e-5 * f.error);
    return f;
}

START_TEST(one_slope)
{
    even(50, 0.7);
    for (int i = 0; i < 50; i++)
        amplitude[i] = -3 * exp(-12.5 * time[i]);
    struct slopes_series s = {50, time, amplitude, {0}};
    struct slopes_fit f = fitted(&s, 1);
    ck_assert_int_eq(f.n, 1);
    ck_assert_double_eq_tol(f.decay[0], 12.5, 1e-6);
    ck_assert_double_eq_tol(s.gain[0], -3, 1e-6);
    ck_assert(s.gain[1] == 0);
}
END_TEST

/* Early decay and late decay, as of a plate coupled to a frame; from evenly and from unevenly spaced samples. */
START_TEST(two_slopes)
{
    for (int kind = 0; kind < 2; kind++) {
        even(120, 1.5);
        for (int i = 0; i < 120; i++) {
            time[i] = kind ? 1.5 * pow(i / 119.0, 2.5) : time[i];
            amplitude[i] = 1.0 * exp(-40 * time[i]) + 0.1 * exp(-4 * time[i]);
        }
        struct slopes_series s = {120, time, amplitude, {0}};
        struct slopes_fit f = fitted(&s, 1);
        ck_assert_int_eq(f.n, 2);
        ck_assert_double_eq_tol(f.decay[0], 4, 1e-5);
        ck_assert_double_eq_tol(f.decay[1], 40, 1e-5);
        ck_assert_double_eq_tol(s.gain[0], 0.1, 1e-6);
        ck_assert_double_eq_tol(s.gain[1], 1.0, 1e-6);
    }
}
END_TEST

/* Rise and fall: one of the gains is negative. */
START_TEST(an_attack)
{
    even(200, 1);
    for (int i = 0; i < 200; i++)
        amplitude[i] = 2 * (exp(-6 * time[i]) - exp(-90 * time[i]));
    struct slopes_series s = {200, time, amplitude, {0}};
    struct slopes_fit f = fitted(&s, 1);
    ck_assert_int_eq(f.n, 2);
    ck_assert_double_eq_tol(f.decay[0], 6, 1e-4);
    ck_assert_double_eq_tol(f.decay[1], 90, 1e-3);
    ck_assert_double_eq_tol(s.gain[1], -2, 1e-4);
}
END_TEST

/* Shapes that are no sums of exponentials: the error is as stated (checked in fitted), and no larger than here. */
START_TEST(other_shapes)
{
    static const double most[6] = {1e-3, 4e-3, 0.08, 0.2, 2e-2, 0.3};
    even(200, 1);
    for (int kind = 0; kind < 6; kind++) {
        for (int i = 0; i < 200; i++) {
            double t = time[i], x = (t - 0.2) / 0.1;
            amplitude[i] = kind == 0   ? exp(-sqrt(30 * t))                        /* stretched */
                           : kind == 1 ? 1 / (1 + 20 * t * t)                      /* no exponential's tail */
                           : kind == 2 ? t * exp(-8 * t) * (1 + 0.1 * sin(40 * t)) /* attack and ripple */
                           : kind == 3 ? exp(-x * x)                               /* a bump */
                           : kind == 4 ? exp(-5 * t) * (1 + 0.02 * (i * 7919 % 101 / 50.0 - 1)) /* noise */
                                       : t < 0.5;                                               /* cut off */
        }
        struct slopes_series s = {200, time, amplitude, {0}};
        struct slopes_fit f = fitted(&s, 1);
        printf("shape %d: %d slopes, %.1f dB\n", kind, f.n, 20 * log10(f.error));
        ck_assert_double_lt(f.error, most[kind]);
    }
}
END_TEST

/* The same decays at three places, other gains and other times; at one place a slope is missing. */
START_TEST(shared_decays)
{
    static double t[3][100], x[3][100];
    static const double gain[3][2] = {{1, 0.2}, {-0.3, 0.5}, {0, 0.4}};
    struct slopes_series s[3];
    for (int p = 0; p < 3; p++) {
        s[p] = (struct slopes_series){60 + 20 * p, t[p], x[p], {0}};
        for (int i = 0; i < s[p].n; i++) {
            t[p][i] = 0.01 * (p + 1) + 0.012 * i;
            x[p][i] = gain[p][0] * exp(-30 * t[p][i]) + gain[p][1] * exp(-3 * t[p][i]);
        }
    }
    struct slopes_fit f = fitted(s, 3);
    ck_assert_int_eq(f.n, 2);
    ck_assert_double_eq_tol(f.decay[0], 3, 1e-5);
    ck_assert_double_eq_tol(f.decay[1], 30, 1e-4);
    for (int p = 0; p < 3; p++) {
        ck_assert_double_eq_tol(s[p].gain[0], gain[p][1], 1e-6);
        ck_assert_double_eq_tol(s[p].gain[1], gain[p][0], 1e-5);
    }
}
END_TEST

/* Few samples limit the slopes; constants decay as slowly as allowed; silence is one silent slope; the scale does not
 * matter. */
START_TEST(small_cases)
{
    double two[2] = {0, 0.1}, fall[2] = {1, 0.5}, level[2] = {1, 1}, rise[2] = {0.5, 1}, none[2] = {0, 0};
    struct slopes_series s = {2, two, fall, {0}};
    struct slopes_fit f = fitted(&s, 1);
    ck_assert(f.n == 1);
    ck_assert_double_eq_tol(f.decay[0], log(2) / 0.1, 1e-6);
    s.amplitude = level;
    f = fitted(&s, 1);
    ck_assert(f.n == 1 && f.decay[0] <= 1.1e-2 && f.error < 1e-3);
    s.amplitude = rise;
    ck_assert(fitted(&s, 1).error > 0.1);
    s.amplitude = none;
    f = slopes_fit(&s, 1);
    ck_assert(f.n == 1 && f.decay[0] > 0 && s.gain[0] == 0 && f.error == 0);
    even(60, 1);
    struct slopes_fit scaled[2];
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 60; i++)
            amplitude[i] = ldexp(exp(-3 * time[i]) + exp(-20 * time[i]) + exp(-150 * time[i]) * 0.3, k ? -900 : 0);
        s = (struct slopes_series){60, time, amplitude, {0}};
        scaled[k] = slopes_fit(&s, 1);
    }
    ck_assert(memcmp(&scaled[0].decay, &scaled[1].decay, sizeof scaled[0].decay) == 0);
}
END_TEST

UNIT("slopes", one_slope, two_slopes, an_attack, other_shapes, shared_decays, small_cases)
