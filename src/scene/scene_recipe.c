/* Recipes: see scene_recipe.h. */
#include "scene/scene_recipe.h"

#include <string.h>

#include "file/yaml.h"
#include "scene/scene_merge.h"
#include "scene/scene_values.h"

static const char CURE[] = "a recipe holds what stands under surface: write for instance: roughness: {rms: 4 um}";

static bool is_remark(const struct yaml_node *item)
{
    return strcmp(item->key->text, "title") == 0 || strcmp(item->key->text, "source") == 0;
}

/* May the item stand in a recipe? Whether it is a key of a surface is asked of the merged scene. */
static bool item_good(struct yaml *y, const struct yaml_node *item)
{
    const char *name = item->key->text;
    if (strcmp(name, "recipe") == 0)
        return diag_add(y->diag, item->key->at, "put both recipes' keys into one file",
                        "a recipe must not name a recipe itself");
    if (is_remark(item) && item->kind != YAML_SCALAR)
        return diag_add(y->diag, item->at, "write for instance: title: sandpaper, grit 120",
                        "%s must be a text, not %s", name, scene_values_kind(y, item));
    return true;
}

/* The recipe's keys of the surface. */
static struct yaml_node *keys_of(struct yaml *y, struct yaml_node *recipe)
{
    struct yaml_node *keys = yaml_make(y, YAML_MAP, recipe->at, NULL);
    for (struct yaml_node *item = recipe->first, *next; item; item = next) {
        next = item->next;
        if (item_good(y, item) && !is_remark(item)) yaml_append(keys, item->key, item);
    }
    return keys;
}

static bool surface_merge(struct yaml *y, struct yaml_node *surface)
{
    const struct yaml_node *name = yaml_get(surface, "recipe");
    if (!name || name->kind != YAML_SCALAR || !*name->text || yaml_null(name)) return true;
    const struct diag_source *source = yaml_bytes_read(y, scene_merge_path(y, name->at.source, name->text), name->at);
    struct yaml_node *recipe = source ? yaml_parse(y, source) : NULL;
    if (recipe && recipe->kind != YAML_MAP)
        return diag_add(y->diag, recipe->at, CURE, "a recipe must be a map of keys, not %s",
                        scene_values_kind(y, recipe));
    if (recipe && yaml_get(recipe, "surface"))
        return diag_add(y->diag, yaml_get(recipe, "surface")->key->at, CURE, "unknown key 'surface' in a recipe");
    if (recipe) scene_merge_under(y, surface, keys_of(y, recipe));
    return recipe || !source;
}

static bool contact_merge(struct yaml *y, struct yaml_node *map)
{
    struct yaml_node *surface = yaml_get(map, "surface");
    return !surface || surface_merge(y, surface);
}

bool scene_recipe_merge(struct yaml *y, struct yaml_node *root)
{
    const struct yaml_node *contacts = yaml_get(root, "contacts");
    bool good = contact_merge(y, root);
    for (struct yaml_node *map = contacts ? contacts->first : NULL; map; map = map->next)
        good = contact_merge(y, map) && good;
    return good;
}
