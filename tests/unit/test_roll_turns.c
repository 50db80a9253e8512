/* The level under a ball, which turns with its way: heights where nothing is limited, corners, first turns, one leg, a grain that is read in the plane or as ridges. What rolls at a given
   stiffness is looked at in windows of the force. */
#include "rig.h"
#include "surface/profile.h"
#include "trajectory/trajectory.h"

enum { WINDOW = 240 }; /* frames, 5 ms: what rolls at a given stiffness knows no time, and so goes fast here */

static const char *ball_more = "";

static struct scene ball_scene(const char *surface, const char *limiter, const char *motion)
{
    return rig_scene(rig_arena(), arena_format(rig_arena(), "rasp: 1\nseed: 5\n%sball: {radius: 8 mm, mass: 5.4 g%s}\noutput: {diagnostics: {}, sample_rate: 48000}\n"
                                                            "load: {approach: 0 s, release: 0 s}\ncontact: {model: roll, smoothing: 0, %sroll: {stiffness: 1e6, scraping: 0}}\n"
                                                            "motion: %s\n", surface, ball_more, limiter, motion));
}

/* Means of the force over windows, over the ball's weight. */
static void ball_windows(const char *surface, const char *limiter, const char *motion, int n, double *windows)
{
    struct scene s = ball_scene(surface, limiter, motion);
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, (long)n * WINDOW, 1024);
    int per = WINDOW * g->per_frame;
    for (int i = 0; i < n; i++) {
        windows[i] = 0;
        for (int k = 0; k < per; k++)
            windows[i] += g->x[i * per + k] / (per * 5.4e-3 * 9.80665);
    }
    rig_close(g);
}

static const char *const there_and_back = "{path: back_and_forth, to: [20 mm, 0], rate: 5 Hz, law: minimum_jerk, duration: 0.2 s}",
                  *const sharp = "{path: polyline, points: [[0, 0], [20 mm, 0], [0, 0.001 mm]], duration: 0.2 s, law: minimum_jerk}",
                  *const square = "{path: polyline, points: [[0, 0], [20 mm, 0], [20 mm, 20 mm]], duration: 0.2 s, law: minimum_jerk}",
                  *const circle = "{path: circle, radius: 2 mm, turns: 2, duration: 0.1 s}";
static const char *const grounds[] = {"surface: {along: plane, roughness: {rms: 4 um, shortest: 40 um}}\n", "surface: {along: x, roughness: {rms: 4 um, shortest: 40 um}}\n"};

/* A corner of 180 degrees is a reversal, over ground that is 1 um to the side at most: as soon as 4 leaks of 2 mm have passed since the start, and since the corner. Until then it may differ, as a
   height is carried over a corner and a slope over a reversal: by 0.29 weights. With a level that did not turn it was up to 5 weights off. */
START_TEST(a_sharp_corner_is_a_reversal)
{
    for (int k = 0; k < 2; k++) {
        double is[40], wanted[40], worst = 0, soon = 0;
        ball_windows(grounds[k], "", there_and_back, 40, wanted);
        ball_windows(grounds[k], "", sharp, 40, is);
        for (int i = 0; i < 40; i++) { /* 20 mm each way, by minimum jerk: 8.6 mm in 9 of 20 windows */
            double off = fabs(is[i] - wanted[i]);
            if (i % 20 < 9)
                soon = fmax(soon, off);
            else
                worst = fmax(worst, off);
        }
        printf("worst %.3g, later %.3g of the weight\n", soon, worst), fflush(stdout);
        ck_assert_double_lt(soon, 0.4);
        ck_assert_double_lt(worst, 0.06);
    }
}
END_TEST

/* The ground's own ups and downs are left; with a level that did not turn 2.3 weights on the plane, and none before the corner over ridges. */
START_TEST(a_square_corner_makes_no_thump)
{
    for (int k = 0; k < 2; k++) {
        double is[40], before = 0, after = 0;
        ball_windows(grounds[k], "", square, 40, is);
        for (int i = 0; i < 6; i++)
            before += is[14 + i] / 6, after += is[21 + i] / 6;
        printf("%.4g, %.4g of the weight\n", before, after), fflush(stdout);
        ck_assert_double_eq_tol(before, 1, 0.3);
        ck_assert_double_eq_tol(after, 1, 0.3);
    }
}
END_TEST

/* A circle's first turn, of 6 leaks, presses from the start on, and from 4 leaks on it is the second: (1 + 4) e^-4 is left of what S began with. */
START_TEST(a_first_turn_is_as_the_second)
{
    for (int k = 0; k < 2; k++) {
        double is[20];
        ball_windows(grounds[k], "", circle, 20, is);
        for (int i = 0; i < 10; i++) {
            printf("%.4g %.4g\n", is[i], is[10 + i]), fflush(stdout);
            ck_assert_double_gt(is[i], 0.25);
            ck_assert(i < 7 || fabs(is[i] - is[10 + i]) < 0.05);
        }
    }
}
END_TEST

