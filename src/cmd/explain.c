/* rasp explain: what a scene may say, and what a scene says in full. As JSON ranges are in SI units; null stands for
 * what there is none of: unit, range, default ("" would be a text), condition, words. */
#include <ctype.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/report.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"
#include "scene/params.h"
#include "scene/scene_materials.h"
#include "scene/scene_write.h"
#include "scene/units.h"

/* ------------------------------------------------------------------ JSON Schemas (draft 2020-12), for editors

   They know each key, its type, units, words and, of bare numbers, its range. They do not know which keys go together:
   `rasp check` does. Every key may be null, which stands for "not given". */

static const char number_pattern[] = "[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";

/* Takes the object, returns it. */
static json_t *described(json_t *o, const char *description)
{
    if (description) json_object_set_new(o, "description", json_string(description));
    return o;
}

/* Of a type or null: "array", "object"; "text": whatever is a text in YAML, be it a number. */
static json_t *plain(const char *type, const char *description)
{
    json_t *types = strcmp(type, "text") ? json_pack("[s, s]", type, "null")
                                         : json_pack("[s, s, s, s]", "string", "number", "boolean", "null");
    return described(json_pack("{s:o}", "type", types), description);
}

/* Takes items. */
static json_t *list(json_t *items, int least, int most, const char *description)
{
    json_t *o = plain("array", description);
    json_object_update_new(o, json_pack("{s:o, s:i, s:i}", "items", items, "minItems", least, "maxItems", most));
    return o;
}

/* A map that has these keys only; takes properties. */
static json_t *map(json_t *properties, const char *description)
{
    json_t *o = plain("object", description);
    json_object_update_new(o, json_pack("{s:o, s:b}", "properties", properties, "additionalProperties", 0));
    return o;
}

/* {"enum": [WORD, ..., null]} */
static json_t *one_of(const char *const *words)
{
    json_t *all = json_array();
    for (; *words; words++)
        json_array_append_new(all, json_string(*words));
    json_array_append_new(all, json_null());
    return json_pack("{s:o}", "enum", all);
}

/* {"$ref": "#/$defs/NAME"} */
static json_t *ref(const char *name) { return json_pack("{s:o}", "$ref", json_sprintf("#/$defs/%s", name)); }

/* A number as JSON writes it: 44100, not 44100.0. */
static json_t *number(double x) { return x == floor(x) && fabs(x) < 1e15 ? json_integer((json_int_t)x) : json_real(x); }

/* A bare number or one with a unit; low = high: any, or, not 0, that one. `word` may stand in its place; NULL: none. */
static json_t *quantity(enum key_dimension dimension, double low, double high, bool whole, const char *word,
                        struct arena *a)
{
    const char *units = units_pattern(dimension, a);
    const char *text = arena_format(a, "%s%s", number_pattern, *units ? arena_format(a, "([ \\t]*(%s))?", units) : "");
    text = word ? arena_format(a, "^(%s|%s)$", word, text) : arena_format(a, "^%s$", text);
    json_t *o =
        json_pack("{s:[s, s, s], s:s}", "type", whole ? "integer" : "number", "string", "null", "pattern", text);
    if (low < high || low != 0)
        json_object_update_new(
            o, json_pack("{s:o, s:o}", "minimum", number(low), "maximum", number(low < high ? high : low)));
    return o;
}

static json_t *of_dimension(const struct key *k, struct arena *a)
{
    return quantity(k->dimension, k->low, k->high, k->type == KEY_COUNT || k->type == KEY_WHOLE,
                    k->type == KEY_TIME_OR_AUTO ? "auto" : NULL, a);
}

static const char material_name[] = "^[A-Za-z_][A-Za-z0-9_]*$"; /* of a scene's own */

