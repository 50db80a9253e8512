/* See design_factors.h. A factor that is named by a key of scenes has values of that key as levels, or maps; any other has maps alone. */
#include "batch/design_factors.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "batch/design_changes.h"
#include "batch/design_columns.h"
#include "scene/scene_merge.h"
#include "scene/scene_values.h"

static const char map_cure[] = "write for instance: - {label: wood, set: {surface.response: wood.csv}}";

struct reading_level { /* one that is being read */
    struct design_reading *r;
    int factor, index;
    bool key;  /* the factor's name is a key of scenes */
    const struct yaml_node *name;
};

static struct design_level *level_of(const struct reading_level *l)
{
    return &l->r->design->factors[l->factor].levels[l->index];
}

static struct design_change *change_of(const struct reading_level *l)
{
    return &l->r->texts->levels[l->factor][l->index];
}

/* ------------------------------------------------------------------ labels */

/* Of a file name what stands between folder and ending. */
static const char *stem_of(const char *file, struct arena *a)
{
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file, *dot = strrchr(name, '.');
    return arena_format(a, "%.*s", (int)(dot && dot > name ? (size_t)(dot - name) : strlen(name)), name);
}

static void label_set(const struct reading_level *l, const struct yaml_node *node)
{
    const char *text = node->text;
    bool good = node->kind == YAML_SCALAR && *text && strlen(text) <= 100;
    for (const char *s = text; good && *s; s++)
        good = (unsigned char)*s >= ' ' && *s != 127;
    if (good)
        level_of(l)->label = text;
    else
        design_reading_must(l->r, node, "label", "a text of 1 to 100 bytes in one line", "write for instance: label: wood");
}

static int by_label(const void *pa, const void *pb)
{
    const struct design_level *const *a = pa, *const *b = pb;
    int order = strcmp((*a)->label, (*b)->label);
    return order ? order : *a < *b ? -1 : *a > *b;
}

static void labels_differ(const struct design_reading *r, int f, const struct yaml_node *list)
{
    const struct design_factor *factor = &r->design->factors[f];
    struct design_level **sorted = ARENA_TAKE(r->arena, struct design_level *, factor->n_levels + 1);
    for (int i = 0; i < factor->n_levels; i++)
        sorted[i] = &factor->levels[i];
    qsort(sorted, (size_t)factor->n_levels, sizeof *sorted, by_label);
    for (int i = 1; i < factor->n_levels; i++) {
        if (!*sorted[i]->label || strcmp(sorted[i]->label, sorted[i - 1]->label) != 0)
            continue;
        const struct yaml_node *item = list->first;
        for (long at = sorted[i] - factor->levels; at > 0; at--)
            item = item->next;
        const struct yaml_node *label = yaml_get(item, "label");
        diag_add(r->yaml->diag, label ? label->at : item->at,
                 item->kind == YAML_SCALAR ? "remove one of them, or write - {label: ..., value: ...}" : "give each level a label of its own",
                 "two levels of %s are labelled '%s'", factor->name, diag_shown(r->yaml->diag, sorted[i]->label));
    }
}

/* ------------------------------------------------------------------ levels */

/* Told of the first such level: with a word that should be a key, all are. */
static void no_key(const struct reading_level *l, const struct yaml_node *item)
{
    const char *near = design_changes_near(l->r, l->name->text);
    if (l->index == 0 || l->r->factors[l->factor]->first->kind != YAML_SCALAR)
        diag_add(l->r->yaml->diag, item->at, near ? arena_format(l->r->arena, "did you mean %s? else %s", near, map_cure) : map_cure,
                 "a level of %s must be a map, not %s: %s is no key of scenes whose values could be levels", l->name->text,
                 scene_values_kind(l->r->yaml, item), l->name->text);
}

static void scalar_read(const struct reading_level *l, const struct yaml_node *item)
{
    const struct key *k = design_changes_key(l->name->text);
    struct arena *a = l->r->arena;
    if (!l->key) {
        no_key(l, item);
        return;
    }
    if (*item->text) {
        struct yaml_node *label = yaml_make(l->r->yaml, YAML_SCALAR, item->at, k && k->type == KEY_FILE ? stem_of(item->text, a) : item->text);
        label_set(l, label);
    }
    design_changes_add(l->r, change_of(l), l->name, item);
}

