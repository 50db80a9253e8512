/* See schema.h: values and maps of values first, then scenes, then designs. */
#include "cmd/schema.h"

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/arena.h"
#include "base/text.h"
#include "output/force_table.h"
#include "scene/keys.h"
#include "scene/keys_text.h"
#include "scene/units_table.h"

/* A bare number or one with a unit; low = high: any. `word` may stand in its place; NULL: none. */
struct schema_value_quantity {
    enum key_dimension dimension;
    double low, high;
    bool whole;
    const char *word;
};

static const char *description(const struct key *k, struct arena *a);
static json_t *level(struct arena *a);

static const char number_pattern[] = "[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";

static void describe(json_t *o, const char *description)
{
    if (description) json_object_set_new(o, "description", json_string(description));
}

/* {"type": [TYPE, "null"], "description": ...}; type "text": whatever is a text in YAML, be it a number. description
 * may be NULL. */
static json_t *schema_value_plain(const char *type, const char *description)
{
    json_t *o = json_object();
    json_object_set_new(o, "type",
                        strcmp(type, "text") ? json_pack("[s, s]", type, "null")
                                             : json_pack("[s, s, s, s]", "string", "number", "boolean", "null"));
    describe(o, description);
    return o;
}

/* {"type": ["array", "null"], "items": items, "minItems": least, "maxItems": most}; takes items. */
static json_t *schema_value_list(json_t *items, int least, int most, const char *description)
{
    json_t *o = schema_value_plain("array", description);
    json_object_set_new(o, "items", items);
    json_object_set_new(o, "minItems", json_integer(least));
    json_object_set_new(o, "maxItems", json_integer(most));
    return o;
}

/* A map that has these keys only; takes properties. */
static json_t *schema_value_map(json_t *properties, const char *description)
{
    json_t *o = schema_value_plain("object", description);
    json_object_set_new(o, "properties", properties);
    json_object_set_new(o, "additionalProperties", json_false());
    return o;
}

/* {"$ref": "#/$defs/NAME"} */
static json_t *schema_value_ref(const char *name)
{
    return json_pack("{s:o}", "$ref", json_sprintf("#/$defs/%s", name));
}

/* A number as JSON writes it: 44100, not 44100.0. */
static json_t *number(double x) { return x == floor(x) && fabs(x) < 1e15 ? json_integer((json_int_t)x) : json_real(x); }

static json_t *schema_value_quantity(const struct schema_value_quantity *q, struct arena *a)
{
    json_t *o = json_object();
    const char *units = units_table_pattern(q->dimension, a);
    const char *text = arena_format(a, "%s%s", number_pattern, *units ? arena_format(a, "([ \\t]*(%s))?", units) : "");
    text = q->word ? arena_format(a, "^(%s|%s)$", q->word, text) : arena_format(a, "^%s$", text);
    json_object_set_new(o, "type", json_pack("[s, s, s]", q->whole ? "integer" : "number", "string", "null"));
    json_object_set_new(o, "pattern", json_string(text));
    if (q->low < q->high) {
        json_object_set_new(o, "minimum", number(q->low));
        json_object_set_new(o, "maximum", number(q->high));
    } else if (q->low != 0) {
        json_object_set_new(o, "minimum", number(q->low));
        json_object_set_new(o, "maximum", number(q->low));
    }
    return o;
}

static json_t *of_dimension(const struct key *k, struct arena *a)
{
    bool whole = k->type == KEY_COUNT || k->type == KEY_WHOLE;
    return schema_value_quantity(&(struct schema_value_quantity){k->dimension, k->low, k->high, whole,
                                                                 k->type == KEY_TIME_OR_AUTO ? "auto" : NULL},
                                 a);
}

static json_t *names(const struct key *k)
{
    json_t *items = json_object(), *all = json_array();
    for (const struct table_column *t = force_table_columns; !strcmp(k->path, "output.diagnostics.columns") && t->name;
         t++)
        json_array_append_new(all, json_string(t->name));
    if (json_array_size(all) > 0)
        json_object_set(items, "enum", all);
    else
        json_object_set_new(items, "type", json_string("string"));
    json_decref(all);
    return schema_value_list(items, 1, 1000, NULL);
}

