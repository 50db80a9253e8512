/* ringing: what does not decay, what a fit can do without, few of many, and the file's steps. */
#include "analysis/ringing_hums.h"
#include "analysis/ringing_select.h"

#include "ringing_found.h"

enum { N = 12000, TEN = 10 };

static void ten_make(double *h, double deviation)
{
    struct truth m[TEN];
    gsl_rng *g = generator(4);
    for (int i = 0; i < TEN; i++)
        m[i] = (struct truth){.frequency = 104 * (i + 1) * sqrt(i + 1), .decay = 10 + 9 * i, .gain = 1.0 / (1 + i % 4), .phase = 0};
    series_sum(m, TEN, RATE, N, h);
    series_noise(g, deviation, N, h);
    gsl_rng_free(g);
}

static void search(const struct ringing *r, int most, struct arena *a, struct ringing_modes *m)
{
    struct err e = {0};
    struct ringing_options o = ringing_options;
    o.most = most;
    o.slope_test = 0;
    openblas_set_num_threads(1);
    ck_assert_msg(ringing_esprit(r, &o, a, m, &e), "%s", e.text);
}

/* A response that begins 50 samples late is no sum of modes: components that cancel stand for its silence. What is told of must not leave more than there is. */
START_TEST(test_late)
{
    struct arena *a = arena_open();
    struct ringing_modes found;
    static double h[N + 50];
    memset(h, 0, 50 * sizeof *h);
    ten_make(h + 50, 1e-4);
    const double *const list[] = {h};
    search(&(struct ringing){.places = 1, .n = N + 50, .rate = RATE, .h = list}, 50, a, &found);
    ck_assert_msg(found.explained[0] >= 0 && found.explained[0] <= 1, "%g", found.explained[0]);
    arena_close(a);
}
END_TEST

/* Two that do not decay are each a hundred times what there is: one goes, and the other is fitted anew; what is left of it is next to nothing, and the mode what it was. */
START_TEST(test_cancelling)
{
    struct arena *a = arena_open();
    struct truth m = {.frequency = 1000, .decay = 30, .gain = 1, .phase = M_PI / 2};
    struct ringing_fit f;
    struct ringing_noise noise;
    struct ringing_fit_errors e;
    enum ringing_hums_kind kind[4];
    static double h[N];
    const double *const list[] = {h};
    const struct ringing r = {.places = 1, .n = N, .rate = RATE, .h = list};
    gsl_rng *g = generator(10);
    series_sum(&m, 1, RATE, N, h);
    series_noise(g, 1e-3, N, h);
    openblas_set_num_threads(1);
    ringing_fit_open(&f, &r, 8, a);
    ringing_noise_open(&r, a, &noise);
    ringing_fit_add(&f, 30, 2 * M_PI * 1000);
    ringing_fit_add(&f, 1e-9, 2 * M_PI * 300);
    ringing_fit_add(&f, 2e-9, 2 * M_PI * 301);
    ringing_fit_gains(&f);
    f.gain[2] += 100;
    f.gain[3] -= 100;
    ringing_select_errors(&f, &noise, a, &e);
    ringing_hums_kinds(&f, &noise, &e, kind);
    ck_assert(kind[1] == RINGING_HUMS_NONE && kind[2] == RINGING_HUMS_SURPLUS && kind[3] == RINGING_HUMS_SURPLUS);
    ck_assert_int_ge(ringing_hums_drop(&f, &noise, false), 1);
    ck_assert_int_le(f.m, 3);
    ck_assert_double_eq_tol(cabs(f.gain[1]), 1, 0.002);
    ck_assert_double_eq_tol(f.energy[0] / (N * 1e-6), 1, 0.1);
    for (int i = 2; i < f.m; i++)
        ck_assert_double_le(cabs(f.gain[i]), 1e-3);
    ringing_noise_close(&noise);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* The strongest of ten is the same whether one is asked for or all: 1e-6 of it. */
START_TEST(test_few)
{
    struct arena *a = arena_open();
    struct ringing_modes all, one;
    static double h[N];
    ten_make(h, 1e-5);
    const double *const list[] = {h};
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list}, 50, a, &all);
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list}, 1, a, &one);
    ck_assert_int_eq(all.modes, TEN);
    ck_assert_int_eq(one.modes, 1);
    ck_assert_double_eq_tol(one.mode[0].decay / all.mode[0].decay, 1, 1e-6);
    ck_assert_double_eq_tol(one.mode[0].frequency / all.mode[0].frequency, 1, 1e-6);
    ck_assert_double_eq_tol(one.mode[0].decay, 10, 4.5 * one.mode[0].decay_error);
    arena_close(a);
}
END_TEST

/* 320 Hz of 0.001/s falls by 0.0003 in 12000 samples, which noise of 0.05 hides: a hum where it stood in the noise before, else a mode, of a decay that is its standard error. */
START_TEST(test_before)
{
    struct arena *a = arena_open();
    struct truth m[2] = {{.frequency = 320, .decay = 0.001, .gain = 1, .phase = 0.3}, {.frequency = 1500, .decay = 30, .gain = 2, .phase = 1}};
    struct ringing_modes found;
    static double h[N], noise[N];
    const double *const list[] = {h}, *const before[] = {noise};
    gsl_rng *g = generator(9);
    series_sum(m, 2, RATE, N, h);
    series_noise(g, 0.05, N, h);
    memset(noise, 0, sizeof noise);
    series_noise(g, 0.05, N, noise);
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list, .noise = before, .noise_n = N}, 50, a, &found);
    ck_assert_int_eq(found.n, 2);
    const struct ringing_mode *k = nearest(&found, 320);
    ck_assert_double_eq_tol(k->frequency, 320, 4.5 * k->frequency_error);
    ck_assert_double_gt(k->decay, 0.1 * k->decay_error);
    ck_assert(found.note && strstr(found.note, "320 Hz decays by no more than chance"));
    for (int i = 0; i < N; i++)
        noise[i] += sin(2 * M_PI * 320 * i / RATE);
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list, .noise = before, .noise_n = N}, 50, a, &found);
    ck_assert_int_eq(found.n, 1);
    ck_assert_double_eq_tol(found.mode[0].frequency, 1500, 1);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* Single precision: what it rounds off is no mode. */
START_TEST(test_steps)
{
    struct arena *a = arena_open();
    struct ringing_modes found;
    static double h[N];
    const double *const list[] = {h}, rounding[] = {ldexp(sqrt(1.0 / 12), -22)}; /* of values between 2 and 4 */
    ten_make(h, 0);
    for (int i = 0; i < N; i++)
        h[i] = (float)h[i];
    search(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = list, .rounding = rounding}, 50, a, &found);
    ck_assert_int_eq(found.modes, TEN);
    ck_assert_double_ge(found.mode[0].gain_error[0], 1e-9);
    arena_close(a);
}
END_TEST

UNIT("ringing_hums", test_late, test_cancelling, test_few, test_before, test_steps)
