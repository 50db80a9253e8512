/* ringing: standard errors are what they are said to be. */
#include "ringing_found.h"

/* 50 seeds of three modes: 150 intervals of each kind; 95 +- 6.3 % is 3.5 deviations of that count. */
START_TEST(test_intervals)
{
    enum { N = 1000, COUNT = 3, SEEDS = 50 };
    const struct truth m[COUNT] = {{.frequency = 1400, .decay = 80, .gain = 1, .phase = 1},
                                   {.frequency = 1450, .decay = 240, .gain = 0.5, .phase = 2},
                                   {.frequency = 6000, .decay = 400, .gain = 0.4, .phase = 3}};
    double inside[3] = {0}, squares[3] = {0};
    for (unsigned long seed = 1; seed <= SEEDS; seed++) {
        struct arena *a = arena_open();
        struct ringing_modes found;
        double h[N];
        gsl_rng *g = generator(seed);
        series_sum(m, COUNT, RATE, N, h);
        series_noise(g, 0.01, N, h);
        find((const double *const[]){h}, 1, N, a, &found);
        ck_assert_int_eq(found.n, COUNT);
        for (int i = 0; i < COUNT; i++) {
            const struct ringing_mode *k = nearest(&found, m[i].frequency);
            const double z[] = {(k->frequency - m[i].frequency) / k->frequency_error, (k->decay - m[i].decay) / k->decay_error,
                                (hypot(k->re[0], k->im[0]) - m[i].gain) / k->gain_error[0]};
            for (int x = 0; x < 3; x++) {
                inside[x] += fabs(z[x]) < 1.96;
                squares[x] += z[x] * z[x];
            }
        }
        gsl_rng_free(g);
        arena_close(a);
    }
    for (int i = 0; i < 3; i++) {
        ck_assert_double_eq_tol(inside[i] / (COUNT * SEEDS), 0.95, 0.063);
        ck_assert_double_eq_tol(squares[i] / (COUNT * SEEDS), 1, 0.44); /* errors that are too wide; 3.8 deviations of chi squared of 150 */
    }
}
END_TEST

UNIT("ringing_intervals", test_intervals)
