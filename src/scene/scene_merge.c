/* A scene's tree: see scene_merge.h.
   `accuracy: high` counts as {preset: high} when knobs are laid over it; a preset laid
   over knobs replaces them all. */
#include "scene/scene_merge.h"

#include <string.h>
#include <sys/stat.h>

#include "base/text.h"
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

/* Puts a value where an old one stands, in a map or a list. */
static void replace(struct yaml_node *in, struct yaml_node *old, struct yaml_node *value)
{
    struct yaml_node **link = &in->first;
    while (*link != old)
        link = &(*link)->next;
    value->next = old->next;
    *link = value;
    if (in->last == old) in->last = value;
}

/* An entry of the map as a map, if it has such a form: `accuracy: high` becomes {preset: high}. */
static struct yaml_node *opened(struct yaml *y, struct yaml_node *map, struct yaml_node *item)
{
    if (item->kind != YAML_SCALAR || yaml_null(item) || !item->key || strcmp(item->key->text, "accuracy") != 0)
        return item;
    struct yaml_node *made = yaml_make(y, YAML_MAP, item->at, NULL),
                     *preset = yaml_make(y, YAML_SCALAR, item->at, item->text);
    preset->plain = item->plain;
    yaml_append(made, yaml_make(y, YAML_SCALAR, item->key->at, "preset"), preset);
    made->key = item->key;
    replace(map, item, made);
    return made;
}

static void put(struct yaml *y, struct yaml_node *map, struct yaml_node *key, struct yaml_node *value);

static void merge(struct yaml *y, struct yaml_node *under, struct yaml_node *over)
{
    for (struct yaml_node *item = over->first, *next; item; item = next) {
        next = item->next;
        put(y, under, item->key, item);
    }
}

