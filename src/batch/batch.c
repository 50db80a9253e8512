/* See batch.h. A failure of one stimulus is its own, but for those that all others would have too: a disk that is full, a folder that cannot be written. */
#include "batch/batch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/shelf.h"
#include "base/stopwatch.h"
#include "batch/claim.h"
#include "batch/finish.h"
#include "batch/folder.h"
#include "batch/pool.h"
#include "batch/progress.h"
#include "batch/set_file.h"
#include "num/fft.h"
#include "num/resample.h"

enum { SHELF_MOST = 256 << 20 /* bytes of inputs that stay in memory; what is beyond is read again for every stimulus */ };

struct batch {
    const struct batch_ask *ask;
    struct batch_report *report;
    struct arena *arena;
    struct job_kit kit;
    struct slot {                /* what a job came to, until it is taken */
        struct journal_ref ref;
        bool done, kept, waits;
        struct err *e;           /* by malloc; NULL: none */
    } *slots;                    /* [n_mine] */
    int *rows;                   /* [n_mine] which stimuli */
    struct progress progress;
    struct err stop;
    struct claim claim;
    int entered;                 /* claim_enter's */
    const char *changed;         /* an input, while stimuli were made of it; NULL: none */
};

/* ------------------------------------------------------------------ jobs */

static bool stops(enum err_kind kind)
{
    return kind == ERR_CREATE || kind == ERR_IO || kind == ERR_INTERRUPTED || kind == ERR_MEMORY;
}

static bool job(void *context, int at)
{
    struct batch *b = context;
    struct slot *s = &b->slots[at];
    struct job_result result = {0};
    struct err e = {0};
    struct arena *a = arena_open();
    bool ok = interrupt_seen() ? err_set(&e, ERR_INTERRUPTED, "interrupted") : job_do(&b->kit, b->rows[at], a, &result, &e);
    *s = (struct slot){result.ref, true, result.kept, ok && !result.record->job, NULL};
    arena_close(a);
    if (!ok)
        *(s->e = memory_take(sizeof e)) = e;
    return ok || !stops(e.kind);
}

static void took_failure(struct batch *b, struct outcome *o, const struct err *e)
{
    if (stops(e->kind)) {
        err_set(&b->stop, e->kind, "%s", e->text);
        return;
    }
    o->kind = e->kind;
    o->text = folder_seen(b->ask->folder, e->text, b->arena);
    b->report->failed++;
}

static void took(void *context, int at)
{
    struct batch *b = context;
    struct slot *s = &b->slots[at];
    int i = b->rows[at];
    struct outcome *o = &b->report->outcomes[i];
    double cost = b->report->set.rows[i].cost, length = b->report->prepare.lengths[i];
    if (s->e)
        took_failure(b, o, s->e);
    else {
        o->kept = s->kept;
        o->record = s->ref;
        o->waits = s->waits;
        b->report->kept += o->kept;
        b->report->rendered += !o->kept;
    }
    free(s->e);
    *s = (struct slot){0};
    progress_step(&b->progress, b->report->set.rows[i].name, o->kept ? 0 : cost, o->kept ? cost : 0, o->kept ? 0 : length);
}

/* Results behind the first that was not done are there all the same, and are in the journal. */
static bool run_jobs(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    double cost = 0;
    b->slots = ARENA_TAKE(b->arena, struct slot, r->n_mine);
    for (int at = 0; at < r->n_mine; at++)
        cost += r->set.rows[b->rows[at]].cost;
    progress_begin(&b->progress, r->n_mine, cost, b->ask->quiet);
    pool_run(&(struct pool_work){.n = r->n_mine, .threads = b->ask->threads, .context = b, .job = job, .took = took});
    for (int at = 0; at < r->n_mine; at++)
        if (b->slots[at].done)
            took(b, at);
    progress_clear(&b->progress);
    if (b->stop.kind == ERR_INTERRUPTED)
        return err_set(e, ERR_INTERRUPTED, "interrupted after %d of %d stimuli; run the same command again, and it goes on from here", r->rendered + r->kept, r->n_mine);
    return !b->stop.kind || err_set(e, b->stop.kind, "%s; stopped after %d of %d stimuli; once that is mended, run the same command again, and it goes on from here", b->stop.text,
                                    r->rendered + r->kept, r->n_mine);
}

/* ------------------------------------------------------------------ before */

static void divide(struct batch *b)
{
    struct batch_report *r = b->report;
    int *to = ARENA_TAKE(b->arena, int, r->set.n);
    double *cost = ARENA_TAKE(b->arena, double, r->set.n);
    r->mine = ARENA_TAKE(b->arena, bool, r->set.n);
    b->rows = ARENA_TAKE(b->arena, int, r->set.n);
    for (int i = 0; i < r->set.n; i++)
        cost[i] = r->set.rows[i].cost;
    shard_assign(cost, r->set.n, b->ask->shard.n, to, b->arena);
    for (int i = 0; i < r->set.n; i++)
        if ((r->mine[i] = to[i] == b->ask->shard.i))
            b->rows[r->n_mine++] = i;
}

static bool has_room(const struct batch *b, struct err *e)
{
    const struct prepare *p = &b->report->prepare;
    double share = (double)b->report->n_mine / b->report->set.n, free = folder_free(b->ask->folder), raw = share * p->raw_bytes;
    if (raw < free || access(arena_format(b->arena, "%s/.rasp/raw", b->ask->folder), F_OK) == 0)
        return true;
    return err_set(e, ERR_CREATE, "%s: %.3g GB are free, and the sounds take %.3g GB until the common level is known: give the level as full_scale, or make room", b->ask->folder,
                   free / 1e9, raw / 1e9);
}

