/* The scraping force in the plane: maps and formulas under straight and curved paths, against a slow judge
   (tests/unit/judge.h), turned, and its momentum. */
#include <unistd.h>

#include "plane.h"

static double against_judge(struct relief_part *(*relief)(struct arena *, const struct contact *), const char *contact,
                            const char *motion, long frames)
{
    struct scene s = plane_scene(relief, arena_format(rig_arena(), "contact: %s\nmotion: %s\n", contact, motion));
    return judge_difference(&s, frames);
}

static const char *const unlimited = "{beta1: 0, smoothing: 0, limiter: {curve: none}}", *const limited =
                                                                                             "{beta1: 0, smoothing: 0}";

/* Along a row or column curvature is a straight line between knots. Elsewhere it is taken as a parabola over each
   stretch of 1 um, which T (alpha c is about 300) makes 1e-5 to 1e-4 of. */
START_TEST(map_under_a_straight_path)
{
    static const char *const to[] = {"[9 mm, 2.3 mm]", "[1.1 mm, -8 mm]", "[12 mm, 5 mm]", "[-7 mm, 3 mm]",
                                     "[7 mm, 7 mm]"};
    for (int k = 0; k < 5; k++) {
        const char *motion =
            arena_format(rig_arena(), "{path: line, from: [1.1 mm, 2.3 mm], to: %s, speed: 20 cm/s}", to[k]);
        ck_assert_double_lt(against_judge(plane_rough_map, unlimited, motion, 600), 5e-6);
        ck_assert_double_lt(against_judge(plane_rough_map, limited, motion, 600), k < 2 ? 1e-6 : 1e-4);
    }
}
END_TEST

/* The same in all quadrants, either way round, tight and wide; 0.1 mm is 20 samples of the map: the path turns by 0.01
 * in each sub-interval. */
START_TEST(map_under_a_circle)
{
    static const char *const circle[] = {"radius: 5 mm, turns: 0.5", "radius: 5 mm, turns: -0.5, start_angle: 1",
                                         "radius: 1 mm, turns: 2", "radius: 0.1 mm, turns: -20"};
    static const double bounds[] = {2e-6, 2e-6, 2e-6, 1e-5};
    for (int k = 0; k < 4; k++) {
        const char *motion =
            arena_format(rig_arena(), "{path: circle, center: [0, 1 mm], %s, speed: 20 cm/s}", circle[k]);
        ck_assert_double_lt(against_judge(plane_rough_map, unlimited, motion, 1000), bounds[k]);
        ck_assert_double_lt(against_judge(plane_rough_map, limited, motion, 1000), 1e-4);
    }
}
END_TEST

/* A formula has no knots; its pieces are as fine as it asks for. Both forces; a circle's memory of its slope goes round
 * with it. */
START_TEST(formula_under_curved_paths)
{
    static const char *const motions[] = {
        "{path: line, to: [5 mm, 3 mm], law: minimum_jerk, duration: 20 ms}",
        "{path: circle, radius: 2 mm, speed: 20 cm/s}",
        "{path: spline, points: [[0, 0], [1 mm, 1 mm], [2 mm, 0], [1 mm, -1 mm]], duration: 30 ms}",
        "{path: scribble, size: [3 mm, 2 mm], rate: 20 Hz, duration: 30 ms}"};
    plane_wave.amplitude = 2e-6, plane_wave.length = 0.4e-3, plane_wave.angle = 0.7, plane_wave.finest = 2e-6;
    for (int k = 0; k < 4; k++) {
        ck_assert_double_lt(against_judge(plane_wave_part, unlimited, motions[k], 900), 2e-6);
        ck_assert_double_lt(against_judge(plane_wave_part, limited, motions[k], 900), 3e-6);
        ck_assert_double_lt(against_judge(plane_wave_part, "{beta1: 5, smoothing: 0}", motions[k], 900), 1e-4);
    }
}
END_TEST

/* ------------------------------------------------------------------ rotation */

/* The sub-forces of a stroke of 1 mm from a point near the origin at that angle, over the wave at its angle. */
static struct rig *stroke_at(double angle, const char *contact, bool map)
{
    struct scene s = plane_scene(
        map ? plane_wave_map : plane_wave_part,
        arena_format(rig_arena(), "contact: %s\nmotion: {path: line, to: [1 mm, 0], speed: 20 cm/s}\n", contact));
    struct motion *m = &s.contacts[0].motion;
    m->from[0] = m->from[1] = map ? 0.2e-3 : 0;
    m->to[0] = m->from[0] + 1e-3 * cos(angle);
    m->to[1] = m->from[1] + 1e-3 * sin(angle);
    return rig_record(&s, ITEM_SUBFORCE, 200, 1024);
}

/* Relative rms difference of b from `ratio` times a. */
static double difference(const struct rig *a, const struct rig *b, double ratio)
{
    double off = 0, all = 0;
    for (long i = 0; i < a->frames * a->per_frame; i++) {
        off += pow(b->x[i] - ratio * a->x[i], 2);
        all += pow(ratio * a->x[i], 2);
    }
    ck_assert_double_gt(all, 0);
    return sqrt(off / all);
}

