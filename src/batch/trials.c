/* See trials.h. A trial is known by the names of its stimuli. Streams: "rasp trials WHAT NAME" of the seed, row: the
   participant, column: the sitting. */
#include "batch/trials.h"

#include <stdlib.h>
#include <string.h>

#include "num/noise.h"

/* ------------------------------------------------------------------ which stimuli are presented together */

/* By all factors but those within, the first the slowest; training; sample; replicate. */
static int group_order(const struct design *d, int i, int j)
{
    const struct design_stimulus *p = &d->stimuli[i], *q = &d->stimuli[j];
    const struct design_trials *t = d->trials;
    for (int f = 0; f < d->n_factors; f++)
        if (!t->within[f] && p->level[f] != q->level[f]) return p->level[f] - q->level[f];
    int training = t->for_training[i] - t->for_training[j];
    if (training) return training;
    return p->sample != q->sample ? p->sample - q->sample : p->replicate - q->replicate;
}

static int by_group(const void *pi, const void *pj, void *design)
{
    int i = *(const int *)pi, j = *(const int *)pj, order = group_order(design, i, j);
    return order ? order : i - j;
}

static const char *name_of(const struct trials *t, const struct trial *x, int k)
{
    return t->design->stimuli[x->stimuli[k]].name;
}

/* What the trial says: recordings may say something of their own, which is not of the trial. */
static bool text_set(const struct trials *t, struct trial *x, struct arena *a, struct err *e)
{
    const struct design *d = t->design;
    if (d->trials->task == DESIGN_TASK_CHOOSE) return true; /* it may well be the answer */
    for (int k = 0; k < x->n; k++) {
        const char *text = d->stimuli[x->stimuli[k]].recording && x->n > 1 ? NULL : design_text(d, x->stimuli[k], a);
        if (!text) continue;
        if (x->text && strcmp(x->text, text) != 0)
            return err_set(e, ERR_SCENE, "text: names a factor that differs within a trial: '%s' and '%s' (%s and %s)",
                           x->text, text, name_of(t, x, 0), name_of(t, x, k));
        for (const char *s = text; *s; s++)
            if ((unsigned char)*s < ' ')
                return err_set(e, ERR_SCENE, "text: must be one line, as '%s' of %s is not", text, name_of(t, x, k));
        x->text = text;
    }
    return true;
}

static bool add(struct trials *t, const int *stimuli, int n, struct arena *a, struct err *e)
{
    const struct design *d = t->design;
    const struct design_trials *w = d->trials;
    const int *level = d->stimuli[stimuli[0]].level;
    struct trial x = {.id = t->n + 1,
                      .session = w->session < 0 ? -1 : level[w->session],
                      .block = w->block < 0 ? -1 : level[w->block],
                      .training = w->for_training[stimuli[0]],
                      .n = n,
                      .stimuli = ARENA_TAKE(a, int, n)};
    x.reference = -1;
    for (int k = 0; k < n; k++) {
        bool is = w->roles[x.stimuli[k] = stimuli[k]] == DESIGN_ROLE_REFERENCE;
        if (is && x.reference >= 0)
            return err_set(e, ERR_SCENE, "trials.reference: one trial has two: %s and %s", d->stimuli[x.reference].name,
                           name_of(t, &x, k));
        if (is) x.reference = stimuli[k];
    }
    if (x.reference >= 0 && n == 1)
        return err_set(e, ERR_SCENE, "trials.reference: the trial of %s has nothing beside its reference",
                       name_of(t, &x, 0));
    if (n > TRIALS_SOUNDS)
        return err_set(e, ERR_SCENE, "trials.within: the trial of %s has %d sounds, more than %d", name_of(t, &x, 0), n,
                       TRIALS_SOUNDS);
    if (t->n == TRIALS_MOST) return err_set(e, ERR_SCENE, "trials.within: there are more than %d trials", TRIALS_MOST);
    if (!text_set(t, &x, a, e)) return false;
    t->all = arena_more(a, t->all, t->n, sizeof *t->all);
    t->all[t->n++] = x;
    t->most = n > t->most ? n : t->most;
    return true;
}

/* A group of stimuli: one trial, or of compared ones each pair. */
static bool add_group(struct trials *t, const int *stimuli, int n, struct arena *a, struct err *e)
{
    const struct design *d = t->design;
    if (d->trials->task != DESIGN_TASK_COMPARE) return add(t, stimuli, n, a, e);
    bool *differs = ARENA_TAKE(a, bool, d->n_factors + 1);
    for (int k = 0; k < n * d->n_factors; k++)
        differs[k % d->n_factors] |= d->stimuli[stimuli[k / d->n_factors]].level[k % d->n_factors] !=
                                     d->stimuli[stimuli[0]].level[k % d->n_factors];
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++) {
            if (!add(t, (const int[2]){stimuli[i], stimuli[j]}, 2, a, e)) return false;
            t->all[t->n - 1].differs = differs;
        }
    return n > 1 || err_set(e, ERR_SCENE, "trials.within: %s has no other sound to be compared with",
                            d->stimuli[stimuli[0]].name);
}

