/* Designs: cells, seeds, order, names and columns against lists worked out by hand, and what must not change when a
 * design grows. */
#include <pthread.h>

#include "base/hash.h"
#include "batch/design.h"
#include "folder.h"
#include "unit.h"

static struct arena *arena;

static const char scene[] =
    "rasp: 1\ntitle: t\nseed: 3\nsurface: {roughness: {rms: 4 um}, response: x.csv}\nscraper: {mass: 20 g}\n"
    "motion: {path: back_and_forth, from: [0, 0], to: [6 cm, 0], rate: 2 Hz, duration: 1 s}\nload: {constant: 1 N}\n";

static bool try_read(const char *text, struct design *d, const char **messages, struct err *e)
{
    folder_write("design.yaml", text);
    folder_write("scene.yaml", scene);
    return design_read(folder_path("design.yaml"), arena, d, messages, e);
}

static struct design made(const char *rest)
{
    struct design d;
    const char *messages;
    struct err e = {0};
    char text[8000];
    snprintf(text, sizeof text, "rasp-design: 1\nbase: scene.yaml\n%s", rest);
    bool good = try_read(text, &d, &messages, &e);
    ck_assert_msg(good, "%s", messages);
    return d;
}

static void refused(const char *rest, const char *says)
{
    struct design d;
    const char *messages;
    struct err e = {0};
    char text[8000];
    snprintf(text, sizeof text, "rasp-design: 1\nbase: scene.yaml\n%s", rest);
    ck_assert_msg(!try_read(text, &d, &messages, &e), "accepted: %s", rest);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(messages, says) != NULL, "%s\ndoes not say: %s", messages, says);
}

static void names_are(const struct design *d, const char *names)
{
    char all[4000] = "";
    for (int i = 0; i < d->n_stimuli; i++)
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i ? " " : "", d->stimuli[i].name);
    ck_assert_str_eq(all, names);
}

#define TWO                                                                                                            \
    "factors:\n  motion.rate: [1 Hz, 2 Hz]\n  material:\n    - {label: dark wood, set: {surface.response: a.csv}}\n  " \
    "  - {label: metal}\n"

START_TEST(crossed_first_factor_slowest)
{
    arena = folder_make();
    struct design d = made(TWO "replicates: 2\n");
    names_are(&d, "1Hz_dark_wood_r1 1Hz_dark_wood_r2 1Hz_metal_r1 1Hz_metal_r2 2Hz_dark_wood_r1 2Hz_dark_wood_r2 "
                  "2Hz_metal_r1 2Hz_metal_r2");
    ck_assert_int_eq(d.stimuli[5].cell, 2);
    ck_assert_int_eq(d.stimuli[5].replicate, 2);
    ck_assert_str_eq(design_label(&d, 5, 1), "dark wood");
    ck_assert_str_eq(d.factors[1].levels[0].set[0], "surface.response=a.csv");
    ck_assert_ptr_null(d.factors[1].levels[1].set[0]);
    folder_remove();
}
END_TEST

START_TEST(names_are_padded)
{
    arena = folder_make();
    struct design d = made("replicates: 11\nname: \"x/{replicate}-{cell}-{order}\"\n");
    ck_assert_str_eq(d.stimuli[0].name, "x/01-1-01");
    ck_assert_str_eq(d.stimuli[10].name, "x/11-1-11");
    folder_remove();
}
END_TEST

START_TEST(without_factors_the_base_gives_the_name)
{
    arena = folder_make();
    struct design one = made(""), two = made("replicates: 2\n");
    names_are(&one, "scene");
    names_are(&two, "scene_r1 scene_r2");
    folder_remove();
}
END_TEST

START_TEST(labels_in_names)
{
    arena = folder_make();
    struct design d = made(
        "factors:\n  scraper.mass: [10 g, 2e-2 kg]\n  load.constant: [1 N]\n  surface.roughness.rms: [10 \xc2\xb5m]\n"
        "  surface.response: [../irs/a b.csv]\n  x: [{label: -3 dB (10%)}]\n");
    names_are(&d, "10g_1N_10um_a_b_-3dB__10__ 2e-2kg_1N_10um_a_b_-3dB__10__");
    folder_remove();
}
END_TEST

