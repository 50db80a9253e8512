/* See design_changes.h. A value is read here into a struct that nobody looks at, so that what is wrong with it is told once, with the design's line,
   and not for each of the scenes that it is laid over. */
#include "batch/design_changes.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"
#include "scene/scene_values.h"

const struct key *design_changes_key(const char *path)
{
    return keys_find(keys_text_plain(path));
}

/* ------------------------------------------------------------------ paths */

static bool is_one_of(const char *path, const char *const *names)
{
    for (; *names; names++)
        if (strcmp(*names, path) == 0)
            return true;
    return false;
}

const char *design_changes_near(const struct design_reading *r, const char *word)
{
    const char *found = NULL;
    for (const char *const *name = r->keys; *name; name++) {
        const char *dot = strrchr(*name, '.');
        if (dot && strcmp(dot + 1, word) == 0)
            found = found ? arena_format(r->arena, "%s or %s", found, *name) : *name;
    }
    return found ? found : text_nearest(word, r->keys);
}

bool design_changes_known(const struct design_reading *r, const struct yaml_node *key)
{
    const char *plain = keys_text_plain(key->text);
    if (is_one_of(plain, r->keys))
        return true;
    const char *near = design_changes_near(r, plain);
    return diag_add(r->yaml->diag, key->at, near ? arena_format(r->arena, "did you mean %s?", near) : "rasp explain lists every key of a scene",
                              "'%s' is no key of scenes", diag_shown(r->yaml->diag, key->text));
}

static bool starts(const char *path, const char *map)
{
    size_t n = strlen(map);
    return strncmp(path, map, n) == 0 && (!path[n] || path[n] == '.');
}

/* A factor's key is looked at for each of its levels. */
static bool is_told(const struct diag *d, const struct diag_place *at)
{
    for (int i = 0; i < d->n && i < DIAG_KEPT; i++)
        if (d->errors[i].at.source == at->source && d->errors[i].at.line == at->line && d->errors[i].at.column == at->column)
            return true;
    return false;
}

/* Keys that are the design's to say. */
static bool reserved(const struct design_reading *r, const struct yaml_node *key)
{
    const char *cure = NULL;
    const struct design *d = r->design;
    if (strcmp(key->text, "seed") == 0)
        cure = "write seed: at the design's top level: each stimulus's seed is made from it; replicates: gives several";
    else if (strcmp(key->text, "include") == 0)
        cure = "write include: into the base scene";
    else if (strcmp(key->text, "rasp") == 0)
        cure = "remove it";
    else if (starts(key->text, "output.level") && d->level_rule != DESIGN_LEVEL_SCENE)
        cure = "the design has one level rule for the set (level:, by default {common: {peak: -3 dB}}); write level: scene to set levels here";
    else if (starts(key->text, "output.duration") && d->length_rule != DESIGN_LENGTH_OWN)
        cure = "the design has one length rule for the set (length:, by default longest); write length: own to set durations here";
    return cure && (is_told(r->yaml->diag, &key->at) || !diag_add(r->yaml->diag, key->at, cure, "%s cannot be set here", key->text));
}

/* ------------------------------------------------------------------ values */

/* "contacts.rod." */
static const char *prefix_of(const char *path, struct arena *a)
{
    return arena_format(a, "%.*s", (int)(keys_text_plain(path) - path), path);
}

static bool value_good(const struct design_reading *r, const char *path, const struct yaml_node *value)
{
    const struct key *k = design_changes_key(path);
    size_t size = sizeof(struct scene) > sizeof(struct contact) ? sizeof(struct scene) : sizeof(struct contact);
    if (!k || yaml_null(value))
        return true;
    struct arena *own = arena_open(); /* some kilobytes, for each of perhaps thousands of levels */
    struct scene_part part = {r->yaml, r->root, prefix_of(path, own), k->of, arena_take(own, 1, size)};
    bool good = scene_values_read(&part, k, value);
    arena_close(own);
    return good;
}

