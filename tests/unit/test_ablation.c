/* What is left out (section ablation): a normal force held is the mean of the one that varies, over whole motions; a
   surface followed exactly makes the force of its closed form, with and without smoothing; a response of one place is
   that of a table of this place alone; the two bodies apart add up to both; and what cannot be left out is told. Stages
   and what stays bit for bit: tests/effects/list. */
#include <math.h>

#include "renders.h"
#include "scenes.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"

#define PI 3.14159265358979323846

/* ------------------------------------------------------------------ the normal force */

static struct contact held(const struct motion *m, double azimuth)
{
    return (struct contact){.name = "rod",
                            .scraper = {.mass = 0.02},
                            .motion = *m,
                            .grip = {true, 0.5, azimuth, 0.3},
                            .load = {.constant = NAN, .approach = NAN, .release = NAN},
                            .contact = {.gravity = 9.80665}};
}

/* The mean of N(t) as it varies, and all of N as it is held: to the error of 2e5 midpoints, of smooth periods far below
 * 1e-9. */
static void mean_is_held(const char *what, struct contact c)
{
    enum { POINTS = 200000 };
    struct trajectory tr;
    struct load_law law, still;
    struct err e = {0};
    long double sum = 0;
    ck_assert_msg(trajectory_make(&c.motion, 1, folder_arena, &tr, &e) && load_make(&c, &tr, folder_arena, &law, &e),
                  "%s", e.text);
    ck_assert(load_varies(&c));
    for (int i = 0; i < POINTS; i++)
        sum += load_of(&law, &tr, tr.duration * (i + 0.5) / POINTS);
    ck_assert_msg(law.most > 1.001 * law.least, "%s: it does not vary", what);
    c.ablation.normal_force = ABLATED_FORCE_CONSTANT;
    ck_assert(!load_varies(&c));
    ck_assert_msg(load_make(&c, &tr, folder_arena, &still, &e), "%s", e.text);
    double mean = (double)(sum / POINTS), n = load_constant(&c);
    ck_assert_msg(fabs(n / mean - 1) < 1e-8, "%s: held at %.12g N, the mean is %.12g N", what, n, mean);
    ck_assert(still.least == n && still.most == n && load_of(&still, &tr, 0.3 * tr.duration) == n);
}

START_TEST(test_mean)
{
    folder_make();
    const struct motion strokes = {
        .path = PATH_BACK_AND_FORTH, .to = {0.06, 0.02}, .rate = 2, .duration = 1.5, .speed = NAN};
    const struct motion circle = {
        .path = PATH_CIRCLE, .radius = 0.03, .turns = 3, .duration = 2, .speed = NAN, .start_angle = 0.4};
    const struct motion stroke = {
        .path = PATH_LINE, .to = {0.1, 0}, .duration = 0.5, .speed = NAN, .law = SPEED_MINIMUM_JERK};
    mean_is_held("strokes", held(&strokes, 0.3));
    mean_is_held("circle", held(&circle, 1));
    mean_is_held("stroke", held(&stroke, 0));
    folder_remove();
}
END_TEST

/* Three turns. */
START_TEST(test_mean_of_ball)
{
    folder_make();
    const struct motion line = {.path = PATH_LINE, .to = {3 * 2 * PI * 0.02, 0}, .duration = 0.8, .speed = NAN};
    struct contact c = {.name = "ball",
                        .motion = line,
                        .ball = {.radius = 0.02, .mass = 0.05, .offset = 0.002, .lobes = 2},
                        .grip = {.given = false},
                        .load = {.constant = NAN, .approach = NAN, .release = NAN},
                        .contact = {.model = CONTACT_ROLL, .gravity = 9.80665}};
    contact_derive(&c, NULL);
    mean_is_held("ball", c);
    c.ball.lobe_height = 1e-4;
    mean_is_held("ball with lobes", c);
    folder_remove();
}
END_TEST

/* ------------------------------------------------------------------ the surface followed exactly */

/* Amplitude of the force, from its rms over whole ridges in the middle of the motion. */
static double amplitude(const char *ablation)
{
    char text[1200];
    snprintf(text, sizeof text,
             "rasp: 1\nsurface: {along: path, ridges: {spacing: 1 mm, height: 40 um}}\nscraper: {mass: 20 g}\nmotion: "
             "{path: line, to: [0.5 m, 0], duration: 1 s}\n"
             "load: {constant: 1 N}\ncontact: {beta1: 0}\n%soutput: {quantity: force, tail: 0, encoding: float64, "
             "level: {full_scale: 1 N}}\n",
             ablation);
    renders_made(text, "followed");
    struct wav w = renders_sound("followed.wav");
    double sum = 0;
    for (int i = 9600; i < 38400; i++) /* 0.6 s, 300 ridges */
        sum += w.x[i] * w.x[i];
    return sqrt(2 * sum / 28800);
}

