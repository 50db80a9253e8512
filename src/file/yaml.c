/* Nodes: making and finding them; see yaml.h. */
#include "file/yaml.h"

#include <string.h>

struct yaml *yaml_open(struct arena *a)
{
    struct yaml *y = ARENA_TAKE(a, struct yaml, 1);
    y->arena = a;
    y->diag = diag_open(a);
    return y;
}

struct diag_source *yaml_source(struct yaml *y, const char *name, const char *text, size_t size)
{
    struct diag_source *s = ARENA_TAKE(y->arena, struct diag_source, 1);
    *s = (struct diag_source){.name = name, .text = text, .size = size, .order = y->sources++};
    return s;
}

struct yaml_node *yaml_make(struct yaml *y, enum yaml_kind kind, struct diag_place at, const char *text)
{
    struct yaml_node *node = ARENA_TAKE(y->arena, struct yaml_node, 1);
    *node = (struct yaml_node){.kind = kind, .at = at, .text = text, .plain = true};
    return node;
}

void yaml_append(struct yaml_node *parent, struct yaml_node *key, struct yaml_node *value)
{
    value->key = key;
    value->next = NULL;
    *(parent->last ? &parent->last->next : &parent->first) = value;
    parent->last = value;
    parent->n++;
}

bool yaml_null(const struct yaml_node *node)
{
    return node->kind == YAML_SCALAR && node->plain &&
           (strcmp(node->text, "null") == 0 || strcmp(node->text, "~") == 0);
}

struct yaml_node *yaml_get(const struct yaml_node *map, const char *key)
{
    if (map->kind != YAML_MAP) return NULL;
    for (struct yaml_node *item = map->first; item; item = item->next)
        if (strcmp(item->key->text, key) == 0) return item;
    return NULL;
}

struct yaml_node *yaml_find(struct yaml_node *map, const char *path)
{
    char part[128];
    while (map) {
        size_t n = strcspn(path, ".");
        if (n >= sizeof part) return NULL;
        memcpy(part, path, n);
        part[n] = '\0';
        map = yaml_get(map, part);
        if (!path[n]) return map;
        path += n + 1;
    }
    return NULL;
}
