/* The schema of designs: see schema.h and man rasp-design(5). */
#include <string.h>

#include "cmd/schema.h"
#include "cmd/schema_value.h"
#include "scene/keys_text.h"

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
        json_object_set_new(all, *names, keys_find(*names) && !strchr(*names, '.') ? schema_value_key(keys_find(*names), a) : ref_of(*names, a));
    for (const char *const *own = (const char *const[]){"rasp", "seed", "include", "inputs", "contacts", NULL}; *own; own++)
        json_object_del(all, *own);
    json_t *o = schema_value_map(all, "keys laid over the scene: dotted (motion.rate: 2 Hz), or as maps; files as seen from the design's folder");
    json_object_set_new(o, "patternProperties", json_pack("{s:b}", "^contacts(\\.|$)", 1));
    return o;
}

/* A word, a key of scenes, or what contacts have. */
static json_t *factor_names(struct arena *a)
{
    json_t *keys = json_array();
    for (const char **names = keys_text_names(a); *names; names++)
        if (strchr(*names, '.'))
            json_array_append_new(keys, json_string(*names));
    return json_pack("{s:[{s:s}, {s:o}]}", "anyOf", "pattern", "^([A-Za-z][A-Za-z0-9_-]*|contacts\\..*)$", "enum", keys);
}

static json_t *factors(struct arena *a)
{
    json_t *level = schema_value_map(json_pack("{s:o, s:o, s:b, s:o, s:o, s:{s:[s], s:s}}", "label", schema_value_plain("text", "what it is called in names and lists"), "text", schema_value_plain("text", "what it is called in the text of a trial"), "value", 1, "set", schema_value_ref("set"),
                                         "base", schema_value_plain("text", "a scene that takes the place of the design's"), "of", "enum", "recordings", "description", "only recordings have it: no cell is crossed with it"),
                               NULL);
    json_object_set_new(level, "required", json_pack("[s]", "label"));
    json_t *levels = schema_value_list(json_pack("{s:[{s:[s, s, s]}, o]}", "anyOf", "type", "string", "number", "boolean", level), 1, 1000000, NULL);
    json_t *o = schema_value_plain("object", "factors, crossed, the first slowest: a dotted key with values, or a word with levels {label, set, base}");
    json_object_set_new(o, "additionalProperties", levels);
    json_object_set_new(o, "propertyNames", factor_names(a));
    return o;
}

/* One label, or several. */
static json_t *labels(void)
{
    return json_pack("{s:[o, o]}", "anyOf", schema_value_plain("text", NULL), schema_value_list(schema_value_plain("text", NULL), 0, 1000000, NULL));
}

/* Maps whose keys are factors: what `own` says, else a label of the factor, as `label` has it. */
static json_t *cells(json_t *own, json_t *label, const char *description)
{
    json_t *entry = schema_value_plain("object", NULL);
    if (json_object_get(own, "file"))
        json_object_set_new(entry, "required", json_pack("[s]", "file"));
    json_object_set_new(entry, "properties", own);
    json_object_set_new(entry, "additionalProperties", label);
    return schema_value_list(entry, 0, 1000000, description);
}

static json_t *level(struct arena *a)
{
    json_t *rules = json_object();
    for (const char *const *name = (const char *const[]){"peak", "rms", "lufs", "full_scale", "dbfs_at_1_pa", NULL}; *name; name++)
        json_object_set_new(rules, *name, schema_value_key(keys_find(arena_format(a, "output.level.%s", *name)), a));
    json_t *one = schema_value_map(rules, NULL);
    json_object_set_new(one, "minProperties", json_integer(1));
    json_object_set_new(one, "maxProperties", json_integer(1));
    json_t *map = schema_value_map(json_pack("{s:O, s:o}", "common", one, "each", one), NULL);
    json_object_set_new(map, "maxProperties", json_integer(1));
    return json_pack("{s:[{s:[s, n]}, o], s:s}", "anyOf", "enum", "scene", map, "description",
                     "one gain for the whole set, as in {common: {peak: -3 dB}}, the default; a gain for each stimulus, as in {each: {lufs: -23}}: all equally loud; or as each scene says (scene)");
}

static json_t *order(struct arena *a)
{
    json_t *map = schema_value_map(json_pack("{s:o}", "seed", schema_value_key(keys_find("seed"), a)), NULL);
    return json_pack("{s:[{s:[s, n]}, o], s:s}", "anyOf", "enum", "design", map, "description", "as written (design, the default), or shuffled by {seed: NUMBER}");
}

static json_t *described(json_t *o, const char *description)
{
    json_object_set_new(o, "description", json_string(description));
    return o;
}

static void add_rest(json_t *all, struct arena *a)
{
    const struct schema_value_quantity length = {KEY_TIME, 0, 0, false, "longest|own"}, replicates = {KEY_NONE, 1, 1000000, true, NULL};
    json_object_set_new(all, "replicates", described(schema_value_quantity(&replicates, a), "takes of each cell, which differ in their noise; default: 1"));
    json_object_set_new(all, "independent", schema_value_list(schema_value_plain("text", NULL), 0, 1000, "factors whose levels have noise of their own"));
    json_object_set_new(all, "name", schema_value_plain("text", "names of files: {FACTOR}, {replicate}, {order}, {cell} between other characters"));
    json_object_set_new(all, "level", level(a));
    json_object_set_new(all, "length", described(schema_value_quantity(&length, a), "how long each sound is: as the longest of the set (longest, the default), as by itself (own), or a time"));
}

json_t *schema_design(struct arena *a)
{
    json_t *all = json_object(), *defs = schema_maps(a);
    json_object_set_new(all, "rasp-design", described(schema_value_quantity(&(struct schema_value_quantity){KEY_NONE, 1, 1, true, NULL}, a), "version of the format of designs; this is version 1"));
    json_object_set_new(all, "title", schema_value_plain("text", "what the set is, for people"));
    json_object_set_new(all, "text", schema_value_plain("text", "what a trial says, {FACTOR} standing for a level's text"));
    json_object_set_new(all, "base", schema_value_plain("text", "the scene that all stimuli build on, as seen from the design's folder"));
    json_t *seed = schema_value_key(keys_find("seed"), a);
    json_object_set_new(seed, "description", json_string("seed of the set: a stimulus's own is made of it and of its replicate, so that cells differ in nothing else; default: 1"));
    json_object_set_new(seed, "default", json_integer(1));
    json_object_set_new(all, "seed", seed);
    json_object_set_new(all, "set", schema_value_ref("set"));
    json_object_set_new(all, "factors", factors(a));
    json_object_set_new(all, "exclude", cells(json_object(), labels(), "cells that are left out: those that match all pairs of FACTOR: LABEL, or one of its LABELS"));
    json_object_set_new(all, "cells", cells(json_object(), schema_value_plain("text", NULL), "the cells, listed, in place of crossing the factors"));
    json_object_set_new(all, "recordings", cells(json_pack("{s:o, s:o}", "file", schema_value_plain("text", "a WAV"), "name", schema_value_plain("text", NULL)), schema_value_plain("text", NULL), "supplied sounds as cells of their own"));
    json_object_set_new(all, "order", order(a));
    add_rest(all, a);
    json_object_set_new(defs, "set", settings(a));
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:b, s:[s], s:o}", "$schema", "https://json-schema.org/draft/2020-12/schema", "title", "a design of rasp", "description",
                     "Which stimuli a set has; see rasp-design(5). What goes together, rasp batch --dry-run knows.", "type", "object", "properties", all,
                     "additionalProperties", 0, "required", "rasp-design", "$defs", defs);
}
