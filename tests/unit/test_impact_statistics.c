/* impact_statistics: intervals cover what the series were drawn from, and each warning comes when it should and not
 * else. */
#include "analysis/impact_statistics.h"

#include "series.h"

enum { MOST = 2000 };
static double at[MOST], amplitude[MOST], duration[MOST];
static bool alone[MOST];

struct plan {
    int n;
    double a1[2], b1[2], mean[2], deviation[2];
    bool two;     /* processes */
    double floor; /* of amplitudes */
};

/* Like papers/002's table I at rho = 0. */
static const struct plan smooth = {.n = MOST,
                                   .a1 = {-0.97, -0.97},
                                   .b1 = {0.07, -0.34},
                                   .mean = {0.43, 3.1e-3},
                                   .deviation = {0.03, 0.19e-3},
                                   .floor = -HUGE_VAL};

/* Like its other column, rho = 1, with the floor of prototype roll: about 3 % of the amplitudes are at it. */
static const struct plan rough = {.n = MOST,
                                  .a1 = {-0.93, -0.93},
                                  .b1 = {0.32, 0.35},
                                  .mean = {0.27, 6.4e-3},
                                  .deviation = {0.04, 0.85e-3},
                                  .floor = 2.7e-3};

static struct impact_events draw(struct plan p, unsigned long seed)
{
    static double interval[MOST];
    gsl_rng *g = series_rng(seed);
    series_draw(g, p.mean[0], p.deviation[0], p.a1[0], p.b1[0], amplitude, p.n);
    if (!p.two) gsl_rng_set(g, seed);
    series_draw(g, p.mean[1], p.deviation[1], p.a1[1], p.b1[1], interval, p.n);
    gsl_rng_free(g);
    at[0] = 1;
    for (int i = 0; i < p.n; i++) {
        amplitude[i] = fmax(amplitude[i], p.floor);
        duration[i] = 1e-4;
        if (i + 1 < p.n) at[i + 1] = at[i] + fmax(interval[i], 1e-5);
    }
    return (struct impact_events){p.n, at, amplitude, duration, alone, 0, {0}};
}

static struct impact_statistics s;

static void make(const struct impact_events *v, bool demodulate, struct arena *a)
{
    struct err e = {.kind = ERR_NONE};
    ck_assert_msg(impact_statistics_make(v, demodulate, a, &s, &e), "%s", e.text);
}

static bool warned(const char *of)
{
    for (int i = 0; s.warnings[i]; i++)
        if (strstr(s.warnings[i], of)) return true;
    return false;
}

static bool holds(struct estimate e, double truth)
{
    ck_assert(e.error > 0 && e.low < e.value && e.value < e.high);
    return e.low <= truth && truth <= e.high;
}

/* 40 seeds, 8 parameters: of 40 at least 33 (95 % would give fewer once in 2000), of all 320 at least 290. */
START_TEST(test_coverage)
{
    enum { SEEDS = 40 };
    int held[2][4] = {0}, all = 0, single = 0;
    for (int seed = 1; seed <= SEEDS; seed++) {
        struct arena *a = arena_open();
        struct impact_events v = draw(smooth, seed);
        make(&v, false, a);
        for (int k = 0; k < 2; k++) {
            const struct series_statistics *t = &s.series[k];
            const double is[] = {smooth.mean[k], smooth.deviation[k], smooth.a1[k], smooth.b1[k]};
            const struct estimate e[] = {t->mean, t->deviation, t->a1, t->b1};
            for (int p = 0; p < 4; p++)
                held[k][p] += holds(e[p], is[p]);
        }
        single += s.one_process > 0.99;
        arena_close(a);
    }
    for (int i = 0; i < 8; i++) {
        ck_assert_msg(held[i / 4][i % 4] >= 33, "parameter %d: %d of 40", i, held[i / 4][i % 4]);
        all += held[i / 4][i % 4];
    }
    ck_assert_msg(all >= 290, "%d of 320", all);
    ck_assert_int_eq(single, SEEDS);
}
END_TEST

START_TEST(test_plain)
{
    struct arena *a = arena_open();
    struct impact_events v = draw(smooth, 99);
    make(&v, true, a);
    ck_assert_msg(s.warnings[0] == NULL, "%s", s.warnings[0]);
    ck_assert(!s.modulation.found && s.n == MOST && memcmp(s.demodulated, amplitude, sizeof amplitude) == 0);
    for (int k = 0; k < 2; k++) {
        const struct series_statistics *t = &s.series[k];
        double b = smooth.b1[k], r = (b + 0.97) * (1 + 0.97 * b) / (1 + b * b + 2 * 0.97 * b), energy = 0;
        ck_assert(!t->flat && !t->ridge && t->iterations > 0);
        ck_assert_double_eq_tol(t->correlation[1], r, 0.03); /* 5 errors */
        for (int i = 1; i < STATISTICS_LAGS; i++)
            ck_assert_msg(fabs(t->white_correlation[i]) < 4.2 / sqrt(MOST), "lag %d: %g", i, t->white_correlation[i]);
        for (int i = 0; i < MOST - 1; i++)
            energy += s.white[k][i] * s.white[k][i];

        ck_assert_double_eq_tol(sqrt(energy / (MOST - 3)), t->deviation.value, 2e-3 * t->deviation.value);
        ck_assert(t->white.gaussian_r2 > 0.95 && t->itself.skewness != t->white.skewness);
    }
    ck_assert(s.white_cross[STATISTICS_LAGS - 1] > 0.99 && s.cross[STATISTICS_LAGS - 1] > 0.8);
    arena_close(a);
}
END_TEST

