/* From a scene's text to its struct: the tree with includes, overrides and recipes, unknown keys, values, what is
   missing or contradicts. Each step reports its errors and goes on, so that all are reported at once; only a tree that
   cannot be read ends it early. */
#include "scene/scene_read.h"

#include <string.h>

#include "base/interrupt.h"
#include "file/yaml.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "scene/params.h"
#include "scene/scene_materials.h"
#include "scene/scene_merge.h"
#include "scene/scene_part.h"
#include "scene/scene_places.h"
#include "scene/scene_values.h"
#include "scene/units.h"

/* ------------------------------------------------------------------ recipes */

/* surface.recipe: a file of surface keys, such as

       title: sandpaper, grit 120
       source: where the figures come from
       grit: {density: 30 /mm^2, diameter: 125 um}
       roughness: {rms: 2 um}

   Title and source are for people. Paths in it are seen from its own folder. */

static const char RECIPE[] = "a recipe holds what stands under surface: write for instance: roughness: {rms: 4 um}";

/* The recipe's keys of the surface. Whether they are keys of a surface is asked of the merged scene. */
static struct yaml_node *keys_of(struct yaml *y, struct yaml_node *recipe)
{
    struct yaml_node *keys = yaml_make(y, YAML_MAP, recipe->at, NULL);
    for (struct yaml_node *item = recipe->first, *next; item; item = next) {
        const char *name = item->key->text;
        bool remark = strcmp(name, "title") == 0 || strcmp(name, "source") == 0;
        next = item->next;
        if (strcmp(name, "recipe") == 0)
            diag_add(y->diag, item->key->at, "put both recipes' keys into one file",
                     "a recipe must not name a recipe itself");
        else if (!remark)
            yaml_append(keys, item->key, item);
        else if (item->kind != YAML_SCALAR)
            diag_add(y->diag, item->at, "write for instance: title: sandpaper, grit 120", "%s must be a text, not %s",
                     name, scene_values_kind(y, item));
    }
    return keys;
}

static bool recipe_merge(struct yaml *y, struct yaml_node *map)
{
    struct yaml_node *surface = yaml_get(map, "surface");
    const struct yaml_node *name = surface ? yaml_get(surface, "recipe") : NULL;
    if (!name || name->kind != YAML_SCALAR || !*name->text || yaml_null(name)) return true;
    const struct diag_source *source = yaml_bytes_read(y, scene_merge_path(y, name->at.source, name->text), name->at);
    struct yaml_node *recipe = source ? yaml_parse(y, source) : NULL;
    if (recipe && recipe->kind != YAML_MAP)
        return diag_add(y->diag, recipe->at, RECIPE, "a recipe must be a map of keys, not %s",
                        scene_values_kind(y, recipe));
    if (recipe && yaml_get(recipe, "surface"))
        return diag_add(y->diag, yaml_get(recipe, "surface")->key->at, RECIPE, "unknown key 'surface' in a recipe");
    if (recipe) scene_merge_under(y, surface, keys_of(y, recipe));
    return recipe || !source;
}

/* ------------------------------------------------------------------ pinned inputs */

static const char INPUTS[] = "write: - {file: modes.csv, sha256: 64 hexadecimal digits}";

static void item_read(struct yaml *y, const struct yaml_node *item, struct scene *s, struct input *input)
{
    bool text = item->kind == YAML_SCALAR && *item->text, file = strcmp(item->key->text, "file") == 0;
    if (file && text) {
        input->file = scene_merge_path(y, item->at.source, item->text);
        scene_places_input(y, input->file, &item->at, s);
    } else if (file)
        diag_add(y->diag, item->at, INPUTS, "file must be a file name, not %s", scene_values_kind(y, item));
    else if (strcmp(item->key->text, "sha256") != 0)
        diag_add(y->diag, item->key->at, "keys here: file, sha256", "unknown key '%s' in inputs",
                 diag_shown(y->diag, item->key->text));
    else if (text && strlen(item->text) == 64 && !item->text[strspn(item->text, "0123456789abcdef")])
        input->sha256 = item->text;
    else
        diag_add(y->diag, item->at, INPUTS, "sha256 must be 64 hexadecimal digits in lower case, not %s",
                 scene_values_kind(y, item));
}

static void inputs_read(struct yaml *y, const struct yaml_node *list, struct scene *s)
{
    if (list && list->kind != YAML_LIST)
        diag_add(y->diag, list->at, INPUTS, "inputs must be a list, not %s", scene_values_kind(y, list));
    if (!list || list->kind != YAML_LIST) return;
    s->inputs = ARENA_TAKE(y->arena, struct input, list->n);
    for (const struct yaml_node *entry = list->first; entry; entry = entry->next) {
        struct input *input = &s->inputs[s->n_inputs++];
        if (entry->kind != YAML_MAP) {
            diag_add(y->diag, entry->at, INPUTS, "an entry of inputs must be a map of keys, not %s",
                     scene_values_kind(y, entry));
            continue;
        }
        for (const struct yaml_node *item = entry->first; item; item = item->next)
            item_read(y, item, s, input);
        if (!yaml_get(entry, "file")) diag_add(y->diag, entry->at, INPUTS, "an entry of inputs has no file");
    }
}

