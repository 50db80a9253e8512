/* tip over the grounds there are, as a ball of roll_coupled meets them: profiles that are drawn, measured ones, a map
   in the plane. Against the plain maximum over heights read far more densely (through every height the stage reads), on
   smooth ground searched from there on, and what is refused and told. */
#include <unistd.h>

#include "pipeline/stages.h"
#include "plane.h"
#include "trajectory/trajectory.h"

struct floor {
    struct scene scene;
    struct contact contact;
    struct trajectory trajectory;
    struct board board;
    struct stage_run run, opened[9];
    int n;
};

static void step(struct floor *g, const struct stage *s)
{
    struct err e = {0};
    struct stage_run *r = &g->opened[g->n];
    if (!stages_wanted(s, &g->contact, &g->scene)) return;
    *r = g->run;
    r->stage = s;
    ck_assert_msg(s->open(r, &e), "%s", e.text);
    g->n++;
}

static void ground_close(struct floor *g)
{
    for (int i = 0; i < g->n; i++)
        if (g->opened[i].stage->close) g->opened[i].stage->close(&g->opened[i]);
}

/* The surface of a scene, as it is before the tip; the contact is a ball's. */
static void ground_make(struct floor *g, const char *surface, double radius, double patch)
{
    static const struct stage *const parts[] = {&relief_stage,   &height_map_stage, &continuation_stage,
                                                &roughness_stage, &ridges_stage,     &grit_stage,
                                                &fractal_stage};
    struct err e = {0};
    *g = (struct floor){
        .scene = rig_scene(rig_arena(),
                           arena_format(rig_arena(),
                                        "rasp: 1\noutput: {diagnostics: {}}\nscraper: {mass: 1 g, radius: 1 cm}\n"
                                        "surface: %s\nmotion: {path: line, to: [2 cm, 0], speed: 20 cm/s}\n",
                                        surface))};
    g->contact = g->scene.contacts[0];
    g->contact.contact.model = CONTACT_ROLL_COUPLED;
    g->contact.scraper.radius = radius;
    g->contact.scraper.patch = patch;
    ck_assert(trajectory_make(&g->contact.motion, 1, rig_arena(), &g->trajectory, &e));
    g->board = (struct board){.trajectory = &g->trajectory};
    g->run = (struct stage_run){.scene = &g->scene, .contact = &g->contact, .board = &g->board, .arena = rig_arena()};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        step(g, parts[i]);
}

static double height_at(const struct relief *r, double x)
{
    double z;
    relief_at(r, &(struct relief_points){1, &x, NULL}, &(struct relief_values){.z = &z});
    return z;
}

/* Over heights that span `span`, every d from 0 on. */
static double plain_at(const struct relief *r, double radius, double span, double d, double x)
{
    double reach = fmin(radius, sqrt(2 * radius * span)), most = -HUGE_VAL;
    for (double i = ceil((x - reach) / d); i * d <= x + reach; i++) {
        double off = x - i * d;
        if (fabs(off) <= radius)
            most = fmax(most, height_at(r, i * d) - off * off / (radius + sqrt(radius * radius - off * off)));
    }
    return most;
}

static double arc_at(const struct relief *r, double radius, double x, double t)
{
    double off = x - t, square = radius * radius - off * off;
    return square < 0 ? -HUGE_VAL : height_at(r, t) - off * off / (radius + sqrt(square));
}

/* The same of smooth ground between the heights: from each that comes within `missed` of the best so far, ever nearer.
 */
static double searched_at(const struct relief *r, const double radius_span_missed[3], double d, double x)
{
    double radius = radius_span_missed[0], most = plain_at(r, radius, radius_span_missed[1], d, x),
           least = most - radius_span_missed[2];
    double reach = fmin(radius, sqrt(2 * radius * radius_span_missed[1]));
    for (double i = ceil((x - reach) / d); i * d <= x + reach; i++) {
        double t = i * d, best = arc_at(r, radius, x, t);
        for (double step = best > least ? d / 2 : 0; step > 1e-11; step /= 2) {
            double left = arc_at(r, radius, x, t - step), right = arc_at(r, radius, x, t + step);
            t += left > best ? -step : right > best ? step : 0;
            best = fmax(best, fmax(left, right));
        }
        most = fmax(most, best);
    }
    return most;
}

