/* See design.h: a design from its text, part by part: the rules of the whole set here, then factors and what their
   levels change (design_factors.c), cells, stimuli (design_rows.c) and names (design_names.c). Each part reports all
   its errors; the later ones need the earlier ones whole. design_scene only reads design, base and all that is laid
   over it: any number of threads may ask for scenes at once. */
#include "batch/design_reading.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/text.h"
#include "file/yaml.h"
#include "scene/keys_text.h"
#include "scene/scene_places.h"
#include "scene/scene_read.h"
#include "scene/scene_values.h"

/* ------------------------------------------------------------------ what the parts share */

struct yaml_node *design_reading_value(const struct design_reading *r, const char *key)
{
    struct yaml_node *node = yaml_get(r->root, key);
    return node && yaml_null(node) ? NULL : node;
}

bool design_reading_must(const struct design_reading *r, const struct yaml_node *node, const char *label,
                         const char *be, const char *cure)
{
    return diag_add(r->yaml->diag, node->at, cure, "%s must be %s, not %s", label, be,
                    node->kind == YAML_LIST && node->n == 0 ? "an empty list" : scene_values_kind(r->yaml, node));
}

const char *design_reading_joined(const struct design_reading *r, const char *const *names)
{
    const char *all = "";
    for (int i = 0; names[i] && i < 13; i++)
        all = arena_format(r->arena, "%s%s%s", all, i ? ", " : "", i < 12 ? names[i] : "...");
    return all;
}

/* "did you mean 'x'?", or what there is. */
static const char *near_or_all(const struct design_reading *r, const char *word, const char *const *names,
                               const char *there)
{
    const char *near = text_nearest(word, names);
    return near ? arena_format(r->arena, "did you mean '%s'?", near)
                : arena_format(r->arena, "%s: %s", there, design_reading_joined(r, names));
}

void design_reading_known(const struct design_reading *r, const struct yaml_node *map, const char *const *names,
                          const char *in)
{
    for (const struct yaml_node *item = map->first; item; item = item->next)
        if (!text_is_one(item->key->text, names))
            diag_add(r->yaml->diag, item->key->at, near_or_all(r, item->key->text, names, "keys here"),
                     "unknown key '%s'%s", diag_shown(r->yaml->diag, item->key->text), in);
}

int design_reading_factor(const struct design_reading *r, const struct yaml_node *key)
{
    const struct design *d = r->design;
    const char **names = ARENA_TAKE(r->arena, const char *, d->n_factors + 1);
    for (int f = 0; f < d->n_factors; f++) {
        if (strcmp(d->factors[f].name, key->text) == 0) return f;
        names[f] = d->factors[f].name;
    }
    diag_add(r->yaml->diag, key->at,
             d->n_factors ? near_or_all(r, key->text, names, "factors") : "the design has no factors", "no factor '%s'",
             diag_shown(r->yaml->diag, key->text));
    return -1;
}

int design_reading_level(const struct design_reading *r, int f, const struct yaml_node *label, bool recording)
{
    const struct design_factor *factor = &r->design->factors[f];
    const struct yaml_node *item = r->texts->made[f].path ? NULL : r->factors[f]->first;
    if (label->kind != YAML_SCALAR) {
        design_reading_must(r, label, factor->name, "the label of a level",
                            arena_format(r->arena, "write for instance: %s", factor->levels[0].label));
        return -1;
    }
    for (int i = 0; i < factor->n_levels; i++, item = item ? item->next : NULL)
        if (strcmp(factor->levels[i].label, label->text) == 0 ||
            (item && item->kind == YAML_SCALAR && strcmp(item->text, label->text) == 0))
            return i;
    const char **names = ARENA_TAKE(r->arena, const char *, factor->n_levels + 1);
    for (int i = 0; i < factor->n_levels; i++)
        names[i] = factor->levels[i].label;
    const char *cure = near_or_all(r, label->text, names, "its levels"),
               *shown = diag_shown(r->yaml->diag, label->text);
    if (recording)
        cure = arena_format(r->arena, "%s (a level that only recordings have: - {label: %s, of: recordings})", cure,
                            shown);
    diag_add(r->yaml->diag, label->at, cure, "'%s' is no level of %s", shown, factor->name);
    return -1;
}