static bool open_folder(struct batch *b, struct err *e)
{
    const struct batch_ask *ask = b->ask;
    bool part = ask->shard.n > 1;
    const char *name = part ? arena_format(b->arena, "%s/.rasp/journal.%d-of-%d", ask->folder, ask->shard.i, ask->shard.n)
                            : arena_format(b->arena, "%s/.rasp/journal", ask->folder);
    if (!folder_make(ask->folder, e))
        return false;
    if (!claim_enter(&b->claim, b->arena, &b->entered, e))
        return false;
    if (!(b->kit.journal = b->report->journal = journal_open(ask->folder, name, b->arena, e)) || !has_room(b, e))
        return false;
    return !part || set_file_save(&b->report->set, arena_format(b->arena, "%s/.rasp/set.json", ask->folder), e);
}

/* Tables of an earlier run would speak of files that may be replaced now. */
static void forget_tables(const struct batch *b)
{
    static const char *const tables[] = {"manifest.csv", "manifest.json", "SHA256SUMS"};
    for (int i = 0; i < 3; i++)
        unlink(arena_format(b->arena, "%s/%s", b->ask->folder, tables[i]));
    unlink(manifest_path(b->ask->folder, &b->ask->shard, b->arena));
}

/* ------------------------------------------------------------------ the whole */

static bool judge(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    enum err_kind worst = ERR_NONE;
    r->failed = r->waiting = r->rendered = r->kept = 0; /* the level may have changed what became of some */
    for (int i = 0; i < r->set.n; i++) {
        const struct outcome *o = &r->outcomes[i];
        r->rendered += o->record.size && !o->kept;
        r->kept += o->record.size && o->kept;
        r->failed += o->kind != ERR_NONE;
        r->waiting += o->record.size && o->waits;
        worst = o->kind > worst ? o->kind : worst;
    }
    if (b->changed)
        return err_set(e, ERR_INPUT, "%s has changed while stimuli were made of it: some may be of what it was before; run the same command again, which renders those anew", b->changed);
    return !worst || err_set(e, worst, "%d of %d stimuli failed; the column error of the manifest says why%s", r->failed, r->n_mine,
                             r->waiting ? ", and the common level waits for them" : "");
}

/* Inputs may be seen from folders that the end removes: it is looked before. anew: something was made of them. */
static void look_for_changes(struct batch *b, bool anew)
{
    b->changed = anew ? shelf_changed(b->kit.shelf, b->arena) : NULL;
}

/* A shard of two states is not one that can be merged: it has no manifest. */
static bool end_shard(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    look_for_changes(b, r->rendered > 0);
    return b->changed || manifest_write(b->ask->folder, &(struct results){&r->set, r->outcomes, r->journal}, &b->ask->shard, r->mine, e);
}

static bool end(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    struct results results = {&r->set, r->outcomes, r->journal};
    struct finish f = {.kit = &b->kit, .results = results, .threads = b->ask->threads, .entered = b->entered, .arena = b->arena, .anew = r->rendered > 0,
                       .inputs = r->prepare.inputs, .prune = b->ask->prune};
    if (b->ask->shard.n > 1)
        return end_shard(b, e);
    bool ok = finish_level(&f, e);
    look_for_changes(b, f.anew);
    ok = ok && finish_tables(&f, e);
    r->full_scale = f.full_scale;
    r->left = f.left;
    r->unheard = f.unheard ? f.unheard : "";
    return ok;
}

static bool render_in_folder(struct batch *b, struct err *e)
{
    if (!open_folder(b, e))
        return false;
    forget_tables(b);
    resample_prepare();
    return run_jobs(b, e) && end(b, e) && judge(b, e);
}

static bool render(struct batch *b, struct err *e)
{
    b->entered = -1;
    bool ok = render_in_folder(b, e);
    folder_leave(b->entered);
    return ok;
}

void batch_close(struct batch_report *r)
{
    prepare_close(&r->prepare);
    journal_close(r->journal);
    r->journal = NULL;
}

static bool run(const struct batch_ask *ask, struct shelf *shelf, struct arena *a, struct batch_report *r, struct err *e)
{
    *r = (struct batch_report){.messages = "", .unheard = "", .full_scale = NAN};
    if (!design_read(ask->design, a, &r->design, &r->messages, e))
        return false;
    set_make(&r->design, ask->build, a, &r->set);
    if (!prepare_set(&(struct prepare_ask){&r->design, ask->threads, shelf, ask->folder, &ask->shard, ask->replace, ask->force || ask->replace}, a, &r->set, &r->prepare, e))
        return false;
    struct batch b = {.ask = ask, .report = r, .arena = a, .kit = {.design = &r->design, .set = &r->set, .folder = ask->folder, .shelf = shelf, .force = ask->force},
                      .claim = {ask->folder, ask->design, r->set.sha256, ask->build, ask->replace}};
    r->outcomes = ARENA_TAKE(a, struct outcome, r->set.n);
    divide(&b);
    if (ask->folder && !claim_look(&b.claim, a, e)) /* before anything is written */
        return false;
    return ask->dry || render(&b, e);
}

bool batch_run(const struct batch_ask *ask, struct arena *a, struct batch_report *r, struct err *e)
{
    double start = stopwatch_wall();
    struct shelf *shelf = shelf_open(SHELF_MOST);
    fft_keep(true);
    bool ok = run(ask, shelf, a, r, e);
    fft_keep(false);
    shelf_close(shelf);
    r->seconds = stopwatch_wall() - start;
    return ok;
}
