/* Scenes against structs and messages written down by hand: places, words, cures; merging, overrides, mutations of a
 * good scene. */
#include "force/scrape.h"
#include "scene/scene_read.h"

#include <sys/stat.h>

#include "folder.h"
#include "pipeline/stages.h"
#include "scene/keys.h"
#include "scene/params.h"
#include "scenes.h"
#include "surface/height_map.h"
#include "surface/limiter.h"

static struct result read_good(const char *text, const char *const *set)
{
    struct result r = read_with(text, set);
    ck_assert_msg(r.good, "%s", r.messages);
    return r;
}

static const struct height_map_file *map_of(const struct contact *c) { return params_of(c, height_map_stage.params); }

START_TEST(test_full)
{
    struct result r = read_good(full, NULL);
    const struct scene *s = &r.scene;
    const struct contact *c = s->contacts;
    ck_assert(s->version == 1 && s->seed == UINT64_MAX && s->n_contacts == 1 && s->n_inputs == 2);
    ck_assert_str_eq(s->file, "scenes/t.yaml");
    ck_assert_str_eq(s->title, "PVC rod on a plank");
    ck_assert_str_eq(map_of(c)->path, "scenes/../surfaces/basswood.gsf");
    ck_assert_str_eq(c->surface.response.file, "/irs/plank.csv");
    ck_assert_str_eq(c->scraper.response.file, "scenes/rod.csv");
    ck_assert(c->surface.along == ALONG_X && c->surface.origin[0] == 0.01 && c->surface.origin[1] == -0.002);
    ck_assert(c->scraper.mass == 0.02 && c->scraper.weight == 0.3);
    ck_assert(c->motion.path == PATH_BACK_AND_FORTH && c->motion.from[0] == 0.03 && c->motion.to[0] == 0.075 &&
              c->motion.rate == 2);
    ck_assert(c->motion.duration == 1.5 && isnan(c->motion.speed));
    ck_assert(c->grip.given && c->grip.angle == 0.5 && c->grip.friction == 0.3 && isnan(c->load.constant));
    ck_assert(scrape_law(c)->force == FORCE_PAPER && isnan(scrape_law(c)->leak) && limiter_of(c)->force_range[1] == 5);
    ck_assert(!params_given(c, roughness_stage.params) && isnan(map_of(c)->read.pitch));
    ck_assert_str_eq(s->accuracy.preset, "high");
    ck_assert(s->accuracy.oversampling == 16 && s->accuracy.gain_ramp == 16);
    ck_assert(s->output.sample_rate == 44100 && s->output.encoding == ENCODING_PCM16 && s->output.level.lufs == -23);
    ck_assert(isnan(s->output.level.peak) && s->output.ramp == 0.02 && s->output.tail == 2);
    ck_assert(s->output.diagnostics.given && s->output.diagnostics.rate == 1000);
    ck_assert_str_eq(s->output.diagnostics.columns[1], "normal_force_n");
    ck_assert_ptr_null(s->output.diagnostics.columns[2]);
    ck_assert_str_eq(s->inputs[0].file, "scenes/rod.csv");
    ck_assert_str_eq(s->inputs[0].sha256 + 60, "cdef");
    ck_assert_ptr_null(s->inputs[1].sha256);
    arena_close(r.arena);
}
END_TEST

START_TEST(test_defaults)
{
    struct result r = read_good(MIN, NULL);
    const struct contact *c = r.scene.contacts;
    const struct limiter *l = limiter_of(c);
    ck_assert_str_eq(c->name, "contact");
    ck_assert(c->start == 0 && c->gain == 1 && r.scene.seed == 0 && !r.scene.title && r.scene.n_inputs == 0);
    ck_assert(map_of(c)->read.height_scale == 1 && c->surface.along == ALONG_AUTO &&
              map_of(c)->off_map == OFF_MAP_MIRROR);
    ck_assert(c->surface.origin[0] == 0 && c->surface.response.modes == 50 && isnan(c->surface.response.length));
    ck_assert(c->motion.from[0] == 0 && c->motion.from[1] == 0 && isnan(c->motion.rate) && c->motion.law == SPEED_AUTO);
    ck_assert(!c->grip.given && isnan(c->load.constant) && scrape_law(c)->leak == 2e-3 &&
              *(const double *)params_of(c, smooth_stage.params) == 50e-6);
    ck_assert(c->contact.gravity == 9.80665 && scrape_law(c)->beta1 == 0.05 && scrape_law(c)->beta2 == 1);
    ck_assert(l->curve == LIMITER_TANH && l->alpha == 0.03 && l->alpha_min == 0.01 && l->alpha_max == 0.05 &&
              isnan(l->force_range[0]));
    ck_assert(r.scene.output.sample_rate == 48000 && r.scene.output.ramp == 0.01 && isnan(r.scene.output.tail));
    ck_assert(!r.scene.output.diagnostics.given && !r.scene.output.diagnostics.columns &&
              isnan(r.scene.output.level.peak));
    ck_assert_str_eq(r.scene.accuracy.preset, "standard");
    ck_assert(r.scene.accuracy.oversampling == 4);
    arena_close(r.arena);
}
END_TEST

