/* See scene_layer.h. A tree takes its nodes in and changes them when it is merged: values are copied for each scene,
 * keys are not changed and are shared. */
#include "scene/scene_layer.h"

#include <string.h>

#include "base/text.h"
#include "scene/scene_set.h"

static struct yaml_node *copied(struct yaml *y, const struct yaml_node *from)
{
    struct yaml_node *copy = yaml_make(y, from->kind, from->at, from->text);
    copy->plain = from->plain;
    for (const struct yaml_node *item = from->first; item; item = item->next)
        yaml_append(copy, item->key, copied(y, item));
    return copy;
}

void scene_layer_put(struct yaml *y, struct yaml_node *root, const struct scene_layer *layer)
{
    for (int i = 0; i < layer->n; i++)
        if (!y->missing ||
            strcmp(layer->keys[i].path[0]->text, "contacts") != 0) /* they may stand in a file that is not there */
            scene_set_put(y, root, layer->keys[i].path, copied(y, layer->keys[i].value));
}

/* Of a key without quotes the place of the part alone. */
static struct diag_place part_place(const struct yaml_node *key, size_t from, size_t n)
{
    struct diag_place at = key->at;
    if (!key->plain) return at;
    at.column += (int)text_utf8_count(key->text, from);
    at.width = (int)text_utf8_count(key->text + from, n);
    return at;
}

struct yaml_node **scene_layer_path(struct yaml *y, const struct yaml_node *key)
{
    int most = 2, n = 0;
    for (const char *s = key->text; *s; s++)
        most += *s == '.';
    struct yaml_node **parts = ARENA_TAKE(y->arena, struct yaml_node *, most);
    for (const char *s = key->text;; s++) {
        size_t size = strcspn(s, ".");
        if (size == 0) {
            diag_add(y->diag, key->at, "write for instance: motion.rate", "a part of the path '%s' is empty",
                     diag_shown(y->diag, key->text));
            return NULL;
        }
        parts[n++] = yaml_make(y, YAML_SCALAR, part_place(key, (size_t)(s - key->text), size),
                               arena_format(y->arena, "%.*s", (int)size, s));
        s += size;
        if (!*s) return parts;
    }
}