const struct yaml_node *design_reading_item(const struct design_reading *r, int f, int level)
{
    const struct yaml_node *item = r->factors[f];
    if (r->texts->made[f].path) return item;
    for (item = item->first; level > 0; level--)
        item = item->next;
    return item;
}

const char *design_reading_labels(const struct design *d, const int *level, struct arena *a)
{
    const char *all = "";
    for (int f = 0; f < d->n_factors; f++)
        if (level[f] >= 0) all = arena_format(a, "%s%s%s", all, *all ? ", " : "", d->factors[f].levels[level[f]].label);
    return all;
}

/* ------------------------------------------------------------------ rules of the whole set */

static const char level_cure[] =
    "write for instance: level: {common: {peak: -3 dB}}, level: {each: {lufs: -23}}, or level: scene";

static bool is_text(const struct yaml_node *node, const char *word)
{
    return node->kind == YAML_SCALAR && strcmp(node->text, word) == 0;
}

/* A whole number as a scene has it: no sign, no leading zeros. */
static void seed_read(const struct design_reading *r, const struct yaml_node *node, const char *label, uint64_t *seed)
{
    if (node->kind != YAML_SCALAR || !text_u64(node->text, seed) || (node->text[0] == '0' && node->text[1]))
        design_reading_must(r, node, label, "a whole number from 0 to 18446744073709551615",
                            "write for instance: seed: 7");
}

/* ------------------------------------------------------------------ order */

static void order_read(const struct design_reading *r)
{
    static const char *const names[] = {"seed", NULL};
    const struct yaml_node *node = design_reading_value(r, "order"), *seed = node ? yaml_get(node, "seed") : NULL;
    if (!node || is_text(node, "design")) return;
    if (!seed) {
        design_reading_must(r, node, "order", "design, or {seed: NUMBER}", "write for instance: order: {seed: 7}");
        return;
    }
    design_reading_known(r, node, names, " in order");
    seed_read(r, seed, "order.seed", &r->design->order_seed);
    r->design->shuffled = true;
}

/* ------------------------------------------------------------------ level */

static void level_read(const struct design_reading *r)
{
    struct design *d = r->design;
    const struct yaml_node *node = design_reading_value(r, "level");
    d->level = (struct level){NAN, NAN, NAN, NAN, NAN, false};
    d->level_rule = node && is_text(node, "scene") ? DESIGN_LEVEL_SCENE : DESIGN_LEVEL_COMMON;
    if (!node) d->level.peak = -3;
    if (!node || d->level_rule == DESIGN_LEVEL_SCENE) return;
    const struct yaml_node *rule = node->kind == YAML_MAP && node->n == 1 ? node->first : NULL;
    if (rule && strcmp(rule->key->text, "each") == 0)
        d->level_rule = DESIGN_LEVEL_EACH;
    else if (!rule || strcmp(rule->key->text, "common") != 0) {
        diag_add(r->yaml->diag, node->at, level_cure, "level must be {common: ...}, {each: ...} or scene");
        return;
    }
    static const char *const names[] = {"peak", "rms", "lufs", "full_scale", "dbfs_at_1_pa", NULL};
    double *const fields[] = {&d->level.peak, &d->level.rms, &d->level.lufs, &d->level.full_scale,
                              &d->level.dbfs_at_1_pa};
    const char *word = rule->key->text;
    const struct yaml_node *value = rule->first;
    if (rule->kind != YAML_MAP || rule->n != 1) {
        diag_add(r->yaml->diag, rule->at, level_cure, "level.%s must be one of: %s", word,
                 design_reading_joined(r, names));
        return;
    }
    int i = 0;
    while (names[i] && strcmp(names[i], value->key->text) != 0)
        i++;
    if (!names[i]) {
        design_reading_known(r, rule, names, arena_format(r->arena, " in level.%s", word));
        return;
    }
    const struct key *k = keys_find(arena_format(r->arena, "output.level.%s", names[i]));
    struct scene_part part = {r->yaml, r->root, "", KEY_SCENE, NULL, NULL};
    scene_values_number(&part, k, value, arena_format(r->arena, "level.%s.%s", word, names[i]), fields[i]);
}

/* ------------------------------------------------------------------ length */

