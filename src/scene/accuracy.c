/* Presets and knobs: see accuracy.h. */
#include "scene/accuracy.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "scene/keys.h"
#include "scene/scene_values.h"

static const char STANDARD[] = "standard", PRESETS[] = "presets: draft, standard, high, reference";

bool accuracy_preset(struct accuracy *accuracy, const char *preset)
{
    for (int i = 0; keys_presets[i]; i++) {
        if (strcmp(keys_presets[i], preset) != 0)
            continue;
        accuracy->preset = keys_presets[i];
        for (const struct key_knob *k = keys_knobs; k->name; k++)
            *(double *)((char *)accuracy + k->offset) = k->preset[i];
        return true;
    }
    return false;
}

static void preset_read(struct yaml *y, const struct yaml_node *node, struct accuracy *accuracy)
{
    const char *near = NULL;
    if (node->kind == YAML_SCALAR && accuracy_preset(accuracy, node->text))
        return;
    if (node->kind == YAML_SCALAR)
        near = text_nearest(node->text, keys_presets);
    diag_add(y->diag, node->at, near ? arena_format(y->arena, "did you mean '%s'?", near) : PRESETS,
             "accuracy must be a preset or a map of knobs, not %s", scene_values_kind(y, node));
}

static const struct key_knob *knob_find(const char *name)
{
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        if (strcmp(k->name, name) == 0)
            return k;
    return NULL;
}

static void knob_unknown(struct yaml *y, const struct yaml_node *key)
{
    const char *names[32] = {"preset"}, *all = "preset";
    int n = 1;
    for (const struct key_knob *k = keys_knobs; k->name && n < 31; k++) {
        names[n++] = k->name;
        all = arena_format(y->arena, "%s, %s", all, k->name);
    }
    const char *near = text_nearest(key->text, names);
    diag_add(y->diag, key->at, near ? arena_format(y->arena, "did you mean '%s'?", near) : arena_format(y->arena, "keys here: %s", all),
             "unknown key '%s' in accuracy", diag_shown(y->diag, key->text));
}

/* The unit a knob takes is the one that its meaning names. */
static enum key_dimension knob_dimension(const struct key_knob *k)
{
    return strstr(k->meaning, "seconds ") ? KEY_TIME : strstr(k->meaning, " in dB ") ? KEY_DECIBEL : KEY_NONE;
}

static void knob_read(struct yaml *y, const struct key_knob *k, const struct yaml_node *node, struct accuracy *accuracy)
{
    const char *label = arena_format(y->arena, "accuracy.%s", k->name);
    const char *given = scene_values_kind(y, node);
    double x;
    if (!scene_values_quantity(y, node, label, knob_dimension(k), &x))
        return;
    if (x < k->low || x > k->high)
        diag_add(y->diag, node->at, k->meaning, "%s must be from %g to %g, not %s", label, k->low, k->high, given);
    else if (k->whole && x != floor(x))
        diag_add(y->diag, node->at, k->meaning, "%s must be a whole number, not %s", label, given);
    else if (strcmp(k->name, "overlap_order") == 0 && x == 3)
        diag_add(y->diag, node->at, "write 1, 2 or 4", "accuracy.overlap_order 3 is not offered: 1, 2 and 4 are");
    else
        *(double *)((char *)accuracy + k->offset) = x;
}

static void entry_read(struct yaml *y, const struct yaml_node *item, struct accuracy *accuracy)
{
    const struct key_knob *k = knob_find(item->key->text);
    if (strcmp(item->key->text, "preset") == 0)
        return;
    if (strcmp(item->key->text, "error") == 0)
        diag_add(y->diag, item->key->at, arena_format(y->arena, "name a preset instead; %s", PRESETS),
                 "choosing the accuracy by an error is not offered");
    else if (k)
        knob_read(y, k, item, accuracy);
    else
        knob_unknown(y, item->key);
}

void accuracy_read(struct yaml *y, const struct yaml_node *node, struct accuracy *accuracy)
{
    accuracy_preset(accuracy, STANDARD);
    if (!node)
        return;
    if (node->kind != YAML_MAP) {
        preset_read(y, node, accuracy);
        return;
    }
    const struct yaml_node *preset = yaml_get(node, "preset");
    if (preset)
        preset_read(y, preset, accuracy);
    for (const struct yaml_node *item = node->first; item; item = item->next)
        entry_read(y, item, accuracy);
}
