/* Scenes against structs and messages written down by hand: places, words, cures; merging, overrides, mutations of a good scene. */
#include "scene/scene_read.h"

#include <sys/stat.h>
#include <unistd.h>

#include "scene/keys.h"
#include "unit.h"

/* Four lines to which one more is added. */
#define MIN                           \
    "rasp: 1\n"                       \
    "surface: {height_map: a.npy}\n"  \
    "scraper: {mass: 20 g}\n"         \
    "motion: {path: line, to: [1 cm, 0], duration: 1 s}\n"

static const char full[] =
    "rasp: 1\n"
    "title: PVC rod on a plank\n"
    "seed: 18446744073709551615\n"
    "surface:\n"
    "  height_map: ../surfaces/basswood.gsf\n"
    "  response: /irs/plank.csv\n"
    "  along: x\n"
    "  origin: [1 cm, -2 mm]\n"
    "scraper: {mass: 20 g, response: rod.csv, weight: 0.3}\n"
    "motion:\n"
    "  path: back_and_forth\n"
    "  from: [3 cm, 2 cm]\n"
    "  to: [7.5 cm, 2 cm]\n"
    "  rate: 2 Hz\n"
    "  duration: 1.5 s\n"
    "grip: {angle: 0.5 rad}\n"
    "contact: {model: scrape, force: paper, limiter: {alpha_min: 1 cm, alpha_max: 5 cm, zeta: 0.95, force_range: [0.2 N, 5 N]}}\n"
    "accuracy: {preset: high, oversampling: 16, overlap_hop: 5 ms}\n"
    "output: {sample_rate: 44.1 kHz, encoding: pcm16, level: {lufs: -23}, ramp: 20 ms, tail: 2 s,\n"
    "  diagnostics: {columns: [speed_m_per_s, normal_force_N]}}\n"
    "inputs:\n"
    "- file: rod.csv\n"
    "  sha256: 0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef\n"
    "- {file: b.csv}\n";

struct result {
    struct arena *arena;
    struct scene scene;
    const char *messages;
    struct err err;
    bool good;
};

static struct result read_with(const char *text, const char *const *set)
{
    struct result r = {.arena = arena_open()};
    struct scene_overrides over = {(const char **)set, 0};
    while (set && set[over.n])
        over.n++;
    r.good = scene_read_text(text, strlen(text), "scenes/t.yaml", &over, r.arena, &r.scene, &r.messages, &r.err);
    ck_assert_msg(r.good == (r.err.kind == ERR_NONE) && r.good == !*r.messages, "%s", r.messages);
    return r;
}

static struct result read_good(const char *text, const char *const *set)
{
    struct result r = read_with(text, set);
    ck_assert_msg(r.good, "%s", r.messages);
    return r;
}

START_TEST(test_full)
{
    struct result r = read_good(full, NULL);
    const struct scene *s = &r.scene;
    const struct contact *c = s->contacts;
    ck_assert(s->version == 1 && s->seed == UINT64_MAX && s->n_contacts == 1 && s->n_inputs == 2);
    ck_assert_str_eq(s->file, "scenes/t.yaml");
    ck_assert_str_eq(s->title, "PVC rod on a plank");
    ck_assert_str_eq(c->surface.height_map, "scenes/../surfaces/basswood.gsf");
    ck_assert_str_eq(c->surface.response.file, "/irs/plank.csv");
    ck_assert_str_eq(c->scraper.response.file, "scenes/rod.csv");
    ck_assert(c->surface.along == ALONG_X && c->surface.origin[0] == 0.01 && c->surface.origin[1] == -0.002);
    ck_assert(c->scraper.mass == 0.02 && c->scraper.weight == 0.3);
    ck_assert(c->motion.path == PATH_BACK_AND_FORTH && c->motion.from[0] == 0.03 && c->motion.to[0] == 0.075 && c->motion.rate == 2);
    ck_assert(c->motion.duration == 1.5 && isnan(c->motion.speed));
    ck_assert(c->grip.given && c->grip.angle == 0.5 && c->grip.friction == 0.3 && isnan(c->load.constant));
    ck_assert(c->contact.force == FORCE_PAPER && isnan(c->contact.leak) && c->contact.limiter.force_range[1] == 5);
    ck_assert(!c->surface.roughness.given && isnan(c->surface.pitch));
    ck_assert_str_eq(s->accuracy.preset, "high");
    ck_assert(s->accuracy.oversampling == 16 && s->accuracy.overlap_hop == 5e-3 && s->accuracy.gain_ramp == 16);
    ck_assert(s->output.sample_rate == 44100 && s->output.encoding == ENCODING_PCM16 && s->output.level.lufs == -23);
    ck_assert(isnan(s->output.level.peak) && s->output.ramp == 0.02 && s->output.tail == 2);
    ck_assert(s->output.diagnostics.given && s->output.diagnostics.rate == 1000);
    ck_assert_str_eq(s->output.diagnostics.columns[1], "normal_force_N");
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
    const struct limiter *l = &c->contact.limiter;
    ck_assert_str_eq(c->name, "contact");
    ck_assert(c->start == 0 && c->gain == 1 && r.scene.seed == 0 && !r.scene.title && r.scene.n_inputs == 0);
    ck_assert(c->surface.height_scale == 1 && c->surface.along == ALONG_PATH && c->surface.off_map == OFF_MAP_MIRROR);
    ck_assert(isnan(c->surface.origin[0]) && c->surface.response.modes == 50 && isnan(c->surface.response.length));
    ck_assert(c->motion.from[0] == 0 && c->motion.from[1] == 0 && isnan(c->motion.rate) && c->motion.law == SPEED_CONSTANT);
    ck_assert(!c->grip.given && isnan(c->load.constant) && c->contact.leak == 2e-3 && c->contact.smoothing == 50e-6);
    ck_assert(c->contact.gravity == 9.80665 && c->contact.beta1 == 0.05 && c->contact.beta2 == 1);
    ck_assert(l->curve == LIMITER_TANH && l->alpha == 0.03 && l->alpha_min == 0.01 && l->alpha_max == 0.05 && isnan(l->force_range[0]));
    ck_assert(r.scene.output.sample_rate == 48000 && r.scene.output.ramp == 0.01 && isnan(r.scene.output.tail));
    ck_assert(!r.scene.output.diagnostics.given && !r.scene.output.diagnostics.columns && isnan(r.scene.output.level.peak));
    ck_assert_str_eq(r.scene.accuracy.preset, "standard");
    ck_assert(r.scene.accuracy.oversampling == 4);
    arena_close(r.arena);
}
END_TEST

