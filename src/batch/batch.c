/* See batch.h. The design is read and planned; the folder is entered; each stimulus is made that is not there; the gain
   of the set is found and laid; stale files are looked for; tables are written from the records. A failure of one
   stimulus is its own, but for those that all others would have too: a disk that is full, a folder that cannot be
   written. */
#include "batch/batch.h"

#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "batch/pool.h"
#include "num/fft.h"
#include "num/resample.h"

struct slot { /* what a job came to, until it is taken */
    struct stimulus is;
    bool done;
    char *key;     /* by malloc, of what failed; NULL: not known */
    struct err *e; /* by malloc; NULL: none */
};

struct batch {
    const struct batch_ask *ask;
    struct batch_report *report;
    struct arena *arena;
    struct stimulus_set k;
    struct stimulus *is; /* [n] key: of what has no right record */
    bool (*act)(const struct batch *b, int i, struct arena *a, struct stimulus *s, struct err *e); /* what jobs do */
    struct slot *slots;                                                                            /* [n_now] */
    int *now, n_now; /* the stimuli that jobs are about */
    struct pool_progress progress;
    struct err stop;
    const char *changed; /* an input, while stimuli were made of it; NULL: none */
};

/* ------------------------------------------------------------------ jobs */

static bool stops(enum err_kind kind)
{
    return kind == ERR_CREATE || kind == ERR_IO || kind == ERR_INTERRUPTED || kind == ERR_MEMORY;
}

static bool look(const struct batch *b, int i, struct arena *a, struct stimulus *s, struct err *e)
{
    return stimulus_look(&b->k, i, a, s, e);
}

static bool make(const struct batch *b, int i, struct arena *a, struct stimulus *s, struct err *e)
{
    enum stimulus_how how = b->ask->no_render ? STIMULUS_NEVER : b->ask->force ? STIMULUS_ANEW : STIMULUS_IF_NEEDED;
    return stimulus_make(&b->k, i, how, a, s, e) &&
           (s->state == STIMULUS_THERE ||
            err_set(e, ERR_INPUT,
                    "it is not there as it should be (%s): run its shard, or the same command without --no-render",
                    stimulus_states[s->state]));
}

static bool level(const struct batch *b, int i, struct arena *a, struct stimulus *s, struct err *e)
{
    return stimulus_level(&b->k, i, b->report->full_scale, !b->ask->no_render, a, s, e);
}

static bool job(void *context, int at)
{
    struct batch *b = context;
    struct slot *s = &b->slots[at];
    struct err e = {0};
    struct arena *a = arena_open();
    bool ok = interrupt_seen() ? err_set(&e, ERR_INTERRUPTED, "interrupted") : b->act(b, b->now[at], a, &s->is, &e);
    s->done = true;
    if (!ok) {
        *(s->e = memory_take(sizeof e)) = e;
        s->key = s->is.key ? memcpy(memory_take(HASH_TEXT), s->is.key, HASH_TEXT) : NULL;
    }
    s->is.key = NULL; /* it goes with the arena */
    arena_close(a);
    return ok || !stops(e.kind);
}

static void took(void *context, int at)
{
    struct batch *b = context;
    struct slot *s = &b->slots[at];
    int i = b->now[at];
    struct tables_row *o = &b->report->rows[i];
    double cost = b->report->set.cost[i];
    bool made = s->is.made && !s->e;
    if (s->e && stops(s->e->kind))
        err_set(&b->stop, s->e->kind, "%s", s->e->text);
    else if (s->e) {
        o->there = false;
        o->kind = s->e->kind;
        o->text = folder_seen(b->ask->folder, s->e->text, b->arena);
        b->is[i].key = s->key ? arena_text(b->arena, s->key) : "";
    } else {
        o->there = s->is.state == STIMULUS_THERE;
        o->made = o->made || made;
        o->wall += s->is.wall, o->cpu += s->is.cpu;
        b->is[i] = s->is;
        if (b->report->states) b->report->states[i] = s->is.state;
    }
    free(s->e);
    free(s->key);
    *s = (struct slot){0};
    pool_progress_step(&b->progress, b->report->design.stimuli[i].name, made ? cost : 0, made ? 0 : cost,
                       made ? b->report->set.lengths[i] : 0);
}

