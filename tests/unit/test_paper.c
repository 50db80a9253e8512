/* The printed equations (contact.force: paper) on profiles and in the plane: means by hats against many point values of
   the formulas, the limit of each axis, and each axis's smoothing. */
#include "plane.h"

static const char *const head = "rasp: 1\n"
                                "seed: 5\n"
                                "output: {diagnostics: {}, sample_rate: 48000}\n"
                                "load: {approach: 0, release: 0}\n"
                                "scraper: {mass: 20 g}\n";

static struct scene made(const char *rest)
{
    return rig_scene(rig_arena(), arena_format(rig_arena(), "%s%s", head, rest));
}

/* An item of the printed force, which is made with all others. */
static struct rig *recorded(struct scene *s, enum item item, long frames)
{
    rig_probe.also = ITEM_BIT(ITEM_SUBFORCE);
    return rig_record(s, item, frames, 1024);
}

/* ------------------------------------------------------------------ equations 2 to 5 */

struct point {
    double xx, yy, slope, v[2], force; /* limited curvatures, dz/dt, m/s, N */
};

/* Equations 2 to 5 at an instant. */
static struct point printed_at(const struct judge *j, double t)
{
    struct judge_place p = judge_at(j, t);
    double ratio = limiter_of(j->c)->ratio_y;
    double x, y = 0, h[3], vx = p.v * p.e[0], vy = p.v * p.e[1];
    bool plane = j->b->relief->along == ALONG_PLANE;
    judge_bend(j, &p, h);
    relief_at(j->b->relief, &(struct relief_points){1, &p.x, plane ? &p.y : NULL},
              &(struct relief_values){.x = &x, .y = plane ? &y : NULL});
    struct point r = {.xx = judge_limited(j, j->alpha, h[0]),
                      .yy = plane ? judge_limited(j, j->alpha * ratio, h[2]) : 0,
                      .slope = vx * x + vy * y,
                      .v = {vx, vy}};
    r.force =
        j->c->scraper.mass * (r.xx * vx * vx + r.yy * vy * vy) + j->law->beta1 * pow(fabs(r.slope), j->law->beta2);
    return r;
}

/* Relative rms difference of the sub-forces from the mean by each hat of 200 point values a sub-interval; but for the
   first, half of which is before the start, where curvature is that of the first place and nothing moves. */
static double against_formulas(struct scene *s, long frames)
{
    struct rig *g = rig_record(s, ITEM_SUBFORCE, frames, 1024);
    struct judge j = judge_of(g);
    double off = 0, all = 0, late = 0, dt = 1 / (48000.0 * g->per_frame);
    for (long i = 0; i < frames * g->per_frame; i++) {
        double mean = late;
        late = 0;
        for (int k = 0; k < 200; k++) {
            double q = (k + 0.5) / 200, force = printed_at(&j, ((double)i + q) * dt).force / 200;
            mean += (1 - q) * force;
            late += q * force;
        }
        off += i > 0 ? (g->x[i] - mean) * (g->x[i] - mean) : 0;
        all += mean * mean;
    }
    printf("relative rms difference %.3g (rms force %.3g N)\n", sqrt(off / all),
           sqrt(all / (double)(frames * g->per_frame)));
    ck_assert_double_gt(all, 0);
    rig_close(g);
    return sqrt(off / all);
}

/* On a profile, at an angle: Simpson's rule on |z'|^1.5 near its zeros, and the judge's 200 points. */
START_TEST(on_a_profile)
{
    struct scene s = made(
        "surface: {roughness: {rms: 5 um}, along: x}\ncontact: {force: paper, beta1: 0.2, beta2: 1.5, smoothing: 0 s}\n"
        "motion: {path: line, from: [1 cm, 0], to: [1.6 cm, 8 mm], speed: 20 cm/s}\n");
    ck_assert_double_lt(against_formulas(&s, 300), 1e-3);
}
END_TEST

/* On a map, straight and round: S_xx and S_yy limited each by its own alpha; the slope of equation 3 is that of z. The
   judge's points leave 1e-5 where T steps. */
