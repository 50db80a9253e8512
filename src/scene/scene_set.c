/* See scene_set.h. */
#include "scene/scene_set.h"

#include <string.h>

#include "base/text.h"
#include "file/yaml.h"
#include "scene/scene_merge.h"

struct assignment {
    struct yaml *y;
    struct diag_source *source;
    size_t from, to; /* of the part of the path that is looked at */
};

static struct diag_place part_place(const struct assignment *s)
{
    const char *text = s->source->text;
    int column = (int)text_utf8_count(text, s->from) + 1, width = (int)text_utf8_count(text + s->from, s->to - s->from);
    return (struct diag_place){s->source, 1, column, width > 0 ? width : 1};
}

static struct yaml_node *part_key(const struct assignment *s)
{
    const char *word = arena_format(s->y->arena, "%.*s", (int)(s->to - s->from), s->source->text + s->from);
    return yaml_make(s->y, YAML_SCALAR, part_place(s), word);
}

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

/* One step down the path; what is not there, or is not a map, becomes one. */
static struct yaml_node *step(struct yaml *y, struct yaml_node *at, struct yaml_node *key)
{
    if (at->kind == YAML_LIST) return list_entry(y, at, key);
    struct yaml_node *child = yaml_get(at, key->text);
    if (child) child = scene_merge_opened(y, at, child);
    if (child && child->kind != YAML_SCALAR) return child;
    child = yaml_make(y, YAML_MAP, key->at, NULL);
    scene_merge_put(y, at, key, child);
    return child;
}

static void put(struct yaml *y, struct yaml_node *at, struct yaml_node *key, struct yaml_node *value)
{
    struct yaml_node *old = at->kind == YAML_LIST ? list_entry(y, at, key) : NULL;
    if (old)
        scene_merge_replace(at, old, value);
    else if (at->kind == YAML_MAP)
        scene_merge_put(y, at, key, value);
}

void scene_set_put(struct yaml *y, struct yaml_node *root, struct yaml_node *const *path, struct yaml_node *value)
{
    for (struct yaml_node *at = root; at && *path; path++) {
        if (!path[1]) {
            put(y, at, *path, value);
            return;
        }
        at = step(y, at, *path);
    }
}

static bool part_next(struct assignment *s, size_t end)
{
    s->to = s->from + strcspn(s->source->text + s->from, ".");
    if (s->to > end) s->to = end;
    if (s->to > s->from) return true;
    diag_add(s->y->diag, part_place(s), "write for instance: --set \"motion.rate=3 Hz\"",
             "a part of the path is empty");
    return false;
}

/* The parts of the path; NULL: one of them is empty. */
static struct yaml_node **path_of(struct assignment *s, size_t equals)
{
    struct yaml_node **path = ARENA_TAKE(s->y->arena, struct yaml_node *, equals + 2);
    for (int n = 0; part_next(s, equals); s->from = s->to + 1) {
        path[n++] = part_key(s);
        if (s->to == equals) return path;
    }
    return NULL;
}

static void assign(struct assignment *s, struct yaml_node *root, size_t equals)
{
    struct yaml_node *value = yaml_parse_value(s->y, s->source, equals + 1), **path = value ? path_of(s, equals) : NULL;
    if (path) scene_set_put(s->y, root, path, value);
}

void scene_set(struct yaml *y, struct yaml_node *root, const char *text)
{
    size_t equals = strcspn(text, "=");
    const char *name = arena_format(y->arena, "--set %.*s", (int)equals, text);
    struct assignment s = {.y = y, .source = yaml_source(y, name, text, strlen(text))};
    s.source->option = true;
    if (!text[equals])
        diag_add(y->diag, (struct diag_place){s.source, 1, 1, 0}, "write for instance: --set \"motion.rate=3 Hz\"",
                 "has no '=VALUE'");
    else if (strncmp(text, "include", equals) == 0 && equals == strlen("include"))
        diag_add(y->diag, (struct diag_place){s.source, 1, 1, 0}, "write include: into a scene file",
                 "include cannot be set here");
    else
        assign(&s, root, equals);
}

void scene_set_seed(struct yaml *y, struct yaml_node *root, const char *number)
{
    struct diag_source *source = yaml_source(y, "--seed", number, strlen(number));
    source->option = true;
    struct yaml_node *value = yaml_parse_value(y, source, 0);
    if (value) scene_merge_put(y, root, yaml_make(y, YAML_SCALAR, (struct diag_place){source, 1, 1, 0}, "seed"), value);
}
