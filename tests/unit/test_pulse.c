/* pulse: against the regularised incomplete beta function (GSL's), which inverts the pulse, against the equation of
   motion integrated step by step in long double, and against closed forms. From x' = v sqrt(1 - u), u = (x / x_m)^2.5:
   q = I_u(2/5, 1/2) / 2, p = (1 - sqrt(1 - u)) / 2 on the way in. */
#include <gsl/gsl_sf_gamma.h>

#include "force/strike.h"
#include "scene/scene.h"
#include "unit.h"

/* 2e-16 of the constants themselves, GSL's beta function 3e-15. */
START_TEST(contact_times)
{
    struct pulse_shape hertz = strike_pulse_make(PULSE_HERTZ), sine = strike_pulse_make(PULSE_HALF_SINE);
    ck_assert_double_eq_tol(hertz.scale, 0.8 * gsl_sf_beta(0.4, 0.5), 1e-14);
    for (double m = 1e-4; m < 20; m *= 7)
        for (double k = 1e3; k < 1e12; k *= 31)
            for (double v = 1e-3; v < 30; v *= 5) {
                double h = 2.9432751843247 * pow(5 * m / (4 * k), 0.4) * pow(v, -0.2), s = M_PI * sqrt(m / k);
                ck_assert_double_eq_tol(strike_pulse_lasts(&hertz, m, k, v), h, 2e-14 * h);
                ck_assert_double_eq_tol(strike_pulse_lasts(&sine, m, k, v), s, 1e-15 * s);
            }
}
END_TEST

/* GSL states 1e-14 or so for beta_inc; p rises by up to 1.84 per q. The least u are of the pulse's first instants:
 * relative there. */
START_TEST(hertz_is_incomplete_beta)
{
    struct pulse_shape hertz = strike_pulse_make(PULSE_HERTZ);
    for (int i = 1; i < 4000; i++) {
        double u = i < 2000 ? i / 2000.0 : exp(-30 * (i - 1999) / 2000.0);
        double q = 0.5 * gsl_sf_beta_inc(0.4, 0.5, u), p = 0.5 * u / (1 + sqrt(1 - u));
        ck_assert_double_eq_tol(strike_pulse_share(&hertz, q), p, 3e-14 * p);
        ck_assert_double_eq_tol(strike_pulse_share(&hertz, 1 - q), 1 - p, 3e-14);
    }
}
END_TEST

/* m x'' = -k x^1.5 by Runge and Kutta's fourth order in long double, 200000 steps: their error is that of x^1.5 at x =
 * 0, h^2.5 of what is there. */
START_TEST(hertz_is_its_equation)
{
    enum { STEPS = 200000 };
    double m = 0.013, k = 3e7, v0 = 0.7;
    struct pulse_shape hertz = strike_pulse_make(PULSE_HERTZ);
    long double h = (long double)strike_pulse_lasts(&hertz, m, k, v0) / STEPS, x = 0, v = v0, most = 0;
    for (int i = 1; i < STEPS; i++) {
        long double dx[4], dv[4], a[4] = {0, 0.5L, 0.5L, 1};
        for (int s = 0; s < 4; s++) {
            long double xs = s ? x + a[s] * h * dx[s - 1] : x;
            dx[s] = s ? v + a[s] * h * dv[s - 1] : v;
            dv[s] = -k / m * (xs > 0 ? xs * sqrtl(xs) : 0);
        }
        x += h / 6 * (dx[0] + 2 * dx[1] + 2 * dx[2] + dx[3]);
        v += h / 6 * (dv[0] + 2 * dv[1] + 2 * dv[2] + dv[3]);
        most = fmaxl(most, x);
        if (i % 997 == 0)
            ck_assert_double_eq_tol(strike_pulse_share(&hertz, (double)i / STEPS), (double)(0.5L - v / (2 * v0)), 2e-13);
    }
    ck_assert_double_eq_tol((double)v, -v0, 1e-9); /* one step before the end */
    ck_assert_double_eq_tol((double)most, pow(5 * m * v0 * v0 / (4 * k), 0.4), 1e-9 * (double)most);
}
END_TEST

START_TEST(half_sine_is_closed_form)
{
    struct pulse_shape sine = strike_pulse_make(PULSE_HALF_SINE);
    for (int i = -100; i <= 1100; i++) {
        double q = i / 1000.0, inside = fmin(fmax(q, 0), 1);
        ck_assert_double_eq_tol(strike_pulse_share(&sine, q), (double)(0.5L - 0.5L * cosl(3.14159265358979323846L * inside)),
                                3e-16);
    }
}
END_TEST

START_TEST(shares_rise_from_0_to_1)
{
    for (int kind = PULSE_HALF_SINE; kind <= PULSE_HERTZ; kind++) {
        struct pulse_shape p = strike_pulse_make(kind);
        double last = 0;
        ck_assert_double_eq(strike_pulse_share(&p, 0), 0);
        ck_assert_double_eq(strike_pulse_share(&p, -3), 0);
        ck_assert_double_eq(strike_pulse_share(&p, 1), 1);
        ck_assert_double_eq(strike_pulse_share(&p, HUGE_VAL), 1);
        ck_assert_double_eq_tol(strike_pulse_share(&p, 0.5), 0.5, 2e-16);
        for (int i = 1; i <= 100000; i++) {
            double q = i / 100000.0, now = strike_pulse_share(&p, q);
            ck_assert(now > last);
            ck_assert_double_eq_tol(now + strike_pulse_share(&p, 1 - q), 1, 6e-16); /* 1 - q is rounded */
            last = now;
        }
    }
}
END_TEST

UNIT("pulse", contact_times, hertz_is_incomplete_beta, hertz_is_its_equation, half_sine_is_closed_form,
     shares_rise_from_0_to_1)
