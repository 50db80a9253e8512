/* ringing: long, short, low, high modes and responses; nothing but rounding's error without noise. */
#include "ringing_found.h"

/* One response with its noise; each mode must come back, and no other. */
static void recover(const struct truth *m, int count, long n, double deviation, double offset)
{
    struct arena *a = arena_open();
    struct ringing_modes found;
    double *h = ARENA_TAKE(a, double, n);
    gsl_rng *g = generator(3);
    series_sum(m, count, RATE, n, h);
    series_noise(g, deviation, n, h);
    for (long i = 0; i < n; i++)
        h[i] += offset;
    find((const double *const[]){h}, 1, n, a, &found);
    ck_assert_int_eq(found.n, count);
    for (int i = 0; i < count; i++) {
        const struct ringing_mode *k = nearest(&found, m[i].frequency);
        ck_assert_double_eq_tol(k->frequency, m[i].frequency, fmax(4.5 * k->frequency_error, 1e-7)); /* 4.5 deviations: 7 in a million */
        ck_assert_double_eq_tol(k->decay, m[i].decay, fmax(4.5 * k->decay_error, 1e-6 * m[i].decay));
        ck_assert_double_eq_tol(k->re[0], m[i].gain * cos(m[i].phase), fmax(0.03 * m[i].gain, 0)); /* worst: the 3000/s */
        ck_assert_double_eq_tol(k->im[0], m[i].gain * sin(m[i].phase), fmax(0.03 * m[i].gain, 0));
    }
    ck_assert(found.explained[0] > (deviation > 0 ? 0.999 : 1 - 1e-12));
    if (deviation > 0)
        ck_assert_double_eq_tol(found.noise[0] / deviation, 1, 0.25); /* 250 samples in the shortest */
    gsl_rng_free(g);
    arena_close(a);
}

START_TEST(test_edges)
{
    recover((struct truth[]){{.frequency = 440, .decay = 10, .gain = 1, .phase = 0.3}}, 1, 20000, 1e-3, 0.5);
    recover((struct truth[]){{.frequency = 20, .decay = 3, .gain = 1, .phase = 0.3}}, 1, LONG, 1e-3, 0);
    recover((struct truth[]){{.frequency = 22040, .decay = 3, .gain = 1, .phase = 0.3}, {.frequency = 21900, .decay = 30, .gain = 1, .phase = 1}}, 2, LONG, 1e-3, 0);
    recover((struct truth[]){{.frequency = 1000, .decay = 0.5, .gain = 1, .phase = 0.3}}, 1, LONG, 1e-3, 0);
    recover((struct truth[]){{.frequency = 1000, .decay = 3000, .gain = 1, .phase = 0.3}, {.frequency = 6000, .decay = 2000, .gain = 1, .phase = 1}}, 2, 5000, 1e-3, 0);
    recover((struct truth[]){{.frequency = 1000, .decay = 100, .gain = 1, .phase = 0.3}, {.frequency = 3000, .decay = 300, .gain = 1, .phase = 1}}, 2, 500, 1e-3, 0);
}
END_TEST

/* What double precision leaves: 1e-7 Hz and 1e-6 of the decay are asked of recover; here 1e-9 and 1e-9. */
START_TEST(test_exact)
{
    static double h[LONG];
    struct arena *a = arena_open();
    struct truth m[SERIES_MODES];
    struct ringing_modes found;
    gsl_rng *g = generator(2);
    series_fifty(g, m);
    series_sum(m, SERIES_MODES, RATE, LONG, h);
    find((const double *const[]){h}, 1, LONG, a, &found);
    ck_assert_int_eq(found.n, SERIES_MODES);
    for (int i = 0; i < SERIES_MODES; i++) {
        const struct ringing_mode *k = nearest(&found, m[i].frequency);
        ck_assert_double_eq_tol(k->frequency, m[i].frequency, 1e-9);
        ck_assert_double_eq_tol(k->decay / m[i].decay, 1, 1e-9);
        ck_assert_double_eq_tol(hypot(k->re[0], k->im[0]) / m[i].gain, 1, 1e-8);
    }
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

UNIT("ringing_edges", test_edges, test_exact)