/* The sessions that have a trial that counts; references are in all trials, or in none. */
static bool all_check(struct trials *t, struct arena *a, struct err *e)
{
    const struct trial *with = NULL, *without = NULL;
    int session = t->design->trials->session, last = session < 0 ? -1 : t->design->factors[session].n_levels - 1;
    t->sessions = ARENA_TAKE(a, int, last + 2);
    for (int l = session < 0 ? -1 : 0; l <= last; l++) {
        bool counts = false;
        for (int i = 0; i < t->n && !counts; i++)
            counts = t->all[i].session == l && !t->all[i].training;
        if (counts) t->sessions[t->n_sessions++] = l;
    }
    for (int i = 0; i < t->n; i++)
        *(t->all[i].reference < 0 ? &without : &with) = &t->all[i];
    if (t->n_sessions == 0) return err_set(e, ERR_SCENE, "trials.training: no trial is left that counts");
    return !with || !without ||
           err_set(e, ERR_SCENE, "trials.reference: the trial of %s has none, that of %s has one",
                   name_of(t, without, 0), name_of(t, with, 0));
}

bool trials_make(const struct design *d, struct arena *a, struct trials *t, struct err *e)
{
    int *order = ARENA_TAKE(a, int, d->n_stimuli + 1);
    bool alone = d->trials->task == DESIGN_TASK_CHOOSE; /* so are takes of a recording that share all levels */
    *t = (struct trials){.design = d};
    for (int i = 0; i < d->n_stimuli; i++)
        order[i] = i;
    qsort_r(order, (size_t)d->n_stimuli, sizeof *order, by_group, (void *)d);
    for (int i = 0, n; i < d->n_stimuli; i += n) {
        for (n = 1; !alone && i + n < d->n_stimuli && !group_order(d, order[i], order[i + n]);)
            n++;
        if (!add_group(t, &order[i], n, a, e)) return false;
    }
    return all_check(t, a, e);
}

int trials_right(const struct trials *t, const struct trial *x)
{
    const struct design_trials *w = t->design->trials;
    int level = w->asked < 0 ? -1 : t->design->stimuli[x->stimuli[0]].level[w->asked];
    for (int i = 0; level >= 0 && i < w->n_answers; i++)
        if (!strcmp(w->answers[i].label, t->design->factors[w->asked].levels[level].label)) return i;
    return -1;
}

/* ------------------------------------------------------------------ orders */

/* The session of a sitting, from 0: rows of 0, n-1, 1, n-2, 2 ... plus the row's number; for an odd n the same rows
   backwards follow. */
static int session_at(int n, int participant, int sitting)
{
    int row = participant % (n % 2 ? 2 * n : n), k = row < n ? sitting : n - 1 - sitting;
    return ((k % 2 ? n - (k + 1) / 2 : k / 2) + row) % n;
}

static int by_rank(const void *pa, const void *pb)
{
    const struct trial *a = pa, *b = pb;
    if (a->training != b->training) return b->training - a->training;
    for (int k = 0; k < 2; k++)
        if (a->rank[k] != b->rank[k]) return a->rank[k] < b->rank[k] ? -1 : 1;
    return a->id - b->id;
}

struct draw {
    uint64_t seed;
    int participant, sitting;
};

static uint64_t draw(const struct draw *from, const char *what, const char *name, struct arena *a)
{
    uint64_t bits[2];
    struct noise stream = noise_make(from->seed, arena_format(a, "rasp trials %s %s", what, name));
    noise_bits(stream, (uint64_t)from->participant, (uint64_t)from->sitting, bits);
    return bits[0];
}

/* The sounds of a trial in an order of their own. */
static void sounds_draw(const struct trials *t, struct trial *x, const char *name, const struct draw *from,
                        struct arena *a)
{
    int *stimuli = ARENA_TAKE(a, int, x->n);
    uint64_t ranks[TRIALS_SOUNDS];
    for (int k = 0; k < x->n; k++) { /* by insertion */
        uint64_t rank = draw(from, "sound", arena_format(a, "%s in %s", name_of(t, x, k), name), a);
        int at = k;
        for (; at > 0 && ranks[at - 1] > rank; at--) {
            ranks[at] = ranks[at - 1];
            stimuli[at] = stimuli[at - 1];
        }
        ranks[at] = rank;
        stimuli[at] = x->stimuli[k];
    }
    x->stimuli = stimuli;
}

struct trial *trials_list(const struct trials *t, uint64_t seed, int participant, int sitting, struct arena *a, int *n)
{
    const struct design_trials *w = t->design->trials;
    const struct draw from = {seed, participant, sitting};
    int session = t->sessions[session_at(t->n_sessions, participant - 1, sitting - 1)], all = 0, first = 0;
    struct trial *list = ARENA_TAKE(a, struct trial, t->n + w->training + 1);
    for (int i = 0; i < t->n; i++) {
        if (t->all[i].session >= 0 && t->all[i].session != session) continue;
        struct trial *x = &list[all++];
        *x = t->all[i];
        const char *name = name_of(t, x, 0);
        for (int k = 1; k < x->n; k++)
            name = arena_format(a, "%s %s", name, name_of(t, x, k));
        if (x->block >= 0 && !x->training)
            x->rank[0] = draw(&from, "block", t->design->factors[w->block].levels[x->block].label, a);
        x->rank[1] = draw(&from, "trial", name, a);
        sounds_draw(t, x, name, &from, a);
        first += x->training;
    }
    qsort(list, (size_t)all, sizeof *list, by_rank);
    /* Drawn for training, behind the first: the last trials of as many equal stretches, of all blocks so. */
    int rest = all - first, drawn = w->training < rest ? w->training : rest;
    memmove(list + first + drawn, list + first, (size_t)rest * sizeof *list);
    for (int k = 0; k < drawn; k++) {
        list[first + k] = list[first + drawn + (int)((long)(k + 1) * rest / drawn) - 1];
        list[first + k].training = true;
    }
    *n = all + drawn;
    for (int i = first + drawn; i < *n; i++)
        list[i].part = i == first + drawn ? 1 : list[i - 1].part + (list[i].block != list[i - 1].block);
    return list;
}
