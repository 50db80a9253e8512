/* See scene_places.h. What reads a file knows its path and not who named it, and begins its messages with the path (after "contact 'rod': ", say): so the
   longest path of a key that stands at the beginning of a part of the text, between colons, is what the error is about; also that of a folder, of a file in it. */
#include "scene/scene_places.h"

#include <string.h>

static const char *value_of(const struct scene_part *p, const struct key *k)
{
    return k->type == KEY_FILE ? *(const char **)((char *)p->to + k->offset) : NULL;
}

static struct scene_place **add(const struct scene_part *p, const struct scene_place *what, const struct diag_place *at, struct scene_place **last)
{
    *last = ARENA_TAKE(p->yaml->arena, struct scene_place, 1);
    **last = *what;
    (*last)->label = scene_part_label(p, what->key);
    (*last)->file = at->source->name;
    (*last)->line = at->source->option ? 0 : at->line;
    (*last)->column = at->column;
    return &(*last)->next;
}

void scene_places_note(const struct scene_part *p, const char *contact, struct scene *s)
{
    struct scene_place **last = &s->places;
    while (*last)
        last = &(*last)->next;
    for (const struct key *k = keys_table; k->path; k++) {
        const struct yaml_node *node = k->of == p->of ? yaml_find(p->map, k->path) : NULL;
        if (node && node->at.source)
            last = add(p, &(struct scene_place){.contact = contact, .key = k->path, .value = value_of(p, k)}, &node->at, last);
    }
    for (const struct key_section *k = keys_sections; k->path; k++) {
        const struct yaml_node *node = k->of == p->of ? yaml_find(p->map, k->path) : NULL;
        if (node && node->key && node->key->at.source)
            last = add(p, &(struct scene_place){.contact = contact, .key = k->path}, &node->key->at, last);
    }
}

static bool same(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

static const struct scene_place *find(const struct scene *s, const char *contact, const char *key)
{
    for (const struct scene_place *p = s->places; p; p = p->next)
        if (same(p->contact, contact) && same(p->key, key))
            return p;
    return NULL;
}

/* Does the text, or a part of it after ": ", begin with the path? */
static bool begins(const char *text, const char *path)
{
    size_t n = strlen(path);
    for (const char *at = strstr(text, path); at; at = strstr(at + 1, path))
        if ((at == text || (at >= text + 2 && at[-1] == ' ' && at[-2] == ':')) && (!at[n] || strchr(": ,/", at[n])))
            return true;
    return false;
}

static const struct scene_place *named(const struct scene *s, const char *text)
{
    const struct scene_place *best = NULL;
    for (const struct scene_place *p = s->places; p; p = p->next)
        if (p->value && begins(text, p->value) && (!best || strlen(p->value) > strlen(best->value)))
            best = p;
    return best;
}

static const char *place_text(const struct scene *s, const struct scene_place *p, struct arena *a)
{
    if (!p)
        return s->file;
    const char *where = p->line > 0 ? arena_format(a, "%s:%d:%d", p->file, p->line, p->column) : p->file;
    return strcmp(p->file, s->file) == 0 ? where : arena_format(a, "%s: %s", s->file, where);
}

const char *scene_places_text(const struct scene *s, const char *contact, const char *key, struct arena *a)
{
    return place_text(s, find(s, contact, key), a);
}

bool scene_places_tell(const struct scene *s, struct err *e)
{
    struct arena *a = arena_open();
    const struct scene_place *p = e->key ? find(s, e->contact, e->key) : named(s, e->text);
    const char *place = place_text(s, p, a);
    if (p && !strstr(e->text, p->key) && !strstr(place, p->key))
        err_at(e, "%s", p->label);
    err_at(e, "%s", place);
    arena_close(a);
    return false;
}
