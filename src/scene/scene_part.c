/* A part of a scene: names and places of what it holds, unknown keys, and its struct filled: see scene_part.h. */
#include "scene/scene_part.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "scene/keys.h"
#include "scene/keys_text.h"
#include "scene/scene.h"
#include "scene/scene_merge.h"
#include "scene/scene_values.h"

const char *scene_part_label(const struct scene_part *p, const char *path)
{
    return arena_format(p->yaml->arena, "%s%s", p->prefix, path);
}

const char *scene_part_contact(const struct scene_part *p, const char *name)
{
    return *p->prefix && name ? arena_format(p->yaml->arena, "contact '%s'", diag_shown(p->yaml->diag, name))
                              : "the contact";
}

struct diag_place scene_part_place(const struct scene_part *p, const struct yaml_node *map)
{
    if (map->key) return map->key->at;
    if (*p->prefix) return map->at;
    const struct yaml_node *first = map->first; /* not a comment above it */
    bool here = first && first->key->at.source == map->at.source;
    return (struct diag_place){map->at.source, here ? first->key->at.line : 1, 1, 0};
}

/* Was a laid down before b? An included file's keys before the including file's, those before the command line's. */
static bool laid_before(const struct diag_place *a, const struct diag_place *b)
{
    const struct diag_source *of_a = a->source, *of_b = b->source;
    if (of_a == of_b) return a->line != b->line ? a->line < b->line : a->column < b->column;
    if (of_a->option != of_b->option) return of_b->option;
    return of_a->option == (of_a->order < of_b->order);
}

struct diag_place scene_part_later(const struct scene_part *p, const char *path, const char *other)
{
    const struct yaml_node *a = yaml_find(p->map, path), *b = yaml_find(p->map, other);
    const struct yaml_node *node = !a ? b : !b ? a : laid_before(&a->at, &b->at) ? b : a;
    return node ? node->at : scene_part_place(p, p->map);
}

void scene_part_contradiction(const struct scene_part *p, const char *path, const char *other, const char *says,
                              const char *cure)
{
    const struct yaml_node *a = yaml_find(p->map, path), *b = yaml_find(p->map, other);
    diag_add(p->yaml->diag, scene_part_later(p, path, other), cure, "%s %s %s%s", scene_part_label(p, path), says,
             scene_part_label(p, other), a && b ? "" : " (the other is the default; give both)");
}

bool scene_part_known(const struct scene_part *p, const char *path)
{
    const struct key *k = keys_find(path);
    const struct yaml_node *node = yaml_find(p->map, path);
    if (!node) return k->standard != NULL;
    for (const struct choice *c = k->choices; c->word; c++)
        if (node->kind == YAML_SCALAR && strcmp(c->word, node->text) == 0) return true;
    return false;
}

bool scene_part_given(const struct scene_part *p, const char *path) { return yaml_find(p->map, path) != NULL; }

void scene_part_refuse(const struct scene_part *p, const char *path, const char *other, const char *cure,
                       const char *format, ...)
{
    char says[1024];
    va_list ap;
    va_start(ap, format);
    vsnprintf(says, sizeof says, format, ap);
    va_end(ap);
    diag_add(p->yaml->diag, scene_part_later(p, path, other), cure, "%s%s", scene_part_label(p, path), says);
}

/* ------------------------------------------------------------------ unknown keys */

enum { NAMES_MAX = 64, DEEP_MAX = 256 };

static const char *const top_names[] = {"include", "contacts", "materials", "accuracy", "inputs", NULL};

struct walk {
    struct yaml *y;
    enum scene_part_where where;
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
    return w->where == SCENE_PART_SINGLE || (k->of == KEY_CONTACT) == (w->where == SCENE_PART_ENTRY);
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
        if (!text_is_one(name, names)) names[n++] = name;
    }
    for (int i = 0; !*section && w->where != SCENE_PART_ENTRY && top_names[i]; i++)
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