static json_t *seed(void)
{
    json_t *o = json_object();
    json_object_set_new(o, "type", json_pack("[s, s, s]", "integer", "string", "null"));
    json_object_set_new(o, "pattern", json_string("^(0|[1-9][0-9]{0,19})$"));
    json_object_set_new(o, "minimum", json_integer(0));
    return o;
}

static json_t *typed(const struct key *k, struct arena *a)
{
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_WHOLE:
    case KEY_COUNT:
    case KEY_TIME_OR_AUTO:
        return of_dimension(k, a);
    case KEY_SEED:
        return seed();
    case KEY_TEXT:
    case KEY_FILE:
        return schema_value_plain("text", NULL);
    case KEY_POINT:
    case KEY_RANGE:
        return schema_value_list(of_dimension(k, a), 2, 2, NULL);
    case KEY_POINTS:
        return schema_value_list(schema_value_list(of_dimension(k, a), 2, 2, NULL), 2, 10000, NULL);
    case KEY_PLACES:
        return schema_value_list(schema_value_list(of_dimension(k, a), 3, 3, NULL), 1, 64, NULL);
    case KEY_LIST:
        return names(k);
    case KEY_CHOICE: {
        json_t *o = json_object(), *all = json_array();
        for (const struct choice *c = k->choices; c->word; c++)
            json_array_append_new(all, json_string(c->word));
        json_array_append_new(all, json_null());
        json_object_set_new(o, "enum", all);
        return o;
    }
    }
    return json_object();
}

static const char *sentence(const char *text, struct arena *a)
{
    char *copy = arena_text(a, text);
    if (copy[0] >= 'a' && copy[0] <= 'z') copy[0] = (char)(copy[0] - 'a' + 'A');
    return arena_format(a, "%s.", copy);
}

/* The meaning, the type where it is a quantity, range, default, when it applies, and what the words mean. */
static const char *description(const struct key *k, struct arena *a)
{
    const char *range = keys_text_range(k, a), *when = keys_text_applies(k, a), *all = sentence(k->meaning, a);
    if (!k->choices) all = arena_format(a, "%s Type: %s.", all, keys_text_type(k));
    if (range) all = arena_format(a, "%s Range: %s.", all, range);
    if (!k->standard || *k->standard)
        all = arena_format(a, "%s Default: %s.", all, k->standard ? k->standard : "none, it must be given");
    if (when) all = arena_format(a, "%s Only %s.", all, when);
    for (const struct choice *c = k->choices; c && c->word; c++)
        all = arena_format(a, "%s\n- %s: %s", all, c->word, c->meaning);
    return all;
}

/* The value of one key, with what `rasp explain` says of it. */
static json_t *schema_value_key(const struct key *k, struct arena *a)
{
    json_t *o = typed(k, a);
    describe(o, description(k, a));
    double x;
    if (k->standard && *k->standard && k->standard[0] != '[')
        json_object_set_new(o, "default", text_double(k->standard, &x) ? number(x) : json_string(k->standard));
    return o;
}

/* The schema of scenes: see schema.h. Dotted paths become maps in maps; those at the top stand in $defs, as one
   contact's keys may stand at the top level or in an entry of contacts. */

static const char *frame_meaning(const char *path)
{
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        if (!strcmp(p->path, path)) return p->meaning;
    return NULL;
}

static const char *section_meaning(const char *path)
{
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (!strcmp(s->path, path)) return s->meaning;
    return NULL;
}

/* The properties of the map `path`, under those of the top; maps are made as they are needed. */
static json_t *properties_at(json_t *top, const char *path, struct arena *a)
{
    if (!*path) return top;
    const char *dot = strrchr(path, '.'), *name = dot ? dot + 1 : path;
    json_t *outer = properties_at(top, arena_format(a, "%.*s", dot ? (int)(dot - path) : 0, path), a);
    if (!json_object_get(outer, name))
        json_object_set_new(outer, name, schema_value_map(json_object(), section_meaning(path)));
    return json_object_get(json_object_get(outer, name), "properties");
}