START_TEST(excluded_cells_and_lists)
{
    arena = folder_make();
    struct design d = made(TWO "exclude: [{material: metal, motion.rate: [2 Hz]}]\n");
    names_are(&d, "1Hz_dark_wood 1Hz_metal 2Hz_dark_wood");
    struct design l =
        made(TWO "cells: [{material: metal, motion.rate: 2 Hz}, {motion.rate: 1 Hz, material: dark wood}]\n");
    names_are(&l, "2Hz_metal 1Hz_dark_wood");
    ck_assert_int_eq(l.stimuli[0].level[0], 1);
    folder_remove();
}
END_TEST

START_TEST(recordings_are_cells)
{
    arena = folder_make();
    struct design d = made(TWO "replicates: 2\nexclude: [{motion.rate: 2 Hz}]\nrecordings: [{file: rec/wood plank.wav, "
                               "material: dark wood}, {file: b.wav, name: \"{material}/x\"}]\n");
    names_are(&d, "1Hz_dark_wood_r1 1Hz_dark_wood_r2 1Hz_metal_r1 1Hz_metal_r2 wood_plank na/x");
    ck_assert_str_eq(d.stimuli[4].recording, folder_path("rec/wood plank.wav"));
    ck_assert_int_eq(d.stimuli[4].cell, 2);
    ck_assert_int_eq(d.stimuli[4].level[0], -1);
    ck_assert_str_eq(design_label(&d, 4, 0), "n/a");
    ck_assert_str_eq(design_value(&d, 4, 1), "dark wood");
    struct scene s;
    const char *messages;
    struct err e = {0};
    ck_assert(!design_scene(&d, 4, arena, &s, &messages, &e));
    ck_assert_int_eq(e.kind, ERR_USAGE);
    folder_remove();
}
END_TEST

/* SHA-256 of the documented text, by hash_bytes on the whole of it. */
static uint64_t seed_by_hand(const char *text, size_t n)
{
    char hex[HASH_TEXT];
    hash_bytes(text, n, hex);
    hex[16] = '\0';
    return strtoull(hex, NULL, 16);
}

START_TEST(seeds_are_the_documented_hash)
{
    static const char plain[] = "rasp design seed\0"
                                "5\0"
                                "2",
                      with[] = "rasp design seed\0"
                               "5\0"
                               "2\0"
                               "material\0"
                               "metal";
    arena = folder_make();
    struct design d = made("seed: 5\nreplicates: 2\n" TWO),
                  i = made("seed: 5\nreplicates: 2\nindependent: [material]\n" TWO);
    ck_assert(d.stimuli[1].seed == seed_by_hand(plain, sizeof plain));
    ck_assert(d.stimuli[7].seed == d.stimuli[1].seed && d.stimuli[0].seed != d.stimuli[1].seed);
    ck_assert(i.stimuli[3].seed == seed_by_hand(with, sizeof with));
    ck_assert(i.stimuli[7].seed == i.stimuli[3].seed && i.stimuli[5].seed != i.stimuli[7].seed);
    folder_remove();
}
END_TEST

static const struct design_stimulus *find(const struct design *d, const char *name)
{
    for (int i = 0; i < d->n_stimuli; i++)
        if (strcmp(d->stimuli[i].name, name) == 0) return &d->stimuli[i];
    ck_abort_msg("no %s", name);
    return NULL;
}

START_TEST(growing_changes_no_other_stimulus)
{
    arena = folder_make();
    static const char rules[] = "independent: [b, a]\nreplicates: 2\nname: \"{a}{b}{replicate}\"\n";
    char small[400], more[400];
    snprintf(small, sizeof small, "%sfactors: {a: [{label: x}, {label: y}], b: [{label: p}, {label: q}]}\n", rules);
    snprintf(more, sizeof more,
             "%sfactors: {b: [{label: o}, {label: p}, {label: q}], a: [{label: y}, {label: x}], motion.rate: [2 Hz]}\n",
             rules);
    struct design s = made(small), m = made(more);
    ck_assert_int_eq(m.n_stimuli, 12);
    for (int i = 0; i < s.n_stimuli; i++)
        ck_assert(find(&m, s.stimuli[i].name)->seed == s.stimuli[i].seed);
    folder_remove();
}
END_TEST

