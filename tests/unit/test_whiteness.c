/* whiteness: correlations by hand, Ljung and Box's probability over seeds, ranks against GSL's. */
#include "analysis/whiteness.h"

#include <gsl/gsl_statistics_double.h>

#include "series.h"

START_TEST(test_by_hand)
{
    const double x[] = {1, 2, 4, 1}, y[] = {0, 1, 2, 4}; /* less their means: -1 0 2 -1 and -1.75 -0.75 0.25 2.25 */
    double r[3], c[5], flat[] = {3, 3, 3, 3};
    whiteness_correlation(x, 4, 3, r);
    ck_assert_double_eq_tol(r[0], 1, 1e-15);
    ck_assert_double_eq_tol(r[1], -2.0 / 6, 1e-15);
    ck_assert_double_eq_tol(r[2], -2.0 / 6, 1e-15);
    whiteness_cross(x, y, 4, 3, c);
    double scale = sqrt(6 * 8.75);
    ck_assert_double_eq_tol(c[2], (1.75 + 0.5 - 2.25) / scale, 1e-15);
    ck_assert_double_eq_tol(c[3], (0.75 + 0 + 2 * 2.25) / scale, 1e-15); /* x_n with y_(n+1) */
    ck_assert_double_eq_tol(c[0], (2 * -1.75 + 0.75) / scale, 1e-15);    /* x_n with y_(n-2) */
    whiteness_correlation(flat, 4, 3, r);
    ck_assert(r[0] == 1 && r[1] == 0 && r[2] == 0);
}
END_TEST

START_TEST(test_box)
{
    enum { N = 1000, SEEDS = 400, LAGS = 20 };
    static double x[N];
    double r[LAGS + 1], p;
    int low = 0, lower = 0;
    gsl_rng *g = series_rng(4);
    for (int seed = 0; seed < SEEDS; seed++) {
        series_draw(g, 0, 1, 0, 0, x, N);
        whiteness_correlation(x, N, LAGS + 1, r);
        whiteness_box(r, N, LAGS, 0, &p);
        low += p < 0.5;
        lower += p < 0.05;
    }
    ck_assert_msg(abs(low - 200) < 40 && abs(lower - 20) < 16, "%d below 0.5, %d below 0.05, of 400", low,
                  lower); /* 4 and 3.7 deviations */
    series_draw(g, 0, 1, 0, 0.35, x, N);
    whiteness_correlation(x, N, LAGS + 1, r);
    double q = whiteness_box(r, N, LAGS, 0, &p), fewer;
    ck_assert(p < 1e-6);
    ck_assert(whiteness_box(r, N, LAGS, 2, &fewer) == q && fewer < p);
    gsl_rng_free(g);
}
END_TEST

START_TEST(test_ranks)
{
    enum { N = 300 };
    double x[N], y[N], work[2 * N], flat[N] = {0};
    struct arena *a = arena_open();
    gsl_rng *g = series_rng(6);
    for (int i = 0; i < N; i++) {
        x[i] = rint(10 * gsl_rng_uniform(g)); /* many are equal */
        y[i] = x[i] + 5 * gsl_rng_uniform(g);
    }
    ck_assert_double_eq_tol(whiteness_ranks(x, y, N, a), gsl_stats_spearman(x, 1, y, 1, N, work), 1e-12);
    for (int i = 0; i < N; i++)
        y[i] = -exp(x[i]);
    ck_assert_double_eq_tol(whiteness_ranks(x, y, N, a), -1, 1e-12);
    ck_assert(isnan(whiteness_ranks(x, flat, N, a)));
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

UNIT("whiteness", test_by_hand, test_box, test_ranks)
