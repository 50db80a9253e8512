/* Hard cases of the force on maps and curved paths, with floating-point traps on (invalid, division by zero, overflow).
 */
#include <fenv.h>

#include "force/scrape.h"
#include "plane.h"
#include "scene/params.h"
#include "surface/limiter.h"

enum { SIDE = 64 };

static double spike_height;

/* Flat at 1 mm, but for one sample. */
static struct relief_part *spike_map(struct arena *a, const struct contact *c)
{
    const struct height_map_file *map = params_of(c, height_map_stage.params);
    double *z = ARENA_TAKE(a, double, SIDE *SIDE);
    for (int i = 0; i < SIDE * SIDE; i++)
        z[i] = 1e-3;
    z[20 * SIDE + 20] += spike_height;
    return height_map_part(a, height_map_spline(a, &(struct height_map){z, SIDE, SIDE, {5e-6, 5e-6}}, map->off_map),
                           (double[]){0, 0}, "spike");
}

/* The item's values, traps on; the scene's alpha if not NAN. */
static struct rig *trapped(struct scene *s, enum item item, long frames)
{
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    rig_probe.also = item == ITEM_SUBFORCE ? 0 : ITEM_BIT(ITEM_SUBFORCE);
    struct rig *g = rig_record(s, item, frames, 1024);
    fedisableexcept(FE_ALL_EXCEPT);
    return g;
}

static double peak_of(struct scene *s, enum item item, long frames)
{
    struct rig *g = trapped(s, item, frames);
    double most = 0;
    for (long i = 0; i < frames * g->per_frame; i++) {
        ck_assert(isfinite(g->x[i]));
        most = fmax(most, fabs(g->x[i]));
    }
    rig_close(g);
    return most;
}

static const char *const motions[] = {"{path: line, to: [3 mm, 2.9 mm], speed: 20 cm/s}",
                                      "{path: line, to: [3 mm, 0], speed: 2 m/s}",
                                      "{path: circle, radius: 0.2 mm, center: [0.1 mm, 0.3 mm], speed: 20 cm/s}",
                                      "{path: back_and_forth, to: [0.3 mm, 0.3 mm], rate: 100 Hz, duration: 20 ms}"};

/* A flat map gives exactly nothing, wherever it lies. */
START_TEST(flat_map)
{
    for (int k = 0; k < 4; k++)
        for (int paper = 0; paper < 2; paper++) {
            struct scene s = plane_scene(spike_map, arena_format(rig_arena(), "contact: {%s}\nmotion: %s\n",
                                                                 paper ? "force: paper" : "", motions[k]));
            spike_height = 0;
            ck_assert(peak_of(&s, ITEM_SUBFORCE, 700) == 0);
        }
}
END_TEST

/* One sample sticks out, by so much that alpha z'' reaches 1e9: curvature within 1/alpha, the force within m (2 v^2 +
 * |a| l) / alpha; it is felt. */
START_TEST(spike)
{
    static const double heights[] = {1e-9, 1e-6, 1e-3}, alphas[] = {1e-6, 0.03, 1000},
                        speeds[] = {0.2, 2, 0.2, M_PI * 100 * 0.3e-3 * M_SQRT2};
    for (int n = 0; n < 72; n++) {
        int k = n / 9 % 4;
        bool paper = n >= 36;
        double alpha = alphas[n % 3], v = speeds[k], acceleration = k == 3 ? 2 * M_PI * 100 * v : 0;
        struct scene s = plane_scene(
            spike_map, arena_format(rig_arena(), "contact: {beta1: 0, smoothing: 0, force: %s}\nmotion: %s\n",
                                    paper ? "paper" : "directional", motions[k]));
        ((struct limiter *)rig_edit(&s, &limiter_stage))->alpha = alpha;
        ((struct height_map_file *)params_edit(&s.contacts[0], height_map_stage.params, rig_arena()))->off_map =
            n % 2 ? OFF_MAP_WRAP : OFF_MAP_MIRROR;
        spike_height = heights[n / 3 % 3];
        double peak = peak_of(&s, ITEM_SUBFORCE, 700);
        ck_assert_double_le(peak, 0.02 / alpha * (2 * v * v + acceleration * 2e-3) * (1 + 1e-6));
        ck_assert(k == 1 || peak > 0);
        if (paper) {
            ck_assert_double_le(peak_of(&s, ITEM_CURVATURE, 700), (1 + 1e-7) / alpha);
            ck_assert_double_le(peak_of(&s, ITEM_CURVATURE_Y, 700), (1 + 1e-7) / alpha);
        }
    }
}
END_TEST

