/* distribution_fit: samples of GSL's generators, closed forms, and a plain distance. */
#include "analysis/distribution_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multimin.h>

#include "series.h"

enum { N = 4000 };
static double x[N];

static struct distribution_fits fit(int n)
{
    struct arena *a = arena_open();
    struct distribution_fits f;
    distribution_fit(x, n, a, &f);
    arena_close(a);
    return f;
}

START_TEST(test_gaussian)
{
    gsl_rng *g = series_rng(1);
    for (int i = 0; i < N; i++)
        x[i] = -3 + gsl_ran_gaussian(g, 0.2);
    struct distribution_fits f = fit(N);
    ck_assert_msg(f.gaussian_r2 > 0.98 && f.gaussian_r2 <= 1, "%g",
                  f.gaussian_r2);                    /* 4000 in 25 bins: 6 % noise a bin, 0.4 % of the squares */
    ck_assert(f.gaussian_distance < 1.04 / sqrt(N)); /* Lilliefors, 1 % */
    ck_assert(fabs(f.skewness) < 4 * sqrt(6.0 / N) && fabs(f.kurtosis - 3) < 4 * sqrt(24.0 / N));
    ck_assert(isnan(f.gamma_shape) && isnan(f.exponential_mean)); /* all below 0 */
    for (int i = 0; i < N; i++)
        x[i] = exp(3 * x[i]);
    ck_assert(fit(N).gaussian_distance > 0.05);
    gsl_rng_free(g);
}
END_TEST

/* A Gaussian's peak on a floor far and wide: what a histogram's least squares fit, which the plain moments do not. */
START_TEST(test_least_squares)
{
    gsl_rng *g = series_rng(2);
    for (int i = 0; i < N; i++)
        x[i] = (i % 20 == 0) ? 16 * (gsl_rng_uniform(g) - 0.5) : gsl_ran_gaussian(g, 1);
    struct distribution_fits f = fit(N);
    ck_assert_msg(f.gaussian_r2 > 0.97, "%g", f.gaussian_r2);
    for (int i = 0; i < N; i++)
        x[i] = gsl_rng_uniform(g);
    f = fit(N);
    ck_assert_msg(f.gaussian_r2 < 0.5, "%g", f.gaussian_r2); /* an even density has no slope to explain */
    gsl_rng_free(g);
}
END_TEST

/* The fit of figure 9 done over again: the same bins, a simplex instead of Gauss and Newton, the density in the middle
 * of 40 parts of each bin. */
static struct {
    int bins;
    double from, width, density[64];
} h;

static double histogram_left(const gsl_vector *at, void *context)
{
    double left = 0, mean = gsl_vector_get(at, 0), deviation = gsl_vector_get(at, 1);
    (void)context;
    for (int i = 0; i < h.bins; i++) {
        double sum = 0;
        for (int k = 0; k < 40; k++)
            sum += gsl_ran_gaussian_pdf(h.from + (i + (k + 0.5) / 40) * h.width - mean, deviation) / 40;
        left += (h.density[i] - sum) * (h.density[i] - sum);
    }
    return left;
}

START_TEST(test_histogram)
{
    enum { FEW = 500 };
    gsl_rng *g = series_rng(8);
    double low = HUGE_VAL, high = -HUGE_VAL, mean = 0, square = 0, middle = 0, all = 0;
    for (int i = 0; i < FEW; i++) {
        x[i] = gsl_ran_gamma(g, 4, 0.5);
        low = fmin(low, x[i]), high = fmax(high, x[i]), mean += x[i] / FEW;
    }
    for (int i = 0; i < FEW; i++)
        square += (x[i] - mean) * (x[i] - mean) / FEW;
    h.bins = (int)ceil((high - low) / (3.49 * sqrt(square) / cbrt(FEW))), h.from = low, h.width = (high - low) / h.bins;
    for (int i = 0; i < FEW; i++)
        h.density[(int)fmin((x[i] - low) / h.width, h.bins - 1)] += 1 / (FEW * h.width);
    for (int i = 0; i < h.bins; i++)
        middle += h.density[i] / h.bins;
    for (int i = 0; i < h.bins; i++)
        all += (h.density[i] - middle) * (h.density[i] - middle);
    gsl_vector *at = gsl_vector_alloc(2), *step = gsl_vector_alloc(2);
    gsl_multimin_function f = {histogram_left, 2, NULL};
    gsl_multimin_fminimizer *m = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
    gsl_vector_set(at, 0, mean), gsl_vector_set(at, 1, sqrt(square)), gsl_vector_set_all(step, 0.1);
    gsl_multimin_fminimizer_set(m, &f, at, step);
    for (int i = 0; i < 500 && gsl_multimin_fminimizer_size(m) > 1e-9; i++)
        if (gsl_multimin_fminimizer_iterate(m)) break;
    ck_assert_double_eq_tol(fit(FEW).gaussian_r2, 1 - gsl_multimin_fminimizer_minimum(m) / all,
                            1e-4); /* the middles of 40 parts: 1e-5 */
    gsl_multimin_fminimizer_free(m);
    gsl_vector_free(at);
    gsl_vector_free(step);
    gsl_rng_free(g);
}
END_TEST

