/* The cells of a design, crossed or listed, each once for each sample, without those that are excluded, and the
   recordings; stimuli from cells: replicates, noise seeds, the order of presentation.

   The seed of a stimulus is the first 8 bytes (big-endian) of the SHA-256 of the text
       rasp design seed\0 SEED \0 REPLICATE \0 sample\0 NUMBER \0 FACTOR \0 LABEL \0 ...
   with the sample, unless samples share their noise, and the factors whose levels are to be independent, in the order
   of their names (by bytes): it depends on nothing else, so that a level, a factor, a sample or a replicate more
   changes no other stimulus. Shuffling sorts by such a hash of the order's seed and all labels, for the same reason:
   what is added comes between, and the others keep their order. */
#include "batch/design_reading.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "file/csv.h"
#include "scene/scene_merge.h"

/* ------------------------------------------------------------------ cells */

enum { MATCHES = 1000, TABLE_ERRORS = 20 /* of the rows of a table that are reported */ };

/* ------------------------------------------------------------------ crossing */

struct crossing { /* a factor's levels but for those of recordings */
    int *level, n;
};

static double crossed(const struct design *d, const struct crossing *all)
{
    double n = 1;
    for (int f = 0; f < d->n_factors; f++)
        n *= all[f].n;
    return n;
}

static struct design_cell *cell_add(struct design_reading *r)
{
    r->cells = arena_more(r->arena, r->cells, (int)r->n_cells, sizeof *r->cells);
    return &r->cells[r->n_cells++];
}

bool design_rows_match(const struct design *d, const int *level, struct design_match *all, int n)
{
    bool any = false;
    for (int i = 0; i < n; i++) {
        bool match = true;
        for (int f = 0; match && f < d->n_factors; f++)
            match = !all[i].named[f] || (level[f] >= 0 && all[i].named[f][level[f]]);
        all[i].matched = all[i].matched || match;
        any = any || match;
    }
    return any;
}

/* Of the cell with these levels, but for those that are drawn, each sample, unless it is excluded. */
static void samples_add(struct design_reading *r, const int *level, const struct yaml_node *entry,
                        struct design_match *all, int n)
{
    const struct design *d = r->design;
    int most = d->samples ? d->samples : 1, *levels = ARENA_TAKE(r->arena, int, (long)most * d->n_factors + 1);
    for (int k = 0; k < most; k++) {
        for (int f = 0; f < d->n_factors; f++)
            levels[f] = d->factors[f].drawn ? r->drawn[f][k] : level[f];
        if (design_rows_match(d, levels, all, n)) continue;
        *cell_add(r) = (struct design_cell){.level = levels, .sample = d->samples ? k + 1 : 0, .entry = entry};
        levels += d->n_factors;
    }
}

/* The first factor is the slowest. */
static void cells_cross(struct design_reading *r, const struct crossing *factors, struct design_match *all, int n)
{
    const struct design *d = r->design;
    long most = (long)crossed(d, factors);
    int *levels = ARENA_TAKE(r->arena, int, d->n_factors + 1);
    for (long i = 0; i < most; i++) {
        long cell = i;
        for (int f = d->n_factors - 1; f >= 0; f--) {
            levels[f] = factors[f].level[cell % factors[f].n];
            cell /= factors[f].n;
        }
        samples_add(r, levels, NULL, all, n);
    }
}

/* ------------------------------------------------------------------ listing */

/* The levels that a map of factor: label says, -1 where it says none; keys of `own` (NULL-terminated) are not factors.
 */
static int *entry_levels(const struct design_reading *r, const struct yaml_node *map, const char *const *own)
{
    int *level = ARENA_TAKE(r->arena, int, r->design->n_factors + 1);
    for (int f = 0; f < r->design->n_factors; f++)
        level[f] = -1;
    for (const struct yaml_node *item = map->first; item; item = item->next) {
        int i = 0;
        while (own[i] && strcmp(own[i], item->key->text) != 0)
            i++;
        int f = own[i] ? -1 : design_reading_factor(r, item->key);
        if (f >= 0) level[f] = design_reading_level(r, f, item, own[0] != NULL);
    }
    return level;
}

/* Entries that are no maps are reported here. */
static bool is_list(const struct design_reading *r, const struct yaml_node *list, const char *label, const char *cure)
{
    if (list->kind != YAML_LIST) return design_reading_must(r, list, label, "a list", cure);
    for (const struct yaml_node *item = list->first; item; item = item->next)
        if (item->kind != YAML_MAP)
            design_reading_must(r, item, arena_format(r->arena, "an entry of %s", label), "a map", cure);
    return true;
}

