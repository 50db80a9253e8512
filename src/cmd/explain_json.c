/* See explain_json.h. Ranges are in SI units; null stands for what there is none of: unit, range, default ("" would be a text), condition, words. */
#include "cmd/explain_json.h"

#include <string.h>

#include "scene/keys_text.h"

static json_t *text_or_null(const char *s)
{
    return s && *s ? json_string(s) : json_null();
}

static json_t *words(const struct choice *c)
{
    if (!c)
        return json_null();
    json_t *all = json_array();
    for (; c->word; c++)
        json_array_append_new(all, json_pack("{s:s, s:s}", "word", c->word, "meaning", c->meaning));
    return all;
}

static json_t *key(const struct key *k)
{
    struct arena *a = arena_open();
    bool range = keys_text_range(k, a);
    json_t *o = json_pack("{s:s, s:s, s:s, s:o, s:o, s:o, s:b, s:o, s:o, s:o}", "path", k->path, "meaning", k->meaning, "type",
                          k->type == KEY_CHOICE ? "word" : keys_text_type(k), "unit", text_or_null(keys_text_unit(k->dimension)), "low",
                          range ? json_real(k->low) : json_null(), "high", range ? json_real(k->high) : json_null(), "must_be_given", !k->standard, "default",
                          text_or_null(k->standard), "only", text_or_null(keys_text_applies(k, a)), "words", words(k->choices));
    arena_close(a);
    return o;
}

static json_t *knob(const struct key_knob *k)
{
    json_t *presets = json_object();
    for (int i = 0; keys_presets[i]; i++)
        json_object_set_new(presets, keys_presets[i], json_real(k->preset[i]));
    return json_pack("{s:o, s:s, s:s, s:f, s:f, s:o}", "path", json_sprintf("accuracy.%s", k->name), "meaning", k->meaning, "type", k->whole ? "whole number" : "number",
                     "low", k->low, "high", k->high, "presets", presets);
}

/* Is it the path itself, or in its map? */
static bool within(const char *path, const char *map)
{
    size_t n = strlen(map);
    return !n || (!strncmp(path, map, n) && (!path[n] || path[n] == '.'));
}

json_t *explain_json(const char *path)
{
    const char *name = strncmp(path, "accuracy.", 9) ? path : path + 9;
    bool all = !*path || !strcmp(path, "accuracy");
    json_t *rows = json_array();
    for (const struct key *k = keys_table; k->path; k++)
        if (within(k->path, path))
            json_array_append_new(rows, key(k));
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        if (all || !strcmp(k->name, name))
            json_array_append_new(rows, knob(k));
    return rows;
}
