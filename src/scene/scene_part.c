/* Names and places of what a part of a scene holds: see scene_part.h. */
#include "scene/scene_part.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *scene_part_label(const struct scene_part *p, const char *path)
{
    return arena_format(p->yaml->arena, "%s%s", p->prefix, path);
}

const char *scene_part_contact(const struct scene_part *p, const char *name)
{
    return *p->prefix && name ? arena_format(p->yaml->arena, "contact '%s'", diag_shown(p->yaml->diag, name))
                              : "the contact";
}

struct diag_place scene_part_place(const struct scene_part *p, const struct yaml_node *map)
{
    if (map->key) return map->key->at;
    if (*p->prefix) return map->at;
    return (struct diag_place){map->at.source, 1, 1, 0};
}

struct diag_place scene_part_later(const struct scene_part *p, const char *path, const char *other)
{
    const struct yaml_node *a = yaml_find(p->map, path), *b = yaml_find(p->map, other);
    const struct yaml_node *node = !a ? b : !b ? a : scene_part_before(&a->at, &b->at) ? b : a;
    return node ? node->at : scene_part_place(p, p->map);
}

void scene_part_contradiction(const struct scene_part *p, const char *path, const char *other, const char *says,
                              const char *cure)
{
    const struct yaml_node *a = yaml_find(p->map, path), *b = yaml_find(p->map, other);
    diag_add(p->yaml->diag, scene_part_later(p, path, other), cure, "%s %s %s%s", scene_part_label(p, path), says,
             scene_part_label(p, other), a && b ? "" : " (the other is the default; give both)");
}

bool scene_part_known(const struct scene_part *p, const char *path)
{
    const struct key *k = keys_find(path);
    const struct yaml_node *node = yaml_find(p->map, path);
    if (!node) return k->standard != NULL;
    for (const struct choice *c = k->choices; c->word; c++)
        if (node->kind == YAML_SCALAR && strcmp(c->word, node->text) == 0) return true;
    return false;
}

bool scene_part_before(const struct diag_place *a, const struct diag_place *b)
{
    const struct diag_source *of_a = a->source, *of_b = b->source;
    if (of_a == of_b) return a->line != b->line ? a->line < b->line : a->column < b->column;
    if (of_a->option != of_b->option) return of_b->option;
    return of_a->option == (of_a->order < of_b->order);
}

bool scene_part_given(const struct scene_part *p, const char *path) { return yaml_find(p->map, path) != NULL; }

void scene_part_refuse(const struct scene_part *p, const char *path, const char *other, const char *cure,
                       const char *format, ...)
{
    char says[1024];
    va_list ap;
    va_start(ap, format);
    vsnprintf(says, sizeof says, format, ap);
    va_end(ap);
    diag_add(p->yaml->diag, scene_part_later(p, path, other), cure, "%s%s", scene_part_label(p, path), says);
}