/* alpha to 0: the unlimited force, to 1e-12 of it; alpha of 1 km: finite and within 1/alpha. */
START_TEST(limits_of_the_limiter)
{
    for (int k = 0; k < 4; k++)
        for (int paper = 0; paper < 2; paper++) {
            struct scene s = plane_scene(plane_rough_map,
                                         arena_format(rig_arena(), "contact: {smoothing: 0, force: %s}\nmotion: %s\n",
                                                      paper ? "paper" : "directional", motions[k]));
            struct limiter *limiter = rig_edit(&s, &limiter_stage);
            limiter->curve = LIMITER_NONE;
            struct rig *none = trapped(&s, ITEM_SUBFORCE, 700);
            limiter->curve = LIMITER_TANH;
            limiter->alpha = 1e-11;
            struct rig *tiny = trapped(&s, ITEM_SUBFORCE, 700);
            double most = 0;
            for (long i = 0; i < 2800; i++)
                most = fmax(most, fabs(none->x[i]));
            for (long i = 0; i < 2800; i++)
                ck_assert_double_eq_tol(tiny->x[i], none->x[i], 1e-12 * most);
            rig_close(none);
            rig_close(tiny);
            limiter->alpha = 1000;
            ((struct scrape_law *)rig_edit(&s, &scrape_stage))->beta1 = 0;
            ck_assert_double_lt(peak_of(&s, ITEM_SUBFORCE, 700), 0.02 / 1000 * (2 * 4 + 400 * 2e-3));
        }
}
END_TEST

/* 2 m/s: 8.3 samples of the map in an audio sample. No asperity is skipped: the judge, which visits them all, finds the
   same force and momentum. Of one sub-interval cells are as long as a sample of the map, of four a quarter of it. */
START_TEST(eight_samples_in_one)
{
    static const char *const fast[] = {"{path: line, to: [20 mm, 1 mm], speed: 2 m/s}",
                                       "{path: circle, radius: 10 mm, speed: 2 m/s}",
                                       "{path: circle, radius: 1 mm, speed: 2 m/s}"};
    for (int k = 0; k < 6; k++) {
        struct scene s = plane_scene(plane_rough_map, arena_format(rig_arena(),
                                                                   "contact: {beta1: 0, smoothing: 0}\n"
                                                                   "accuracy: {oversampling: %d}\nmotion: %s\n",
                                                                   k < 3 ? 1 : 4, fast[k % 3]));
        double d = judge_difference(&s, 150);
        printf("%s, %d: %g\n", fast[k % 3], k < 3 ? 1 : 4, d);
        ck_assert_double_lt(d, k < 3 ? 2e-3 : 2e-5);
    }
}
END_TEST

/* Rests: nothing moves, nothing is heard, and it goes on from there as it was. Corners, cusps and hairpins, with and
 * without a stop. */
START_TEST(rests_and_corners)
{
    static const char *const stops[] = {
        "{path: four_in_line, to: [2 mm, 1 mm], duration: 40 ms}",
        "{path: polyline, points: [[0, 0], [2 mm, 0], [2 mm, 2 mm], [0, 0]], duration: 40 ms}",
        "{path: polyline, points: [[0, 0], [2 mm, 0], [2 mm, 2 mm], [0, 0.1 mm]], corner: 10 um, law: constant, "
        "duration: 40 ms}",
        "{path: polyline, points: [[0, 0], [2 mm, 0], [0, 0.1 mm], [2 mm, 0.2 mm]], corner: 1 um, law: constant, "
        "duration: 40 ms}",
        "{path: polyline, points: [[0, 0], [2 mm, 1 mm], [0, 0], [2 mm, 1 mm]], law: harmonic, duration: 40 ms}",
        "{path: polyline, points: [[0, 0], [2 mm, 0], [2 mm, 2 mm]], corner: 0.2 mm, law: two_thirds, duration: 40 ms}",
        "{path: spline, points: [[0, 0], [2 mm, 0], [2 mm, 1 mm], [0, 0]], duration: 40 ms}",
        "{path: scribble, size: [2 mm, 1 mm], rate: 50 Hz, duration: 40 ms}",
        "{path: line, to: [0.01 mm, 0.02 mm], duration: 40 ms}",
        "{path: circle, radius: 0.1 mm, turns: 30, duration: 40 ms}",
    };
    for (size_t k = 0; k < sizeof stops / sizeof stops[0]; k++)
        for (int paper = 0; paper < 2; paper++) {
            struct scene s =
                plane_scene(plane_rough_map,
                            arena_format(rig_arena(), "contact: {smoothing: 0, beta2: 0.7, force: %s}\nmotion: %s\n",
                                         paper ? "paper" : "directional", stops[k]));
            double peak = peak_of(&s, ITEM_SUBFORCE, 2500);
            printf("%s: %.3g N\n", stops[k], peak);
            ck_assert_double_gt(peak, 0);
            ck_assert_double_lt(peak, 100);
        }
}
END_TEST

UNIT("hard_plane", flat_map, spike, UNIT_LONG(limits_of_the_limiter), eight_samples_in_one, rests_and_corners)