/* The order of those that were there before stays, when a level is added; another seed is another order. */
START_TEST(order_is_deterministic)
{
    arena = folder_make();
    struct design a = made("order: {seed: 7}\nfactors: {a: [{label: x1}, {label: x2}, {label: x3}, {label: x4}, "
                           "{label: x5}, {label: x6}]}\n");
    struct design b = made("order: {seed: 7}\nfactors: {a: [{label: x0}, {label: x6}, {label: x2}, {label: x3}, "
                           "{label: x4}, {label: x5}, {label: x1}]}\n");
    struct design c = made("order: {seed: 8}\nfactors: {a: [{label: x1}, {label: x2}, {label: x3}, {label: x4}, "
                           "{label: x5}, {label: x6}]}\n");
    int at = 0;
    bool same = true, sorted = true;
    for (int i = 0; i < b.n_stimuli; i++)
        if (strcmp(b.stimuli[i].name, "x0") != 0) ck_assert_str_eq(b.stimuli[i].name, a.stimuli[at++].name);
    for (int i = 0; i < 6; i++) {
        same = same && strcmp(a.stimuli[i].name, c.stimuli[i].name) == 0;
        sorted = sorted && a.stimuli[i].cell == i;
    }
    ck_assert(!same && !sorted && a.shuffled);
    names_are(&a, "x2 x3 x6 x1 x5 x4");
    folder_remove();
}
END_TEST

static void column_is(const struct design *d, int f, const char *column, const char *unit, const char *values)
{
    char all[400] = "";
    ck_assert_str_eq(d->factors[f].column, column);
    if (unit)
        ck_assert_str_eq(d->factors[f].unit, unit);
    else
        ck_assert_ptr_null(d->factors[f].unit);
    for (int i = 0; i < d->factors[f].n_levels; i++)
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i ? " " : "", d->factors[f].levels[i].value);
    ck_assert_str_eq(all, values);
}

START_TEST(columns)
{
    arena = folder_make();
    struct design d = made(
        "factors:\n  motion.rate: [1 Hz, 2.50 Hz]\n  scraper.mass: [20 g, 0.1 kg]\n  load.constant: [1, 2]\n"
        "  surface.object.youngs_modulus: [1 GPa, 12 MPa]\n  hardness: [{label: 12 MPa}]\n  speed: [{label: 5 cm/s}]\n"
        "  grade: [{label: 120}, {label: 80}]\n  mixed: [{label: 1 Hz}, {label: 1 m}]\n  Rough-ness: [{label: high}]\n"
        "  surface.response: [1.csv, 2.csv]\n");
    column_is(&d, 0, "motion_rate_hz", "Hz", "1 2.5");
    column_is(&d, 1, "scraper_mass_kg", "kg", "0.02 0.1");
    column_is(&d, 2, "load_constant_n", "N", "1 2");
    column_is(&d, 3, "surface_object_youngs_modulus_pa", "Pa", "1000000000 12000000");
    column_is(&d, 4, "hardness_megapa", "MPa", "12");
    column_is(&d, 5, "speed_cm_per_s", "cm/s", "5");
    column_is(&d, 6, "grade", NULL, "120 80");
    column_is(&d, 7, "mixed", NULL, "1 Hz 1 m");
    column_is(&d, 8, "rough_ness", NULL, "high");
    column_is(&d, 9, "surface_response", NULL, "1 2");
    refused("factors: {Text: [{label: a}]}\n", "would be called text, as is the manifest's own");
    refused("factors: {a-b: [{label: a}], a_b: [{label: a}]}\n", "would be called a_b, as is that of a-b");
    ck_assert_ptr_nonnull(strstr(d.factors[0].meaning, "per second"));
    folder_remove();
}
END_TEST

START_TEST(rules)
{
    arena = folder_make();
    struct design d = made(""), e = made("level: {each: {lufs: -23}}\nlength: 250 ms\norder: design\ntitle: t\n"),
                  s = made("level: scene\nlength: own\n");
    ck_assert(d.level_rule == DESIGN_LEVEL_COMMON && d.level.peak == -3 && isnan(d.level.rms) &&
              d.length_rule == DESIGN_LENGTH_LONGEST);
    ck_assert(e.level_rule == DESIGN_LEVEL_EACH && e.level.lufs == -23 && isnan(e.level.peak) &&
              e.length_rule == DESIGN_LENGTH_FIXED && e.length == 0.25);
    ck_assert(s.level_rule == DESIGN_LEVEL_SCENE && isnan(s.level.peak) && s.length_rule == DESIGN_LENGTH_OWN &&
              !s.shuffled);
    ck_assert_str_eq(e.title, "t");
    folder_remove();
}
END_TEST