static bool leaf_add(const struct design_reading *r, struct design_change *c, const struct yaml_node *key, const struct yaml_node *value)
{
    if (reserved(r, key) || !design_changes_known(r, key) || !value_good(r, key->text, value))
        return false;
    struct yaml_node **path = scene_layer_path(r->yaml, key);
    if (!path)
        return false;
    if (c->n == c->room) {
        c->room = 2 * c->room + 4;
        struct scene_layer_key *more = ARENA_TAKE(r->arena, struct scene_layer_key, c->room);
        if (c->n > 0)
            memcpy(more, c->keys, (size_t)c->n * sizeof *more);
        c->keys = more;
    }
    c->keys[c->n++] = (struct scene_layer_key){path, value};
    return true;
}

bool design_changes_add(const struct design_reading *r, struct design_change *c, const struct yaml_node *key, const struct yaml_node *value)
{
    bool good = true;
    if (value->kind != YAML_MAP || value->n == 0)
        return leaf_add(r, c, key, value);
    for (const struct yaml_node *item = value->first; item; item = item->next) {
        struct yaml_node *path = yaml_make(r->yaml, YAML_SCALAR, item->key->at, arena_format(r->arena, "%s.%s", key->text, item->key->text));
        path->plain = false; /* its place is that of the last part */
        good = design_changes_add(r, c, path, item) && good;
    }
    return good;
}

bool design_changes_map(const struct design_reading *r, struct design_change *c, const struct yaml_node *map)
{
    bool good = true;
    if (map->kind != YAML_MAP)
        return design_reading_must(r, map, "set", "a map of keys of a scene", "write for instance: set: {motion.rate: 2 Hz}");
    for (const struct yaml_node *item = map->first; item; item = item->next)
        good = design_changes_add(r, c, item->key, item) && good;
    return good;
}

/* ------------------------------------------------------------------ texts */

static const char *scalar_text(const struct yaml_node *node, bool alone, struct arena *a)
{
    static const char safe[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./+-^() ";
    bool plain = *node->text && node->plain && (alone ? !strchr("[{\"'", node->text[0]) : node->text[strspn(node->text, safe)] == '\0');
    return plain ? node->text : keys_yaml_quoted(node->text, a);
}

static void put_text(FILE *f, const struct yaml_node *node, bool alone, struct arena *a)
{
    if (node->kind == YAML_SCALAR) {
        fputs(scalar_text(node, alone, a), f);
        return;
    }
    fputc(node->kind == YAML_MAP ? '{' : '[', f);
    for (const struct yaml_node *item = node->first; item; item = item->next) {
        if (node->kind == YAML_MAP)
            fprintf(f, "%s: ", scalar_text(item->key, false, a));
        put_text(f, item, false, a);
        fputs(item->next ? ", " : "", f);
    }
    fputc(node->kind == YAML_MAP ? '}' : ']', f);
}

const char *design_changes_text(const struct yaml_node *value, struct arena *a)
{
    char *memory = NULL;
    size_t size = 0;
    FILE *f = memory_stream(&memory, &size);
    put_text(f, value, true, a);
    memory_stream_end(f, &memory);
    const char *text = arena_text(a, memory);
    free(memory);
    return text;
}

static const char *path_text(struct yaml_node *const *path, struct arena *a)
{
    const char *all = "";
    for (; *path; path++)
        all = arena_format(a, "%s%s%s", all, *all ? "." : "", (*path)->text);
    return all;
}

const char **design_changes_texts(const struct design_change *c, struct arena *a)
{
    const char **all = ARENA_TAKE(a, const char *, c->n + 1);
    for (int i = 0; i < c->n; i++)
        all[i] = arena_format(a, "%s=%s", path_text(c->keys[i].path, a), design_changes_text(c->keys[i].value, a));
    return all;
}