enum { HILL = 8000 };

/* z = -(x - 4 cm)^2 / (2 m): the ball's centre goes over it with the curvature -1 / (0.5 m + R), but for (x / 0.5 m)^2 of it. */
static struct relief_part *hill_part(struct arena *a, const struct contact *c)
{
    static double z[HILL];
    (void)c;
    for (int i = 0; i < HILL; i++)
        z[i] = -pow((i - HILL / 2) * 1e-5, 2);
    return profile_part(a, profile_from_samples(a, z, HILL, 1e-5, OFF_MAP_WRAP), "hill", 0);
}

/* The centre's height E over the hill, leaked twice (d/ds + 1/l of it is dE/ds, twice), at n + 1 instants, m; 0 at the start. Steps of 0.2 um or less, of the first order in them. */
static void hill_height(const struct scene *s, int n, double step, double *to)
{
    enum { FINE = 40 };
    const double leak = 2e-3;
    struct arena *a = arena_open();
    struct trajectory tr;
    struct err e;
    double before = 0, once = 0, twice = 0, way = 0;
    ck_assert(trajectory_make(&s->contacts[0].motion, 1, a, &tr, &e));
    for (int i = 0; i <= n * FINE; i++) {
        double t = step * i / FINE, x, u;
        trajectory_at(&tr, 1, &t, (struct trajectory_out){.x = &x, .u = &u});
        double height = -(x - 4e-2) * (x - 4e-2) / (2 * (0.5 + 8e-3)), kept = i ? exp(-(u - way) / leak) : 0, one = once;
        once = i ? kept * once + height - before : 0;
        twice = kept * twice + once - one;
        before = height;
        way = u;
        if (i % FINE == 0)
            to[i / FINE] = twice;
    }
    arena_close(a);
}

/* Means of (rest + height)^1.5 over windows, over their mean, with rest such that the mean is the weight; rho' has a part of 1e-4 in it. */
static void hill_windows(const double *height, int windows, int per, double *to)
{
    double low = 0, high = 1e-3, sum = 0;
    while (high - low > 1e-13) {
        double rest = 0.5 * (low + high);
        sum = 0;
        for (int w = 0; w < windows; w++) {
            to[w] = 0;
            for (int i = 0; i < per; i++) {
                double rho = rest + 0.5 * (height[w * per + i] + height[w * per + i + 1]);
                to[w] += rho > 0 ? 1e6 * rho * sqrt(rho) / (per * 5.4e-3 * 9.80665) : 0;
            }
            sum += to[w] / windows;
        }
        if (sum < 1)
            low = rest;
        else
            high = rest;
    }
    ck_assert_double_eq_tol(sum, 1, 1e-6);
}

/* With nothing limited a height is what it is on whatever way: on ways that turn the centre's height leaked twice, by a sum of its own; on a straight way, where that is l^2 times a constant
   curvature, it is level, and the force is the weight at every place. */
START_TEST(a_hill_is_a_height)
{
    static const char *const motions[] = {"{path: circle, center: [4 cm, 0], radius: 3 mm, turns: 1, duration: 0.1 s}",
                                          "{path: circle, center: [4.2 cm, 0], radius: 1 mm, turns: 2, duration: 0.1 s}",
                                          "{path: spline, points: [[3.8 cm, 0], [4.2 cm, 3 mm], [4.4 cm, -2 mm], [3.9 cm, 1 mm]], duration: 0.1 s}",
                                          "{path: back_and_forth, from: [3.8 cm, 0], to: [4.4 cm, 2 mm], rate: 20 Hz, duration: 0.1 s}"};
    static const char *const surface = "surface: {along: x, roughness: {}}\n", *const limiter = "limiter: {curve: none}, ";
    static double height[20 * WINDOW + 1];
    rig_relief = hill_part;
    for (size_t k = 0; k < sizeof motions / sizeof motions[0]; k++) {
        double is[20], wanted[20], worst = 0, swing = 0;
        ball_windows(surface, limiter, motions[k], 20, is);
        struct scene s = ball_scene(surface, limiter, motions[k]);
        hill_height(&s, 20 * WINDOW, 1 / 48e3, height);
        hill_windows(height, 20, WINDOW, wanted);
        for (int i = 0; i < 20; i++) {
            wanted[i] = k < 3 ? wanted[i] : 1;
            worst = fmax(worst, fabs(is[i] - wanted[i]));
            swing = fmax(swing, fabs(wanted[i] - 1));
        }
        printf("swings by %.3g, worst %.3g of the weight\n", swing, worst), fflush(stdout);
        ck_assert(k == 3 || swing > 0.02);
        ck_assert_double_lt(worst, 2e-3);
    }
    rig_relief = NULL;
}
END_TEST