START_TEST(texts_of_trials)
{
    arena = folder_make();
    struct design d = made(
        "text: \"a {material}, {motion.rate}, {replicate}!\"\nreplicates: 2\nfactors:\n  motion.rate: [1 Hz, 2 Hz]\n"
        "  material: [{label: w, text: \"plank of wood, thick\"}]\nrecordings: [{file: r.wav, material: w}, {file: "
        "s.wav, text: own}]\n");
    ck_assert_str_eq(design_text(&d, 3, arena), "a plank of wood, thick, 2 Hz, 2!");
    ck_assert_ptr_null(design_text(&d, 4, arena));
    ck_assert_str_eq(design_text(&d, 5, arena), "own");
    refused("text: a {x\n", "a brace is left open");
    refused("text: \"{materail}\"\n" TWO, "did you mean 'material'?");
    struct design none = made("");
    ck_assert_ptr_null(design_text(&none, 0, arena));
    folder_remove();
}
END_TEST

START_TEST(hash_is_of_the_meaning)
{
    arena = folder_make();
    struct design a = made(TWO), b = made("# a comment\nseed:   1\n\n" TWO "order: design\n"),
                  c = made("seed: 2\n" TWO), d = made(TWO "exclude: [{motion.rate: 1 Hz}]\n");
    ck_assert_str_eq(a.sha256, b.sha256);
    ck_assert_str_ne(a.sha256, c.sha256);
    ck_assert_str_ne(a.sha256, d.sha256);
    struct design e = made("set: {motion.duration: 1 s}\n" TWO), f = made("set: {motion: {duration: 1 s}}\n" TWO),
                  g = made("set: {motion.duration: 2 s}\n" TWO);
    ck_assert_str_eq(e.sha256, f.sha256);
    ck_assert_str_ne(e.sha256, g.sha256);
    folder_remove();
}
END_TEST

static struct scene scene_of(const struct design *d, int i)
{
    struct scene s;
    const char *messages;
    struct err e = {0};
    bool good = design_scene(d, i, arena, &s, &messages, &e);
    ck_assert_msg(good, "%s", messages);
    return s;
}

START_TEST(scenes_are_laid_over)
{
    arena = folder_make();
    folder_write("other.yaml", "include: [scene.yaml]\nmotion: {duration: 5 s}\n");
    struct design d =
        made("set: {motion: {rate: 3 Hz, duration: 2 s}, scraper: {mass: 1 g}}\nfactors:\n  scraper.mass: [5 g, 7 g]\n"
             "  motion.to: [{label: far, value: [9 cm, 0]}]\n"
             "  what: [{label: a, base: other.yaml, set: {surface.response: sub/y.csv, output.stems: [force]}}, "
             "{label: b, set: {motion.duration: 4 s, title: null}}]\n");
    struct scene a = scene_of(&d, 0), b = scene_of(&d, 3);
    ck_assert_str_eq(a.file, folder_path("other.yaml"));
    ck_assert_str_eq(a.contacts->surface.response.file, folder_path("sub/y.csv"));
    ck_assert_str_eq(a.output.stems[0], "force");
    ck_assert(a.contacts->scraper.mass == 5e-3 && b.contacts->scraper.mass == 7e-3);
    ck_assert(a.contacts->motion.rate == 3 && a.contacts->motion.duration == 2 && b.contacts->motion.duration == 4);
    ck_assert(a.contacts->motion.to[0] == 0.09);
    ck_assert(b.title == NULL && a.seed == d.stimuli[0].seed && b.seed == a.seed);
    ck_assert_str_eq(b.contacts->surface.response.file, folder_path("x.csv"));
    folder_remove();
}
END_TEST

START_TEST(keys_of_contacts)
{
    arena = folder_make();
    struct design d = made("factors: {contacts.rod.gain: [1, 2]}\nset: {contacts.1.start: 1 s}\n");
    folder_write("scene.yaml", "rasp: 1\ncontacts:\n  - {name: rod, surface: {roughness: {rms: 4 um}, response: "
                               "x.csv}, scraper: {mass: 20 g}, load: {constant: 1 N},\n"
                               "     motion: {path: line, from: [0, 0], to: [6 cm, 0], duration: 1 s}}\n"
                               "  - {name: b, surface: {roughness: {rms: 4 um}, response: x.csv}, scraper: {mass: 20 "
                               "g}, load: {constant: 1 N},\n"
                               "     motion: {path: line, from: [0, 0], to: [6 cm, 0], duration: 1 s}}\n");
    struct scene s = scene_of(&d, 1);
    ck_assert(s.contacts[0].gain == 2 && s.contacts[1].gain == 1 && s.contacts[1].start == 1);
    folder_remove();
}
END_TEST

