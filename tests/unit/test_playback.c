/* playback: the force of a surface that is played, against the sine surface's closed form, the same integral by a plain
   fine rule on the trajectory's own functions, and the momentum that a spline's heights hand over, however fast they
   are passed. */
#include "rig.h"
#include "surface/height_map.h"
#include "surface/profile.h"
#include "trajectory/trajectory.h"

static const double wave = 80e-6, height = 3e-6;

/* z = height sin(2 pi x / wave), in the plane times cos(2 pi y / (2 wave)). */
static void sine_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    (void)part;
    for (size_t i = 0; v->z && i < p->n; i++)
        v->z[i] += height * sin(2 * M_PI * p->x[i] / wave) * (p->y ? cos(M_PI * p->y[i] / wave) : 1);
}

static struct relief_part *sine(struct arena *a, const struct contact *c)
{
    struct relief_part *p = ARENA_TAKE(a, struct relief_part, 1);
    (void)c;
    *p = (struct relief_part){.name = "sine",
                              .finest = wave / 8,
                              .from = {-HUGE_VAL, -HUGE_VAL},
                              .to = {HUGE_VAL, HUGE_VAL},
                              .add = sine_add};
    return p;
}

static struct rig *played(const char *motion, const char *surface,
                          struct relief_part *(*relief)(struct arena *, const struct contact *), long frames, int block)
{
    struct scene s = rig_scene(
        rig_arena(),
        arena_format(rig_arena(),
                     "rasp: 1\nsurface: {%s, roughness: {exponent: -2, rms: 1 um, longest: 1 mm, shortest: 20 um}}\n"
                     "motion: {%s}\nload: {approach: 0 s, release: 0 s}\n"
                     "contact: {model: playback, playback: {stiffness: 2e5 N/m}}\n"
                     "output: {sample_rate: 44.1 kHz, diagnostics: {rate: 1 kHz}}\n",
                     surface, motion));
    rig_relief = relief;
    return rig_record(&s, ITEM_SUBFORCE, frames, block);
}

/* Closed form at constant speed: k h (cos(a) - cos(b)) / (b - a), to 1e-9 of the greatest force; none after the end. */
static void check_sine(double length, double lasts)
{
    struct rig *g =
        played(arena_format(rig_arena(), "path: line, from: [0, 0], to: [%g m, 0], duration: %g s", length, lasts),
               "along: path", sine, (long)(lasts * 44100) + 100, 700);
    double dt = 1 / (44100.0 * g->per_frame), v = length / lasts, worst = 0;
    for (long i = 0; i < g->frames * g->per_frame; i++) {
        double from = fmin((double)i * dt, lasts), to = fmin((double)(i + 1) * dt, lasts),
               a = 2 * M_PI * v * from / wave, b = 2 * M_PI * v * to / wave;
        double want = to > from ? 2e5 * height * (cos(a) - cos(b)) / (2 * M_PI * v / wave) / dt : 0;
        worst = fmax(worst, fabs(g->x[i] - want));
    }
    printf("%g m/s: off by %.2e of the greatest force\n", v, worst / (2e5 * height));
    ck_assert_double_le(worst, 1e-9 * 2e5 * height);
    rig_close(g);
}

/* 99 m/s: a wave and more in each sub-interval. */
START_TEST(sine_at_constant_speed)
{
    check_sine(0.1, 0.1003);
    check_sine(0.3, 0.00303);
}
END_TEST

/* The judge: 64 panels of Simpson's rule over each sub-interval, places by the trajectory itself. */
static double plainly(const struct rig *g, long i, bool plane)
{
    enum { PANELS = 128 };
    const struct trajectory *tr = g->run.board.trajectory;
    double dt = 1 / (44100.0 * g->per_frame), t[PANELS + 1], u[PANELS + 1], x[PANELS + 1], y[PANELS + 1], sum = 0;
    for (int k = 0; k <= PANELS; k++)
        t[k] = ((double)i + k / (double)PANELS) * dt;
    trajectory_at(tr, PANELS + 1, t, (struct trajectory_out){.u = u, .x = x, .y = y});
    for (int k = 0; k <= PANELS; k++) {
        double z = height * sin(2 * M_PI * (plane ? x[k] : u[k]) / wave) * (plane ? cos(M_PI * y[k] / wave) : 1);
        sum += z * (k == 0 || k == PANELS ? 1 : k % 2 ? 4 : 2) / (3.0 * PANELS);
    }
    return 2e5 * sum;
}

static void check_plainly(const char *motion, const char *surface, bool plane)
{
    long frames = 4000;
    struct rig *g = played(motion, surface, sine, frames, 512);
    double worst = 0;
    for (long i = 0; i < frames * g->per_frame; i += 7)
        worst = fmax(worst, fabs(g->x[i] - plainly(g, i, plane)));
    printf("%s: off by %.2e of the greatest force\n", motion, worst / (2e5 * height));
    ck_assert_double_le(worst, 1e-9 * 2e5 * height);
    rig_close(g);
}

