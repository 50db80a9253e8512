/* The stiffness under a ball whose centre of mass is not in its middle: N(t) swings, and alpha with it. The offset is no roughness (scene key contact.roll.static_depth), so the stiffness is
   about that of a round ball over the same ridges: by alpha, which is larger for a while and smaller for a while, some tens of percent off. */
#include "rig.h"

static const char *const ways[] = {"{path: line, to: [6 cm, 5 mm], speed: 20 cm/s}", "{path: circle, radius: 10 mm, turns: 1, speed: 20 cm/s}",
                                   "{path: polyline, points: [[0, 0], [3 cm, 5 mm], [0, 1 cm]], speed: 20 cm/s}"};
enum { WAYS = sizeof ways / sizeof ways[0] };

static double stiffness(const char *along, double offset, const char *limiter, const char *way)
{
    struct scene s = rig_scene(rig_arena(), arena_format(rig_arena(), "rasp: 1\noutput: {diagnostics: {}, sample_rate: 48000}\nload: {approach: 0, release: 0}\n"
                                                         "surface: {along: %s, ridges: {spacing: 1 mm, height: 20 um}}\nball: {radius: 1 cm, mass: 10 g, patch: 120 um, offset: %g mm}\n"
                                                         "contact: {model: roll, smoothing: 0, %sroll: {scraping: 0}}\nmotion: %s\n", along, offset, limiter, way));
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 100, 1024);
    double k = g->run.board.roll.stiffness;
    rig_close(g);
    return k;
}

/* Along a straight way the mean of what is limited went with alpha, and S with it, against the force: 0.11 of the round ball's stiffness. Along a path there is no direction. */
START_TEST(an_offset_is_no_roughness)
{
    static const char *const along[] = {"plane", "x", "path"};
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < WAYS; i++) {
            double round = stiffness(along[j], 0, "", ways[i]);
            for (double offset = 0.1; offset < 3; offset *= 4.5) {
                double ratio = stiffness(along[j], offset, "", ways[i]) / round;
                printf("along %s, %s, %g mm: %.3g of the round ball's\n", along[j], ways[i], offset, ratio), fflush(stdout);
                ck_assert(ratio > 0.6 && ratio < 1.6);
            }
        }
}
END_TEST

/* A range of alpha of no width is one of next to none; its middle was taken once for what the normal force does not move (3 times off). */
START_TEST(a_range_of_alpha_without_width)
{
    for (int i = 0; i < WAYS; i++) {
        double none = stiffness("plane", 2, "limiter: {alpha_min: 1 cm, alpha_max: 1 cm}, ", ways[i]), some = stiffness("plane", 2, "limiter: {alpha_min: 1 cm, alpha_max: 1.000001 cm}, ", ways[i]);
        printf("%s: %.6g, %.6g\n", ways[i], none, some), fflush(stdout);
        ck_assert_double_eq_tol(none / some, 1, 1e-3);
    }
}
END_TEST

UNIT("roll_eccentric", an_offset_is_no_roughness, a_range_of_alpha_without_width)