START_TEST(test_exponential)
{
    gsl_rng *g = series_rng(3);
    double sum = 0;
    for (int i = 0; i < N; i++)
        sum += (x[i] = gsl_ran_exponential(g, 2.5)) / N;
    struct distribution_fits f = fit(N);
    ck_assert_double_eq_tol(f.exponential_mean, sum, 1e-12);
    ck_assert(f.exponential_distance < 1.31 / sqrt(N)); /* mean fitted, 1 % */
    ck_assert(fabs(f.gamma_shape - 1) < 4 * 1.25 / sqrt(N) && f.gamma_distance < 1.3 / sqrt(N));
    ck_assert_msg(f.gaussian_distance > 0.1 && fabs(f.skewness - 2) < 0.5, "%g %g", f.gaussian_distance, f.skewness);
    for (int i = 0; i < N; i += 2)
        x[i] = -1;
    f = fit(N);
    ck_assert_msg(isnan(f.gamma_shape) && fabs(f.exponential_mean - 2.5) < 0.25, "%g",
                  f.exponential_mean); /* of those above 0 */
    ck_assert(f.exponential_distance < 1.31 / sqrt(N / 2));
    gsl_rng_free(g);
}
END_TEST

static double gamma_likelihood(int n, double shape, double scale)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += (shape - 1) * log(x[i]) - x[i] / scale - shape * log(scale) - lgamma(shape);
    return sum;
}

START_TEST(test_gamma)
{
    const double shapes[] = {0.05, 0.7, 3, 40, 2000};
    gsl_rng *g = series_rng(4);
    for (size_t k = 0; k < sizeof shapes / sizeof shapes[0]; k++) {
        for (int i = 0; i < N; i++)
            x[i] = fmax(gsl_ran_gamma(g, shapes[k], 3e-3), 1e-300);
        struct distribution_fits f = fit(N);
        ck_assert_msg(fabs(f.gamma_shape / shapes[k] - 1) < 4 * sqrt(2.0 / N), "%g for %g", f.gamma_shape, shapes[k]);
        ck_assert(f.gamma_distance < 1.6 / sqrt(N));
        double best = gamma_likelihood(N, f.gamma_shape, f.gamma_scale);
        for (int d = 0; d < 4; d++) {
            double a = f.gamma_shape * (1 + 0.01 * ((d & 1) ? 1 : -1)),
                   b = f.gamma_scale * (1 + 0.01 * ((d & 2) ? 1 : -1));
            ck_assert(gamma_likelihood(N, a, b) < best);
            ck_assert(gamma_likelihood(N, a, f.gamma_shape * f.gamma_scale / a) < best);
        }
    }
    gsl_rng_free(g);
}
END_TEST

START_TEST(test_distance)
{
    enum { FEW = 12 };
    gsl_rng *g = series_rng(5);
    double most = 0, mean = 0, square = 0;
    for (int i = 0; i < FEW; i++)
        x[i] = gsl_ran_gamma(g, 2, 1);
    for (int i = 0; i < FEW; i++)
        mean += x[i] / FEW;
    for (int i = 0; i < FEW; i++)
        square += (x[i] - mean) * (x[i] - mean) / FEW;
    for (int i = 0; i < FEW; i++) { /* without sorting */
        int below = 0, up_to = 0;
        double p = gsl_cdf_gaussian_P(x[i] - mean, sqrt(square));
        for (int k = 0; k < FEW; k++) {
            below += x[k] < x[i];
            up_to += x[k] <= x[i];
        }
        most = fmax(most, fmax(fabs(p - below / (double)FEW), fabs(up_to / (double)FEW - p)));
    }
    ck_assert_double_eq_tol(fit(FEW).gaussian_distance, most, 1e-12);
    gsl_rng_free(g);
}
END_TEST

START_TEST(test_odd_values)
{
    for (int i = 0; i < 100; i++)
        x[i] = 5;
    struct distribution_fits f = fit(100);
    ck_assert(isnan(f.gaussian_r2) && isnan(f.gaussian_distance) && isnan(f.gamma_shape) && isnan(f.kurtosis));
    for (int spread = 1; spread <= 15; spread++) { /* shapes of 10 to 1e30 */
        gsl_rng *g = series_rng(spread);
        for (int i = 0; i < 1000; i++)
            x[i] = 1 + pow(10, -spread) * (gsl_rng_uniform(g) - 0.5);
        f = fit(1000);
        ck_assert(isfinite(f.gaussian_r2) && isfinite(f.gaussian_distance));
        ck_assert_msg(isnan(f.gamma_shape) ? spread >= 6 : fabs(f.gamma_distance - f.gaussian_distance) < 0.02,
                      "%d: %g, %g", spread, f.gamma_distance, f.gaussian_distance);
        gsl_rng_free(g);
    }
    for (int i = 0; i < 1000; i++)
        x[i] = (i == 0) ? 1e12 : 1 + i; /* far out, and near 0 */
    f = fit(1000);
    ck_assert(isfinite(f.gaussian_r2) && isfinite(f.gamma_distance) && isfinite(f.exponential_distance));
    for (int i = 0; i < 1000; i++)
        x[i] = (i & 1) ? 1e-300 : 1e300;
    f = fit(1000);
    ck_assert(isfinite(f.gamma_distance) && f.gamma_shape > 0);
    for (int i = 0; i < 1000; i++)
        x[i] = i & 1;
    ck_assert(isfinite(fit(1000).gaussian_r2));
}
END_TEST

UNIT("distribution_fit", test_gaussian, test_least_squares, test_histogram, test_exponential, test_gamma, test_distance,
     test_odd_values)