/* A way of one leg goes by the code for turning ways, and is what the straight one is, where alpha follows the normal force too, across the plane and slantwise over ridges: but for a straight line between
   128 directions at which the means of what is limited (force/slope_heading.c) are known, of which over ridges 1e-4 of 300 um, 0.03 of the 1.4 um by which the ball lies in, is left. With means of
   other shapes it was 0.23 weights off, with alpha of ridges met squarely 0.7 at 60 degrees. */
START_TEST(a_leg_is_a_straight_way)
{
    ball_more = ", offset: 0.12 mm"; /* by which the normal force swings by a third */
    for (int k = 0; k < 4; k++) {
        double is[16], wanted[16], worst = 0, to[2] = {k == 0 ? 16 : k == 1 ? 40 : k == 2 ? 30 : 10, k == 0 ? 12 : k == 1 ? 24 : k == 2 ? 52 : 57};
        ball_windows(grounds[k > 0], "", arena_format(rig_arena(), "{path: line, to: [%g mm, %g mm], law: minimum_jerk, duration: 0.08 s}", to[0], to[1]), 16, wanted);
        ball_windows(grounds[k > 0], "", arena_format(rig_arena(), "{path: polyline, points: [[0, 0], [%g mm, %g mm]], law: minimum_jerk, duration: 0.08 s}", to[0], to[1]), 16, is);
        for (int i = 0; i < 16; i++)
            worst = fmax(worst, fabs(is[i] - wanted[i]));
        printf("worst %.3g of the weight\n", worst), fflush(stdout);
        ck_assert_double_lt(worst, k ? 0.1 : 1e-3);
    }
    ball_more = "";
}
END_TEST

/* ------------------------------------------------------------------ a grain */

enum { WAVES = 20 };

static double grain_angle; /* rad, across the grain */

/* Waves of 3 to 0.3 mm, 6 um rms, all of one direction: ridges, whether in the plane or along x. */
static void grain_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    double ex = cos(grain_angle), ey = sin(grain_angle);
    (void)part;
    for (int m = 0; m < WAVES; m++) {
        double k = 2 * M_PI / 3e-3 * pow(10, (double)m / WAVES), a = 6.5e-6 * pow(10, -0.7 * m / WAVES);
        for (size_t i = 0; i < p->n; i++) {
            double phase = k * (ex * p->x[i] + (p->y ? ey * p->y[i] : 0)) + 2.4 * m * m, z = a * cos(phase), d = -k * a * sin(phase), dd = -k * k * z;
            const double all[6] = {z, d * ex, d * ey, dd * ex * ex, dd * ex * ey, dd * ey * ey};
            double *const to[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
            for (int n = 0; n < 6; n++)
                if (to[n])
                    to[n][i] += all[n];
        }
    }
}

static struct relief_part *grain_part(struct arena *a, const struct contact *c)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    (void)c;
    *part = (struct relief_part){.name = "grain", .finest = 3e-5, .from = {-HUGE_VAL, -HUGE_VAL}, .to = {HUGE_VAL, HUGE_VAL}, .add = grain_add};
    return part;
}

static void grain_windows(const char *along, double degrees, int n, double *windows)
{
    grain_angle = degrees * M_PI / 180;
    ball_windows(arena_format(rig_arena(), "surface: {along: %s, roughness: {}}\n", along), "leak: 1 mm, ",
                 arena_format(rig_arena(), "{path: circle, radius: 3 mm, start_angle: %g deg, turns: 1, duration: 0.06 s}", degrees), n, windows);
}

/* Round a circle over a grain along and across the mean of T differ: the force would swing by several weights twice in each turn, where that of the same
   ridges as a profile does not; and turned with the ball's way the ground is the same, but for the four directions that the level knows. */
START_TEST(a_grain_in_the_plane_is_ridges)
{
    static const double angles[] = {22.5, 100};
    double wanted[12];
    rig_relief = grain_part;
    grain_windows("x", 0, 12, wanted);
    for (int k = 0; k < (int)(sizeof angles / sizeof *angles); k++) {
        double is[12], worst = 0;
        grain_windows("plane", angles[k], 12, is);
        for (int i = 0; i < 12; i++)
            worst = fmax(worst, fabs(is[i] - wanted[i])), printf("%.3f %.3f\n", wanted[i], is[i]);
        printf("%g degrees: worst %.3g of the weight\n", angles[k], worst), fflush(stdout);
        ck_assert_double_lt(worst, 0.05);
    }
    rig_relief = NULL;
}
END_TEST

UNIT("roll_turns", a_hill_is_a_height, a_leg_is_a_straight_way, UNIT_LONG(a_grain_in_the_plane_is_ridges), a_sharp_corner_is_a_reversal, a_square_corner_makes_no_thump, a_first_turn_is_as_the_second)
