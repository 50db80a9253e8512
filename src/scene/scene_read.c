/* From a scene's text to its struct: the tree with includes, overrides and recipes, unknown keys, values, what is
   missing or contradicts. Each step tells its errors and goes on, so that all are told at once; only a tree that cannot
   be read ends it early. */
#include "scene/scene_read.h"

#include <string.h>

#include "base/interrupt.h"
#include "file/yaml.h"
#include "scene/accuracy.h"
#include "scene/scene_check.h"
#include "scene/scene_contacts.h"
#include "scene/scene_inputs.h"
#include "scene/scene_merge.h"
#include "scene/scene_places.h"
#include "scene/scene_recipe.h"
#include "scene/scene_sense.h"
#include "scene/scene_set.h"
#include "scene/scene_table.h"
#include "scene/scene_values.h"
#include "scene/units.h"

/* Where the preset and the knobs stand, which are no rows of keys.def. */
static void note_accuracy(struct yaml *y, const struct yaml_node *accuracy, struct scene *s)
{
    const struct yaml_node *at = accuracy && accuracy->kind == YAML_MAP ? accuracy->key : accuracy;
    if (at && at->at.source) scene_places_key(y, "accuracy", &at->at, s);
    for (const struct yaml_node *knob = accuracy && accuracy->kind == YAML_MAP ? accuracy->first : NULL; knob;
         knob = knob->next)
        if (knob->at.source) scene_places_key(y, arena_format(y->arena, "accuracy.%s", knob->key->text), &knob->at, s);
}

static void tree_read(struct yaml *y, struct yaml_node *root, struct scene *s)
{
    struct scene_part top = {y, root, "", KEY_SCENE, s};
    scene_check_fill(&top);
    scene_places_note(&top, NULL, s);
    if (!y->missing) {
        scene_table_rate(&top);
        scene_sense_output(&top);
    }
    scene_table_names(y, root);
    scene_contacts_read(y, root, s);
    accuracy_read(y, yaml_get(root, "accuracy"), &s->accuracy);
    note_accuracy(y, yaml_get(root, "accuracy"), s);
    scene_inputs_read(y, yaml_get(root, "inputs"), s);
    if (y->diag->n == 0 && !y->missing) {
        scene_sense_output_stems(&top);
        scene_sense_output_impacts(&top);
    }
}

/* The source of a layer is the first: it builds on the scene, which is as if it included it. */
static struct yaml *open_over(const struct scene_overrides *over, struct arena *a)
{
    struct yaml *y = yaml_open(a);
    y->sources = over && over->layer;
    return y;
}

/* A design, which a scene was asked for. */
static bool a_design(struct yaml *y, const struct yaml_node *root)
{
    const struct yaml_node *node = yaml_get(root, "rasp-design");
    if (!node) return false;
    y->diag->n = 0;
    y->missing = false;
    diag_add(y->diag, node->key->at, "rasp batch renders it, rasp check checks it",
             "this is a design of many scenes, not a scene");
    return true;
}

/* A scene of another version: what else looks wrong in it need not be, so that this is the only error told. */
static bool another_version(struct yaml *y, const struct yaml_node *root)
{
    const struct yaml_node *node = yaml_get(root, "rasp");
    struct units_fault fault;
    double version;
    if (!node || node->kind != YAML_SCALAR || !units_read(node->text, KEY_NONE, &version, y->arena, &fault) ||
        version == 1)
        return false;
    y->diag->n = 0;
    y->missing = false;
    diag_add(y->diag, node->at,
             "this program reads scenes of version 1, written rasp: 1; a newer one may read this scene",
             "rasp must be 1, not %s", scene_values_kind(y, node));
    return true;
}

static void source_read(struct yaml *y, const struct diag_source *source, const struct scene_overrides *over,
                        struct scene *s)
{
    struct yaml_node *root = scene_merge_text(y, source);
    *s = (struct scene){.file = arena_text(y->arena, source->name)};
    if (!root) return;
    if (over && over->layer) scene_layer_put(y, root, over->layer);
    for (int i = 0; over && i < over->n; i++)
        if (!y->missing || strncmp(over->set[i], "contacts.", strlen("contacts.")) !=
                               0) /* they may stand in a file that is not there */
            scene_set(y, root, over->set[i]);
    if (over && over->seed) scene_set_seed(y, root, over->seed);
    if (a_design(y, root) || another_version(y, root)) return;
    bool readable = scene_recipe_merge(y, root);
    scene_merge_drop_nulls(root);
    if (readable) tree_read(y, root, s);
}

/* The files that were read, as an array. */
static const char **sources_of(struct yaml *y)
{
    int n = 0;
    for (const struct yaml_file *f = y->files; f; f = f->next)
        n++;
    const char **all = ARENA_TAKE(y->arena, const char *, n + 1);
    n = 0;
    for (const struct yaml_file *f = y->files; f; f = f->next)
        all[n++] = f->name;
    return all;
}

static bool finish(struct yaml *y, struct scene *s, const char **messages, struct err *e)
{
    *messages = "";
    s->sources = sources_of(y);
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
