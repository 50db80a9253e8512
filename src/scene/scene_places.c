/* See scene_places.h. What reads a file knows its path and not who named it, and begins its messages with the path
   (after "contact 'rod': ", say): so the longest path of a key that stands at the beginning of a part of the text,
   between colons, is what the error is about; also that of a folder, of a file in it. Stages begin theirs with a
   contact's name and a key: "contact 'rod': surface.moving: ...". */
#include "scene/scene_places.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"

enum { KEY_MAX = 128 };

/* ------------------------------------------------------------------ noting */

struct list {
    struct yaml *yaml;
    const char *contact, *prefix;
    struct scene_place **end;
};

static struct list list_of(struct yaml *y, struct scene *s)
{
    struct list l = {.yaml = y, .prefix = "", .end = &s->places};
    while (*l.end)
        l.end = &(*l.end)->next;
    return l;
}

static struct scene_place *place_make(const struct diag_place *at, struct arena *a)
{
    struct scene_place *p = ARENA_TAKE(a, struct scene_place, 1);
    *p = (struct scene_place){.file = at->source->name,
                              .named = diag_named(a, at->source),
                              .column = at->column,
                              .width = at->width,
                              .line = at->source->option || at->source->made ? 0 : at->line};
    return p;
}

static void add(struct list *l, const char *key, const char *file, const struct diag_place *at)
{
    struct arena *a = l->yaml->arena;
    struct scene_place *p = place_make(at, a);
    p->contact = l->contact;
    p->key = key;
    p->label = arena_format(a, "%s%s", l->prefix, key);
    p->value = file ? text_shown(a, file) : NULL;
    *l->end = p;
    l->end = &p->next;
}

static bool in_same_map(const struct key *k, const char *path, size_t n)
{
    return k && strncmp(k->path, path, n) == 0 && k->path[n] == '.';
}

void scene_places_note(const struct scene_part *p, const char *contact, struct scene *s)
{
    struct list l = list_of(p->yaml, s);
    const struct key *before = NULL;
    l.contact = contact;
    l.prefix = p->prefix;
    for (const struct key *k = keys_table; k->path; k++) {
        if (k->of != p->of) continue;
        const struct yaml_node *node = yaml_find(p->map, k->path);
        for (const char *dot = strchr(k->path, '.'); dot; dot = strchr(dot + 1, '.')) {
            size_t n = (size_t)(dot - k->path);
            if (in_same_map(before, k->path, n)) continue; /* its map is in the list already */
            const char *path = arena_format(p->yaml->arena, "%.*s", (int)n, k->path);
            const struct yaml_node *map = yaml_find(p->map, path);
            if (map && map->key && map->key->at.source) add(&l, path, NULL, &map->key->at);
        }
        if (node && node->at.source)
            add(&l, k->path, k->type == KEY_FILE ? *(const char **)keys_field(k, p->to) : NULL, &node->at);
        before = k;
    }
}

void scene_places_key(struct yaml *y, const char *key, const struct diag_place *at, struct scene *s)
{
    struct list l = list_of(y, s);
    add(&l, key, NULL, at);
}

void scene_places_move(struct scene *s, const char *key, const char *label, const struct diag_place *at,
                       struct arena *a)
{
    size_t n = strlen(key);
    struct scene_place **end = &s->places;
    while (*end)
        if (!(*end)->contact && strncmp((*end)->key, key, n) == 0 && (!(*end)->key[n] || (*end)->key[n] == '.'))
            *end = (*end)->next;
        else
            end = &(*end)->next;
    *end = place_make(at, a);
    (*end)->key = key;
    (*end)->label = label;
}

void scene_places_input(struct yaml *y, const char *file, const struct diag_place *at, struct scene *s)
{
    struct list l = list_of(y, s);
    add(&l, "inputs", file, at);
}

/* ------------------------------------------------------------------ finding */