/* f = m v^2 dS'/ds of dS'/ds + S'/l = z'', z = (h/2) sin(k s): m v^2 (h/2) k^3 / sqrt(k^2 + 1/l^2); a Gaussian of sigma
   seconds takes exp(-(k v sigma)^2/2) of it. 500 Hz at 48 kHz: what hats and the decimator's passband leave is below
   1e-4. */
START_TEST(test_followed)
{
    folder_make();
    double k = 2 * PI / 1e-3, v = 0.5, l = 2e-3, sigma = 50e-6;
    double whole = 0.02 * v * v * 20e-6 * k * k * k / sqrt(k * k + 1 / (l * l)),
           smooth = exp(-0.5 * k * v * sigma * k * v * sigma);
    double omitted = amplitude("ablation: {nonlinearity: omitted}\n"),
           smoothed = amplitude("ablation: {nonlinearity: smoothed}\n");
    ck_assert_msg(fabs(omitted / whole - 1) < 1e-4, "%.8g N, not %.8g", omitted, whole);
    ck_assert_msg(fabs(smoothed / (whole * smooth) - 1) < 1e-4, "%.8g N, not %.8g", smoothed, whole * smooth);
    ck_assert(amplitude("") < 0.2 * whole);
    folder_remove();
}
END_TEST

/* ------------------------------------------------------------------ responses */

static void table_write(const char *name, const char *poles, int places, const double *x, const double *gain,
                        const double *frequency)
{
    FILE *f = fopen(folder_path(name), "w");
    fprintf(f, "# poles: %s\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n",
            poles);
    for (int p = 0; p < places; p++)
        for (int i = 0; i < 2; i++)
            fprintf(f, "%d,%.17g,0,%d,%.17g,%d,%.17g,0\n", p, x[p], i, frequency[p] * (1 + 2 * i), 40 + 10 * i,
                    gain[p] / (1 + i));
    fclose(f);
}

static const char scrape[] =
    "rasp: 1\nsurface: {roughness: {}, response: %s, extrapolate: nearest}\nscraper: {mass: 20 g}\n"
    "motion: {path: line, to: [10 cm, 0], duration: 0.2 s, law: minimum_jerk}\ngrip: {}\n%s"
    "output: {tail: 0.1 s, encoding: float64, level: {full_scale: 1 mm/s}}\n";

static struct wav scraped(const char *table, const char *more)
{
    char text[1200];
    snprintf(text, sizeof text, scrape, table, more);
    renders_made(text, "scraped");
    return renders_sound("scraped.wav");
}

/* Relative rms of a's difference from b + c (c may be NULL). */
static double apart(const struct wav *a, const struct wav *b, const struct wav *c)
{
    double sum = 0, whole = 0;
    ck_assert_int_eq(a->frames, b->frames);
    for (long i = 0; i < (long)a->frames; i++) {
        double d = a->x[i] - b->x[i] - (c ? c->x[i] : 0);
        sum += d * d;
        whole += a->x[i] * a->x[i];
    }
    ck_assert(whole > 0);
    return sqrt(sum / whole);
}

/* Between the places 0 and 10 cm: of shared poles gains are linear, of separate ones frequencies and gains go by their
 * logarithms. */
static void one_place(const char *poles, const double *gain, const double *frequency, double g, double f)
{
    table_write("two.csv", poles, 2, (double[]){0, 0.1}, gain, frequency);
    table_write("one.csv", poles, 1, (double[]){0}, &g, &f);
    table_write("first.csv", poles, 1, (double[]){0}, gain, frequency);
    struct wav there = scraped("two.csv", "ablation: {response: constant, place: [5 cm, 0]}\n"),
               one = scraped("one.csv", "");
    struct wav start = scraped("two.csv", "ablation: {response: constant}\n"), first = scraped("first.csv", ""),
               moves = scraped("two.csv", "");
    ck_assert_msg(apart(&there, &one, NULL) < 1e-9, "%s: %g", poles, apart(&there, &one, NULL));
    ck_assert_msg(apart(&start, &first, NULL) < 1e-9, "%s: %g", poles, apart(&start, &first, NULL));
    ck_assert(apart(&moves, &one, NULL) > 0.01 && apart(&moves, &first, NULL) > 0.01);
}