static void base_read(const struct reading_level *l, const struct yaml_node *base)
{
    if (base->kind != YAML_SCALAR || !*base->text) {
        design_reading_must(l->r, base, "base", "the file name of a scene", "write for instance: base: scrape.yaml");
        return;
    }
    change_of(l)->base = base;
    level_of(l)->base = scene_merge_path(l->r->yaml, base->at.source, base->text);
}

/* A level of recordings has no scene to change. */
static void of_read(const struct reading_level *l, const struct yaml_node *map, const struct yaml_node *of)
{
    static const char cure[] = "write for instance: - {label: recorded, of: recordings}";
    if (of->kind != YAML_SCALAR || strcmp(of->text, "recordings") != 0)
        design_reading_must(l->r, of, "of", "the word recordings", cure);
    level_of(l)->recorded = true;
    for (const char *const *other = (const char *const[]){"set", "base", "value", NULL}; *other; other++)
        if (yaml_get(map, *other))
            diag_add(l->r->yaml->diag, yaml_get(map, *other)->key->at, cure, "a level that only recordings have has no %s", *other);
}

static void map_read(const struct reading_level *l, const struct yaml_node *map)
{
    static const char *const names[] = {"label", "text", "set", "base", "value", "of", NULL};
    const struct yaml_node *label = yaml_get(map, "label"), *set = yaml_get(map, "set"), *base = yaml_get(map, "base"), *value = yaml_get(map, "value");
    const struct yaml_node *text = yaml_get(map, "text");
    design_reading_known(l->r, map, names, " in a level");
    if (label)
        label_set(l, label);
    else
        diag_add(l->r->yaml->diag, map->at, map_cure, "a level of %s has no label", l->name->text);
    if (value && l->key)
        design_changes_add(l->r, change_of(l), l->name, value);
    else if (value)
        diag_add(l->r->yaml->diag, value->key->at, map_cure, "value needs a factor that is a key of scenes, which %s is not", l->name->text);
    if (set && !yaml_null(set))
        design_changes_map(l->r, change_of(l), set);
    if (text && text->kind != YAML_SCALAR)
        design_reading_must(l->r, text, "text", "what a trial says of the level", "write for instance: text: a plank of poplar");
    else if (text)
        level_of(l)->text = text->text;
    if (base)
        base_read(l, base);
    if (yaml_get(map, "of"))
        of_read(l, map, yaml_get(map, "of"));
}

static void level_read(const struct reading_level *l, const struct yaml_node *item)
{
    level_of(l)->label = "";
    if (item->kind == YAML_MAP)
        map_read(l, item);
    else if (item->kind == YAML_SCALAR)
        scalar_read(l, item);
    else
        diag_add(l->r->yaml->diag, item->at, l->key ? "write: - {label: ..., value: [...]}" : map_cure, "a level of %s that is a list needs a label",
                 l->name->text);
    level_of(l)->set = design_changes_texts(change_of(l), l->r->arena);
}

/* ------------------------------------------------------------------ factors */

static bool is_word(const char *s)
{
    if (!isalpha((unsigned char)*s))
        return false;
    while (isalnum((unsigned char)*s) || *s == '_' || *s == '-')
        s++;
    return !*s;
}

static bool name_good(const struct design_reading *r, const struct yaml_node *name, bool *key)
{
    static const char *const taken[] = {"replicate", "order", "cell", NULL};
    *key = design_changes_key(name->text) || strcmp(name->text, "accuracy") == 0 || strchr(name->text, '.');
    if (*key)
        return design_changes_known(r, name);
    for (int i = 0; taken[i]; i++)
        if (strcmp(name->text, taken[i]) == 0)
            return diag_add(r->yaml->diag, name->at, "call the factor otherwise", "%s has a meaning of its own in names: a factor cannot be called so", name->text);
    return is_word(name->text) || diag_add(r->yaml->diag, name->at, "write for instance: material", "a factor must be a key of scenes, or a word (letters, digits, _ and -, a letter first), not '%s'",
                                           diag_shown(r->yaml->diag, name->text));
}

