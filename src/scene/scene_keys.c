/* Unknown keys: see scene_keys.h. */
#include "scene/scene_keys.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "scene/keys.h"
#include "scene/scene_values.h"

enum { NAMES_MAX = 64, DEEP_MAX = 256 };
enum role { ROLE_NONE, ROLE_VALUE, ROLE_SECTION };

static const char *const top_names[] = {"include", "contacts", "accuracy", "inputs", NULL};

struct walk {
    struct yaml *y;
    enum scene_keys_where where;
    const char *prefix;
};

/* Does dotted path `key` lie under `section` ("": everything does)? Gives what follows. */
static const char *under(const char *key, const char *section)
{
    size_t n = strlen(section);
    if (n == 0) return key;
    return strncmp(key, section, n) == 0 && key[n] == '.' ? key + n + 1 : NULL;
}

static bool allowed(const struct walk *w, const struct key *k)
{
    return w->where == SCENE_KEYS_SINGLE || (k->of == KEY_CONTACT) == (w->where == SCENE_KEYS_ENTRY);
}

static enum role role_of(const char *path, const struct key **found)
{
    for (const struct key *k = keys_table; k->path; k++) {
        *found = k;
        if (strcmp(k->path, path) == 0) return ROLE_VALUE;
        if (under(k->path, path)) return ROLE_SECTION;
    }
    return ROLE_NONE;
}

static bool is_top_name(const struct walk *w, const char *path)
{
    for (int i = 0; top_names[i]; i++)
        if (w->where != SCENE_KEYS_ENTRY && strcmp(top_names[i], path) == 0) return true;
    return false;
}

static bool has(const char *const *names, const char *word)
{
    for (; *names; names++)
        if (strcmp(*names, word) == 0) return true;
    return false;
}

/* The keys that may stand in a section, NULL-terminated. */
static const char **names_in(const struct walk *w, const char *section)
{
    const char **names = ARENA_TAKE(w->y->arena, const char *, NAMES_MAX + 8);
    int n = 0;
    for (const struct key *k = keys_table; k->path && n < NAMES_MAX; k++) {
        const char *rest = allowed(w, k) ? under(k->path, section) : NULL;
        if (!rest) continue;
        const char *name = arena_format(w->y->arena, "%.*s", (int)strcspn(rest, "."), rest);
        if (!has(names, name)) names[n++] = name;
    }
    for (int i = 0; !*section && w->where != SCENE_KEYS_ENTRY && top_names[i]; i++)
        names[n++] = top_names[i];
    return names;
}

static const char *joined(struct arena *a, const char *const *names, const char *between)
{
    const char *all = "";
    for (; *names; names++)
        all = arena_format(a, "%s%s%s", all, *all ? between : "", *names);
    return all;
}

/* Full paths of the keys whose last part is the word; NULL: there are none. */
static const char *elsewhere(const struct walk *w, const char *word)
{
    const char *paths[5] = {NULL};
    int n = 0;
    for (const struct key *k = keys_table; k->path && n < 4; k++) {
        const char *last = strrchr(k->path, '.');
        if (allowed(w, k) && last && strcmp(last + 1, word) == 0) paths[n++] = k->path;
    }
    for (const struct key_knob *k = keys_knobs; k->name && n < 4; k++)
        if (strcmp(k->name, word) == 0) paths[n++] = arena_format(w->y->arena, "accuracy.%s", word);
    return n ? joined(w->y->arena, paths, " or ") : NULL;
}

/* Keys that scenes once had, and what took their place. */
static const char *former(const char *section, const char *word)
{
    static const struct {
        const char *section, *word, *cure;
    } all[] = {{"contact.roll", "static_depth",
                "it is gone: the stiffness follows from both materials and the ground's roughness; remove it, or give "
                "contact.roll.static_penetration, a length"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (strcmp(section, all[i].section) == 0 && strcmp(word, all[i].word) == 0) return all[i].cure;
    return NULL;
}

static const char *unknown_cure(const struct walk *w, const char *word, const char *section)
{
    if (former(section, word)) return former(section, word);
    const char *const *names = names_in(w, section);
    const char *near = text_nearest(word, names), *other = elsewhere(w, word);
    struct arena *a = w->y->arena;
    if (strchr(word, ':')) return "put a space after the colon";
    if (other) return arena_format(a, "'%s' belongs elsewhere: %s", word, other);
    if (near) return arena_format(a, "did you mean '%s'?", near);
    return arena_format(a, "keys here: %s", joined(a, names, ", "));
}

static void unknown(const struct walk *w, const struct yaml_node *key, const char *section)
{
    struct diag *d = w->y->diag;
    if (d->n >= DIAG_STORED) {
        d->n++;
        return;
    }
    bool top = !*section && !*w->prefix;
    const char *place = *section ? arena_format(d->arena, "%s%s", w->prefix, section)
                                 : arena_format(d->arena, "%.*s", (int)strlen(w->prefix) - !top, w->prefix);
    diag_add(d, key->at, unknown_cure(w, key->text, section), "unknown key '%s'%s%s", diag_shown(d, key->text),
             top ? "" : " in ", place);
}

static void misplaced(const struct walk *w, const struct yaml_node *key, const struct key *k)
{
    struct diag *d = w->y->diag;
    if (k->of == KEY_CONTACT)
        diag_add(d, key->at,
                 arena_format(d->arena,
                              "move it into an entry of contacts (--set contacts.NAME.%s=...), or remove contacts",
                              key->text),
                 "'%s' describes one contact and must not stand beside contacts", key->text);
    else
        diag_add(d, key->at, "move it to the top level", "'%s' belongs to the whole scene, not to one contact",
                 key->text);
}

static void walk_map(const struct walk *w, const struct yaml_node *map, const char *section)
{
    for (const struct yaml_node *item = map->first; item; item = item->next) {
        const struct key *k;
        char path[DEEP_MAX];
        int n = snprintf(path, sizeof path, "%s%s%s", section, *section ? "." : "", item->key->text);
        enum role role =
            n < DEEP_MAX && *item->key->text && !strchr(item->key->text, '.') ? role_of(path, &k) : ROLE_NONE;
        if (!*section && is_top_name(w, item->key->text)) continue;
        if (role == ROLE_NONE)
            unknown(w, item->key, section);
        else if (!allowed(w, k))
            misplaced(w, item->key, k);
        else if (role == ROLE_SECTION && item->kind == YAML_MAP)
            walk_map(w, item, path);
        else if (role == ROLE_SECTION)
            diag_add(w->y->diag, item->at,
                     arena_format(w->y->arena, "keys here: %s", joined(w->y->arena, names_in(w, path), ", ")),
                     "%s%s must be a map of keys, not %s", w->prefix, path, scene_values_kind(w->y, item));
    }
}

void scene_keys_check(struct yaml *y, const struct yaml_node *map, enum scene_keys_where where, const char *prefix)
{
    struct walk w = {y, where, prefix};
    walk_map(&w, map, "");
}
