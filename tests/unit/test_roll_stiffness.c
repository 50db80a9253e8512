/* How a ball lies in its contact: from both materials, its weight and the ground, and from nothing of the motion; and
   the ground's roughness by second differences, against closed forms. */

#include "force/hertz.h"
#include "force/roll.h"
#include "rig.h"

/* ------------------------------------------------------------------ the ground's roughness */

static double wave_height, wave_length, wave_tilt, wave_heading;

static void wave_add(struct relief_part *p, const struct relief_points *at, const struct relief_values *to)
{
    double q = 2 * M_PI / wave_length, ex = cos(wave_heading), ey = sin(wave_heading);
    (void)p;
    for (size_t i = 0; i < at->n; i++) {
        double u = ex * at->x[i] + (at->y ? ey * at->y[i] : 0), phase = q * u;
        const double all[6] = {
            wave_height * sin(phase) + wave_tilt * u,    wave_height * q * cos(phase) * ex,
            wave_height * q * cos(phase) * ey,           -wave_height * q * q * sin(phase) * ex * ex,
            -wave_height * q * q * sin(phase) * ex * ey, -wave_height * q * q * sin(phase) * ey * ey};
        double *const out[6] = {to->z, to->x, to->y, to->xx, to->xy, to->yy};
        for (int k = 0; k < 6; k++)
            if (out[k]) out[k][i] += all[k];
    }
}

static struct relief_part wave = {
    .name = "wave", .finest = 1e-5, .from = {-HUGE_VAL, -HUGE_VAL}, .to = {HUGE_VAL, HUGE_VAL}, .add = wave_add};

static struct relief_part *wave_part(struct arena *a, const struct contact *c)
{
    struct relief_part *p = ARENA_TAKE(a, struct relief_part, 1);
    (void)c;
    *p = wave;
    return p;
}

static double wave_roughness(int along, double height, double length, double tilt, double heading)
{
    wave_height = height, wave_length = length, wave_tilt = tilt, wave_heading = heading;
    return roll_stiffness_roughness(&(struct relief){.along = along, .first = &wave});
}

/* a / sqrt 2 times what passes of the wave's square, of 0.1 to 20 mm, along a line and in the plane: 1024 places
   scatter by 2 % of Rq, 16 waves of about that length in their mean by less. */
START_TEST(waves_pass_as_they_should)
{
    for (int k = 0; k <= 16; k++) {
        double off[2] = {0}, worst = 0;
        for (int j = 0; j < 16; j++) {
            double length = 1e-4 * pow(200, k / 16.0) * (1 + 0.004 * j), q = 2 * M_PI / length, s = 5e-4,
                   a = exp(-0.5 * q * q * s * s);
            double want = 1e-6 / sqrt(2) * sqrt(1 - 4.0 / 3 * a + 1.0 / 3 * a * a * a * a);
            for (int plane = 0; plane < 2; plane++) {
                double is =
                    wave_roughness(plane ? ALONG_PLANE : ALONG_PATH, 1e-6, length, 0, plane * 0.4 * j) / want - 1;
                off[plane] += is / 16;
                worst = fmax(worst, fabs(is));
            }
        }
        printf("%.3g mm: off by %.4f, %.4f in the mean, %.4f at most\n", 0.1 * pow(200, k / 16.0), off[0], off[1],
               worst),
            fflush(stdout);
        ck_assert_double_lt(fmax(fabs(off[0]), fabs(off[1])), 0.03);
        ck_assert_double_lt(worst, 0.12);
    }
}
END_TEST

START_TEST(tilt_and_scale)
{
    ck_assert_double_lt(wave_roughness(ALONG_PATH, 0, 1e-3, 0.1, 0), 1e-16);
    ck_assert_double_lt(wave_roughness(ALONG_PLANE, 0, 1e-3, 0.1, 0.7), 1e-16);
    double one = wave_roughness(ALONG_PLANE, 1e-6, 1e-3, 0, 0.7);
    ck_assert(wave_roughness(ALONG_PLANE, 4e-6, 1e-3, 0, 0.7) == 4 * one);
}
END_TEST

/* ------------------------------------------------------------------ the stiffness */

struct marble {
    const char *surface, *ball, *contact, *motion, *more; /* NULL: as here */
};

