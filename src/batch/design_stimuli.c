/* See design_stimuli.h.

   The seed of a stimulus is the first 8 bytes (big-endian) of the SHA-256 of the text
       rasp design seed\0 SEED \0 REPLICATE \0 FACTOR \0 LABEL \0 ...
   with the factors whose levels are to be independent, in the order of their names (by bytes): it depends on nothing else, so that a level, a factor or
   a replicate more changes no other stimulus. Shuffling sorts by such a hash of the order's seed and all labels, for the same reason: what is added comes
   between, and the others keep their order. */
#include "batch/design_stimuli.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch/design_changes.h"

struct hashing {
    struct hash h;
};

static void add_text(struct hashing *x, const char *text)
{
    hash_add(&x->h, text, strlen(text) + 1);
}

static void add_number(struct hashing *x, uint64_t n)
{
    char text[24];
    snprintf(text, sizeof text, "%llu", (unsigned long long)n);
    add_text(x, text);
}

static struct hashing begin(const char *what)
{
    struct hashing x = {hash_start()};
    add_text(&x, what);
    return x;
}

static uint64_t first_64_bits(struct hashing *x)
{
    char hex[HASH_TEXT];
    hash_end(&x->h, hex);
    hex[16] = '\0';
    return strtoull(hex, NULL, 16);
}

/* ------------------------------------------------------------------ seeds and order */

static int by_factor_name(const void *pa, const void *pb)
{
    const struct design_factor *const *a = pa, *const *b = pb;
    return strcmp((*a)->name, (*b)->name);
}

static const struct design_factor **factors_by_name(const struct design_reading *r)
{
    int n = r->design->n_factors;
    const struct design_factor **all = ARENA_TAKE(r->arena, const struct design_factor *, n + 1);
    for (int f = 0; f < n; f++)
        all[f] = &r->design->factors[f];
    qsort(all, (size_t)n, sizeof *all, by_factor_name);
    return all;
}

static void add_labels(struct hashing *x, const struct design *d, const struct design_factor *const *factors, const int *level, bool independent)
{
    for (; *factors; factors++) {
        const struct design_factor *f = *factors;
        int i = level[f - d->factors];
        if (i < 0 || (independent && !f->independent))
            continue;
        add_text(x, f->name);
        add_text(x, f->levels[i].label);
    }
}

static uint64_t seed_of(const struct design *d, const struct design_factor *const *factors, const struct design_stimulus *s)
{
    struct hashing x = begin("rasp design seed");
    add_number(&x, d->seed);
    add_number(&x, (uint64_t)s->replicate);
    add_labels(&x, d, factors, s->level, true);
    return first_64_bits(&x);
}

static uint64_t rank_of(const struct design_reading *r, const struct design_factor *const *factors, const struct design_stimulus *s)
{
    struct hashing x = begin("rasp design order");
    const struct yaml_node *file = s->recording ? yaml_get(r->cells[s->cell].entry, "file") : NULL;
    add_number(&x, r->design->order_seed);
    add_number(&x, (uint64_t)s->replicate);
    add_text(&x, file ? file->text : "");
    add_labels(&x, r->design, factors, s->level, false);
    return first_64_bits(&x);
}

struct ranked {
    struct design_stimulus stimulus;
    uint64_t rank;
};

static int by_rank(const void *pa, const void *pb)
{
    const struct ranked *a = pa, *b = pb;
    if (a->rank != b->rank)
        return a->rank < b->rank ? -1 : 1;
    return a->stimulus.cell < b->stimulus.cell ? -1 : a->stimulus.cell > b->stimulus.cell;
}

static void shuffle(struct design_reading *r, const struct design_factor *const *factors)
{
    struct design *d = r->design;
    struct ranked *all = ARENA_TAKE(r->arena, struct ranked, d->n_stimuli);
    for (int i = 0; i < d->n_stimuli; i++)
        all[i] = (struct ranked){d->stimuli[i], rank_of(r, factors, &d->stimuli[i])};
    qsort(all, (size_t)d->n_stimuli, sizeof *all, by_rank);
    for (int i = 0; i < d->n_stimuli; i++)
        d->stimuli[i] = all[i].stimulus;
}

void design_stimuli_make(struct design_reading *r)
{
    struct design *d = r->design;
    const struct design_factor **factors = factors_by_name(r);
    d->stimuli = ARENA_TAKE(r->arena, struct design_stimulus, r->n_cells * d->replicates + 1);
    for (long c = 0; c < r->n_cells; c++) {
        const struct design_cell *cell = &r->cells[c];
        for (int k = 1; k <= (cell->recording ? 1 : d->replicates); k++) {
            struct design_stimulus *s = &d->stimuli[d->n_stimuli++];
            *s = (struct design_stimulus){.level = cell->level, .replicate = k, .cell = c, .recording = cell->recording};
            s->seed = cell->recording ? 0 : seed_of(d, factors, s);
        }
    }
    if (d->shuffled)
        shuffle(r, factors);
}

/* ------------------------------------------------------------------ the design */

static void add_change(struct hashing *x, const struct design_change *c, const char **texts)
{
    add_text(x, c->base ? c->base->text : "");
    for (; *texts; texts++)
        add_text(x, *texts);
    add_text(x, "");
}

static void add_rules(struct hashing *x, const struct design *d)
{
    char text[200];
    const struct level *l = &d->level;
    add_text(x, d->title ? d->title : "");
    add_text(x, d->text ? d->text : "");
    add_number(x, d->seed);
    snprintf(text, sizeof text, "%d %a %a %a %a %a %d %a", d->level_rule, l->peak, l->rms, l->lufs, l->full_scale, l->dbfs_at_1_pa, d->length_rule, d->length);
    add_text(x, text);
}

static void add_stimulus(struct hashing *x, const struct design_reading *r, const struct design_stimulus *s)
{
    add_text(x, s->name);
    for (int f = 0; f < r->design->n_factors; f++)
        add_number(x, (uint64_t)(s->level[f] + 1));
    add_number(x, (uint64_t)s->replicate);
    add_number(x, (uint64_t)s->cell);
    add_number(x, s->seed);
    if (s->recording && yaml_get(r->cells[s->cell].entry, "text"))
        add_text(x, yaml_get(r->cells[s->cell].entry, "text")->text);
    add_text(x, s->recording ? yaml_get(r->cells[s->cell].entry, "file")->text : "");
}

void design_stimuli_hash(struct design_reading *r)
{
    const struct design *d = r->design;
    struct hashing x = begin("rasp design 1");
    add_rules(&x, d);
    add_text(&x, r->texts->base ? r->texts->base->text : "");
    add_change(&x, &r->texts->set, d->set);
    for (int f = 0; f < d->n_factors; f++) {
        add_text(&x, d->factors[f].name);
        add_number(&x, (uint64_t)d->factors[f].n_levels);
        for (int i = 0; i < d->factors[f].n_levels; i++) {
            add_text(&x, d->factors[f].levels[i].label);
            add_text(&x, d->factors[f].levels[i].text ? d->factors[f].levels[i].text : "");
            add_change(&x, &r->texts->levels[f][i], d->factors[f].levels[i].set);
        }
    }
    for (int i = 0; i < d->n_stimuli; i++)
        add_stimulus(&x, r, &d->stimuli[i]);
    hash_end(&x.h, r->design->sha256);
}
