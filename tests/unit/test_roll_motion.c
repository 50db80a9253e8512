/* A ball of model roll along whole motions: beside the coupled model where that is linear; its mean force; ways that
   turn, reverse and have corners; how its force grows with the ground. */
#include "num/fft.h"
#include "rig.h"
#include "trajectory/trajectory.h"

enum {
    SAMPLES = 1 << 17,
    FIRST = 12,
    BANDS = 24
}; /* of 192 kHz, 0.68 s; third octaves from 2^(FIRST/3) * 2 Hz on, 32 Hz to 6.5 kHz */

static struct scene ball_scene(const char *model, const char *contact, const char *surface, const char *ball,
                               const char *motion)
{
    return rig_scene(rig_arena(),
                     arena_format(rig_arena(),
                                  "rasp: 1\nseed: 5\nsurface: {%s}\nball: {%s}\ncontact: {model: %s, %s}\nmotion: "
                                  "{%s}\nload: {approach: 0, release: 0}\n"
                                  "output: {sample_rate: 48000, diagnostics: {}}\naccuracy: {oversampling: 4}\n",
                                  surface, ball, model, contact, motion));
}

/* Power in third octaves of SAMPLES forces, by Hann's window. */
static void thirds(const double *force, double power[BANDS])
{
    static double x[SAMPLES], re[SAMPLES / 2 + 1], im[SAMPLES / 2 + 1];
    struct fft *f = fft_open(SAMPLES);
    double mean = 0;
    for (int i = 0; i < SAMPLES; i++)
        mean += force[i] / SAMPLES;
    for (int i = 0; i < SAMPLES; i++)
        x[i] = (force[i] - mean) * (0.5 - 0.5 * cos(2 * M_PI * (i + 0.5) / SAMPLES));
    fft_forward(f, x, re, im);
    for (int k = 0; k < BANDS; k++)
        power[k] = 0;
    for (int i = 1; i <= SAMPLES / 2; i++) {
        int k = (int)floor(3 * log2(i * 192000.0 / SAMPLES / 2)) - FIRST;
        if (k >= 0 && k < BANDS) power[k] += re[i] * re[i] + im[i] * im[i];
    }
    fft_close(f);
}

/* Of two series' swings about their means. */
static double correlation(const double *a, const double *b, int n)
{
    double s[5] = {0};
    for (int i = 0; i < n; i++)
        s[0] += a[i] / n, s[1] += b[i] / n;
    for (int i = 0; i < n; i++)
        s[2] += (a[i] - s[0]) * (a[i] - s[0]), s[3] += (b[i] - s[1]) * (b[i] - s[1]),
            s[4] += (a[i] - s[0]) * (b[i] - s[1]);
    return s[4] / sqrt(s[2] * s[3]);
}

/* On ground of 3 nm, where the coupled model's ball never bounces and its force is all but linear, the same stiffness
   and no damping but mu's make the same force, after half a second. */
START_TEST(near_the_coupled_ball)
{
    const char *surface = "roughness: {rms: 3 nm}", *ball = "radius: 8 mm, mass: 5.4 g",
               *motion = "path: line, to: [35 cm, 0], speed: 25 cm/s";
    struct scene here = ball_scene(
        "roll",
        "smoothing: 0, limiter: {curve: none}, roll: {static_penetration: 1.2 um, damping_ratio: 0, scraping: 0}",
        surface, ball, motion);
    long frames = 64800, from = 4 * 24000;
    struct rig *roll = rig_record(&here, ITEM_SUBFORCE, frames, 1024);
    struct scene there =
        ball_scene("roll_coupled",
                   arena_format(rig_arena(), "roll: {ground: rigid, stiffness: %.17g}", roll->run.board.roll.stiffness),
                   surface, ball, motion);
    struct rig *coupled = rig_record(&there, ITEM_SUBFORCE, frames, 1024);
    double power[2][BANDS], worst = 0, *means = calloc((size_t)(4 * frames), sizeof *means);
    ck_assert_int_eq(coupled->per_frame, 4);
    for (long i = 1; i < 4 * frames;
         i++) /* plain means, about the middle of a sub-interval: of two, about the start, as hats are */
        means[i] = 0.5 * (coupled->x[i - 1] + coupled->x[i]);
    thirds(roll->x + from, power[0]);
    thirds(means + from, power[1]);
    for (int k = 0; k < BANDS; k++) {
        double off = 10 * log10(power[0][k] / power[1][k]);
        printf("%.0f Hz: %.3g, %.3f dB\n", 2 * pow(2, (FIRST + k) / 3.0), power[1][k], off), fflush(stdout);
        worst = fmax(worst, 2 * pow(2, (FIRST + k) / 3.0) < 80
                                ? 0
                                : fabs(off)); /* S leaks (contact.leak) below v / (2 pi l), 20 Hz */
    }
    double alike = correlation(roll->x + from, means + from, SAMPLES);
    printf("correlation %.5f\n", alike), fflush(stdout);
    ck_assert_double_lt(worst, 0.5);
    ck_assert_double_gt(alike, 0.99);
    free(means);
    rig_close(roll);
    rig_close(coupled);
}
END_TEST

