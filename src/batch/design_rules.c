/* See design_rules.h. */
#include "batch/design_rules.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "scene/scene_values.h"

static const char level_cure[] = "write for instance: level: {common: {peak: -3 dB}}, level: {each: {lufs: -23}}, or level: scene";

static bool is_text(const struct yaml_node *node, const char *word)
{
    return node->kind == YAML_SCALAR && strcmp(node->text, word) == 0;
}

/* ------------------------------------------------------------------ numbers */

/* A whole number as a scene has it: no sign, no leading zeros. */
static void seed_read(const struct design_reading *r, const struct yaml_node *node, const char *label, uint64_t *seed)
{
    if (node->kind != YAML_SCALAR || !text_u64(node->text, seed) || (node->text[0] == '0' && node->text[1]))
        design_reading_must(r, node, label, "a whole number from 0 to 18446744073709551615", "write for instance: seed: 7");
}

static void version_read(const struct design_reading *r)
{
    const struct yaml_node *node = yaml_get(r->root, "rasp-design");
    if (!node)
        diag_add(r->yaml->diag, (struct diag_place){r->root->at.source, 1, 1, 0}, "begin with: rasp-design: 1 (rasp new design writes one)", "rasp-design is missing: is this a design?");
    else if (!is_text(node, "1"))
        design_reading_must(r, node, "rasp-design", "1", "this program reads designs of version 1; a newer one may read this");
}

static void replicates_read(const struct design_reading *r)
{
    const struct yaml_node *node = design_reading_value(r, "replicates");
    r->design->replicates = 1;
    if (node && (node->kind != YAML_SCALAR || !text_int(node->text, 1, DESIGN_READING_CELLS, &r->design->replicates)))
        design_reading_must(r, node, "replicates", "a whole number from 1 to 1000000", "write for instance: replicates: 4");
}

/* ------------------------------------------------------------------ order */

static void order_read(const struct design_reading *r)
{
    static const char *const names[] = {"seed", NULL};
    const struct yaml_node *node = design_reading_value(r, "order"), *seed = node ? yaml_get(node, "seed") : NULL;
    if (!node || is_text(node, "design"))
        return;
    if (!seed) {
        design_reading_must(r, node, "order", "design, or {seed: NUMBER}", "write for instance: order: {seed: 7}");
        return;
    }
    design_reading_known(r, node, names, " in order");
    seed_read(r, seed, "order.seed", &r->design->order_seed);
    r->design->shuffled = true;
}

/* ------------------------------------------------------------------ level */

static double *level_field(struct level *l, const char *word)
{
    return !strcmp(word, "peak")         ? &l->peak
           : !strcmp(word, "rms")        ? &l->rms
           : !strcmp(word, "lufs")       ? &l->lufs
           : !strcmp(word, "full_scale") ? &l->full_scale
           : !strcmp(word, "dbfs_at_1_pa") ? &l->dbfs_at_1_pa
                                           : NULL;
}

static void level_value(const struct design_reading *r, const char *rule, const struct yaml_node *map)
{
    static const char *const names[] = {"peak", "rms", "lufs", "full_scale", "dbfs_at_1_pa", NULL};
    const struct yaml_node *value = map->first;
    if (map->kind != YAML_MAP || map->n != 1) {
        diag_add(r->yaml->diag, map->at, level_cure, "level.%s must be one of: %s", rule, design_reading_joined(r, names));
        return;
    }
    double *field = level_field(&r->design->level, value->key->text);
    if (!field) {
        design_reading_known(r, map, names, arena_format(r->arena, " in level.%s", rule));
        return;
    }
    const struct key *k = keys_find(arena_format(r->arena, "output.level.%s", value->key->text));
    struct scene_part part = {r->yaml, r->root, "", KEY_SCENE, NULL};
    scene_values_number(&part, k, value, arena_format(r->arena, "level.%s.%s", rule, value->key->text), field);
}

static void level_read(const struct design_reading *r)
{
    struct design *d = r->design;
    const struct yaml_node *node = design_reading_value(r, "level");
    d->level = (struct level){NAN, NAN, NAN, NAN, NAN, false};
    d->level_rule = node && is_text(node, "scene") ? DESIGN_LEVEL_SCENE : DESIGN_LEVEL_COMMON;
    if (!node)
        d->level.peak = -3;
    if (!node || d->level_rule == DESIGN_LEVEL_SCENE)
        return;
    const struct yaml_node *rule = node->kind == YAML_MAP && node->n == 1 ? node->first : NULL;
    if (rule && strcmp(rule->key->text, "each") == 0)
        d->level_rule = DESIGN_LEVEL_EACH;
    else if (!rule || strcmp(rule->key->text, "common") != 0) {
        diag_add(r->yaml->diag, node->at, level_cure, "level must be {common: ...}, {each: ...} or scene");
        return;
    }
    level_value(r, rule->key->text, rule);
}

/* ------------------------------------------------------------------ length */

static void length_read(const struct design_reading *r)
{
    struct design *d = r->design;
    const struct yaml_node *node = design_reading_value(r, "length");
    d->length_rule = DESIGN_LENGTH_LONGEST;
    if (!node || is_text(node, "longest"))
        return;
    if (is_text(node, "own")) {
        d->length_rule = DESIGN_LENGTH_OWN;
        return;
    }
    d->length_rule = DESIGN_LENGTH_FIXED;
    if (node->kind != YAML_SCALAR || text_number_length(node->text) == 0) {
        design_reading_must(r, node, "length", "longest, own or a time", "write for instance: length: 2 s");
        return;
    }
    struct scene_part part = {r->yaml, r->root, "", KEY_SCENE, NULL};
    scene_values_number(&part, keys_find("output.duration"), node, "length", &d->length);
}

/* ------------------------------------------------------------------ all */

static struct diag_place place_of(const struct design_reading *r, const struct yaml_node *node)
{
    return node ? node->at : (struct diag_place){r->root->at.source, 1, 1, 0};
}

void design_rules_read(struct design_reading *r)
{
    const struct yaml_node *title = design_reading_value(r, "title"), *seed = design_reading_value(r, "seed");
    r->texts->seed = place_of(r, seed);
    r->design->seed = 1;
    version_read(r);
    if (title && title->kind != YAML_SCALAR)
        design_reading_must(r, title, "title", "a text", "write for instance: title: three materials by two rates");
    else if (title)
        r->design->title = title->text;
    if (seed)
        seed_read(r, seed, "seed", &r->design->seed);
    replicates_read(r);
    order_read(r);
    level_read(r);
    r->texts->level = place_of(r, design_reading_value(r, "level"));
    length_read(r);
    r->texts->length = place_of(r, design_reading_value(r, "length"));
}

void design_rules_independent(struct design_reading *r)
{
    const struct yaml_node *list = design_reading_value(r, "independent");
    if (list && list->kind != YAML_LIST) {
        design_reading_must(r, list, "independent", "a list of factors", "write for instance: independent: [material]");
        return;
    }
    for (const struct yaml_node *item = list ? list->first : NULL; item; item = item->next) {
        int f = -1;
        if (item->kind == YAML_SCALAR)
            f = design_reading_factor(r, item);
        else
            design_reading_must(r, item, "an entry of independent", "the name of a factor", NULL);
        if (f >= 0 && r->design->factors[f].independent)
            diag_add(r->yaml->diag, item->at, "remove one of them", "independent names '%s' twice", diag_shown(r->yaml->diag, item->text));
        else if (f >= 0)
            r->design->factors[f].independent = true;
    }
}