static json_t *typed(const struct key *k, struct arena *a)
{
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_WHOLE:
    case KEY_COUNT:
    case KEY_TIME_OR_AUTO:
        return of_dimension(k, a);
    case KEY_SEED:
        return json_pack("{s:[s, s, s], s:s, s:i}", "type", "integer", "string", "null", "pattern",
                         "^(0|[1-9][0-9]{0,19})$", "minimum", 0);
    case KEY_TEXT:
    case KEY_FILE:
        return plain("text", NULL);
    case KEY_POINT:
    case KEY_RANGE:
        return list(of_dimension(k, a), 2, 2, NULL);
    case KEY_POINTS:
        return list(list(of_dimension(k, a), 2, 2, NULL), 2, 10000, NULL);
    case KEY_PLACES:
        return list(list(of_dimension(k, a), 3, 3, NULL), 1, 64, NULL);
    case KEY_LIST: {
        if (strcmp(k->path, "output.diagnostics.columns") != 0)
            return list(json_pack("{s:s}", "type", "string"), 1, 1000, NULL);
        json_t *all = json_array();
        const struct params_column *t;
        for (int i = 0; (t = params_column(i, NULL)); i++)
            json_array_append_new(all, json_string(t->name));
        return list(json_pack("{s:o}", "enum", all), 1, 1000, NULL);
    }
    case KEY_CHOICE: {
        const char *words[64] = {NULL};
        for (int i = 0; i < 63 && k->choices[i].word; i++)
            words[i] = k->choices[i].word;
        if (!scene_materials_key(k)) return one_of(words);
        return json_pack("{s:[o, {s:s, s:s}]}", "anyOf", one_of(words), "type", "string", "pattern", material_name);
    }
    }
    return json_object();
}

/* The value of one key, with what `rasp explain` says of it. */
static json_t *key_value(const struct key *k, struct arena *a)
{
    const char *range = keys_text_range(k, a), *when = keys_text_applies(k, a),
               *all = arena_format(a, "%c%s.", toupper((unsigned char)k->meaning[0]), k->meaning + 1);
    if (!k->choices) all = arena_format(a, "%s Type: %s.", all, keys_text_type(k, a));
    if (range) all = arena_format(a, "%s Range: %s.", all, range);
    if (!k->standard || *k->standard)
        all = arena_format(a, "%s Default: %s.", all, k->standard ? k->standard : "none, it must be given");
    if (when) all = arena_format(a, "%s Only %s.", all, when);
    for (const struct choice *c = k->choices; c && c->word; c++)
        all = arena_format(a, "%s\n- %s: %s", all, c->word, c->meaning);
    json_t *o = described(typed(k, a), all);
    double x;
    if (k->standard && *k->standard && k->standard[0] != '[')
        json_object_set_new(o, "default", text_double(k->standard, &x) ? number(x) : json_string(k->standard));
    return o;
}

/* The schema of scenes. Dotted paths become maps in maps; those at the top stand in $defs, as one
   contact's keys may stand at the top level or in an entry of contacts. */

static const char *frame_meaning(const char *path)
{
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        if (!strcmp(p->path, path)) return p->meaning;
    return NULL;
}

/* The properties of the map `path`, under those of the top; maps are made as they are needed. */
static json_t *properties_at(json_t *top, const char *path, struct arena *a)
{
    if (!*path) return top;
    const char *dot = strrchr(path, '.'), *name = dot ? dot + 1 : path;
    json_t *outer = properties_at(top, arena_format(a, "%.*s", dot ? (int)(dot - path) : 0, path), a);
    const char *meaning = NULL;
    for (const struct key_section *s = keys_sections; s->path; s++)
        meaning = strcmp(s->path, path) ? meaning : s->meaning;
    if (!json_object_get(outer, name)) json_object_set_new(outer, name, map(json_object(), meaning));
    return json_object_get(json_object_get(outer, name), "properties");
}

/* "$defs" of both: the scene's top-level maps by name, and accuracy. */
static json_t *schema_maps(struct arena *a)
{
    json_t *top = json_object();
    for (const struct key *k = keys_table; k->path; k++) {
        const char *dot = strrchr(k->path, '.');
        if (dot)
            json_object_set_new(properties_at(top, arena_format(a, "%.*s", (int)(dot - k->path), k->path), a), dot + 1,
                                key_value(k, a));
    }
    json_t *knobs =
        json_pack("{s:o, s:o}", "preset", described(one_of(keys_presets), frame_meaning("accuracy.preset")), "error",
                  described(quantity(KEY_DECIBEL, -240, 0, false, NULL, a), frame_meaning("accuracy.error")));
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        json_object_set_new(knobs, k->name,
                            described(quantity(KEY_NONE, k->low, k->high, k->whole, NULL, a), k->meaning));
    json_object_set_new(top, "accuracy",
                        json_pack("{s:[o, o], s:s}", "anyOf", one_of(keys_presets), map(knobs, NULL), "description",
                                  frame_meaning("accuracy")));
    return top;
}