/* What is wrong only together is told where the design says it, with the base's name where the base does. */
START_TEST(errors_stand_in_the_design)
{
    arena = folder_make();
    struct design d = made(
        "set:\n  grip: {angle: 30 deg, azimuth: 0, friction: 0.3}\nfactors: {motion.path: [back_and_forth, circle]}\n");
    struct scene s;
    const char *messages;
    struct err e = {0};
    ck_assert(!design_scene(&d, 1, arena, &s, &messages, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(messages, "scene.yaml:6:") && strstr(messages, "(named at ") &&
                      strstr(messages, "design.yaml:2:7)"),
                  "%s", messages);
    struct design n = made("factors: {m: [{label: a, base: none.yaml}]}\n");
    e = (struct err){0};
    ck_assert(!design_scene(&n, 0, arena, &s, &messages, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    ck_assert_msg(strstr(messages, "design.yaml:3:32: error: cannot read"), "%s", messages);
    struct design t = made("set: {motion.rate: null}\n");
    e = (struct err){0};
    ck_assert(!design_scene(&t, 0, arena, &s, &messages, &e));
    ck_assert_msg(strstr(messages, "motion.rate is missing"), "%s", messages);
    struct design c = made("set: {contacts.rod.gain: 2}\n");
    e = (struct err){0};
    ck_assert(!design_scene(&c, 0, arena, &s, &messages, &e));
    ck_assert_msg(strstr(messages, "design.yaml:3:"), "%s", messages);
    folder_remove();
}
END_TEST

static void *many_scenes(void *design)
{
    const struct design *d = design;
    for (int k = 0; k < 200; k++) {
        struct arena *a = arena_open();
        struct scene s;
        const char *messages;
        struct err e = {0};
        int i = k % d->n_stimuli;
        bool good = design_scene(d, i, a, &s, &messages, &e) && s.contacts->motion.rate == 1 + i / 2 &&
                    s.seed == d->stimuli[i].seed;
        arena_close(a);
        if (!good) return design;
    }
    return NULL;
}

START_TEST(threads_share_a_design)
{
    arena = folder_make();
    struct design d = made(TWO);
    pthread_t threads[4];
    void *bad = NULL, *one;
    for (int i = 0; i < 4; i++)
        ck_assert_int_eq(pthread_create(&threads[i], NULL, many_scenes, &d), 0);
    for (int i = 0; i < 4; i++) {
        pthread_join(threads[i], &one);
        bad = one ? one : bad;
    }
    ck_assert_ptr_null(bad);
    folder_remove();
}
END_TEST

START_TEST(names_that_cannot_be)
{
    arena = folder_make();
    refused(TWO "name: \"../{cell}\"\n", "begins with a dot");
    refused(TWO "name: \"a/../{cell}\"\n", "begins with a dot");
    refused(TWO "name: \"/a/{cell}\"\n", "folder without a name");
    refused(TWO "name: \"{cell}/\"\n", "folder without a name");
    refused(TWO "name: \"{cell}.wav\"\n", "ends as a file does");
    refused(TWO "name: \"a b{cell}\"\n", "cannot hold ' '");
    refused(TWO "name: \"{materail}\"\n", "did you mean {material}?");
    refused(TWO "name: \"{material\"\n", "a brace is left open");
    refused("name: manifest\n", "is that of a table");
    refused(TWO "name: \"{material}\"\n",
            "two stimuli would be named 'dark_wood': 1 Hz, dark wood; and 2 Hz, dark wood");
    refused("replicates: 2\nname: x\n", "put {replicate} into name:");
    refused("factors: {a: [{label: x}, {label: x.b}]}\n", "could have one name");
    refused("factors: {a: [{label: a b}, {label: a_b}]}\n", "two stimuli would be named 'a_b'");
    refused("factors: {a: [{label: ..}]}\n", "begins with a dot");
    struct design d = made("factors: {scraper.weight: [1, 1.5]}\n");
    names_are(&d, "1 1.5");
    folder_remove();
}
END_TEST

START_TEST(sizes_that_cannot_be)
{
    arena = folder_make();
    refused("replicates: 1000001\n", "replicates must be");
    refused("replicates: 1000000\nfactors: {scraper.weight: [0, 1]}\n", "this makes 2000000 stimuli");
    refused("factors: {scraper.weight: []}\n", "must be a list of one level or more, not an empty list");
    refused("a: &a [x, x, x, x, x, x, x, x, x, x]\nb: &b [*a, *a, *a, *a, *a, *a, *a, *a, *a, *a]\nc: &c [*b, *b, *b, "
            "*b, *b, *b, *b, *b, *b, *b]\n"
            "d: &d [*c, *c, *c, *c, *c, *c, *c, *c, *c, *c]\ne: &e [*d, *d, *d, *d, *d, *d, *d, *d, *d, *d]\n",
            "values after expanding aliases");
    struct design d = made("replicates: 100000\n");
    ck_assert_int_eq(d.n_stimuli, 100000);
    ck_assert_str_eq(d.stimuli[99999].name, "scene_r100000");
    folder_remove();
}
END_TEST

START_TEST(what_is_a_design)
{
    arena = folder_make();
    folder_write("a.yaml", "# x\n\nrasp-design: 1\n");
    folder_write("b.yaml", "rasp: 1\ntitle: rasp-design\n");
    folder_write("c.yaml", "rasp-designs: 1\n");
    ck_assert(design_is(folder_path("a.yaml")));
    ck_assert(!design_is(folder_path("b.yaml")) && !design_is(folder_path("c.yaml")) &&
              !design_is(folder_path("none.yaml")));
    folder_remove();
}
END_TEST

/* Value k by the documented formula, with libm, to 4 digits. */
static double drawn_by_hand(const char *rule, const char *factor, int k, double a, double b)
{
    char text[100], hex[HASH_TEXT], four[32];
    int n = snprintf(text, sizeof text, "rasp sample%c1%c%s%c%d", 0, 0, factor, 0, k);
    hash_bytes(text, (size_t)n + 1, hex);
    hex[16] = '\0';
    double u = (double)(strtoull(hex, NULL, 16) >> 11) * 0x1p-53;
    snprintf(four, sizeof four, "%.3e", rule[0] == 'l' ? a * pow(b / a, u) : a + u * (b - a));
    return strtod(four, NULL);
}

#define DRAWN                                                                                                          \
    "factors:\n  material: [{label: wood}, {label: metal}]\n  motion.rate: {uniform: [1 Hz, 4 Hz]}\n"                  \
    "  load.constant: {log_uniform: [0.1 N, 10 N]}\n"

START_TEST(samples_are_the_documented_quantiles)
{
    arena = folder_make();
    struct design d = made(DRAWN "samples: 50\nreplicates: 2\n");
    ck_assert_int_eq(d.n_stimuli, 200);
    ck_assert_str_eq(d.stimuli[0].name, "wood/s000001_r1");
    ck_assert_str_eq(d.stimuli[199].name, "metal/s000050_r2");
    ck_assert_str_eq(d.factors[1].column, "motion_rate_hz");
    for (int i = 0; i < d.n_stimuli; i++) {
        int k = d.stimuli[i].sample;
        struct scene s;
        const char *messages;
        struct err e = {0};
        ck_assert_int_eq(k, i / 2 % 50 + 1);
        ck_assert_double_eq(strtod(design_value(&d, i, 1), NULL), drawn_by_hand("uniform", "motion.rate", k, 1, 4));
        ck_assert_double_eq(strtod(design_label(&d, i, 2), NULL), drawn_by_hand("log", "load.constant", k, 0.1, 10));
        folder_write("x.csv", "x");
        ck_assert_msg(design_scene(&d, i, arena, &s, &messages, &e), "%s", messages);
        ck_assert_double_eq(s.contacts[0].motion.rate, strtod(design_value(&d, i, 1), NULL));
    }
    ck_assert(d.stimuli[0].seed != d.stimuli[1].seed && d.stimuli[0].seed != d.stimuli[2].seed);
    ck_assert(d.stimuli[0].seed == d.stimuli[100].seed); /* of the other material */
    struct design common = made(DRAWN "samples: 50\nindependent: []\n");
    ck_assert(common.stimuli[0].seed == common.stimuli[1].seed);
    folder_remove();
}
END_TEST

START_TEST(more_samples_change_none)
{
    arena = folder_make();
    struct design few = made(DRAWN "samples: 7\n"),
                  many = made(DRAWN "  scraper.mass: {normal: [20 g, 5 g], within: [5 g, 30 g]}\n  surface.response: "
                                    "{choose: [a.csv, b.csv, c.csv]}\nsamples: 3000\norder: {seed: 4}\n");
    int found = 0, chosen[3] = {0};
    double sum = 0;
    for (int j = 0; j < many.n_stimuli; j++) {
        for (int i = 0; i < few.n_stimuli; i++) {
            if (strcmp(few.stimuli[i].name, many.stimuli[j].name) != 0) continue;
            found++;
            ck_assert(few.stimuli[i].seed == many.stimuli[j].seed);
            for (int f = 0; f < 3; f++)
                ck_assert_str_eq(design_label(&few, i, f), design_label(&many, j, f));
        }
        double mass = strtod(design_value(&many, j, 3), NULL);
        ck_assert(mass >= 5 && mass <= 30);
        sum += mass / many.n_stimuli;
        chosen[many.stimuli[j].level[4]]++;
    }
    ck_assert_int_eq(found, 14);
    ck_assert_double_eq_tol(sum, 19.735, 0.25); /* 20 - 5 (phi(2) - phi(-3)) / (Phi(2) - Phi(-3)) */
    for (int c = 0; c < 3; c++)
        ck_assert(chosen[c] > 1840 && chosen[c] < 2160);
    folder_remove();
}
END_TEST

START_TEST(splits_keep_samples_together)
{
    arena = folder_make();
    struct design d = made(DRAWN "samples: 1000\nsplits: {train: 8, validation: 1, test: 1}\n"),
                  more = made(DRAWN "samples: 1200\nreplicates: 2\norder: {seed: 5}\nsplits: {train: 8, validation: 1, "
                                    "test: 1}\n"),
                  none = made(DRAWN "samples: 2\n");
    const char *of[1201] = {NULL};
    int n = 0;
    for (int i = 0; i < d.n_stimuli; i++) {
        const char **split = &of[d.stimuli[i].sample];
        ck_assert(!*split || strcmp(*split, d.stimuli[i].split) == 0); /* of wood and of metal */
        *split = d.stimuli[i].split;
        n += strcmp(*split, "train") == 0;
    }
    ck_assert_int_le(abs(n - 1600), 76); /* three standard deviations */
    for (int i = 0; i < more.n_stimuli; i++)
        if (of[more.stimuli[i].sample]) ck_assert_str_eq(more.stimuli[i].split, of[more.stimuli[i].sample]);
    ck_assert_ptr_null(none.stimuli[0].split);
    refused("splits: [train]\n", "splits must be a map of names with shares");
    folder_remove();
}
END_TEST

START_TEST(rules_that_cannot_be)
{
    static const char *const wrong[][2] = {
        {"motion.rate: {uniform: [1 Hz, 400 Hz]}", "motion.rate must be from"},
        {"motion.rate: {uniform: [4 Hz, 1 Hz]}", "uniform is empty: 4 Hz is not below 1 Hz"},
        {"motion.rate: {uniform: [1 Hz, 2 kHz]}", "uniform has the units 'Hz' and 'kHz'"},
        {"motion.rate: {uniform: [1 m, 2 m]}", "m is a unit of length"},
        {"motion.rate: {uniform: [1 Hz, 2.00001 Hz]}", "at most 4 digits"},
        {"motion.rate: {uniform: [1 Hz]}", "must be a list of two numbers"},
        {"motion.rate: {unifrom: [1 Hz, 2 Hz]}", "did you mean 'uniform'?"},
        {"motion.rate: {uniform: [1 Hz, 2 Hz], choose: [1 Hz]}", "or one rule to draw them by"},
        {"motion.rate: {uniform: [1 Hz, 2 Hz], within: [1 Hz, 2 Hz]}", "within goes with normal"},
        {"load.constant: {log_uniform: [0 N, 2 N]}", "log_uniform must be above 0"},
        {"scraper.mass: {normal: [20 g, -5 g]}", "standard deviation must be above 0"},
        {"scraper.mass: {normal: [20 g, 5 g]}", "scraper.mass must be from"},
        {"scraper.mass: {normal: [20 g, 5 g], within: [9 g, 9 g]}", "within is empty"},
        {"scraper.mass: {normal: [20 g, 1 g], within: [90 g, 99 g]}", "within is too far from the mean"},
        {"motion.law: {uniform: [1, 2]}", "motion.law is no key of scenes whose value is any number"},
        {"material: {normal: [1, 2]}", "material is no key of scenes whose value is any number"},
        {"motion.rate: {choose: []}", "must be a list of one level or more"},
        {"motion.rate: [1 Hz]", "samples is given, and no factor is drawn"},
        {"motion.rate: cells", "has its levels from the table of cells, and there is none"},
        {"sample: {choose: [{label: a}]}", "cannot be called so"}};
    arena = folder_make();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[200];
        snprintf(text, sizeof text, "factors: {%s}\nsamples: 5\n", wrong[i][0]);
        refused(text, wrong[i][1]);
    }
    refused("factors: {motion.rate: {uniform: [1 Hz, 2 Hz]}}\n", "samples does not say how often");
    refused("factors: {motion.rate: {uniform: [1 Hz, 2 Hz]}}\nsamples: 0\n", "samples must be a whole number");
    refused("factors: {motion.rate: {uniform: [1 Hz, 2 Hz]}}\nsamples: 5\nreplicates: 200001\n", "1000005 stimuli");
    folder_remove();
}
END_TEST

START_TEST(cells_of_a_table)
{
    arena = folder_make();
    folder_write("rows.csv",
                 "load.constant,material,motion.rate\n0.5 N,metal,2 Hz\n\"0.25 N\",dark wood,1 Hz\n0.5 N,metal,1 Hz\n");
    struct design d =
        made(TWO "  load.constant: cells\n  scraper.mass: {uniform: [10 g, 20 g]}\ncells: rows.csv\nsamples: 2\n"
                 "exclude: [{motion.rate: 1 Hz, material: metal}]\n");
    names_are(&d,
              "2Hz_metal_0.5N/s000001 2Hz_metal_0.5N/s000002 1Hz_dark_wood_0.25N/s000001 1Hz_dark_wood_0.25N/s000002");
    ck_assert_str_eq(d.factors[2].column, "load_constant_n");
    ck_assert_str_eq(design_value(&d, 2, 2), "0.25");
    ck_assert_int_eq(d.factors[2].n_levels, 2);
    ck_assert_str_eq(d.sources[1], folder_path("rows.csv"));
#define TABLE TWO "  load.constant: cells\ncells: rows.csv\n"
    folder_write("rows.csv", "load.constant,material,motion.rate\n0.5 N,metal,2 Hz\n5 kg,metal,2 Hz\n,metal,2 Hz\n");
    refused(TABLE, "rows.csv:3:1: error: load.constant needs a force; kg is a unit of mass");
    refused(TABLE, "rows.csv:4:1: error: load.constant is empty here");
    folder_write("rows.csv", "load.constant,material,motion.raet\n0.5 N,metla,2 Hz\n");
    refused(TABLE, "no factor 'motion.raet'");
    refused(TABLE, "there is no column motion.rate");
    refused(TABLE, "rows.csv:2:1: error: 'metla' is no level of material");
    folder_write("rows.csv", "load.constant,material\n0.5 N,metal,2 Hz\n");
    refused(TABLE, "rows.csv:2: 3 cells");
    folder_write("rows.csv", "load.constant,material,motion.rate\n");
    refused(TABLE, "has no rows");
    folder_remove();
}
END_TEST

UNIT("design", crossed_first_factor_slowest, names_are_padded, without_factors_the_base_gives_the_name, labels_in_names,
     excluded_cells_and_lists, recordings_are_cells, seeds_are_the_documented_hash, growing_changes_no_other_stimulus,
     order_is_deterministic, columns, rules, texts_of_trials, hash_is_of_the_meaning, scenes_are_laid_over,
     keys_of_contacts, errors_stand_in_the_design, threads_share_a_design, names_that_cannot_be, sizes_that_cannot_be,
     what_is_a_design, samples_are_the_documented_quantiles, more_samples_change_none, splits_keep_samples_together,
     rules_that_cannot_be, cells_of_a_table)
