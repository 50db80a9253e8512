/* num/special.h against GSL's Bessel functions, and against exact integrals. */
#include "num/special.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_bessel.h>

#include "unit.h"

static const double places[] = {1e-12, 1e-9, 1e-7, 1e-3, 0.1,   1.0,    2.404825557695773,
                                5.0,   13.7, 31.4, 64.0, 100.5, 200.25, 499.0};
static const int orders[] = {0, 1, 2, 3, 7, 20, 50, 100};

/* Relative to the amplitude sqrt(2/(pi x)) where J swings, to J where it does not yet. */
START_TEST(test_j)
{
    gsl_set_error_handler_off(); /* it calls underflow an error */
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (size_t n = 0; n < sizeof orders / sizeof *orders; n++) {
            double j[2], x = places[p];
            special_bessel_j(orders[n], x, j);
            for (int k = 0; k < 2; k++) {
                double size = orders[n] + k < x ? sqrt(2.0 / (3.14159265358979323846 * x)) : 0.0;
                gsl_sf_result want = {0};
                gsl_sf_bessel_Jn_e(orders[n] + k, x, &want);
                ck_assert_msg(fabs(j[k] - want.val) <= 1e-12 * fmax(fabs(want.val), size) + 1e-300,
                              "J_%d(%g) = %.17g, not %.17g", orders[n] + k, x, j[k], want.val);
            }
        }
}
END_TEST

/* Of tiny x GSL leaves out e^-x. */
START_TEST(test_i)
{
    gsl_set_error_handler_off();
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (size_t n = 0; n < sizeof orders / sizeof *orders; n++) {
            double i[2], x = places[p];
            special_bessel_i(orders[n], x, i);
            for (int k = 0; k < 2; k++) {
                gsl_sf_result want = {0};
                gsl_sf_bessel_In_scaled_e(orders[n] + k, x, &want);
                ck_assert_msg(fabs(i[k] - want.val) <= (1e-12 + (x < 1e-6 ? x : 0.0)) * 1.1 * fabs(want.val) + 1e-300,
                              "I_%d(%g) = %.17g, not %.17g", orders[n] + k, x, i[k], want.val);
            }
        }
}
END_TEST

START_TEST(test_zero_and_zeros)
{
    double j[2], i[2];
    special_bessel_j(0, 0.0, j);
    special_bessel_i(0, 0.0, i);
    ck_assert(j[0] == 1.0 && j[1] == 0.0 && i[0] == 1.0 && i[1] == 0.0);
    special_bessel_i(0, 5e-9, i); /* e^-x (1, x/2) */
    ck_assert_double_lt(fabs(i[0] - (1.0 - 5e-9)), 2e-16);
    ck_assert_double_lt(fabs(i[1] / (2.5e-9 * (1.0 - 5e-9)) - 1.0), 1e-15);
    const double zeros[] = {2.404825557695773, 3.831705970207512,
                            5.135622301840683}; /* j_01, j_11, j_21 (DLMF 10.75) */
    for (int n = 0; n < 3; n++) {
        special_bessel_j(n, zeros[n], j);
        ck_assert_double_lt(fabs(j[0]), 1e-15);
    }
}
END_TEST

/* x^k, k < 2n, to rounding; n = 1 and large n. */
START_TEST(test_gauss)
{
    const int sizes[] = {1, 2, 5, 24, 200};
    for (int s = 0; s < 5; s++) {
        double node[200], weight[200];
        special_gauss_legendre(sizes[s], node, weight);
        for (int k = 0; k < 2 * sizes[s]; k++) {
            double sum = 0.0;
            for (int i = 0; i < sizes[s]; i++)
                sum += weight[i] * pow(node[i], k);
            ck_assert_double_lt(fabs(sum - (k % 2 ? 0.0 : 2.0 / (k + 1))), 1e-14);
        }
    }
}
END_TEST

/* Orthonormal; the derivatives are those of the values (differences over 1e-5, so 1e-6 of the second derivative's size
 * n^4). */
START_TEST(test_jacobi)
{
    const int ends[][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 2}};
    enum { N = 40, POINTS = 60 };
    double node[POINTS], weight[POINTS], f[POINTS][N], low[N], high[N], f1[N], f2[N], d1[N], d2[N], middle[N];
    special_gauss_legendre(POINTS, node, weight);
    for (int e = 0; e < 4; e++) {
        struct jacobi j = special_jacobi_make(ends[e][0], ends[e][1]);
        for (int q = 0; q < POINTS; q++)
            special_jacobi_values(&j, N, node[q], f[q]);
        for (int a = 0; a < N; a++)
            for (int b = 0; b < N; b++) {
                double sum = 0.0;
                for (int q = 0; q < POINTS; q++)
                    sum += weight[q] * f[q][a] * f[q][b];
                ck_assert_double_lt(fabs(sum - (a == b)), 1e-12);
            }
        const double x = 0.3, h = 1e-5;
        special_jacobi_slopes(&j, N, x - h, low, d1, d2);
        special_jacobi_slopes(&j, N, x + h, high, f1, f2);
        for (int a = 0; a < N; a++)
            f2[a] = (f1[a] - d1[a]) / (2.0 * h);
        special_jacobi_slopes(&j, N, x, middle, d1, d2);
        for (int a = 0; a < N; a++) {
            ck_assert_double_lt(fabs((high[a] - low[a]) / (2.0 * h) - d1[a]), 1e-4);
            ck_assert_double_lt(fabs(f2[a] - d2[a]), 1e-2);
        }
        special_jacobi_values(&j, N, x, low);
        for (int a = 0; a < N; a++)
            ck_assert_double_lt(fabs(low[a] - middle[a]), 1e-13);
    }
}
END_TEST

UNIT("bessel", test_j, test_i, test_zero_and_zeros, test_gauss, test_jacobi)
