/* impact_shape: each shape from its own samples, the Meixner window by its definition with log-gamma; R^2 against sums
 * by hand; a force of many impacts. */
#include <gsl/gsl_sf_gamma.h>

#include "analysis/impact_shape.h"
#include "unit.h"

static double meixner(double n, double b, double xi)
{
    return n > -1
               ? exp(0.5 * (b * log(1 - xi * xi) + gsl_sf_lngamma(n + b) - gsl_sf_lngamma(b) - gsl_sf_lngamma(n + 1)) +
                     n * log(xi))
               : 0;
}

/* b, xi, onset in samples, of 400 at most. The reference is good to 1e-13, so R^2 is 1 to 1e-10, and parameters are
 * known to about its root. */
START_TEST(meixner_from_itself)
{
    static const double given[][3] = {{1.5, 0.8, 3}, {3, 0.9, 4.3},  {8, 0.7, 5.7},
                                      {30, 0.5, 4},  {4, 0.95, 3.3}, {10, 0.98, 5}};
    for (int k = 0; k < 6; k++) {
        double y[400], model[400];
        int n = given[k][1] > 0.9 ? 400 : 60;
        struct impact_shape_fit f;
        for (int i = 0; i < n; i++)
            y[i] = -2.5 * meixner(i - given[k][2], given[k][0], given[k][1]);
        impact_shape_guess(y, n, IMPACT_SHAPE_MEIXNER, &f);
        impact_shape_fit(y, n, IMPACT_SHAPE_MEIXNER, &f, model);
        ck_assert_double_ge(f.r2, 1 - 1e-10);
        ck_assert_double_eq_tol(f.b / given[k][0], 1, 1e-3);
        ck_assert_double_eq_tol(f.xi, given[k][1], 1e-4);
        ck_assert_double_eq_tol(f.at, given[k][2], 1e-3);
        for (int i = 0; i < n; i++)
            ck_assert_double_eq_tol(model[i], y[i], 1e-4);
    }
}
END_TEST

/* From whole n on, w^2 is a negative binomial distribution: it sums to 1, its mean is b xi^2/(1 - xi^2). (Of the test's
 * own formula.) */
START_TEST(definition)
{
    double sum = 0, mean = 0;
    for (int n = 0; n < 2000; n++) {
        double w = meixner(n, 3.5, 0.9);
        sum += w * w;
        mean += n * w * w;
    }
    ck_assert_double_eq_tol(sum, 1, 1e-10);
    ck_assert_double_eq_tol(mean, 3.5 * 0.81 / 0.19, 1e-8);
    ck_assert_double_eq_tol(meixner(5, 3.5, 0.9) / meixner(4, 3.5, 0.9), 0.9 * sqrt((4 + 3.5) / 5),
                            1e-12); /* ISO/IEC 14496-3's recursion */
}
END_TEST

START_TEST(cosine_from_itself)
{
    for (double d = 6; d < 200; d *= 1.7) {
        double y[220];
        int n = (int)d + 6;
        struct impact_shape_fit f;
        for (int i = 0; i < n; i++) {
            double q = (i - n / 2.0 - 0.3) / d;
            y[i] = fabs(q) < 0.5 ? 1.7 * pow(cos(M_PI * q), 2) : 0;
        }
        impact_shape_guess(y, n, IMPACT_SHAPE_COSINE, &f);
        impact_shape_fit(y, n, IMPACT_SHAPE_COSINE, &f, NULL);
        ck_assert_double_eq_tol(f.duration / d, 1, 1e-5);
        ck_assert_double_eq_tol(f.at, n / 2.0 + 0.3, 1e-5 * d);
        ck_assert_double_eq_tol(f.gain, 1.7, 1e-5);
        ck_assert_double_ge(f.r2, 1 - 1e-9);
    }
}
END_TEST