static void factor_read(struct design_reading *r, int f, const struct yaml_node *list)
{
    struct design_factor *factor = &r->design->factors[f];
    bool key, good = name_good(r, list->key, &key);
    factor->name = list->key->text;
    r->factors[f] = list;
    factor->levels = ARENA_TAKE(r->arena, struct design_level, list->n + 1);
    r->texts->levels[f] = ARENA_TAKE(r->arena, struct design_change, list->n + 1);
    if (list->kind != YAML_LIST || list->n == 0) {
        design_reading_must(r, list, factor->name, list->kind == YAML_LIST ? "a list of one level or more" : "a list of levels", key ? "write the values in brackets: [1 Hz, 2 Hz]" : map_cure);
        return;
    }
    for (const struct yaml_node *item = list->first; good && item; item = item->next) {
        struct reading_level l = {r, f, factor->n_levels++, key, list->key};
        level_read(&l, item);
    }
    labels_differ(r, f, list);
}

/* The value of a key that is a factor is what its levels say: another factor must not change it. */
static void keys_once(const struct design_reading *r, int f, int other)
{
    const struct design_factor *g = &r->design->factors[other];
    size_t n = strlen(r->design->factors[f].name);
    for (int i = 0; i < g->n_levels; i++)
        for (int k = 0; k < r->texts->levels[other][i].n; k++) {
            struct yaml_node *const *path = r->texts->levels[other][i].keys[k].path;
            if (!*g->levels[i].label || strncmp(g->levels[i].set[k], r->design->factors[f].name, n) != 0 || g->levels[i].set[k][n] != '=')
                continue;
            while (path[1])
                path++;
            diag_add(r->yaml->diag, (*path)->at, "remove it here, or make the other a factor of levels {label: ..., set: ...}", "%s is a factor: '%s' of %s must not set it",
                     r->design->factors[f].name, diag_shown(r->yaml->diag, g->levels[i].label), g->name);
        }
}

static void factors_read(struct design_reading *r, const struct yaml_node *map)
{
    int n = map && map->kind == YAML_MAP ? map->n : 0;
    r->design->factors = ARENA_TAKE(r->arena, struct design_factor, n + 1);
    r->texts->levels = ARENA_TAKE(r->arena, struct design_change *, n + 1);
    r->factors = ARENA_TAKE(r->arena, const struct yaml_node *, n + 1);
    if (map && map->kind != YAML_MAP)
        design_reading_must(r, map, "factors", "a map of factors with their levels", "write for instance: factors: {motion.rate: [1 Hz, 2 Hz]}");
    for (const struct yaml_node *item = n ? map->first : NULL; item; item = item->next)
        factor_read(r, r->design->n_factors++, item);
    for (int f = 0; f < n; f++)
        for (int g = 0; g < n; g++)
            if (f != g)
                keys_once(r, f, g);
}

/* ------------------------------------------------------------------ bases */

static int bases_of(const struct design_reading *r, int f, const struct yaml_node **one, bool *all)
{
    int n = 0;
    *all = true;
    for (int i = 0; i < r->design->factors[f].n_levels; i++)
        if (r->texts->levels[f][i].base) {
            *one = r->texts->levels[f][i].base;
            n++;
        } else if (!r->design->factors[f].levels[i].recorded) {
            *all = false;
        }
    return n;
}

/* A stimulus has one base: the design's, or that of the one factor whose levels have some. */
static void bases_check(const struct design_reading *r)
{
    const struct yaml_node *one = NULL;
    bool all = false, some = false;
    for (int f = 0; f < r->design->n_factors; f++) {
        bool every;
        int n = bases_of(r, f, &one, &every);
        if (n && some)
            diag_add(r->yaml->diag, one->key->at, "let one factor choose the scene", "levels of two factors have a base");
        some = some || n;
        all = all || (n && every);
    }
    if (!r->texts->base && !(all && some))
        diag_add(r->yaml->diag, (struct diag_place){r->root->at.source, 1, 1, 0}, "write for instance: base: scrape.yaml",
                 some ? "base is missing, and not every level has one" : "base is missing");
}

void design_factors_read(struct design_reading *r)
{
    const struct yaml_node *base = design_reading_value(r, "base"), *set = design_reading_value(r, "set");
    if (base && (base->kind != YAML_SCALAR || !*base->text))
        design_reading_must(r, base, "base", "the file name of a scene", "write for instance: base: scrape.yaml");
    r->texts->base = base;
    r->design->base = base && base->kind == YAML_SCALAR ? scene_merge_path(r->yaml, base->at.source, base->text) : NULL;
    if (set)
        design_changes_map(r, &r->texts->set, set);
    r->design->set = design_changes_texts(&r->texts->set, r->arena);
    factors_read(r, design_reading_value(r, "factors"));
    bases_check(r);
    design_columns_make(r);
}
