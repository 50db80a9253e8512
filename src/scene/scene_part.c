/* Names and places of what a part of a scene holds: see scene_part.h. */
#include "scene/scene_part.h"

const char *scene_part_label(const struct scene_part *p, const char *path)
{
    return arena_format(p->yaml->arena, "%s%s", p->prefix, path);
}

struct diag_place scene_part_place(const struct scene_part *p, const struct yaml_node *map)
{
    if (map->key)
        return map->key->at;
    if (*p->prefix)
        return map->at;
    return (struct diag_place){map->at.source, 1, 1, 0};
}

bool scene_part_before(const struct diag_place *a, const struct diag_place *b)
{
    const struct diag_source *of_a = a->source, *of_b = b->source;
    if (of_a == of_b)
        return a->line != b->line ? a->line < b->line : a->column < b->column;
    if (of_a->option != of_b->option)
        return of_b->option;
    return of_a->option == (of_a->order < of_b->order);
}