/* Results behind the first that was not done are there all the same, and have their records. */
static void run_jobs(struct batch *b)
{
    pool_run(&(struct pool_work){.n = b->n_now, .threads = b->ask->threads, .context = b, .job = job, .took = took});
    for (int at = 0; at < b->n_now; at++)
        if (b->slots[at].done) took(b, at);
    pool_progress_clear(&b->progress);
}

static bool make_all(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    double cost = 0;
    int done = 0;
    b->act = make;
    for (int at = 0; at < b->n_now; at++)
        cost += r->set.cost[b->now[at]];
    pool_progress_begin(&b->progress, b->n_now, cost, b->ask->quiet);
    run_jobs(b);
    for (int at = 0; at < b->n_now; at++)
        done += r->rows[b->now[at]].there;
    if (b->stop.kind == ERR_INTERRUPTED)
        return err_set(e, ERR_INTERRUPTED,
                       "interrupted after %d of %d stimuli; run the same command again, and it goes on from here", done,
                       b->n_now);
    return !b->stop.kind || err_set(e, b->stop.kind,
                                    "%s; stopped after %d of %d stimuli; once that is mended, run the same command "
                                    "again, and it goes on from here",
                                    b->stop.text, done, b->n_now);
}

/* ------------------------------------------------------------------ the gain of the set */

static bool are_all_there(const struct batch *b)
{
    bool all = true;
    for (int i = 0; i < b->report->set.n; i++)
        all = all && b->report->rows[i].there;
    return all;
}

static bool find_gain(const struct batch *b, double *full_scale, struct err *e)
{
    struct set_loudest l = set_loudest();
    for (int i = 0; i < b->report->set.n; i++)
        set_loudest_add(&l, &b->is[i].measured);
    return set_gain(&b->report->set, &l, full_scale, e);
}

static bool needs_gain(const struct batch *b, int i, double full_scale)
{
    return !b->report->design.stimuli[i].recording && (b->is[i].waits || b->is[i].full_scale != full_scale);
}

static bool level_all(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    r->full_scale = set_waits(&r->set) ? NAN : r->set.level.full_scale;
    if (!set_waits(&r->set) || !are_all_there(b) ||
        file_cache_changed(b->k.file_cache, b->arena)) /* of two states no gain is found */
        return true;
    if (!find_gain(b, &r->full_scale, e)) return false;
    b->n_now = 0;
    for (int i = 0; i < r->set.n; i++)
        if (needs_gain(b, i, r->full_scale)) b->now[b->n_now++] = i;
    b->act = level;
    pool_progress_begin(&b->progress, b->n_now, 0, true);
    run_jobs(b);
    return !b->stop.kind ||
           err_set(e, b->stop.kind, "%s; run the same command again, and it goes on from here", b->stop.text);
}

/* ------------------------------------------------------------------ only looking */