/* Wave and path turned together: the same force, to the rounding of places (1e-16 m of 1 mm at a wave of 0.4 mm). */
START_TEST(turned_with_the_wave)
{
    static const double between[] = {0, 20, 60}, turned[] = {15, 30, 45, 100, -80, 180};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 6; i++) {
            double degree = M_PI / 180;
            plane_wave.amplitude = 2e-6, plane_wave.length = 0.4e-3, plane_wave.finest = 10e-6;
            plane_wave.angle = between[k] * degree;
            struct rig *straight = stroke_at(0, "{smoothing: 0}", false);
            plane_wave.angle = (between[k] + turned[i]) * degree;
            struct rig *g = stroke_at(turned[i] * degree, "{smoothing: 0}", false);
            ck_assert_double_lt(difference(straight, g, 1), 1e-10);
            rig_close(straight);
            rig_close(g);
        }
}
END_TEST

/* The same on a map of 200 samples a wave: 1e-3 asked for; the spline's own error of curvature is (2 pi / 200)^2 / 12 =
 * 8e-5. */
START_TEST(turned_on_a_map)
{
    plane_wave.amplitude = 2e-6, plane_wave.length = 0.4e-3, plane_wave.finest = 2e-6;
    for (int angle = 0; angle <= 45; angle += 15)
        for (int none = 0; none < 2; none++) {
            plane_wave.angle = angle * M_PI / 180;
            const char *contact = none ? "{smoothing: 0, limiter: {curve: none}}" : "{smoothing: 0}";
            struct rig *map = stroke_at(plane_wave.angle, contact, true);
            double phase = 2 * M_PI / plane_wave.length * 0.2e-3 * (cos(plane_wave.angle) + sin(plane_wave.angle)),
                   turn = plane_wave.angle;
            plane_wave.angle = 0; /* the wave along x, begun where the stroke's start is in its phase */
            struct scene s = plane_scene(
                plane_wave_part,
                arena_format(rig_arena(), "contact: %s\nmotion: {path: line, to: [1 mm, 0], speed: 20 cm/s}\n",
                             contact));
            s.contacts[0].motion.from[0] = phase / (2 * M_PI) * plane_wave.length;
            s.contacts[0].motion.to[0] = s.contacts[0].motion.from[0] + 1e-3;
            struct rig *straight = rig_record(&s, ITEM_SUBFORCE, 200, 1024);
            double off = difference(straight, map, 1);
            printf("map turned by %g degrees: %.2g\n", turn * 180 / M_PI, off);
            ck_assert_double_lt(off, 2e-4);
            rig_close(map);
            rig_close(straight);
        }
}
END_TEST

/* The printed equations, without limiter: (cos^4 + sin^4) of the force along an axis. */
START_TEST(printed_equations_turned)
{
    static const double angle[] = {15, 30, 45}, ratio[] = {0.875, 0.625, 0.5};
    const char *const contact = "{force: paper, beta1: 0, smoothing: 0, limiter: {curve: none}}";
    plane_wave.amplitude = 2e-6, plane_wave.length = 0.4e-3, plane_wave.finest = 2e-6;
    for (int map = 0; map < 2; map++)
        for (int k = 0; k < 3; k++) {
            plane_wave.angle = 0;
            struct rig *straight = stroke_at(0, contact, false);
            plane_wave.angle = angle[k] * M_PI / 180;
            struct rig *g = stroke_at(plane_wave.angle, contact, map);
            if (map) { /* begins elsewhere in the wave: compare sizes over whole waves, 2 of them in 0.8 mm */
                double a = 0, b = 0;
                for (long i = 1; i <= 768; i++) {
                    a += straight->x[i] * straight->x[i];
                    b += g->x[i] * g->x[i];
                }
                ck_assert_double_eq_tol(sqrt(b / a), ratio[k], 2e-4);
            } else {
                ck_assert_double_lt(difference(straight, g, ratio[k]), 1e-10);
            }
            rig_close(straight);
            rig_close(g);
        }
}
END_TEST

/* ------------------------------------------------------------------ momentum */

/* From rest to rest nothing is left of the sum of f dt, whatever lies between: reversals, corners, pauses, curves. (Of
   sum |f| dt; the motion's end is a sample's edge.) */
