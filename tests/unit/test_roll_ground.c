/* A rolling ball's stiffness is that of the ground, whatever the motion makes of it: small and closed motions, gone round once or many times, against a straight
   line as long as the ground that is asked for, on random ground, as means over seeds.

   Tolerance: ln k of one seed is uncertain by 1.5 sqrt(1.3 / n), n the leaks of ground (scene/ball.c): 0.22 of 60, 0.30 of 33 in the plane. Two motions that go
   on to different ground share nothing, so that their means over S seeds differ by sqrt(2 / S) of that; three times as much is allowed. */
#include "folder.h"
#include "rig.h"

enum { LINE_SEEDS = 6, PLANE_SEEDS = 4 };

#define CIRCLE(turns) "{path: circle, radius: 1 mm, turns: " #turns ", speed: 10 cm/s}"

/* Mean over the seeds of ln k. A ball of glass of 8 mm. In the plane, where ground costs a lot, what is finer than the patch is left out. */
static double stiffness_level(const char *along, const char *motion, int seeds)
{
    const char *fine = strcmp(along, "plane") ? "25 um" : "120 um";
    double sum = 0;
    for (int seed = 1; seed <= seeds; seed++) {
        struct scene s = rig_scene(rig_arena(), arena_format(rig_arena(), "rasp: 1\nseed: %d\noutput: {diagnostics: {}, sample_rate: 48000}\nload: {approach: 0, release: 0}\n"
                                                             "surface: {roughness: {rms: 5.7 um, exponent: -1.8, longest: 0.61 mm, shortest: %s}, along: %s}\n"
                                                             "ball: {radius: 8 mm, mass: 5.4 g, patch: %s}\ncontact: {model: roll, roll: {scraping: 0}}\nmotion: %s\n",
                                                             seed, fine, along, fine, motion));
        struct rig *g = rig_record(&s, ITEM_SUBFORCE, 100, 100);
        sum += log(g->run.board.roll.stiffness) / seeds;
        rig_close(g);
    }
    return sum;
}

static void same_as(const char *what, double is, double line, double leaks, int seeds)
{
    double most = 3 * 1.5 * sqrt(1.3 / leaks) * sqrt(2.0 / seeds);
    printf("%s: %.3f times, within a factor of %.3f\n", what, exp(is - line), exp(most)), fflush(stdout);
    ck_assert_double_eq_tol(is, line, most);
}

static double line_along_x(void)
{
    return stiffness_level("x", "{path: line, to: [12 cm, 0], speed: 25 cm/s}", LINE_SEEDS);
}

/* Fitted to every turn, the level that is taken off beyond the circle was the circle's: k of 40 turns was some 4 times too small. */
START_TEST(how_often_round_is_no_matter)
{
    double line = line_along_x();
    same_as("1 turn", stiffness_level("x", CIRCLE(1), LINE_SEEDS), line, 60, LINE_SEEDS);
    same_as("40 turns", stiffness_level("x", CIRCLE(40), LINE_SEEDS), line, 60, LINE_SEEDS);
}
END_TEST

START_TEST(how_often_round_is_no_matter_in_the_plane)
{
    double once = stiffness_level("plane", CIRCLE(1), PLANE_SEEDS);
    same_as("40 turns, plane", stiffness_level("plane", CIRCLE(40), PLANE_SEEDS), once, 33, PLANE_SEEDS);
}
END_TEST

/* n times round a square of 2 mm. */
static const char *round_a_square(const char *path, int n)
{
    const char *points = "";
    for (int i = 0; i < n; i++)
        points = arena_format(rig_arena(), "%s%s[0, 0], [2 mm, 0], [2 mm, 2 mm], [0, 2 mm]", points, i ? ", " : "");
    return arena_format(rig_arena(), "{path: %s, points: [%s], speed: 5 cm/s}", path, points);
}

/* A circle of 1 mm, twice a second. */
static const char *recorded_circle(double duration)
{
    FILE *f = fopen(folder_path("circle.csv"), "w");
    ck_assert_ptr_nonnull(f);
    fputs("time_s,x_m,y_m\n", f);
    for (int i = 0; i <= 200 * duration; i++)
        fprintf(f, "%.6f,%.9f,%.9f\n", i / 200.0, 1e-3 * cos(4 * M_PI * i / 200), 1e-3 * sin(4 * M_PI * i / 200));
    fclose(f);
    return arena_format(rig_arena(), "{path: recorded, file: %s}", folder_path("circle.csv"));
}

/* Where every metre counted as new there was none beyond, and k of a scribble some 4 times too great. A square's sides along y are level: rms is 1/sqrt 2, of
   half of the leaks. */
START_TEST(small_motions_have_the_grounds_stiffness)
{
    folder_make();
    double line = line_along_x();
    const struct {
        const char *what, *motion;
        double more, leaks;
    } of[] = {{"scribble", "{path: scribble, size: [3 mm, 3 mm], rate: 5 Hz, duration: 4 s}", 1, 60}, {"recorded circle", recorded_circle(10), 1, 60},
              {"spline", round_a_square("spline", 20), 1, 60}, {"polyline", round_a_square("polyline", 20), pow(2, 0.75), 30}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        same_as(of[i].what, stiffness_level("x", of[i].motion, LINE_SEEDS), line + log(of[i].more), of[i].leaks, LINE_SEEDS);
    folder_remove();
}
END_TEST

START_TEST(a_small_scribble_in_the_plane)
{
    double line = stiffness_level("plane", "{path: line, to: [7 cm, 0], speed: 25 cm/s}", PLANE_SEEDS);
    double is = stiffness_level("plane", "{path: scribble, size: [0.5 mm, 0.5 mm], rate: 10 Hz, duration: 2 s}", PLANE_SEEDS);
    same_as("scribble, plane", is, line, 33, PLANE_SEEDS);
}
END_TEST

UNIT("roll_ground", how_often_round_is_no_matter, how_often_round_is_no_matter_in_the_plane, UNIT_LONG(small_motions_have_the_grounds_stiffness), a_small_scribble_in_the_plane)
