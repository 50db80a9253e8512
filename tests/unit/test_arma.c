/* arma: whitening and the estimates against a dense exact likelihood (Cholesky's factor of the covariance matrix),
 * known series, and series that are none. */
#include "analysis/arma.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multimin.h>

#include "series.h"

enum { SMALL = 70 };

/* Covariance of the stationary series for a white process of deviation 1: closed form. */
static double covariance(double a, double b, int k)
{
    if (k == 0) return (1 + b * b - 2 * a * b) / (1 - a * a);
    return pow(-a, k - 1) * (b - a) * (1 - a * b) / (1 - a * a);
}

static gsl_matrix *factor(double a, double b, int n)
{
    gsl_matrix *m = gsl_matrix_alloc(n, n);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            gsl_matrix_set(m, i, j, covariance(a, b, abs(i - j)));
    ck_assert_int_eq(gsl_linalg_cholesky_decomp1(m), 0);
    return m;
}

static void solve(const gsl_matrix *l, const double *x, double *out)
{
    gsl_vector_view v = gsl_vector_view_array(out, l->size1);
    memcpy(out, x, l->size1 * sizeof *x);
    gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, l, &v.vector);
}

START_TEST(test_whitens)
{
    const double sets[][2] = {{-0.97, 0.07}, {-0.97, -0.34}, {-0.93, 0.35}, {0.5, -0.9}, {0, 0}, {-0.3, 0.999}};
    gsl_rng *g = series_rng(1);
    for (size_t k = 0; k < sizeof sets / sizeof sets[0]; k++) {
        double x[SMALL], w[SMALL], slow[SMALL], logarithms = 0;
        series_draw(g, 0, 2, sets[k][0], sets[k][1], x, SMALL);
        gsl_matrix *l = factor(sets[k][0], sets[k][1], SMALL);
        solve(l, x, slow);
        for (int i = 0; i < SMALL; i++)
            logarithms += 2 * log(gsl_matrix_get(l, i, i));
        ck_assert_double_eq_tol(arma_whiten(x, SMALL, sets[k][0], sets[k][1], w), logarithms, 1e-10);
        for (int i = 0; i < SMALL; i++)
            ck_assert_double_eq_tol(w[i], slow[i], 1e-10); /* conditioning: at most 1e4 roundings */
        gsl_matrix_free(l);
    }
    gsl_rng_free(g);
}
END_TEST

struct dense {
    double x[SMALL], mean, deviation;
};

/* -2 ln of the residual likelihood over n - 1, the deviation at its best. */
static double dense_cost(const gsl_vector *at, void *context)
{
    struct dense *d = context;
    double a = tanh(gsl_vector_get(at, 0)), b = tanh(gsl_vector_get(at, 1)), ones[SMALL], wx[SMALL], wo[SMALL], xx = 0,
           xo = 0, oo = 0, logarithms = 0;
    gsl_matrix *l = factor(a, b, SMALL);
    for (int i = 0; i < SMALL; i++)
        ones[i] = 1;
    solve(l, d->x, wx);
    solve(l, ones, wo);
    for (int i = 0; i < SMALL; i++) {
        xx += wx[i] * wx[i];
        xo += wx[i] * wo[i];
        oo += wo[i] * wo[i];
        logarithms += 2 * log(gsl_matrix_get(l, i, i));
    }
    gsl_matrix_free(l);
    d->mean = xo / oo;
    d->deviation = sqrt((xx - xo * xo / oo) / (SMALL - 3));
    return log(xx - xo * xo / oo) + (logarithms + log(oo)) / (SMALL - 1);
}

static double dense_fit(struct dense *d, double *a, double *b)
{
    double best = HUGE_VAL;
    gsl_vector *start = gsl_vector_alloc(2), *step = gsl_vector_alloc(2);
    gsl_multimin_function f = {dense_cost, 2, d};
    gsl_multimin_fminimizer *m = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
    for (int k = 0; k < 9; k++) {
        gsl_vector_set(start, 0, 1.2 * (k / 3 - 1));
        gsl_vector_set(start, 1, 1.2 * (k % 3 - 1));
        gsl_vector_set_all(step, 0.3);
        gsl_multimin_fminimizer_set(m, &f, start, step);
        for (int i = 0; i < 200 && gsl_multimin_fminimizer_size(m) > 1e-7; i++)
            if (gsl_multimin_fminimizer_iterate(m)) break;
        if (gsl_multimin_fminimizer_minimum(m) < best) {
            best = gsl_multimin_fminimizer_minimum(m);
            *a = tanh(gsl_vector_get(gsl_multimin_fminimizer_x(m), 0));
            *b = tanh(gsl_vector_get(gsl_multimin_fminimizer_x(m), 1));
        }
    }
    gsl_vector_set(start, 0, atanh(*a));
    gsl_vector_set(start, 1, atanh(*b));
    dense_cost(start, d);
    gsl_multimin_fminimizer_free(m);
    gsl_vector_free(start);
    gsl_vector_free(step);
    return best;
}