/* Into properties: the keys of a contact, or of the scene; maps as references. */
static void add_keys(json_t *properties, enum key_struct of, struct arena *a)
{
    for (const struct key *k = keys_table; k->path; k++) {
        size_t n = strcspn(k->path, ".");
        const char *name = arena_format(a, "%.*s", (int)n, k->path);
        if (k->of != of || json_object_get(properties, name)) continue;
        json_object_set_new(properties, name, k->path[n] ? ref(name) : key_value(k, a));
    }
}

/* An entry's numbers have the ranges of the object's keys of their names. */
static json_t *own_materials(struct arena *a)
{
    static const char *const numbers[] = {"youngs_modulus", "poisson", "density", "alpha", "beta", "loss", NULL};
    json_t *entry = json_object(), *all = map(json_object(), frame_meaning("materials"));
    for (const char *const *n = numbers; *n; n++)
        json_object_set_new(entry, *n, of_dimension(keys_find(arena_format(a, "surface.object.%s", *n)), a));
    json_object_set_new(entry, "wave_speed", quantity(KEY_SPEED, 1, 1e5, false, NULL, a));
    json_object_set_new(entry, "like", plain("text", NULL));
    json_object_set_new(entry, "source", plain("text", NULL));
    json_object_set_new(all, "patternProperties", json_pack("{s:o}", material_name, map(entry, NULL)));
    return all;
}

static json_t *schema_scene(struct arena *a)
{
    json_t *contact = json_object(), *all = json_object();
    add_keys(contact, KEY_CONTACT, a);
    add_keys(all, KEY_SCENE, a);
    add_keys(all, KEY_CONTACT, a);
    json_object_set_new(all, "accuracy", ref("accuracy"));
    json_object_set_new(all, "contacts", list(map(contact, NULL), 1, 1000, frame_meaning("contacts")));
    json_object_set_new(all, "include", list(plain("text", NULL), 0, 200, frame_meaning("include")));
    json_t *entry = map(json_pack("{s:o, s:{s:s, s:s}}", "file", plain("text", NULL), "sha256", "type", "string",
                                  "pattern", "^[0-9a-f]{64}$"),
                        NULL);
    json_object_set_new(entry, "required", json_pack("[s]", "file"));
    json_object_set_new(all, "materials", own_materials(a));
    json_object_set_new(all, "inputs", list(entry, 0, 1000000, frame_meaning("inputs")));
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:b, s:o}", "$schema", "https://json-schema.org/draft/2020-12/schema",
                     "title", "a scene of rasp", "description",
                     "What touches what, how it moves and how it rings; see rasp-scene(5). Which keys go "
                     "together, rasp check knows.",
                     "type", "object", "properties", all, "additionalProperties", 0, "$defs", schema_maps(a));
}

/* The schema of designs: see man rasp-design(5). */

/* What may be laid over a scene: dotted keys, maps of keys, and the same of a contact by its name. */
static json_t *settings(struct arena *a)
{
    json_t *all = json_object();
    for (const char **names = keys_text_names(a); *names; names++) {
        const char *knob = "accuracy/anyOf/1/properties/", *rest = *names, /* where a dotted path stands in $defs */
                                                               *to = strncmp(rest, "accuracy.", 9) ? "" : knob;
        rest += *to ? 9 : 0;
        for (const char *dot = strchr(rest, '.'); dot; rest = dot + 1, dot = strchr(rest, '.'))
            to = arena_format(a, "%s%.*s/properties/", to, (int)(dot - rest), rest);
        json_object_set_new(all, *names,
                            keys_find(*names) && !strchr(*names, '.') ? key_value(keys_find(*names), a)
                                                                      : ref(arena_format(a, "%s%s", to, rest)));
    }
    for (const char *const *own =
             (const char *const[]){"rasp", "seed", "include", "inputs", "contacts", "materials", NULL};
         *own; own++)
        json_object_del(all, *own);
    json_t *o =
        map(all,
            "keys laid over the scene: dotted (motion.rate: 2 Hz), or as maps; files as seen from the design's folder");
    json_object_set_new(o, "patternProperties", json_pack("{s:b}", "^contacts(\\.|$)", 1));
    return o;
}