static json_t *accuracy(struct arena *a)
{
    json_t *knobs = json_object(), *presets = json_array();
    for (int i = 0; keys_presets[i]; i++)
        json_array_append_new(presets, json_string(keys_presets[i]));
    json_array_append_new(presets, json_null());
    json_object_set_new(knobs, "preset",
                        json_pack("{s:O, s:s}", "enum", presets, "description", frame_meaning("accuracy.preset")));
    json_t *error = schema_value_quantity(&(struct schema_value_quantity){KEY_DECIBEL, -240, 0, false, NULL}, a);
    json_object_set_new(error, "description", json_string(frame_meaning("accuracy.error")));
    json_object_set_new(knobs, "error", error);
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        json_t *knob =
            schema_value_quantity(&(struct schema_value_quantity){KEY_NONE, k->low, k->high, k->whole, NULL}, a);
        json_object_set_new(knob, "description", json_string(k->meaning));
        json_object_set_new(knobs, k->name, knob);
    }
    return json_pack("{s:[{s:o}, o], s:s}", "anyOf", "enum", presets, schema_value_map(knobs, NULL), "description",
                     frame_meaning("accuracy"));
}

/* "$defs" of both: the scene's top-level maps by name, and accuracy. */
static json_t *schema_maps(struct arena *a)
{
    json_t *top = json_object();
    for (const struct key *k = keys_table; k->path; k++) {
        const char *dot = strrchr(k->path, '.');
        if (dot)
            json_object_set_new(properties_at(top, arena_format(a, "%.*s", (int)(dot - k->path), k->path), a), dot + 1,
                                schema_value_key(k, a));
    }
    json_object_set_new(top, "accuracy", accuracy(a));
    return top;
}

/* Into properties: the keys of a contact, or of the scene; maps as references. */
static void add_keys(json_t *properties, enum key_struct of, struct arena *a)
{
    for (const struct key *k = keys_table; k->path; k++) {
        size_t n = strcspn(k->path, ".");
        const char *name = arena_format(a, "%.*s", (int)n, k->path);
        if (k->of != of || json_object_get(properties, name)) continue;
        json_object_set_new(properties, name, k->path[n] ? schema_value_ref(name) : schema_value_key(k, a));
    }
}

static json_t *inputs(void)
{
    json_t *entry = schema_value_map(json_pack("{s:o, s:{s:s, s:s}}", "file", schema_value_plain("text", NULL),
                                               "sha256", "type", "string", "pattern", "^[0-9a-f]{64}$"),
                                     NULL);
    json_object_set_new(entry, "required", json_pack("[s]", "file"));
    return schema_value_list(entry, 0, 1000000, frame_meaning("inputs"));
}

json_t *schema_scene(struct arena *a)
{
    json_t *contact = json_object(), *all = json_object();
    add_keys(contact, KEY_CONTACT, a);
    add_keys(all, KEY_SCENE, a);
    add_keys(all, KEY_CONTACT, a);
    json_object_set_new(all, "accuracy", schema_value_ref("accuracy"));
    json_object_set_new(all, "contacts",
                        schema_value_list(schema_value_map(contact, NULL), 1, 1000, frame_meaning("contacts")));
    json_object_set_new(all, "include",
                        schema_value_list(schema_value_plain("text", NULL), 0, 200, frame_meaning("include")));
    json_object_set_new(all, "inputs", inputs());
    json_t *o = json_pack("{s:s, s:s, s:s, s:s, s:o, s:b, s:o}", "$schema",
                          "https://json-schema.org/draft/2020-12/schema", "title", "a scene of rasp", "description",
                          "What touches what, how it moves and how it rings; see rasp-scene(5). Which keys go "
                          "together, rasp check knows.",
                          "type", "object", "properties", all, "additionalProperties", 0, "$defs", schema_maps(a));
    return o;
}

/* The schema of designs: see schema.h and man rasp-design(5). */