START_TEST(test_warns)
{
    struct arena *a = arena_open();
    struct plan p = smooth;
    p.floor = 0.2;
    struct impact_events v = draw(p, 3);
    make(&v, true, a);
    ck_assert(warned("amplitudes are the smallest one, 0.2") && !warned("intervals are the smallest"));
    v = draw(smooth, 3);
    for (int i = 0; i < MOST; i++) /* rounded, not floored */
        amplitude[i] = 0.1 * rint(amplitude[i] / 0.1);
    make(&v, true, a);
    ck_assert(!warned("the smallest one"));

    p = smooth, p.n = 200;
    v = draw(p, 4);
    make(&v, true, a);
    ck_assert(warned("only 200 impacts"));

    p = smooth, p.two = true;
    v = draw(p, 5);
    make(&v, true, a);
    ck_assert(warned("not driven by one process") && !warned("in part") && fabs(s.one_process) < 0.1);
    gsl_rng *g = series_rng(5);
    v = draw(smooth, 5);
    for (int i = 0; i < MOST; i++)
        amplitude[i] += gsl_ran_gaussian(g, 0.02);
    make(&v, true, a);
    ck_assert_msg(warned("by one process only in part") && !warned("not driven") && s.one_process > 0.5 &&
                      s.one_process < 0.9,
                  "%g", s.one_process);
    gsl_rng_free(g);

    v = draw(smooth, 6);
    for (int i = 0; i < MOST; i++)
        duration[i] = 2.5e-3;
    make(&v, true, a);
    ck_assert(warned("begin before the one before is over"));
    for (int i = 0; i < MOST; i++)
        duration[i] = NAN;
    make(&v, true, a);
    ck_assert(!warned("begin before"));

    p = smooth, p.a1[1] = p.b1[1] = 0;
    v = draw(p, 7);
    make(&v, true, a);
    ck_assert(warned("intervals: white as they are") && s.series[1].ridge && s.series[1].a1.value == 0 &&
              s.series[1].a1.low == -1 && s.series[1].a1.high == 1);
    ck_assert(holds(s.series[1].mean, 3.1e-3) && !s.series[0].ridge);

    v = draw(smooth, 8);
    for (int i = 0; i < MOST; i++)
        amplitude[i] += 0.5 * amplitude[i > 4 ? i - 5 : 0];
    make(&v, true, a);
    ck_assert(warned("amplitudes: not white after one pole") && s.series[0].whiteness_p < 0.001);

    g = series_rng(9);
    v = draw(smooth, 9);
    for (int i = 0; i < MOST; i++)
        amplitude[i] = gsl_ran_exponential(g, 1);
    make(&v, true, a);
    ck_assert(warned("amplitudes: the white process is not Gaussian") && !warned("intervals: the white process"));
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* What is at a floor: under a modulation that is divided out, in a force as far as alike impacts are told apart there;
 * and what is not. */
START_TEST(test_floors)
{
    struct arena *a = arena_open();
    struct plan p = rough;
    for (int seed = 20; seed < 24; seed++) {
        struct impact_events v = draw(p, seed);
        for (int i = 0; i < MOST; i++)
            amplitude[i] *= 1 + 0.3 * sin(2 * M_PI * 5 * at[i] + seed);
        make(&v, true, a);
        ck_assert_msg(s.modulation.found && warned("amplitudes are the smallest one, about 0.") &&
                          warned("by that: the mean is too high"),
                      "seed %d", seed);
        p.floor = -HUGE_VAL;
        v = draw(p, seed);
        p.floor = rough.floor;
        for (int i = 0; i < MOST; i++)
            amplitude[i] = (0.6 * p.floor + fabs(amplitude[i])) * (1 + 0.3 * sin(2 * M_PI * 5 * at[i] + seed));
        make(&v, true, a);
        ck_assert_msg(s.modulation.found && !warned("amplitudes are the smallest one"), "seed %d", seed);
    }
    p = smooth, p.floor = 0.2;
    struct impact_events v = draw(p, 3);
    for (int i = 0; i < MOST; i++)
        amplitude[i] *= 1 + 0.004 * sin(i * i);
    make(&v, true, a);
    ck_assert(!warned("the smallest one"));
    v.blur[0] = 0.005;
    make(&v, true, a);
    ck_assert(warned("amplitudes are the smallest one, about 0.2"));
    v = draw(smooth, 3);
    amplitude[7] = 1e30, amplitude[70] = 2e30, amplitude[700] = 4e30;
    make(&v, true, a);
    ck_assert(!warned("the smallest one"));
    v = draw(smooth, 3); /* rubbing for a third of it */
    for (int i = 1; i < MOST; i++)
        at[i] = at[i - 1] + (i < MOST / 3 ? 1 / 44100.0 : fmax(3e-3 + 1e-3 * sin(i * i), 1e-3));
    make(&v, true, a);
    ck_assert(warned("intervals are the smallest one, 2.268e-05: raised to a floor, as draws below one are (or drawn "
                     "alike, as a rub's are)"));
    arena_close(a);
}
END_TEST

/* Impacts that follow each other without a gap, at times that rounding moves, do not run into each other; by 1e-6 of
 * their duration they do. */
START_TEST(test_touch)
{
    struct arena *a = arena_open();
    struct impact_events v = draw(smooth, 3);
    for (int i = 0; i < MOST; i++)
        at[i] = 100 + i / 44100.0, duration[i] = 1 / 44100.0;
    make(&v, true, a);
    ck_assert(!warned("begin before"));
    for (int i = 0; i < MOST; i++)
        duration[i] *= 1 + 1e-6;
    make(&v, true, a);
    ck_assert(warned("begin before") && !warned("cannot be told here"));
    v.blur[0] = 0.005;
    make(&v, true, a);
    ck_assert(warned("whether draws were raised to a floor cannot be told here"));
    arena_close(a);
}
END_TEST

/* Errors of the deviation know the kurtosis: of exponential values it is known less well. */
START_TEST(test_kurtosis)
{
    struct arena *a = arena_open();
    gsl_rng *g = series_rng(1);
    int held = 0;
    for (int seed = 0; seed < 40; seed++) {
        struct impact_events v = draw(smooth, seed);
        for (int i = 0; i < MOST; i++)
            amplitude[i] = gsl_ran_exponential(g, 1);
        make(&v, false, a);
        held += holds(s.series[0].deviation, 1);
        ck_assert(s.series[0].deviation.error > 1.5 / sqrt(2.0 * MOST));
    }
    ck_assert_msg(held >= 33, "%d of 40", held);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

START_TEST(test_demodulates)
{
    struct arena *a = arena_open();
    struct impact_events v = draw(smooth, 11);
    for (int i = 0; i < MOST; i++)
        amplitude[i] = fmax(amplitude[i], 4e-3) * (1 + 0.3 * sin(2 * M_PI * 5 * at[i]));
    make(&v, true, a);
    ck_assert(s.modulation.found && fabs(s.modulation.depth - 0.3) < 4 * s.modulation.depth_error &&
              fabs(s.modulation.rate - 5) < 4 * s.modulation.rate_error);
    ck_assert(warned("amplitudes are modulated, m = 0."));
    ck_assert(holds(s.series[0].a1, -0.97) && holds(s.series[0].mean, 0.43) &&
              memcmp(s.demodulated, amplitude, sizeof amplitude) != 0);
    double variance = s.series[0].variance;
    make(&v, false, a);
    ck_assert(!s.modulation.found && s.series[0].variance > variance * 1.1 &&
              memcmp(s.demodulated, amplitude, sizeof amplitude) == 0);
    arena_close(a);
}
END_TEST

START_TEST(test_flat)
{
    struct arena *a = arena_open();
    struct impact_events v = draw(smooth, 12);
    for (int i = 0; i < MOST; i++) /* rubbing: an impact a sample, far from time 0 */
        at[i] = 1000 + i / 44100.0, duration[i] = 0.9 / 44100;
    make(&v, true, a);
    ck_assert(s.series[1].flat && !s.series[0].flat && isnan(s.one_process));
    ck_assert_double_eq_tol(s.series[1].mean.value, 1 / 44100.0, 1e-12);
    ck_assert(s.series[1].deviation.value == 0 && s.series[1].a1.value == 0 && isnan(s.series[1].white.gaussian_r2));
    for (int i = 0; i < MOST; i++)
        amplitude[i] = 0.25;
    make(&v, true, a);
    ck_assert(s.series[0].flat && s.series[0].mean.value == 0.25 && s.warnings[0] == NULL);
    arena_close(a);
}
END_TEST

static void refused(const struct impact_events *v, const char *text)
{
    struct arena *a = arena_open();
    struct err e = {.kind = ERR_NONE};
    ck_assert(!impact_statistics_make(v, true, a, &s, &e));
    ck_assert(e.kind == ERR_SCENE);
    ck_assert_msg(strstr(e.text, text), "%s", e.text);
    arena_close(a);
}

START_TEST(test_refuses)
{
    struct plan p = smooth;
    p.n = 49;
    struct impact_events v = draw(p, 13);
    refused(&v, "49 impacts are too few");
    v = draw(smooth, 13);
    at[7] = at[6];
    refused(&v, "impact 8, at");
    v = draw(smooth, 13);
    amplitude[3] = NAN;
    refused(&v, "impact 4");
    struct arena *a = arena_open();
    p.n = 50;
    v = draw(p, 13);
    make(&v, true, a);
    arena_close(a);
}
END_TEST

UNIT("impact_statistics", test_coverage, test_plain, test_warns, test_floors, test_touch, test_kurtosis,
     test_demodulates, test_flat, test_refuses)
