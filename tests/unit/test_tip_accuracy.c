/* What accuracy.tip_heights buys: ridges across the path are the same surface extruded (surface.along: x, heights twice
   as dense) and in the plane (another lattice, another search), so that the two forces differ by what the heights
   between the samples are worth. */
#include "rig.h"

static struct rig *force(const char *along, int heights)
{
    struct arena *a = rig_arena();
    struct scene s = rig_scene(
        a, arena_format(
               a,
               "rasp: 1\nsurface: {along: %s, ridges: {spacing: 2 mm, height: 20 um, jitter: 0.1, variation: 0.2}}\n"
               "scraper: {mass: 20 g, radius: 1 mm, patch: 20 um}\nload: {approach: 0 s, release: 0 s}\n"
               "motion: {path: line, from: [10 cm, 0], to: [10.5 cm, 0], speed: 10 cm/s}\n"
               "accuracy: {preset: standard, tip_heights: %d}\noutput: {diagnostics: {}}\n",
               along, heights));
    return rig_record(&s, ITEM_FORCE, 2400, 1024);
}

static double distance_agreement(int heights)
{
    struct rig *x = force("x", heights), *plane = force("plane", heights);
    double all = 0, off = 0;
    for (long i = 0; i < x->frames; i++) {
        all += x->x[i] * x->x[i];
        off += (x->x[i] - plane->x[i]) * (x->x[i] - plane->x[i]);
    }
    rig_close(x), rig_close(plane);
    printf("%d times: %.1f dB\n", heights, 10 * log10(all / off));
    return 10 * log10(all / off);
}

/* The heights of the plane only tell which crest bears the ball; where it touches is found on the surface itself. By
   heights alone the two agree to 37, 47 and 60 dB. */
START_TEST(denser_heights_agree_better)
{
    double once = distance_agreement(1), twice = distance_agreement(2), four = distance_agreement(4);
    ck_assert_double_gt(once, 55);
    ck_assert_double_gt(twice, once + 20);
    ck_assert_double_gt(four, twice + 20);
}
END_TEST

UNIT("tip_accuracy", denser_heights_agree_better)
