/* heights: moments by GSL's quadrature, by reading, and in fields. */
#include "surface/heights.h"

#include <gsl/gsl_integration.h>

#include "num/noise.h"
#include "parts.h"
#include "surface/roughness.h"
#include "surface/tiles.h"

struct power {
    const struct heights *h;
    int power;
};

static double integrand(double g, void *data)
{
    const struct power *p = data;
    double z, slope, bend;
    heights_at(p->h, 1, &g, &z, &slope, &bend);
    return (p->power < 0    ? slope * slope
            : p->power == 5 ? g * z
                            : pow(z, p->power)) *
           exp(-0.5 * g * g) / sqrt(2 * M_PI);
}

static double mean_of(const struct heights *h, int power)
{
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    struct power p = {h, power};
    gsl_function f = {integrand, &p};
    double sum, error;
    gsl_integration_qag(&f, -14, 14, 1e-13, 1e-12, 1000, 6, space, &sum, &error);
    gsl_integration_workspace_free(space);
    return sum;
}

static const double shapes[][2] = {{0, 3}, {-1, 5},  {1, 5},  {0, 2.2},   {0, 30},    {-0.5, 3.2},
                                   {2, 9}, {-3, 20}, {3, 40}, {0.3, 2.7}, {0, 3.001}, {-1e-3, 3}};
enum { SHAPES = 12 };

START_TEST(moments_are_as_asked)
{
    for (int i = 0; i < SHAPES; i++) {
        struct heights h;
        struct err e = {0};
        ck_assert_msg(heights_make(shapes[i][0], shapes[i][1], &h, &e), "%s", e.text);
        double variance = mean_of(&h, 2);
        ck_assert_double_eq_tol(mean_of(&h, 1), 0, 1e-9);
        ck_assert_double_eq_tol(variance, 1, 1e-9);
        ck_assert_double_eq_tol(mean_of(&h, 3), shapes[i][0], 1e-8);
        ck_assert_double_eq_tol(mean_of(&h, 4) / shapes[i][1], 1, 1e-9);
        ck_assert_double_eq_tol(mean_of(&h, 5) * mean_of(&h, 5), h.linear, 1e-9);
        ck_assert_double_eq_tol(mean_of(&h, -1), h.steeper, 1e-8);
        ck_assert(h.linear <= 1 + 1e-12 && h.steeper >= 1 - 1e-12);
    }
}
END_TEST

START_TEST(derivatives_and_rise)
{
    for (int i = 0; i < SHAPES; i++) {
        struct heights h;
        struct err e = {0};
        heights_make(shapes[i][0], shapes[i][1], &h, &e);
        for (double g = -9; g < 9; g += 0.0371) {
            double at[3] = {g - 1e-5, g, g + 1e-5}, z[3], slope[3], bend[3];
            heights_at(&h, 3, at, z, slope, bend);
            ck_assert_double_gt(slope[1], 0);
            ck_assert_double_eq_tol((z[2] - z[0]) / 2e-5 / slope[1], 1, 1e-6);
            ck_assert_double_eq_tol((slope[2] - slope[0]) / 2e-5, bend[1], 1e-6 * (fabs(bend[1]) + slope[1]));
        }
    }
}
END_TEST

START_TEST(gaussian_is_left_alone)
{
    struct heights h;
    struct err e = {0};
    double g[5] = {-5, -1, 0, 0.3, 6}, z[5], slope[5], bend[5];
    heights_make(0, 3, &h, &e);
    heights_at(&h, 5, g, z, slope, bend);
    for (int i = 0; i < 5; i++) {
        ck_assert_double_eq_tol(z[i], g[i], 1e-9);
        ck_assert_double_eq_tol(slope[i], 1, 1e-9);
        ck_assert_double_eq_tol(bend[i], 0, 1e-9);
    }
}
END_TEST

/* What is refused says what would do, and that does. */
START_TEST(out_of_reach)
{
    static const double beyond[][2] = {{0, 1.8}, {1, 3}, {-3, 15}, {2, 45}, {0, 60}};
    for (int i = 0; i < 5; i++) {
        struct heights h;
        struct err e = {0};
        double range[2], told[2];
        ck_assert(!heights_make(beyond[i][0], beyond[i][1], &h, &e));
        ck_assert_int_eq(e.kind, ERR_SCENE);
        ck_assert_int_eq(sscanf(strstr(e.text, "can be from"), "can be from %lf to %lf", &told[0], &told[1]), 2);
        ck_assert(heights_range(beyond[i][0], range));
        for (int k = 0; k < 2; k++) {
            struct err none = {0};
            ck_assert_double_eq_tol(told[k] / range[k], 1, 1e-3);
            ck_assert_msg(heights_make(beyond[i][0], told[k], &h, &none), "%s", none.text);
        }
    }
}
END_TEST

/* 20 m of a profile and of a line in the plane, 8 longest waves apart at least: some 10 000 independent heights. Of the
   field's kurtosis the deviation is bounded by five of sqrt(variance of z^4/10 000); 0.5 of that of the exact moments
   is allowed at kurtosis 5, as measured over other seeds. */
static void check_field(struct relief_part *p, double skewness, double kurtosis)
{
    enum { N = 1 << 16 };
    static double x[N], y[N], z[N];
    double sum[5] = {0};
    for (int from = 0; from < 4; from++) {
        for (int i = 0; i < N; i++) {
            x[i] = 80e-6 * i + 6.1 * from;
            y[i] = 0.31 * x[i];
            z[i] = 0;
        }
        p->add(p, &(struct relief_points){N, x, y}, &(struct relief_values){.z = z});
        for (int i = 0; i < N; i++)
            for (int k = 1; k < 5; k++)
                sum[k] += pow(z[i] / 4e-6, k) / N / 4;
    }
    ck_assert_double_eq_tol(sum[1], 0, 0.05);
    ck_assert_double_eq_tol(sum[2], 1, 0.05);
    ck_assert_double_eq_tol(sum[3], skewness, 0.2);
    ck_assert_double_eq_tol(sum[4], kurtosis, 0.7);
}

START_TEST(fields_have_them)
{
    struct arena *a = arena_open();
    struct heights h;
    struct err e = {0};
    struct spectrum s = spectrum_power_law(a, -2.4, 2e-3, 20e-6, 1);
    heights_make(-1, 5, &h, &e);
    struct relief_part *line = profile_part(a, roughness_blocks(a, &s, noise_make(1, "line")), "line", 0);
    struct relief_part *plane = tiles_part(a, &s, &(struct tiles_grain){1, 0, false}, noise_make(1, "plane"), NULL, &e);
    struct relief_part *shaped[2] = {heights_part(a, line, &h, 4e-6), heights_part(a, plane, &h, 4e-6)};
    for (int k = 0; k < 2; k++) {
        ck_assert(!shaped[k]->linear);
        check_field(shaped[k], -1, 5);
        parts_derivatives(shaped[k], 0.05, k == 1);
    }
    parts_continuous(shaped[1], 20000, 0.02, 0.3, 0.3);
    parts_asked_alone(shaped[1]);
    shaped[0]->close(shaped[0]);
    arena_close(a);
}
END_TEST

UNIT("heights", moments_are_as_asked, derivatives_and_rise, gaussian_is_left_alone, out_of_reach, fields_have_them)