static void cells_list(struct design_reading *r, const struct yaml_node *list, struct design_match *all, int n)
{
    static const char *const own[] = {NULL};
    int errors = r->yaml->diag->n;
    if (!is_list(r, list, "cells", "write cells: [{material: wood, motion.rate: 1 Hz}], or cells: FILE.csv")) return;
    for (const struct yaml_node *entry = list->first; entry; entry = entry->next) {
        if (entry->kind != YAML_MAP) continue;
        int *level = entry_levels(r, entry, own);
        for (int f = 0; f < r->design->n_factors; f++) {
            const struct design_factor *factor = &r->design->factors[f];
            const struct yaml_node *given = yaml_get(entry, factor->name);
            if (factor->drawn && given)
                diag_add(r->yaml->diag, given->key->at, "leave it out: each cell has every sample", "%s is drawn",
                         factor->name);
            else if (!given && !factor->drawn)
                diag_add(r->yaml->diag, entry->at, "name a level of every factor", "this cell says nothing of %s",
                         factor->name);
            else if (level[f] >= 0 && factor->levels[level[f]].recorded)
                diag_add(r->yaml->diag, given->at, "list a recording under recordings:, or leave of: out of the level",
                         "'%s' of %s is a level that only recordings have",
                         diag_shown(r->yaml->diag, factor->levels[level[f]].label), factor->name);
        }
        if (r->yaml->diag->n == errors) samples_add(r, level, entry, all, n);
    }
}

/* Of cells: FILE.csv */
static void cells_table(struct design_reading *r, struct design_match *all, int n)
{
    const struct design *d = r->design;
    const struct csv *t = r->table;
    const struct diag_place head = {r->table_source, 0, 0, 0};
    int errors = r->yaml->diag->n, *level = ARENA_TAKE(r->arena, int, d->n_factors + 1);
    for (size_t c = 0; c < t->columns; c++)
        design_reading_factor(r, &(struct yaml_node){.kind = YAML_SCALAR, .at = head, .text = t->names[c]});
    for (int f = 0; f < d->n_factors; f++)
        if ((csv_column(t, d->factors[f].name) >= 0) == d->factors[f].drawn)
            diag_add(r->yaml->diag, head,
                     d->factors[f].drawn ? "take the column out, or let its factor be: cells"
                                         : "add the column, with a level in each row",
                     d->factors[f].drawn ? "%s is drawn: it cannot be a column" : "there is no column %s",
                     d->factors[f].name);
    if (t->rows == 0) diag_add(r->yaml->diag, head, "write a row for each cell", "the table of cells has no rows");
    for (size_t row = 0; row < t->rows && r->yaml->diag->n < errors + TABLE_ERRORS; row++) {
        int before = r->yaml->diag->n;
        if (r->yaml->diag->n == errors || row < TABLE_ERRORS) design_made_row(r, row, level);
        if (before == errors && r->yaml->diag->n == errors) samples_add(r, level, NULL, all, n);
    }
}

/* ------------------------------------------------------------------ picking by levels */

static void level_name(const struct design_reading *r, int f, const struct yaml_node *label, unsigned char *named)
{
    int i = design_reading_level(r, f, label, false);
    if (i >= 0) named[i] = 1;
}

struct design_match *design_rows_matches(const struct design_reading *r, const struct yaml_node *list,
                                         const char *label, int *n)
{
    const char *cure = arena_format(r->arena, "write for instance: %s: [{material: wood, motion.rate: 2 Hz}]", label);
    struct design_match *all = ARENA_TAKE(r->arena, struct design_match, list ? list->n + 1 : 1);
    *n = 0;
    if (list && list->n > MATCHES) {
        diag_add(r->yaml->diag, list->at, "list the cells that there are: cells:", "%s has more than %d entries", label,
                 MATCHES);
        return all;
    }
    if (!list || !is_list(r, list, label, cure)) return all;
    for (const struct yaml_node *entry = list->first; entry; entry = entry->next) {
        if (entry->kind != YAML_MAP) continue;
        struct design_match *x = &all[(*n)++];
        *x = (struct design_match){.entry = entry,
                                   .named = ARENA_TAKE(r->arena, unsigned char *, r->design->n_factors + 1)};
        if (entry->n == 0) diag_add(r->yaml->diag, entry->at, cure, "this names every cell");
        for (const struct yaml_node *item = entry->first; item; item = item->next) {
            int f = design_reading_factor(r, item->key);
            if (f < 0) continue;
            x->named[f] = arena_take(r->arena, (size_t)r->design->factors[f].n_levels, 1);
            if (item->kind != YAML_LIST) level_name(r, f, item, x->named[f]);
            for (const struct yaml_node *one = item->kind == YAML_LIST ? item->first : NULL; one; one = one->next)
                level_name(r, f, one, x->named[f]);
        }
    }
    return all;
}

