/* See finish.h. */
#include "batch/finish.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "batch/folder.h"
#include "batch/level.h"
#include "batch/merge_lock.h"
#include "batch/pool.h"
#include "batch/shard.h"
#include "batch/sums.h"
#include "batch/unheard.h"

struct levelled {                /* what became of a stimulus that gets its gain, until it is taken */
    struct journal_ref record;
    bool done, again;            /* again: it was rendered once more for it */
    struct err *e;               /* by malloc; NULL: none */
};

struct work {
    struct finish *finish;
    struct levelled *now;        /* [n] */
    struct err stop;
};

/* ------------------------------------------------------------------ levels */

static bool whole(const struct finish *f)
{
    for (int i = 0; i < f->kit->set->n; i++)
        if (!f->results.of[i].record.size)
            return false;
    return true;
}

static bool has_level(const struct finish *f, int i, const struct record *r)
{
    return f->kit->set->rows[i].recording || (r->job && r->full_scale == f->full_scale);
}

struct relevel {                 /* of one stimulus */
    const struct finish *finish;
    int i;
    const char *key;             /* of what the set's gain was found with */
    struct levelled *to;
    struct arena *arena;
};

/* Renders the raw sound again: another gain was given to it, and it is gone. It must be what the gain was found with. */
static bool again(const struct relevel *l, const struct record **raw, struct err *e)
{
    struct job_kit k = *l->finish->kit;
    struct job_result result;
    k.again = true;
    if (!k.design)
        return err_set(e, ERR_INPUT, "it has the level that an earlier merge gave it, and for another one its raw sound is needed, which a merge cannot render: run its shard again with the same command, then merge");
    if (!job_do(&k, l->i, l->arena, &result, e))
        return false;
    l->to->again |= !result.kept;
    if (strcmp(result.record->key, l->key) != 0)
        return err_set(e, ERR_INPUT, "what it is made of has changed since its level was measured: run the same command again");
    *raw = result.record;
    return true;
}

enum { TRIES = 6 };

/* Another batch in the same folder takes raw sounds away when it has given them their gain, and once more when it has finished. */
static bool level_raw(const struct relevel *l, const struct record *raw, struct err *e)
{
    const struct finish *f = l->finish;
    for (int tries = 0; tries < TRIES; tries++) {
        *e = (struct err){0};
        if (tries || !raw)
            if (!again(l, &raw, e))
                return false;
        if (level_apply(f->kit, raw, f->full_scale, l->arena, &l->to->record, e))
            return true;
        if (e->kind != ERR_INPUT)
            return false;
    }
    return false;
}

/* Its raw sound, if an earlier run left it and it is still there: another state of the design may have put its own in its place. */
static const struct record *left_raw(const struct finish *f, const struct record *r, struct arena *a)
{
    struct journal_ref ref;
    const struct record *raw = journal_find(f->kit->journal, r->key, true, a, &ref);
    return raw && raw->place && r->place && !strcmp(raw->place, r->place) && job_is_there(f->kit->folder, raw, a) ? raw : NULL;
}

static bool level_one(const struct finish *f, int i, struct levelled *to, struct arena *a, struct err *e)
{
    to->record = f->results.of[i].record;
    const struct record *r = journal_read(f->kit->journal, to->record, a, e);
    if (!r)
        return false;
    if (has_level(f, i, r))
        return true;
    return level_raw(&(struct relevel){f, i, r->key, to, a}, r->job ? left_raw(f, r, a) : r, e);
}

static bool stops(const struct err *e)
{
    return e->kind == ERR_CREATE || e->kind == ERR_IO || e->kind == ERR_INTERRUPTED || e->kind == ERR_MEMORY;
}

static bool job(void *context, int i)
{
    struct work *w = context;
    struct levelled *l = &w->now[i];
    struct err e = {0};
    struct arena *a = arena_open();
    bool ok = interrupt_seen() ? err_set(&e, ERR_INTERRUPTED, "interrupted; run the same command again, and it goes on from here")
                               : level_one(w->finish, i, l, a, &e);
    arena_close(a);
    l->done = true;
    if (!ok)
        *(l->e = memory_take(sizeof e)) = e;
    return ok || !stops(&e);
}