static void length_read(const struct design_reading *r)
{
    struct design *d = r->design;
    const struct yaml_node *node = design_reading_value(r, "length");
    d->length_rule = DESIGN_LENGTH_LONGEST;
    if (!node || is_text(node, "longest")) return;
    if (is_text(node, "own")) {
        d->length_rule = DESIGN_LENGTH_OWN;
        return;
    }
    d->length_rule = DESIGN_LENGTH_FIXED;
    if (node->kind != YAML_SCALAR || text_number_length(node->text) == 0) {
        design_reading_must(r, node, "length", "longest, own or a time", "write for instance: length: 2 s");
        return;
    }
    struct scene_part part = {r->yaml, r->root, "", KEY_SCENE, NULL, NULL};
    scene_values_number(&part, keys_find("output.duration"), node, "length", &d->length);
}

/* ------------------------------------------------------------------ all */

static struct diag_place place_of(const struct design_reading *r, const struct yaml_node *node)
{
    return node ? node->at : (struct diag_place){r->root->at.source, 1, 1, 0};
}

static void design_rules_read(struct design_reading *r)
{
    const struct yaml_node *title = design_reading_value(r, "title"), *seed = design_reading_value(r, "seed");
    r->texts->seed = place_of(r, seed);
    r->design->seed = 1;
    const struct yaml_node *version = yaml_get(r->root, "rasp-design"),
                           *replicates = design_reading_value(r, "replicates");
    if (!version)
        diag_add(r->yaml->diag, (struct diag_place){r->root->at.source, 1, 1, 0},
                 "begin with: rasp-design: 1 (rasp new design writes one)",
                 "rasp-design is missing: is this a design?");
    else if (!is_text(version, "1"))
        design_reading_must(r, version, "rasp-design", "1",
                            "this program reads designs of version 1; a newer one may read this");
    if (title && title->kind != YAML_SCALAR)
        design_reading_must(r, title, "title", "a text", "write for instance: title: three materials by two rates");
    else if (title)
        r->design->title = title->text;
    if (seed) seed_read(r, seed, "seed", &r->design->seed);
    r->design->replicates = 1;
    if (replicates && (replicates->kind != YAML_SCALAR ||
                       !text_int(replicates->text, 1, DESIGN_READING_CELLS, &r->design->replicates)))
        design_reading_must(r, replicates, "replicates", "a whole number from 1 to 1000000",
                            "write for instance: replicates: 4");
    const struct yaml_node *samples = design_reading_value(r, "samples");
    if (samples &&
        (samples->kind != YAML_SCALAR || !text_int(samples->text, 1, DESIGN_READING_CELLS, &r->design->samples)))
        design_reading_must(r, samples, "samples", "a whole number from 1 to 1000000",
                            "write for instance: samples: 1000");
    r->design->samples_independent = r->design->samples;
    order_read(r);
    level_read(r);
    r->texts->level = place_of(r, design_reading_value(r, "level"));
    length_read(r);
    r->texts->length = place_of(r, design_reading_value(r, "length"));
}

static void design_rules_independent(struct design_reading *r)
{
    const struct yaml_node *list = design_reading_value(r, "independent");
    if (list && list->kind != YAML_LIST) {
        design_reading_must(r, list, "independent", "a list of factors", "write for instance: independent: [material]");
        return;
    }
    bool sample = false;
    for (const struct yaml_node *item = list ? list->first : NULL; item; item = item->next) {
        int f = -1;
        if (r->design->samples && is_text(item, "sample"))
            sample = true;
        else if (item->kind == YAML_SCALAR)
            f = design_reading_factor(r, item);
        else
            design_reading_must(r, item, "an entry of independent", "the name of a factor", NULL);
        if (f >= 0 && r->design->factors[f].independent)
            diag_add(r->yaml->diag, item->at, "remove one of them", "independent names '%s' twice",
                     diag_shown(r->yaml->diag, item->text));
        else if (f >= 0)
            r->design->factors[f].independent = true;
    }
    if (list) r->design->samples_independent = sample;
}

/* ------------------------------------------------------------------ texts of trials */

static const char text_cure[] = "write for instance: text: \"a {motion} on {material}\"";

static bool is_field(const char *s, size_t n, const char *name)
{
    return strlen(name) == n && strncmp(s, name, n) == 0;
}

