/* See merge.h. Which record of the journals counts is said by the shards' manifests, by its job hash: the journals may hold more, of earlier designs. */
#include "batch/merge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "batch/claim.h"
#include "batch/finish.h"
#include "batch/folder.h"
#include "batch/merge_lock.h"
#include "batch/merge_shards.h"
#include "batch/merged.h"
#include "batch/pool.h"
#include "batch/set_file.h"
#include "file/csv.h"

struct merge {
    const char *folder;
    struct arena *arena;
    struct merge_report *report;
    struct job_kit kit;
    int entered;             /* claim_join's */
    struct merge_shards shards;
    bool *there;             /* [set.n] */
};

/* ------------------------------------------------------------------ what they say */

static int by_name(const void *a, const void *b)
{
    return strcmp((*(const struct set_row *const *)a)->name, (*(const struct set_row *const *)b)->name);
}

static bool same_set(const struct merge *m, const struct csv *t, const char *file, struct err *e)
{
    const char *design = csv_comment(t, "design"), *build = csv_comment(t, "build");
    if (!design || strcmp(design, m->report->set.sha256) != 0)
        return err_set(e, ERR_SCENE, "%s/%s is of another design than the rest, or of another state of its scenes or of the files that they read: run all shards again, or remove it", m->folder, file);
    if (!build || strcmp(build, m->report->set.build) != 0)
        return err_set(e, ERR_SCENE, "%s/%s was made by %s, the rest by %s: run its shard again with the same program", m->folder, file, build ? build : "an unknown program",
                       m->report->set.build);
    return true;
}

struct columns {
    int name, status, job, code, error;
};

static bool tells_enough(const void *context, const struct record *r, struct arena *a)
{
    const struct merge *m = context;
    (void)a;
    return job_tells_enough(&m->report->set, r);
}

/* What waited may have its level already, of a merge that was cut off. */
static void find_record(const struct merge *m, const char *hash, struct outcome *o)
{
    struct arena *a = arena_open();
    if (!journal_find_such(m->kit.journal, &(struct journal_wish){hash, o->waits, tells_enough, m}, a, &o->record) && o->waits)
        o->waits = !journal_find_such(m->kit.journal, &(struct journal_wish){hash, false, tells_enough, m}, a, &o->record);
    arena_close(a);
}

static struct outcome outcome_of(const struct merge *m, const struct csv *t, size_t row, const struct columns *c)
{
    const char *const *cell = t->cells + row * t->columns;
    const char *status = cell[c->status];
    struct outcome o = {.kept = true};
    int code = ERR_NUMBERS;
    if (!strcmp(status, "ok") || !strcmp(status, "waits")) {
        o.waits = !strcmp(status, "waits");
        find_record(m, cell[c->job], &o);
        return o;
    }
    if (!strcmp(status, "failed")) {
        text_int(cell[c->code], 1, 125, &code);
        o.kind = (enum err_kind)code;
        o.text = cell[c->error];
    }
    return o;
}

static bool read_part(struct merge *m, const char *file, struct set_row **sorted, struct err *e)
{
    struct csv t;
    if (!csv_read(arena_format(m->arena, "%s/%s", m->folder, file), m->arena, &t, e) || !same_set(m, &t, file, e))
        return false;
    struct columns c = {csv_column(&t, "stimulus_id"), csv_column(&t, "status"), csv_column(&t, "job_hash"), csv_column(&t, "error_code"), csv_column(&t, "error")};
    if (c.name < 0 || c.status < 0 || c.job < 0 || c.code < 0 || c.error < 0)
        return err_set(e, ERR_SCENE, "%s/%s is no manifest of a shard: run its shard again", m->folder, file);
    for (size_t i = 0; i < t.rows; i++) {
        struct set_row key = {.name = t.cells[i * t.columns + (size_t)c.name]}, *wanted = &key;
        struct set_row **found = bsearch(&wanted, sorted, (size_t)m->report->set.n, sizeof(struct set_row *), by_name);
        if (found)
            m->report->outcomes[*found - m->report->set.rows] = outcome_of(m, &t, i, &c);
    }
    return true;
}

