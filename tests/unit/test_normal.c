/* normal: against erfc in extended precision (glibc's erfcl, 64 bits of mantissa) and GSL. */
#include <gsl/gsl_cdf.h>

#include "num/special.h"
#include "unit.h"

static long double cdf(double x) { return 0.5L * erfcl(-(long double)x / sqrtl(2)); }

/* Relative, both tails, across the three ranges' borders. */
START_TEST(distribution_function)
{
    double worst = 0;
    for (int i = -37000; i <= 9000; i++) {
        double x = i / 1000.0 + 1e-7, error = (double)fabsl(special_normal_cdf(x) / cdf(x) - 1);
        worst = fmax(worst, error);
        if (x > -5)
            ck_assert_double_eq_tol(special_normal_cdf(x), gsl_cdf_ugaussian_P(x), 2e-15 * gsl_cdf_ugaussian_P(x));
        ck_assert_double_eq_tol(special_normal_density(x),
                                (double)(expl(-0.5L * (long double)x * x) / sqrtl(2 * acosl(-1))),
                                1e-15 * special_normal_density(x));
        double density;
        ck_assert_double_eq(special_normal_cdf_density(x, &density), special_normal_cdf(x));
        ck_assert_double_eq(density, special_normal_density(x));
    }
    ck_assert_double_le(worst, 4e-15);
    ck_assert_double_eq(special_normal_cdf(-50), 0);
    ck_assert_double_eq(special_normal_cdf(50), 1);
    ck_assert_double_eq(special_normal_cdf(0), 0.5);
}
END_TEST

/* x at which P is w: one Newton's step in extended precision finds the error. Over all the numbers that a uniform
 * process can give. */
static double error_of(double w)
{
    double x = special_normal_quantile(w);
    long double density = expl(-0.5L * (long double)x * x) / sqrtl(2 * acosl(-1)),
                miss = w < 0.5 ? cdf(x) - w : (1 - (long double)w) - cdf(-x);
    return fabs((double)(miss / density)) / fabs(x);
}

START_TEST(inverse)
{
    double worst = 0;
    for (int i = 1; i < 4000; i++) {
        worst = fmax(worst, error_of(i / 4000.0 + 1e-9));
        worst = fmax(worst, error_of(exp2(-i * 0.0132)));
        worst = fmax(worst, error_of(1 - exp2(-floor(i * 0.0132)) / 3));
        worst = fmax(worst, error_of(exp(-i * 0.17)));
    }
    worst = fmax(worst, error_of(1 - 0x1p-53));
    ck_assert_double_le(worst, 2e-15);
    for (int i = 1; i < 1000; i++)
        ck_assert_double_eq_tol(special_normal_quantile(i / 1000.0), gsl_cdf_ugaussian_Pinv(i / 1000.0), 2e-15 * 3.1);
}
END_TEST

START_TEST(symmetry_and_ends)
{
    for (int i = 1; i < 512; i++) {
        ck_assert_double_eq(special_normal_quantile(i / 1024.0), -special_normal_quantile(1 - i / 1024.0));
        ck_assert_double_lt(special_normal_quantile(i / 1024.0), special_normal_quantile((i + 1) / 1024.0));
    }
    ck_assert_double_eq(special_normal_quantile(0.5), 0);
    ck_assert(isinf(special_normal_quantile(0)) && special_normal_quantile(0) < 0 &&
              isinf(special_normal_quantile(1)) && special_normal_quantile(1) > 0);
}
END_TEST

UNIT("normal", distribution_function, inverse, symmetry_and_ends)