static json_t *factors(struct arena *a)
{
    json_t *level =
        map(json_pack("{s:o, s:o, s:b, s:o, s:o, s:{s:[s], s:s}}", "label",
                      plain("text", "what it is called in names and lists"), "text",
                      plain("text", "what it is called in the text of a trial"), "value", 1, "set", ref("set"), "base",
                      plain("text", "a scene that takes the place of the design's"), "of", "enum", "recordings",
                      "description", "only recordings have it: no cell is crossed with it"),
            NULL);
    json_object_set_new(level, "required", json_pack("[s]", "label"));
    json_t *levels = list(json_pack("{s:[{s:[s, s, s]}, o]}", "anyOf", "type", "string", "number", "boolean", level), 1,
                          1000000, NULL);
    json_t *rules = json_pack("{s:O, s:o}", "choose", levels, "within", list(plain("text", NULL), 2, 2, NULL));
    for (const char *const *rule = (const char *const[]){"uniform", "log_uniform", "normal", NULL}; *rule; rule++)
        json_object_set_new(rules, *rule, list(plain("text", NULL), 2, 2, NULL));
    json_t *o = plain(
        "object",
        "factors, crossed, the first slowest: a dotted key with values, or a word with levels {label, set, base}; or "
        "one rule to draw samples by; or cells, as the table of cells has them");
    json_object_set_new(o, "additionalProperties",
                        json_pack("{s:[o, {s:[s]}, o]}", "anyOf", levels, "enum", "cells", map(rules, NULL)));
    json_t *keys = json_array(); /* or a word, or what contacts have */
    for (const char **names = keys_text_names(a); *names; names++)
        if (strchr(*names, '.')) json_array_append_new(keys, json_string(*names));
    json_object_set_new(
        o, "propertyNames",
        json_pack("{s:[{s:s}, {s:o}]}", "anyOf", "pattern", "^([A-Za-z][A-Za-z0-9_-]*|contacts\\..*)$", "enum", keys));
    return o;
}

/* Maps whose keys are factors: what `own` says, else a label of the factor, as `label` has it. */
static json_t *cells(json_t *own, json_t *label, const char *description)
{
    json_t *entry = plain("object", NULL);
    if (json_object_get(own, "file")) json_object_set_new(entry, "required", json_pack("[s]", "file"));
    json_object_set_new(entry, "properties", own);
    json_object_set_new(entry, "additionalProperties", label);
    return list(entry, 0, 1000000, description);
}

static json_t *level(struct arena *a)
{
    json_t *rules = json_object();
    for (const char *const *name = (const char *const[]){"peak", "rms", "lufs", "full_scale", "dbfs_at_1_pa", NULL};
         *name; name++)
        json_object_set_new(rules, *name, key_value(keys_find(arena_format(a, "output.level.%s", *name)), a));
    json_t *one = map(rules, NULL);
    json_object_update_new(one, json_pack("{s:i, s:i}", "minProperties", 1, "maxProperties", 1));
    json_t *rule = map(json_pack("{s:O, s:o}", "common", one, "each", one), NULL);
    json_object_set_new(rule, "maxProperties", json_integer(1));
    return json_pack("{s:[{s:[s, n]}, o], s:s}", "anyOf", "enum", "scene", rule, "description",
                     "one gain for the whole set, as in {common: {peak: -3 dB}}, the default; a gain for each "
                     "stimulus, as in {each: {lufs: -23}}: all equally loud; or as each scene says (scene)");
}

/* What listeners do. */
static json_t *trials(void)
{
    static const char *const texts[][2] = {
        {"question", "what listeners are asked"},
        {"instructions", "what they read before the first trial"},
        {"session", "a factor each of whose levels has a session of its own"},
        {"blocks", "a factor each of whose levels has a block of its own within a session"}};
    json_t *all = json_object(), *picked = list(json_pack("{s:s}", "type", "object"), 0, 1000, NULL);
    json_object_set_new(all, "task",
                        json_pack("{s:[s, s, s], s:s}", "enum", "rate", "choose", "compare", "description",
                                  "rate: a number for each sound of a trial; choose: an answer to its one sound; "
                                  "compare: which of two sounds"));
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        json_object_set_new(all, texts[i][0], plain("text", texts[i][1]));
    for (int i = 0; i < 2; i++)
        json_object_set_new(
            all, i ? "answers" : "within",
            json_pack("{s:[o, o], s:s}", "anyOf", plain("text", NULL), list(plain("text", NULL), 1, 1000, NULL),
                      "description",
                      i ? "texts of the answers, or the factor whose levels they are; of rate: words of "
                          "the scale; of compare: A, neither, B"
                        : "factors whose levels are heard within one trial"));
    json_object_set_new(all, "reference",
                        described(json_deep_copy(picked), "levels of the sound that the others are rated by"));
    json_object_set_new(all, "anchors", described(json_deep_copy(picked), "levels of sounds that are known to be bad"));
    json_object_set_new(
        all, "training",
        json_pack("{s:[{s:s, s:i}, o], s:s}", "anyOf", "type", "integer", "minimum", 0, picked, "description",
                  "how many trials are drawn to begin each session with, or levels of sounds that are for "
                  "training alone"));
    json_t *o = map(all, "what listeners do with the stimuli, for rasp export: nothing that is rendered depends on it");
    json_object_set_new(o, "required", json_pack("[s]", "task"));
    return o;
}