/* ------------------------------------------------------------------ recordings */

static void recordings_add(struct design_reading *r, const struct yaml_node *list)
{
    static const char *const own[] = {"file", "name", "text", NULL};
    static const char cure[] = "write for instance: recordings: [{file: recorded/wood.wav, material: wood}]";
    if (!is_list(r, list, "recordings", cure)) return;
    for (const struct yaml_node *entry = list->first; entry; entry = entry->next) {
        if (entry->kind != YAML_MAP) continue;
        const struct yaml_node *file = yaml_get(entry, "file");
        const struct yaml_node *text = yaml_get(entry, "text");
        int *level = entry_levels(r, entry, own);
        if (text && text->kind != YAML_SCALAR)
            design_reading_must(r, text, "text", "what the text of a trial is", cure);
        if (!file)
            diag_add(r->yaml->diag, entry->at, cure, "this recording has no file");
        else if (file->kind != YAML_SCALAR || !*file->text)
            design_reading_must(r, file, "file", "the name of a WAV", cure);
        else
            *cell_add(r) = (struct design_cell){
                .level = level, .entry = entry, .recording = scene_merge_path(r->yaml, file->at.source, file->text)};
    }
}

/* Levels that are said to be of recordings, and are of none. */
static void recorded_check(const struct design_reading *r)
{
    for (int f = 0; f < r->design->n_factors; f++) {
        const struct design_factor *factor = &r->design->factors[f];
        bool *used = ARENA_TAKE(r->arena, bool, factor->n_levels + 1);
        for (long c = 0; c < r->n_cells; c++)
            if (r->cells[c].level[f] >= 0) used[r->cells[c].level[f]] = true;
        for (int i = 0; i < factor->n_levels; i++)
            if (factor->levels[i].recorded && !used[i])
                diag_add(r->yaml->diag, design_reading_item(r, f, i)->at,
                         arena_format(r->arena,
                                      "give it to one: recordings: [{file: recorded.wav, %s: %s}]; or remove it",
                                      factor->name, factor->levels[i].label),
                         "no recording has this level of %s", factor->name);
    }
}

/* ------------------------------------------------------------------ all */

void design_rows_cells(struct design_reading *r)
{
    const struct yaml_node *cells = design_reading_value(r, "cells"),
                           *recordings = design_reading_value(r, "recordings");
    int n, errors = r->yaml->diag->n;
    struct design_match *all = design_rows_matches(r, design_reading_value(r, "exclude"), "exclude", &n);
    int samples = r->design->samples ? r->design->samples : 1;
    struct crossing *levels = ARENA_TAKE(r->arena, struct crossing, r->design->n_factors + 1);
    for (int f = 0; f < r->design->n_factors; f++) {
        const struct design_factor *factor = &r->design->factors[f];
        levels[f].level = ARENA_TAKE(r->arena, int, factor->n_levels + 1);
        for (int i = 0; i < factor->n_levels; i++)
            if (!factor->levels[i].recorded && (i == 0 || !factor->drawn)) levels[f].level[levels[f].n++] = i;
    }
    const struct yaml_node *at = cells ? cells : design_reading_value(r, "factors");
    double stimuli = (r->table ? (double)r->table->rows
                      : cells  ? cells->n
                               : crossed(r->design, levels)) *
                     samples * r->design->replicates;
    if (stimuli > DESIGN_READING_CELLS) {
        diag_add(r->yaml->diag, at ? at->at : r->root->at, "make several designs of it",
                 "this makes %.0f stimuli; a design has at most %d", stimuli, DESIGN_READING_CELLS);
        return;
    }
    if (r->table)
        cells_table(r, all, n);
    else if (cells)
        cells_list(r, cells, all, n);
    else if (r->yaml->diag->n == errors)
        cells_cross(r, levels, all, n);
    bool good = r->yaml->diag->n == errors;
    for (int i = 0; good && i < n; i++)
        if (!all[i].matched)
            diag_add(r->yaml->diag, all[i].entry->at, "remove it, or mend it",
                     "this excludes nothing: there is no such cell");
    if (r->yaml->diag->n == errors && r->n_cells == 0)
        diag_add(r->yaml->diag,
                 (cells ? cells : yaml_get(r->root, yaml_get(r->root, "exclude") ? "exclude" : "factors"))->at,
                 "leave some in", "no cell is left");
    if (recordings) recordings_add(r, recordings);
    if (r->yaml->diag->n == errors) recorded_check(r);
}

