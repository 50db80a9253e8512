/* The two metrics of papers/003: the contour of ISO 226, what is alike, what is not, and a descent to it. */
#include "analysis/material_metric.h"

#include <math.h>

#include "unit.h"

enum { MODES = 12 };

static const double pi = 3.14159265358979323846;

START_TEST(test_contour)
{
    static const double hz[] = {20, 100, 500, 1000, 3150, 4000, 12500},
                        db[] = {99.8539, 64.3711, 43.0507, 40.0100, 35.6089, 36.6492, 51.4859}; /* of the standard */
    for (int i = 0; i < 7; i++)
        ck_assert_double_eq_tol(material_metric_contour(hz[i]), db[i], 1e-3);
    ck_assert_double_eq_tol(material_metric_contour(sqrt(1000.0 * 1250.0)), 0.5 * (40.0100 + 41.8195), 1e-3);
}
END_TEST

/* A reference that the object's own modes make, with gains of its shapes. */
struct made {
    struct solid_family family;
    double in[MODES], gain[MODES], phase[MODES];
    struct feature feature[MODES];
    struct material_voice voice;
    double x[MATERIAL_UNKNOWNS];
};

static void make(struct made *m, double gamma, double alpha, double beta, double sigma, struct arena *a)
{
    m->family = (struct solid_family){.n = MODES,
                                      .nodes = 1,
                                      .nu = ARENA_TAKE(a, double, 1),
                                      .log_ratio = ARENA_TAKE(a, double, MODES),
                                      .slope = ARENA_TAKE(a, double, MODES)};
    for (int j = 0; j < MODES; j++) {
        double f = 180.0 * pow(1.0 + j, 1.4), lambda = 4.0 * pi * pi * f * f;
        m->family.log_ratio[j] = log(lambda / 2.5e7);
        lambda *= gamma / 2.5e7;
        double d = 0.5 * (alpha + beta * lambda), w = sqrt(lambda - d * d);
        m->in[j] = 1.0 + 0.5 * cos(1.7 * j);
        m->gain[j] = sigma * m->in[j] * m->in[j];
        m->phase[j] = pi / 2.0;
        m->feature[j] = (struct feature){w / (2.0 * pi), d, m->gain[j] * m->gain[j] / (4.0 * d)};
    }
    m->voice = (struct material_voice){.family = &m->family,
                                       .in = m->in,
                                       .out = m->in,
                                       .n = MODES,
                                       .feature = m->feature,
                                       .gain = m->gain,
                                       .phase = m->phase};
    m->x[MATERIAL_GAMMA] = log(gamma);
    m->x[MATERIAL_ALPHA_OF] = log(alpha);
    m->x[MATERIAL_BETA_OF] = log(beta);
    m->x[MATERIAL_SIGMA] = log(sigma);
}

/* Alike: both are 0. Everything halved in level: a sound 6.02 dB weaker has 2^(-0.602) of the loudness where it is
   above 40 phon, so image is (1 - 0.659)^2 = 0.116, less where it is below. Another gamma: nearly nothing in common. */
START_TEST(test_metrics)
{
    struct arena *a = arena_open();
    struct made m;
    make(&m, 2.5e7, 8.0, 3e-7, 5.0, a);
    struct material_search *s = material_metric_open(&m.voice, a);
    struct material_metric at = material_metric_at(s, m.x, 0.0);
    ck_assert_double_lt(at.image, 1e-6);
    ck_assert_double_lt(fabs(at.feature), 1e-9);
    ck_assert_double_eq_tol(material_metric_strength(s, m.x, 0.0), log(5.0), 1e-9);
    m.x[MATERIAL_SIGMA] -= log(2.0);
    at = material_metric_at(s, m.x, 0.0);
    ck_assert_double_eq_tol(at.image, 0.116, 0.02);
    m.x[MATERIAL_SIGMA] += log(2.0);
    m.x[MATERIAL_GAMMA] += 0.5;
    at = material_metric_at(s, m.x, 0.0);
    ck_assert(at.image > 0.4 && at.feature > 0.7);
    m.x[MATERIAL_GAMMA] -= 0.5;
    at = material_metric_at(s, m.x, 0.02); /* more damping */
    ck_assert(at.image > 0.05 && at.feature > 0.5);
    material_metric_close(s);
    arena_close(a);
}
END_TEST

START_TEST(test_descent)
{
    struct arena *a = arena_open();
    struct made m;
    make(&m, 2.5e7, 8.0, 3e-7, 5.0, a);
    struct material_search *s = material_metric_open(&m.voice, a);
    double x[MATERIAL_UNKNOWNS] = {m.x[0] + 0.004, m.x[1] + 0.3, m.x[2] - 0.3, m.x[3] + 0.2};
    const double step[MATERIAL_UNKNOWNS] = {0.002, 0.1, 0.1, 0.1};
    ck_assert_int_gt(material_metric_descend(s, x, step, 0.0), 50);
    ck_assert_double_eq_tol(x[MATERIAL_GAMMA], m.x[MATERIAL_GAMMA], 2e-4);
    ck_assert_double_eq_tol(x[MATERIAL_ALPHA_OF], m.x[MATERIAL_ALPHA_OF], 0.05);
    ck_assert_double_eq_tol(x[MATERIAL_BETA_OF], m.x[MATERIAL_BETA_OF], 0.05);
    ck_assert_double_eq_tol(x[MATERIAL_SIGMA], m.x[MATERIAL_SIGMA], 0.02);
    material_metric_close(s);
    arena_close(a);
}
END_TEST

UNIT("material_metric", test_contour, test_metrics, test_descent)