START_TEST(in_the_plane)
{
    static const char *const contacts[] = {"beta1: 0, limiter: {ratio_y: 1}", "beta1: 0, limiter: {ratio_y: 0.3}",
                                           "beta1: 0, limiter: {curve: none}", "beta1: 2, limiter: {ratio_y: 3}",
                                           "beta1: 2, beta2: 1.5, limiter: {ratio_y: 3}"};
    static const char *const motions[] = {"{path: line, to: [8 mm, 3 mm], speed: 20 cm/s}",
                                          "{path: circle, radius: 2 mm, speed: 20 cm/s}"};
    static const double bounds[] = {1e-4, 1e-4, 3e-5, 1e-4, 1e-3};
    for (int k = 0; k < 5; k++)
        for (int m = 0; m < 2; m++) {
            struct scene s = plane_scene(
                plane_rough_map, arena_format(rig_arena(), "contact: {force: paper, smoothing: 0, %s}\nmotion: %s\n",
                                              contacts[k], motions[m]));
            ck_assert_double_lt(against_formulas(&s, 200), bounds[k]);
        }
}
END_TEST

/* A wave along y is not felt by S_xx, nor one along x by S_yy, whatever the path; T of one does not hear the other. */
START_TEST(axes_are_limited_apart)
{
    for (int axis = 0; axis < 2; axis++) {
        plane_wave.amplitude = 5e-6, plane_wave.length = 0.3e-3, plane_wave.finest = 4e-6;
        plane_wave.angle = axis ? M_PI / 2 : 0;
        const char *rest = "contact: {force: paper, beta1: 0, smoothing: 0, limiter: {alpha: 2 cm, ratio_y: 0.5}}\n"
                           "motion: {path: line, to: [3 mm, 3 mm], speed: 20 cm/s}\n";
        struct scene s = plane_scene(plane_wave_part, rest);
        struct rig *xx = recorded(&s, ITEM_CURVATURE, 700), *yy = recorded(&s, ITEM_CURVATURE_Y, 700);
        double most[2] = {0, 0}, k = 2 * M_PI / plane_wave.length, c = plane_wave.amplitude * k * k;
        for (long i = 0; i < 2800; i++) {
            most[0] = fmax(most[0], fabs(xx->x[i]));
            most[1] = fmax(most[1], fabs(yy->x[i]));
        }
        double alpha = axis ? 0.01 : 0.02;
        ck_assert_double_eq_tol(most[axis], tanh(alpha * c) / alpha, 1e-5 / alpha);
        ck_assert_double_lt(most[1 - axis], 1e-9 * c);
        rig_close(xx);
        rig_close(yy);
    }
}
END_TEST

/* ------------------------------------------------------------------ smoothing */

/* Spread of one item by smoothing: the standard deviation of the Gaussian, in seconds, that makes the smoothed signal
   of the raw one, by the ratio of their spectra at one frequency: exp(-(2 pi f sigma)^2 / 2). */
static double measured_sigma(enum item item, const char *limiter, double smoothing, double frequency)
{
    double size[2];
    for (int smooth = 0; smooth < 2; smooth++) {
        struct scene s =
            plane_scene(plane_rough_map, arena_format(rig_arena(),
                                                      "contact: {force: paper, limiter: %s}\n"
                                                      "motion: {path: line, to: [9 cm, 4 cm], speed: 20 cm/s}\n",
                                                      limiter));
        *(double *)rig_edit(&s, &smooth_stage) = smooth ? smoothing : 0;
        struct rig *g = recorded(&s, item, 12000);
        double re = 0, im = 0;
        for (long i = 0; i < 48000; i++) {
            double t = (double)i / 192000, window = 1 - cos(2 * M_PI * (double)i / 48000);
            re += window * g->x[i] * cos(2 * M_PI * frequency * t);
            im += window * g->x[i] * sin(2 * M_PI * frequency * t);
        }
        size[smooth] = sqrt(re * re + im * im);
        rig_close(g);
    }
    return sqrt(-2 * log(size[1] / size[0])) / (2 * M_PI * frequency);
}