static void design_text_read(const struct design_reading *r)
{
    const struct yaml_node *node = design_reading_value(r, "text");
    if (!node) return;
    if (node->kind != YAML_SCALAR || !*node->text) {
        design_reading_must(r, node, "text", "what the text of a trial is", text_cure);
        return;
    }
    r->design->text = node->text;
    for (const char *s = node->text + strcspn(node->text, "{}"); *s; s += strcspn(s, "{}")) {
        size_t n = strcspn(s + 1, "{}");
        if (*s == '}' || s[1 + n] != '}') {
            diag_add(r->yaml->diag, node->at, text_cure, "a brace is left open in '%s'",
                     diag_shown(r->yaml->diag, node->text));
            return;
        }
        if (!is_field(s + 1, n, "replicate"))
            design_reading_factor(
                r, yaml_make(r->yaml, YAML_SCALAR, node->at, arena_format(r->arena, "%.*s", (int)n, s + 1)));
        s += n + 2;
    }
}

/* ------------------------------------------------------------------ making */

/* False: a factor that it names has no level here. */
static bool template_put(FILE *f, const struct design *d, const struct design_stimulus *s)
{
    for (const char *t = d->text; *t;) {
        size_t n = strcspn(t, "{");
        fprintf(f, "%.*s", (int)n, t);
        t += n;
        if (!*t) break;
        size_t m = strcspn(++t, "}");
        int k = 0;
        while (k < d->n_factors && !is_field(t, m, d->factors[k].name))
            k++;
        if (is_field(t, m, "replicate"))
            fprintf(f, "%d", s->replicate);
        else if (k == d->n_factors || s->level[k] < 0)
            return false;
        else
            fputs(d->factors[k].levels[s->level[k]].text ? d->factors[k].levels[s->level[k]].text
                                                         : d->factors[k].levels[s->level[k]].label,
                  f);
        t += m + 1;
    }
    return true;
}

const char *design_text(const struct design *d, int i, struct arena *a)
{
    const struct design_stimulus *s = &d->stimuli[i];
    const struct yaml_node *entry = s->recording ? d->texts->cells[s->cell].entry : NULL,
                           *own = entry ? yaml_get(entry, "text") : NULL; /* what a recording says itself */
    char *memory = NULL;
    size_t size = 0;
    if (own || !d->text) return own ? own->text : NULL;
    FILE *f = memory_stream(&memory, &size);
    bool whole = template_put(f, d, s);
    memory_stream_end(f, &memory);
    const char *text = whole ? arena_text(a, memory) : NULL;
    free(memory);
    return text;
}

/* ------------------------------------------------------------------ scenes */

bool design_scene(const struct design *d, int i, struct arena *a, struct scene *s, const char **messages, struct err *e)
{
    const struct design_texts *t = d->texts;
    const int *level = d->stimuli[i].level;
    const char *base = d->base;
    const struct yaml_node *named = t->base;
    *messages = "";
    if (d->stimuli[i].recording)
        return err_set(e, ERR_USAGE, "%s is a recording: it has no scene", d->stimuli[i].recording);
    int n = t->set.n + 1;
    struct design_change *changes = ARENA_TAKE(a, struct design_change, d->n_factors + 1);
    for (int f = 0; f < d->n_factors; f++)
        n += (changes[f] = design_made_change(d, f, level[f], a)).n;
    struct scene_layer_key *keys = ARENA_TAKE(a, struct scene_layer_key, n);
    n = 0;
    for (int f = -1; f < d->n_factors; f++) {
        const struct design_change *c = f < 0 ? &t->set : &changes[f];
        for (int k = 0; k < c->n; k++)
            keys[n++] = c->keys[k];
        if (f < 0) continue;
        base = c->base ? d->factors[f].levels[level[f]].base : base;
        named = c->base ? c->base : named;
    }
    struct yaml *y = yaml_open(a); /* the design's seed in this stimulus, as a key of the scene */
    struct yaml_node **path = ARENA_TAKE(a, struct yaml_node *, 2);
    path[0] = yaml_make(y, YAML_SCALAR, t->seed, "seed");
    keys[n++] = (struct scene_layer_key){
        path, yaml_make(y, YAML_SCALAR, t->seed, arena_format(a, "%llu", (unsigned long long)d->stimuli[i].seed))};
    const struct scene_layer layer = {named->at, keys, n};
    return scene_read(base, &(struct scene_overrides){.layer = &layer}, a, s, messages, e);
}

