/* Missing keys, keys that do not apply, alternatives: see scene_check.h. */
#include "scene/scene_check.h"

#include <stdio.h>
#include <string.h>

#include "scene/keys_text.h"
#include "scene/scene.h"
#include "scene/scene_example.h"
#include "scene/scene_values.h"

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

/* Of a key that does not apply and those that decide it, in a chain: the one whose own decider has the wrong value. */
static const struct key *barred(const struct scene_part *p, const struct key *k)
{
    while ((keys_words(k) || k->applies[0] == '!') && applies(p, keys_decider(k)) == APPLIES_NO)
        k = keys_decider(k);
    return k;
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
    const struct key *bar = barred(p, k);
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

/* The innermost map on the way to the path; NULL: something that is not a map is in the way (and told elsewhere). */
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

/* "rate: 2 Hz", or "motion: {rate: 2 Hz}" where there is no motion yet. */
static const char *line_for(const struct scene_part *p, const char *rest, const char *value)
{
    const char *line = value;
    char path[128];
    snprintf(path, sizeof path, "%s", rest);
    for (char *dot = strrchr(path, '.'); dot; dot = strrchr(path, '.')) {
        line = arena_format(p->yaml->arena, "{%s: %s}", dot + 1, line);
        *dot = '\0';
    }
    return arena_format(p->yaml->arena, "%s: %s", path, line);
}

static const char *add_cure(const struct scene_part *p, const char *rest, const char *value)
{
    return arena_format(p->yaml->arena, "add for instance: %s", line_for(p, rest, value));
}

static const char *example_of(const struct scene_part *p, const char *path)
{
    const struct key *k = keys_find(path);
    return k ? scene_example(p->yaml, k) : "{}";
}

void scene_check_missing(const struct scene_part *p, const char *path, const char *value, const char *because)
{
    const char *rest;
    const struct yaml_node *map = innermost(p, path, &rest);
    if (map && !p->yaml->missing && !yaml_find(p->map, path))
        diag_add(p->yaml->diag, scene_part_place(p, map), add_cure(p, rest, value), "%s is missing%s",
                 scene_part_label(p, path), because);
}

static void missing(const struct scene_part *p, const char *path)
{
    scene_check_missing(p, path, example_of(p, path), "");
}

static bool in_absent_section(const struct scene_part *p, const char *path)
{
    for (const struct key_section *s = keys_sections; s->path; s++) {
        size_t n = strlen(s->path);
        if (strncmp(path, s->path, n) == 0 && path[n] == '.' && !yaml_find(p->map, s->path)) return true;
    }
    return false;
}

/* ------------------------------------------------------------------ keys */

static void key_fill(const struct scene_part *p, const struct key *k)
{
    const struct yaml_node *node = yaml_find(p->map, k->path);
    enum applies a = applies(p, k);
    scene_values_clear(p, k);
    if (node && a == APPLIES_NO)
        not_applicable(p, k, node);
    else if (node)
        scene_values_read(p, k, node);
    else if (a == APPLIES_YES && k->standard)
        scene_values_default(p, k);
    else if (a == APPLIES_YES && !in_absent_section(p, k->path))
        missing(p, k->path);
}

/* ------------------------------------------------------------------ alternatives */

static enum key_struct owner_of(const char *path)
{
    const struct key *k = keys_find(path);
    for (const struct key_section *s = keys_sections; !k && s->path; s++)
        if (strcmp(s->path, path) == 0) return s->of;
    return k ? k->of : KEY_CONTACT;
}

static enum applies path_applies(const struct scene_part *p, const char *path)
{
    const struct key *k = keys_find(path);
    return k ? applies(p, k) : APPLIES_YES;
}

static void both_given(const struct scene_part *p, const struct yaml_node *const nodes[2], const char *const names[2])
{
    bool swap = scene_part_before(&nodes[1]->key->at, &nodes[0]->key->at);
    const struct yaml_node *first = nodes[swap], *second = nodes[!swap];
    const struct diag_source *other = first->key->at.source;
    struct arena *a = p->yaml->arena;
    const char *label = scene_part_label(p, names[swap]), *where = other->name;
    if (!other->option) where = arena_format(a, "%s line %d", where, first->key->at.line);
    const char *cure = arena_format(a, "%s stands in %s; remove one of them", label, where);
    if (other != second->key->at.source)
        cure = arena_format(a, "%s, or take that one away with %s: null (on the command line: --set %s=null)", cure,
                            label, label);
    diag_add(p->yaml->diag, second->key->at, cure, "%s and %s exclude each other", scene_part_label(p, names[!swap]),
             label);
}

/* The alternatives that could be given, in words. */
static void none_given(const struct scene_part *p, const char *const *candidates, int n)
{
    const char *rest, *all = "";
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
        enum applies a = path_applies(p, path);
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

void scene_check_fill(const struct scene_part *p)
{
    for (const struct key *k = keys_table; k->path; k++)
        if (k->of == p->of) key_fill(p, k);
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (s->of == p->of) *keys_given(s, p->to) = yaml_find(p->map, s->path) != NULL;
    for (const struct key_alternative *x = keys_alternatives; x->paths[0]; x++)
        if (owner_of(x->paths[0]) == p->of) alternative_check(p, x);
}