/* Every default of keys.def can be read and every preset lies within its knob's range. */
START_TEST(test_tables)
{
    struct result r = read_good(MIN "grip: {}\nsurface2: null\noutput: {diagnostics: {}}\n", NULL);
    ck_assert(r.scene.contacts->grip.given && r.scene.contacts->grip.angle == 0.523598775598298873077107230546583814);
    ck_assert(r.scene.output.diagnostics.given);
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        for (int i = 0; i < 4; i++)
            ck_assert_msg(k->preset[i] >= k->low && k->preset[i] <= k->high && (!k->whole || k->preset[i] == floor(k->preset[i])), "%s", k->name);
    for (const struct key *k = keys_table; k->path; k++) {
        ck_assert_ptr_eq(keys_find(k->path), k);
        ck_assert_msg((k->type == KEY_CHOICE) == (k->choices != NULL), "%s", k->path);
        char other[128];
        if (k->applies) {
            snprintf(other, sizeof other, "%.*s", (int)strcspn(k->applies, "="), k->applies);
            ck_assert_msg(keys_find(other) && keys_find(other)->type == (strchr(k->applies, '=') ? KEY_CHOICE : KEY_FILE), "%s", k->path);
        }
    }
    arena_close(r.arena);
}
END_TEST

struct bad {
    const char *text;  /* a line (or more) after MIN; from '#' on: a whole scene */
    const char *place; /* line:column                                             */
    const char *says, *cure;
};