/* What of the set is there, and why the rest would be made. A gain is known when all are. */
static bool look_at_folder(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    struct err silent = {0};
    double full_scale = NAN;
    r->states = ARENA_TAKE(b->arena, enum stimulus_state, r->set.n);
    b->k.read_only = true;
    b->n_now = 0;
    for (int i = 0; i < r->set.n; i++)
        b->now[b->n_now++] = i;
    b->act = look;
    pool_progress_begin(&b->progress, b->n_now, 0, true);
    run_jobs(b);
    if (b->stop.kind) return err_set(e, b->stop.kind, "%s", b->stop.text);
    int shards = b->ask->missing, *to = ARENA_TAKE(b->arena, int, r->set.n);
    bool *lacks = ARENA_TAKE(b->arena, bool, shards + 1);
    if (shards) {
        set_deal(&r->set, shards, to);
        r->missing = "";
    }
    for (int i = 0; i < r->set.n; i++)
        lacks[to[i]] = lacks[to[i]] || !r->rows[i].there;
    for (int k = 1; k <= shards; k++)
        if (lacks[k]) r->missing = arena_format(b->arena, "%s%s%d", r->missing, *r->missing ? "," : "", k);
    bool gain = set_waits(&r->set) && are_all_there(b) && find_gain(b, &full_scale, &silent);
    for (int i = 0; i < r->set.n; i++)
        if (r->states[i] == STIMULUS_THERE && set_waits(&r->set) &&
            (b->is[i].waits || (gain && needs_gain(b, i, full_scale))))
            r->states[i] = STIMULUS_GAIN;
    for (int i = 0; i < r->set.n; i++)
        r->rows[i] = (struct tables_row){0};
    return true;
}

/* ------------------------------------------------------------------ the end */

static bool judge(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    enum err_kind worst = ERR_NONE;
    for (int i = 0; i < r->set.n; i++) {
        const struct tables_row *o = &r->rows[i];
        r->rendered += o->there && o->made;
        r->reused += o->there && !o->made;
        r->failed += o->kind != ERR_NONE;
        r->waiting += o->there && b->is[i].waits;
        worst = o->kind > worst ? o->kind : worst;
    }
    if (b->changed)
        return err_set(e, ERR_INPUT,
                       "%s has changed while stimuli were made of it: some may be of what it was before; run the same "
                       "command again, which renders those anew",
                       b->changed);
    if (worst && b->ask->no_render)
        return err_set(e, worst, "%d of %d stimuli are missing; no table was written", r->failed, r->n_mine);
    return !worst || err_set(e, worst, "%d of %d stimuli failed; the column error of the manifest says why%s",
                             r->failed, r->n_mine, r->waiting ? ", and the common level waits for them" : "");
}

struct wanted {
    const char *name, *key;
};

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct wanted *)a)->name, ((const struct wanted *)b)->name);
}

static void find_stale(struct batch *b)
{
    struct batch_report *r = b->report;
    int n = r->set.n;
    struct wanted *all = ARENA_TAKE(b->arena, struct wanted, n);
    struct folder_wanted w = {.folder = b->ask->folder,
                              .names = ARENA_TAKE(b->arena, const char *, n),
                              .keys = ARENA_TAKE(b->arena, const char *, n),
                              .n = n,
                              .inputs = r->plan.inputs,
                              .prune = b->ask->prune,
                              .all = are_all_there(b)};
    for (int i = 0; i < n; i++) {
        w.all = w.all && !b->is[i].waits;
        all[i] = (struct wanted){r->design.stimuli[i].name, r->rows[i].there ? NULL : b->is[i].key ? b->is[i].key : ""};
    }
    qsort(all, (size_t)n, sizeof *all, by_name);
    for (int i = 0; i < n; i++) {
        w.names[i] = all[i].name;
        w.keys[i] = all[i].key;
    }
    folder_stale(&w, b->arena, &r->stale);
}

