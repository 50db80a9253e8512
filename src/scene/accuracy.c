/* Presets and knobs: see accuracy.h. */
#include "scene/accuracy.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "scene/keys.h"
#include "scene/scene_values.h"

static const char STANDARD[] = "standard",
                  PRESETS[] = "presets: draft, standard, high, reference; for an error that must hold: {error: -60 dB}";

#define LEAST_ERROR (-240.0) /* dB; doubles hold -313 */

bool accuracy_preset(struct accuracy *accuracy, const char *preset)
{
    for (int i = 0; keys_presets[i]; i++) {
        if (strcmp(keys_presets[i], preset) != 0) continue;
        accuracy->preset = keys_presets[i];
        for (const struct key_knob *k = keys_knobs; k->name; k++)
            *(double *)((char *)accuracy + k->offset) = k->preset[i];
        return true;
    }
    return false;
}

double accuracy_target(const struct accuracy *accuracy)
{
    static const double target[] = {-40, -70, -100, NAN};
    for (int i = 0; accuracy->preset && keys_presets[i]; i++)
        if (!strcmp(keys_presets[i], accuracy->preset) && accuracy->by_user != (1u << KNOBS) - 1) return target[i];
    return NAN;
}

struct scene accuracy_coarsest(const struct scene *s)
{
    struct scene c = *s;
    for (int i = 0; i < s->n_contacts; i++)
        if (s->contacts[i].contact.model == CONTACT_ROLL_COUPLED) return c;
    for (int k = 0; k < KNOBS && !isnan(accuracy_target(&s->accuracy)); k++)
        if (!(s->accuracy.by_user & 1u << k)) accuracy_turn(&c.accuracy, (enum knob)k, keys_knobs[k].preset[0]);
    return c;
}

static void preset_read(struct yaml *y, const struct yaml_node *node, struct accuracy *accuracy)
{
    const char *near = NULL;
    if (node->kind == YAML_SCALAR && accuracy_preset(accuracy, node->text)) return;
    if (node->kind == YAML_SCALAR) near = text_nearest(node->text, keys_presets);
    diag_add(y->diag, node->at, near ? arena_format(y->arena, "did you mean '%s'?", near) : PRESETS,
             "accuracy must be a preset or a map of knobs, not %s", scene_values_kind(y, node));
}

static void knob_unknown(struct yaml *y, const struct yaml_node *key)
{
    const char *names[32] = {"preset", "error"}, *all = "preset, error";
    int n = 2;
    for (const struct key_knob *k = keys_knobs; k->name && n < 31; k++) {
        names[n++] = k->name;
        all = arena_format(y->arena, "%s, %s", all, k->name);
    }
    const char *near = text_nearest(key->text, names),
               *former = keys_former(arena_format(y->arena, "accuracy.%s", key->text), "");
    if (former)
        diag_add(y->diag, key->at, former, "accuracy.%s is no longer there", key->text);
    else
        diag_add(y->diag, key->at,
                 near ? arena_format(y->arena, "did you mean '%s'?", near)
                      : arena_format(y->arena, "keys here: %s", all),
                 "unknown key '%s' in accuracy", diag_shown(y->diag, key->text));
}

double accuracy_knob(const struct accuracy *accuracy, enum knob k)
{
    return *(const double *)((const char *)accuracy + keys_knobs[k].offset);
}

void accuracy_turn(struct accuracy *accuracy, enum knob k, double value)
{
    *(double *)((char *)accuracy + keys_knobs[k].offset) = value;
}

bool accuracy_takes(enum knob k, double value)
{
    const struct key_knob *o = &keys_knobs[k];
    return value >= o->low && value <= o->high && (!o->whole || value == floor(value));
}

static void knob_read(struct yaml *y, const struct key_knob *k, const struct yaml_node *node, struct accuracy *accuracy)
{
    const char *label = arena_format(y->arena, "accuracy.%s", k->name);
    const char *given = scene_values_kind(y, node);
    double x;
    if (!scene_values_quantity(y, node, label, KEY_NONE, &x)) return;
    if (x < k->low || x > k->high)
        diag_add(y->diag, node->at, k->meaning, "%s must be from %g to %g, not %s", label, k->low, k->high, given);
    else if (k->whole && x != floor(x))
        diag_add(y->diag, node->at, k->meaning, "%s must be a whole number, not %s", label, given);
    else {
        accuracy_turn(accuracy, (enum knob)(k - keys_knobs), x);
        accuracy->by_user |= 1u << (k - keys_knobs);
    }
}

void accuracy_read(struct yaml *y, const struct yaml_node *node, struct accuracy *accuracy)
{
    accuracy_preset(accuracy, STANDARD);
    accuracy->error = NAN;
    accuracy->by_user = 0;
    if (!node) return;
    if (node->kind != YAML_MAP) {
        preset_read(y, node, accuracy);
        return;
    }
    const struct yaml_node *preset = yaml_get(node, "preset");
    if (preset) preset_read(y, preset, accuracy);
    for (const struct yaml_node *item = node->first; item; item = item->next) {
        const struct key_knob *k = keys_knobs;
        double x;
        while (k->name && strcmp(k->name, item->key->text) != 0)
            k++;
        if (strcmp(item->key->text, "error") == 0) {
            if (!scene_values_quantity(y, item, "accuracy.error", KEY_DECIBEL, &x)) continue;
            if (x >= LEAST_ERROR && x < 0)
                accuracy->error = x;
            else
                diag_add(y->diag, item->at,
                         "write for instance: -60 dB, relative to the sound, rms; the knobs that are not given are "
                         "chosen by it",
                         "accuracy.error must be from %g dB to below 0 dB, not %s", LEAST_ERROR,
                         scene_values_kind(y, item));
        } else if (k->name)
            knob_read(y, k, item, accuracy);
        else if (strcmp(item->key->text, "preset") != 0)
            knob_unknown(y, item->key);
    }
}