/* Each is one error, and no other. */
static const struct bad bads[] = {
    /* unknown, misplaced, duplicate keys */
    {"titel: x\n", "5:1", "unknown key 'titel'", "did you mean 'title'?"},
    {"trajectory: x\n", "5:1", "unknown key 'trajectory'", "keys here: rasp, title"},
    {"rate: 3 Hz\n", "5:1", "unknown key 'rate'", "'rate' belongs elsewhere: motion.rate or output.diagnostics.rate"},
    {"lufs: -23\n", "5:1", "unknown key 'lufs'", "output.level.lufs"},
    {"oversampling: 3\n", "5:1", "unknown key 'oversampling'", "accuracy.oversampling"},
    {"output: {ramps: 1 s}\n", "5:10", "unknown key 'ramps' in output", "did you mean 'ramp'?"},
    {"output: {level: {peek: -3}}\n", "5:18", "unknown key 'peek' in output.level", "did you mean 'peak'?"},
    {"output: {ramp:1 s}\n", "5:10", "unknown key 'ramp:1 s' in output", "space after the colon"},
    {"output.ramp: 1 s\n", "5:1", "unknown key 'output.ramp'", "keys here"},
    {"\"\": 1\n", "5:1", "unknown key ''", "keys here"},
    {"rasp: 1\n", "5:1", "duplicate key 'rasp'", "first set on line 1"},
    {"output: {ramp: 1 s, ramp: 2 s}\n", "5:21", "duplicate key 'ramp'", "first set on line 5"},
    {"output:\n  ramp: 1 s\n  tail: 0\n  ramp: 2 s\n", "8:3", "duplicate key 'ramp'", "first set on line 6"},
    /* kinds */
    {"output: loud\n", "5:9", "output must be a map of keys, not 'loud'", "keys here: sample_rate"},
    {"output:\n", "5:8", "output must be a map of keys, not an empty value", "keys here"},
    {"output: {ramp: {x: 1}}\n", "5:16", "output.ramp needs a time, not a map of keys", "10 ms"},
    {"output: {ramp: [1, 2]}\n", "5:16", "output.ramp needs a time, not a list", "10 ms"},
    {"output: {ramp: }\n", "5:16", "output.ramp has no value", "10 ms"},
    {"output: {encoding: [pcm16]}\n", "5:20", "output.encoding must be one of", "encoding: pcm24"},
    {"title: [a]\n", "5:8", "title must be a text, not a list", "title:"},
    {"title: \"\"\n", "5:8", "title must be a text", "title:"},
    {"title:\n", "5:7", "title must be a text, not an empty value", "title:"},
    /* numbers */
    {"seed: -1\n", "5:7", "seed must be a whole number from 0", "seed: 7"},
    {"seed: 1.5\n", "5:7", "seed must be a whole number", "seed: 7"},
    {"seed: 07\n", "5:7", "seed must be a whole number", "seed: 7"},
    {"seed: 18446744073709551616\n", "5:7", "18446744073709551615", "seed: 7"},
    {"gain: 2 dB\n", "5:7", "gain needs a plain number without a unit", "write: 2"},
    {"gain: yes\n", "5:7", "yes/no word", "0.5"},
    {"gain: .inf\n", "5:7", "finite", "0.5"},
    {"gain: .nan\n", "5:7", "finite", "0.5"},
    {"gain: 1e999\n", "5:7", "too large", "0.5"},
    {"gain: 0x10\n", "5:7", "decimal", "0.5"},
    {"gain: 010\n", "5:7", "leading zeros", "write: 10"},
    {"gain: 1_000\n", "5:7", "underscores", "write: 1000"},
    {"gain: 1,5\n", "5:7", "decimal point", "write: 1.5"},
    {"gain: 2000\n", "5:7", "gain must be from -1000 to 1000, not '2000'", "factor on this contact's sound"},
    {"start: 1:30\n", "5:8", "clock time", "90 s"},
    {"start: 2 m\n", "5:8", "start needs a time; m is a unit of length", "10 ms"},
    {"start: -1 s\n", "5:8", "start must be from 0 s to 3600 s, not '-1 s'", "begins"},
    {"output: {sample_rate: 44100.5}\n", "5:23", "output.sample_rate must be a whole number, not '44100.5'", "44.1 kHz"},
    {"output: {sample_rate: 4 kHz}\n", "5:23", "output.sample_rate must be from 8 kHz to 768 kHz", "per second"},
    {"output: {channels: 1.5}\n", "5:20", "output.channels must be a whole number", "2"},
    {"output: {channels: 0}\n", "5:20", "output.channels must be from 1 to 64", "channels"},
    {"output: {tail: automatic}\n", "5:16", "output.tail needs a time, not 'automatic'", "10 ms"},
    {"output: {level: {full_scale: 3 N}}\n", "5:30", "unit of force", "1 mm/s"},
    {"output: {level: {peak: 3 dB}}\n", "5:24", "output.level.peak must be from -200 dB to 0 dB", "peak"},
    /* words */
    {"output: {encoding: pcm_24}\n", "5:20", "output.encoding must be one of: pcm16, pcm24, float32, float64, not 'pcm_24'", "did you mean 'pcm24'?"},
    {"output: {encoding: mp3}\n", "5:20", "one of: pcm16", "encoding: pcm24"},
    {"contact: {model: roll}\n", "5:18", "contact.model must be scrape, not 'roll'", "model: scrape"},
    {"name: 2nd\n", "5:7", "must not start with a digit, not '2nd'", "left_hand"},
    {"name: my contact\n", "5:7", "letters, digits and _", "left_hand"},
    /* alternatives, keys that do not apply */
    {"grip: {}\nload: {constant: 1 N}\n", "6:8", "load.constant and grip exclude each other", "grip stands in scenes/t.yaml line 5"},
    {"output: {level: {lufs: -23, peak: -1 dB}}\n", "5:29", "output.level.peak and output.level.lufs exclude", "line 5"},
    {"contact: {force: paper, leak: 1 mm}\n", "5:25", "contact.leak applies only where contact.force is directional", "it is paper"},
    {"contact: {limiter: {curve: none, zeta: 1}}\n", "5:34", "contact.limiter.zeta applies only where contact.limiter.curve is tanh", "it is none"},
    /* pairs and lists */
    {"contact: {limiter: {force_range: [5 N, 1 N]}}\n", "5:34", "first number of contact.limiter.force_range must be less", "[1 N, 5 N]"},
    {"contact: {limiter: {force_range: [1 N, 5 m]}}\n", "5:40", "the second number of contact.limiter.force_range needs a force", "1.5 N"},
    {"contact: {limiter: {force_range: [1 N]}}\n", "5:34", "must be a list of 2 numbers, not of 1", "[1 N, 5 N]"},
    {"contact: {limiter: {force_range: 3 N}}\n", "5:34", "must be a list of 2 numbers, not '3 N'", "[1 N, 5 N]"},
    {"contact: {limiter: {alpha_min: 6 cm}}\n", "5:32", "contact.limiter.alpha_min must not be greater than contact.limiter.alpha_max", ""},
    {"contact: {limiter: {alpha_max: 5 mm}}\n", "5:32", "must not be greater than contact.limiter.alpha_max", ""},
    {"output: {diagnostics: {columns: [a, b, a]}}\n", "5:40", "output.diagnostics.columns has 'a' twice", "remove"},
    {"output: {diagnostics: {columns: [a, '']}}\n", "5:37", "an entry of output.diagnostics.columns must be a text", "columns: ["},
    {"output: {diagnostics: {columns: [[a]]}}\n", "5:34", "must be a text, not a list", "columns: ["},
    {"output: {diagnostics: {columns: []}}\n", "5:33", "must be a list of 1 to 1000 texts, not of 0", "columns: ["},
    {"output: {diagnostics: {columns: speed}}\n", "5:33", "must be a list of 1 to 1000 texts, not 'speed'", "columns: ["},
    {"output: {diagnostics: yes}\n", "5:23", "output.diagnostics must be a map of keys, not 'yes'", "rate, columns"},
    /* accuracy */
    {"accuracy: best\n", "5:11", "accuracy must be a preset or a map of knobs, not 'best'", "draft, standard, high, reference"},
    {"accuracy: hihg\n", "5:11", "accuracy must be a preset", "did you mean 'high'?"},
    {"accuracy: [high]\n", "5:11", "not a list", "presets"},
    {"accuracy: {preset: hi}\n", "5:20", "not 'hi'", "presets"},
    {"accuracy: {error: -80 dB}\n", "5:12", "choosing the accuracy by an error is not offered", "name a preset"},
    {"accuracy: {oversmapling: 4}\n", "5:12", "unknown key 'oversmapling' in accuracy", "did you mean 'oversampling'?"},
    {"accuracy: {oversampling: 100}\n", "5:26", "accuracy.oversampling must be from 1 to 64", "sub-intervals"},
    {"accuracy: {oversampling: 2.5}\n", "5:26", "accuracy.oversampling must be a whole number", "sub-intervals"},
    {"accuracy: {oversampling: 2 s}\n", "5:26", "without a unit", "write: 2"},
    {"accuracy: {overlap_order: 3}\n", "5:27", "overlap_order 3 is not offered", "write 2 or 4"},
    /* inputs */
    {"inputs: a.csv\n", "5:9", "inputs must be a list", "sha256"},
    {"inputs: [a.csv]\n", "5:10", "an entry of inputs must be a map", "sha256"},
    {"inputs: [{file: a, sha256: 12}]\n", "5:28", "64 hexadecimal digits", "sha256"},
    {"inputs: [{sha256: 0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef}]\n", "5:10", "has no file", "file"},
    {"inputs: [{file: a, md5: 12}]\n", "5:20", "unknown key 'md5' in inputs", "file, sha256"},
    /* contacts beside the top-level form */
    {"#rasp: 1\nscraper: {mass: 1 g}\ncontacts:\n- surface: {height_map: a.npy}\n  scraper: {mass: 1 g}\n  motion: {path: line, to: [1, 0], duration: 1}\n", "2:1",
     "'scraper' describes one contact and must not stand beside contacts", "contacts.NAME.scraper"},
    {"#rasp: 1\ncontacts: []\n", "2:11", "contacts must be a list of 1 to 1000 contacts, not of 0", "- name"},
    {"#rasp: 1\ncontacts: {rod: {}}\n", "2:11", "contacts must be a list of 1 to 1000 contacts, not a map", "- name"},
    {"#rasp: 1\ncontacts: [rod]\n", "2:12", "an entry of contacts must be a map of keys, not 'rod'", "- name"},
    /* include */
    {"include: a.yaml\n", "5:10", "include must be a list", "include: ["},
    {"include: [[a]]\n", "5:11", "an entry of include must be a file name", "include: ["},
    {"include: [no/such/file.yaml]\n", "5:11", "cannot read 'scenes/no/such/file.yaml': No such file", "relative to that file's folder"},
    /* missing */
    {"#surface: {height_map: a.npy}\nscraper: {mass: 20 g}\nmotion: {path: line, to: [1, 0], duration: 1 s}\n", "1:1", "rasp is missing", "add for instance: rasp: 1"},
    {"#rasp: 1\nsurface: {height_map: a.npy}\nscraper: {weight: 1}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "3:1", "scraper.mass is missing",
     "add for instance: mass: 20 g"},
    {"#rasp: 1\nsurface: {height_map: a.npy}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "1:1", "scraper.mass is missing", "scraper: {mass: 20 g}"},
    {"#rasp: 1\nsurface: {along: x}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "2:1",
     "surface.height_map or surface.roughness must be given", "height_map: profile.npy"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: back_and_forth, to: [1, 0], rate: 2}\n", "4:1", "motion.duration is missing",
     "duration: 10 ms"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: back_and_forth, to: [1, 0], duration: 2}\n", "4:1", "motion.rate is missing",
     "rate: 2 Hz"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0]}\n", "4:1", "motion.speed or motion.duration must be given", "speed: 10 cm/s"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {to: [1, 0], duration: 1}\n", "4:1", "motion.path is missing", "path: back_and_forth"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, duration: 1}\n", "4:1", "motion.to is missing", "to: [3 cm, 0]"},
    /* values that contradict */
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, from: [1 cm, 0], to: [10 mm, 0], duration: 1}\n", "4:43",
     "motion.to must differ from motion.from", ""},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [0, 0], duration: 1}\n", "4:26", "motion.to must differ from motion.from", ""},
    {"#rasp: 1\nsurface: {roughness: {shortest: 3 mm}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "2:33",
     "surface.roughness.shortest must be less than surface.roughness.longest", ""},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, rate: 2 Hz, to: [1, 0], duration: 1}\n", "4:22",
     "motion.rate applies only where motion.path is back_and_forth", "it is line"},
    {"#rasp: 2\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "1:7", "rasp must be 1, not '2'", "version 1"},
    {"#rasp: 1\nsurface: {roughness: {}, origin: [1 cm, 0]}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "2:26",
     "surface.origin applies only where surface.along is x", "not given"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, 2 cm, 3 cm], duration: 1}\n", "4:26",
     "motion.to must be a list of 2 numbers, not of 3", "[3 cm, 0]"},
    {"#rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1 cm, {y: 1}], duration: 1}\n", "4:33",
     "the second number of motion.to needs a length, not a map of keys", "3 cm"},
    {"#rasp: 1\nsurface: {height_map: [a]}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1, 0], duration: 1}\n", "2:23",
     "surface.height_map must be a file name, not a list", "profile.npy"},
    /* not a scene at all */
    {"#just words\n", "1:1", "a scene must be a map of keys", "title"},
    {"#- a\n- b\n", "1:1", "a scene must be a map of keys", "title"},
    {"#rasp: 1\nsurface: {\n", "3:1", "not valid YAML", "brackets"},
};

