/* spectrum: integrals against GSL's adaptive quadrature; the density in the plane against the trace that it has. */
#include "surface/spectrum.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "unit.h"

static double at(double k, void *s) { return spectrum_at(s, k); }

/* Broken at the nodes and at the ends of the takeover. */
static double quadrature(struct spectrum *s, double from, double to)
{
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    gsl_function f = {at, s};
    double ends[16] = {0}, sum = 0, part, error;
    int n = 1;
    for (int i = 0; i < s->n; i++)
        ends[n++] = s->k[i];
    ends[n++] = s->takeover * sqrt(0.5), ends[n++] = s->takeover * sqrt(2), ends[n++] = 1e9;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            if (ends[j] < ends[i]) {
                double swap = ends[i];
                ends[i] = ends[j], ends[j] = swap;
            }
    for (int i = 0; i + 1 < n; i++) {
        double k0 = fmax(from, ends[i]), k1 = fmin(to, ends[i + 1]);
        if (k0 < k1 && k0 < spectrum_top(s)) {
            gsl_integration_qag(&f, k0, k1 * (1 - 1e-15), 0, 1e-12, 1000, 6, space, &part, &error);
            sum += part;
        }
    }
    gsl_integration_workspace_free(space);
    return sum;
}

static double nodes[5] = {300, 700, 5e3, 2.2e4, 9e4}, densities[5] = {3e-15, 5e-16, 4.9e-16, 1e-20, 2e-20};

START_TEST(integrals_of_a_table)
{
    gsl_set_error_handler_off();
    for (int flat = 0; flat < 2; flat++)
        for (int cross = 0; cross < 3; cross++) {
            struct spectrum s = {.n = 5,
                                 .k = nodes,
                                 .p = densities,
                                 .flat = flat,
                                 .takeover = cross == 0   ? 0
                                             : cross == 1 ? 800
                                                          : 3e4};
            static const double ends[][2] = {{0, 1e6},   {0, 100},     {250, 310}, {600, 4000}, {699, 701},
                                             {2e4, 3e4}, {100, 8.9e4}, {9e4, 1e5}, {1000, 1000}};
            for (int i = 0; i < 9; i++) {
                double want = quadrature(&s, ends[i][0], ends[i][1]), got = spectrum_power(&s, ends[i][0], ends[i][1]);
                ck_assert_msg(fabs(got - want) <= 1e-8 * want,
                              "flat %d, takeover %g, %g to %g: %.12g, quadrature %.12g", flat, s.takeover, ends[i][0],
                              ends[i][1], got, want);
            }
        }
}
END_TEST

START_TEST(nodes_and_ends)
{
    struct spectrum s = {.n = 5, .k = nodes, .p = densities, .flat = true};
    for (int i = 0; i < 4; i++) {
        ck_assert_double_eq(spectrum_at(&s, nodes[i]), densities[i]);
        double mid = sqrt(nodes[i] * nodes[i + 1]);
        ck_assert_double_eq_tol(spectrum_at(&s, mid) / sqrt(densities[i] * densities[i + 1]), 1, 1e-13);
    }
    ck_assert_double_eq(spectrum_at(&s, 0), densities[0]);
    ck_assert_double_eq(spectrum_at(&s, nodes[4]), 0);
    s.flat = false;
    ck_assert_double_eq(spectrum_at(&s, 299), 0);
    ck_assert_double_eq(spectrum_bottom(&s), 300);
    double rms = spectrum_rms(&s);
    double copy[5];
    memcpy(copy, densities, sizeof copy);
    s.p = copy;
    spectrum_scale(&s, 2 * rms);
    ck_assert_double_eq_tol(spectrum_rms(&s) / rms, 2, 1e-13);
}
END_TEST

