/* See unheard.h. Sorted by the hash of their samples, stimuli that have the same ones stand together, in the order of the design; each is compared with the first of its group. */
#include "batch/unheard.h"

#include <stdlib.h>
#include <string.h>

struct sound {
    char audio[HASH_TEXT];
    int row;
};

struct search {
    const struct results *all;
    struct sound *sounds;
    int n, found;            /* found: stimuli that differ in some factor from the first of their group */
    bool *factors;           /* [n_factors] that they differ in */
    const struct sound *pair[2], *replicates[2]; /* the first in the design: of these, and of a cell's; NULL: none */
};

static bool gather(struct search *s, struct err *e)
{
    const struct set *set = s->all->set;
    for (int i = 0; i < set->n; i++) {
        if (set->rows[i].recording || !s->all->of[i].record.size)
            continue;
        struct arena *a = arena_open();
        const struct record *r = journal_read(s->all->journal, s->all->of[i].record, a, e);
        if (r && r->audio && r->job) {
            snprintf(s->sounds[s->n].audio, HASH_TEXT, "%s", r->audio);
            s->sounds[s->n++].row = i;
        }
        arena_close(a);
        if (!r)
            return false;
    }
    return true;
}

static int by_audio(const void *a, const void *b)
{
    const struct sound *p = a, *q = b;
    int hashes = strcmp(p->audio, q->audio);
    return hashes ? hashes : (p->row > q->row) - (p->row < q->row);
}

static void compare(struct search *s, const struct sound *first, const struct sound *other)
{
    const struct set *set = s->all->set;
    bool differ = false;
    for (int k = 0; k < set->n_factors; k++)
        if (strcmp(set->rows[first->row].values[k], set->rows[other->row].values[k]) != 0)
            differ = s->factors[k] = true;
    if (differ && (!s->found++ || first->row < s->pair[0]->row))
        s->pair[0] = first, s->pair[1] = other;
    if (!differ && (!s->replicates[0] || first->row < s->replicates[0]->row))
        s->replicates[0] = first, s->replicates[1] = other;
}

static const char *tell_factors(const struct search *s, struct arena *a)
{
    const struct set *set = s->all->set;
    const char *names = "";
    for (int k = 0; k < set->n_factors; k++)
        if (s->factors[k])
            names = arena_format(a, "%s%s%s", names, *names ? ", " : "", set->factors[k].name);
    return arena_format(a, "%d of %d sounds %s the very samples of another one that differs in %s (%s and %s): what the factor's levels set has no effect there", s->found, s->n,
                        s->found == 1 ? "has" : "have", names, set->rows[s->pair[0]->row].name, set->rows[s->pair[1]->row].name);
}

static const char *tell(const struct search *s, struct arena *a)
{
    const struct set_row *rows = s->all->set->rows;
    const char *text = s->found ? tell_factors(s, a) : "";
    if (!s->replicates[0])
        return text;
    return arena_format(a, "%s%sreplicates have the very samples of each other (%s and %s): nothing is random there, and one would do", text, *text ? "; " : "",
                        rows[s->replicates[0]->row].name, rows[s->replicates[1]->row].name);
}

bool unheard_find(const struct results *all, struct arena *a, const char **text, struct err *e)
{
    struct search s = {.all = all, .sounds = ARENA_TAKE(a, struct sound, all->set->n), .factors = ARENA_TAKE(a, bool, all->set->n_factors + 1)};
    *text = "";
    if (!gather(&s, e))
        return false;
    if (s.n)
        qsort(s.sounds, (size_t)s.n, sizeof *s.sounds, by_audio);
    for (int i = 1, first = 0; i < s.n; i++) {
        if (strcmp(s.sounds[first].audio, s.sounds[i].audio) != 0)
            first = i;
        else
            compare(&s, &s.sounds[first], &s.sounds[i]);
    }
    *text = tell(&s, a);
    return true;
}
