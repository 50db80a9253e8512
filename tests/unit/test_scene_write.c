/* scene/scene_write.c: what has been written reads back as the same scene, field by field (to the bit), and is written
   as the same text again. Fields are walked by the tables of keys.h, compared here by their C types. */
#include "unit.h"

#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "pipeline/stages.h"
#include "scene/keys.h"
#include "scene/keys_yaml.h"
#include "scene/params.h"
#include "scene/scene_read.h"
#include "scene/scene_write.h"
#include "surface/roughness.h"

#define INDEX "file_name,x_m,y_m\na.wav,0,0\nb.WAV,1,0\n" /* of a folder of responses */

static const char PLAIN[] = "rasp: 1\nsurface: {roughness: {}, response: files/plank.csv}\nscraper: {mass: 20 g}\n"
                            "motion: {path: back_and_forth, to: [4.5 cm, 0], rate: 2 Hz, duration: 2 s}\n";
static const char FULL[] =
    "rasp: 1\ntitle: \"a \\\"b\\\" \\\\ \\t \\n # {c}: [d], \\u00e9 \\u2028 \\ufeff \\x7f \\x85 \\U0001F600\"\nseed: "
    "18446744073709551615\n"
    "name: 'yes'\nstart: 0.1\ngain: -0.3333333333333333\n"
    "surface: {height_map: files/map.npy, pitch: 5.6 um, height_scale: 1 nm, along: x, off_map: wrap, origin: [0.1, "
    "0.2],\n"
    "  response: files/plank.csv, modes: 7, response_length: 0.3, convolution: overlap_add, extrapolate: nearest}\n"
    "scraper: {mass: 0.1 g, weight: 0.7, response: files/plank.csv, modes: 3, convolution: resonators}\n"
    "motion: {path: line, from: [1e-3, 0.3], to: [0.7 mm, 12.3 cm], speed: 0.1, law: minimum_jerk}\n"
    "grip: {angle: 30 deg, azimuth: 77 deg, friction: 0.123}\n"
    "contact: {force: paper, beta1: 0.7, beta2: 1.1, smoothing: 0, limiter: {alpha_min: 7 mm, force_range: [0.1, 5]}}\n"
    "output: {sample_rate: 44.1 kHz, encoding: float64, channels: 2, level: {lufs: -23}, ramp: 0, tail: 0.3,\n"
    "  diagnostics: {rate: 100, columns: [time_s, speed_m_per_s]}}\n"
    "accuracy: {preset: high, oversampling: 5, gain_ramp: 7}\n";
static const char NONE[] =
    "rasp: 1\nsurface: {height_map: files/map.npy, pitch: 1 um, response: files/plank.csv}\nscraper: {mass: 1}\nload: "
    "{constant: 0.1}\n"
    "motion: {path: line, to: [1, 1], duration: 0.3}\ncontact: {limiter: {curve: none}}\naccuracy: draft\n";
static const char SEVERAL[] =
    "rasp: 1\ncontacts:\n"
    "  - {name: rod, surface: {roughness: {rms: 4 um}, response: files/plank.csv}, scraper: {mass: 20 g},\n"
    "     motion: {path: line, to: [10 cm, 0], speed: 5 cm/s}}\n"
    "  - {name: comb, start: 0.5, gain: 0.5, surface: {height_map: files/map.npy, pitch: 1 um},\n"
    "     scraper: {mass: 8 g, response: files/plank.csv}, motion: {path: line, to: [0, 10 cm], duration: 1},\n"
    "     grip: {angle: 0.1}}\n"
    "output: {diagnostics: {}}\n";
