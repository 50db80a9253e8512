/* A mass on a damped spring that is driven by an acceleration, against closed forms: waves, steps, constants, and
   poles of every kind. */
#include <complex.h>
#include <math.h>

#include "force/roll.h"
#include "unit.h"

/* Driven by A sin(w t) for so many s, and from 0.9 of it on against the closed form of what stays: greatest error
   over its amplitude. */
static double wave_error(double w0, double zeta, double w, double dt, double lasts)
{
    double c = 2 * zeta * w0, a = 3.0, worst = 0;
    double complex y = a / (w0 * w0 - w * w + I * w * c);
    struct roll_follow f = roll_follow_make(w0, c, dt);
    long n = lrint(lasts / dt);
    for (long i = 0; i < n; i++) {
        roll_follow_step(&f, a * sin(w * dt * (double)i), a * sin(w * dt * (double)(i + 1)));
        double complex turn = cexp(I * w * dt * (double)(i + 1));
        if ((double)i > 0.9 * (double)n)
            worst =
                fmax(worst, fmax(fabs(f.y - cimag(y * turn)), fabs(f.rate - cimag(I * w * y * turn)) / w) / cabs(y));
    }
    return worst;
}

/* Size and phase, from a tenth of the resonance to ten times it; what is left at these steps is the straight line
   between instants, (w dt)^2 / 12. */
START_TEST(waves_have_their_size_and_phase)
{
    for (double w = 100; w < 11000; w *= 1.7782794100389228) {
        double off = wave_error(1000, 0.3, w, 1e-3 / w, 0.06 + 30 / w);
        printf("w %.4g: %.3g\n", w, off);
        ck_assert_double_lt(off, 1e-6);
    }
}
END_TEST

START_TEST(waves_are_of_second_order)
{
    for (double w = 300; w < 4000; w *= 3) {
        double ratio = wave_error(1000, 0.3, w, 0.1 / w, 0.1) / wave_error(1000, 0.3, w, 0.05 / w, 0.1);
        printf("w %.4g: %.4g\n", w, ratio);
        ck_assert_double_eq_tol(ratio, 4, 0.1);
    }
}
END_TEST

/* y = S''/w0^2, y' = 0, in steps small and large beside the resonance, and its mean over a step. */
START_TEST(a_constant_is_balanced)
{
    static const double steps[] = {1e-3, 0.1, 1, 40, 3000};
    for (int k = 0; k < 5; k++) {
        double dt = 1e-5, w0 = steps[k] / dt, mean = 0;
        struct roll_follow f = roll_follow_make(w0, 2 * 0.7 * w0, dt);
        for (long i = 0; i < 50000; i++)
            mean = roll_follow_step(&f, 5, 5);
        ck_assert_double_eq_tol(f.y * w0 * w0 / 5, 1, 1e-9);
        ck_assert_double_eq_tol(mean * w0 * w0 / 5, 1, 1e-9);
        ck_assert_double_lt(fabs(f.rate) * w0 / 5, 1e-9);
    }
}
END_TEST

/* Left alone from y = 0 at a speed: sin, exp and t exp, as the poles are complex, double, or real. Mean over a step
   by the differential equation: w0^2 times the integral of y is -y' - c y. */
START_TEST(poles_of_every_kind)
{
    static const double zetas[] = {0, 0.3, 1, 1.5, 20};
    for (int k = 0; k < 5; k++) {
        double w0 = 2000, zeta = zetas[k], dt = 1e-4, c = 2 * zeta * w0, sum = 0;
        struct roll_follow f = roll_follow_make(w0, c, dt);
        f.rate = 0.5;
        for (int i = 1; i <= 100; i++) {
            double t = i * dt, root = w0 * sqrt(fabs(1 - zeta * zeta));
            double wave = zeta < 1 ? sin(root * t) / root : zeta > 1 ? sinh(root * t) / root : t;
            sum += roll_follow_step(&f, 0, 0) * dt;
            ck_assert_double_eq_tol(f.y, 0.5 * exp(-zeta * w0 * t) * wave, 1e-10 * 0.5 / w0);
            ck_assert_double_eq_tol(w0 * w0 * sum, 0.5 - f.rate - c * f.y, 1e-10 * 0.5 * (1 + zeta));
        }
    }
}
END_TEST

/* Without damping nothing is lost or gained in a million steps. */
START_TEST(nothing_is_lost_without_damping)
{
    struct roll_follow f = roll_follow_make(1400, 0, 5e-6);
    f.rate = 1;
    for (long i = 0; i < 1000000; i++)
        roll_follow_step(&f, 0, 0);
    ck_assert_double_eq_tol(f.rate * f.rate + 1400.0 * 1400 * f.y * f.y, 1, 1e-8);
}
END_TEST

UNIT("roll_follow", waves_have_their_size_and_phase, waves_are_of_second_order, a_constant_is_balanced,
     poles_of_every_kind, nothing_is_lost_without_damping)
