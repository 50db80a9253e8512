/* grit: against Campbell's theorem, against grains counted one by one, and as a trace. */
#include "surface/grit.h"

#include "parts.h"

static const struct grit coat = {.given = true, .density = 1e7, .diameter = 125e-6, .height = 40e-6, .spread = 0.2};

static struct relief_part *grains(struct arena *a, struct grit g, const char *name)
{
    struct err e = {0};
    struct relief_part *p = grit_part(a, &g, noise_make(4, name), &e);
    ck_assert_msg(p != NULL, "%s", e.text);
    return p;
}

/* Heights of 400 x 400 places, half a millimetre apart (no grain touches two): independent, so that means are within 5
 * deviations / 400. */
START_TEST(mean_and_square)
{
    static const double spreads[] = {0, 0.2, 0.5}, densities[] = {1e7, 2e8};
    for (int s = 0; s < 3; s++)
        for (int d = 0; d < 2; d++) {
            struct arena *a = arena_open();
            struct grit g = coat;
            g.spread = spreads[s], g.density = densities[d], g.diameter = d ? 40e-6 : 125e-6;
            struct relief_part *p = grains(a, g, "moments");
            double mean = 0, square = 0, fourth = 0, want[2];
            for (int i = 0; i < 160000; i++) {
                double z = parts_at(p, 0.5e-3 * (i % 400), 0.5e-3 * (i / 400 - 200), true).v[0] / g.height;
                mean += z / 160000, square += z * z / 160000, fourth += z * z * z * z / 160000;
            }
            grit_moments(&g, &want[0], &want[1]);
            ck_assert_double_eq_tol(mean * g.height / want[0], 1, 5 * sqrt(square) / mean / 400);
            ck_assert_double_eq_tol(square * g.height * g.height / want[1], 1, 5 * sqrt(fourth) / square / 400);
            arena_close(a);
        }
}
END_TEST

/* Lone grains, one in a hundred of its diameters squared: their tops are local maxima with level ground around; how
   many there are on 40 mm x 40 mm, how high and how wide, against Poisson's and the log-normal deviations. */
START_TEST(counted)
{
    enum { N = 800 };
    static double z[N][N];
    struct arena *a = arena_open();
    struct grit g = coat;
    g.density = 5e5, g.spread = 0.3;
    struct relief_part *p = grains(a, g, "count");
    double step = 20e-6, count = 0, height = 0, square = 0;
    static double x[N], y[N];
    for (int quarter = 0; quarter < 6; quarter++) {
        for (int j = 0; j < N; j++) {
            for (int i = 0; i < N; i++) {
                x[i] = i * step + 0.1 * quarter, y[i] = j * step;
                z[j][i] = 0;
            }
            p->add(p, &(struct relief_points){N, x, y}, &(struct relief_values){.z = z[j]});
        }
        for (int j = 1; j < N - 1; j++)
            for (int i = 1; i < N - 1; i++) {
                bool top = z[j][i] > 0;
                for (int k = 0; k < 9 && top; k++)
                    top = k == 4 || z[j + k / 3 - 1][i + k % 3 - 1] < z[j][i];
                if (!top) continue;
                double u = i * step + 0.1 * quarter, v = j * step;
                for (double d = step / 2; d > 1e-9; d /= 2)
                    for (int k = 0; k < 8; k++) { /* climb: twice in each direction */
                        double x1 = u + (k % 4 == 0   ? d
                                         : k % 4 == 1 ? -d
                                                      : 0),
                               y1 = v + (k % 4 == 2   ? d
                                         : k % 4 == 3 ? -d
                                                      : 0);
                        if (parts_at(p, x1, y1, true).v[0] > parts_at(p, u, v, true).v[0]) u = x1, v = y1;
                    }
                double h = parts_at(p, u, v, true).v[0] / g.height;
                count++, height += h, square += h * h;
            }
    }
    double area = 6 * pow((N - 2) * step, 2), mean = height / count, spread = sqrt(square / count - mean * mean);
    /* some 770 grains; a hundredth or so hide each other and add up */
    ck_assert_double_eq_tol(count / (area * g.density), 1, 5 / sqrt(area * g.density) + 0.03);
    ck_assert_double_eq_tol(mean, 1, 5 * 0.3 / sqrt(count) + 0.01);
    ck_assert_double_eq_tol(spread, 0.3, 5 * 0.3 / sqrt(count));
    arena_close(a);
}
END_TEST

/* A lone grain is the bump of its size: heights 0.5 R away from the top. */
START_TEST(a_grain_is_the_bump)
{
    struct arena *a = arena_open();
    struct grit g = coat;
    g.density = 1e4, g.spread = 0;
    struct relief_part *p = grains(a, g, "one");
    int found = 0;
    for (int i = 0; i < 4000000 && found < 3; i++) {
        double x = 50e-6 * (i % 2000), y = 50e-6 * (i / 2000);
        struct parts_point t = parts_at(p, x, y, true);
        if (t.v[0] < 30e-6) continue;
        for (int n = 0; n < 8; n++) {
            double det = t.v[3] * t.v[5] - t.v[4] * t.v[4];
            x -= (t.v[5] * t.v[1] - t.v[4] * t.v[2]) / det, y -= (t.v[3] * t.v[2] - t.v[4] * t.v[1]) / det;
            t = parts_at(p, x, y, true);
        }
        ck_assert_double_eq_tol(t.v[0], 40e-6, 1e-15);
        for (double r = 0; r < 70e-6; r += 3e-6) {
            double share = 1 - r * r / (62.5e-6 * 62.5e-6), want = share > 0 ? 40e-6 * share * share * share : 0;
            ck_assert_double_eq_tol(parts_at(p, x + r * 0.6, y - r * 0.8, true).v[0], want, 1e-15);
        }
        found++;
    }
    ck_assert_int_eq(found, 3);
    arena_close(a);
}
END_TEST

START_TEST(trace_on_a_line)
{
    struct arena *a = arena_open();
    struct relief_part *p = grains(a, coat, "trace");
    for (int i = 0; i < 20000; i++) {
        struct parts_point line = parts_at(p, 7e-6 * i, 0, false), plane = parts_at(p, 7e-6 * i, 0, true);
        for (int k = 0; k < 4; k++)
            ck_assert(k == 2 || line.v[k] == plane.v[k]);
    }
    arena_close(a);
}
END_TEST

START_TEST(derivatives_and_continuity)
{
    struct arena *a = arena_open();
    struct grit g = coat;
    g.density = 1e8;
    parts_derivatives(grains(a, g, "c2"), 0.02, true);
    parts_derivatives(grains(a, g, "c2"), 0.02, false);
    parts_continuous(grains(a, g, "c2"), 50000, 0.01, 0.7, 0.4);
    parts_any_order(grains(a, coat, "order"), grains(a, coat, "order"), 10e-6);
    parts_asked_alone(grains(a, g, "order"));
    arena_close(a);
}
END_TEST

START_TEST(too_many_are_refused)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct grit g = coat;
    g.density = 1e11;
    ck_assert_ptr_null(grit_part(a, &g, noise_make(1, "x"), &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    arena_close(a);
}
END_TEST

UNIT("grit", mean_and_square, counted, a_grain_is_the_bump, trace_on_a_line, derivatives_and_continuity,
     too_many_are_refused)