static bool same(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

/* Does the text, or a part of it after ": ", begin with the path? */
static bool begins(const char *text, const char *path)
{
    size_t n = strlen(path);
    for (const char *at = strstr(text, path); at; at = strstr(at + 1, path))
        if ((at == text || (at >= text + 2 && at[-1] == ' ' && at[-2] == ':')) && (!at[n] || strchr(": ,/", at[n])))
            return true;
    return false;
}

/* A key's place; of several (inputs), that of the file with which the text begins. */
static const struct scene_place *find(const struct scene *s, const char *contact, const char *key, const char *text)
{
    const struct scene_place *first = NULL;
    for (const struct scene_place *p = s->places; p; p = p->next) {
        if (!same(p->contact, contact) || strcmp(p->key, key) != 0) continue;
        if (text && p->value && begins(text, p->value)) return p;
        first = first ? first : p;
    }
    return first;
}

const struct scene_place *scene_places_find(const struct scene *s, const char *contact, const char *key,
                                            const char *file)
{
    char shown[sizeof((struct err *)0)->text];
    text_show(file, shown, sizeof shown);
    return find(s, contact, key, shown);
}

/* Of a key that is not given, the place of the section in which it would stand. */
static const struct scene_place *nearest(const struct scene *s, const char *contact, const char *key, const char *text)
{
    const struct scene_place *p = find(s, contact, key, text);
    char path[KEY_MAX];
    snprintf(path, sizeof path, "%s", key);
    for (char *dot = strrchr(path, '.'); dot && !p; dot = strrchr(path, '.')) {
        *dot = '\0';
        p = find(s, contact, path, NULL);
    }
    return p;
}

/* Of "contact 'NAME': rest" the contact, and the rest; NULL: it does not begin so. */
static const struct contact *contact_of(const struct scene *s, const char *text, const char **rest)
{
    static const char head[] = "contact '";
    size_t m = strlen(head);
    *rest = text;
    if (strncmp(text, head, m) != 0) return NULL;
    for (int i = 0; i < s->n_contacts; i++) {
        const char *name = s->contacts[i].name;
        size_t n = name ? strlen(name) : 0;
        if (name && strncmp(text + m, name, n) == 0 && strncmp(text + m + n, "': ", 3) == 0) {
            *rest = text + m + n + 3;
            return &s->contacts[i];
        }
    }
    return NULL;
}

/* The key, or section, with whose name the text begins, into path; "": there is none. Of whom it is, is what is
   returned. A word without a dot may be any word ("contact 'rod', ..."), unless a colon follows. */
static enum key_struct leading_key(const char *text, char path[KEY_MAX])
{
    size_t n = strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_.");
    bool may_be = n < KEY_MAX && (text[n] == ':' || memchr(text, '.', n));
    snprintf(path, KEY_MAX, "%.*s", may_be ? (int)n : 0, text);
    for (const struct key *k = keys_table; k->path && *path; k++)
        if (strcmp(k->path, path) == 0 || in_same_map(k, path, strlen(path))) return k->of;
    *path = '\0';
    return KEY_SCENE;
}

/* What the text itself says that it is about: its file, or its key. */
static const struct scene_place *by_text(const struct scene *s, const char *text)
{
    const char *rest;
    char path[KEY_MAX];
    const struct contact *c = contact_of(s, text, &rest);
    const struct scene_place *file = NULL;
    for (const struct scene_place *p = s->places; p; p = p->next)
        if (p->value && begins(text, p->value) && (!file || strlen(p->value) > strlen(file->value))) file = p;
    bool contacts = leading_key(rest, path) == KEY_CONTACT;
    if (file || !*path) return file;
    c = c || s->n_contacts != 1 ? c : s->contacts;
    return contacts && !c ? NULL : nearest(s, contacts ? c->name : NULL, path, text);
}

/* The first key that stands anywhere in the text and is given; else the section of the first that is not. */
static const struct scene_place *by_mention(const struct scene *s, const struct contact *c, const char *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789_.";
    const struct scene_place *section = NULL;
    char path[KEY_MAX];
    for (size_t n; *text; text += n + (text[n] != '\0')) {
        n = strspn(text, letters);
        enum key_struct of = leading_key(text, path);
        if (!*path || (of == KEY_CONTACT && !c)) continue;
        const char *name = of == KEY_CONTACT ? c->name : NULL;
        const struct scene_place *p = find(s, name, path, NULL);
        if (p) return p;
        section = section ? section : nearest(s, name, path, NULL);
    }
    return section;
}

/* No refusal of a scene is without a place: the key that the code says, the file or key that the text begins with, one
 * that the text names, or the contact. */
static const struct scene_place *place_of(const struct scene *s, const struct err *e)
{
    const char *rest;
    const struct contact *c = contact_of(s, e->text, &rest);
    const struct scene_place *p = e->key ? nearest(s, e->contact, e->key, e->text) : by_text(s, e->text);
    c = c || s->n_contacts != 1 ? c : s->contacts;
    if (!p && e->kind == ERR_SCENE) p = by_mention(s, c, e->text);
    if (p || e->kind != ERR_SCENE) return p;
    static const char *const sections[] = {"contact", "motion", "surface", NULL}; /* every scene says what it is */
    for (int i = 0; c && !p && sections[i]; i++)
        p = find(s, c->name, sections[i], NULL);
    return p ? p : s->places;
}

/* ------------------------------------------------------------------ telling */

const char *scene_places_text(const struct scene *s, const struct scene_place *p, struct arena *a)
{
    if (!p) return s->file;
    const char *where = p->line > 0 ? arena_format(a, "%s:%d:%d", p->file, p->line, p->column) : p->file;
    return p->line > 0 || strcmp(p->file, s->file) == 0 ? where : arena_format(a, "%s: %s", s->file, where);
}

/* Of a scene with contacts: "contacts.rod.surface.moving: ..." for "contact 'rod': surface.moving: ...". */
static const char *whole_keys(const struct scene *s, const char *contact, const char *text, struct arena *a)
{
    char path[KEY_MAX];
    const char *rest;
    const struct contact *c = contact_of(s, text, &rest);
    const struct scene_place *p = s->places; /* one of that contact, which says what stands before its keys */
    contact = c ? c->name : contact;
    while (contact && p && !same(p->contact, contact))
        p = p->next;
    if (!contact || !p || leading_key(rest, path) != KEY_CONTACT || !*path || !strcmp(p->label, p->key)) return text;
    return arena_format(a, "%.*s%s", (int)(strlen(p->label) - strlen(p->key)), p->label, rest);
}

bool scene_places_report(const struct scene *s, struct err *e)
{
    struct arena *a = arena_open();
    struct err placed = {.contact = e->contact, .key = e->key};
    const struct scene_place *p = place_of(s, e), *in_text = e->key ? p : by_text(s, e->text);
    const char *place = scene_places_text(s, p, a), *text = whole_keys(s, p ? p->contact : e->contact, e->text, a);
    if (p && p == in_text && (!e->key || strcmp(p->key, e->key) == 0) && !strstr(text, p->label)) {
        const char *rest = text; /* the key that it is about goes before a text that does not name it */
        if (strcmp(p->label, p->key) != 0) contact_of(s, text, &rest);
        text = arena_format(a, "%s: %s", p->label, rest);
    }
    bool lines = p && p->line > 0;
    char shown[sizeof e->text];
    text_show(lines ? p->file : s->file, shown, sizeof shown);
    placed.place = (struct err_place){.file = (int)strlen(shown), .message = (int)strlen(shown) + 2};
    if (lines) {
        text_show(place, shown, sizeof shown);
        placed.place.message = (int)strlen(shown) + 2;
        placed.place.line = p->line, placed.place.column = p->column, placed.place.width = p->width;
    }
    err_set(&placed, e->kind, "%s: %s%s", place, text, p && !strstr(text, p->named) ? p->named : "");
    *e = placed;
    arena_close(a);
    return false;
}