static json_t *schema_design(struct arena *a)
{
    json_t *seed = described(key_value(keys_find("seed"), a),
                             "seed of the set: a stimulus's own is made of it and of its replicate, so that cells "
                             "differ in nothing else; default: 1");
    json_object_set_new(seed, "default", json_integer(1));
    json_t *all = json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "rasp-design",
        described(quantity(KEY_NONE, 1, 1, true, NULL, a), "version of the format of designs; this is version 1"),
        "title", plain("text", "what the set is, for people"), "text",
        plain("text", "what a trial says, {FACTOR} standing for a level's text"), "base",
        plain("text", "the scene that all stimuli build on, as seen from the design's folder"), "seed", seed, "set",
        ref("set"), "factors", factors(a));
    json_object_set_new(
        all, "exclude",
        cells(json_object(),
              json_pack("{s:[o, o]}", "anyOf", plain("text", NULL), list(plain("text", NULL), 0, 1000000, NULL)),
              "cells that are left out: those that match all pairs of FACTOR: LABEL, or one of its LABELS"));
    json_object_set_new(
        all, "cells",
        json_pack("{s:[o, o], s:s}", "anyOf", cells(json_object(), plain("text", NULL), NULL), plain("text", NULL),
                  "description",
                  "the cells, listed, in place of crossing the factors; or a CSV with a column for each factor"));
    json_object_set_new(all, "recordings",
                        cells(json_pack("{s:o, s:o}", "file", plain("text", "a WAV"), "name", plain("text", NULL)),
                              plain("text", NULL), "supplied sounds as cells of their own"));
    json_object_set_new(all, "order",
                        json_pack("{s:[{s:[s, n]}, o], s:s}", "anyOf", "enum", "design",
                                  map(json_pack("{s:o}", "seed", key_value(keys_find("seed"), a)), NULL), "description",
                                  "as written (design, the default), or shuffled by {seed: NUMBER}"));
    json_object_set_new(all, "replicates",
                        described(quantity(KEY_NONE, 1, 1000000, true, NULL, a),
                                  "takes of each cell, which differ in their noise; default: 1"));
    json_object_set_new(all, "samples",
                        described(quantity(KEY_NONE, 1, 1000000, true, NULL, a),
                                  "how many samples there are of each cell, where factors are drawn"));
    json_t *splits =
        plain("object", "names with shares, as in {train: 8, test: 2}: the parts that the set is divided into, "
                        "replicates, and cells of one sample, together");
    json_object_set_new(splits, "additionalProperties", quantity(KEY_NONE, 0, 0, false, NULL, a));
    json_object_set_new(all, "splits", splits);
    json_object_set_new(all, "independent",
                        list(plain("text", NULL), 0, 1000,
                             "factors whose levels have noise of their own, and sample; default: [sample]"));
    json_object_set_new(
        all, "name",
        plain("text", "names of files: {FACTOR}, {replicate}, {sample}, {order}, {cell} between other characters"));
    json_object_set_new(all, "level", level(a));
    json_object_set_new(
        all, "length",
        described(
            quantity(KEY_TIME, 0, 0, false, "longest|own", a),
            "how long each sound is: as the longest of the set (longest, the default), as by itself (own), or a time"));
    json_object_set_new(all, "trials", trials());
    json_t *defs = schema_maps(a);
    json_object_set_new(defs, "set", settings(a));
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:b, s:[s], s:o}", "$schema",
                     "https://json-schema.org/draft/2020-12/schema", "title", "a design of rasp", "description",
                     "Which stimuli a set has; see rasp-design(5). What goes together, rasp batch --dry-run knows.",
                     "type", "object", "properties", all, "additionalProperties", 0, "required", "rasp-design", "$defs",
                     defs);
}
/* ------------------------------------------------------------------ keys */