/* ------------------------------------------------------------------ stimuli */

static void add_number(struct hash *x, uint64_t n)
{
    char text[24];
    snprintf(text, sizeof text, "%llu", (unsigned long long)n);
    hash_text(x, text);
}

static uint64_t first_64_bits(struct hash *x)
{
    char hex[HASH_TEXT];
    hash_end(x, hex);
    hex[16] = '\0';
    return strtoull(hex, NULL, 16);
}

/* ------------------------------------------------------------------ seeds and order */

static int by_factor_name(const void *pa, const void *pb)
{
    const struct design_factor *const *a = pa, *const *b = pb;
    return strcmp((*a)->name, (*b)->name);
}

static void add_labels(struct hash *x, const struct design *d, const struct design_factor *const *factors,
                       const int *level, bool independent)
{
    for (; *factors; factors++) {
        const struct design_factor *f = *factors;
        int i = level[f - d->factors];
        if (i < 0 || (independent && !f->independent)) continue;
        hash_text(x, f->name);
        hash_text(x, f->levels[i].label);
    }
}

struct ranked {
    struct design_stimulus stimulus;
    uint64_t rank;
};

static int by_rank(const void *pa, const void *pb)
{
    const struct ranked *a = pa, *b = pb;
    if (a->rank != b->rank) return a->rank < b->rank ? -1 : 1;
    return a->stimulus.cell < b->stimulus.cell ? -1 : a->stimulus.cell > b->stimulus.cell;
}

static void shuffle(struct design_reading *r, const struct design_factor *const *factors)
{
    struct design *d = r->design;
    struct ranked *all = ARENA_TAKE(r->arena, struct ranked, d->n_stimuli);
    for (int i = 0; i < d->n_stimuli; i++) {
        const struct design_stimulus *s = &d->stimuli[i];
        const struct yaml_node *file = s->recording ? yaml_get(r->cells[s->cell].entry, "file") : NULL;
        struct hash x = hash_start();
        hash_text(&x, "rasp design order");
        add_number(&x, d->order_seed);
        add_number(&x, (uint64_t)s->replicate);
        if (s->sample) add_number(&x, (uint64_t)s->sample);
        hash_text(&x, file ? file->text : "");
        add_labels(&x, d, factors, s->level, false);
        all[i] = (struct ranked){*s, first_64_bits(&x)};
    }
    qsort(all, (size_t)d->n_stimuli, sizeof *all, by_rank);
    for (int i = 0; i < d->n_stimuli; i++)
        d->stimuli[i] = all[i].stimulus;
}

/* ------------------------------------------------------------------ splits */

static const char splits_cure[] = "write for instance: splits: {train: 8, validation: 1, test: 1}";

