/* ringing: modes of known responses come back, of several places, of two slopes; no hum; what is refused. */
#include "ringing_found.h"

/* Two slopes of one frequency are one mode of two components; without the test of slopes, one. */
START_TEST(test_slopes)
{
    enum { N = 30000 };
    const struct truth m[] = {{.frequency = 1000, .decay = 40, .gain = 1, .phase = 0.3}, {.frequency = 1000, .decay = 5, .gain = 0.1, .phase = 1},
                              {.frequency = 3000, .decay = 30, .gain = 0.1, .phase = 0.3}};
    static double h[N];
    struct arena *a = arena_open();
    struct ringing_modes found;
    struct ringing_options o = ringing_options;
    struct err e = {0};
    gsl_rng *g = generator(1);
    series_sum(m, 3, RATE, N, h);
    series_noise(g, 1e-3, N, h);
    find((const double *const[]){h}, 1, N, a, &found);
    ck_assert_int_eq(found.n, 3);
    ck_assert_int_eq(found.modes, 2);
    for (int i = 0; i < 2; i++) {
        ck_assert_int_eq(found.mode[i].mode, 1);
        ck_assert_int_eq(found.mode[i].slope, i + 1);
        ck_assert(found.mode[i].frequency == found.mode[0].frequency);
        const struct truth *t = fabs(found.mode[i].decay - 40) < 10 ? &m[0] : &m[1];
        ck_assert_double_eq_tol(found.mode[i].decay, t->decay, 4.5 * found.mode[i].decay_error);
        ck_assert_double_eq_tol(hypot(found.mode[i].re[0], found.mode[i].im[0]), t->gain, 4.5 * found.mode[i].gain_error[0]);
    }
    ck_assert(found.mode[0].decay != found.mode[1].decay);
    o.slope_test = 0;
    ck_assert(ringing_esprit(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = (const double *const[]){h}}, &o, a, &found, &e));
    ck_assert_int_eq(found.n, 2);
    ck_assert_int_eq(found.modes, 2);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* Three places share their poles; one mode is missing at the second place, another exists only at the third. */
START_TEST(test_places)
{
    enum { N = 20000, PLACES = 3, COUNT = 3 };
    const double gain[PLACES][COUNT] = {{1, 0.5, 0}, {0, 0.5, 0}, {0.7, 0.2, 0.3}};
    const double frequency[COUNT] = {500, 507, 4000};
    static double h[PLACES][N];
    struct arena *a = arena_open();
    struct ringing_modes all, one;
    gsl_rng *g = generator(8);
    for (int p = 0; p < PLACES; p++) {
        const struct truth m[COUNT] = {{.frequency = frequency[0], .decay = 20, .gain = gain[p][0], .phase = 1 + p},
                                       {.frequency = frequency[1], .decay = 30, .gain = gain[p][1], .phase = 2 - p},
                                       {.frequency = frequency[2], .decay = 50, .gain = gain[p][2], .phase = 3}};
        series_sum(m, COUNT, RATE, N, h[p]);
        series_noise(g, 0.01, N, h[p]);
    }
    find((const double *const[]){h[0], h[1], h[2]}, PLACES, N, a, &all);
    find((const double *const[]){h[2]}, 1, N, a, &one);
    ck_assert_int_eq(all.n, COUNT);
    ck_assert_int_eq(one.n, COUNT);
    for (int i = 0; i < COUNT; i++) {
        const struct ringing_mode *k = nearest(&all, frequency[i]), *single = nearest(&one, k->frequency);
        for (int p = 0; p < PLACES; p++)
            ck_assert_double_eq_tol(hypot(k->re[p], k->im[p]), gain[p][i], 4.5 * k->gain_error[p]);
        ck_assert(k->frequency_error < (i < 2 ? 0.9 : 1.1) * single->frequency_error);
        ck_assert_double_eq_tol(k->frequency, frequency[i], 4.5 * k->frequency_error);
    }
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

/* A hum is there before the strike too, and does not decay: no mode. */
START_TEST(test_hum)
{
    enum { N = 20000, BEFORE = 8000 };
    const struct truth m[] = {{.frequency = 50, .decay = 0, .gain = 0.3, .phase = 0.3}, {.frequency = 3000, .decay = 30, .gain = 1, .phase = 0.3}};
    static double h[N], noise[BEFORE];
    struct arena *a = arena_open();
    struct ringing_modes found;
    struct err e = {0};
    gsl_rng *g = generator(1);
    series_sum(m, 2, RATE, N, h);
    series_noise(g, 1e-3, N, h);
    series_sum(m, 1, RATE, BEFORE, noise);
    series_noise(g, 1e-3, BEFORE, noise);
    find((const double *const[]){h}, 1, N, a, &found);
    ck_assert_int_eq(found.n, 1);
    ck_assert_msg(found.note && strstr(found.note, "50 Hz does not decay") && strstr(found.note, "rms 0.212,"), "%s", found.note); /* 0.3/sqrt 2 */
    struct ringing r = {.places = 1, .n = N, .rate = RATE, .h = (const double *const[]){h}, .noise = (const double *const[]){noise}, .noise_n = BEFORE};
    ck_assert(ringing_esprit(&r, &ringing_options, a, &found, &e));
    ck_assert_int_eq(found.n, 1);
    ck_assert_double_eq_tol(found.noise[0], sqrt(0.3 * 0.3 / 2 + 1e-6), 0.01);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

START_TEST(test_refusals)
{
    struct arena *a = arena_open();
    struct ringing_modes m;
    double h[2000] = {0};
    struct err e = {0};
    struct ringing r = {.places = 1, .n = 20, .rate = RATE, .h = (const double *const[]){h}};
    ck_assert(!ringing_esprit(&r, &ringing_options, a, &m, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    r.n = 2000;
    e = (struct err){0};
    ck_assert(ringing_esprit(&r, &ringing_options, a, &m, &e));
    ck_assert_int_eq(m.n, 0);
    ck_assert(m.explained[0] == 0 && strstr(m.note, "silent"));
    ck_assert(ringing_spectrogram(&r, &ringing_options, a, &m, &e));
    ck_assert_int_eq(m.n, 0);
    h[7] = NAN;
    ck_assert(!ringing_esprit(&r, &ringing_options, a, &m, &e));
    ck_assert_int_eq(e.kind, ERR_NUMBERS);
    arena_close(a);
}
END_TEST

START_TEST(test_sound)
{
    enum { N = 3000 };
    double gain[] = {0.8, -0.3}, quadrature[] = {0.1, 0.4}, y[N];
    struct ringing_mode mode[] = {{.frequency = 440.3, .decay = 3, .re = gain, .im = quadrature}, {.frequency = 15000, .decay = 50, .re = quadrature, .im = gain}};
    ringing_sound(&(struct ringing_modes){.n = 2, .modes = 2, .mode = mode}, 1, RATE, N, y);
    for (int i = 0; i < N; i++) {
        double t = i / RATE, sum = 0;
        for (int k = 0; k < 2; k++)
            sum += exp(-mode[k].decay * t) * (mode[k].re[1] * sin(2 * M_PI * mode[k].frequency * t) + mode[k].im[1] * cos(2 * M_PI * mode[k].frequency * t));
        ck_assert_double_eq_tol(y[i], sum, 1e-12); /* phases of 6000 rad: 1e-12 */
    }
}
END_TEST

UNIT("ringing", test_slopes, test_places, test_hum, test_refusals, test_sound)
