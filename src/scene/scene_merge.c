/* Includes: see scene_merge.h. `accuracy: high` counts as {preset: high} when knobs are laid over it; a preset laid
   over knobs replaces them all. */
#include "scene/scene_merge.h"

#include <string.h>
#include <sys/stat.h>

#include "file/bytes.h"
#include "file/yaml.h"

enum { DEEPEST = 16, FILES_MAX = 200 };

struct chain { /* the files that are being included, innermost first */
    const struct chain *outer;
    const struct diag_source *source;
    struct stat status;
    bool on_disk;
    int depth;
};

const char *scene_merge_path(struct yaml *y, const struct diag_source *source, const char *name)
{
    const char *slash = source->option || source->made || name[0] == '/' || bytes_piped(source->name)
                            ? NULL
                            : strrchr(source->name, '/');
    return slash ? arena_format(y->arena, "%.*s/%s", (int)(slash - source->name), source->name, name) : name;
}

/* ------------------------------------------------------------------ merging */

void scene_merge_replace(struct yaml_node *in, struct yaml_node *old, struct yaml_node *value)
{
    struct yaml_node **link = &in->first;
    while (*link != old)
        link = &(*link)->next;
    value->next = old->next;
    *link = value;
    if (in->last == old) in->last = value;
}

/* `accuracy: high` as {preset: high}. */
static struct yaml_node *preset_map(struct yaml *y, struct yaml_node *word)
{
    struct yaml_node *map = yaml_make(y, YAML_MAP, word->at, NULL);
    struct yaml_node *preset = yaml_make(y, YAML_SCALAR, word->at, word->text);
    preset->plain = word->plain;
    yaml_append(map, yaml_make(y, YAML_SCALAR, word->key->at, "preset"), preset);
    map->key = word->key;
    return map;
}

struct yaml_node *scene_merge_opened(struct yaml *y, struct yaml_node *map, struct yaml_node *item)
{
    if (item->kind != YAML_SCALAR || yaml_null(item) || !item->key || strcmp(item->key->text, "accuracy") != 0)
        return item;
    struct yaml_node *made = preset_map(y, item);
    scene_merge_replace(map, item, made);
    return made;
}

static void merge(struct yaml *y, struct yaml_node *under, struct yaml_node *over)
{
    for (struct yaml_node *item = over->first, *next; item; item = next) {
        next = item->next;
        scene_merge_put(y, under, item->key, item);
    }
}

void scene_merge_put(struct yaml *y, struct yaml_node *map, struct yaml_node *key, struct yaml_node *value)
{
    struct yaml_node *old = yaml_get(map, key->text);
    if (!old) {
        yaml_append(map, key, value);
        return;
    }
    if (value->kind == YAML_MAP) old = scene_merge_opened(y, map, old);
    if (value->kind == YAML_MAP && old->kind == YAML_MAP) {
        old->key = key;
        merge(y, old, value);
    } else {
        scene_merge_replace(map, old, value);
        value->key = key;
    }
}

void scene_merge_under(struct yaml *y, struct yaml_node *map, struct yaml_node *base)
{
    merge(y, base, map);
    map->first = base->first;
    map->last = base->last;
    map->n = base->n;
}

void scene_merge_drop_nulls(struct yaml_node *node)
{
    struct yaml_node *last = NULL, **link = &node->first;
    while (*link) {
        struct yaml_node *item = *link;
        if (node->kind == YAML_MAP && yaml_null(item)) {
            *link = item->next;
            node->n--;
            continue;
        }
        scene_merge_drop_nulls(item);
        last = item;
        link = &item->next;
    }
    node->last = last;
}

/* ------------------------------------------------------------------ includes */

static struct yaml_node *read_all(struct yaml *y, const struct chain *chain);

static bool same_file(const struct chain *a, const struct stat *b)
{
    return a->on_disk && a->status.st_dev == b->st_dev && a->status.st_ino == b->st_ino;
}

static const char *cycle(struct yaml *y, const struct chain *chain, const struct stat *status)
{
    for (const struct chain *c = chain; c; c = c->outer)
        if (same_file(c, status)) return arena_format(y->arena, "'%s' includes itself", c->source->name);
    return NULL;
}

static struct yaml_node *include_one(struct yaml *y, const struct chain *chain, const struct yaml_node *entry)
{
    struct chain inner = {.outer = chain, .depth = chain->depth + 1};
    if (entry->kind != YAML_SCALAR || !*entry->text) {
        diag_add(y->diag, entry->at, "write: include: [materials.yaml]", "an entry of include must be a file name");
        return NULL;
    }
    const char *file = scene_merge_path(y, entry->at.source, entry->text);
    inner.on_disk = stat(file, &inner.status) == 0;
    const char *circle = inner.on_disk ? cycle(y, chain, &inner.status) : NULL;
    if (circle || inner.depth > DEEPEST || y->sources >= FILES_MAX) {
        diag_add(y->diag, entry->at, "remove this include", "%s", circle ? circle : "too many includes");
        return NULL;
    }
    inner.source = yaml_bytes_read(y, file, entry->at);
    return inner.source ? read_all(y, &inner) : NULL;
}

/* Merges the files that `include` lists; false: one of them is in error. One that is not there (y->missing) hides no
 * errors of the others. */
static bool includes(struct yaml *y, const struct chain *chain, struct yaml_node *list, struct yaml_node *into)
{
    bool good = true;
    if (list->kind != YAML_LIST) {
        diag_add(y->diag, list->at, "write: include: [materials.yaml]", "include must be a list of file names");
        return false;
    }
    for (const struct yaml_node *entry = list->first; entry; entry = entry->next) {
        struct yaml_node *tree = include_one(y, chain, entry);
        if (tree) merge(y, into, tree);
        good = good && tree;
    }
    return good;
}

static struct yaml_node *read_all(struct yaml *y, const struct chain *chain)
{
    struct yaml_node *own = yaml_parse(y, chain->source);
    if (!own) return NULL;
    if (own->kind != YAML_MAP) {
        diag_add(y->diag, own->at, "write keys with values, such as: title: my scene", "a scene must be a map of keys");
        return NULL;
    }
    struct yaml_node *list = yaml_get(own, "include");
    if (!list || yaml_null(list)) return own;
    struct yaml_node *whole = yaml_make(y, YAML_MAP, own->at, NULL);
    bool good = includes(y, chain, list, whole);
    merge(y, whole, own);
    return good || y->missing ? whole : NULL;
}

struct yaml_node *scene_merge_text(struct yaml *y, const struct diag_source *source)
{
    struct chain chain = {.source = source};
    chain.on_disk = stat(source->name, &chain.status) == 0;
    return read_all(y, &chain);
}