/* X at k and at takeover^2/k add to 1; it rises; its ends are smooth. */
START_TEST(takeover_is_power_complementary)
{
    struct spectrum s = {.n = 5, .k = nodes, .p = densities, .takeover = 1e4};
    double last = 0;
    for (double k = 6e3; k < 1.6e4; k += 10) {
        double x = spectrum_takeover(&s, k);
        ck_assert_double_eq_tol(x + spectrum_takeover(&s, 1e8 / k), 1, 1e-12);
        ck_assert(x >= last && x - last < 5e-3);
        last = x;
    }
    ck_assert_double_eq(spectrum_takeover(&s, 7071), 0);
    ck_assert_double_eq(spectrum_takeover(&s, 14143), 1);
    ck_assert_double_eq_tol(spectrum_takeover(&s, 1e4), 0.5, 1e-15);
}
END_TEST

/* A ring of power w at radius kappa has the share 2/pi asin(k/kappa) of it below k along any line: thin rings of W make
 * the trace's power. */
START_TEST(rings_have_the_trace)
{
    static const double exponents[] = {-2.4, 0, -1, -8, -0.5};
    enum { RINGS = 4000 };
    struct arena *a = arena_open();
    for (int e = 0; e < 5; e++) {
        struct spectrum s = spectrum_power_law(a, exponents[e], 2e-3, 20e-6, 4e-6);
        double top = spectrum_top(&s), w[RINGS + 1];
        for (int i = 0; i <= RINGS; i++) {
            double share = 1 - (double)i / RINGS; /* rings crowd at the edge, where C2 has a pole, and at 0 */
            w[i] = i == RINGS ? 0 : spectrum_beyond(&s, top * (1 - share * share));
        }
        ck_assert_double_eq_tol(w[0] / 16e-12, 1, 1e-8);
        for (double k = top; k > 50; k /= 2) {
            double sum = 0;
            for (int i = 0; i < RINGS; i++) {
                double in = 1 - (double)i / RINGS, out = 1 - (i + 1.0) / RINGS,
                       kappa = top * (1 - 0.5 * (in * in + out * out));
                sum += (w[i] - w[i + 1]) * 2 / M_PI * asin(fmin(1, k / kappa));
            }
            double want = spectrum_power(&s, 0, k);
            ck_assert_msg(fabs(sum / want - 1) < 2e-3, "exponent %g, below %g: %g of the trace", exponents[e], k,
                          sum / want);
        }
    }
    arena_close(a);
}
END_TEST

/* Of a flat density W is P sqrt(k1^2 - kappa^2); of 1/k^2 above k0: P0 k0^2/kappa atan(sqrt(k1^2/kappa^2 - 1)). */
START_TEST(beyond_in_closed_form)
{
    struct arena *a = arena_open();
    struct spectrum flat = spectrum_power_law(a, 0, 1e-3, 1e-5, 1e-6),
                    square = spectrum_power_law(a, -2, 1e-3, 1e-5, 1e-6);
    for (double kappa = 1e3; kappa < 1e5; kappa *= 1.3) {
        ck_assert_double_eq_tol(spectrum_beyond(&flat, kappa) / (spectrum_at(&flat, 0) * sqrt(1e10 - kappa * kappa)), 1,
                                1e-9);
        double want = spectrum_at(&square, 0) * 1e6 / kappa * atan(sqrt(1e10 / (kappa * kappa) - 1));
        ck_assert_double_eq_tol(spectrum_beyond(&square, kappa) / want, 1, 1e-8);
    }
    arena_close(a);
}
END_TEST

START_TEST(a_rising_one_is_of_no_surface)
{
    struct arena *a = arena_open();
    struct spectrum s = spectrum_power_law(a, 2, 2e-3, 20e-6, 4e-6);
    ck_assert_double_gt(spectrum_beyond(&s, 2e4), spectrum_beyond(&s, 1e3));
    arena_close(a);
}
END_TEST

UNIT("spectrum", integrals_of_a_table, nodes_and_ends, takeover_is_power_complementary, rings_have_the_trace,
     beyond_in_closed_form, a_rising_one_is_of_no_surface)