/* Heights' span and the greatest |z''| over the motion. */
static void ground_look(const struct relief *r, double *span, double *bend)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    *bend = 0;
    for (int i = 0; i < 40000; i++) {
        double x = -5e-3 + 3e-2 * i / 40000, z, xx;
        relief_at(r, &(struct relief_points){1, &x, NULL}, &(struct relief_values){.z = &z, .xx = &xx});
        least = fmin(least, z);
        most = fmax(most, z);
        *bend = fmax(*bend, fabs(xx));
    }
    *span = 1.2 * (most - least);
}

/* Of ground with kinks: never above the denser maximum but for rounding, and below it by d^2/8 (1/R + |z''|) at most,
 * and a thousandth of the span where it is level. */
static void check_kinked(const char *surface, const struct relief *bare, const struct relief *with, double radius,
                         int places)
{
    double span, bend, worst = 0, d = with->first->finest;
    ground_look(bare, &span, &bend);
    double missed = d * d / 8 * (1 / radius + bend);
    ck_assert_double_le(d * d / 8 / radius, 1e-3 * span);
    for (int i = 0; i < places; i++) {
        double x = 2e-2 * drand48(), want = plain_at(bare, radius, span, d / 5, x), got = height_at(with, x);
        ck_assert_msg(got <= want + 1e-15, "%s: %g above the largest", surface, got - want);
        worst = fmax(worst, want - got);
    }
    printf("%s, R = %g m: d = %g m, too low by at most %g m of %g m that are allowed, heights span %g m\n", surface,
           radius, d, worst, missed, span / 1.2);
    ck_assert_msg(worst <= missed && worst > 0, "%s: %g below, and at most %g", surface, worst, missed);
}

/* Of smooth ground: `share` of the span on either side; where that is 0, the stage reads it at its knots, and rounding
 * alone is left. */
static void check_smooth(const char *surface, const struct relief *bare, const struct relief *with,
                         const double radius_share[2], int places)
{
    double radius = radius_share[0], span, bend, worst = 0, d = with->first->finest, fine = d / 20;
    ground_look(bare, &span, &bend);
    for (int i = 0; i < places; i++) {
        double x = 2e-2 * drand48(),
               want = searched_at(bare, (double[]){radius, span, fine * fine / 4 * (1 / radius + bend)}, fine, x);
        worst = fmax(worst, fabs(want - height_at(with, x)));
    }
    printf("%s, R = %g m: d = %g m, off by at most %g of the span\n", surface, radius, d, worst / span);
    ck_assert_msg(worst <= radius_share[1] * span + 1e-16, "%s: off by %g of %g m", surface, worst, span);
}

static void check_ground(const char *surface, double radius, double share, int places)
{
    struct floor bare, with;
    ground_make(&bare, surface, radius, 0);
    ground_make(&with, surface, radius, 0);
    step(&with, &tip_stage);
    ck_assert_str_eq(with.board.relief->first->name, "crest");
    if (relief_kinks(bare.board.relief) > 0)
        check_kinked(surface, bare.board.relief, with.board.relief, radius, places);
    else
        check_smooth(surface, bare.board.relief, with.board.relief, (double[]){radius, share}, places);
    ck_assert_int_eq(with.board.n_warnings, bare.board.n_warnings);
    ground_close(&bare);
    ground_close(&with);
}

START_TEST(drawn_profiles)
{
    check_ground("{roughness: {rms: 3 um, exponent: -2.2, longest: 1 mm, shortest: 40 um}}", 1e-2, 1e-5, 100);
    check_ground("{roughness: {rms: 3 um, exponent: -2.2, longest: 1 mm, shortest: 40 um}}", 10, 1e-5, 20);
    check_ground(
        "{along: path, ridges: {shape: round, spacing: 1 mm, height: 50 um, width: 0.3 mm}, roughness: {rms: 1 um}}",
        5e-3, 1e-5, 100);
    check_ground("{along: x, grit: {density: 10 /mm^2, diameter: 0.2 mm, height: 40 um}}", 1e-2, 1e-5, 100);
}
END_TEST

/* Kinks and steps are among the heights that are read: between straight lines and under steps the ball is too low by
 * d^2/(8 R) at most. */
