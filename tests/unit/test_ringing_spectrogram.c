/* ringing_spectrogram: modes that are apart come back; neither noise nor what is no decaying sinusoid does. */
#include "analysis/ringing.h"

#include "ringing_series.h"
#include "unit.h"

enum { N = 30000, COUNT = 4 };

static const double RATE = 44100;

static void find(const double *h, double threshold, struct arena *a, struct ringing_modes *m)
{
    struct ringing_options o = ringing_options;
    struct err e = {0};
    o.threshold = threshold;
    ck_assert_msg(ringing_spectrogram(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = &h}, &o, a, m, &e), "%s", e.text);
}

/* Four modes far apart. */
START_TEST(test_apart)
{
    const struct truth m[COUNT] = {{.frequency = 300, .decay = 10, .gain = 1, .phase = 1}, {.frequency = 1003.7, .decay = 40, .gain = 0.3, .phase = 2},
                                   {.frequency = 4000, .decay = 20, .gain = 0.1, .phase = 3}, {.frequency = 8000, .decay = 5, .gain = 0.1, .phase = 1}};
    static double h[N];
    struct arena *a = arena_open();
    struct ringing_modes found;
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    series_sum(m, COUNT, RATE, N, h);
    series_noise(g, 1e-4, N, h);
    find(h, 0.1, a, &found);
    ck_assert_int_eq(found.n, COUNT);
    for (int i = 0; i < COUNT; i++) {
        const struct ringing_mode *best = &found.mode[0];
        for (int k = 1; k < found.n; k++)
            if (fabs(found.mode[k].frequency - m[i].frequency) < fabs(best->frequency - m[i].frequency))
                best = &found.mode[k];
        ck_assert_double_eq_tol(best->frequency, m[i].frequency, 0.02); /* a bin is 10.8 Hz: 60 dB and more of SNR, a 500th of one */
        ck_assert_double_eq_tol(best->decay / m[i].decay, 1, 0.01);
        ck_assert_double_eq_tol(hypot(best->re[0], best->im[0]) / m[i].gain, 1, 0.01);
    }
    find(h, 1e-9, a, &found); /* no fit is as good */
    ck_assert_int_eq(found.n, 0);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

START_TEST(test_noise)
{
    static double h[N];
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    for (int seed = 1; seed <= 10; seed++) {
        struct arena *a = arena_open();
        struct ringing_modes found;
        memset(h, 0, sizeof h);
        series_noise(g, 1, N, h);
        find(h, 0.1, a, &found);
        ck_assert_int_eq(found.n, 0);
        arena_close(a);
    }
    gsl_rng_free(g);
}
END_TEST

UNIT("ringing_spectrogram", test_apart, test_noise)