static void took(void *context, int i)
{
    struct work *w = context;
    struct levelled *l = &w->now[i];
    struct outcome *o = &w->finish->results.of[i];
    w->finish->anew = w->finish->anew || l->again;
    o->kept = o->kept && !l->again && !l->e;
    if (!l->e) {
        w->finish->anew = w->finish->anew || l->record.at != o->record.at;
        o->record = l->record;
        o->waits = false;
    } else {
        o->kind = l->e->kind;
        o->text = folder_seen(w->finish->kit->folder, l->e->text, w->finish->arena);
        if (stops(l->e))
            err_set(&w->stop, l->e->kind, "%s", l->e->text);
        o->raw = o->waits ? o->record : (struct journal_ref){0};
        o->refused = o->waits || w->finish->kit->design ? (struct journal_ref){0} : o->record;
        o->record = (struct journal_ref){0};
    }
    free(l->e);
    *l = (struct levelled){0};
}

static bool look_at(struct finish *f, int i, struct level_greatest *g, struct err *e)
{
    struct arena *a = arena_open();
    const struct record *r = journal_read(f->kit->journal, f->results.of[i].record, a, e);
    if (r)
        level_look(g, r);
    arena_close(a);
    return r != NULL;
}

static bool lay_level(struct finish *f, struct err *e)
{
    const struct set *s = f->kit->set;
    struct level_greatest g = level_start();
    for (int i = 0; i < s->n; i++)
        if (!s->rows[i].recording && !look_at(f, i, &g, e))
            return false;
    if (!level_find(s, &g, &f->full_scale, e))
        return false;
    struct work w = {f, ARENA_TAKE(f->arena, struct levelled, s->n), {0}};
    pool_run(&(struct pool_work){.n = s->n, .threads = f->threads, .context = &w, .job = job, .took = took});
    for (int i = 0; i < s->n; i++)
        if (w.now[i].done)
            took(&w, i);
    return !w.stop.kind || err_set(e, w.stop.kind, "%s", w.stop.text);
}

/* ------------------------------------------------------------------ tables */

static bool write_tables(struct finish *f, struct err *e)
{
    const struct set *s = f->kit->set;
    const char *folder = f->kit->folder, *timings = arena_format(f->arena, "%s/timings.csv", folder);
    struct stat status;
    if (!manifest_write(folder, &f->results, &(struct shard){1, 1}, NULL, e) || !manifest_describe(folder, s, e) || !sums_write(folder, &f->results, e))
        return false;
    return (!f->anew && stat(timings, &status) == 0) || sums_timings(folder, &f->results, e);
}

static bool settle(struct finish *f, bool complete, struct err *e)
{
    const struct set *s = f->kit->set;
    if (!leftover_find(&(struct leftover_ask){f->kit->folder, &f->results, f->inputs, f->prune}, f->arena, &f->left, e))
        return false;
    int n = s->n + f->left.n;
    struct journal_ref *records = ARENA_TAKE(f->arena, struct journal_ref, n);
    const char **names = ARENA_TAKE(f->arena, const char *, s->n);
    for (int i = 0; i < f->left.n; i++) /* before the set's: the later a record stands, the newer it is */
        records[i] = f->left.refs[i];
    for (int i = 0; i < s->n; i++) {
        const struct outcome *o = &f->results.of[i];
        records[f->left.n + i] = o->record.size ? o->record : o->raw;
        names[i] = s->rows[i].name;
    }
    if (!journal_settle(f->kit->journal, records, n, e))
        return false;
    f->alone = folder_is_mine(f->entered);
    if (f->alone) {
        if (f->kit->design) { /* what a merge has merged it takes away itself, if nothing failed */
            shard_sweep(f->kit->folder);
            merge_lock_sweep(f->kit->folder, f->arena);
        }
        folder_sweep(f->kit->folder, names, s->n, complete);
    }
    return true;
}

bool finish_level(struct finish *f, struct err *e)
{
    bool waits = set_waits(f->kit->set);
    f->full_scale = waits ? NAN : f->kit->set->level.full_scale;
    return !waits || !whole(f) || lay_level(f, e);
}

bool finish_tables(struct finish *f, struct err *e)
{
    f->unheard = "";
    return write_tables(f, e) && unheard_find(&f->results, f->arena, &f->unheard, e) && settle(f, !set_waits(f->kit->set) || whole(f), e);
}