static struct roll_report rests(struct marble b)
{
    const char *surface = b.surface ? b.surface : "roughness: {rms: 5 um}",
               *ball = b.ball ? b.ball : "radius: 1 cm, mass: 10 g";
    const char *motion = b.motion ? b.motion : "path: line, to: [8 cm, 0], speed: 30 cm/s",
               *more = b.more ? b.more : "";
    struct scene s = rig_scene(
        rig_arena(), arena_format(rig_arena(),
                                  "rasp: 1\nseed: 5\nload: {approach: 0, release: 0}\nsurface: {%s}\nball: "
                                  "{%s}\ncontact: {model: roll%s}\nmotion: {%s}\n%s%s",
                                  surface, ball, b.contact ? b.contact : "", motion, more,
                                  strstr(more, "output") ? "" : "output: {sample_rate: 48000, diagnostics: {}}\n"));
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 20, 20);
    struct roll_report is = g->run.board.roll;
    rig_close(g);
    return is;
}

#define WITH(part, text) ((struct marble){.part = text})

/* To the bit, whatever the motion does, and however exactly it is worked out; with neither the limiter nor what is
   left out in it. */
START_TEST(nothing_of_the_motion_is_in_it)
{
    const struct marble of[] = {WITH(motion, "path: line, from: [3 cm, 0], to: [3.1 cm, 0], speed: 3 cm/s"),
                                WITH(motion, "path: back_and_forth, to: [4 mm, 0], rate: 20 Hz, duration: 0.11 s"),
                                WITH(motion, "path: line, to: [2 m, 0], speed: 2 m/s"),
                                WITH(contact, ", leak: 10 mm"),
                                WITH(contact, ", limiter: {alpha: 5 mm}"),
                                WITH(contact, ", limiter: {curve: none}"),
                                WITH(ball, "radius: 1 cm, mass: 10 g, patch: 50 um"),
                                WITH(ball, "radius: 1 cm, mass: 10 g, lobe_height: 1 nm"),
                                WITH(ball, "radius: 1 cm, mass: 10 g, offset: 4 mm"),
                                WITH(ball, "radius: 4 cm, mass: 10 g"), /* of unknown materials */
                                WITH(contact, ", roll: {mu: 7, damping_ratio: 0, scraping: 0}"),
                                WITH(contact, ", force: paper"),
                                WITH(more, "ablation: {normal_force: constant}\n"),
                                WITH(more, "ablation: {nonlinearity: omitted}\n"),
                                WITH(more, "accuracy: draft\n"),
                                WITH(more, "accuracy: reference\n"),
                                WITH(more, "accuracy: {oversampling: 16, tip_heights: 4}\n"),
                                WITH(more, "output: {sample_rate: 96000, diagnostics: {}}\n"),
                                WITH(more, "start: 0.3 s\n")};
    double k = rests((struct marble){0}).stiffness;
    ck_assert_double_gt(k, 0);
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        double is = rests(of[i]).stiffness;
        ck_assert_msg(is == k, "%zu: %.17g, not %.17g", i, is, k);
    }
    ck_assert(rests(WITH(surface, "roughness: {rms: 6 um}")).stiffness != k);
}
END_TEST

/* delta = Hertz's depth + 1.5 Rq, k = N / delta^1.5: each part by itself, and both. */
START_TEST(both_parts_add_up)
{
    const char *glass = "radius: 1 cm, material: glass";
    struct roll_report of_both =
        rests((struct marble){.surface = "material: steel, roughness: {rms: 5 um}", .ball = glass});
    struct roll_report of_rough = rests((struct marble){0}), heavier = rests(WITH(ball, "radius: 1 cm, mass: 30 g"));
    rig_relief = wave_part;
    wave_height = wave_tilt = 0, wave_length = 1;
    struct roll_report of_smooth = rests((struct marble){.surface = "material: steel, roughness: {}", .ball = glass});
    rig_relief = NULL;
    double weight = 4.0 / 3 * M_PI * 1e-6 * 2500 * 9.80665, hertz;
    struct scene s =
        rig_scene(rig_arena(), "rasp: 1\nsurface: {material: steel, roughness: {}}\nball: {radius: 1 cm, material: "
                               "glass}\ncontact: {model: roll_coupled}\n"
                               "motion: {path: line, to: [8 cm, 0], speed: 30 cm/s}\noutput: {diagnostics: {}}\n");
    struct err e = {0};
    ck_assert(hertz_stiffness(&s.contacts[0], &hertz, &e));
    ck_assert_double_eq_tol(of_smooth.stiffness / hertz, 1, 1e-12);
    ck_assert_double_eq_tol(of_smooth.rest / of_smooth.hertz, 1, 1e-15);
    ck_assert_double_eq_tol(of_both.rest / (of_smooth.rest + of_rough.rest), 1, 1e-12);
    ck_assert_double_eq_tol(of_rough.rest / (1.5 * of_rough.roughness), 1, 1e-12);
    ck_assert_double_eq_tol(of_both.stiffness * pow(of_both.rest, 1.5) / (s.contacts[0].scraper.mass * 9.80665), 1,
                            1e-12);
    ck_assert_double_eq_tol(s.contacts[0].scraper.mass * 9.80665 / weight, 1, 0.1);
    ck_assert_double_eq_tol(heavier.stiffness / of_rough.stiffness, 3, 1e-12); /* k ~ N */
    ck_assert_double_eq_tol(heavier.resonance / of_rough.resonance, 1, 1e-12); /* of no mass */
    ck_assert_double_eq_tol(of_rough.resonance, sqrt(1.5 * 9.80665 / of_rough.rest) / (2 * M_PI), 1e-9);
    struct roll_report given = rests(WITH(contact, ", roll: {static_penetration: 4 um}"));
    ck_assert_double_eq_tol(given.stiffness * pow(4e-6, 1.5) / 0.0980665, 1, 1e-12);
    ck_assert(isnan(given.roughness) && isnan(given.hertz));
}
END_TEST

