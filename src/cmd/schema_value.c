/* See schema_value.h. */
#include "cmd/schema_value.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "output/force_table.h"
#include "scene/keys_text.h"
#include "scene/units_table.h"

static const char number_pattern[] = "[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";

static void describe(json_t *o, const char *description)
{
    if (description)
        json_object_set_new(o, "description", json_string(description));
}

json_t *schema_value_plain(const char *type, const char *description)
{
    json_t *o = json_object();
    json_object_set_new(o, "type", strcmp(type, "text") ? json_pack("[s, s]", type, "null") : json_pack("[s, s, s, s]", "string", "number", "boolean", "null"));
    describe(o, description);
    return o;
}

json_t *schema_value_list(json_t *items, int least, int most, const char *description)
{
    json_t *o = schema_value_plain("array", description);
    json_object_set_new(o, "items", items);
    json_object_set_new(o, "minItems", json_integer(least));
    json_object_set_new(o, "maxItems", json_integer(most));
    return o;
}

json_t *schema_value_map(json_t *properties, const char *description)
{
    json_t *o = schema_value_plain("object", description);
    json_object_set_new(o, "properties", properties);
    json_object_set_new(o, "additionalProperties", json_false());
    return o;
}

json_t *schema_value_ref(const char *name)
{
    return json_pack("{s:o}", "$ref", json_sprintf("#/$defs/%s", name));
}

/* A number as JSON writes it: 44100, not 44100.0. */
static json_t *number(double x)
{
    return x == floor(x) && fabs(x) < 1e15 ? json_integer((json_int_t)x) : json_real(x);
}

json_t *schema_value_quantity(const struct schema_value_quantity *q, struct arena *a)
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
    return schema_value_quantity(&(struct schema_value_quantity){k->dimension, k->low, k->high, whole, k->type == KEY_TIME_OR_AUTO ? "auto" : NULL}, a);
}

static json_t *words(const struct key *k)
{
    json_t *o = json_object(), *all = json_array();
    for (const struct choice *c = k->choices; c->word; c++)
        json_array_append_new(all, json_string(c->word));
    json_array_append_new(all, json_null());
    json_object_set_new(o, "enum", all);
    return o;
}

static json_t *names(const struct key *k)
{
    json_t *items = json_object(), *all = json_array();
    for (const struct table_column *t = force_table_columns; !strcmp(k->path, "output.diagnostics.columns") && t->name; t++)
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
    case KEY_TIME_OR_AUTO: return of_dimension(k, a);
    case KEY_SEED: return seed();
    case KEY_TEXT:
    case KEY_FILE: return schema_value_plain("text", NULL);
    case KEY_POINT:
    case KEY_RANGE: return schema_value_list(of_dimension(k, a), 2, 2, NULL);
    case KEY_POINTS: return schema_value_list(schema_value_list(of_dimension(k, a), 2, 2, NULL), 2, 10000, NULL);
    case KEY_PLACES: return schema_value_list(schema_value_list(of_dimension(k, a), 3, 3, NULL), 1, 64, NULL);
    case KEY_LIST: return names(k);
    case KEY_CHOICE: return words(k);
    }
    return json_object();
}

static const char *sentence(const char *text, struct arena *a)
{
    char *copy = arena_text(a, text);
    if (copy[0] >= 'a' && copy[0] <= 'z')
        copy[0] = (char)(copy[0] - 'a' + 'A');
    return arena_format(a, "%s.", copy);
}

/* The meaning, the type where it is a quantity, range, default, when it applies, and what the words mean. */
static const char *description(const struct key *k, struct arena *a)
{
    const char *range = keys_text_range(k, a), *when = keys_text_applies(k, a), *all = sentence(k->meaning, a);
    if (!k->choices)
        all = arena_format(a, "%s Type: %s.", all, keys_text_type(k));
    if (range)
        all = arena_format(a, "%s Range: %s.", all, range);
    if (!k->standard || *k->standard)
        all = arena_format(a, "%s Default: %s.", all, k->standard ? k->standard : "none, it must be given");
    if (when)
        all = arena_format(a, "%s Only %s.", all, when);
    for (const struct choice *c = k->choices; c && c->word; c++)
        all = arena_format(a, "%s\n- %s: %s", all, c->word, c->meaning);
    return all;
}

json_t *schema_value_key(const struct key *k, struct arena *a)
{
    json_t *o = typed(k, a);
    describe(o, description(k, a));
    double x;
    if (k->standard && *k->standard && k->standard[0] != '[')
        json_object_set_new(o, "default", text_double(k->standard, &x) ? number(x) : json_string(k->standard));
    return o;
}