/* The shares, by their names in design->splits. */
static double *splits_read(struct design_reading *r)
{
    const struct yaml_node *map = design_reading_value(r, "splits");
    double *shares = NULL;
    if (!map) return NULL;
    if (map->kind != YAML_MAP || map->n == 0) {
        design_reading_must(r, map, "splits", "a map of names with shares", splits_cure);
        return NULL;
    }
    shares = ARENA_TAKE(r->arena, double, map->n);
    r->design->splits = ARENA_TAKE(r->arena, const char *, map->n + 1);
    int n = 0;
    for (const struct yaml_node *item = map->first; item; item = item->next) {
        const char *name = item->key->text;
        if (!*name || strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_") != strlen(name))
            diag_add(r->yaml->diag, item->key->at, splits_cure,
                     "the name of a split must be of the letters a-z, digits and _, not '%s'",
                     diag_shown(r->yaml->diag, name));
        if (item->kind != YAML_SCALAR || !text_double(item->text, &shares[n]) || !(shares[n] > 0))
            design_reading_must(r, item, name, "a share above 0", splits_cure);
        r->design->splits[n++] = name;
    }
    return shares;
}

/* By the hash of the seed and the sample's number, or, where nothing is drawn, all labels: replicates, and cells of one
   sample, stay together, and a stimulus more moves no other. */
static const char *split_of(const struct design *d, const double *shares, const struct design_factor *const *factors,
                            const struct design_stimulus *s, const char *file)
{
    struct hash x = hash_start();
    double sum = 0;
    int k = 0;
    hash_text(&x, "rasp split");
    add_number(&x, d->seed);
    if (s->sample)
        add_number(&x, (uint64_t)s->sample);
    else
        add_labels(&x, d, factors, s->level, false);
    hash_text(&x, file);
    for (int i = 0; d->splits[i]; i++)
        sum += shares[i];
    double at = sum * ((double)(first_64_bits(&x) >> 11) * 0x1p-53);
    while (d->splits[k + 1] && at >= shares[k])
        at -= shares[k++];
    return d->splits[k];
}

void design_rows_stimuli(struct design_reading *r)
{
    struct design *d = r->design;
    const struct design_factor **factors = ARENA_TAKE(r->arena, const struct design_factor *, d->n_factors + 1);
    for (int f = 0; f < d->n_factors; f++)
        factors[f] = &d->factors[f];
    qsort(factors, (size_t)d->n_factors, sizeof *factors, by_factor_name);
    d->stimuli = ARENA_TAKE(r->arena, struct design_stimulus, r->n_cells * d->replicates + 1);
    for (long c = 0; c < r->n_cells; c++) {
        const struct design_cell *cell = &r->cells[c];
        for (int k = 1; k <= (cell->recording ? 1 : d->replicates); k++) {
            struct design_stimulus *s = &d->stimuli[d->n_stimuli++];
            *s = (struct design_stimulus){
                .level = cell->level, .replicate = k, .sample = cell->sample, .cell = c, .recording = cell->recording};
            if (cell->recording) continue;
            struct hash x = hash_start();
            hash_text(&x, "rasp design seed");
            add_number(&x, d->seed);
            add_number(&x, (uint64_t)k);
            if (cell->sample && d->samples_independent) {
                hash_text(&x, "sample");
                add_number(&x, (uint64_t)cell->sample);
            }
            add_labels(&x, d, factors, s->level, true);
            s->seed = first_64_bits(&x);
        }
    }
    const double *shares = splits_read(r);
    for (struct design_stimulus *s = d->stimuli; shares && s < d->stimuli + d->n_stimuli; s++)
        s->split = split_of(d, shares, factors, s, s->recording ? yaml_get(r->cells[s->cell].entry, "file")->text : "");
    if (d->shuffled) shuffle(r, factors);
}

/* ------------------------------------------------------------------ the design */

static void add_change(struct hash *x, const struct design_change *c, const char **texts)
{
    hash_text(x, c->base ? c->base->text : "");
    for (; *texts; texts++)
        hash_text(x, *texts);
    hash_text(x, "");
}

void design_rows_hash(struct design_reading *r)
{
    const struct design *d = r->design;
    struct hash x = hash_start();
    const struct level *l = &d->level;
    char rules[200];
    hash_text(&x, "rasp design 1");
    hash_text(&x, d->title ? d->title : "");
    hash_text(&x, d->text ? d->text : "");
    add_number(&x, d->seed);
    snprintf(rules, sizeof rules, "%d %a %a %a %a %a %d %a", d->level_rule, l->peak, l->rms, l->lufs, l->full_scale,
             l->dbfs_at_1_pa, d->length_rule, d->length);
    hash_text(&x, rules);
    hash_text(&x, r->texts->base ? r->texts->base->text : "");
    add_change(&x, &r->texts->set, d->set);
    for (int f = 0; f < d->n_factors; f++) {
        hash_text(&x, d->factors[f].name);
        add_number(&x, (uint64_t)d->factors[f].n_levels);
        for (int i = 0; i < d->factors[f].n_levels; i++) {
            hash_text(&x, d->factors[f].levels[i].label);
            hash_text(&x, d->factors[f].levels[i].text ? d->factors[f].levels[i].text : "");
            if (r->texts->levels[f]) add_change(&x, &r->texts->levels[f][i], d->factors[f].levels[i].set);
        }
    }
    for (const struct design_stimulus *s = d->stimuli; s < d->stimuli + d->n_stimuli; s++) {
        const struct yaml_node *entry = s->recording ? r->cells[s->cell].entry : NULL,
                               *own = entry ? yaml_get(entry, "text") : NULL;
        hash_text(&x, s->name);
        for (int f = 0; f < d->n_factors; f++)
            add_number(&x, (uint64_t)(s->level[f] + 1));
        add_number(&x, (uint64_t)s->replicate);
        if (s->sample) add_number(&x, (uint64_t)s->sample);
        add_number(&x, (uint64_t)s->cell);
        add_number(&x, s->seed);
        if (own) hash_text(&x, own->text);
        hash_text(&x, entry ? yaml_get(entry, "file")->text : "");
    }
    hash_end(&x, r->design->sha256);
}