/* A half sine: R^2 of its best raised cosine by a search over a grid of middles and durations. */
START_TEST(r2_is_the_best)
{
    enum { M = 40 };
    double y[M], best = -HUGE_VAL, mean = 0, total = 0;
    struct impact_shape_fit f;
    for (int i = 0; i < M; i++) {
        y[i] = fmax(sin(M_PI * (i - 6.2) / 25), 0) * (i > 6 && i < 31.2);
        mean += y[i] / M;
    }
    for (int i = 0; i < M; i++)
        total += (y[i] - mean) * (y[i] - mean);
    for (double at = 17; at < 21; at += 0.02)
        for (double d = 25; d < 40; d += 0.02) {
            double yw = 0, ww = 0, yy = 0;
            for (int i = 0; i < M; i++) {
                double w = fabs((i - at) / d) < 0.5 ? pow(cos(M_PI * (i - at) / d), 2) : 0;
                yw += y[i] * w, ww += w * w, yy += y[i] * y[i];
            }
            best = fmax(best, 1 - (yy - yw * yw / ww) / total);
        }
    impact_shape_guess(y, M, IMPACT_SHAPE_COSINE, &f);
    impact_shape_fit(y, M, IMPACT_SHAPE_COSINE, &f, NULL);
    ck_assert_double_eq_tol(f.r2, best, 1e-5);
    ck_assert_double_ge(f.r2, best - 1e-12);
}
END_TEST

START_TEST(many)
{
    enum { N = 20000 };
    static double y[N];
    struct arena *a = arena_open();
    struct impact_signal s = {y, N, 1000, 0};
    struct impact_found f;
    struct impact_shape h;
    struct err e = {0};
    for (int k = 0; k < 190; k++)
        for (int i = 0; i < N; i++) {
            double q = (i - 100.3 - 100.7 * k) / (20 + k % 7);
            y[i] += fabs(q) < 0.5 ? (1 + k % 5) * pow(cos(M_PI * q), 2) : 0;
        }
    ck_assert(impact_find(&s, &impact_find_options, a, &f, &e));
    impact_shape_make(&s, &f, a, &h);
    ck_assert(h.fitted == 190 && h.brief == 0);
    ck_assert_double_ge(h.r2[IMPACT_SHAPE_COSINE][0], 1 - 1e-8);
    ck_assert_double_le(h.r2[IMPACT_SHAPE_MEIXNER][2], 0.995);
    ck_assert(h.r2[1][0] <= h.r2[1][1] && h.r2[1][1] <= h.r2[1][2]);
    ck_assert_double_eq_tol(h.stretch, 1, 0.01);
    for (int j = 0; j < IMPACT_SHAPE_POINTS; j++) {
        double expected = fabs(h.q[j]) < 0.5 ? pow(cos(M_PI * h.q[j]), 2) : 0;
        ck_assert_double_eq_tol(h.mean[j], expected, 0.01); /* durations are known to 1 % */
        ck_assert_double_eq_tol(h.model[0][j], h.mean[j], 0.01);
        ck_assert_double_le(h.deviation[j], 0.03); /* and places on 1/32 of a sample */
    }
    f.events.n = 0;
    impact_shape_make(&s, &f, a, &h);
    ck_assert_int_eq(h.fitted, 0);
    arena_close(a);
}
END_TEST

/* Raised cosines of 2, 30, 3000 and 6000 samples: the first and the last are counted, not fitted. */
START_TEST(lengths)
{
    enum { N = 20000 };
    static double y[N];
    static const double at[] = {1000, 2000, 5000, 12000}, duration[] = {2, 30, 3000, 6000};
    struct arena *a = arena_open();
    struct impact_signal s = {y, N, 1000, 0};
    struct impact_found f;
    struct impact_shape h;
    struct err e = {0};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < N; i++) {
            double q = (i - at[k]) / duration[k];
            y[i] += fabs(q) < 0.5 ? pow(cos(M_PI * q), 2) : 0;
        }
    ck_assert(impact_find(&s, &impact_find_options, a, &f, &e) && f.alone == 4);
    impact_shape_make(&s, &f, a, &h);
    ck_assert_msg(h.fitted == 2 && h.brief == 1 && h.lengthy == 1, "%ld %ld %ld", h.fitted, h.brief, h.lengthy);
    arena_close(a);
}
END_TEST

UNIT("impact_shape", meixner_from_itself, definition, cosine_from_itself, r2_is_the_best, many, lengths)