/* Inputs may be seen from folders that the end removes: they are looked at before. */
static bool end(struct batch *b, struct err *e)
{
    struct batch_report *r = b->report;
    b->changed = file_cache_changed(b->k.file_cache, b->arena);
    bool missing = false, made = false;
    for (int i = 0; i < r->set.n; i++) {
        missing = missing || (b->ask->no_render && r->rows[i].kind);
        made = made || r->rows[i].made;
    }
    if (missing) return true;
    find_stale(b);
    int fd = made ? open(b->ask->folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (fd >= 0) { /* the tables speak of what is on the disk */
        syncfs(fd);
        close(fd);
    }
    return tables_write(&(struct tables){&r->set, b->ask->folder, r->rows, b->arena}, &r->no_effect, e);
}

static bool run_in_folder(struct batch *b, struct err *e)
{
    const char *folder = b->ask->folder;
    double share = (double)b->report->n_mine / b->report->set.n, free = folder_free(folder),
           raw = share * b->report->plan.raw_bytes;
    if (!(raw < free) && access(arena_format(b->arena, "%s/.rasp/raw", folder), F_OK) != 0)
        return err_set(e, ERR_CREATE,
                       "%s: %.3g GB are free, and the sounds take %.3g GB until the common level is known: give the "
                       "level as full_scale, or make room",
                       folder, free / 1e9, raw / 1e9);
    b->report->rendering = true;
    b->k.unfinished = !tables_are_there(b->ask->folder, b->arena);
    tables_remove(b->ask->folder, b->arena);
    resample_prepare();
    if (!make_all(b, e)) return false;
    if (b->ask->shard.n > 1)
        b->changed = file_cache_changed(b->k.file_cache, b->arena);
    else if (!level_all(b, e) || !end(b, e))
        return false;
    return judge(b, e);
}

static bool run(const struct batch_ask *ask, struct file_cache *file_cache, struct arena *a, struct batch_report *r,
                struct err *e)
{
    int lock;
    *r = (struct batch_report){.messages = "", .no_effect = "", .full_scale = NAN};
    if (!design_read(ask->design, a, &r->design, &r->messages, e)) return false;
    r->set = set_make(&r->design, ask->program);
    if (!set_plan(
            &r->set,
            &(struct set_plan_ask){ask->threads, file_cache, ask->folder, ask->replace, ask->force || ask->replace}, a,
            &r->plan, e))
        return false;
    struct batch b = {.ask = ask,
                      .report = r,
                      .arena = a,
                      .is = ARENA_TAKE(a, struct stimulus, r->set.n),
                      .k = {.set = &r->set, .folder = ask->folder, .file_cache = file_cache, .inputs = r->plan.inputs}};
    r->rows = ARENA_TAKE(a, struct tables_row, r->set.n);
    int *to = ARENA_TAKE(a, int, r->set.n);
    r->mine = ARENA_TAKE(a, bool, r->set.n);
    b.now = ARENA_TAKE(a, int, r->set.n);
    b.slots = ARENA_TAKE(a, struct slot, r->set.n);
    set_deal(&r->set, ask->shard.n, to);
    for (int i = 0; i < r->set.n; i++)
        if ((r->mine[i] = to[i] == ask->shard.i)) b.now[b.n_now++] = i;
    r->n_mine = b.n_now;
    if (!ask->folder) return true;
    const struct folder_owner owner = {ask->folder,  ask->design,  r->set.sha256,
                                       ask->program, ask->replace, ask->shard.n > 1};
    if (!folder_look(&owner, a, e)) /* before anything is written */
        return false;
    b.k.unfinished = !tables_are_there(ask->folder, a);
    if (ask->dry || ask->missing) {
        b.k.seen_from = folder_place(ask->design, ask->folder, a);
        return look_at_folder(&b, e);
    }
    if (!folder_enter(&owner, a, &lock, e)) return false;
    b.k.seen_from = folder_place(ask->design, ask->folder, a);
    bool ok = run_in_folder(&b, e);
    folder_leave(lock);
    return ok;
}

void batch_close(struct batch_report *r) { set_plan_close(&r->plan); }

bool batch_run(const struct batch_ask *ask, struct arena *a, struct batch_report *r, struct err *e)
{
    double start = stopwatch_wall();
    struct file_cache *file_cache = file_cache_open(FILE_CACHE_MOST);
    bool ok = run(ask, file_cache, a, r, e);
    file_cache_close(file_cache);
    r->seconds = stopwatch_wall() - start;
    return ok;
}
