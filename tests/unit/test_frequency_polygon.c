/* frequency_polygon: its integral, mean and deviation by quadrature, its closeness to the density of a large sample,
 * and when it is needed. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include "analysis/distribution_fit.h"
#include "unit.h"

static void moments(const struct frequency_polygon *t, double m[3])
{
    m[0] = m[1] = m[2] = 0;
    for (int i = 0; i + 1 < t->n; i++)
        for (int k = 0; k < 2000; k++) {
            double q = (k + 0.5) / 2000, h = t->value[i + 1] - t->value[i], x = t->value[i] + q * h,
                   d = t->density[i] + q * (t->density[i + 1] - t->density[i]);
            m[0] += d * h / 2000;
            m[1] += d * x * h / 2000;
            m[2] += d * x * x * h / 2000;
        }
}

static double at(const struct frequency_polygon *t, double x)
{
    for (int i = 0; i + 1 < t->n; i++)
        if (x >= t->value[i] && x <= t->value[i + 1])
            return t->density[i] +
                   (x - t->value[i]) / (t->value[i + 1] - t->value[i]) * (t->density[i + 1] - t->density[i]);
    return 0;
}

START_TEST(moments_and_density)
{
    enum { N = 100000 };
    static double x[N];
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    struct arena *a = arena_open();
    for (int kind = 0; kind < 2; kind++) {
        struct frequency_polygon t;
        double m[3], worst = 0;
        for (int i = 0; i < N; i++)
            x[i] = 2e-3 * (kind ? gsl_ran_gamma(r, 3, 1) / sqrt(3) : gsl_ran_gaussian(r, 1)) + 5;
        distribution_fit_polygon(x, N, 2e-3, a, &t);
        moments(&t, m);
        ck_assert_double_eq_tol(m[0], 1, 1e-9);
        ck_assert_double_eq_tol(m[1] / 2e-3, 0, 1e-9);
        ck_assert_double_eq_tol(sqrt(m[2]) / 2e-3, 1, 1e-6); /* the quadrature's */
        ck_assert(t.density[0] == 0 && t.density[t.n - 1] == 0);
        for (double z = -3; z < 4; z += 0.01) {
            double density =
                kind ? gsl_ran_gamma_pdf((z + sqrt(3)) * sqrt(3), 3, 1) * sqrt(3) : gsl_ran_gaussian_pdf(z, 1);
            worst = fmax(worst, fabs(at(&t, 2e-3 * z) * 2e-3 - density));
        }
        ck_assert_double_le(
            worst, 0.04); /* a bin holds 1 % of the sample and more: 3 % of 0.45, and the polygon cuts corners */
    }
    arena_close(a);
    gsl_rng_free(r);
}
END_TEST

START_TEST(few_and_coarse)
{
    struct arena *a = arena_open();
    struct frequency_polygon t;
    double two[2] = {1, 3}, mass[100] = {0}, m[3];
    distribution_fit_polygon(two, 2, 0.5, a, &t);
    moments(&t, m);
    ck_assert_double_eq_tol(sqrt(m[2]), 0.5, 1e-3);
    mass[99] = 1; /* quartiles alike: no width from them */
    distribution_fit_polygon(mass, 100, 0.1, a, &t);
    moments(&t, m);
    ck_assert_double_eq_tol(m[0], 1, 1e-6);
    ck_assert_double_eq_tol(m[1], 0, 1e-6);
    arena_close(a);
}
END_TEST

START_TEST(needed)
{
    ck_assert(distribution_fit_polygon_needed(0.11, 100) &&
              !distribution_fit_polygon_needed(0.1, 100)); /* Lilliefors: 0.1031 */
    ck_assert(!distribution_fit_polygon_needed(0.019, 1000000) && distribution_fit_polygon_needed(0.021, 1000000));
}
END_TEST

UNIT("frequency_polygon", moments_and_density, few_and_coarse, needed)