static const char EVERYTHING[] =
    "rasp: 1\nsurface: {height_map: files/map.npy, pitch: 1 um, height_range: 3 um, along: plane, holes: fill, "
    "levelling: plane, origin: [1 mm, 0.3],\n"
    "  continuation: {exponent: -2.7, from: 50 um, shortest: 3 um}, grit: {density: 12.3 /mm^2, diameter: 0.1 mm, "
    "height: 30 um, spread: 0.1},\n"
    "  roughness: {skewness: 0.7, kurtosis: 4.1, grain: 7, grain_direction: 33 deg, rms: 1.1 um, shortest: 3 um},\n"
    "  ridges: {spacing: 0.7 mm, shape: groove, width: 0.1 mm, direction: 11 deg, jitter: 0.1, variation: 0.3}}\n"
    "scraper: {mass: 1 g, radius: 0.7 mm, patch: 7 um, response: files/plank.csv}\n"
    "motion: {path: polyline, points: [[0, 0.1], [0.3, 1e-3], [0.7, 7 mm]], corner: 1 mm, duration: 0.7, law: "
    "two_thirds, straight: 0.3}\n"
    "load: {recorded: files/force.csv, approach: 3 ms, release: auto}\ncontact: {force: paper, limiter: {ratio_y: "
    "0.7}}\n";
static const char UNLIMITED[] = "rasp: 1\nsurface: {grit: {}, response: files/plank.csv}\nscraper: {mass: 1}\nmotion: "
                                "{path: line, to: [0.1, 0.3], duration: 1}\n"
                                "contact: {force: paper, limiter: {curve: none}}\n";
static const char CIRCLE[] =
    "rasp: 1\nsurface: {grit: {}, response: files/plank.csv}\nscraper: {mass: 1}\n"
    "motion: {path: circle, center: [0.1, 0.2], radius: 3 cm, start_angle: 7 deg, turns: -1.3, speed: 0.3}\n"
    "ablation: {normal_force: constant, nonlinearity: smoothed, response: constant, place: [3 cm, 0.1], sound: "
    "surface}\n";
static const char SCRIBBLE[] =
    "rasp: 1\nsurface: {roughness: {like: files/map.npy, like_pitch: 3 um}, response: files/plank.csv}\nscraper: "
    "{mass: 1}\n"
    "motion: {path: scribble, size: [3 cm, 1 cm], rate: 1.1, duration: 3, law: minimum_jerk}\n";
static const char GIVEN[] =
    "rasp: 1\nsurface: {ridges: {shape: round}, response: files/plank.csv, residual: files/plank.csv}\nscraper: {mass: "
    "1}\n"
    "motion: {path: four_in_line, to: [0.1, 0.3], strokes: 3, law: given, profile: files/speed.csv, until: 0.2 s}\n";
static const char RECORDED[] = "rasp: 1\nsurface: {ridges: {}, response: files/plank.csv}\nscraper: {mass: 1}\n"
                               "motion: {path: recorded, file: files/path.csv, cutoff: 7}\n";
static const char OBJECT[] =
    "rasp: 1\nsurface: {material: poplar, object: {shape: plate, edges: supported, length: 0.3, width: 20 cm, "
    "thickness: 7 mm, youngs_modulus: 12 GPa,\n"
    "  youngs_modulus_across: 0.7 GPa, shear_modulus: 0.9 GPa, poisson: 0.31, density: 433 kg/m^3, alpha: 11 1/s, "
    "beta: 0.1 us, loss: 0.013,\n"
    "  origin: [1 cm, -3 mm]}, moving: launch, convolution: overlap_add, modes: 77, pairing: 0.07}\n"
    "scraper: {mass: 1, radius: 3 mm, material: steel, weight: 0.3, object: {shape: rod, waves: longitudinal, edges: "
    "cantilever, length: 0.3, diameter: 1 cm,\n"
    "  thickness: 1 mm, at: [7 cm, 0]}}\n"
    "motion: {path: line, from: [0.1, 0.1], to: [0.2, 0.1], speed: 0.1}\n"
    "contact: {model: strike, gravity: 7, strike: {speed: 1.1, first: 0.1, count: 7, restitution: 0.7}}\naccuracy: "
    "{gain_ramp: 77}\n"
    "output: {listen: {radiator: plate, places: [[0, 0.1, 1], [0.3, -0.7, 0.9 m]], density: 1.1, sound_speed: 333}, "
    "stems: [force, scraper],\n"
    "  level: {dbfs_at_1_pa: -11 dB}}\n";
static const char SPACE[] = "rasp: 1\nsurface: {space: {from: [0.1, -0.3], to: [-0.5, 0.7], dimension: 1.1, "
                            "dimension_to: 3, fundamental: 333, gain: 0.7}, moving: glide}\n"
                            "scraper: {mass: 0.1}\nmotion: {path: still, at: [3 mm, 0.7 cm], duration: 3}\n"
                            "contact: {model: strike, strike: {pulse: half_sine, speed: 0.1, stiffness: 1.1 MN/m, "
                            "count: 3, interval: 0.3}}\noutput: {quantity: acceleration, level: {full_scale: 0.3}}\n";
