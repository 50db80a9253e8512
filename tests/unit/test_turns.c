/* Motions that stop and turn back exactly: pauses and reversals of recordings and polylines in the plane, many of them, drawn from seeds. At the
   turns the contact's steps are of the size of the coordinates' last places, so that chords point anywhere. The force must be finite (the runner
   refuses what is not), and from rest to rest its sum is the momentum's change: none. And the level under a ball, which turns with its way. */
#include <unistd.h>

#include "rig.h"
#include "surface/profile.h"

static char *drawn_polyline(struct arena *a, int seed)
{
    char *points = arena_format(a, "[[0, 20 mm]");
    int x = 0;
    srand48(seed);
    for (int i = 0; i < 6; i++) {
        x += (i % 2 ? -1 : 1) * (10 + (int)(60 * drand48()));
        points = arena_format(a, "%s, [%d mm, %d mm]", points, x, seed % 3 ? 20 : 20 + i);
    }
    return arena_format(a, "motion: {path: polyline, points: %s], duration: %.17g s}\n", points, 0.06 + 0.01 * (seed % 13));
}

static double jerk(double p)
{
    return p < 0 ? 0 : p > 1 ? 1 : p * p * p * (10 + p * (-15 + p * 6));
}

/* There, a pause, half way back, a pause, there again; positions held to `grain` m. */
static void recording(const char *file, int seed, double grain)
{
    FILE *f = fopen(file, "w");
    ck_assert_ptr_nonnull(f);
    fprintf(f, "time_s,x_m,y_m\n");
    srand48(seed);
    double way = 0.01 + 0.04 * drand48(), pause = 0.05 * drand48(), up = seed % 2 ? 0 : 0.02 * drand48();
    for (int i = 0; i <= 48; i++) {
        double t = i / 120.0, s = jerk(t / 0.1) - 0.5 * jerk((t - 0.1 - pause) / 0.08) + 0.5 * jerk((t - 0.25) / 0.1), x = 0.1 + way * s, y = 0.03 + up * s;
        if (grain > 0)
            x = grain * rint(x / grain), y = grain * rint(y / grain);
        fprintf(f, "%.6f,%.9f,%.9f\n", t, x, y);
    }
    fclose(f);
}

/* The sum of the force over the motion, over the sum of its magnitudes. */
static double left_over(struct scene *s, long frames)
{
    struct rig *g = rig_record(s, ITEM_SUBFORCE, frames, 1024);
    double sum = 0, all = 0;
    for (long i = 0; i < frames * g->per_frame; i++) {
        sum += g->x[i];
        all += fabs(g->x[i]);
    }
    ck_assert_double_gt(all, 0);
    rig_close(g);
    return fabs(sum) / all;
}

static const char *const head = "rasp: 1\nsurface: {along: plane, roughness: {rms: 4 um}}\nscraper: {mass: 20 g}\naccuracy: draft\noutput: {diagnostics: {}}\n"
                                "load: {approach: 0 s, release: 0 s}\n";
static const char *const forces[] = {"contact: {beta1: 0, smoothing: 0}\n", "contact: {force: paper, smoothing: 0}\n"};

/* Corners of 180 degrees and others; the sum is below the roundings of 10 000 terms. */
START_TEST(polylines_that_go_back)
{
    for (int seed = 0; seed < 6; seed++)
        for (int k = 0; k < 2; k++) {
            struct arena *a = arena_open();
            struct scene s = rig_scene(a, arena_format(a, "%s%s%s", head, forces[k], drawn_polyline(a, seed)));
            double left = left_over(&s, (long)(s.contacts[0].motion.duration * 48000) + 2);
            ck_assert_msg(k == 1 || left < 1e-11, "seed %d: %g is left", seed, left);
            arena_close(a);
        }
}
END_TEST

START_TEST(recordings_with_pauses)
{
    static const double grains[] = {0, 1e-5, 1e-4}, cutoffs[] = {0, 12, 25};
    char file[] = "/tmp/test_turns.XXXXXX.csv";
    int handle = mkstemps(file, 4);
    ck_assert_int_ge(handle, 0);
    close(handle);
    for (int seed = 0; seed < 27; seed += 5) { /* each grain, cutoff and force */
        struct arena *a = arena_open();
        recording(file, seed, grains[seed % 3]);
        struct scene s = rig_scene(a, arena_format(a, "%s%smotion: {path: recorded, file: %s, cutoff: %g}\n", head, forces[seed % 4 == 3], file,
                                                   cutoffs[seed / 3 % 3]));
        left_over(&s, 19203);
        arena_close(a);
    }
    remove(file);
}
END_TEST

/* ------------------------------------------------------------------ the level under a ball */