static bool read_parts(struct merge *m, struct err *e)
{
    struct set *s = &m->report->set;
    struct set_row **sorted = ARENA_TAKE(m->arena, struct set_row *, s->n);
    for (int i = 0; i < s->n; i++)
        sorted[i] = &s->rows[i];
    qsort(sorted, (size_t)s->n, sizeof(struct set_row *), by_name);
    for (int i = 0; i < m->shards.n; i++)
        if (!read_part(m, m->shards.files[i], sorted, e))
            return false;
    return true;
}

/* ------------------------------------------------------------------ what is there */

static bool is_there(const void *context, const struct record *r, struct arena *a)
{
    const struct merge *m = context;
    return job_tells_enough(&m->report->set, r) && job_is_there(m->folder, r, a);
}

/* The latest record is not always the one whose files are there: journals of several divisions are read by their names, and of what waited a merge that was cut off may have made
   what has its level. */
static bool find_other(const struct merge *m, struct outcome *o, const struct record *r, struct arena *a)
{
    struct journal_ref other;
    const char *hash = r->job && !o->waits ? r->job : r->key;
    for (int waits = o->waits; waits >= 0; waits--)
        if (journal_find_such(m->kit.journal, &(struct journal_wish){hash, waits, is_there, m}, a, &other)) {
            o->record = other;
            o->waits = waits;
            return true;
        }
    return false;
}

static bool look(void *context, int i)
{
    struct merge *m = context;
    struct arena *a = arena_open();
    struct err unreadable = {0};
    struct outcome *o = &m->report->outcomes[i];
    const struct record *r = o->record.size ? journal_read(m->kit.journal, o->record, a, &unreadable) : NULL;
    m->there[i] = r && (job_is_there(m->folder, r, a) || find_other(m, o, r, a));
    arena_close(a);
    return true;
}

/* Their scenes name files as seen from the folder in which each was made. */
static bool seen_alike(const struct merge *m, struct err *e)
{
    const char *first = NULL;
    bool ok = true;
    for (int i = 0; ok && i < m->report->set.n; i++) {
        struct journal_ref ref = m->report->outcomes[i].record;
        struct arena *a = arena_open();
        const struct record *r = ref.size ? journal_read(m->kit.journal, ref, a, e) : NULL;
        if (r && r->place && first && strcmp(first, r->place) != 0)
            ok = err_set(e, ERR_INPUT, "%s: its shards were made in folders from which the design was seen as %s and as %s, and their scenes name files so: run those of one kind again here", m->folder,
                         first, r->place);
        else if (r && r->place && !first)
            first = arena_text(m->arena, r->place);
        arena_close(a);
    }
    return ok && !e->kind;
}

/* "low is missing", "low.wav was changed" */
static const char *why_not(const struct merge *m, int i)
{
    struct arena *a = arena_open();
    struct err unreadable = {0};
    struct journal_ref ref = m->report->outcomes[i].record;
    const struct record *r = ref.size ? journal_read(m->kit.journal, ref, a, &unreadable) : NULL;
    const char *file = NULL, *state = r ? job_differs(m->folder, r, a, &file) : "is not known here: .rasp is copied with the files of a shard, too; else run its shard again";
    const char *why = arena_format(m->arena, "%s %s", file ? file : m->report->set.rows[i].name, state ? state : "has come back");
    arena_close(a);
    return why;
}

static bool all_there(struct merge *m, int threads, struct err *e)
{
    struct merge_report *r = m->report;
    int missing = 0;
    r->names = ARENA_TAKE(m->arena, const char *, r->set.n + 1);
    r->whys = ARENA_TAKE(m->arena, const char *, r->set.n + 1);
    m->there = ARENA_TAKE(m->arena, bool, r->set.n);
    pool_run(&(struct pool_work){.n = r->set.n, .threads = threads, .context = m, .job = look});
    for (int i = 0; i < r->set.n; i++)
        if (!m->there[i] && !r->outcomes[i].kind) {
            r->whys[missing] = why_not(m, i);
            r->names[missing++] = r->set.rows[i].name;
        }
    return !missing || err_set(e, ERR_INPUT, "%s: %d of %d stimuli are not there as their shards left them: run the shards again", m->folder, missing, r->set.n);
}