static const char SAMPLES[] = "rasp: 1\nsurface: {material: glass, object: {shape: drum, diameter: 0.3, thickness: 0.1 "
                              "mm, surface_tension: 2.2 kN/m}}\n"
                              "motion: {path: still, duration: 3}\ncontact: {model: given, given: {file: "
                              "files/force.wav, channel: 2, scale: 7 mN}}\n"
                              "output: {listen: {places: [[0, 0, 1]]}, diagnostics: {columns: [force_mean_n]}}\n";
static const char ARRAY[] = "rasp: 1\nsurface: {object: {shape: string, length: 0.65, diameter: 0.7 mm, tension: 77 N, "
                            "density: 7800}, moving: readout, convolution: overlap_add}\n"
                            "motion: {path: circle, radius: 0.1, duration: 3}\ncontact: {model: given, given: {file: "
                            "files/map.npy, rate: 44.1 kHz}}\n"
                            "output: {listen: {radiator: point, places: [[0.1, 0.2, 0]]}, quantity: displacement}\n";
static const char TABLE[] = "rasp: 1\nsurface: {response: files/set, extrapolate: nearest, moving: launch}\nmotion: "
                            "{path: still, duration: 3}\n"
                            "contact: {model: given, given: {file: files/force.csv, column: f, scale: 3}}\noutput: "
                            "{listen: {radiator: contact}, level: {rms: -23.3}}\n";
static const char ROLL[] =
    "rasp: 1\nsurface: {fractal: {exponent: -1.1, spectrum: amplitude, maximum: 0.3 um, pitch: 70 um, length: 0.7, "
    "interpolation: linear}, response: files/plank.csv}\n"
    "ball: {radius: 1.1 cm, body: hollow, wall: 0.7 mm, material: glass, offset: 0.3 mm, start_angle: 11 deg, "
    "lobe_height: 0.7 um, lobes: 3, patch: 33 um, weight: 0.3,\n"
    "  object: {shape: shell, diameter: 2.2 cm, thickness: 0.7 mm, at: [1 mm, 0]}}\n"
    "motion: {path: incline, from: [0.1, 0], to: [0.4, 0], incline: 3.3 deg, start_speed: 0.7, rolling_friction: "
    "0.003}\n"
    "contact: {model: roll, roll: {penetration: paper, kappa: 7e4, lambda: 0.3, scraping: 0.7}}\n"
    "output: {stems: [ball], envelope: approach_recede, envelope_depth: 7 dB}\n";
static const char COUPLED[] = "rasp: 1\nsurface: {roughness: {}}\nball: {radius: 1.1 cm, mass: 7 g, patch: 0}\nmotion: "
                              "{path: still, duration: 0.3}\n"
                              "contact: {model: roll_coupled, roll: {stiffness: 1.1 GN/m^1.5, mu: 0.7, integrator: "
                              "exact_impact, ground: rigid, drop: 3 mm}}\n"
                              "output: {quantity: force, level: {full_scale: 3 N}}\naccuracy: {contact_steps: 33}\n";
static const char DEVIATION[] = "rasp: 1\nsurface: {ridges: {}, response: files/plank.csv}\nball: {radius: 1 cm, "
                                "material: oak, response: files/plank.csv}\n"
                                "motion: {path: circle, radius: 0.1, duration: 3}\ncontact: {model: roll, roll: "
                                "{static_penetration: 7 um, damping_ratio: 0.2}}\n";