bool design_scene_recording(const struct design *d, int i, struct err *e)
{
    const struct diag_place *at = &yaml_get(d->texts->cells[d->stimuli[i].cell].entry, "file")->at;
    char name[sizeof e->text], number[32];
    text_show(at->source->name, name, sizeof name);
    int file = (int)strlen(name), rest = snprintf(number, sizeof number, ":%d:%d: ", at->line, at->column);
    err_at(e, "%s:%d:%d", at->source->name, at->line, at->column);
    e->place = (struct err_place){file, file + rest, at->line, at->column, at->width};
    return false;
}

void design_scene_places(const struct design *d, struct scene *s, struct arena *a)
{
    if (d->level_rule != DESIGN_LEVEL_SCENE) scene_places_move(s, "output.level", "level", &d->texts->level, a);
    if (d->length_rule == DESIGN_LENGTH_FIXED) scene_places_move(s, "output.duration", "length", &d->texts->length, a);
}

/* ------------------------------------------------------------------ the list */

struct table {
    const struct design *d;
    FILE *f;
    const char *const *states; /* NULL: none */
    int *width;                /* [columns] */
    bool recordings;
};

enum { COLUMN_NAME, COLUMN_SAMPLE, COLUMN_REPLICATE, COLUMN_SEED, COLUMN_RECORDING, COLUMN_STATE, COLUMN_FACTORS };

/* The cell_text's text, row -1 the head; `number` is room for numbers. */
static const char *cell_text(const struct table *t, int row, int column, char number[24])
{
    static const char *const heads[] = {"name", "sample", "replicate", "seed", "recording", "state"};
    const struct design_stimulus *s = row < 0 ? NULL : &t->d->stimuli[row];
    if (column >= COLUMN_FACTORS)
        return s ? design_label(t->d, row, column - COLUMN_FACTORS) : t->d->factors[column - COLUMN_FACTORS].name;
    if (!s || column == COLUMN_NAME) return s ? s->name : heads[column];
    if (column == COLUMN_RECORDING) return s->recording ? s->recording : "n/a";
    if (column == COLUMN_STATE) return t->states ? t->states[row] : "";
    if (s->recording) return "n/a";
    snprintf(number, 24, "%llu",
             column == COLUMN_SEED     ? (unsigned long long)s->seed
             : column == COLUMN_SAMPLE ? (unsigned long long)s->sample
                                       : (unsigned long long)s->replicate);
    return number;
}

static int width_of(const char *text) { return (int)text_utf8_count(text, strlen(text)); }

static void put_cell(const struct table *t, int row, int column, bool last)
{
    char number[24];
    const char *text = cell_text(t, row, column, number);
    fprintf(t->f, "  %s%*s", text, last ? 0 : t->width[column] - width_of(text), "");
}

void design_print(const struct design *d, const bool *mine, const char *const *states, FILE *f)
{
    struct arena *a = arena_open();
    struct table t = {.d = d, .f = f, .states = states, .width = ARENA_TAKE(a, int, COLUMN_FACTORS + d->n_factors)};
    int digits = snprintf(NULL, 0, "%d", d->n_stimuli);
    for (int i = 0; i < d->n_stimuli; i++)
        t.recordings = t.recordings || d->stimuli[i].recording;
    for (int row = -1; row < d->n_stimuli; row++)
        for (int c = 0; c < COLUMN_FACTORS + d->n_factors; c++) {
            char number[24];
            int n = width_of(cell_text(&t, row, c, number));
            t.width[c] = n > t.width[c] ? n : t.width[c];
        }
    int last = states ? COLUMN_STATE : t.recordings ? COLUMN_RECORDING : COLUMN_SEED;
    for (int row = -1; row < d->n_stimuli; row++) { /* name and labels first, then what follows from them */
        if (row >= 0 && mine && !mine[row]) continue;
        if (row < 0)
            fprintf(f, "%*s", digits, "#");
        else
            fprintf(f, "%*d", digits, row + 1);
        put_cell(&t, row, COLUMN_NAME, false);
        for (int k = 0; k < d->n_factors; k++)
            put_cell(&t, row, COLUMN_FACTORS + k, false);
        for (int c = COLUMN_SAMPLE; c <= last; c++)
            if ((c != COLUMN_SAMPLE || d->samples) && (c != COLUMN_REPLICATE || d->replicates > 1) &&
                (c != COLUMN_RECORDING || t.recordings))
                put_cell(&t, row, c, c == last);
        fputc('\n', f);
    }
    arena_close(a);
}

/* ------------------------------------------------------------------ the whole */