START_TEST(test_likelihood)
{
    const double sets[][2] = {{-0.9, 0.3}, {-0.8, -0.34}, {0.6, -0.45}, {-0.5, -0.95}};
    gsl_rng *g = series_rng(2);
    for (size_t k = 0; k < sizeof sets / sizeof sets[0]; k++) {
        struct dense d;
        struct arma f;
        double a = NAN, b = NAN;
        series_draw(g, 7, 0.5, sets[k][0], sets[k][1], d.x, SMALL);
        dense_fit(&d, &a, &b);
        arma_fit(d.x, SMALL, &f);
        ck_assert_msg(fabs(f.a1 - a) < 1e-4 && fabs(f.b1 - b) < 1e-4, "%g %g, slowly %g %g", f.a1, f.b1, a,
                      b); /* least to 1e-8: a parabola's foot to 1e-4 */
        ck_assert_double_eq_tol(f.mean, d.mean, 1e-4);
        ck_assert_double_eq_tol(f.deviation, d.deviation, 1e-4);
        ck_assert(!f.white);
    }
    gsl_rng_free(g);
}
END_TEST

/* Errors are those that the estimates have; no estimate is far off. */
START_TEST(test_recovers)
{
    enum { N = 1500, SEEDS = 40 };
    const double sets[][2] = {{-0.97, 0.07}, {-0.97, -0.34}, {-0.93, 0.35}, {0.7, -0.2}, {-0.6, -0.98}};
    static double x[N];
    for (size_t k = 0; k < sizeof sets / sizeof sets[0]; k++) {
        double square[4] = {0};
        for (int seed = 1; seed <= SEEDS; seed++) {
            gsl_rng *g = series_rng(1000 * k + seed);
            struct arma f;
            series_draw(g, 3, 0.04, sets[k][0], sets[k][1], x, N);
            arma_fit(x, N, &f);
            double z[4] = {(f.a1 - sets[k][0]) / sqrt(f.covariance[0]), (f.b1 - sets[k][1]) / sqrt(f.covariance[2]),
                           (f.mean - 3) / sqrt(f.mean_variance), (f.deviation / 0.04 - 1) * sqrt(2.0 * N)};
            for (int p = 0; p < 4; p++) {
                ck_assert_msg(fabs(z[p]) < 5, "set %zu, seed %d, parameter %d: %g errors off", k, seed, p, z[p]);
                square[p] += z[p] * z[p] / SEEDS;
            }
            gsl_rng_free(g);
        }
        for (int p = 0; p < 4;
             p++) /* chi-squared of 40 over 40: 0.46 to 1.8 but for 2 in 1000; the mean's has Student's tails */
            ck_assert_msg(square[p] > 0.42 && square[p] < (p == 2 ? 2.2 : 1.9),
                          "set %zu, parameter %d: mean square %g errors", k, p, square[p]);
    }
}
END_TEST

START_TEST(test_white)
{
    enum { N = 800, SEEDS = 100 };
    static double x[N];
    int white = 0;
    gsl_rng *g = series_rng(5);
    for (int seed = 0; seed < SEEDS; seed++) {
        struct arma f;
        series_draw(g, -2, 1, 0, 0, x, N);
        arma_fit(x, N, &f);
        white += f.white && f.a1 == 0 && f.b1 == 0;
        double plain = 0;
        for (int i = 0; i < N; i++)
            plain += x[i] / N;
        ck_assert(!f.white || fabs(f.mean - plain) < 1e-12);
    }
    ck_assert_int_ge(white, 93); /* of the best of a ridge of pairs, a few more than 1 % gain ARMA_GAIN */
    gsl_rng_free(g);
}
END_TEST

static void sane(const double *x, int n)
{
    struct arma f;
    arma_fit(x, n, &f);
    ck_assert(fabs(f.a1) < 1 && fabs(f.b1) < 1 && isfinite(f.mean) && f.deviation >= 0 && isfinite(f.deviation));
    ck_assert(!isnan(f.covariance[0]) && f.covariance[0] >= 0 && !isnan(f.covariance[2]) && isfinite(f.mean_variance));
}