START_TEST(test_one_place)
{
    folder_make();
    one_place("shared", (double[]){1, -3}, (double[]){500, 500}, -1, 500);
    one_place("separate", (double[]){1, 4}, (double[]){500, 520}, 2, sqrt(500.0 * 520));
    folder_remove();
}
END_TEST

/* By weight 0 it is the same sound, to the bit; sums are those of doubles. */
START_TEST(test_apart)
{
    folder_make();
    table_write("plank.csv", "shared", 2, (double[]){0, 0.1}, (double[]){1, -3}, (double[]){500, 500});
    table_write("rod.csv", "shared", 1, (double[]){0}, (double[]){2}, (double[]){900});
    char text[1200], both[1400];
    snprintf(text, sizeof text,
             "rasp: 1\nsurface: {roughness: {}, response: plank.csv}\nscraper: {mass: 20 g, response: rod.csv, weight: "
             "0.7}\n"
             "motion: {path: line, to: [10 cm, 0], duration: 0.2 s}\noutput: {tail: 0.1 s, encoding: float64, level: "
             "{full_scale: 1 mm/s}}\n");
    struct wav sound[4];
    const char *const more[3] = {"", "ablation: {sound: surface}\n", "ablation: {sound: scraper}\n"};
    for (int i = 0; i < 3; i++) {
        snprintf(both, sizeof both, "%s%s", text, more[i]);
        renders_made(both, "body");
        sound[i] = renders_sound("body.wav");
    }
    ck_assert_msg(apart(&sound[0], &sound[1], &sound[2]) < 1e-14, "%g", apart(&sound[0], &sound[1], &sound[2]));
    for (int i = 0; i < 2; i++) { /* or without weight, with the same knobs */
        snprintf(both, sizeof both, "%s%saccuracy: {oversampling: 4, gain_ramp: 64}\n", text, i ? "" : more[1]);
        if (i) memcpy(strstr(both, "0.7"), "0.0", 3);
        renders_made(both, "body");
        sound[2 + i] = renders_sound("body.wav");
    }
    ck_assert(apart(&sound[2], &sound[3], NULL) == 0);
    folder_remove();
}
END_TEST

/* ------------------------------------------------------------------ scenes */

/* The effective scene says what is left out, and is the same sound. */
START_TEST(test_effective)
{
    folder_make();
    table_write("plank.csv", "shared", 2, (double[]){0, 0.1}, (double[]){1, -3}, (double[]){500, 500});
    struct wav first = scraped("plank.csv", "contact: {force: paper, limiter: {ratio_y: 2}}\nablation: {nonlinearity: "
                                            "omitted, normal_force: constant, response: constant, place: [3 cm, 0]}\n");
    struct scene s;
    struct err e = {0};
    const char *messages;
    struct render_report report;
    ck_assert_msg(scene_read(folder_path("scraped.scene.yaml"), NULL, folder_arena, &s, &messages, &e), "%s", messages);
    ck_assert_str_eq(contact_ablation(&s.contacts[0], folder_arena),
                     "normal_force: constant, nonlinearity: omitted, response: constant");
    ck_assert_msg(render_scene(&s, folder_path("again"), folder_arena, &report, &e), "%s", e.text);
    struct wav again = renders_sound("again.wav");
    ck_assert(apart(&first, &again, NULL) == 0);
    folder_remove();
}
END_TEST

START_TEST(test_errors)
{
    struct result r = read_with(MIN "ablation: {sound: ball}\n", NULL);
    one_error(&r, "scenes/t.yaml:5:19", "ablation.sound is ball, and what touches the surface here is called scraper",
              "write ablation.sound: scraper");
    arena_close(r.arena);
    r = read_with(MIN "ablation: {sound: scraper}\n", NULL);
    one_error(&r, "scenes/t.yaml:5:19", "ablation.sound is scraper, which does not ring: nothing would be heard",
              "give scraper.response and a weight above 0");
    arena_close(r.arena);
    r = read_with(MIN "load: {recorded: n.csv}\nablation: {normal_force: constant}\n", NULL);
    one_error(&r, "scenes/t.yaml:6:26",
              "ablation.normal_force is constant, and a recorded force has no mean that is known",
              "give load.constant");
    arena_close(r.arena);
    r = read_with(MIN "ablation: {place: [1 cm, 0]}\n", NULL);
    one_error(&r, "scenes/t.yaml:5:12", "ablation.place applies only where ablation.response is constant", "");
    arena_close(r.arena);
}
END_TEST

UNIT("ablation", test_mean, test_mean_of_ball, test_followed, test_one_place, test_apart, test_effective, test_errors)
