/* See design_reading.h. */
#include "batch/design_reading.h"

#include <string.h>

#include "base/text.h"
#include "scene/scene_values.h"

struct yaml_node *design_reading_value(const struct design_reading *r, const char *key)
{
    struct yaml_node *node = yaml_get(r->root, key);
    return node && yaml_null(node) ? NULL : node;
}

bool design_reading_must(const struct design_reading *r, const struct yaml_node *node, const char *label, const char *be, const char *cure)
{
    return diag_add(r->yaml->diag, node->at, cure, "%s must be %s, not %s", label, be,
                    node->kind == YAML_LIST && node->n == 0 ? "an empty list" : scene_values_kind(r->yaml, node));
}

const char *design_reading_joined(const struct design_reading *r, const char *const *names)
{
    const char *all = "";
    for (int i = 0; names[i]; i++)
        all = i == 12 ? arena_format(r->arena, "%s, ...", all) : i > 12 ? all : arena_format(r->arena, "%s%s%s", all, i ? ", " : "", names[i]);
    return all;
}

/* "did you mean 'x'?", or what there is. */
static const char *near_or_all(const struct design_reading *r, const char *word, const char *const *names, const char *there)
{
    const char *near = text_nearest(word, names);
    return near ? arena_format(r->arena, "did you mean '%s'?", near) : arena_format(r->arena, "%s: %s", there, design_reading_joined(r, names));
}

void design_reading_known(const struct design_reading *r, const struct yaml_node *map, const char *const *names, const char *in)
{
    for (const struct yaml_node *item = map->first; item; item = item->next) {
        int i = 0;
        while (names[i] && strcmp(names[i], item->key->text) != 0)
            i++;
        if (!names[i])
            diag_add(r->yaml->diag, item->key->at, near_or_all(r, item->key->text, names, "keys here"), "unknown key '%s'%s",
                     diag_shown(r->yaml->diag, item->key->text), in);
    }
}

int design_reading_factor(const struct design_reading *r, const struct yaml_node *key)
{
    const struct design *d = r->design;
    const char **names = ARENA_TAKE(r->arena, const char *, d->n_factors + 1);
    for (int f = 0; f < d->n_factors; f++) {
        if (strcmp(d->factors[f].name, key->text) == 0)
            return f;
        names[f] = d->factors[f].name;
    }
    diag_add(r->yaml->diag, key->at, d->n_factors ? near_or_all(r, key->text, names, "factors") : "the design has no factors", "no factor '%s'",
             diag_shown(r->yaml->diag, key->text));
    return -1;
}

static void no_level(const struct design_reading *r, int f, const struct yaml_node *label, bool recording)
{
    const struct design_factor *factor = &r->design->factors[f];
    const char **names = ARENA_TAKE(r->arena, const char *, factor->n_levels + 1);
    for (int i = 0; i < factor->n_levels; i++)
        names[i] = factor->levels[i].label;
    const char *cure = near_or_all(r, label->text, names, "its levels");
    if (recording)
        cure = arena_format(r->arena, "%s (a level that only recordings have: - {label: %s, of: recordings})", cure, diag_shown(r->yaml->diag, label->text));
    diag_add(r->yaml->diag, label->at, cure, "'%s' is no level of %s",
             diag_shown(r->yaml->diag, label->text), factor->name);
}

int design_reading_level(const struct design_reading *r, int f, const struct yaml_node *label, bool recording)
{
    const struct design_factor *factor = &r->design->factors[f];
    const struct yaml_node *item = r->factors[f]->first;
    if (label->kind != YAML_SCALAR) {
        design_reading_must(r, label, factor->name, "the label of a level", arena_format(r->arena, "write for instance: %s", factor->levels[0].label));
        return -1;
    }
    for (int i = 0; i < factor->n_levels; i++, item = item->next)
        if (strcmp(factor->levels[i].label, label->text) == 0 || (item->kind == YAML_SCALAR && strcmp(item->text, label->text) == 0))
            return i;
    no_level(r, f, label, recording);
    return -1;
}

const char *design_reading_labels(const struct design *d, const int *level, struct arena *a)
{
    const char *all = "";
    for (int f = 0; f < d->n_factors; f++)
        if (level[f] >= 0)
            all = arena_format(a, "%s%s%s", all, *all ? ", " : "", d->factors[f].levels[level[f]].label);
    return all;
}