static const char SERIES[] =
    "rasp: 1\ncontacts:\n"
    "- name: disk\n  motion: {path: line, to: [1 cm, 0], duration: 1 s}\n  surface: {response: files/plank.csv, "
    "gammatone: 2}\n"
    "  contact: {model: impacts, impacts: {prototype: space, space: {walk: files/walk.csv}, amplitude: {distribution: "
    "table, table: files/density.csv}}}\n"
    "- name: moving\n  motion: {path: line, to: [1 cm, 0], duration: 1 s}\n"
    "  contact: {model: impacts, impacts: {prototype: space, space: {angle: 2 rad, radius: 0.5, angle_to: 3 rad, "
    "radius_to: -0.5},\n"
    "    interval: {distribution: table, table: files/density.csv}, rub: {interval: 30 us}, scratch: {duration: 40 "
    "us}}}\n"
    "- name: own\n  motion: {path: circle, radius: 1 cm, duration: 1 s}\n  load: {approach: 1 ms, release: 2 ms}\n"
    "  contact:\n    model: impacts\n    gesture: {cutoff: 1 kHz, speed: 1 m/s, order: 1}\n"
    "    impacts:\n      prototype: custom\n      unit_force: 3 N\n      amplitude: {mean: 1, deviation: 0.1, a1: "
    "-0.9, b1: 0.1}\n"
    "      interval: {mean: 5 ms, deviation: 0.1 ms, a1: -0.8, b1: -0.1}\n      duration: {zeta: 1 ms, theta: 0.2}\n   "
    "   modulation: {depth: 0.1, rate: 2 Hz}\n"
    "      floor: {amplitude: 0.02, interval: 1 ms}\n      marginal: lognormal\n      processes: two\n"
    "output: {impacts: table, diagnostics: {}}\n";
static const char PLAYED[] =
    "rasp: 1\nsurface: {roughness: {}, material: steel, object: {shape: bar, length: 1, width: 1 cm, thickness: 1 "
    "cm}}\nmotion: {path: line, to: [1 cm, 0], duration: 1 s}\n"
    "contact: {model: playback, playback: {stiffness: 1 kN/m}, gesture: {}, comb: {gain: -0.5}, "
    "modulation: {rate: 3 Hz}, enhance: {gain: 30 dB, modes: 7}}\n";
static const char ROLLING[] =
    "rasp: 1\nmotion: {path: line, to: [1 cm, 0], duration: 1 s}\ncontact: {model: impacts, impacts: {prototype: roll, "
    "size: 0.2, velocity: 0.3, roughness: 0.4}}\noutput: {diagnostics: {}}\n";
static const char *const scenes[] = {SERIES,  PLAYED,     ROLLING, ROLL,     COUPLED, DEVIATION, OBJECT,
                                     SPACE,   SAMPLES,    ARRAY,   TABLE,    PLAIN,   FULL,      NONE,
                                     SEVERAL, EVERYTHING, CIRCLE,  SCRIBBLE, GIVEN,   RECORDED,  UNLIMITED};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

static struct arena *a;
static char root[] = "/tmp/rasp-write-XXXXXX";

static void put(const char *name, const char *text)
{
    FILE *f = fopen(name, "w");
    ck_assert_ptr_nonnull(f);
    fputs(text, f);
    fclose(f);
}

static void enter(void)
{
    a = arena_open();
    ck_assert_ptr_nonnull(mkdtemp(root));
    ck_assert_int_eq(chdir(root), 0);
    ck_assert(mkdir("in", 0700) == 0 && mkdir("in/files", 0700) == 0 && mkdir("out", 0700) == 0);
    put("in/files/plank.csv", "a table\n");
    put("in/files/map.npy", "a map\n");
    put("in/files/force.csv", "a force\n");
    put("in/files/force.wav", "a sound\n");
    ck_assert_int_eq(mkdir("in/files/set", 0700), 0);
    put("in/files/set/index.csv", INDEX);
    put("in/files/set/b.WAV", "a sound at b\n");
    put("in/files/set/a.wav", "a sound at a\n");
    put("in/files/set/remarks.txt", "not read\n");
    put("in/files/speed.csv", "a speed\n");
    put("in/files/path.csv", "a path\n");
    put("in/files/walk.csv", "a walk\n");
    put("in/files/density.csv", "a density\n");
    put("in/files/recipe.yaml", "title: worn wood\nsource: made up\nroughness: {rms: 7 um, exponent: -3}\nridges: "
                                "{spacing: 0.7 mm}\nresponse: plank.csv\n");
}

