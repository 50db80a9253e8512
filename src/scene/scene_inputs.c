/* Pinned inputs: see scene_inputs.h. */
#include "scene/scene_inputs.h"

#include <string.h>

#include "scene/scene_merge.h"
#include "scene/scene_places.h"
#include "scene/scene_values.h"

static const char CURE[] = "write: - {file: modes.csv, sha256: 64 hexadecimal digits}";

static bool is_sha256(const char *s) { return strlen(s) == 64 && s[strspn(s, "0123456789abcdef")] == '\0'; }

static void file_read(struct yaml *y, const struct yaml_node *item, struct scene *s, struct input *input)
{
    input->file = scene_merge_path(y, item->at.source, item->text);
    scene_places_input(y, input->file, &item->at, s);
}

static void item_read(struct yaml *y, const struct yaml_node *item, struct scene *s, struct input *input)
{
    bool text = item->kind == YAML_SCALAR && *item->text;
    if (strcmp(item->key->text, "file") == 0 && text)
        file_read(y, item, s, input);
    else if (strcmp(item->key->text, "file") == 0)
        diag_add(y->diag, item->at, CURE, "file must be a file name, not %s", scene_values_kind(y, item));
    else if (strcmp(item->key->text, "sha256") != 0)
        diag_add(y->diag, item->key->at, "keys here: file, sha256", "unknown key '%s' in inputs",
                 diag_shown(y->diag, item->key->text));
    else if (text && is_sha256(item->text))
        input->sha256 = item->text;
    else
        diag_add(y->diag, item->at, CURE, "sha256 must be 64 hexadecimal digits in lower case, not %s",
                 scene_values_kind(y, item));
}

static void entry_read(struct yaml *y, const struct yaml_node *entry, struct scene *s, struct input *input)
{
    if (entry->kind != YAML_MAP) {
        diag_add(y->diag, entry->at, CURE, "an entry of inputs must be a map of keys, not %s",
                 scene_values_kind(y, entry));
        return;
    }
    for (const struct yaml_node *item = entry->first; item; item = item->next)
        item_read(y, item, s, input);
    if (!yaml_get(entry, "file")) diag_add(y->diag, entry->at, CURE, "an entry of inputs has no file");
}

void scene_inputs_read(struct yaml *y, const struct yaml_node *list, struct scene *s)
{
    if (!list) return;
    if (list->kind != YAML_LIST) {
        diag_add(y->diag, list->at, CURE, "inputs must be a list, not %s", scene_values_kind(y, list));
        return;
    }
    s->inputs = ARENA_TAKE(y->arena, struct input, list->n);
    for (const struct yaml_node *entry = list->first; entry; entry = entry->next)
        entry_read(y, entry, s, &s->inputs[s->n_inputs++]);
}