START_TEST(fractal_profiles)
{
    static const char *const kinds[3] = {"nearest", "linear", "spline"};
    for (int k = 0; k < 3; k++) {
        check_ground(arena_format(rig_arena(), "{fractal: {exponent: -0.5, interpolation: %s}}", kinds[k]), 1e-2, 1e-5,
                     100);
        check_ground(arena_format(rig_arena(),
                                  "{fractal: {exponent: -1.2, maximum: 10 um, pitch: 37 um, interpolation: %s}}",
                                  kinds[k]),
                     2e-3, 1e-5, 100);
    }
    check_ground("{fractal: {exponent: -1.2, maximum: 1 nm, interpolation: linear}}", 5e-3, 1e-5, 10);
}
END_TEST

START_TEST(measured_profiles)
{
    static const char *const names[] = {"acrylic", "plywood", "sandpaper"};
    const char *root = getenv("ROOT");
    check_ground(arena_format(rig_arena(), "{height_map: %s/surfaces/acrylic.gsf}", root), 1e-2, 1e-5, 100);
    for (int k = 0; k < 3; k++) {
        const char *file = arena_format(rig_arena(), "%s/../shared/data/surfaces/%s.npy", root, names[k]);
        if (access(file, R_OK) == 0)
            check_ground(arena_format(rig_arena(), "{height_map: %s, pitch: 1.394068 um}", file), k == 0 ? 1 : 1e-2,
                         1e-5, 50);
        else
            printf("%s is not there: not looked at\n", names[k]);
    }
}
END_TEST

/* Smoothed as well: kinked ground under a patch, against the denser maximum smoothed by a sum over 7 standard
   deviations in steps of an eighth of one. The kinks of E and the lattice of the patch, h^2/11 of the greatest
   curvature (1/R and what is left of the ridges', after smoothing), and what is missed between heights. */
START_TEST(fractal_under_a_patch)
{
    struct floor bare, with;
    double radius = 2e-3, patch = 2e-5, span, bend, largest = 0;
    const char *surface = "{fractal: {exponent: -1.2, maximum: 10 um, pitch: 37 um, interpolation: linear}}";
    ground_make(&bare, surface, radius, patch);
    ground_make(&with, surface, radius, patch);
    step(&with, &tip_stage);
    ground_look(bare.board.relief, &span, &bend);
    for (int i = 0; i < 30; i++) {
        double x = 2e-2 * drand48(), sum = 0, whole = 0, xx;
        for (int k = -56; k <= 56; k++) {
            double q = k / 8.0, g = exp(-0.5 * q * q);
            sum += g * plain_at(bare.board.relief, radius, span, 37e-6 / 150, x + q * patch);
            whole += g;
        }
        relief_at(with.board.relief, &(struct relief_points){1, &x, NULL}, &(struct relief_values){.xx = &xx});
        largest = fmax(largest, fabs(height_at(with.board.relief, x) - sum / whole));
    }
    double kink = 0.4 * 0.2 / patch, h = patch / 4, d = 2.5e-6;
    ck_assert_msg(largest < kink * h * h / 11 + d * d / 8 / radius + patch * patch / 64 / 12 * kink, "%g", largest);
}
END_TEST

/* ------------------------------------------------------------------ a map in the plane */

enum { UP = 36, DENSE = 2 }; /* steps of the lattice to 4.5 standard deviations; heights to a step */

/* E at multiples of h by the plain maximum over a square of heights, the map's own, h/2 apart; smoothed by the
 * Gaussian's sum: as surface/contact_patch.c says, but read plainly. */
static double smoothed_plainly(const struct relief *r, double radius, double h, const double at[2])
{
    long reach = (long)ceil(radius / h) * DENSE, half = UP * DENSE / 2 + reach, side = 2 * half + 1;
    double *z = malloc((size_t)(side * side) * sizeof *z), sum = 0, whole = 0;
    for (long j = -half; j <= half; j++)
        for (long i = -half; i <= half; i++) {
            double x = at[0] + (double)i * h / DENSE, y = at[1] + (double)j * h / DENSE;
            relief_at(r, &(struct relief_points){1, &x, &y},
                      &(struct relief_values){.z = &z[(j + half) * side + i + half]});
        }
    for (long b = -UP / 2; b <= UP / 2; b++)
        for (long a = -UP / 2; a <= UP / 2; a++) {
            double g = exp(-0.5 * (double)(a * a + b * b) / 16), e = -HUGE_VAL;
            for (long j = -reach; j <= reach; j++)
                for (long i = -reach; i <= reach; i++) {
                    double d2 = (double)(i * i + j * j) * h * h / DENSE / DENSE;
                    if (d2 <= radius * radius)
                        e = fmax(e, z[(b * DENSE + j + half) * side + a * DENSE + i + half] -
                                        d2 / (radius + sqrt(radius * radius - d2)));
                }
            sum += g * e;
            whole += g;
        }
    free(z);
    return sum / whole;
}