/* Times that keep to a beat, each off by itself: x_n = mean + j_(n+1) - j_n, a zero at -1. */
START_TEST(test_beat)
{
    enum { N = 600, SEEDS = 60 };
    double x[N], square = 0;
    for (int seed = 1; seed <= SEEDS; seed++) {
        gsl_rng *g = series_rng(700 + seed);
        struct arma f;
        double before = gsl_ran_gaussian(g, 0.1);
        for (int i = 0; i < N; i++) {
            double now = gsl_ran_gaussian(g, 0.1);
            x[i] = 5 + now - before;
            before = now;
        }
        arma_fit(x, N, &f);
        double z = f.a1 / sqrt(f.covariance[0]);
        ck_assert_msg(fabs(z) < 4 && f.covariance[0] < 0.01, "seed %d: a1 %g, %g errors off", seed, f.a1, z);
        ck_assert_msg(f.b1 + 1 < 5 * sqrt(f.covariance[2]) && f.covariance[2] < 0.01, "seed %d: b1 %g +- %g", seed,
                      f.b1, sqrt(f.covariance[2]));
        square += z * z / SEEDS;
        gsl_rng_free(g);
    }
    ck_assert_msg(square > 0.5 && square < 1.7, "mean square %g errors",
                  square); /* chi-squared of 60 over 60: 0.53 to 1.66 but for 2 in 1000 */
}
END_TEST

/* More values than those that tell where to start; and nothing happens in those. */
START_TEST(test_many)
{
    enum { N = 60000, STILL = 25000 };
    double *x = calloc(N, sizeof *x);
    gsl_rng *g = series_rng(9);
    struct arma f;
    series_draw(g, 3, 0.04, -0.97, -0.34, x, N);
    arma_fit(x, N, &f);
    double z[2] = {(f.a1 + 0.97) / sqrt(f.covariance[0]), (f.b1 + 0.34) / sqrt(f.covariance[2])};
    ck_assert_msg(fabs(z[0]) < 4 && fabs(z[1]) < 4 && sqrt(f.covariance[2]) < 0.006, "%g %g: %g %g errors off", f.a1,
                  f.b1, z[0], z[1]);
    for (int i = 0; i < STILL; i++)
        x[i] = 3;
    sane(x, N);
    gsl_rng_free(g);
    free(x);
}
END_TEST

START_TEST(test_odd_series)
{
    enum { N = 200 };
    double x[N], y[N];
    struct arma f, g;
    gsl_rng *r = series_rng(3);
    for (int i = 0; i < N; i++)
        x[i] = gsl_rng_uniform(r) < 0.3 ? -1 : 4; /* two values */
    sane(x, N);
    for (int n = 8; n <= 50; n += 6) { /* few */
        series_draw(r, 1, 0.1, -0.97, 0.07, x, n);
        sane(x, n);
    }
    for (int i = 0; i < N; i++)
        x[i] = (i & 1) ? -1 : 1; /* on the edge: a1 = 1 */
    sane(x, N);
    arma_fit(x, N, &f);
    ck_assert(f.a1 > 0.99);
    for (int i = 0; i < N; i++)
        x[i] = i; /* a1 = -1 */
    sane(x, N);
    for (int i = 0; i < N; i++)
        x[i] = i == 100; /* one of all */
    sane(x, N);
    for (int i = 0; i < N; i++)
        x[i] = gsl_ran_gaussian(r, 1);
    for (int i = N - 1; i > 0; i--)
        x[i] -= x[i - 1]; /* b1 = -1 */
    sane(x, N);
    series_draw(r, 0, 1, -0.9, -0.3, x, N); /* the unit and a large mean change nothing else */
    for (int i = 0; i < N; i++)
        y[i] = 1e-4 * (x[i] + 1e5);
    arma_fit(x, N, &f);
    arma_fit(y, N, &g);
    ck_assert_double_eq_tol(f.a1, g.a1, 1e-6);
    ck_assert_double_eq_tol(f.b1, g.b1, 1e-6);
    ck_assert_double_eq_tol(1e-4 * f.deviation, g.deviation, 1e-9);
    gsl_rng_free(r);
}
END_TEST

UNIT("arma", test_whitens, test_likelihood, test_recovers, test_white, test_beat, test_many, test_odd_series)
