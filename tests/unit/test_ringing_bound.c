/* ringing: no more modes than are asked for, what strikes do not agree on, and fits that have not settled. */
#include "analysis/ringing_settle.h"

#include "ringing_found.h"

enum { N = 8000, DENSE = 60 };

static void search(const struct ringing *r, int most, struct arena *a, struct ringing_modes *m)
{
    struct err e = {0};
    struct ringing_options o = ringing_options;
    o.most = most;
    openblas_set_num_threads(1);
    ck_assert_msg(ringing_esprit(r, &o, a, m, &e), "%s", e.text);
}

/* 60 modes, 12 Hz apart and some 100 Hz wide, are far more than can be told from each other: what is told of must be a fit by itself. The eight modes
   leave 0.0004 of this response; the eight strongest of a fit of many, chosen and not fitted again, 0.1. */
START_TEST(test_dense)
{
    struct arena *a = arena_open();
    struct truth m[DENSE];
    struct ringing_modes found;
    gsl_rng *g = generator(5);
    double h[N], y[N], left = 0, all = 0;
    const double *const list[] = {h};
    for (int i = 0; i < DENSE; i++)
        m[i] = (struct truth){.frequency = 300 + 12 * i, .decay = 200 + 200 * gsl_rng_uniform(g), .gain = gsl_rng_uniform(g), .phase = 6 * gsl_rng_uniform(g)};
    series_sum(m, DENSE, RATE, N, h);
    series_noise(g, 1e-5, N, h);
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list}, 8, a, &found);
    ck_assert_int_ge(found.modes, 1);
    ck_assert_int_le(found.modes, 8);
    ringing_sound(&found, 0, RATE, N, y);
    for (int i = 0; i < N; i++) {
        left += (h[i] - y[i]) * (h[i] - y[i]);
        all += h[i] * h[i];
    }
    ck_assert_msg(left < 0.01 * all, "%g left", left / all);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* Of twelve modes far from each other the five that hold most energy. */
START_TEST(test_strongest)
{
    struct arena *a = arena_open();
    struct truth m[12];
    struct ringing_modes found;
    double h[N];
    const double *const list[] = {h};
    gsl_rng *g = generator(6);
    for (int i = 0; i < 12; i++)
        m[i] = (struct truth){.frequency = 400 + 700 * i, .decay = 30, .gain = i % 2 ? 0.1 : 1 + i, .phase = i};
    series_sum(m, 12, RATE, N, h);
    series_noise(g, 1e-4, N, h);
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list}, 5, a, &found);
    ck_assert_int_eq(found.modes, 5);
    for (int i = 0; i < 5; i++)
        ck_assert_double_eq_tol(found.mode[i].frequency, m[10 - 2 * i].frequency, 1);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* An error that strikes tell of, as large as white noise of deviation 0.02, hides what such noise would hide, and makes the standard errors those of the Cramer-Rao bound for it. */
START_TEST(test_unsure)
{
    struct arena *a = arena_open();
    struct truth m[2] = {{.frequency = 1000, .decay = 40, .gain = 1, .phase = 0.3}, {.frequency = 3000, .decay = 40, .gain = 0.001, .phase = 1}};
    struct ringing_modes found;
    double h[N], *level = ARENA_TAKE(a, double, N / 2 + 1);
    const double *const list[] = {h}, *const unsure[] = {level};
    gsl_rng *g = generator(7);
    series_sum(m, 2, RATE, N, h);
    series_noise(g, 1e-4, N, h);
    for (int i = 0; i <= N / 2; i++)
        level[i] = 0.02 * 0.02;
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list}, 50, a, &found);
    ck_assert_int_eq(found.n, 2);
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list, .unsure = unsure}, 50, a, &found);
    ck_assert_int_eq(found.n, 1);
    series_bound(m, 1, RATE, N, 0.02);
    ck_assert_double_eq_tol(found.mode[0].frequency_error / m[0].bound_frequency, 1, 0.02);
    ck_assert_double_eq_tol(found.mode[0].decay_error / m[0].bound_decay, 1, 0.02);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* A fit that begins 1 Hz beside one of two modes moves, and that one is named; then it stands. */
START_TEST(test_settle)
{
    struct arena *a = arena_open();
    struct truth m[2] = {{.frequency = 1000, .decay = 40, .gain = 1, .phase = 0.3}, {.frequency = 3000, .decay = 40, .gain = 1, .phase = 1}};
    struct ringing_fit f;
    struct ringing_noise noise;
    double h[N];
    const double *const list[] = {h};
    const struct ringing r = {.places = 1, .n = N, .rate = RATE, .h = list};
    gsl_rng *g = generator(8);
    series_sum(m, 2, RATE, N, h);
    series_noise(g, 1e-3, N, h);
    ringing_fit_open(&f, &r, 8, a);
    ringing_noise_open(&r, a, &noise);
    ringing_fit_add(&f, 40, 2 * M_PI * 1000);
    ringing_fit_add(&f, 40, 2 * M_PI * 3000);
    ringing_fit_polish(&f, 20);
    f.omega[2] += 2 * M_PI;
    const char *said = ringing_settle(&f, &noise, (const double[]){0, HUGE_VAL}, a);
    ck_assert_ptr_nonnull(said);
    ck_assert_msg(strstr(said, "1 of its modes") && strstr(said, "(3000 Hz)"), "%s", said);
    ck_assert_ptr_null(ringing_settle(&f, &noise, (const double[]){0, HUGE_VAL}, a));
    ringing_noise_close(&noise);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

UNIT("ringing_bound", test_dense, test_strongest, test_unsure, test_settle)
