/* Contacts: see scene_contacts.h. The scene's own keys have been read before. */
#include "scene/scene_contacts.h"

#include <string.h>

#include "scene/ablation.h"
#include "scene/ball.h"
#include "scene/keys.h"
#include "scene/params.h"
#include "scene/scene_check.h"
#include "scene/scene_keys.h"
#include "scene/scene_places.h"
#include "scene/scene_sense.h"
#include "scene/scene_table.h"
#include "scene/scene_values.h"

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

static void name_check(struct yaml *y, const struct yaml_node *map)
{
    const char *name = name_of(map);
    if (name && *name && !is_name(name))
        diag_add(y->diag, yaml_get(map, "name")->at, "write for instance: name: left_hand",
                 "a contact's name must be of letters, digits and _, and must not start with a digit, not '%s'",
                 diag_shown(y->diag, name));
}

/* errors: how many had been told before this contact; -1: the scene's own keys are in error, so that nothing is known
 * to be missing. */
static void contact_read(const struct tree *t, struct yaml_node *map, const char *prefix, int errors, struct contact *c)
{
    struct scene_part part = {t->yaml, map, prefix, KEY_CONTACT, c};
    name_check(t->yaml, map);
    scene_check_fill(&part);
    scene_places_note(&part, c->name, t->scene);
    ball_apply(c);
    ablation_apply(c);
    if (t->yaml->missing) /* values may stand in a file that is not there */
        return;
    scene_sense_contact(&part);
    if (t->yaml->diag->n == errors) scene_sense_asked(&part, t->scene);
    scene_table_columns(&part, t->root, t->scene);
    scene_sense_output_audible(&part, t->root, t->scene);
}

static const char *prefix_of(struct yaml *y, const struct yaml_node *map, int index)
{
    const char *name = name_of(map);
    return name && is_name(name) ? arena_format(y->arena, "contacts.%s.", name)
                                 : arena_format(y->arena, "contacts.%d.", index);
}

/* Told at a contact whose name an earlier one has; a contact without a name is called "contact". */
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

static void entry_read(const struct tree *t, const struct yaml_node *list, struct yaml_node *map, bool sound,
                       struct contact *c)
{
    struct yaml *y = t->yaml;
    int index = 0, errors = sound ? y->diag->n : -1;
    for (const struct yaml_node *other = list->first; other != map; other = other->next)
        index++;
    const char *prefix = prefix_of(y, map, index);
    if (map->kind != YAML_MAP) {
        diag_add(y->diag, map->at, "write for instance: - name: left_hand",
                 "an entry of contacts must be a map of keys, not %s", scene_values_kind(y, map));
        return;
    }
    unique_check(y, list, map);
    scene_keys_check(y, map, SCENE_KEYS_ENTRY, prefix);
    contact_read(t, map, prefix, errors, c);
}

static void list_read(const struct tree *t, struct yaml_node *list, struct scene *s)
{
    struct yaml *y = t->yaml;
    bool sound = y->diag->n == 0;
    if (list->kind != YAML_LIST || list->n == 0 || list->n > 1000) {
        diag_add(y->diag, list->at, "write each contact as an entry: - name: left_hand",
                 "contacts must be a list of 1 to 1000 contacts, not %s",
                 list->kind == YAML_LIST ? arena_format(y->arena, "of %d", list->n) : scene_values_kind(y, list));
        return;
    }
    s->contacts = params_contacts(y->arena, list->n);
    for (struct yaml_node *map = list->first; map; map = map->next)
        entry_read(t, list, map, sound, &s->contacts[s->n_contacts++]);
}

void scene_contacts_read(struct yaml *y, struct yaml_node *root, struct scene *s)
{
    struct yaml_node *list = yaml_get(root, "contacts");
    const struct tree tree = {y, root, s};
    scene_keys_check(y, root, list ? SCENE_KEYS_TOP : SCENE_KEYS_SINGLE, "");
    if (list) {
        list_read(&tree, list, s);
        return;
    }
    s->contacts = params_contacts(y->arena, 1);
    s->n_contacts = 1;
    contact_read(&tree, root, "", 0, s->contacts);
}