/* Mean force over mean N(t)+ from half a second on; share of the time in contact while N(t) > 0; the deepest and
   least penetration, over that at rest. */
static void bears(const char *name, struct scene s)
{
    bool varies = s.contacts[0].ball.offset > 0;
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 10, 10);
    long frames = (long)(g->run.board.trajectory->duration * 48000);
    rig_close(g);
    g = rig_record(&s, ITEM_SUBFORCE, frames, 1024);
    int per = g->per_frame;
    double weight = g->run.board.roll.stiffness * pow(g->run.board.roll.rest, 1.5), mean = 0, load = 0, pressed = 0;
    long from = 24000 * per, all = frames * per;
    for (long i = from; i < all; i++)
        mean += g->x[i] / (double)(all - from);
    struct roll_report report = g->run.board.roll;
    double lifted = g->run.board.lifted;
    rig_close(g);
    g = varies ? rig_record(&s, ITEM_LOAD, frames, 1024) : NULL;
    for (long i = from; i < all; i++)
        load += (g ? fmax(g->x[i], 0) : weight) / (double)(all - from);
    pressed = report.contact / (report.time - lifted);
    printf("%s: mean force %.5f of N(t)+, in contact %.5f while pressed\n", name, mean / load, pressed), fflush(stdout);
    ck_assert_double_eq_tol(mean / load, 1, 0.005);
    ck_assert_double_gt(pressed, 0.99);
    if (g) rig_close(g);
}

