/* Energies of sums of exponentials against quadrature in long double, down to sums that all but cancel. */
#include "convolution/decaying.h"

#include <complex.h>

#include "unit.h"

/* Simpson's rule up to 45 of the slowest's decay times; t enters the weight. */
static double quadrature(const struct decaying *x, int n, double until, double fade)
{
    enum { STEPS = 40000 };
    double slowest = HUGE_VAL;
    long double sum = 0;
    for (int k = 0; k < n; k++)
        slowest = fmin(slowest, x[k].decay);
    double end = fmin(until, 45 / slowest);
    for (int i = 0; i <= STEPS; i++) {
        long double t = (long double)end * i / STEPS;
        long double complex all = 0;
        for (int k = 0; k < n; k++)
            all += ((long double)x[k].re + I * (long double)x[k].im) * cexpl((-(long double)x[k].decay + I * ((long double)x[k].omega - x[n - 1].omega)) * t);
        sum += (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2) * creall(all * conjl(all)) * expl(-fade * t);
    }
    return (double)(sum * end / STEPS / 3);
}

/* Order 4 in the middle between nodes, the pole moving by `rho` half bandwidths a node: the error falls with rho^4 (-275 dB at 0.0026), and is still
   seen. The series' own tolerance is 1e-4, quadrature's 1e-8, rounding's (1e-16 of a sixteenth)^2. */
START_TEST(test_cancelling)
{
    static const double w[5] = {-1.0 / 16, 9.0 / 16, 9.0 / 16, -1.0 / 16, -1}, at[5] = {-1.5, -0.5, 0.5, 1.5, 0};
    for (double rho = 1; rho > 8e-4; rho /= 3.3)
        for (int turn = 0; turn < 2; turn++) {
            struct decaying x[5];
            for (int k = 0; k < 5; k++)
                x[k] = (struct decaying){0.6 * w[k], 0.8 * w[k], turn ? 40 : 40 * (1 + 0.2 * rho * at[k]), 6000 + (turn ? 40 * rho * at[k] : 0)};
            double energy = decaying_energy(x, 5), judge = quadrature(x, 5, HUGE_VAL, 0);
            ck_assert_msg(fabs(energy - judge) < 1e-3 * judge + 1e-31, "rho %g: %g of %g", rho, energy, judge);
        }
}
END_TEST

/* Poles near and far: nothing cancels. */
START_TEST(test_apart)
{
    for (double apart = 0; apart < 3000; apart = 2 * apart + 1) {
        struct decaying x[3] = {{1, 0, 30, 500 + apart}, {0.3, 0.5, 50, 500 - apart}, {-0.7, 0.2, 40, 500}};
        ck_assert_double_eq_tol(decaying_energy(x, 3) / quadrature(x, 3, HUGE_VAL, 0), 1, 2e-3);
    }
}
END_TEST

/* Until an end, from far before to far after the sound has died away, also of poles that do not decay at all; what all but cancels, and phases that turn by a
   hundred turns, a whole number of them from one step to the next (where steps would see nothing). */
START_TEST(test_until)
{
    static const double w[5] = {-1.0 / 16, 9.0 / 16, 9.0 / 16, -1.0 / 16, -1}, at[5] = {-1.5, -0.5, 0.5, 1.5, 0}, decays[] = {0, 0.01, 1, 40};
    for (int i = 0; i < 4; i++)
        for (double end = 0.01; end < 0.5; end *= 3)
            for (double drift = 200 * M_PI; drift > 1e-2; drift /= 10) { /* rad between nodes until the end */
                struct decaying x[5];
                double alone, judge;
                for (int k = 0; k < 5; k++)
                    x[k] = (struct decaying){0.6 * w[k], 0.8 * w[k], decays[i] * (1 + 0.01 * at[k]), 6000 + drift * at[k] / end};
                double energy = decaying_energy_until(x, 5, end, &alone);
                judge = quadrature(x, 5, end, 0);
                ck_assert_msg(fabs(energy - judge) < 1e-3 * judge + 1e-26 * end, "decay %g, end %g, drift %g: %g of %g", decays[i], end, drift, energy, judge);
                ck_assert_double_eq_tol(alone / quadrature(x + 4, 1, end, 0), 1, 1e-9);
            }
}
END_TEST

/* Cut, and with a weight that falls: 24 points leave 1e-3 where the integrand is as smooth as that. */
START_TEST(test_weights)
{
    static const double untils[] = {0.002, 0.02, 0.1, HUGE_VAL};
    for (int i = 0; i < 4; i++)
        for (double fade = 0; fade < 30; fade += 10) {
            struct decaying x[2] = {{1, 0, 40, 612}, {-1, 0.01, 42, 600}};
            struct decaying_points p;
            double weight[DECAYING_POINTS], alone;
            decaying_points_make(2 * x[1].decay * untils[i], &p);
            for (int k = 0; k < DECAYING_POINTS; k++)
                weight[k] = exp(-fade * p.x[k] / (2 * x[1].decay));
            double energy = decaying_energy_weighted(x, 2, &p, weight, &alone);
            ck_assert_double_eq_tol(energy / quadrature(x, 2, untils[i], fade), 1, 2e-3);
            ck_assert_double_eq_tol(alone / quadrature(x + 1, 1, untils[i], fade), 1, 1e-3);
        }
}
END_TEST

UNIT("decaying", test_cancelling, test_apart, test_until, test_weights)
