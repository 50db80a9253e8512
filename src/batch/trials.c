/* See trials.h. A trial is known by the names of its stimuli. Streams: "rasp trials WHAT NAME" of the seed, row: the
   participant, column: the sitting. */
#include "batch/trials.h"

#include <stdlib.h>
#include <string.h>

#include "num/noise.h"

/* ------------------------------------------------------------------ which stimuli are heard together */

/* By all factors but those within, the first the slowest; training; replicate. */
static int group_order(const struct design *d, int i, int j)
{
    const struct design_stimulus *p = &d->stimuli[i], *q = &d->stimuli[j];
    const struct design_trials *t = d->trials;
    for (int f = 0; f < d->n_factors; f++)
        if (!t->within[f] && p->level[f] != q->level[f]) return p->level[f] - q->level[f];
    int training = t->for_training[i] - t->for_training[j];
    return training ? training : p->replicate - q->replicate;
}

struct placed {
    const struct design *design;
    int stimulus;
};

static int by_group(const void *pa, const void *pb)
{
    const struct placed *a = pa, *b = pb;
    int order = group_order(a->design, a->stimulus, b->stimulus);
    return order ? order : a->stimulus - b->stimulus;
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
    bool compare = d->trials->task == DESIGN_TASK_COMPARE;
    if (n == 1 && compare)
        return err_set(e, ERR_SCENE, "trials.within: %s has no other sound to be compared with",
                       d->stimuli[stimuli[0]].name);
    if (!compare) return add(t, stimuli, n, a, e);
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            if (!add(t, (const int[2]){stimuli[i], stimuli[j]}, 2, a, e)) return false;
    return true;
}

static bool all_check(const struct trials *t, struct err *e)
{
    const struct trial *with = NULL, *without = NULL;
    for (int i = 0; i < t->n; i++)
        *(t->all[i].reference < 0 ? &without : &with) = &t->all[i];
    if (t->n_sessions == 0) return err_set(e, ERR_SCENE, "trials.training: no trial is left that counts");
    return !with || !without ||
           err_set(e, ERR_SCENE, "trials.reference: the trial of %s has none, that of %s has one",
                   name_of(t, without, 0), name_of(t, with, 0));
}

bool trials_make(const struct design *d, struct arena *a, struct trials *t, struct err *e)
{
    struct placed *all = ARENA_TAKE(a, struct placed, d->n_stimuli + 1);
    int *stimuli = ARENA_TAKE(a, int, d->n_stimuli + 1), session = d->trials->session;
    *t = (struct trials){.design = d};
    for (int i = 0; i < d->n_stimuli; i++)
        all[i] = (struct placed){d, i};
    qsort(all, (size_t)d->n_stimuli, sizeof *all, by_group);
    bool alone = d->trials->task == DESIGN_TASK_CHOOSE; /* so are takes of a recording that share all levels */
    for (int i = 0, n = 0; i < d->n_stimuli; i++) {
        stimuli[n++] = all[i].stimulus;
        if (!alone && i + 1 < d->n_stimuli && !group_order(d, all[i].stimulus, all[i + 1].stimulus)) continue;
        if (!add_group(t, stimuli, n, a, e)) return false;
        n = 0;
    }
    t->sessions = ARENA_TAKE(a, int, session < 0 ? 1 : d->factors[session].n_levels + 1);
    for (int l = session < 0 ? -1 : 0; l < (session < 0 ? 0 : d->factors[session].n_levels); l++) {
        bool counts = false;
        for (int i = 0; i < t->n; i++)
            counts = counts || (t->all[i].session == l && !t->all[i].training);
        if (counts) t->sessions[t->n_sessions++] = l;
    }
    return all_check(t, e);
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

struct drawn {
    struct trial trial;
    uint64_t block, rank;
};

static int by_rank(const void *pa, const void *pb)
{
    const struct drawn *a = pa, *b = pb;
    if (a->trial.training != b->trial.training) return b->trial.training - a->trial.training;
    if (a->block != b->block) return a->block < b->block ? -1 : 1;
    if (a->rank != b->rank) return a->rank < b->rank ? -1 : 1;
    return a->trial.id - b->trial.id;
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
    int session = t->sessions[session_at(t->n_sessions, participant - 1, sitting - 1)];
    struct drawn *all = ARENA_TAKE(a, struct drawn, t->n + w->training + 1);
    struct trial *list = ARENA_TAKE(a, struct trial, t->n + w->training + 1);
    *n = 0;
    for (int i = 0; i < t->n; i++) {
        const struct trial *x = &t->all[i];
        if (x->session >= 0 && x->session != session) continue;
        const char *name = name_of(t, x, 0);
        for (int k = 1; k < x->n; k++)
            name = arena_format(a, "%s %s", name, name_of(t, x, k));
        struct drawn *to = &all[(*n)++];
        *to = (struct drawn){.trial = *x, .rank = draw(&from, "trial", name, a)};
        if (x->block >= 0 && !x->training)
            to->block = draw(&from, "block", t->design->factors[w->block].levels[x->block].label, a);
        sounds_draw(t, &to->trial, name, &from, a);
    }
    qsort(all, (size_t)*n, sizeof *all, by_rank);
    int fixed = 0, first = 0;
    while (first < *n && all[first].trial.training)
        first++;
    /* Drawn for training: the last ones of as many equal stretches, of all blocks so. */
    for (int m = *n - first; fixed < w->training && fixed < m; fixed++) {
        int of = w->training < m ? w->training : m;
        list[first + fixed] = all[first + (int)((long)(fixed + 1) * m / of) - 1].trial;
        list[first + fixed].training = true;
    }
    for (int i = 0; i < *n; i++)
        list[i < first ? i : i + fixed] = all[i].trial;
    *n += fixed;
    return list;
}