static void leave(void)
{
    static const char *const files[] = {"in/files/plank.csv", "in/files/map.npy",         "in/files/force.csv",
                                        "in/files/force.wav", "in/files/set/index.csv",   "in/files/set/a.wav",
                                        "in/files/set/b.WAV", "in/files/set/remarks.txt", "in/files/speed.csv",
                                        "in/files/path.csv",  "in/files/recipe.yaml",     "in/scene.yaml",
                                        "in/files/walk.csv",  "in/files/density.csv",     "out/scene.yaml"},
                             *const folders[] = {"in/files/set", "in/files", "in", "out", root};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        unlink(files[i]);
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++)
        rmdir(folders[i]);
    arena_close(a);
}

static bool try_read(const char *file, const struct scene_overrides *over, struct scene *s, const char **messages)
{
    struct err e = {0};
    return scene_read(file, over, a, s, messages, &e);
}

static void must_read(const char *file, struct scene *s)
{
    const char *messages = "";
    ck_assert_msg(try_read(file, NULL, s, &messages), "%s", messages);
}

/* ------------------------------------------------------------------ comparison */

static bool same_double(double x, double y) { return isnan(x) ? isnan(y) : memcmp(&x, &y, sizeof x) == 0; }

static bool same_text(const char *x, const char *y) { return x && y ? !strcmp(x, y) : x == y; }

static bool same_file(const char *x, const char *y)
{
    struct stat s, t;
    return x && y ? stat(x, &s) == 0 && stat(y, &t) == 0 && s.st_ino == t.st_ino : x == y;
}

static bool same_list(const char *const *x, const char *const *y)
{
    for (; x && y && *x && *y; x++, y++)
        if (strcmp(*x, *y) != 0) return false;
    return x && y ? *x == *y : x == y;
}

static bool same_points(const struct key *k, const void *x, const void *y)
{
    int n = *keys_points_count(x);
    const double *xd = *(const double *const *)x, *yd = *(const double *const *)y;
    return n == *keys_points_count(y) &&
           (n ? memcmp(xd, yd, (k->type == KEY_PLACES ? 3 : 2) * (size_t)n * sizeof *xd) == 0 : xd == yd);
}

static bool same_field(const struct key *k, const void *x, const void *y)
{
    const double *xd = x, *yd = y;
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_WHOLE:
    case KEY_TIME_OR_AUTO:
        return same_double(*xd, *yd);
    case KEY_POINT:
    case KEY_RANGE:
        return same_double(xd[0], yd[0]) && same_double(xd[1], yd[1]);
    case KEY_COUNT:
    case KEY_CHOICE:
        return *(const int *)x == *(const int *)y;
    case KEY_SEED:
        return *(const uint64_t *)x == *(const uint64_t *)y;
    case KEY_TEXT:
        return same_text(*(const char *const *)x, *(const char *const *)y);
    case KEY_FILE:
        return !strcmp(k->path, "surface.recipe") ||
               same_file(*(const char *const *)x, *(const char *const *)y); /* it is merged in */
    case KEY_POINTS:
    case KEY_PLACES:
        return same_points(k, x, y);
    case KEY_LIST:
        return same_list(*(const char *const *const *)x, *(const char *const *const *)y);
    }
    return false;
}

static void same_part(enum key_struct of, const void *x, const void *y, const char *text)
{
    for (const struct key *k = keys_table; k->path; k++)
        if (k->of == of && strcmp(k->path, "written_by") != 0) /* the program of the text, not of what was read */
            ck_assert_msg(same_field(k, keys_field(k, x), keys_field(k, y)), "%s differs after:\n%s", k->path, text);
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (s->of == of) ck_assert_msg(*keys_given(s, x) == *keys_given(s, y), "%s: given", s->path);
}

/* What the effective scene spells out beyond the fields: the weight of a scraper that no hand holds, and the level of
 * what sounds. */
static void spell_out(struct scene *s)
{
    struct level *level = &s->output.level;
    bool sounds = false;
    for (int i = 0; i < s->n_contacts; i++) {
        struct contact *c = &s->contacts[i];
        double weight = c->scraper.mass * c->contact.gravity;
        bool rings = c->surface.response.file || c->surface.response.object.given || c->surface.response.space.given;
        bool scraper_rings = (c->scraper.response.file || c->scraper.response.object.given) && c->scraper.weight != 0;
        if (c->contact.model == CONTACT_SCRAPE && isnan(c->load.constant) && !c->grip.given && !c->load.recorded &&
            weight <= 1e5) /* the key's range */
            c->load.constant = weight;
        sounds = sounds || (c->gain != 0 && (rings || scraper_rings));
    }
    if (sounds && isnan(level->full_scale) && isnan(level->peak) && isnan(level->rms) && isnan(level->lufs) &&
        isnan(level->dbfs_at_1_pa))
        level->peak = -3;
}