/* A millionth more of anything changes k by less than 1e-5. */
START_TEST(it_is_continuous)
{
    double k[6];
    for (int i = 0; i < 6; i++) {
        double a[6] = {1, 1, 1, 1, 1, 1};
        a[i] = i > 0 ? 1 + 1e-6 : 1;
        k[i] = rests((struct marble){
                         .surface = arena_format(rig_arena(),
                                                 "roughness: {rms: %.12g um}, object: {shape: plate, edges: supported, "
                                                 "length: 30 cm, width: 20 cm, thickness: 2 mm, "
                                                 "youngs_modulus: %.12g GPa, poisson: 0.2, density: 2500, loss: 0.01}",
                                                 5 * a[1], 70 * a[4]),
                         .ball = arena_format(rig_arena(), "radius: %.12g cm, mass: %.12g g, material: glass", a[2],
                                              10 * a[3]),
                         .motion = arena_format(
                             rig_arena(),
                             "path: incline, incline: %.12g deg, from: [0, 0], to: [8 cm, 0], start_speed: 30 cm/s",
                             5 * a[5])})
                   .stiffness;
        printf("%.12g\n", k[i]);
        ck_assert_double_lt(fabs(k[i] / k[0] - 1), 1e-5);
        ck_assert(i == 0 || k[i] != k[0]);
    }
}
END_TEST

enum { WAVES = 300 };

static double isotropic_number(int m) { return 2 * M_PI / (5e-4 * pow(10, (double)m / WAVES)); }

/* Waves of 0.5 to 5 mm in all directions: ground that is alike in all of them, turned as a whole by wave_heading. */
static void isotropic_add(struct relief_part *p, const struct relief_points *at, const struct relief_values *to)
{
    (void)p;
    for (int m = 0; m < WAVES; m++) {
        double heading = wave_heading + 2.399963 * m, q = isotropic_number(m), ex = cos(heading), ey = sin(heading);
        for (size_t i = 0; i < at->n; i++)
            to->z[i] += 1e-7 * sin(q * (ex * at->x[i] + ey * at->y[i]) + 1.7 * m * m);
    }
}

/* Turning a ground that is alike in all directions changes nothing but which of it the places meet: 1024 of them
   scatter by 1 / sqrt(2048) of Rq or more, and their mean over headings is what passes of the waves' squares. Where
   the scene lays it changes nothing at all. */
START_TEST(turned_ground_is_as_rough)
{
    enum { HEADINGS = 16 };
    double square = 0, want = 0, s = 5e-4;
    struct relief_part isotropic = wave;
    isotropic.add = isotropic_add;
    for (int m = 0; m < WAVES; m++) {
        double q = isotropic_number(m), a = exp(-0.5 * q * q * s * s);
        want += 0.5e-14 * (1 - 4.0 / 3 * a + 1.0 / 3 * a * a * a * a);
    }
    for (int i = 0; i < HEADINGS; i++) {
        wave_heading = 0.4 * i;
        double rq = roll_stiffness_roughness(&(struct relief){.along = ALONG_PLANE, .first = &isotropic});
        printf("%.4g m of %.4g m\n", rq, sqrt(want)), fflush(stdout);
        ck_assert_double_eq_tol(rq / sqrt(want), 1, 0.08);
        square += rq * rq / HEADINGS;
    }
    printf("%.4f in the mean\n", sqrt(square / want)), fflush(stdout);
    ck_assert_double_eq_tol(sqrt(square / want), 1, 0.02);
    double here = rests(WITH(surface, "along: x, roughness: {rms: 5 um}")).roughness;
    ck_assert(rests(WITH(surface, "along: x, origin: [37 mm, 0], roughness: {rms: 5 um}")).roughness == here);
}
END_TEST

UNIT("roll_stiffness", waves_pass_as_they_should, tilt_and_scale, nothing_of_the_motion_is_in_it, both_parts_add_up,
     it_is_continuous, turned_ground_is_as_rough)