static bool is_scene_file(const char *word)
{
    struct stat s;
    return strchr(word, '/') || text_ends(word, ".yaml") || text_ends(word, ".yml") ||
           (stat(word, &s) == 0 && !S_ISDIR(s.st_mode));
}

static const struct key_knob *find_knob(const char *path)
{
    const char *name = strncmp(path, "accuracy.", 9) ? path : path + 9;
    const struct key_knob *k = keys_knobs;
    while (k->name && strcmp(k->name, name) != 0)
        k++;
    return k->name ? k : NULL;
}

/* True when there was something of that name to explain. */
static bool explain_path(const char *path, const char **names, struct arena *a)
{
    const struct key *k = keys_find(path);
    const struct key_knob *knob = find_knob(path);
    while (*names && strcmp(*names, path) != 0)
        names++;
    if (k)
        keys_text_print_key(stdout, k, a);
    else if (knob)
        keys_text_print_knob(stdout, knob, a);
    else if (!strcmp(path, "accuracy"))
        keys_text_print_accuracy(stdout, a);
    else if (*names)
        keys_text_print_map(stdout, path, a);
    else
        return false;
    bool columns = !strcmp(path, "output.diagnostics.columns");
    if (columns) fputs("  columns\n", stdout);
    const struct params_column *t;
    for (int i = 0; columns && (t = params_column(i, NULL)); i++)
        text_wrap(stdout, t->meaning, printf("    %-22s ", t->name), "                           ");
    return true;
}

/* Every path that ends in the word: "motion.rate or output.diagnostics.rate"; NULL: none. */
static const char *endings(const char *word, const char **names, struct arena *a)
{
    const char *found = NULL;
    for (; *names; names++) {
        const char *dot = strrchr(*names, '.');
        if (dot && !strcmp(dot + 1, word)) found = found ? arena_format(a, "%s or %s", found, *names) : *names;
    }
    return found;
}

static json_t *design_key(json_t *schema, const char *word)
{
    json_t *key = json_object_get(json_object_get(schema, "properties"), word);
    return key && json_object_get(key, "$ref") ? json_object_get(json_object_get(schema, "$defs"), word) : key;
}

static const char *design_text(json_t *key)
{
    const char *text = json_string_value(json_object_get(key, "description"));
    return text ? text : "";
}

static bool names_designs(const char *word) { return !strcmp(word, "design") || !strcmp(word, "designs"); }

/* Every key of designs and what it is for; or one, which is explained elsewhere: of scenes there may be one of that
   name in some section, too. False: there is none. */
static bool explain_design(json_t *schema, const char *word, const char **names, struct arena *a)
{
    json_t *key = design_key(schema, word), *unused;
    const char *text = design_text(key), *scenes = endings(word, names, a), *name;
    if (names_designs(word)) {
        json_object_foreach(json_object_get(schema, "properties"), name, unused)
            text_wrap(stdout, design_text(design_key(schema, name)), printf("%s: ", name), "  ");
        printf("\ndesigns: man rasp-design(5), rasp batch --help\n");
    } else if (key) {
        printf("%s\n  a key of designs", word);
        text_wrap(stdout, text, 18 + (*text ? printf(": ") : 0), "  ");
        printf("%s  designs: man rasp-design(5)%s%s\n", *text ? "" : "\n", scenes ? "; of scenes there is " : "",
               scenes ? scenes : "");
    }
    return key || names_designs(word);
}

/* What a word is nearly spelt like, or the paths that end in it; NULL: nothing. */
static const char *meant_by(json_t *schema, const char *word, const char **names, struct arena *a)
{
    json_t *keys = json_object_get(schema, "properties"), *unused;
    const char **designs = ARENA_TAKE(a, const char *, json_object_size(keys) + 2), *name,
               *meant = endings(word, names, a);
    int n = 0;
    designs[n++] = "design";
    json_object_foreach(keys, name, unused) designs[n++] = name;
    if (!meant) meant = text_nearest(word, names);
    if (!meant && (meant = text_nearest(word, designs)) && meant != designs[0])
        meant = arena_format(a, "%s of designs", meant);
    return meant;
}