static void same_scene(const struct scene *x, const struct scene *y, const char *text)
{
    same_part(KEY_SCENE, x, y, text);
    ck_assert_int_eq(x->n_contacts, y->n_contacts);
    for (int i = 0; i < x->n_contacts; i++)
        same_part(KEY_CONTACT, &x->contacts[i], &y->contacts[i], text);
    ck_assert_str_eq(x->accuracy.preset, y->accuracy.preset);
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        ck_assert_msg(same_double(*(const double *)((const char *)&x->accuracy + k->offset),
                                  *(const double *)((const char *)&y->accuracy + k->offset)),
                      "%s", k->name);
}

static void round_trip(struct scene *s)
{
    struct scene again;
    const char *text = scene_write(s, "out", a);
    put("out/scene.yaml", text);
    must_read("out/scene.yaml", &again);
    spell_out(s);
    same_scene(s, &again, text);
    ck_assert_str_eq(scene_write(&again, "out", a), text);
}

/* ------------------------------------------------------------------ tests */

START_TEST(test_round_trip)
{
    struct scene s;
    enter();
    for (int i = 0; i < SCENES; i++) {
        put("in/scene.yaml", scenes[i]);
        must_read("in/scene.yaml", &s);
        round_trip(&s);
    }
    leave();
}
END_TEST

/* Between low and high, in the logarithm if both are above 0; bits at random otherwise. */
static double any_between(double low, double high)
{
    double u = drand48();
    return low > 0 ? fmin(high, fmax(low, low * pow(high / low, u))) : low + u * (high - low);
}

/* In a section that is not given? */
static bool is_absent(const struct key *k, const void *owner)
{
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (!strncmp(k->path, s->path, strlen(s->path)) && k->path[strlen(s->path)] == '.' && !*keys_given(s, owner))
            return true;
    return false;
}

/* --set for each of the scene's numbers that is given, with a probability of a half. */
static void any_numbers(const struct scene *s, struct scene_overrides *over)
{
    for (const struct key *k = keys_table; k->path; k++) {
        const void *owner = k->of == KEY_SCENE ? (const void *)s : (const void *)s->contacts;
        bool number = k->type == KEY_NUMBER && !isnan(*(const double *)keys_field(k, owner));
        if (number && !is_absent(k, owner) && drand48() < 0.5)
            over->set[over->n++] = arena_format(a, "%s=%.17g", k->path, any_between(k->low, k->high));
    }
}

START_TEST(test_any_numbers)
{
    int tried = 0, good = 0;
    enter();
    srand48(1);
    for (int i = 0; i < SCENES; i++) {
        struct scene s, varied;
        const char *messages;
        put("in/scene.yaml", scenes[i]);
        must_read("in/scene.yaml", &s);
        for (int j = 0; s.n_contacts == 1 && j < 40; j++) {
            struct scene_overrides over = {.set = ARENA_TAKE(a, const char *, 128)};
            any_numbers(&s, &over);
            tried++;
            if (!try_read("in/scene.yaml", &over, &varied,
                          &messages)) /* alpha_min above alpha_max, a motion too long ... */
                continue;
            good++;
            round_trip(&varied);
        }
    }
    leave();
    ck_assert_msg(good > tried / 20, "only %d of %d are scenes", good, tried);
}
END_TEST

/* So that the round trips above miss none: every key is in some effective scene, in a section of its own name. */
START_TEST(test_every_key_is_written)
{
    const char *all = "";
    struct scene s;
    enter();
    for (int i = 0; i < SCENES; i++) {
        put("in/scene.yaml", scenes[i]);
        must_read("in/scene.yaml", &s);
        all = arena_format(a, "%s\n%s", all, scene_write(&s, "out", a));
    }
    for (const struct key *k = keys_table; k->path; k++) {
        const char *dot = strrchr(k->path, '.'), *name = dot ? dot + 1 : k->path;
        bool there = strstr(all, arena_format(a, "%s%s: ", dot ? "  " : "\n", name)) ||
                     strstr(all, arena_format(a, "- %s: ", name));
        ck_assert_msg(there || !strcmp(k->path, "surface.recipe"), "%s is in no scene here", k->path);
    }
    leave();
}
END_TEST