static const char *const keys[] = {
    "rasp-design", "title",   "text",   "base",        "seed",  "set",  "factors", "exclude", "cells",  "recordings",
    "replicates",  "samples", "splits", "independent", "order", "name", "level",   "length",  "trials", NULL};

static void text_read(struct yaml *y, const struct diag_source *source, struct design *d)
{
    struct yaml_node *root = yaml_parse(y, source);
    struct design_reading r = {
        .yaml = y, .arena = y->arena, .root = root, .design = d, .texts = ARENA_TAKE(y->arena, struct design_texts, 1)};
    d->texts = r.texts;
    if (!root) return;
    if (root->kind != YAML_MAP) {
        diag_add(y->diag, root->at, "write keys with values, such as: base: scrape.yaml",
                 "a design must be a map of keys");
        return;
    }
    const struct yaml_node *version = yaml_get(root, "rasp-design"), *scene = yaml_get(root, "rasp");
    if (version && version->kind == YAML_SCALAR && *version->text && strcmp(version->text, "1") != 0 &&
        strspn(version->text, "0123456789") == strlen(version->text)) /* what else looks wrong in it need not be */
        diag_add(y->diag, version->at,
                 "this program reads designs of version 1, written rasp-design: 1; a newer one may read this design",
                 "rasp-design must be 1, not '%s'", diag_shown(y->diag, version->text));
    else if (scene && !version) { /* what is wrong with it as a design is no help */
        y->diag->n = 0;
        diag_add(y->diag, scene->key->at,
                 "rasp render renders it, rasp check checks it; rasp new design writes a starter design",
                 "this is a scene, not a design of many scenes");
    } else {
        r.keys = keys_text_names(y->arena);
        design_reading_known(&r, root, keys, "");
        design_rules_read(&r);
        design_factors_read(&r);
        design_rules_independent(&r);
        design_names_template(&r);
        design_text_read(&r); /* those after it as far as the earlier ones are good */
        if (y->diag->n == 0) design_rows_cells(&r);
        if (y->diag->n == 0) design_rows_stimuli(&r);
        if (y->diag->n == 0) design_names_make(&r);
        r.texts->cells = r.cells;
        if (y->diag->n == 0) design_trials_read(&r);
        if (y->diag->n == 0) design_rows_hash(&r);
    }
}

bool design_read(const char *file, struct arena *a, struct design *d, const char **messages, struct err *e)
{
    struct yaml *y = yaml_open(a);
    struct diag_source *source = yaml_bytes_read(y, file, (struct diag_place){NULL, 0, 0, 0});
    *d = (struct design){.file = arena_text(a, file), .sources = ARENA_TAKE(a, const char *, 3)};
    d->sources[0] = d->file;
    d->diag = y->diag;
    *messages = "";
    if (source) text_read(y, source, d);
    if (y->diag->n == 0) return true;
    *messages = diag_text(y->diag);
    return err_set(e, y->missing ? interrupt_seen() ? ERR_INTERRUPTED : ERR_INPUT : ERR_SCENE, "%s",
                   diag_first(y->diag));
}

const char *design_label(const struct design *d, int i, int factor)
{
    int level = d->stimuli[i].level[factor];
    return level < 0 ? "n/a" : d->factors[factor].levels[level].label;
}

const char *design_value(const struct design *d, int i, int factor)
{
    int level = d->stimuli[i].level[factor];
    return level < 0 ? "n/a" : d->factors[factor].levels[level].value;
}

bool design_is(const char *file)
{
    static const char key[] = "rasp-design";
    struct arena *a = arena_open();
    size_t size, n = strlen(key);
    const char *text = yaml_bytes_text(file, a, &size), *end = text ? text + size : NULL;
    bool found = false, flow = false;
    for (const char *line = text; line && line < end && !found;) {
        /* a line's beginning, after { in flow style ({rasp-design: 1, ...}), is the key, quoted perhaps */
        flow = flow || *line == '{';
        const char *at = line + (flow ? strspn(line, "{ \t") : 0), *s = at + (*at == '"' || *at == '\'');
        found = !strncmp(s, key, n) && (s[n] == ':' || s[n] == ' ' || (s != at && s[n] == *at));
        line = memchr(line, '\n', (size_t)(end - line));
        line = line ? line + 1 : NULL;
    }
    arena_close(a);
    return found;
}