static void unknown(const char *word, const char *meant, struct err *e)
{
    if (meant)
        err_set(e, ERR_USAGE, "no key, section or scene file '%s'; did you mean %s?", word, meant);
    else
        err_set(e, ERR_USAGE, "no key, section or scene file '%s'; rasp explain shows every key", word);
}

/* Words that people have for what is called otherwise here. */
static const char *const synonyms[][2] = {
    {"repeat", "replicate"}, {"volume", "loudness"}, {"velocity", "speed"}, {"quality", "accuracy"}};

/* Does the text hold the word, or one that means the same? Without an s at its end; letters of either case. */
static bool speaks_of(const char *text, const char *word, struct arena *a)
{
    size_t n = strlen(word);
    const char *stem = arena_format(a, "%.*s", (int)(n > 3 && word[n - 1] == 's' ? n - 1 : n), word);
    if (strcasestr(text, stem)) return true;
    for (size_t i = 0; i < sizeof synonyms / sizeof *synonyms; i++)
        if (!strcasecmp(synonyms[i][0], stem) && strcasestr(text, synonyms[i][1])) return true;
    return false;
}

/* How much of a meaning is its first thought. */
static size_t gist(const char *meaning)
{
    size_t n = strcspn(meaning, ";(");
    for (const char *p = meaning; p < meaning + n; p++)
        if (text_ends_sentence(meaning, p)) return (size_t)(p - meaning);
    return n;
}

/* Keys whose name, meaning or words have it, a line each. False: there are none, or more than would help. */
static bool explain_search(json_t *schema, const char *word, struct arena *a)
{
    enum { MOST = 40 };
    const char *found[MOST][2], *name;
    json_t *unused;
    int n = 0;
    if (strlen(word) < 3) return false;
    for (const struct key *k = keys_table; k->path && n < MOST; k++) {
        bool has = k->meaning && (speaks_of(k->path, word, a) || speaks_of(k->meaning, word, a) ||
                                  speaks_of(units_name(k->dimension), word, a));
        for (const struct choice *c = k->choices; k->meaning && c && c->word && !has; c++)
            has = speaks_of(c->word, word, a);
        if (has) found[n][0] = k->path, found[n++][1] = k->meaning;
    }
    json_object_foreach(json_object_get(schema, "properties"), name, unused)
    {
        const char *text = design_text(design_key(schema, name));
        if (n < MOST && (speaks_of(name, word, a) || speaks_of(text, word, a)))
            found[n][0] = arena_format(a, "%s of designs", name), found[n++][1] = text;
    }
    if (n == 0 || n == MOST) return false;
    printf("no key is called '%s'; these speak of it:\n", word);
    for (int i = 0; i < n; i++)
        text_wrap(stdout, arena_format(a, "%.*s", (int)gist(found[i][1]), found[i][1]), printf("  %-30s ", found[i][0]),
                  "                                 ");
    return true;
}

/* The keys and knobs at a path or in a map of that path, in the order of the tables; NULL: all. */
static void explain_json(json_t *schema, const char *word, const char **names, struct arena *a, struct err *e)
{
    const char *path = word ? keys_text_plain(word) : "";
    size_t n = strlen(path);
    const struct key_knob *knob = find_knob(path);
    bool all = !n || !strcmp(path, "accuracy");
    struct report r = report_open_list(stdout, true);
    for (const struct key *k = keys_table; k->path; k++) {
        if (n && (strncmp(k->path, path, n) != 0 || (k->path[n] && k->path[n] != '.'))) continue;
        bool range = keys_text_range(k, a);
        report_set(&r, ":{ path:s meaning:s type:s unit:e low:n high:n must_be_given:b default:e only:e words:0",
                   k->path, k->meaning, k->type == KEY_CHOICE ? "word" : keys_text_type(k, a),
                   keys_text_unit(k->dimension), range ? k->low : NAN, range ? k->high : NAN, !k->standard, k->standard,
                   keys_text_applies(k, a));
        if (k->choices) report_set(&r, "words:[");
        for (const struct choice *c = k->choices; c && c->word; c++)
            report_set(&r, ":{ word:s meaning:s }", c->word, c->meaning);
        report_set(&r, k->choices ? "] }" : "}");
    }
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        if (!all && k != knob) continue;
        report_set(&r, ":{ path:s meaning:s type:s low:n high:n presets:{", arena_format(a, "accuracy.%s", k->name),
                   k->meaning, k->whole ? "whole number" : "number", k->low, k->high);
        for (int i = 0; keys_presets[i]; i++)
            report_set(&r, "$:n", keys_presets[i], k->preset[i]);
        report_set(&r, "} }");
    }
    if (json_array_size(r.open.at[0]) > 0) {
        report_close(&r, 0, e);
        return;
    }
    json_decref(r.open.at[0]);
    if (names_designs(word))
        err_set(e, ERR_USAGE, "designs' keys are in rasp explain --schema=design; --json is for scenes");
    else if (design_key(schema, word))
        err_set(e, ERR_USAGE, "%s is a key of designs, which rasp explain --schema=design has; --json is for scenes",
                word);
    else if (is_scene_file(word))
        err_set(e, ERR_USAGE, "--json is for keys and sections; an effective scene is YAML");
    else
        unknown(word, meant_by(schema, word, names, a), e);
}