/* sigma_x = smoothing alpha_x / 3 cm, sigma_y = ratio_y sigma_x; the window lets 1e-3 of lower frequencies through. */
START_TEST(each_axis_has_its_sigma)
{
    static const double ratios[] = {1, 0.5, 1.7};
    for (int k = 0; k < 3; k++) {
        const char *limiter = arena_format(rig_arena(), "{alpha: 2 cm, ratio_y: %g}", ratios[k]);
        double x = measured_sigma(ITEM_CURVATURE, limiter, 60e-6, 1501),
               y = measured_sigma(ITEM_CURVATURE_Y, limiter, 60e-6, 1501);
        printf("sigma of x %.5g us, of y %.5g us\n", x * 1e6, y * 1e6);
        ck_assert_double_eq_tol(x, 40e-6, 0.01 * x);
        ck_assert_double_eq_tol(y, ratios[k] * 40e-6, 0.01 * y);
    }
}
END_TEST

/* Smoothing acts before the force is formed: f_v is m (S_xx v_x^2 + S_yy v_y^2) of the smoothed curvatures. */
START_TEST(force_of_the_smoothed_curvatures)
{
    const char *rest = "contact: {force: paper, beta1: 0, limiter: {ratio_y: 2}}\nmotion: {path: circle, radius: 3 mm, "
                       "speed: 20 cm/s}\n";
    struct scene s = plane_scene(plane_rough_map, rest);
    struct rig *xx = recorded(&s, ITEM_CURVATURE, 1000), *yy = recorded(&s, ITEM_CURVATURE_Y, 1000),
               *force = rig_record(&s, ITEM_SUBFORCE, 1000, 1024);
    double off = 0, all = 0;
    for (long i = 1; i < 4000; i++) {
        double angle = 0.2 / 3e-3 * (double)i / 192000, vx = -0.2 * sin(angle), vy = 0.2 * cos(angle);
        double want = 0.02 * (xx->x[i] * vx * vx + yy->x[i] * vy * vy);
        off += pow(force->x[i] - want, 2);
        all += want * want;
    }
    ck_assert_double_lt(sqrt(off / all), 1e-7);
    rig_close(xx);
    rig_close(yy);
    rig_close(force);
}
END_TEST

/* ------------------------------------------------------------------ the rest of it */

/* At rest, after the motion, curvature is that of the last point touched. Without the limiter it differs from the mean
   before it; the motion ends off every chunk's edge. The same bits however the frames are cut into blocks. */
START_TEST(blocks_do_not_matter)
{
    const char *rest = "contact: {force: paper, limiter: {curve: none}}\n";
    for (int plane = 0; plane < 2; plane++) {
        struct scene s =
            plane ? plane_scene(
                        plane_rough_map,
                        arena_format(rig_arena(), "%smotion: {path: circle, radius: 1 mm, speed: 15 cm/s}\n", rest))
                  : made(arena_format(rig_arena(),
                                      "surface: {roughness: {rms: 5 um}}\n%s"
                                      "motion: {path: line, from: [1 cm, 0], to: [1.437 cm, 0], speed: 10 cm/s}\n",
                                      rest));
        struct rig *one = rig_record(&s, ITEM_FORCE, 3000, 1024), *other = rig_record(&s, ITEM_FORCE, 3000, 77);
        ck_assert_mem_eq(one->x, other->x, 3000 * sizeof *one->x);
        rig_close(one);
        rig_close(other);
        struct rig *c = recorded(&s, ITEM_CURVATURE, 3000);
        struct judge j = judge_of(c);
        *(double *)rig_edit(&s, &smooth_stage) = 0;
        rig_close(c);
        c = recorded(&s, ITEM_CURVATURE, 3000);
        j = judge_of(c);
        double touched = printed_at(&j, c->run.board.trajectory->duration).xx;
        for (long i = 2600 * 4; i < 12000; i++)
            ck_assert_double_eq_tol(c->x[i], touched, 1e-9 * fabs(touched));
        rig_close(c);
    }
}
END_TEST

/* Straight across a profile along x nothing changes: no force. */
START_TEST(across_a_profile)
{
    struct scene s = made("surface: {roughness: {}, along: x}\ncontact: {force: paper}\nmotion: {path: line, to: [0, 5 "
                          "cm], speed: 0.1}\n");
    struct rig *g = rig_record(&s, ITEM_FORCE, 3000, 1024);
    for (long i = 0; i < 3000; i++)
        ck_assert(g->x[i] == 0);
    rig_close(g);
}
END_TEST

UNIT("paper", on_a_profile, in_the_plane, axes_are_limited_apart, each_axis_has_its_sigma,
     force_of_the_smoothed_curvatures, blocks_do_not_matter, across_a_profile)