enum { WINDOW = 240 }; /* frames, 5 ms: what rolls at a given stiffness knows no time, and so goes fast here */

static const char *ball_more = "";

/* Means of the force over windows, over the ball's weight. */
static void ball_windows(const char *surface, const char *limiter, const char *motion, int n, double *windows)
{
    struct scene s = rig_scene(rig_arena(), arena_format(rig_arena(), "rasp: 1\nseed: 5\n%sball: {radius: 8 mm, mass: 5.4 g%s}\noutput: {diagnostics: {}, sample_rate: 48000}\n"
                                                         "load: {approach: 0 s, release: 0 s}\ncontact: {model: roll, smoothing: 0, %sroll: {stiffness: 1e6, scraping: 0}}\n"
                                                         "motion: %s\n", surface, ball_more, limiter, motion));
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

/* A corner of 180 degrees is a reversal, over ground that is 1 um to the side at most. With a level that did not turn it was up to 5 weights off. */
START_TEST(a_sharp_corner_is_a_reversal)
{
    for (int k = 0; k < 2; k++) {
        double is[40], wanted[40], worst = 0;
        ball_windows(grounds[k], "", there_and_back, 40, wanted);
        ball_windows(grounds[k], "", sharp, 40, is);
        for (int i = 0; i < 40; i++)
            worst = fmax(worst, fabs(is[i] - wanted[i]));
        printf("worst %.3g of the weight\n", worst), fflush(stdout);
        ck_assert_double_lt(worst, 0.02);
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

/* Nothing deviates from the level on a long hill: the force is the weight at every place of every way over it. */
START_TEST(a_hill_is_all_level)
{
    static const char *const motions[] = {"{path: circle, center: [4 cm, 0], radius: 3 mm, turns: 1, duration: 0.1 s}",
                                          "{path: polyline, points: [[3.8 cm, 0], [4.4 cm, 0], [4.4 cm, 6 mm]], duration: 0.1 s}",
                                          "{path: polyline, points: [[3.8 cm, 0], [4.4 cm, 0], [3.8 cm, 1 mm], [4.4 cm, 4 mm]], duration: 0.1 s}",
                                          "{path: back_and_forth, from: [3.8 cm, 0], to: [4.4 cm, 2 mm], rate: 20 Hz, duration: 0.1 s}"};
    rig_relief = hill_part;
    for (size_t k = 0; k < sizeof motions / sizeof motions[0]; k++) {
        double is[20], worst = 0;
        ball_windows("surface: {along: x, roughness: {}}\n", "limiter: {curve: none}, ", motions[k], 20, is);
        for (int i = 0; i < 20; i++)
            worst = fmax(worst, fabs(is[i] - 1));
        printf("worst %.3g of the weight\n", worst), fflush(stdout);
        ck_assert_double_lt(worst, 2e-3);
    }
    rig_relief = NULL;
}
END_TEST

/* A way of one leg goes by the code for turning ways, and is what the straight one is: to rounding where alpha follows the normal force too, across the plane
   and slantwise over ridges. With alpha of ridges met squarely the mean over a window was off by 0.7 weights at 60 degrees. */
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
        ck_assert_double_lt(worst, 1e-6);
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
    ball_windows(arena_format(rig_arena(), "surface: {along: %s, roughness: {}}\n", along), "",
                 arena_format(rig_arena(), "{path: circle, radius: 3 mm, start_angle: %g deg, turns: 1, duration: 0.06 s}", degrees), n, windows);
}

/* Round a circle over a grain along and across the mean of T differ: the force would swing by several weights twice in each turn, where that of the same
   ridges as a profile does not; and turned with the ball's way the ground is the same, but for the four directions that the level knows. */
START_TEST(a_grain_in_the_plane_is_ridges)
{
    static const double angles[] = {0, 22.5, 100};
    double wanted[12];
    rig_relief = grain_part;
    grain_windows("x", 0, 12, wanted);
    for (int k = 0; k < 3; k++) {
        double is[12], worst = 0;
        grain_windows("plane", angles[k], 12, is);
        for (int i = 0; i < 12; i++)
            worst = fmax(worst, fabs(is[i] - wanted[i])), printf("%.3f %.3f\n", wanted[i], is[i]);
        printf("%g degrees: worst %.3g of the weight\n", angles[k], worst), fflush(stdout);
        ck_assert_double_lt(worst, 0.8);
    }
    rig_relief = NULL;
}
END_TEST

UNIT("turns", a_hill_is_all_level, a_leg_is_a_straight_way, a_grain_in_the_plane_is_ridges, a_sharp_corner_is_a_reversal, a_square_corner_makes_no_thump, a_first_turn_is_as_the_second, polylines_that_go_back, recordings_with_pauses)