START_TEST(from_rest_to_rest)
{
    static const char *const motions[] = {
        "{path: back_and_forth, to: [5 mm, 3 mm], rate: 20 Hz, duration: 0.1 s}",
        "{path: four_in_line, to: [5 mm, 3 mm], duration: 0.1 s}",
        "{path: line, to: [5 mm, 3 mm], law: minimum_jerk, duration: 0.05 s}",
        "{path: polyline, points: [[0, 0], [3 mm, 1 mm], [1 mm, 2 mm], [1 mm, 0]], duration: 0.1 s}",
        "{path: polyline, points: [[0, 0], [3 mm, 1 mm], [0, 0]], duration: 0.1 s}"};
    for (int k = 0; k < 5; k++) {
        struct scene s = plane_scene(
            plane_rough_map, arena_format(rig_arena(), "contact: {beta1: 0, smoothing: 0}\nmotion: %s\n", motions[k]));
        struct rig *g = rig_record(&s, ITEM_SUBFORCE, 5000, 1024);
        double sum = 0, all = 0;
        for (long i = 0; i < 5000 * g->per_frame; i++) {
            sum += g->x[i];
            all += fabs(g->x[i]);
        }
        printf("momentum %s: %.2g of what was exchanged\n", motions[k], fabs(sum) / all);
        ck_assert_double_gt(all, 0);
        ck_assert_double_lt(fabs(sum), 1e-10 * all);
        rig_close(g);
    }
}
END_TEST

/* At every instant the sum of f dt is the mean of m v S' over the sub-interval that begins there, with the judge's S':
   on a profile to what the leak's weight leaves out, on curved paths to that of the force. Through reversals, at
   varying speed. */
static void check_momentum(struct scene *s, long frames, double tolerance)
{
    struct rig *g = rig_record(s, ITEM_SUBFORCE, frames, 1024);
    struct judge j = judge_of(g);
    long n = frames * g->per_frame;
    double *force = calloc((size_t)n, sizeof *force), *momenta = calloc((size_t)n, sizeof *momenta),
           dt = 1 / (48000.0 * g->per_frame);
    double sum = 0, all = 0, worst = 0;
    judge_run(&j, n, dt, force, momenta);
    for (long i = 0; i < n; i++) {
        sum += g->x[i] * dt;
        all += fabs(g->x[i]) * dt;
        worst = fmax(worst, fabs(sum - momenta[i]));
    }
    printf("momentum off by %.2g of what was exchanged\n", worst / all);
    ck_assert_double_lt(worst, tolerance * all);
    free(force);
    free(momenta);
    rig_close(g);
}

START_TEST(momentum_is_that_of_the_slope)
{
    const char *const contact = "contact: {beta1: 0, smoothing: 0}\n";
    struct scene s = rig_scene(
        rig_arena(),
        arena_format(rig_arena(),
                     "rasp: 1\noutput: {diagnostics: {}}\nload: {approach: 0, release: 0}\nscraper: {mass: 20 g}\n"
                     "surface: {roughness: {rms: 5 um}}\n%s"
                     "motion: {path: back_and_forth, to: [4 mm, 0], rate: 30 Hz, duration: 0.05 s}\n",
                     contact));
    check_momentum(&s, 2300, 1e-8);
    s = plane_scene(plane_rough_map,
                    arena_format(rig_arena(),
                                 "%smotion: {path: back_and_forth, to: [5 mm, 3 mm], rate: 20 Hz, duration: 0.1 s}\n",
                                 contact));
    check_momentum(&s, 4800, 1e-6);
    s = plane_scene(plane_rough_map,
                    arena_format(rig_arena(), "%smotion: {path: circle, radius: 3 mm, speed: 30 cm/s}\n", contact));
    check_momentum(&s, 3000, 1e-6);
    s = plane_scene(plane_rough_map,
                    arena_format(rig_arena(),
                                 "%smotion: {path: scribble, size: [4 mm, 3 mm], rate: 10 Hz, duration: 50 ms}\n",
                                 contact));
    check_momentum(&s, 2400, 1e-6);
}
END_TEST

/* A hand's recording: there, a pause of 0.1 s, a reversal through the same point, a loop. */
START_TEST(momentum_on_a_recorded_path)
{
    char file[] = "/tmp/test_scrape_plane.XXXXXX.csv";
    int handle = mkstemps(file, 4);
    ck_assert_int_ge(handle, 0);
    dprintf(handle, "time_s,x_m,y_m\n");
    for (int i = 0; i <= 60; i++) {
        double t = 0.005 * i, x = 0.05 * t, y = 0.02 * t;
        if (i > 10) {
            int k = i < 30 ? 0 : i - 30; /* rests, then */
            x = 2.5e-3 - 2e-3 * sin(0.12 * k);
            y = 1e-3 + 0.8e-3 * (cos(0.24 * k) - 1) - 0.8e-3 * sin(0.12 * k);
        }
        dprintf(handle, "%.17g,%.17g,%.17g\n", t, x, y);
    }
    close(handle);
    struct scene s = plane_scene(
        plane_rough_map,
        arena_format(rig_arena(), "contact: {beta1: 0, smoothing: 0}\nmotion: {path: recorded, file: %s}\n", file));
    check_momentum(&s, 14000, 1e-6);
    remove(file);
}
END_TEST

UNIT("scrape_plane", map_under_a_straight_path, map_under_a_circle, formula_under_curved_paths, turned_with_the_wave,
     turned_on_a_map, printed_equations_turned, from_rest_to_rest, momentum_is_that_of_the_slope,
     momentum_on_a_recorded_path)