/* The name that is meant: one of nearly the same letters, or what people call otherwise. */
static const char *meant(const char *word, const char *const *names)
{
    static const char *const otherwise[][2] = {{"frequency", "rate"}, {"freq", "rate"},
                                               {"velocity", "speed"}, {"time", "duration"},
                                               {"loudness", "lufs"},  {"samplerate", "sample_rate"},
                                               {"amplitude", "rms"},  {"weight", "mass"}};
    const char *near = text_nearest(word, names);
    for (size_t i = 0; !near && i < sizeof otherwise / sizeof *otherwise; i++)
        if (!strcmp(otherwise[i][0], word) && text_is_one(otherwise[i][1], names)) near = otherwise[i][1];
    return near;
}

static void unknown(const struct walk *w, const struct yaml_node *key, const char *section)
{
    struct diag *d = w->y->diag;
    if (d->n >= DIAG_STORED) {
        d->n++;
        return;
    }
    const char *const *names = names_in(w, section);
    const char *word = key->text, *near = meant(word, names), *paths[5] = {NULL};
    int n = 0; /* full paths of keys whose last part is the word */
    for (const struct key *k = keys_table; k->path && n < 4; k++) {
        const char *last = strrchr(k->path, '.');
        if (allowed(w, k) && last && strcmp(last + 1, word) == 0) paths[n++] = k->path;
    }
    for (const struct key_knob *k = keys_knobs; k->name && n < 4; k++)
        if (strcmp(k->name, word) == 0) paths[n++] = arena_format(d->arena, "accuracy.%s", word);
    const char *cure = keys_former(arena_format(d->arena, "%s.%s", section, word), "");
    if (!cure && strchr(word, ':'))
        cure = "put a space after the colon";
    else if (!cure && n)
        cure = arena_format(d->arena, "'%s' belongs elsewhere: %s", word, joined(d->arena, paths, " or "));
    else if (!cure && near)
        cure = arena_format(d->arena, "did you mean '%s'?", near);
    else if (!cure)
        cure = arena_format(d->arena, "keys here: %s", joined(d->arena, names, ", "));
    bool top = !*section && !*w->prefix;
    const char *place = *section ? arena_format(d->arena, "%s%s", w->prefix, section)
                                 : arena_format(d->arena, "%.*s", (int)strlen(w->prefix) - !top, w->prefix);
    diag_add(d, key->at, cure, "unknown key '%s'%s%s", diag_shown(d, word), top ? "" : " in ", place);
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

/* Of what stands where a map of keys belongs. */
static const char *map_cure(const struct walk *w, const char *path, const struct yaml_node *item)
{
    const char *const *names = names_in(w, path);
    for (const char *const *name = names; item->kind == YAML_SCALAR && *name; name++) {
        size_t n = strlen(*name);
        if (strncmp(item->text, *name, n) != 0 || (item->text[n] != ' ' && item->text[n] != ':')) continue;
        return arena_format(w->y->arena, "write: %s: %s, with a colon and a space", *name,
                            item->text + n + 1 + strspn(item->text + n + 1, ": "));
    }
    bool empty = item->kind == YAML_SCALAR && item->plain && !*item->text;
    return arena_format(w->y->arena, empty ? "indent the keys that belong to it: %s" : "keys here: %s",
                        joined(w->y->arena, names, ", "));
}

static void walk_map(const struct walk *w, const struct yaml_node *map, const char *section)
{
    for (const struct yaml_node *item = map->first; item; item = item->next) {
        const struct key *k = keys_table;
        char path[DEEP_MAX];
        int n = snprintf(path, sizeof path, "%s%s%s", section, *section ? "." : "", item->key->text);
        bool may_be = n < DEEP_MAX && *item->key->text && !strchr(item->key->text, '.');
        while (may_be && k->path && strcmp(k->path, path) != 0 && !under(k->path, path))
            k++;
        bool is_section = may_be && k->path && strcmp(k->path, path) != 0;
        if (!*section && w->where != SCENE_PART_ENTRY && text_is_one(item->key->text, top_names)) continue;
        if (!may_be || !k->path)
            unknown(w, item->key, section);
        else if (!allowed(w, k))
            misplaced(w, item->key, k);
        else if (is_section && item->kind == YAML_MAP)
            walk_map(w, item, path);
        else if (is_section)
            diag_add(w->y->diag, item->at, map_cure(w, path, item), "%s%s must be a map of keys, not %s", w->prefix,
                     path, scene_values_kind(w->y, item));
    }
}

void scene_part_names(struct yaml *y, const struct yaml_node *map, enum scene_part_where where, const char *prefix)
{
    struct walk w = {y, where, prefix};
    walk_map(&w, map, "");
}

enum applies { APPLIES_NO, APPLIES_YES, APPLIES_UNKNOWN };

/* ------------------------------------------------------------------ does a key apply? */

/* Unknown: the value that decides it is itself in error, or may stand in a file that is not there. */
static enum applies applies(const struct scene_part *p, const struct key *k)
{
    const struct key *decides = keys_decider(k);
    if (!decides) return APPLIES_YES;
    const struct yaml_node *node = yaml_find(p->map, decides->path);
    if (k->applies[0] == '!' && applies(p, decides) == APPLIES_NO) return APPLIES_NO;
    if (!keys_words(k))
        return !node && p->yaml->missing              ? APPLIES_UNKNOWN
               : keys_applies_beside(k, node != NULL) ? APPLIES_YES
                                                      : APPLIES_NO;
    if (applies(p, decides) != APPLIES_YES) return applies(p, decides);
    if (!node && (!decides->standard || p->yaml->missing)) return APPLIES_UNKNOWN;
    int i = node ? scene_values_choice(decides->choices, node) : -1;
    if (node && i < 0) return APPLIES_UNKNOWN;
    return keys_applies_with(k, node ? decides->choices[i].word : decides->standard) ? APPLIES_YES : APPLIES_NO;
}

/* A ball's keys are called as a scraper's: of a key of one that is meant for the other, the line that says so; "" of
 * all else. */
static const char *twin(const struct scene_part *p, const struct key *k)
{
    static const char *const bodies[2] = {"scraper", "ball"};
    for (int i = 0; i < 2; i++) {
        size_t n = strlen(bodies[i]);
        const char *other = strncmp(k->path, bodies[i], n) || k->path[n] != '.'
                                ? NULL
                                : arena_format(p->yaml->arena, "%s%s", bodies[!i], k->path + n);
        if (other && keys_find(other) && applies(p, keys_find(other)) == APPLIES_YES)
            return arena_format(p->yaml->arena, "%s is called %s here; or ", scene_part_label(p, k->path), other);
    }
    return "";
}

static void not_applicable(const struct scene_part *p, const struct key *k, const struct yaml_node *node)
{
    struct arena *a = p->yaml->arena;
    const struct key *bar = k; /* of the chain of those that decide it, the one whose own decider has the wrong value */
    while ((keys_words(bar) || bar->applies[0] == '!') && applies(p, keys_decider(bar)) == APPLIES_NO)
        bar = keys_decider(bar);
    const char *label = scene_part_label(p, k->path), *other = scene_part_label(p, keys_decider(bar)->path), *cure;
    const struct yaml_node *now = yaml_find(p->map, keys_decider(bar)->path);
    const char *when = keys_words(bar) ? arena_format(a, "where %s is %s", other, keys_text_words(bar, a))
                       : now           ? arena_format(a, "where %s is not given", other)
                                       : arena_format(a, "beside %s", other);
    if (keys_words(bar))
        cure = arena_format(a, "%sremove it, or set %s to %s (now it is %s)", twin(p, k), other,
                            keys_text_words(bar, a), now ? now->text : keys_decider(bar)->standard);
    else
        cure = now ? arena_format(a, "remove it (a null takes away what another file says), or remove %s", other)
                   : arena_format(a, "remove it, or give %s", other);
    diag_add(p->yaml->diag, node->key->at, cure, "%s applies only %s", label, when);
}

/* ------------------------------------------------------------------ what is missing */

/* The innermost map on the way to the path; NULL: something that is not a map is in the way (and reported elsewhere).
   */
static const struct yaml_node *innermost(const struct scene_part *p, const char *path, const char **rest)
{
    const struct yaml_node *at = p->map;
    *rest = path;
    for (const char *dot = strchr(path, '.'); dot; dot = strchr(dot + 1, '.')) {
        const struct yaml_node *next = yaml_find(p->map, arena_format(p->yaml->arena, "%.*s", (int)(dot - path), path));
        if (!next) break;
        if (next->kind != YAML_MAP) return NULL;
        at = next;
        *rest = dot + 1;
    }
    return at;
}

bool scene_part_misspelt(const struct scene_part *p, const char *path)
{
    const char *rest;
    const struct yaml_node *map = innermost(p, path, &rest);
    const char *const wanted[] = {arena_format(p->yaml->arena, "%.*s", (int)strcspn(rest, "."), rest), NULL};
    for (const struct yaml_node *item = map ? map->first : NULL; item; item = item->next) {
        const char *word = item->key->text,
                   *full = arena_format(p->yaml->arena, "%.*s%s", (int)(rest - path), path, word);
        const struct key *k = keys_table;
        while (k->path && strcmp(k->path, full) != 0 && !under(k->path, full))
            k++;
        if (!k->path && meant(word, wanted)) return true;
    }
    return false;
}

/* "add for instance: rate: 2 Hz", or "motion: {rate: 2 Hz}" where there is no motion yet. */
static const char *add_cure(const struct scene_part *p, const char *rest, const char *value)
{
    const char *line = value;
    char path[128];
    snprintf(path, sizeof path, "%s", rest);
    for (char *dot = strrchr(path, '.'); dot; dot = strrchr(path, '.')) {
        line = arena_format(p->yaml->arena, "{%s: %s}", dot + 1, line);
        *dot = '\0';
    }
    return arena_format(p->yaml->arena, "add for instance: %s: %s", path, line);
}

static const char *example_of(const struct scene_part *p, const char *path)
{
    const struct key *k = keys_find(path);
    return k ? scene_values_example(p->yaml, k) : "{}";
}

void scene_part_missing(const struct scene_part *p, const char *path, const char *value, const char *because)
{
    const char *rest;
    const struct yaml_node *map = innermost(p, path, &rest);
    if (map && !p->yaml->missing && !yaml_find(p->map, path) && !scene_part_misspelt(p, path))
        diag_add(p->yaml->diag, scene_part_place(p, map), add_cure(p, rest, value), "%s is missing%s",
                 scene_part_label(p, path), because);
}

static void missing(const struct scene_part *p, const char *path)
{
    scene_part_missing(p, path, example_of(p, path), "");
}

/* ------------------------------------------------------------------ keys */

/* ------------------------------------------------------------------ alternatives */

static void both_given(const struct scene_part *p, const struct yaml_node *const nodes[2], const char *const names[2])
{
    bool swap = laid_before(&nodes[1]->key->at, &nodes[0]->key->at);
    const struct yaml_node *first = nodes[swap], *second = nodes[!swap];
    const struct diag_source *other = first->key->at.source;
    struct arena *a = p->yaml->arena;
    const char *label = scene_part_label(p, names[swap]), *where = other->name;
    if (!other->option) where = arena_format(a, "%s line %d", where, first->key->at.line);
    const char *cure = arena_format(a, "%s stands in %s; remove one of them", label, where);
    diag_add(p->yaml->diag, second->key->at, cure, "%s and %s exclude each other", scene_part_label(p, names[!swap]),
             label);
}

/* The alternatives that could be given, in words. */
static void none_given(const struct scene_part *p, const char *const *candidates, int n)
{
    const char *rest, *all = "";
    for (int i = 0; i < n; i++)
        if (scene_part_misspelt(p, candidates[i])) return;
    const struct yaml_node *map = innermost(p, candidates[0], &rest);
    if (n == 1) {
        missing(p, candidates[0]);
        return;
    }
    for (int i = 0; i < n; i++)
        all = arena_format(p->yaml->arena, "%s%s%s", all,
                           i == 0       ? ""
                           : i == n - 1 ? " or "
                                        : ", ",
                           scene_part_label(p, candidates[i]));
    if (map && !p->yaml->missing)
        diag_add(p->yaml->diag, scene_part_place(p, map), add_cure(p, rest, example_of(p, candidates[0])),
                 "%s must be given", all);
}

static void alternative_check(const struct scene_part *p, const struct key_alternative *alternative)
{
    const char *candidates[KEYS_RIVALS], *given[2] = {NULL, NULL};
    const struct yaml_node *nodes[2] = {NULL, NULL};
    const struct key condition = keys_condition(alternative);
    int n = 0, n_given = 0;
    if (applies(p, &condition) != APPLIES_YES) return;
    for (int i = 0; alternative->paths[i]; i++) {
        const char *path = alternative->paths[i];
        const struct key *k = keys_find(path);
        enum applies a = k ? applies(p, k) : APPLIES_YES;
        const struct yaml_node *node = yaml_find(p->map, path);
        if (a == APPLIES_UNKNOWN) return;
        if (a == APPLIES_YES) candidates[n++] = path;
        if (!node || a == APPLIES_NO) continue;
        nodes[n_given > 0] = node;
        given[n_given > 0] = path;
        if (++n_given > alternative->most) both_given(p, nodes, given);
    }
    if (n_given < alternative->least && n > 0) none_given(p, candidates, n);
}

/* Of alternatives that two texts give (a scene and what it includes, a design, the command line) the one that is laid
   later takes the others' place. Within one text they contradict each other, and both stay. */
static void alternative_settle(const struct scene_part *p, const struct key_alternative *alternative)
{
    const struct key condition = keys_condition(alternative);
    struct yaml_node *given[KEYS_RIVALS], *last = NULL;
    int n = 0;
    if (alternative->most != 1 || applies(p, &condition) != APPLIES_YES) return;
    for (int i = 0; alternative->paths[i]; i++) {
        const struct key *k = keys_find(alternative->paths[i]);
        struct yaml_node *node = yaml_find(p->map, alternative->paths[i]);
        if (!node || (k && applies(p, k) != APPLIES_YES)) continue;
        if (!last || laid_before(&last->key->at, &node->key->at)) last = node;
        given[n++] = node;
    }
    for (int i = 0; i < n; i++)
        if (given[i]->key->at.source != last->key->at.source) {
            given[i]->kind = YAML_SCALAR;
            given[i]->plain = true;
            given[i]->text = "null";
        }
}

static bool is_mine(const struct scene_part *p, const struct key_alternative *alternative)
{
    const struct key *k = keys_find(alternative->paths[0]);
    bool mine = k && k->of == p->of;
    for (const struct key_section *s = keys_sections; !k && s->path; s++)
        mine = mine || (strcmp(s->path, alternative->paths[0]) == 0 && s->of == p->of);
    return mine;
}

void scene_part_fill(const struct scene_part *p)
{
    for (const struct key_alternative *x = keys_alternatives; x->paths[0]; x++)
        if (is_mine(p, x)) alternative_settle(p, x);
    scene_merge_drop_nulls(p->map);
    for (const struct key *k = keys_table; k->path; k++) {
        if (k->of != p->of) continue;
        const struct yaml_node *node = yaml_find(p->map, k->path);
        enum applies a = applies(p, k);
        scene_values_clear(p, k);
        if (node && a == APPLIES_NO)
            not_applicable(p, k, node);
        else if (node)
            scene_values_read(p, k, node);
        else if (a == APPLIES_YES && k->standard)
            scene_values_default(p, k);
        else if (a == APPLIES_YES) {
            bool absent = false; /* is a section that it is in? */
            for (const struct key_section *s = keys_sections; s->path; s++)
                absent = absent || (under(k->path, s->path) && !yaml_find(p->map, s->path));
            if (!absent) missing(p, k->path);
        }
    }
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (s->of == p->of) *keys_given(s, p->to) = yaml_find(p->map, s->path) != NULL;
    for (const struct key_alternative *x = keys_alternatives; x->paths[0]; x++)
        if (is_mine(p, x)) alternative_check(p, x);
}