/* ------------------------------------------------------------------ the whole */

static bool judge(struct merge *m, struct err *e)
{
    struct merge_report *r = m->report;
    enum err_kind worst = ERR_NONE;
    for (int i = 0; i < r->set.n; i++) {
        r->failed += r->outcomes[i].kind != ERR_NONE;
        r->waiting += r->outcomes[i].record.size && r->outcomes[i].waits;
        worst = r->outcomes[i].kind > worst ? r->outcomes[i].kind : worst;
    }
    return !worst || err_set(e, worst, "%d of %d stimuli failed; the column error of the manifest says why%s", r->failed, r->set.n,
                             r->waiting ? ", and the common level waits for them" : "");
}

static bool join(struct merge *m, int threads, struct err *e)
{
    struct finish f = {.kit = &m->kit, .results = {&m->report->set, m->report->outcomes, m->kit.journal}, .threads = threads, .entered = m->entered, .arena = m->arena, .anew = true};
    if (!read_parts(m, e) || !all_there(m, threads, e) || !seen_alike(m, e) || !finish_level(&f, e) || !finish_tables(&f, e))
        return false;
    m->report->full_scale = f.full_scale;
    m->report->left = f.left;
    m->report->unheard = f.unheard;
    if (!judge(m, e))
        return false;
    if (f.alone) /* else a shard that runs again has taken the tables away, and the next merge writes them anew */
        shard_sweep(m->folder);
    return true;
}

void merge_close(struct merge_report *r)
{
    journal_close(r->journal);
    r->journal = NULL;
}

/* Looking takes its time, in which shards of another state may begin, and end: what they have left is not swept. */
static bool sweep_rest(const struct merge *m, struct err *e)
{
    if (!merged_already(m->folder, m->arena, m->report, e))
        return false;
    int entered = folder_enter(m->folder);
    if (m->shards.n && folder_is_mine(entered) && merge_shards_swept(&m->shards, m->arena))
        shard_sweep(m->folder);
    folder_leave(entered);
    return true;
}

static bool run(const char *folder, int threads, struct arena *a, struct merge_report *r, struct err *e)
{
    struct merge m = {.folder = folder, .arena = a, .report = r, .kit = {.set = &r->set, .folder = folder}};
    merge_shards_find(folder, a, &m.shards);
    if (!m.shards.n || merge_shards_swept(&m.shards, a))
        return sweep_rest(&m, e);
    if (!merge_shards_agree(&m.shards, e) || !set_file_load(arena_format(a, "%s/.rasp/set.json", folder), a, &r->set, e))
        return false;
    r->outcomes = ARENA_TAKE(a, struct outcome, r->set.n);
    bool all = merge_shards_complete(&m.shards, a, e);
    r->shards = m.shards.of;
    r->missing = m.shards.missing;
    if (!all)
        return false;
    bool ok = claim_join(&(struct claim){.folder = folder, .sha256 = r->set.sha256, .build = r->set.build}, a, &m.entered, e);
    m.kit.journal = r->journal = ok ? journal_open(folder, arena_format(a, "%s/.rasp/journal", folder), a, e) : NULL;
    ok = m.kit.journal && join(&m, threads, e);
    folder_leave(m.entered);
    return ok;
}

bool merge_run(const char *folder, int threads, struct arena *a, struct merge_report *r, struct err *e)
{
    *r = (struct merge_report){.missing = "", .unheard = "", .full_scale = NAN};
    struct merge_lock lock;
    bool ok = merge_lock_take(folder, a, &lock) ? run(folder, threads, a, r, e) : err_set(e, ERR_CREATE, "%s: another rasp merge is at work in it: wait until it has ended", folder);
    merge_lock_give(&lock);
    return ok;
}