START_TEST(the_mean_force_is_the_normal_force)
{
    static const struct {
        const char *name, *surface, *ball, *motion;
    } of[] = {{"line", "roughness: {rms: 5 um}", "", "path: line, to: [35 cm, 0], speed: 25 cm/s"},
              {"offset", "roughness: {rms: 5 um}", ", offset: 4 mm", "path: line, to: [35 cm, 0], speed: 25 cm/s"},
              {"lifting", "roughness: {rms: 5 um}", ", offset: 4 mm", "path: line, to: [100 cm, 0], speed: 90 cm/s"},
              {"reversal", "along: x, ridges: {spacing: 1 mm, height: 20 um}", ", patch: 120 um",
               "path: back_and_forth, to: [20 mm, 3 mm], rate: 3 Hz, duration: 1.4 s"},
              {"corners", "along: x, ridges: {spacing: 1 mm, height: 20 um}", ", patch: 120 um",
               "path: polyline, points: [[0, 0], [9 mm, 3 mm], [11 mm, 12 mm], [3 mm, 14 mm], [0, 13 mm], [1 mm, 5 "
               "mm], [14 mm, 2 mm]], duration: 1.4 s, law: minimum_jerk"},
              {"cusps", "along: x, roughness: {rms: 4 um, shortest: 40 um}", "",
               "path: polyline, points: [[0, 0], [20 mm, 0], [0, 0.001 mm], [20 mm, 0.002 mm]], duration: 1.4 s"},
              {"small circle", "along: x, ridges: {spacing: 1 mm, height: 20 um}", ", patch: 120 um",
               "path: circle, radius: 1 mm, turns: 20, speed: 10 cm/s"},
              {"circle", "along: x, ridges: {spacing: 1 mm, height: 20 um}", ", patch: 120 um",
               "path: circle, radius: 15 mm, turns: 3, speed: 20 cm/s"},
              {"ridges 8 mm apart", "along: x, ridges: {spacing: 8 mm, height: 20 um}", ", patch: 120 um",
               "path: line, to: [35 cm, 0], speed: 25 cm/s"}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        bears(of[i].name,
              ball_scene("roll", "smoothing: 0, roll: {scraping: 0}", of[i].surface,
                         arena_format(rig_arena(), "radius: 8 mm, mass: 5.4 g%s", of[i].ball), of[i].motion));
}
END_TEST

/* Ground twice as high makes a force twice as high: at a given stiffness at all frequencies, and by the rule, where a
   rougher contact is softer, below the resonance, as long as the ground has little above it. */
START_TEST(force_grows_with_the_ground)
{
    for (int ruled = 0; ruled < 2; ruled++) {
        double power[2][BANDS];
        struct roll_report report = {0};
        for (int k = 0; k < 2; k++) {
            struct scene s = ball_scene(
                "roll",
                arena_format(rig_arena(), "smoothing: 0, limiter: {curve: none}, roll: {scraping: 0, mu: 0%s}",
                             ruled ? "" : ", static_penetration: 10 um"),
                arena_format(rig_arena(), "roughness: {rms: %g um, exponent: 0, longest: 1 mm, shortest: %d um}",
                             k ? 0.04 : 0.02, ruled ? 300 : 100),
                "radius: 1 mm, mass: 5.4 g",
                ruled ? "path: line, to: [13 cm, 0], speed: 10 cm/s" : "path: line, to: [26 cm, 0], speed: 20 cm/s");
            struct rig *g = rig_record(&s, ITEM_SUBFORCE, 60000, 1024);
            thirds(g->x + 4 * 24000, power[k]);
            report = g->run.board.roll;
            rig_close(g);
        }
        for (int k = 0; k < BANDS; k++) {
            double at = 2 * pow(2, (FIRST + k) / 3.0), grows = 10 * log10(power[1][k] / power[0][k]);
            printf("%s %.0f Hz: %.3f dB, resonance %.4g Hz\n", ruled ? "rule" : "given", at, grows, report.resonance),
                fflush(stdout);
            ck_assert(at > 1700 || at < 50 || ruled || fabs(grows - 6.02) < 0.5);
            ck_assert(!ruled || at < 50 || at > 0.13 * report.resonance || fabs(grows - 6.02) < 0.5);
        }
    }
}
END_TEST

/* With follows: point the trajectory is a scraper's: on a contact so soft that it presses by 3e-10 N, and neither
   limiter nor offset, the force is that of a point of the same mass, on a profile and in the plane. Under a ball it is
   not. */
START_TEST(a_point_scrapes)
{
    static const struct {
        const char *surface, *motion;
    } of[] = {{"roughness: {rms: 5 um}", "path: line, to: [10 cm, 0], speed: 25 cm/s"},
              {"along: plane, roughness: {rms: 5 um, shortest: 60 um}",
               "path: circle, radius: 1 cm, turns: 0.5, speed: 20 cm/s"}};
    enum { FRAMES = 6000 };
    const char *common = "smoothing: 0, limiter: {curve: none}";
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        double most = 0, off = 0, apart = 0;
        struct scene tip =
            rig_scene(rig_arena(), arena_format(rig_arena(),
                                                "rasp: 1\nseed: 5\nsurface: {%s}\nscraper: {mass: 10 g}\ncontact: "
                                                "{%s}\nmotion: {%s}\nload: {approach: 0, release: 0}\n"
                                                "output: {sample_rate: 48000, diagnostics: {}}\naccuracy: "
                                                "{oversampling: 4}\n",
                                                of[i].surface, common, of[i].motion));
        struct rig *scrape = rig_record(&tip, ITEM_SUBFORCE, FRAMES, 1024);
        for (int point = 0; point < 2; point++) {
            struct scene s = ball_scene(
                "roll",
                arena_format(rig_arena(), "%s, roll: {penetration: paper, kappa: 1e-3, lambda: 0, follows: %s}", common,
                             point ? "point" : "ball"),
                of[i].surface, "radius: 1 mm, mass: 10 g", of[i].motion);
            struct rig *g = rig_record(&s, ITEM_SUBFORCE, FRAMES, 1024);
            double presses = 1e-5 * pow(1e-3, 1.5);
            ck_assert_int_eq(g->per_frame, scrape->per_frame);
            for (int k = 1; k < FRAMES * g->per_frame; k++) { /* the first B-spline has one half */
                most = fmax(most, fabs(scrape->x[k]));
                *(point ? &off : &apart) = fmax(point ? off : apart, fabs(g->x[k] - presses - scrape->x[k]));
            }
            rig_close(g);
        }
        printf("%zu: %.3g N, off by %.3g N; under a ball by %.3g N\n", i, most, off, apart), fflush(stdout);
        ck_assert_double_lt(off, 1e-12 * most + 1.5 * 1e-5 * sqrt(1e-3) * 30e-6); /* what S presses */
        ck_assert_double_gt(apart, 0.5 * most);
        rig_close(scrape);
    }
}
END_TEST

UNIT("roll_motion", UNIT_LONG(near_the_coupled_ball), UNIT_LONG(the_mean_force_is_the_normal_force),
     force_grows_with_the_ground, a_point_scrapes)
