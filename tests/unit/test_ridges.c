/* ridges: shapes by their definition, places and heights by many of them. */
#include "surface/ridges.h"

#include "parts.h"

static const struct ridges sine = {
    .given = true, .spacing = 1e-3, .height = 20e-6, .width = 0.3e-3, .direction = M_PI / 2, .shape = RIDGE_SINE};

static struct ridges with(int shape, double jitter, double variation)
{
    struct ridges r = sine;
    r.shape = shape, r.jitter = jitter, r.variation = variation;
    return r;
}

static double at(struct relief_part *p, double q) { return parts_at(p, q, 0, false).v[0]; }

START_TEST(shapes)
{
    struct arena *a = arena_open();
    struct ridges r[3] = {with(RIDGE_SINE, 0, 0), with(RIDGE_ROUND, 0, 0), with(RIDGE_GROOVE, 0, 0)};
    struct relief_part *p[3];
    for (int k = 0; k < 3; k++)
        p[k] = ridges_part(a, &r[k], ALONG_PATH, noise_make(1, "r"));
    for (double q = -5.3e-3; q < 5e-3; q += 1.7e-5)
        ck_assert_double_eq_tol(at(p[0], q), 10e-6 * cos(2 * M_PI * q / 1e-3), 1e-18);
    for (int i = -3; i < 4; i++) {
        ck_assert_double_eq_tol(at(p[1], i * 1e-3), 20e-6, 1e-17);
        ck_assert_double_eq_tol(at(p[1], i * 1e-3 + 0.15e-3), 10e-6, 1e-16); /* half height at half the width */
        ck_assert_double_eq_tol(at(p[1], i * 1e-3 - 0.15e-3), 10e-6, 1e-16);
        ck_assert_double_eq(at(p[1], i * 1e-3 + 0.34e-3), 0);
        for (double q = -0.5e-3; q < 0.5e-3; q += 1e-5)
            ck_assert_double_eq(at(p[2], i * 1e-3 + q), -at(p[1], i * 1e-3 + q));
    }
    arena_close(a);
}
END_TEST

/* Tops of 20 000 ridges found one by one: places' and heights' means and deviations, 5 deviations of each allowed. */
static void census(int shape, double jitter, double variation)
{
    enum { N = 20000 };
    struct arena *a = arena_open();
    struct ridges r = with(shape, jitter, variation);
    struct relief_part *p = ridges_part(a, &r, ALONG_PATH, noise_make(5, "census"));
    double sum[4] = {0};
    for (int i = -N / 2; i < N / 2; i++) {
        double best = -1, place = 0;
        for (int k = -200; k <= 200; k++) {
            double off = (jitter > 0 ? 0.0019 : 0) * k, z = at(p, (i + off) * 1e-3);
            if (z > best) best = z, place = off;
        }
        double v = best / (shape == RIDGE_SINE ? 10e-6 : 20e-6);
        sum[0] += place / N, sum[1] += place * place / N, sum[2] += v / N, sum[3] += v * v / N;
    }
    double fourth = sqrt(6.0 / N); /* relative deviation of a variance's estimate, at most */
    ck_assert_double_eq_tol(sum[0], 0, 5 * jitter / sqrt(N) + 1e-9);
    ck_assert_double_eq_tol(sqrt(sum[1]), jitter,
                            0.02 * jitter +
                                1e-9); /* the step moves a sine's tops by up to a few percent, the grid by 0.002 */
    ck_assert_double_eq_tol(sum[2], 1, 5 * variation / sqrt(N) + 2e-3);
    ck_assert_double_eq_tol(sqrt(fmax(0, sum[3] - sum[2] * sum[2])), variation, 5 * variation * fourth + 2e-3);
    arena_close(a);
}

START_TEST(places_and_heights)
{
    census(RIDGE_ROUND, 0, 0.2);
    census(RIDGE_ROUND, 0.08, 0);
    census(RIDGE_SINE, 0, 0.2);
    census(RIDGE_SINE, 0.08, 0);
}
END_TEST

/* Crests run in `direction`; along a line the ridges lie across it whatever the direction. */
START_TEST(direction)
{
    struct arena *a = arena_open();
    struct ridges r = with(RIDGE_ROUND, 0.1, 0.3);
    struct relief_part *line = ridges_part(a, &r, ALONG_PATH, noise_make(2, "d"));
    for (double d = 0; d < 3; d += 0.37) {
        r.direction = d;
        struct relief_part *plane = ridges_part(a, &r, ALONG_PLANE, noise_make(2, "d")),
                           *path = ridges_part(a, &r, ALONG_PATH, noise_make(2, "d"));
        for (int i = 0; i < 300; i++) {
            double x = 1.3e-4 * i, y = -0.7e-4 * i, q = x * sin(d) - y * cos(d);
            ck_assert_double_eq_tol(parts_at(plane, x, y, true).v[0], at(line, q), 1e-16);
            ck_assert_double_eq(parts_at(plane, x, y, true).v[0] - parts_at(plane, x + 0, y, true).v[0], 0);
            ck_assert_double_eq(at(path, x), at(line, x));
            ck_assert_double_eq_tol(parts_at(plane, x + 0.01 * cos(d), y + 0.01 * sin(d), true).v[0], at(line, q),
                                    1e-15);
        }
    }
    arena_close(a);
}
END_TEST

START_TEST(derivatives_and_continuity)
{
    struct arena *a = arena_open();
    for (int shape = 0; shape < 3; shape++) {
        struct ridges r = with(shape, 0.2, 0.5);
        r.direction = 0.6;
        r.width = shape == RIDGE_GROOVE ? 1.5e-3 : 0.3e-3; /* overlapping, too */
        parts_derivatives(ridges_part(a, &r, ALONG_PLANE, noise_make(3, "c2")), 0.1, true);
        parts_derivatives(ridges_part(a, &r, ALONG_X, noise_make(3, "c2")), 0.1, false);
        parts_continuous(ridges_part(a, &r, ALONG_PLANE, noise_make(3, "c2")), 50000, 0.01, 2, 0.4);
        parts_any_order(ridges_part(a, &r, ALONG_PLANE, noise_make(3, "o")),
                        ridges_part(a, &r, ALONG_PLANE, noise_make(3, "o")), 50e-6);
        parts_asked_alone(ridges_part(a, &r, ALONG_PLANE, noise_make(3, "o")));
    }
    arena_close(a);
}
END_TEST

UNIT("ridges", shapes, places_and_heights, direction, derivatives_and_continuity)