/* ------------------------------------------------------------------ contacts */

struct tree {
    struct yaml *yaml;
    struct yaml_node *root;
    struct scene *scene;
};

static bool is_name(const char *s)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
    return *s && !(*s >= '0' && *s <= '9') && s[strspn(s, letters)] == '\0';
}

static const char *name_of(const struct yaml_node *map)
{
    const struct yaml_node *name = yaml_get(map, "name");
    return name && name->kind == YAML_SCALAR ? name->text : NULL;
}

/* errors: how many had been reported before this contact; -1: the scene's own keys are in error, so that nothing is
   known to be missing. */
static void contact_read(const struct tree *t, struct yaml_node *map, const char *prefix, int errors, struct contact *c)
{
    struct scene_part part = {t->yaml, map, prefix, KEY_CONTACT, c, t->scene};
    const struct params *own;
    const char *name = name_of(map);
    if (name && *name && !is_name(name))
        diag_add(t->yaml->diag, yaml_get(map, "name")->at, "write for instance: name: left_hand",
                 "a contact's name must be of letters, digits and _, and must not start with a digit, not '%s'",
                 diag_shown(t->yaml->diag, name));
    scene_part_fill(&part);
    scene_materials_assign(&part, t->scene, c);
    scene_places_note(&part, c->name, t->scene);
    for (int i = 0; (own = stages_params(i)); i++)
        if (own->derive) own->derive(c, (char *)params_block(c) + params_at(own));
    if (t->yaml->missing) /* values may stand in a file that is not there */
        return;
    params_check(&part, c);
    bool good = t->yaml->diag->n == errors;
    for (int i = 0; (own = stages_params(i)); i++)
        if (own->check_asked) own->check_asked(&part, t->root, t->scene, good);
}

/* Reported at a contact whose name an earlier one has; a contact without a name is called "contact". */
static void unique_check(struct yaml *y, const struct yaml_node *list, const struct yaml_node *map)
{
    const char *name = name_of(map);
    for (const struct yaml_node *other = list->first; other != map; other = other->next) {
        const char *taken = name_of(other);
        if (other->kind != YAML_MAP || strcmp(taken ? taken : "contact", name ? name : "contact") != 0) continue;
        diag_add(y->diag, name ? yaml_get(map, "name")->at : map->at,
                 "give each contact a name of its own, such as: name: left_hand", "two contacts are named '%s'",
                 name ? diag_shown(y->diag, name) : "contact");
        return;
    }
}

static void contacts_read(struct yaml *y, struct yaml_node *root, struct scene *s)
{
    struct yaml_node *list = yaml_get(root, "contacts");
    const struct tree tree = {y, root, s};
    scene_part_names(y, root, list ? SCENE_PART_TOP : SCENE_PART_SINGLE, "");
    bool sound = y->diag->n == 0;
    if (list && (list->kind != YAML_LIST || list->n == 0 || list->n > 1000)) {
        diag_add(y->diag, list->at, "write each contact as an entry: - name: left_hand",
                 "contacts must be a list of 1 to 1000 contacts, not %s",
                 list->kind == YAML_LIST ? arena_format(y->arena, "of %d", list->n) : scene_values_kind(y, list));
        return;
    }
    s->contacts = params_contacts(y->arena, list ? list->n : 1);
    s->n_contacts = !list;
    if (!list) contact_read(&tree, root, "", 0, s->contacts);
    for (struct yaml_node *map = list ? list->first : NULL; map; map = map->next) {
        int index = s->n_contacts++, errors = sound ? y->diag->n : -1;
        const char *name = name_of(map), *prefix = name && is_name(name)
                                                       ? arena_format(y->arena, "contacts.%s.", name)
                                                       : arena_format(y->arena, "contacts.%d.", index);
        if (map->kind != YAML_MAP) {
            diag_add(y->diag, map->at, "write for instance: - name: left_hand",
                     "an entry of contacts must be a map of keys, not %s", scene_values_kind(y, map));
            continue;
        }
        unique_check(y, list, map);
        scene_part_names(y, map, SCENE_PART_ENTRY, prefix);
        contact_read(&tree, map, prefix, errors, &s->contacts[index]);
    }
}

/* ------------------------------------------------------------------ the scene */

static void check_scene(const struct scene_part *top, bool contacts)
{
    const struct params *own;
    for (int i = 0; (own = stages_params(i)); i++)
        if (own->check_scene) own->check_scene(top, contacts);
}