START_TEST(test_what_does_not_apply_is_left_out)
{
    static const char *const absent[] = {
        " rate:",   "ridges:", "grit:",  "continuation:", "recipe:",    "points:", "radius:",  "patch:", "width:",
        "profile:", "leak:",   "alpha:", "grip:",         "roughness:", "title:",  "columns:", "speed:"};
    struct scene s;
    enter();
    put("in/scene.yaml",
        "rasp: 1\nsurface: {height_map: files/map.npy, pitch: 1 um, response: files/plank.csv}\nscraper: {mass: 1}\n"
        "motion: {path: line, to: [1, 1], duration: 0.3}\ncontact: {force: paper, limiter: {curve: none}}\n");
    must_read("in/scene.yaml", &s);
    const char *text = scene_write(&s, "in", a);
    for (size_t i = 0; i < sizeof absent / sizeof absent[0]; i++)
        ck_assert_msg(!strstr(text, absent[i]), "%s is in:\n%s", absent[i], text);
    ck_assert_ptr_nonnull(strstr(text, "  law: auto\n"));
    leave();
}
END_TEST

/* Which defaults that are no value of their key are written, and where not. */
START_TEST(test_unsaid_defaults_are_spelt_out)
{
    static const char scene[] =
        "rasp: 1\nsurface: {roughness: {}%s}\nscraper: {mass: %s}\nmotion: {path: line, to: [1, 1], duration: 0.3}\n"
        "contact: {gravity: %s}\noutput: {diagnostics: {}%s}\n%s";
    static const char rings[] = ", response: files/plank.csv", peak[] = "  level:\n    peak: -3\n",
                      load[] = "load:\n  constant: 196\n";
    static const struct {
        const char *rings, *mass, *gravity, *output, *rest, *level, *load; /* "": is not written */
    } cases[] = {{rings, "20", "9.8", "", "", peak, load},
                 {"", "20", "9.8", "", "", "", load},
                 {rings, "20", "9.8", "", "gain: 0\n", "", load},
                 {rings, "20", "9.8", "", "grip: {}\n", peak, ""},
                 {rings, "20", "9.8", ", level: {rms: -20 dB}", "load: {constant: 3 N}\n", "  level:\n    rms: -20\n",
                  "load:\n  constant: 3\n"},
                 {rings, "20", "9.8", ", level: {full_scale: 2}", "", "  level:\n    full_scale: 2\n", load},
                 {rings, "1000", "500", "", "", peak, ""}}; /* 500 kN, more than load.constant may be */
    struct scene s;
    enter();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        put("in/scene.yaml",
            arena_format(a, scene, cases[i].rings, cases[i].mass, cases[i].gravity, cases[i].output, cases[i].rest));
        must_read("in/scene.yaml", &s);
        const char *text = scene_write(&s, "in", a);
        ck_assert_msg(*cases[i].level ? strstr(text, cases[i].level) != NULL : !strstr(text, "level:"),
                      "%zu: level in\n%s", i, text);
        ck_assert_msg(*cases[i].load ? strstr(text, cases[i].load) != NULL : !strstr(text, "\n  constant:"),
                      "%zu: load in\n%s", i, text);
    }
    leave();
}
END_TEST

START_TEST(test_inputs)
{
    struct scene s;
    char hex[HASH_TEXT];
    enter();
    put("in/scene.yaml", SEVERAL);
    must_read("in/scene.yaml", &s);
    hash_bytes("a table\n", 8, hex);
    const char *text = scene_write(&s, "out", a);
    const char *entry = arena_format(a, "  - file: \"../in/files/plank.csv\"\n    sha256: \"%s\"\n", hex);
    ck_assert_msg(strstr(text, entry) != NULL, "%s lacks\n%s", text, entry);
    ck_assert_msg(!strstr(strstr(text, entry) + 10, "- file: \"../in/files/plank.csv\""), "listed twice:\n%s", text);
    unlink("in/files/plank.csv");
    text = scene_write(&s, "out", a);
    ck_assert_ptr_nonnull(strstr(text, "plank.csv\"\n    # could not be read when this was written\n"));
    s.n_inputs = 1;
    s.inputs = &(struct input){"in/files/plank.csv", hex};
    ck_assert_str_eq(strstr(scene_write(&s, "out", a), entry),
                     strstr(scene_write(&s, "out", a), "  - file: \"../in/files/plank.csv\""));
    leave();
}
END_TEST