static int explain_run(struct cmd_call *c, struct err *e)
{
    const char *word = c->args.n_operands ? c->args.operands[0] : NULL;
    const char **names = keys_text_names(c->arena);
    json_t *schema = schema_design(c->arena), *key = word ? design_key(schema, word) : NULL;
    static const char *const parts[] = {"keys", "columns"}, *const schemas[] = {"scene", "design"};
    int part = 0, of = 0;
    const struct params_column *t;
    if (args_given(&c->args, "man")) {
        if (cmd_either(c, "man", parts, &part, e) && part == 0) keys_text_man(stdout, c->arena);
        for (int k = 0; part == 1 && (t = params_column(k, NULL)); k++)
            printf(".It Ic %s\n%c%s.\n", t->name, toupper((unsigned char)t->meaning[0]), t->meaning + 1);
    } else if (args_given(&c->args, "schema")) {
        if (cmd_either(c, "schema", schemas, &of, e)) {
            struct report r = {
                .out = stdout, .json = true, .open = {{of ? json_incref(schema) : schema_scene(c->arena)}, 0}};
            report_close(&r, 0, e);
        }
    } else if (args_given(&c->args, "json"))
        explain_json(schema, word, names, c->arena, e);
    else if (!word)
        keys_yaml_reference(stdout, c->arena);
    else if (explain_path(keys_text_plain(word), names, c->arena)) {
        if (key) /* of scenes and of designs, each with a meaning of its own */
            text_wrap(stdout, design_text(key), printf("  designs   have one, too: "), "            ");
    } else if (is_scene_file(word)) {
        struct scene s;
        if (cmd_read_scene(c, word, &s, e)) fputs(scene_write(&s, NULL, c->arena), stdout);
    } else if (!explain_design(schema, word, names, c->arena)) {
        if (endings(word, names, c->arena) || !explain_search(schema, word, c->arena))
            unknown(word, meant_by(schema, word, names, c->arena), e);
    }
    json_decref(schema);
    return 0;
}

static const struct args_option options[] = {
    CMD_SCENE_OPTIONS,
    {"json", 'j', NULL, false, "print keys as a JSON array, an object each: all, one, or those of a section"},
    {"schema", 0, "scene|design", false,
     "print the JSON Schema of scenes, or of designs, for editors (installed as share/rasp/*.schema.json)"},
    {"man", 0, "keys|columns", false, "prints a part of man rasp-scene(5), in mdoc"},
    {0},
};

const struct command explain_command = {
    .name = "explain",
    .summary = "says what a key means, or all that a scene leaves unsaid",
    .does =
        "Without an operand: a scene with every key there is, explained. With a key or a section (motion.rate, motion, "
        "accuracy.oversampling): its type, unit, range, default and meaning. With a key of designs (factors, level, "
        "length): what it is for; with design: all of them; rasp-design(5) has the rest. With another word: the keys "
        "that speak of it. With a "
        "scene file: the effective scene, in which every default and accuracy knob is written out; rendering it gives "
        "the same bytes.",
    .operands = "[KEY | SECTION | SCENE]",
    .least = 0,
    .most = 1,
    .options = options,
    .examples = "rasp explain > every-key.yaml\n"
                "rasp explain motion.rate\n"
                "rasp explain accuracy\n"
                "rasp explain --json motion\n"
                "rasp explain design\n"
                "rasp explain --schema=scene > scene.schema.json\n"
                "rasp explain scrape.yaml > effective.yaml\n",
    .run = explain_run,
};
