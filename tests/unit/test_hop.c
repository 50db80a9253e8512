/* The constants against their definition by quadrature, the formula against the energy of an interpolation error
   sampled in closed form. What it predicts of a whole sound is compared with brute force in test_launch.c. */
#include "unit.h"

#include <complex.h>

#include "hop.h"

static const int orders[] = {1, 2, 4};

/* Node product over p!, and the interval it is used in. */
static double product(int order, double u)
{
    return order == 1 ? u : order == 2 ? u * (u - 1) / 2 : (u + 1) * u * (u - 1) * (u - 2) / 24;
}

static double from(int order) { return order == 1 ? -0.5 : 0.0; }

/* k_p by the midpoint rule in 20000 steps: error of order 1e-9. */
START_TEST(constants_are_the_integrals)
{
    static const double known[] = {0.204, 0.112, 0.211}; /* three digits */
    for (int i = 0; i < 3; i++) {
        int p = orders[i], steps = 20000;
        double mean = 0, factorial = 1;
        for (int k = 0; k < steps; k++)
            mean += pow(product(p, from(p) + (k + 0.5) / steps), 2) / steps;
        for (int j = 2; j <= 2 * p; j++)
            factorial *= j;
        double k = sqrt(mean * factorial) / pow(2, p);
        printf("k_%d = %.6f\n", p, k);
        ck_assert_double_eq_tol(hop_error(p, 1), k, 1e-7);
        ck_assert_double_eq_tol(hop_error(p, 1), known[i], 6e-4);
    }
}
END_TEST

START_TEST(inverse)
{
    for (int i = 0; i < 3; i++)
        for (double rho = 1e-3; rho < 2; rho *= 1.7)
            ck_assert_double_eq_tol(hop_rho(orders[i], hop_error(orders[i], rho)) / rho, 1, 1e-14);
}
END_TEST

/* e^(s tau) itself, s moving linearly in u, interpolated over nodes: the relative rms error over tau and u. The pole
   moves along the imaginary axis by rho sigma per node; terms left out are of relative order rho^2. */
static double measured(int order, double rho)
{
    double error = 0, energy = 0;
    for (int k = 0; k < 60; k++) {
        double u = from(order) + (k + 0.5) / 60;
        for (double tau = 0; tau < 25; tau += 0.01) {
            double complex sum = 0, own = cexp((-1 + I * rho * u) * tau);
            for (int node = order == 4 ? -1 : 0; node <= (order == 4 ? 2 : order - 1); node++) {
                double w = 1;
                for (int other = order == 4 ? -1 : 0; other <= (order == 4 ? 2 : order - 1); other++)
                    if (other != node) w *= (u - other) / (node - other);
                sum += w * cexp((-1 + I * rho * node) * tau);
            }
            error += pow(cabs(sum - own), 2);
            energy += pow(cabs(own), 2);
        }
    }
    return sqrt(error / energy);
}

/* Within 2 dB up to 0.35; beyond, the terms left out make order 4 better than predicted: by 2.4 dB at 0.4, 3.5 dB at
 * 0.5. */
START_TEST(predicts_the_interpolation_error)
{
    static const double rhos[] = {0.05, 0.1, 0.2, 0.35, 0.5};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 5; k++) {
            double rho = rhos[k], d = 20 * log10(hop_error(orders[i], rho) / measured(orders[i], rho));
            printf("order %d, rho %.2f: predicted %.1f dB, %+.2f dB of measured\n", orders[i], rho,
                   20 * log10(hop_error(orders[i], rho)), d);
            ck_assert_double_gt(d, -0.5);
            ck_assert_double_lt(d, rho < 0.15 ? 0.5 : rho < 0.4 ? 2 : 4);
        }
}
END_TEST

UNIT("hop", constants_are_the_integrals, inverse, predicts_the_interpolation_error)
