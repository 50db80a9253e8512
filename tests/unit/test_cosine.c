/* cosine: shares against quadrature of papers/002 equation 9 itself and against the closed form in extended precision.
 */
#include <gsl/gsl_integration.h>

#include "force/strike.h"
#include "unit.h"

static double printed(double q, void *unused)
{
    (void)unused;
    return fabs(q) <= 0.5 ? 0.5 * (1 + cos(2 * M_PI * q)) : 0;
}

/* The whole area is half of amplitude times duration. Quadrature is good to 1e-14, below. */
START_TEST(shares_of_the_printed_shape)
{
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(100);
    gsl_function f = {printed, NULL};
    for (int i = -50; i <= 50; i++) {
        double area, error;
        gsl_integration_qag(&f, -0.5, i / 100.0, 1e-14, 0, 100, GSL_INTEG_GAUSS61, room, &area, &error);
        ck_assert_double_eq_tol(strike_pulse_cosine(i / 100.0) * 0.5, area, 1e-14);
    }
    gsl_integration_workspace_free(room);
}
END_TEST

START_TEST(shares_to_rounding)
{
    double before = 0;
    for (int i = -60000; i <= 60000; i++) {
        double q = i / 1e5, share = strike_pulse_cosine(q);
        long double pi = acosl(-1), want = q <= -0.5 ? 0 : q >= 0.5 ? 1 : 0.5L + q + sinl(2 * pi * q) / (2 * pi);
        ck_assert_double_le((double)fabsl(share - want), 4e-16);
        ck_assert(share >= before && share <= 1);
        before = share;
    }
    ck_assert_double_eq(strike_pulse_cosine(-0.5), 0);
    ck_assert_double_eq(strike_pulse_cosine(0.5), 1);
    ck_assert_double_eq(strike_pulse_cosine(0), 0.5);
    ck_assert_double_eq(strike_pulse_cosine(-1e300), 0);
    ck_assert_double_eq(strike_pulse_cosine(1e300), 1);
}
END_TEST

/* As one by one; 0 before and 1 after to the bit. */
START_TEST(many_shares_at_once)
{
    double q[PULSE_COSINES], share[PULSE_COSINES];
    for (int n = 1; n <= PULSE_COSINES; n++) {
        for (int i = 0; i < n; i++)
            share[i] = q[i] = -0.8 + 1.6 * (i + 0.37) / n;
        strike_pulse_cosines(n, share);
        for (int i = 0; i < n; i++) {
            ck_assert_double_eq_tol(share[i], strike_pulse_cosine(q[i]), 4e-16);
            ck_assert(fabs(q[i]) < 0.5 || share[i] == (q[i] > 0));
        }
    }
}
END_TEST

UNIT("cosine", shares_of_the_printed_shape, shares_to_rounding, many_shares_at_once)