/* Where a dotted path stands in $defs. */
static json_t *ref_of(const char *path, struct arena *a)
{
    const char *to = strncmp(path, "accuracy.", 9) ? "" : "accuracy/anyOf/1/properties/", *rest = *to ? path + 9 : path;
    for (const char *dot = strchr(rest, '.'); dot; rest = dot + 1, dot = strchr(rest, '.'))
        to = arena_format(a, "%s%.*s/properties/", to, (int)(dot - rest), rest);
    return schema_value_ref(arena_format(a, "%s%s", to, rest));
}

/* What may be laid over a scene: dotted keys, maps of keys, and the same of a contact by its name. */
static json_t *settings(struct arena *a)
{
    json_t *all = json_object();
    for (const char **names = keys_text_names(a); *names; names++)
        json_object_set_new(all, *names,
                            keys_find(*names) && !strchr(*names, '.') ? schema_value_key(keys_find(*names), a)
                                                                      : ref_of(*names, a));
    for (const char *const *own = (const char *const[]){"rasp", "seed", "include", "inputs", "contacts", NULL}; *own;
         own++)
        json_object_del(all, *own);
    json_t *o = schema_value_map(
        all,
        "keys laid over the scene: dotted (motion.rate: 2 Hz), or as maps; files as seen from the design's folder");
    json_object_set_new(o, "patternProperties", json_pack("{s:b}", "^contacts(\\.|$)", 1));
    return o;
}

/* A word, a key of scenes, or what contacts have. */
static json_t *factor_names(struct arena *a)
{
    json_t *keys = json_array();
    for (const char **names = keys_text_names(a); *names; names++)
        if (strchr(*names, '.')) json_array_append_new(keys, json_string(*names));
    return json_pack("{s:[{s:s}, {s:o}]}", "anyOf", "pattern", "^([A-Za-z][A-Za-z0-9_-]*|contacts\\..*)$", "enum",
                     keys);
}

static json_t *factors(struct arena *a)
{
    json_t *level = schema_value_map(
        json_pack("{s:o, s:o, s:b, s:o, s:o, s:{s:[s], s:s}}", "label",
                  schema_value_plain("text", "what it is called in names and lists"), "text",
                  schema_value_plain("text", "what it is called in the text of a trial"), "value", 1, "set",
                  schema_value_ref("set"), "base",
                  schema_value_plain("text", "a scene that takes the place of the design's"), "of", "enum",
                  "recordings", "description", "only recordings have it: no cell is crossed with it"),
        NULL);
    json_object_set_new(level, "required", json_pack("[s]", "label"));
    json_t *levels = schema_value_list(
        json_pack("{s:[{s:[s, s, s]}, o]}", "anyOf", "type", "string", "number", "boolean", level), 1, 1000000, NULL);
    json_t *o = schema_value_plain(
        "object",
        "factors, crossed, the first slowest: a dotted key with values, or a word with levels {label, set, base}");
    json_object_set_new(o, "additionalProperties", levels);
    json_object_set_new(o, "propertyNames", factor_names(a));
    return o;
}

/* Maps whose keys are factors: what `own` says, else a label of the factor, as `label` has it. */
static json_t *cells(json_t *own, json_t *label, const char *description)
{
    json_t *entry = schema_value_plain("object", NULL);
    if (json_object_get(own, "file")) json_object_set_new(entry, "required", json_pack("[s]", "file"));
    json_object_set_new(entry, "properties", own);
    json_object_set_new(entry, "additionalProperties", label);
    return schema_value_list(entry, 0, 1000000, description);
}

static json_t *level(struct arena *a)
{
    json_t *rules = json_object();
    for (const char *const *name = (const char *const[]){"peak", "rms", "lufs", "full_scale", "dbfs_at_1_pa", NULL};
         *name; name++)
        json_object_set_new(rules, *name, schema_value_key(keys_find(arena_format(a, "output.level.%s", *name)), a));
    json_t *one = schema_value_map(rules, NULL);
    json_object_set_new(one, "minProperties", json_integer(1));
    json_object_set_new(one, "maxProperties", json_integer(1));
    json_t *map = schema_value_map(json_pack("{s:O, s:o}", "common", one, "each", one), NULL);
    json_object_set_new(map, "maxProperties", json_integer(1));
    return json_pack("{s:[{s:[s, n]}, o], s:s}", "anyOf", "enum", "scene", map, "description",
                     "one gain for the whole set, as in {common: {peak: -3 dB}}, the default; a gain for each "
                     "stimulus, as in {each: {lufs: -23}}: all equally loud; or as each scene says (scene)");
}