static void one_error(const struct result *r, const char *start, const char *says, const char *cure)
{
    const char *line_end = strchr(r->messages, '\n');
    ck_assert_msg(!r->good, "%s %s: accepted", start, says);
    ck_assert_msg(strncmp(r->messages, start, strlen(start)) == 0, "%s %s:\n%s", start, says, r->messages);
    const char *found = strstr(r->messages, says), *help = strstr(r->messages, "= help: ");
    ck_assert_msg(found && found < line_end, "%s %s:\n%s", start, says, r->messages);
    ck_assert_msg(!*cure || (help && strstr(help, cure)), "%s %s:\n%s", start, says, r->messages);
    ck_assert_msg(strstr(r->messages, "\n1 error\n") != NULL, "%s %s:\n%s", start, says, r->messages);
}

START_TEST(test_bad)
{
    ck_assert_uint_ge(sizeof bads / sizeof bads[0], 60);
    for (size_t i = 0; i < sizeof bads / sizeof bads[0]; i++) {
        char text[1024], start[128];
        const struct bad *b = &bads[i];
        snprintf(text, sizeof text, "%s%s", *b->text == '#' ? "" : MIN, *b->text == '#' ? b->text + 1 : b->text);
        snprintf(start, sizeof start, "scenes/t.yaml:%s: error: ", b->place);
        struct result r = read_with(text, NULL);
        one_error(&r, start, b->says, b->cure);
        ck_assert_int_eq(r.err.kind, strstr(b->text, "no/such") ? ERR_INPUT : ERR_SCENE);
        ck_assert_msg(strncmp(r.err.text, start, strlen(start)) == 0, "%s", r.err.text);
        arena_close(r.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ several errors at once */

START_TEST(test_all_at_once)
{
    struct result r = read_with("rasp: 1\nscraper:\n  mass: 20 cm\n\tx\n", NULL);
    one_error(&r, "scenes/t.yaml:4:1: error: not valid YAML", "tab", "tabs");
    arena_close(r.arena);
    r = read_with("rasp: 1\nsurface: {roughness: {rms: 1 V}}\nscraper:\n  mass: 20 cm\nmotion:\n  path: lin\n  to: [1 cm, 2 s]\ntitel: x\n", NULL);
    ck_assert_str_eq(r.messages,
                     "scenes/t.yaml:2:28: error: surface.roughness.rms needs a length; 'V' is not a unit that is known\n"
                     "    2 | surface: {roughness: {rms: 1 V}}\n"
                     "      |                            ^~~\n"
                     "      = help: units: m, cm, mm, um, nm; write for instance: 3 cm\n"
                     "scenes/t.yaml:4:9: error: scraper.mass needs a mass; cm is a unit of length\n"
                     "    4 |   mass: 20 cm\n"
                     "      |         ^~~~~\n"
                     "      = help: write for instance: 20 g\n"
                     "scenes/t.yaml:6:9: error: motion.path must be one of: back_and_forth, line, not 'lin'\n"
                     "    6 |   path: lin\n"
                     "      |         ^~~\n"
                     "      = help: did you mean 'line'?\n"
                     "scenes/t.yaml:7:14: error: the second number of motion.to needs a length; s is a unit of time\n"
                     "    7 |   to: [1 cm, 2 s]\n"
                     "      |              ^~~\n"
                     "      = help: write for instance: 3 cm\n"
                     "scenes/t.yaml:8:1: error: unknown key 'titel'\n"
                     "    8 | titel: x\n"
                     "      | ^~~~~\n"
                     "      = help: did you mean 'title'?\n"
                     "5 errors\n");
    ck_assert_str_eq(r.err.text, "scenes/t.yaml:2:28: error: surface.roughness.rms needs a length; 'V' is not a unit that is known (and 4 more)");
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ --set */

#define SET(...) ((const char *const[]){__VA_ARGS__, NULL})

static const char two[] = "rasp: 1\n"
                          "contacts:\n"
                          "- name: rod\n"
                          "  surface: {roughness: {}}\n"
                          "  scraper: {mass: 20 g}\n"
                          "  motion: {path: back_and_forth, to: [1 cm, 0], rate: 2 Hz, duration: 1 s}\n"
                          "- name: nail\n"
                          "  start: 0.5 s\n"
                          "  surface: {roughness: {}}\n"
                          "  scraper: {mass: 1 g}\n"
                          "  motion: {path: line, to: [1 cm, 0], speed: 10 cm/s}\n";

START_TEST(test_set)
{
    struct result r = read_good(full, SET("motion.rate=3 Hz", "motion.rate= 4 Hz ", "title=Fast: #1", "motion.to=[1 cm, 2 cm]", "surface.response=x.csv",
                                          "output.level={lufs: null, peak: -1 dB}", "accuracy.gain_ramp=7", "grip=~", "load.constant=2 N"));
    const struct contact *c = r.scene.contacts;
    ck_assert(c->motion.rate == 4 && c->motion.to[0] == 0.01 && c->motion.to[1] == 0.02 && !c->grip.given && c->load.constant == 2);
    ck_assert_str_eq(r.scene.title, "Fast: #1");
    ck_assert_str_eq(c->surface.response.file, "x.csv"); /* seen from the current folder */
    ck_assert_str_eq(c->scraper.response.file, "scenes/rod.csv");
    ck_assert(r.scene.output.level.peak == -1 && isnan(r.scene.output.level.lufs));
    ck_assert(r.scene.accuracy.gain_ramp == 7 && r.scene.accuracy.oversampling == 16);
    arena_close(r.arena);
    r = read_good(MIN "accuracy: high\n", SET("accuracy.oversampling=3", "motion.to.1=2 mm"));
    ck_assert(r.scene.accuracy.oversampling == 3 && r.scene.accuracy.gain_ramp == 16 && r.scene.contacts->motion.to[1] == 0.002);
    arena_close(r.arena);
    r = read_good(full, SET("accuracy=draft"));
    ck_assert(r.scene.accuracy.oversampling == 1 && r.scene.accuracy.overlap_hop == 24e-3);
    arena_close(r.arena);
}
END_TEST

static const struct {
    const char *scene, *set, *start, *says, *cure;
} bad_sets[] = {
    {full, "motion.rate=3 m", "--set motion.rate: error: ", "motion.rate needs a frequency", "2 Hz"},
    {full, "motion.raet=3 Hz", "--set motion.raet: error: ", "unknown key 'raet' in motion", "did you mean 'rate'?"},
    {full, "motoin.rate=3 Hz", "--set motoin.rate: error: ", "unknown key 'motoin'", "did you mean 'motion'?"},
    {full, "rate=3 Hz", "--set rate: error: ", "unknown key 'rate'", "motion.rate"},
    {full, "motion.rate", "--set motion.rate: error: ", "has no '=VALUE'", "motion.rate=3 Hz"},
    {full, "motion..rate=3", "--set motion..rate: error: ", "a part of the path is empty", "motion.rate=3 Hz"},
    {full, "=3", "--set : error: ", "a part of the path is empty", "motion.rate=3 Hz"},
    {full, "motion.rate=", "--set motion.rate: error: ", "motion.rate has no value", "2 Hz"},
    {full, "motion.to=[1 cm, 2 cm", "--set motion.to: error: ", "not valid YAML", "brackets"},
    {full, "motion.to=[1 cm, 2 s]", "--set motion.to: error: ", "the second number of motion.to needs a length", "3 cm"},
    {full, "motion.rate.x=1", "--set motion.rate.x: error: ", "motion.rate needs a frequency, not a map of keys", "2 Hz"},
    {full, "motion=fast", "--set motion: error: ", "motion must be a map of keys, not 'fast'", "keys here"},
    {full, "output.level.peak=-1 dB", "--set output.level.peak: error: ", "exclude each other", "output.level.lufs: null"},
    {full, "motion.speed=1 m/s", "--set motion.speed: error: ", "applies only where motion.path is line", "it is back_and_forth"},
    {full, "include=[x]", "--set include: error: ", "include cannot be set", "scene file"},
    {full, "accuracy.error=-80 dB", "--set accuracy.error: error: ", "not offered", "preset"},
    {full, "title=a\x07", "--set title: error: ", "control character U+0007", "remove"},
    {full, "title=\xff", "--set title: error: ", "not valid UTF-8", "UTF-8"},
    {full, "motion.to.2=1 cm", "--set motion.to.2: error: ", "no entry '2' in this list", "from 0 to 1"},
    {two, "contacts.rdo.motion.rate=3 Hz", "--set contacts.rdo.motion.rate: error: ", "no entry 'rdo' in this list", "did you mean 'rod'?"},
    {two, "contacts.2.motion.rate=3 Hz", "--set contacts.2.motion.rate: error: ", "no entry '2' in this list", "number from 0 to 1"},
    {two, "contacts.rod.motion.rate=3 s", "--set contacts.rod.motion.rate: error: ", "contacts.rod.motion.rate needs a frequency", "2 Hz"},
    {two, "contacts.1.motion.sped=3 s", "--set contacts.1.motion.sped: error: ", "unknown key 'sped' in contacts.nail.motion", "did you mean 'speed'?"},
    {two, "motion.rate=3 Hz", "--set motion.rate: error: ", "'motion' describes one contact", "contacts.NAME.motion"},
    {two, "contacts.rod.seed=3", "--set contacts.rod.seed: error: ", "'seed' belongs to the whole scene", "top level"},
    {two, "contacts.nail.name=rod", "--set contacts.nail.name: error: ", "two contacts are named 'rod'", "name of its own"},
    {two, "contacts.rod.surface=null", "scenes/t.yaml:3:3: error: ", "contacts.rod.surface.height_map or contacts.rod.surface.roughness must be given", "surface: {"},
};

START_TEST(test_bad_set)
{
    for (size_t i = 0; i < sizeof bad_sets / sizeof bad_sets[0]; i++) {
        struct result r = read_with(bad_sets[i].scene, SET(bad_sets[i].set));
        one_error(&r, bad_sets[i].start, bad_sets[i].says, bad_sets[i].cure);
        arena_close(r.arena);
    }
    struct result r = read_with(full, SET("motion.rate=3 m"));
    ck_assert_str_eq(r.messages, "--set motion.rate: error: motion.rate needs a frequency; m is a unit of length\n"
                                 "      | motion.rate=3 m\n"
                                 "      |             ^~~\n"
                                 "      = help: write for instance: 2 Hz\n"
                                 "1 error\n");
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ contacts */

START_TEST(test_contacts)
{
    struct result r = read_good(two, SET("contacts.rod.motion.rate=3 Hz", "contacts.1.gain=0.5", "contacts.nail.motion.to.1=1 cm"));
    const struct contact *c = r.scene.contacts;
    ck_assert_int_eq(r.scene.n_contacts, 2);
    ck_assert_str_eq(c[0].name, "rod");
    ck_assert_str_eq(c[1].name, "nail");
    ck_assert(c[0].motion.rate == 3 && c[1].gain == 0.5 && c[1].start == 0.5 && c[1].motion.speed == 0.1 && c[1].motion.to[1] == 0.01);
    arena_close(r.arena);
    r = read_with("rasp: 1\ncontacts:\n- surface: {roughness: {}}\n  scraper: {mass: 2 m}\n  motion: {path: line, to: [1, 0], duration: 1}\n", NULL);
    one_error(&r, "scenes/t.yaml:4:19: error: ", "contacts.0.scraper.mass needs a mass", "20 g");
    arena_close(r.arena);
    r = read_with("rasp: 1\ncontacts:\n- &c\n  surface: {roughness: {}}\n  scraper: {mass: 2 g}\n  motion: {path: line, to: [1, 0], duration: 1}\n- *c\n", NULL);
    one_error(&r, "scenes/t.yaml:3:3: error: ", "two contacts are named 'contact'", "name of its own");
    arena_close(r.arena);
}
END_TEST

/* ------------------------------------------------------------------ files */

static char folder[64];

static const char *path(const char *name)
{
    static char paths[4][128];
    static int next;
    next = (next + 1) % 4;
    snprintf(paths[next], sizeof paths[next], "%s/%s", folder, name);
    return paths[next];
}

static void write_file(const char *name, const char *text)
{
    FILE *f = fopen(path(name), "w");
    ck_assert_ptr_nonnull(f);
    fputs(text, f);
    fclose(f);
}

static struct result read_file(const char *name)
{
    struct result r = {.arena = arena_open()};
    r.good = scene_read(path(name), NULL, r.arena, &r.scene, &r.messages, &r.err);
    return r;
}

static void make_files(void)
{
    strcpy(folder, "/tmp/test_scene_XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder));
    ck_assert_int_eq(mkdir(path("sub"), 0700), 0);
    write_file("base.yaml", MIN "title: base\naccuracy: high\noutput: {ramp: 1 s, level: {lufs: -23}}\n");
    write_file("sub/late.yaml", "scraper: {response: rod.csv}\nmotion: {to: [5 cm, 6 cm]}\noutput: {ramp: 2 s}\ntitle: late\n");
    write_file("main.yaml", "include: [base.yaml, sub/late.yaml]\nscraper: {mass: 7 g}\ntitle: main\naccuracy: {oversampling: 5}\n"
                            "output: {level: {lufs: ~, rms: -30 dB}}\n");
    write_file("error.yaml", "include: [wrong.yaml]\ntitle: x\nseed: x\n");
    write_file("wrong.yaml", MIN "gain: 3 s\n");
    write_file("missing.yaml", MIN "include: [none.yaml, base.yaml]\n");
    write_file("cycle.yaml", MIN "include: [sub/cycle2.yaml]\n");
    write_file("sub/cycle2.yaml", "include: [../cycle.yaml]\n");
    write_file("syntax.yaml", MIN "include: [syntax2.yaml]\n");
    write_file("syntax2.yaml", "a: [\n");
    write_file("dup.yaml", MIN "include: [dup2.yaml]\n");
    write_file("dup2.yaml", "title: a\ntitle: b\n");
    write_file("both.yaml", "include: [base.yaml]\noutput: {level: {peak: -1 dB}}\n");
    for (int i = 0; i < 20; i++) {
        char name[32], text[64];
        snprintf(name, sizeof name, "deep%d.yaml", i);
        snprintf(text, sizeof text, "include: [deep%d.yaml]\n", i + 1);
        write_file(name, text);
    }
    write_file("deep20.yaml", MIN);
}

static void remove_files(void)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    ck_assert_int_eq(system(command), 0);
}

START_TEST(test_include)
{
    make_files();
    struct result r = read_file("main.yaml");
    ck_assert_msg(r.good, "%s", r.messages);
    const struct contact *c = r.scene.contacts;
    ck_assert_str_eq(r.scene.title, "main");
    ck_assert(c->scraper.mass == 0.007 && c->motion.to[0] == 0.05 && c->motion.to[1] == 0.06 && c->motion.duration == 1);
    ck_assert_str_eq(c->scraper.response.file, path("sub/rod.csv"));
    ck_assert_str_eq(c->surface.height_map, path("a.npy"));
    ck_assert(r.scene.output.ramp == 2 && isnan(r.scene.output.level.lufs) && r.scene.output.level.rms == -30);
    ck_assert_str_eq(r.scene.accuracy.preset, "high");
    ck_assert(r.scene.accuracy.oversampling == 5 && r.scene.accuracy.gain_ramp == 16);
    arena_close(r.arena);
    r = read_file("error.yaml");
    ck_assert(!r.good && r.err.kind == ERR_SCENE);
    const char *second = strstr(r.messages, "wrong.yaml:5:7: error: gain needs"), *first = strstr(r.messages, "error.yaml:3:7: error: seed must");
    ck_assert_msg(first && second && first < second, "%s", r.messages);
    arena_close(r.arena);
    remove_files();
}
END_TEST

START_TEST(test_bad_files)
{
    static const struct { const char *name, *at, *place, *says, *cure; enum err_kind kind; } rows[] = {
        {"missing.yaml", "missing.yaml", ":5:11: error: ", "none.yaml': No such file", "relative to that file's folder", ERR_INPUT},
        {"cycle.yaml", "sub/cycle2.yaml", ":1:11: error: ", "cycle.yaml' includes itself", "remove", ERR_SCENE},
        {"syntax.yaml", "syntax2.yaml", ":2:1: error: ", "not valid YAML", "brackets", ERR_SCENE},
        {"dup.yaml", "dup2.yaml", ":2:1: error: ", "duplicate key 'title'", "first set on line 1", ERR_SCENE},
        {"both.yaml", "both.yaml", ":2:18: error: ", "output.level.peak and output.level.lufs exclude each other", "output.level.lufs: null", ERR_SCENE},
        {"deep0.yaml", "deep16.yaml", ":1:11: error: ", "too many includes", "remove", ERR_SCENE},
        {"no.yaml", "no.yaml", ": error: ", "cannot be read: No such file", "", ERR_INPUT},
        {"sub", "sub", ": error: ", "cannot be read: Is a directory", "", ERR_INPUT},
    };
    make_files();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char start[256];
        struct result r = read_file(rows[i].name);
        snprintf(start, sizeof start, "%s%s", path(rows[i].at), rows[i].place);
        one_error(&r, start, rows[i].says, rows[i].cure);
        ck_assert_int_eq(r.err.kind, rows[i].kind);
        arena_close(r.arena);
    }
    remove_files();
}
END_TEST

/* ------------------------------------------------------------------ mutations */

/* Bytes replaced, removed, doubled and exchanged: every result is either a scene whose numbers are in range or messages. */
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
            case 0: text[at] = bytes[(size_t)rand() % sizeof bytes]; break;
            case 1: memmove(text + at, text + at + 1, --size - at); break;
            case 2: memmove(text + at + 1, text + at, size++ - at); break;
            default: text[at] ^= (char)(1 << rand() % 8); break;
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

UNIT("scene_read", test_full, test_defaults, test_tables, test_bad, test_all_at_once, test_set, test_bad_set, test_contacts, test_include,
     test_bad_files, test_mutations, test_cut_short)