START_TEST(turning_and_curved_motions)
{
    check_plainly("path: back_and_forth, from: [0, 0], to: [4 cm, 0], rate: 20 Hz, duration: 1 s", "along: path",
                  false);
    check_plainly("path: back_and_forth, from: [1 mm, 0], to: [3 cm, 2 cm], rate: 20 Hz, duration: 1 s", "along: plane",
                  true);
    check_plainly("path: circle, center: [0, 0], radius: 8 mm, turns: 40, duration: 1 s", "along: plane", true);
    check_plainly("path: scribble, center: [0, 0], size: [4 cm, 3 cm], rate: 8 Hz, duration: 1 s", "along: plane",
                  true);
}
END_TEST

/* ------------------------------------------------------------------ splines */

enum { HEIGHTS = 20000 };
#define PITCH 2e-6

/* Spikes one sample wide, every 251 heights. */
static struct relief_part *spikes(struct arena *a, const struct contact *c)
{
    double *z = ARENA_TAKE(a, double, HEIGHTS);
    (void)c;
    for (int i = 100; i < HEIGHTS - 100; i += 251)
        z[i] = 1e-6 * (1 + i % 5);
    return profile_part(a, profile_from_samples(a, z, HEIGHTS, PITCH, OFF_MAP_MIRROR), "spikes", 0);
}

static double spikes_sum(void)
{
    double sum = 0;
    for (int i = 100; i < HEIGHTS - 100; i += 251)
        sum += 1e-6 * (1 + i % 5);
    return sum;
}

/* The whole of the profile is passed at `speed`: sum f dt = k pitch / v sum z, the trapezium rule being exact for a
 * spline that ends flat. */
static double momentum_off(double speed)
{
    double lasts = PITCH * (HEIGHTS - 1) / speed, sum = 0;
    long frames = (long)(lasts * 44100) + 4;
    struct rig *g = played(arena_format(rig_arena(), "path: line, from: [0, 0], to: [%.17g m, 0], duration: %.17g s",
                                        PITCH * (HEIGHTS - 1), lasts),
                           "along: path", spikes, frames, 1024);
    for (long i = 0; i < frames * g->per_frame; i++)
        sum += g->x[i] / (44100.0 * g->per_frame);
    rig_close(g);
    return sum / (2e5 * PITCH / speed * spikes_sum()) - 1;
}

START_TEST(no_asperity_is_skipped)
{
    static const double speeds[] = {0.07, 1, 13, 39};
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        double off = momentum_off(speeds[i]);
        printf("%g m/s: momentum off by %.2e\n", speeds[i], off);
        ck_assert_double_le(fabs(off), 1e-9);
    }
}
END_TEST

/* A map passed slantwise, its knots crossed in both coordinates: each mean against a plain rule with 4096 points. */
static struct relief_part *map(struct arena *a, const struct contact *c)
{
    static const double pitch[2] = {3e-6, 5e-6}, origin[2] = {-1.3e-6, 2.1e-6};
    double *z = ARENA_TAKE(a, double, 40 * 50);
    (void)c;
    srand48(5);
    for (int i = 0; i < 40 * 50; i++)
        z[i] = 1e-6 * drand48();
    return height_map_part(a, height_map_spline(a, &(struct height_map){z, 50, 40, {pitch[0], pitch[1]}}, OFF_MAP_WRAP),
                           origin, "map");
}

START_TEST(a_map_slantwise)
{
    enum { POINTS = 4096 };
    struct rig *g = played("path: line, from: [0, 0], to: [6 cm, 5 cm], speed: 7 m/s", "along: plane", map, 300, 64);
    double dt = 1 / (44100.0 * g->per_frame), worst = 0, x[POINTS], y[POINTS], z[POINTS], most = 0;
    for (long i = 3; i < 300 * g->per_frame; i += 97) {
        double sum = 0;
        for (int k = 0; k < POINTS; k++) {
            double u = 7 * dt * ((double)i + (k + 0.5) / POINTS);
            x[k] = u * 6 / sqrt(61), y[k] = u * 5 / sqrt(61);
        }
        relief_at(g->run.board.relief, &(struct relief_points){POINTS, x, y}, &(struct relief_values){.z = z});
        for (int k = 0; k < POINTS; k++)
            sum += 2e5 * z[k] / POINTS;
        worst = fmax(worst, fabs(sum - g->x[i]));
        most = fmax(most, fabs(sum));
    }
    printf("map slantwise: off by %.2e\n", worst / most);
    ck_assert_double_le(worst, 1e-6 * most); /* the midpoint rule's own error, h^2 z''/24 over steps of 4 nm */
    rig_close(g);
}
END_TEST

/* However the frames are cut. */
START_TEST(any_blocks)
{
    const char *motion = "path: scribble, center: [0, 0], size: [4 cm, 3 cm], rate: 4 Hz, duration: 1 s";
    struct rig *a = played(motion, "along: plane", map, 1500, 1024), *b = played(motion, "along: plane", map, 1500, 37);
    ck_assert(memcmp(a->x, b->x, (size_t)(1500 * a->per_frame) * sizeof *a->x) == 0);
    rig_close(a);
    rig_close(b);
}
END_TEST

UNIT("playback", sine_at_constant_speed, turning_and_curved_motions, no_asperity_is_skipped, a_map_slantwise,
     any_blocks)