static void tree_read(struct yaml *y, struct yaml_node *root, struct scene *s)
{
    struct scene_part top = {y, root, "", KEY_SCENE, s, s};
    scene_part_fill(&top);
    scene_places_note(&top, NULL, s);
    check_scene(&top, false);
    scene_materials_read(y, yaml_get(root, "materials"), s);
    contacts_read(y, root, s);
    const struct yaml_node *accuracy = yaml_get(root, "accuracy"), /* its knobs are in no table of keys */
        *map = accuracy && accuracy->kind == YAML_MAP ? accuracy : NULL, *at = map ? map->key : accuracy;
    accuracy_read(y, accuracy, &s->accuracy);
    if (at && at->at.source) scene_places_key(y, "accuracy", &at->at, s);
    for (const struct yaml_node *knob = map ? map->first : NULL; knob; knob = knob->next)
        if (knob->at.source) scene_places_key(y, arena_format(y->arena, "accuracy.%s", knob->key->text), &knob->at, s);
    inputs_read(y, yaml_get(root, "inputs"), s);
    if (y->diag->n == 0 && !y->missing) check_scene(&top, true);
}

/* The source of a layer is the first: it builds on the scene, which is as if it included it. */
static struct yaml *open_over(const struct scene_overrides *over, struct arena *a)
{
    struct yaml *y = yaml_open(a);
    y->sources = over && over->layer;
    return y;
}

/* A design, where a scene was asked for, or a scene of another version: what else looks wrong in it need not be, so
 * that this is the only error reported. */
static bool is_other(struct yaml *y, const struct yaml_node *root)
{
    const struct yaml_node *design = yaml_get(root, "rasp-design"), *rasp = yaml_get(root, "rasp");
    struct units_fault fault;
    double version = 1;
    bool read = rasp && rasp->kind == YAML_SCALAR && units_read(rasp->text, KEY_NONE, &version, y->arena, &fault);
    if (!design && (!read || version == 1)) return false;
    y->diag->n = 0;
    y->missing = false;
    if (design)
        diag_add(y->diag, design->key->at, "rasp batch renders it, rasp check checks it",
                 "this is a design of many scenes, not a scene");
    else
        diag_add(y->diag, rasp->at,
                 "this program reads scenes of version 1, written rasp: 1; a newer one may read this scene",
                 "rasp must be 1, not %s", scene_values_kind(y, rasp));
    return true;
}

static void source_read(struct yaml *y, const struct diag_source *source, const struct scene_overrides *over,
                        struct scene *s)
{
    struct yaml_node *root = scene_merge_text(y, source);
    *s = (struct scene){.file = arena_text(y->arena, source->name)};
    if (!root) return;
    if (over && over->layer) scene_merge_layer(y, root, over->layer);
    for (int i = 0; over && i < over->n; i++)
        if (!y->missing || strncmp(over->set[i], "contacts.", strlen("contacts.")) !=
                               0) /* they may stand in a file that is not there */
            scene_merge_set(y, root, over->set[i]);
    if (over && over->seed) scene_merge_seed(y, root, over->seed);
    if (is_other(y, root)) return;
    const struct yaml_node *contacts = yaml_get(root, "contacts");
    bool readable = recipe_merge(y, root);
    for (struct yaml_node *map = contacts ? contacts->first : NULL; map; map = map->next)
        readable = recipe_merge(y, map) && readable;
    scene_merge_drop_nulls(root);
    if (readable) tree_read(y, root, s);
}

static bool finish(struct yaml *y, struct scene *s, const char **messages, struct err *e)
{
    *messages = "";
    int n = 0;
    for (const struct yaml_file *f = y->files; f; f = f->next)
        n++;
    const char **sources = s->sources = ARENA_TAKE(y->arena, const char *, n + 1);
    for (const struct yaml_file *f = y->files; f; f = f->next)
        *sources++ = f->name;
    if (y->diag->n == 0) return true;
    s->diag = y->diag;
    *messages = diag_text(y->diag);
    return err_set(e, y->missing ? interrupt_seen() ? ERR_INTERRUPTED : ERR_INPUT : ERR_SCENE, "%s",
                   diag_first(y->diag));
}

bool scene_read_text(const char *text, size_t n, const char *name, const struct scene_overrides *over, struct arena *a,
                     struct scene *s, const char **messages, struct err *e)
{
    struct yaml *y = open_over(over, a);
    char *copy = arena_take(a, n + 1, 1);
    if (n > 0) memcpy(copy, text, n);
    source_read(y, yaml_source(y, arena_text(a, name), copy, n), over, s);
    return finish(y, s, messages, e);
}

bool scene_read_made(const char *text, const char *name, const struct scene_overrides *over, struct arena *a,
                     struct scene *s, const char **messages, struct err *e)
{
    struct yaml *y = open_over(over, a);
    struct diag_source *source = yaml_source(y, arena_text(a, name), arena_text(a, text), strlen(text));
    source->made = true;
    source_read(y, source, over, s);
    return finish(y, s, messages, e);
}

bool scene_read(const char *file, const struct scene_overrides *over, struct arena *a, struct scene *s,
                const char **messages, struct err *e)
{
    struct yaml *y = open_over(over, a);
    struct diag_place named = over && over->layer ? over->layer->named : (struct diag_place){NULL, 0, 0, 0};
    struct diag_source *source = yaml_bytes_read(y, file, named);
    *s = (struct scene){.file = file};
    if (source) source_read(y, source, over, s);
    return finish(y, s, messages, e);
}