/* What decides is a choice that has these words, or may be left out. */
static void applies_check(const struct key *k)
{
    const struct key *decides = keys_decider(k);
    int words = 0, bars = 0;
    ck_assert_msg((decides != NULL) == (k->applies != NULL), "%s", k->path);
    if (!decides) return;
    if (!keys_words(k)) {
        ck_assert_msg((decides->type == KEY_FILE || decides->type == KEY_NUMBER) && decides->standard &&
                          !*decides->standard,
                      "%s", k->path);
        return;
    }
    ck_assert_msg(decides->type == KEY_CHOICE, "%s", k->path);
    for (const struct choice *c = decides->choices; c->word; c++)
        words += keys_applies_with(k, c->word);
    for (const char *s = keys_words(k); *s; s++)
        bars += *s == '|';
    ck_assert_msg(words == bars + 1, "%s: %s", k->path, k->applies);
}

/* Every default can be read and every preset lies within its knob's range. */
START_TEST(test_tables)
{
    struct result r = read_good(MIN "grip: {}\nsurface2: null\noutput: {diagnostics: {}}\n", NULL);
    ck_assert(r.scene.contacts->grip.given && r.scene.contacts->grip.angle == 0.523598775598298873077107230546583814);
    ck_assert(r.scene.output.diagnostics.given);
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        for (int i = 0; i < 4; i++)
            ck_assert_msg(k->preset[i] >= k->low && k->preset[i] <= k->high &&
                              (!k->whole || k->preset[i] == floor(k->preset[i])),
                          "%s", k->name);
    for (const struct key *k = keys_table; k->path; k++) {
        ck_assert_ptr_eq(keys_find(k->path), k);
        ck_assert_msg((k->type == KEY_CHOICE) == (k->choices != NULL), "%s", k->path);
        applies_check(k);
    }
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ --set */

START_TEST(test_set)
{
    struct result r =
        read_good(full, SET("motion.rate=3 Hz", "motion.rate= 4 Hz ", "title=Fast: #1", "motion.to=[1 cm, 2 cm]",
                            "surface.response=x.csv", "output.level={lufs: null, peak: -1 dB}", "accuracy.gain_ramp=7",
                            "grip=~", "load.constant=2 N"));
    const struct contact *c = r.scene.contacts;
    ck_assert(c->motion.rate == 4 && c->motion.to[0] == 0.01 && c->motion.to[1] == 0.02 && !c->grip.given &&
              c->load.constant == 2);
    ck_assert_str_eq(r.scene.title, "Fast: #1");
    ck_assert_str_eq(c->surface.response.file, "x.csv"); /* seen from the current folder */
    ck_assert_str_eq(c->scraper.response.file, "scenes/rod.csv");
    ck_assert(r.scene.output.level.peak == -1 && isnan(r.scene.output.level.lufs));
    ck_assert(r.scene.accuracy.gain_ramp == 7 && r.scene.accuracy.oversampling == 16);
    arena_close(r.arena);
    r = read_good(MIN "accuracy: high\n", SET("accuracy.oversampling=3", "motion.to.1=2 mm"));
    ck_assert(r.scene.accuracy.oversampling == 3 && r.scene.accuracy.gain_ramp == 16 &&
              r.scene.contacts->motion.to[1] == 0.002);
    arena_close(r.arena);
    r = read_good(full, SET("accuracy=draft"));
    ck_assert(r.scene.accuracy.oversampling == 1 && r.scene.accuracy.gain_ramp == 256);
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ contacts */

START_TEST(test_contacts)
{
    struct result r = read_good(two, SET("contacts.rod.motion.rate=3 Hz", "contacts.0.gain=0.7", "contacts.1.gain=0.5",
                                         "contacts.nail.motion.to.1=1 cm"));
    const struct contact *c = r.scene.contacts;
    ck_assert_int_eq(r.scene.n_contacts, 2);
    ck_assert_str_eq(c[0].name, "rod");
    ck_assert_str_eq(c[1].name, "nail");
    ck_assert(c[0].motion.rate == 3 && c[0].gain == 0.7 && c[1].gain == 0.5 && c[1].start == 0.5 &&
              c[1].motion.speed == 0.1 && c[1].motion.to[1] == 0.01);
    arena_close(r.arena);
    r = read_with("rasp: 1\ncontacts:\n- surface: {roughness: {}}\n  scraper: {mass: 2 m}\n  motion: {path: line, to: "
                  "[1, 0], duration: 1}\n",
                  NULL);
    one_error(&r, "scenes/t.yaml:4:19: error: ", "contacts.0.scraper.mass needs a mass", "20 g");
    arena_close(r.arena);
    r = read_with("rasp: 1\ncontacts:\n- &c\n  surface: {roughness: {}, response: a.csv}\n  scraper: {mass: 2 g}\n  "
                  "motion: {path: line, to: [1, 0], duration: 1}\n- *c\n",
                  NULL);
    one_error(&r, "scenes/t.yaml:3:3: error: ", "two contacts are named 'contact'", "name of its own");
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ files */

static struct result read_file(const char *name)
{
    struct result r = {.arena = arena_open()};
    r.good = scene_read(folder_path(name), NULL, r.arena, &r.scene, &r.messages, &r.err);
    return r;
}

static void make_files(void)
{
    folder_make();
    ck_assert_int_eq(mkdir(folder_path("sub"), 0700), 0);
    folder_write("base.yaml", MIN "title: base\naccuracy: high\noutput: {ramp: 1 s, level: {lufs: -23}}\n");
    folder_write("sub/late.yaml",
                 "scraper: {response: rod.csv}\nmotion: {to: [5 cm, 6 cm]}\noutput: {ramp: 2 s}\ntitle: late\n");
    folder_write("main.yaml",
                 "include: [base.yaml, sub/late.yaml]\nscraper: {mass: 7 g}\ntitle: main\naccuracy: {oversampling: 5}\n"
                 "output: {level: {lufs: ~, rms: -30 dB}}\n");
    folder_write("error.yaml", "include: [wrong.yaml]\ntitle: x\nseed: x\n");
    folder_write("wrong.yaml", MIN "gain: 3 s\n");
    folder_write("missing.yaml", MIN "include: [none.yaml, base.yaml]\n");
    folder_write("cycle.yaml", MIN "include: [sub/cycle2.yaml]\n");
    folder_write("sub/cycle2.yaml", "include: [../cycle.yaml]\n");
    folder_write("syntax.yaml", MIN "include: [syntax2.yaml]\n");
    folder_write("syntax2.yaml", "a: [\n");
    folder_write("dup.yaml", MIN "include: [dup2.yaml]\n");
    folder_write("dup2.yaml", "title: a\ntitle: b\n");
    for (int i = 0; i < 20; i++) {
        char name[32], text[64];
        snprintf(name, sizeof name, "deep%d.yaml", i);
        snprintf(text, sizeof text, "include: [deep%d.yaml]\n", i + 1);
        folder_write(name, text);
    }
    folder_write("deep20.yaml", MIN);
}

START_TEST(test_include)
{
    make_files();
    struct result r = read_file("main.yaml");
    ck_assert_msg(r.good, "%s", r.messages);
    const struct contact *c = r.scene.contacts;
    ck_assert_str_eq(r.scene.title, "main");
    ck_assert(c->scraper.mass == 0.007 && c->motion.to[0] == 0.05 && c->motion.to[1] == 0.06 &&
              c->motion.duration == 1);
    ck_assert_str_eq(c->scraper.response.file, folder_path("sub/rod.csv"));
    ck_assert_str_eq(map_of(c)->path, folder_path("a.npy"));
    ck_assert(r.scene.output.ramp == 2 && isnan(r.scene.output.level.lufs) && r.scene.output.level.rms == -30);
    ck_assert_str_eq(r.scene.accuracy.preset, "high");
    ck_assert(r.scene.accuracy.oversampling == 5 && r.scene.accuracy.gain_ramp == 16);
    static const char *const sources[] = {"main.yaml", "base.yaml", "sub/late.yaml"};
    for (int i = 0; i < 3; i++)
        ck_assert_str_eq(r.scene.sources[i], folder_path(sources[i]));
    ck_assert_ptr_null(r.scene.sources[3]);
    arena_close(r.arena);
    r = read_file("error.yaml");
    ck_assert(!r.good && r.err.kind == ERR_SCENE);
    const char *second = strstr(r.messages, "wrong.yaml:5:7: error: gain needs"),
               *first = strstr(r.messages, "error.yaml:3:7: error: seed must");
    ck_assert_msg(first && second && first < second, "%s", r.messages);
    arena_close(r.arena);
    folder_remove();
}
END_TEST

START_TEST(test_bad_files)
{
    static const struct {
        const char *name, *at, *place, *says, *cure;
        enum err_kind kind;
    } rows[] = {
        {"missing.yaml", "missing.yaml", ":5:11: error: ", "none.yaml': No such file", "relative to that file's folder",
         ERR_INPUT},
        {"cycle.yaml", "sub/cycle2.yaml", ":1:11: error: ", "cycle.yaml' includes itself", "remove", ERR_SCENE},
        {"syntax.yaml", "syntax2.yaml", ":2:1: error: ", "not valid YAML", "brackets", ERR_SCENE},
        {"dup.yaml", "dup2.yaml", ":2:1: error: ", "duplicate key 'title'", "first set on line 1", ERR_SCENE},
        {"deep0.yaml", "deep16.yaml", ":1:11: error: ", "too many includes", "remove", ERR_SCENE},
        {"no.yaml", "no.yaml", ": error: ", "cannot be read: No such file", "", ERR_INPUT},
        {"sub", "sub", ": error: ", "cannot be read: Is a directory", "", ERR_INPUT},
    };
    make_files();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char start[256];
        struct result r = read_file(rows[i].name);
        snprintf(start, sizeof start, "%s%s", folder_path(rows[i].at), rows[i].place);
        one_error(&r, start, rows[i].says, rows[i].cure);
        ck_assert_int_eq(r.err.kind, rows[i].kind);
        arena_close(r.arena);
    }
    folder_remove();
}
END_TEST

/* ------------------------------------------------------------------ mutations */

/* Bytes replaced, removed, doubled and exchanged: every result is either a scene whose numbers are in range or
 * messages. */
START_TEST(test_mutations)
{
    static const char bytes[] = "{}[]:,-#&*!|>'\"%@` \n\t019eE.x\\~<?=\x01\x80\xc2\xff";
    size_t n = strlen(full);
    int good = 0, bad = 0;
    srand(3);
    for (int i = 0; i < 4000; i++) {
        char text[4096];
        size_t size = n;
        memcpy(text, full, n);
        for (int edits = 1 + rand() % 3; edits > 0; edits--) {
            size_t at = (size_t)rand() % size;
            switch (rand() % 4) {
            case 0:
                text[at] = bytes[(size_t)rand() % sizeof bytes];
                break;
            case 1:
                memmove(text + at, text + at + 1, --size - at);
                break;
            case 2:
                memmove(text + at + 1, text + at, size++ - at);
                break;
            default:
                text[at] ^= (char)(1 << rand() % 8);
                break;
            }
        }
        struct arena *a = arena_open();
        struct scene s;
        const char *messages;
        struct err e = {0};
        bool ok = scene_read_text(text, size, "t.yaml", NULL, a, &s, &messages, &e);
        ck_assert(ok == !*messages && ok == (e.kind == ERR_NONE));
        ck_assert(!ok || (s.n_contacts > 0 && s.contacts->scraper.mass >= 1e-9 && s.output.sample_rate >= 8000));
        good += ok;
        bad += !ok;
        arena_close(a);
    }
    ck_assert(good > 100 && bad > 1000);
}
END_TEST

START_TEST(test_cut_short)
{
    for (size_t n = 0; n <= strlen(full); n++) {
        struct arena *a = arena_open();
        struct scene s;
        const char *messages;
        struct err e = {0};
        bool ok = scene_read_text(full, n, "t.yaml", NULL, a, &s, &messages, &e);
        ck_assert(ok == !*messages && (n > 200 || !ok));
        arena_close(a);
    }
}
END_TEST

UNIT("scene_read", test_full, test_defaults, test_tables, test_set, test_contacts, test_include, test_bad_files,
     test_mutations, test_cut_short)
