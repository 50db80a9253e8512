/* The schema of scenes: see schema.h. Dotted paths become maps in maps; those at the top stand in $defs, as one contact's keys may stand at the top level or in an
   entry of contacts. */
#include "cmd/schema.h"

#include <string.h>

#include "cmd/schema_value.h"
#include "scene/keys_text.h"

static const char *frame_meaning(const char *path)
{
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        if (!strcmp(p->path, path))
            return p->meaning;
    return NULL;
}

static const char *section_meaning(const char *path)
{
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (!strcmp(s->path, path))
            return s->meaning;
    return NULL;
}

/* The properties of the map `path`, under those of the top; maps are made as they are needed. */
static json_t *properties_at(json_t *top, const char *path, struct arena *a)
{
    if (!*path)
        return top;
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
    json_object_set_new(knobs, "preset", json_pack("{s:O, s:s}", "enum", presets, "description", frame_meaning("accuracy.preset")));
    json_t *error = schema_value_quantity(&(struct schema_value_quantity){KEY_DECIBEL, -240, 0, false, NULL}, a);
    json_object_set_new(error, "description", json_string(frame_meaning("accuracy.error")));
    json_object_set_new(knobs, "error", error);
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        json_t *knob = schema_value_quantity(&(struct schema_value_quantity){KEY_NONE, k->low, k->high, k->whole, NULL}, a);
        json_object_set_new(knob, "description", json_string(k->meaning));
        json_object_set_new(knobs, k->name, knob);
    }
    return json_pack("{s:[{s:o}, o], s:s}", "anyOf", "enum", presets, schema_value_map(knobs, NULL), "description", frame_meaning("accuracy"));
}

json_t *schema_maps(struct arena *a)
{
    json_t *top = json_object();
    for (const struct key *k = keys_table; k->path; k++) {
        const char *dot = strrchr(k->path, '.');
        if (dot)
            json_object_set_new(properties_at(top, arena_format(a, "%.*s", (int)(dot - k->path), k->path), a), dot + 1, schema_value_key(k, a));
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
        if (k->of != of || json_object_get(properties, name))
            continue;
        json_object_set_new(properties, name, k->path[n] ? schema_value_ref(name) : schema_value_key(k, a));
    }
}

static json_t *inputs(void)
{
    json_t *entry = schema_value_map(json_pack("{s:o, s:{s:s, s:s}}", "file", schema_value_plain("text", NULL), "sha256", "type", "string", "pattern", "^[0-9a-f]{64}$"), NULL);
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
    json_object_set_new(all, "contacts", schema_value_list(schema_value_map(contact, NULL), 1, 1000, frame_meaning("contacts")));
    json_object_set_new(all, "include", schema_value_list(schema_value_plain("text", NULL), 0, 200, frame_meaning("include")));
    json_object_set_new(all, "inputs", inputs());
    json_t *o = json_pack("{s:s, s:s, s:s, s:s, s:o, s:b, s:o}", "$schema", "https://json-schema.org/draft/2020-12/schema", "title",
                          "a scene of rasp", "description", "What touches what, how it moves and how it rings; see rasp-scene(5). Which keys go together, rasp check knows.",
                          "type", "object", "properties", all, "additionalProperties", 0, "$defs", schema_maps(a));
    return o;
}
