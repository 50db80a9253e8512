/* The response from force and sound: exact where the force holds everything, a dense least-squares solution where it
   does not, and heard again through the force wherever the force is above the limit. */
#include "num/deconvolve.h"

#include <gsl/gsl_linalg.h>

#include "base/arena.h"
#include "num/fft.h"
#include "unit.h"

enum { LONG = 6000, SHORT = 120 };

static void convolve(const double *f, long m, const double *h, long n, double *y)
{
    for (long i = 0; i < n; i++) {
        y[i] = 0.0;
        for (long k = 0; k < m; k++)
            if (i - k >= 0) y[i] += f[k] * h[i - k];
    }
}

/* A hammer's pulse of `m` samples: half a sine, or with a second hump, which makes its inverse noncausal. */
static void pulse(double *f, int m, double hump)
{
    for (int k = 0; k < m; k++)
        f[k] = sin(M_PI * (k + 0.5) / m) + hump * sin(3 * M_PI * (k + 0.5) / m);
}

/* Against the normal equations written out and solved by Cholesky. */
static void dense_one(int which)
{
    srand48(which);
    double f[12], y[SHORT], h[SHORT], most = 0.0, limit = which % 2 ? 1e-2 : 1e-4;
    int m = 3 + which % 10;
    for (int k = 0; k < m; k++)
        f[k] = drand48() - 0.2;
    for (int i = 0; i < SHORT; i++)
        y[i] = drand48() - 0.5;
    ck_assert_int_lt(deconvolve(y, SHORT, f, m, limit, h), 500);
    size_t size = fft_good_size(2 * SHORT + 2 * (size_t)m);
    for (size_t k = 0; k <= size / 2; k++) {
        double re = 0.0, im = 0.0;
        for (int i = 0; i < m; i++) {
            re += f[i] * cos(2 * M_PI * (double)k * i / (double)size);
            im += f[i] * sin(2 * M_PI * (double)k * i / (double)size);
        }
        most = fmax(most, re * re + im * im);
    }
    gsl_matrix *g = gsl_matrix_calloc(SHORT, SHORT);
    gsl_vector *b = gsl_vector_calloc(SHORT);
    for (int i = 0; i < SHORT; i++) {
        for (int j = 0; j < SHORT; j++) {
            double sum = i == j ? limit * most : 0.0;
            for (int k = 0; k < m; k++)
                if (k + i - j >= 0 && k + i - j < m) sum += f[k] * f[k + i - j];
            gsl_matrix_set(g, i, j, sum);
        }
        for (int k = 0; k < m; k++)
            if (i + k < SHORT) gsl_vector_set(b, i, gsl_vector_get(b, i) + f[k] * y[i + k]);
    }
    gsl_linalg_cholesky_decomp1(g);
    gsl_linalg_cholesky_svx(g, b);
    double scale = gsl_vector_max(b);
    for (int i = 0; i < SHORT; i++)
        ck_assert_double_eq_tol(h[i], gsl_vector_get(b, i), 1e-6 * scale);
    gsl_matrix_free(g);
    gsl_vector_free(b);
}

START_TEST(dense)
{
    for (int k = 0; k < 20; k++)
        dense_one(k);
}
END_TEST

/* Sound of a response that decays, through pulses of which some have no causal inverse: through the pulse again it is
 * the sound to 0.1 dB in every band of 30 bins in which the pulse holds 1 % of its power or more, and to -40 dB whole. */
static void through_one(int which)
{
    struct arena *a = arena_open();
    srand48(100 + which);
    double f[60], *h = ARENA_TAKE(a, double, LONG), *y = ARENA_TAKE(a, double, LONG),
                  *found = ARENA_TAKE(a, double, LONG), *again = ARENA_TAKE(a, double, LONG), off = 0.0, all = 0.0;
    int m = 8 + 6 * which;
    pulse(f, m, which % 2 ? 0.0 : -0.6);
    for (int i = 0; i < LONG; i++)
        h[i] = (drand48() - 0.5) * exp(-i / 300.0) + sin(0.02 * i) * exp(-i / 900.0);
    convolve(f, m, h, LONG, y);
    ck_assert_int_lt(deconvolve(y, LONG, f, m, 1e-4, found), 500);
    convolve(f, m, found, LONG, again);
    size_t size = fft_good_size(2 * LONG), bins = size / 2 + 1;
    struct fft *fft = fft_open(size);
    double *x = ARENA_TAKE(a, double, size), *re[3], *im[3], most = 0.0;
    const double *from[3] = {y, again, f};
    for (int k = 0; k < 3; k++) {
        re[k] = ARENA_TAKE(a, double, bins);
        im[k] = ARENA_TAKE(a, double, bins);
        memset(x, 0, size * sizeof *x);
        memcpy(x, from[k], (size_t)(k == 2 ? m : LONG) * sizeof *x);
        fft_forward(fft, x, re[k], im[k]);
    }
    for (size_t k = 0; k < bins; k++)
        most = fmax(most, re[2][k] * re[2][k] + im[2][k] * im[2][k]);
    for (size_t k = 0; k + 30 < bins; k += 30) {
        double power[3] = {0}, least = HUGE_VAL;
        for (size_t i = k; i < k + 30; i++) {
            for (int l = 0; l < 2; l++)
                power[l] += re[l][i] * re[l][i] + im[l][i] * im[l][i];
            least = fmin(least, re[2][i] * re[2][i] + im[2][i] * im[2][i]);
        }
        if (least > 1e-2 * most) ck_assert_double_lt(fabs(10 * log10(power[1] / power[0])), 0.15);
    }
    for (int i = 0; i < LONG; i++) {
        off += (again[i] - y[i]) * (again[i] - y[i]);
        all += y[i] * y[i];
    }
    ck_assert_double_lt(off, 1e-4 * all);
    fft_close(fft);
    arena_close(a);
}

START_TEST(through_the_force_again)
{
    for (int k = 0; k < 9; k++)
        through_one(k);
}
END_TEST

START_TEST(no_force)
{
    double f[3] = {0}, y[SHORT], h[SHORT];
    for (int i = 0; i < SHORT; i++)
        y[i] = h[i] = 1.0;
    ck_assert_int_eq(deconvolve(y, SHORT, f, 3, 1e-4, h), 0);
    for (int i = 0; i < SHORT; i++)
        ck_assert_double_eq(h[i], 0.0);
}
END_TEST

UNIT("deconvolve", dense, through_the_force_again, no_force)