/* Obliquely over a rough map. Both read heights densely enough (curvatures up to 2e4 1/m in either direction, h/2 = 2.5
 * um: 0.03 um). */
START_TEST(a_map_along_a_path)
{
    struct floor g;
    double radius = 3e-4, patch = 2e-5, missed = 2 * 2.5e-6 * 2.5e-6 / 8 * (2e4 + 1 / 3e-4), rough = 0;
    ground_make(&g, "{along: plane, roughness: {rms: 1 um}}", radius, patch);
    struct relief bare = {.along = ALONG_PLANE};
    relief_add(&bare, plane_rough_map(rig_arena(), NULL));
    *g.board.relief = bare;
    step(&g, &tip_stage);
    for (int k = 0; k < 3; k++) {
        double u = 3.7e-3 * (k + 1), x = 0.8 * u, y = 0.6 * u, got, base;
        relief_at(g.board.relief, &(struct relief_points){1, &x, &y}, &(struct relief_values){.z = &got});
        relief_at(&bare, &(struct relief_points){1, &x, &y}, &(struct relief_values){.z = &base});
        ck_assert_double_eq_tol(got, smoothed_plainly(&bare, radius, patch / 4, (double[]){x, y}), missed);
        rough = fmax(rough, fabs(got - base));
    }
    ck_assert_double_gt(rough, 10 * missed);
    ground_close(&g);
}
END_TEST

/* ------------------------------------------------------------------ what is refused, and told */

static void refused(const char *surface, double patch, int model, const char *says)
{
    struct floor g;
    struct err e = {0};
    ground_make(&g, surface, 10, patch);
    g.contact.contact.model = model;
    g.run.stage = &tip_stage;
    ck_assert(!tip_stage.open(&g.run, &e));
    ck_assert_msg(e.kind == ERR_SCENE && strstr(e.text, says) && strstr(e.text, "contact 'contact'"), "%s", e.text);
    ground_close(&g);
}

START_TEST(a_patch_of_nothing)
{
    refused("{along: plane, roughness: {}}", 0, CONTACT_ROLL_COUPLED, "set ball.patch");
    refused("{along: path, roughness: {}}", 0, CONTACT_ROLL, "set it to the radius of the contact patch");
    refused("{along: path, roughness: {longest: 10 um, shortest: 0.1 um}}", 0, CONTACT_ROLL_COUPLED,
            "take a coarser surface");
}
END_TEST

static double tower(double x) { return 1e-6 * cos(x / 1e-4) + (fabs(x - 0.1) < 3e-7 ? 1e-3 : 0); }

static void tower_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    (void)part;
    for (size_t i = 0; v->z && i < p->n; i++)
        v->z[i] += tower(p->x[i]);
}

/* A large ball looks as far as the heights that were looked at ask for, and a peak that the first look missed is told,
 * once. */
START_TEST(a_missed_peak_is_told)
{
    struct floor g;
    struct relief_part part = {.finest = 1e-6, .add = tower_add};
    ground_make(&g, "{roughness: {}}", 10, 0);
    g.board.relief->first = &part;
    step(&g, &tip_stage);
    for (int k = 0; k < 100; k++)
        height_at(g.board.relief, 2e-4 * k);
    ck_assert_int_eq(g.board.n_warnings, 0);
    for (int k = 0; k < 100; k++)
        height_at(g.board.relief, 0.09 + 2e-4 * k);
    ck_assert_int_eq(g.board.n_warnings, 1);
    ck_assert(strstr(g.board.warnings[0], "higher in places"));
    ground_close(&g);
}
END_TEST

UNIT("tip_grounds", drawn_profiles, fractal_profiles, measured_profiles, fractal_under_a_patch, a_map_along_a_path,
     a_patch_of_nothing, a_missed_peak_is_told)