/* The hashes of all files that a scene names. */
START_TEST(test_every_file_is_an_input)
{
    struct scene s;
    enter();
    static const char *const named[][3] = {
        {EVERYTHING, "force.csv", "a force\n"}, {GIVEN, "speed.csv", "a speed\n"},
        {RECORDED, "path.csv", "a path\n"},     {SCRIBBLE, "map.npy", "a map\n"},
        {SAMPLES, "force.wav", "a sound\n"},    {TABLE, "set/index.csv", INDEX},
        {TABLE, "set/a.wav", "a sound at a\n"}, {TABLE, "set/b.WAV", "a sound at b\n"}};
    for (size_t i = 0; i < sizeof named / sizeof named[0]; i++) {
        char hex[HASH_TEXT];
        put("in/scene.yaml", named[i][0]);
        must_read("in/scene.yaml", &s);
        hash_bytes(named[i][2], strlen(named[i][2]), hex);
        const char *text = scene_write(&s, "in", a),
                   *entry = arena_format(a, "  - file: \"files/%s\"\n    sha256: \"%s\"\n", named[i][1], hex);
        ck_assert_msg(strstr(text, entry) != NULL, "%s lacks\n%s", text, entry);
        ck_assert_msg(!strstr(text, "file: \"files/set\"") && !strstr(text, "remarks"), "%s",
                      text); /* a folder is what is read of it */
    }
    leave();
}
END_TEST

/* A recipe's keys are written as the scene's own, which then needs the recipe no more but as an input that must not
   have changed; what a null took away stays away. */
START_TEST(test_recipe)
{
    struct scene s, again;
    enter();
    put("in/scene.yaml",
        "rasp: 1\nsurface: {recipe: files/recipe.yaml, roughness: {rms: 3 um}, ridges: null}\nscraper: {mass: 1}\n"
        "motion: {path: line, to: [1, 1], duration: 0.3}\n");
    must_read("in/scene.yaml", &s);
    const struct surface *f = &s.contacts->surface;
    const struct roughness *rough = params_of(s.contacts, roughness_stage.params);
    ck_assert(rough->rms == 3e-6 && rough->exponent == -3 && !params_given(s.contacts, ridges_stage.params));
    ck_assert_str_eq(f->recipe, "in/files/recipe.yaml");
    ck_assert_str_eq(f->response.file, "in/files/plank.csv"); /* as seen from the recipe */
    const char *text = scene_write(&s, "out", a);
    ck_assert_msg(!strstr(text, "recipe:") && strstr(text, "  - file: \"../in/files/recipe.yaml\"\n    sha256: \""),
                  "%s", text);
    put("out/scene.yaml", text);
    must_read("out/scene.yaml", &again);
    spell_out(&s);
    same_scene(&s, &again, text);
    ck_assert_str_eq(scene_write(&again, "out", a), text);
    leave();
}
END_TEST

START_TEST(test_numbers)
{
    static const struct {
        double x;
        const char *text;
    } cases[] = {{0.1, "0.1"},     {0.02, "0.02"}, {1.0 / 3, "0.3333333333333333"}, {0.1 + 0.2, "0.30000000000000004"},
                 {48000, "48000"}, {5e-5, "5e-05"}};
    a = arena_open();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        ck_assert_str_eq(keys_yaml_number(cases[i].x, a), cases[i].text);
    arena_close(a);
}
END_TEST

UNIT("scene_write", test_round_trip, test_any_numbers, test_every_key_is_written, test_what_does_not_apply_is_left_out,
     test_unsaid_defaults_are_spelt_out, test_inputs, test_every_file_is_an_input, test_recipe, test_numbers)