static json_t *order(struct arena *a)
{
    json_t *map = schema_value_map(json_pack("{s:o}", "seed", schema_value_key(keys_find("seed"), a)), NULL);
    return json_pack("{s:[{s:[s, n]}, o], s:s}", "anyOf", "enum", "design", map, "description",
                     "as written (design, the default), or shuffled by {seed: NUMBER}");
}

static json_t *described(json_t *o, const char *description)
{
    json_object_set_new(o, "description", json_string(description));
    return o;
}

json_t *schema_design(struct arena *a)
{
    json_t *all = json_object(), *defs = schema_maps(a);
    json_object_set_new(all, "rasp-design",
                        described(schema_value_quantity(&(struct schema_value_quantity){KEY_NONE, 1, 1, true, NULL}, a),
                                  "version of the format of designs; this is version 1"));
    json_object_set_new(all, "title", schema_value_plain("text", "what the set is, for people"));
    json_object_set_new(all, "text",
                        schema_value_plain("text", "what a trial says, {FACTOR} standing for a level's text"));
    json_object_set_new(
        all, "base",
        schema_value_plain("text", "the scene that all stimuli build on, as seen from the design's folder"));
    json_t *seed = schema_value_key(keys_find("seed"), a);
    json_object_set_new(seed, "description",
                        json_string("seed of the set: a stimulus's own is made of it and of its replicate, so that "
                                    "cells differ in nothing else; default: 1"));
    json_object_set_new(seed, "default", json_integer(1));
    json_object_set_new(all, "seed", seed);
    json_object_set_new(all, "set", schema_value_ref("set"));
    json_object_set_new(all, "factors", factors(a));
    json_object_set_new(
        all, "exclude",
        cells(json_object(),
              json_pack("{s:[o, o]}", "anyOf", schema_value_plain("text", NULL),
                        schema_value_list(schema_value_plain("text", NULL), 0, 1000000, NULL)),
              "cells that are left out: those that match all pairs of FACTOR: LABEL, or one of its LABELS"));
    json_object_set_new(
        all, "cells",
        cells(json_object(), schema_value_plain("text", NULL), "the cells, listed, in place of crossing the factors"));
    json_object_set_new(all, "recordings",
                        cells(json_pack("{s:o, s:o}", "file", schema_value_plain("text", "a WAV"), "name",
                                        schema_value_plain("text", NULL)),
                              schema_value_plain("text", NULL), "supplied sounds as cells of their own"));
    json_object_set_new(all, "order", order(a));
    const struct schema_value_quantity length = {KEY_TIME, 0, 0, false, "longest|own"},
                                       replicates = {KEY_NONE, 1, 1000000, true, NULL};
    json_object_set_new(all, "replicates",
                        described(schema_value_quantity(&replicates, a),
                                  "takes of each cell, which differ in their noise; default: 1"));
    json_object_set_new(
        all, "independent",
        schema_value_list(schema_value_plain("text", NULL), 0, 1000, "factors whose levels have noise of their own"));
    json_object_set_new(
        all, "name",
        schema_value_plain("text", "names of files: {FACTOR}, {replicate}, {order}, {cell} between other characters"));
    json_object_set_new(all, "level", level(a));
    json_object_set_new(
        all, "length",
        described(
            schema_value_quantity(&length, a),
            "how long each sound is: as the longest of the set (longest, the default), as by itself (own), or a time"));
    json_object_set_new(defs, "set", settings(a));
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:b, s:[s], s:o}", "$schema",
                     "https://json-schema.org/draft/2020-12/schema", "title", "a design of rasp", "description",
                     "Which stimuli a set has; see rasp-design(5). What goes together, rasp batch --dry-run knows.",
                     "type", "object", "properties", all, "additionalProperties", 0, "required", "rasp-design", "$defs",
                     defs);
}