/* Lays key: value over a map, as a file that includes the map's would. */
static void put(struct yaml *y, struct yaml_node *map, struct yaml_node *key, struct yaml_node *value)
{
    struct yaml_node *old = yaml_get(map, key->text);
    if (!old) {
        yaml_append(map, key, value);
        return;
    }
    if (value->kind == YAML_MAP) old = opened(y, map, old);
    if (value->kind == YAML_MAP && old->kind == YAML_MAP) {
        old->key = key;
        merge(y, old, value);
    } else {
        replace(map, old, value);
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

static struct yaml_node *include_one(struct yaml *y, const struct chain *chain, const struct yaml_node *entry)
{
    struct chain inner = {.outer = chain, .depth = chain->depth + 1};
    if (entry->kind != YAML_SCALAR || !*entry->text) {
        diag_add(y->diag, entry->at, "write: include: [materials.yaml]", "an entry of include must be a file name");
        return NULL;
    }
    const char *file = scene_merge_path(y, entry->at.source, entry->text);
    inner.on_disk = stat(file, &inner.status) == 0;
    const char *circle = NULL;
    for (const struct chain *c = chain; c && inner.on_disk && !circle; c = c->outer)
        if (c->on_disk && c->status.st_dev == inner.status.st_dev && c->status.st_ino == inner.status.st_ino)
            circle = arena_format(y->arena, "'%s' includes itself", c->source->name);
    if (circle || inner.depth > DEEPEST || y->sources >= FILES_MAX) {
        diag_add(y->diag, entry->at, "remove this include", "%s", circle ? circle : "too many includes");
        return NULL;
    }
    inner.source = yaml_bytes_read(y, file, entry->at);
    return inner.source ? read_all(y, &inner) : NULL;
}

/* With what it includes. An included file that is not there (y->missing) hides no errors of the others. */
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
    bool good = list->kind == YAML_LIST;
    if (!good) diag_add(y->diag, list->at, "write: include: [materials.yaml]", "include must be a list of file names");
    for (const struct yaml_node *entry = good ? list->first : NULL; entry; entry = entry->next) {
        struct yaml_node *tree = include_one(y, chain, entry);
        if (tree) merge(y, whole, tree);
        good = good && tree;
    }
    merge(y, whole, own);
    return good || y->missing ? whole : NULL;
}

struct yaml_node *scene_merge_text(struct yaml *y, const struct diag_source *source)
{
    struct chain chain = {.source = source};
    chain.on_disk = stat(source->name, &chain.status) == 0;
    return read_all(y, &chain);
}

/* ------------------------------------------------------------------ what the command line sets */

/* The entry of a list: by number from 0, or by its name. */
static struct yaml_node *list_entry(struct yaml *y, struct yaml_node *list, const struct yaml_node *key)
{
    const char **names = ARENA_TAKE(y->arena, const char *, list->n + 1);
    int index = -1, i = 0, n = 0;
    text_int(key->text, 0, list->n - 1, &index);
    for (struct yaml_node *item = list->first; item; item = item->next, i++) {
        const struct yaml_node *name = yaml_get(item, "name");
        if (i == index || (name && name->kind == YAML_SCALAR && strcmp(name->text, key->text) == 0)) return item;
        if (name && name->kind == YAML_SCALAR) names[n++] = name->text;
    }
    const char *near = text_nearest(key->text, names);
    const char *cure =
        near ? arena_format(y->arena, "did you mean '%s'?", near)
             : arena_format(y->arena, "entries are named by their name or by a number from 0 to %d", list->n - 1);
    diag_add(y->diag, key->at, cure, "no entry '%s' in this list", diag_shown(y->diag, key->text));
    return NULL;
}

/* What is not there on the way down, or is no map, becomes one. */
static void path_put(struct yaml *y, struct yaml_node *root, struct yaml_node *const *path, struct yaml_node *value)
{
    for (struct yaml_node *at = root, *next; at && *path; path++, at = next) {
        next = at->kind == YAML_LIST ? list_entry(y, at, *path) : NULL;
        if (!path[1]) {
            if (next)
                replace(at, next, value);
            else if (at->kind == YAML_MAP)
                put(y, at, *path, value);
            return;
        }
        if (at->kind == YAML_LIST) continue;
        next = yaml_get(at, (*path)->text);
        if (next) next = opened(y, at, next);
        if (next && next->kind != YAML_SCALAR) continue;
        next = yaml_make(y, YAML_MAP, (*path)->at, NULL);
        put(y, at, *path, next);
    }
}

/* A dotted path into its parts, each with its place; NULL: one of them is empty, which has been reported. */
static struct yaml_node **path_split(struct yaml *y, const struct yaml_node *key, bool option)
{
    int most = 2, n = 0;
    for (const char *s = key->text; *s; s++)
        most += *s == '.';
    struct yaml_node **parts = ARENA_TAKE(y->arena, struct yaml_node *, most);
    for (const char *s = key->text;; s++) {
        size_t size = strcspn(s, ".");
        struct diag_place at = key->at;
        if (key->plain) { /* of a key without quotes the place of the part alone */
            at.column += (int)text_utf8_count(key->text, (size_t)(s - key->text));
            at.width = size > 0 ? (int)text_utf8_count(s, size) : 1;
        }
        if (size == 0 && option)
            diag_add(y->diag, at, "write for instance: --set \"motion.rate=3 Hz\"", "a part of the path is empty");
        else if (size == 0)
            diag_add(y->diag, key->at, "write for instance: motion.rate", "a part of the path '%s' is empty",
                     diag_shown(y->diag, key->text));
        if (size == 0) return NULL;
        parts[n++] = yaml_make(y, YAML_SCALAR, at, arena_format(y->arena, "%.*s", (int)size, s));
        s += size;
        if (!*s) return parts;
    }
}

void scene_merge_set(struct yaml *y, struct yaml_node *root, const char *text)
{
    size_t equals = strcspn(text, "=");
    const char *name = arena_format(y->arena, "--set %.*s", (int)equals, text);
    struct diag_source *source = yaml_source(y, name, text, strlen(text));
    const struct diag_place at = {source, 1, 1, 0};
    source->option = true;
    if (!text[equals])
        diag_add(y->diag, at, "write for instance: --set \"motion.rate=3 Hz\"", "has no '=VALUE'");
    else if (strncmp(text, "include", equals) == 0 && equals == strlen("include"))
        diag_add(y->diag, at, "write include: into a scene file", "include cannot be set here");
    else {
        struct yaml_node *value = yaml_parse_value(y, source, equals + 1),
                         *key = yaml_make(y, YAML_SCALAR, at, arena_format(y->arena, "%.*s", (int)equals, text));
        key->plain = true;
        struct yaml_node **path = value ? path_split(y, key, true) : NULL;
        if (path) path_put(y, root, path, value);
    }
}

void scene_merge_seed(struct yaml *y, struct yaml_node *root, const char *number)
{
    struct diag_source *source = yaml_source(y, "--seed", number, strlen(number));
    source->option = true;
    struct yaml_node *value = yaml_parse_value(y, source, 0);
    if (value) put(y, root, yaml_make(y, YAML_SCALAR, (struct diag_place){source, 1, 1, 0}, "seed"), value);
}

/* ------------------------------------------------------------------ layers */

/* A tree takes its nodes in and changes them when it is merged: values are copied for each scene, keys are not changed
 * and are shared. */

static struct yaml_node *copied(struct yaml *y, const struct yaml_node *from)
{
    struct yaml_node *copy = yaml_make(y, from->kind, from->at, from->text);
    copy->plain = from->plain;
    for (const struct yaml_node *item = from->first; item; item = item->next)
        yaml_append(copy, item->key, copied(y, item));
    return copy;
}

void scene_merge_layer(struct yaml *y, struct yaml_node *root, const struct scene_layer *layer)
{
    for (int i = 0; i < layer->n; i++)
        if (!y->missing ||
            strcmp(layer->keys[i].path[0]->text, "contacts") != 0) /* they may stand in a file that is not there */
            path_put(y, root, layer->keys[i].path, copied(y, layer->keys[i].value));
}

struct yaml_node **scene_merge_layer_path(struct yaml *y, const struct yaml_node *key)
{
    return path_split(y, key, false);
}
