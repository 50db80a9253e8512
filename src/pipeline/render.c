#include "pipeline/render.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/stopwatch.h"
#include "output/force_table.h"
#include "pipeline/inputs.h"
#include "pipeline/outputs.h"
#include "pipeline/stages.h"
#include "pipeline/summary.h"
#include "scene/rules.h"
#include "trajectory/trajectory.h"

struct part {                /* one contact at work */
    struct plan plan;
    struct run run;
    long start;              /* frame of the scene at which it begins */
    bool open;
    struct outfile csv;
    struct table_sink sink;
    char *csv_path;
};

struct render {
    const struct scene *scene;
    const char *base;
    struct arena *arena;
    struct part *parts;
    bool sounds;
    long frames;
    struct sound *sound;
    char *wav_path, *scene_path, *summary_path;
    struct outfile effective, summary;
    struct render_report *report;
};

static bool render_plans(struct render *r, struct err *e)
{
    unsigned asked = 0;
    for (int i = 0; i < r->scene->n_contacts; i++) {
        struct part *p = &r->parts[i];
        if (!plan_make(stages_table, &r->scene->contacts[i], r->scene, r->arena, &p->plan, e))
            return false;
        r->sounds = r->sounds || p->plan.targets & ITEM_BIT(ITEM_SOUND);
        p->start = rules_first_frame(&r->scene->contacts[i], r->scene->output.sample_rate);
        asked |= p->plan.targets;
    }
    return asked || err_set(e, ERR_SCENE, "the gain of every contact is 0: nothing is left to render");
}

/* What is summed is of one quantity; contacts that ring by WAVs, which do not say theirs, go with any. */
static bool render_quantities(const struct render *r, struct err *e)
{
    static const char *const names[] = {"displacement", "velocity", "acceleration"};
    const struct run *first = NULL;
    for (int i = 0; i < r->scene->n_contacts; i++) {
        const struct run *run = &r->parts[i].run;
        if (!r->parts[i].open || run->board.quantity < 0)
            continue;
        first = first ? first : run;
        if (run->board.quantity != first->board.quantity)
            return err_set(e, ERR_SCENE, "contact '%s' gives %s, but contact '%s' %s: they cannot be summed; use mode tables of one quantity",
                           run->plan.contact->name, names[run->board.quantity], first->plan.contact->name, names[first->board.quantity]);
    }
    return true;
}

/* Opens the tables, so that the stages can write their headers, then the stages. */
static bool render_runs(struct render *r, struct err *e)
{
    for (int i = 0; i < r->scene->n_contacts; i++) {
        struct part *p = &r->parts[i];
        p->csv_path = outputs_path(r->scene, r->base, OUTPUT_TABLE, p->plan.contact, r->arena);
        if (p->plan.targets & ITEM_BIT(ITEM_TABLE) && !outfile_open(&p->csv, p->csv_path, e))
            return false;
        p->sink.stream = p->csv.stream;
        if (!p->plan.targets)
            continue;
        if (!run_open(&p->run, &p->plan, r->scene, &p->sink, e))
            return false;
        p->open = true;
    }
    return render_quantities(r, e);
}

/* Frames of a contact's motion; of a muted one, which has no run, too. */
static bool part_frames(const struct render *r, const struct part *p, long *frames, struct err *e)
{
    struct trajectory tr;
    *frames = p->open ? p->run.board.moving : 0;
    if (p->open)
        return true;
    if (!trajectory_make(&p->plan.contact->motion, trajectory_seed(r->scene, p->plan.contact), r->arena, &tr, e))
        return err_at(e, "contact '%s'", p->plan.contact->name);
    *frames = trajectory_frames(&tr, r->scene->output.sample_rate);
    return true;
}

/* Length of the whole: the last motion's end, also of a muted contact, and the tail of what rings. */
static bool render_length(struct render *r, struct err *e)
{
    double tail = r->scene->output.tail, ring = 0, rate = r->scene->output.sample_rate;
    long end = 0, frames;
    for (int i = 0; i < r->scene->n_contacts; i++) {
        struct part *p = &r->parts[i];
        if (!part_frames(r, p, &frames, e))
            return false;
        end = p->start + frames > end ? p->start + frames : end;
        if (p->open)
            ring = fmax(ring, p->run.board.ring);
    }
    r->frames = end + (r->sounds ? (long)ceil((isnan(tail) ? fmin(ring, 60) : tail) * rate) : 0);
    return true;
}

static bool render_open(struct render *r, struct err *e)
{
    r->wav_path = outputs_path(r->scene, r->base, OUTPUT_SOUND, NULL, r->arena);
    r->scene_path = outputs_path(r->scene, r->base, OUTPUT_EFFECTIVE, NULL, r->arena);
    r->summary_path = outputs_path(r->scene, r->base, OUTPUT_SUMMARY, NULL, r->arena);
    if (!inputs_check(r->scene, r->arena, e) || !render_plans(r, e) || !outfile_open(&r->effective, r->scene_path, e) ||
        !outfile_open(&r->summary, r->summary_path, e) || !render_runs(r, e) || !render_length(r, e))
        return false;
    if (r->sounds && !(r->sound = sound_open(r->scene, r->wav_path, r->frames, r->arena, e)))
        return false;
    return true;
}

/* One contact's share of the frames [from, to). */
static bool part_block(struct part *p, long from, long to, double *mix, struct err *e)
{
    long begin = from - p->start > 0 ? from - p->start : 0, end = to - p->start;
    if (end <= begin || !p->open)
        return true;
    if (!run_block(&p->run, end, e))
        return false;
    if (!board_has(&p->run.board, ITEM_SOUND))
        return true;
    const double *x = board_at(&p->run.board, ITEM_SOUND, begin);
    for (long n = begin; n < end; n++)
        mix[n + p->start - from] += x[n - begin];
    return true;
}

static bool render_blocks(struct render *r, struct err *e)
{
    double mix[STAGE_BLOCK];
    for (long from = 0; from < r->frames; from += STAGE_BLOCK) {
        long to = from + STAGE_BLOCK < r->frames ? from + STAGE_BLOCK : r->frames;
        memset(mix, 0, sizeof mix);
        if (interrupt_seen())
            return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
        for (int i = 0; i < r->scene->n_contacts; i++)
            if (!part_block(&r->parts[i], from, to, mix, e))
                return false;
        if (r->sound && !sound_add(r->sound, mix, to - from, e))
            return false;
    }
    return true;
}

static void report_file(struct render *r, enum output_kind kind, const char *path, const char *contact, const char *sha256)
{
    const char *kept = sha256 ? arena_text(r->arena, sha256) : NULL;
    r->report->files[r->report->n_files++] = (struct render_file){outputs_kinds[kind], path, contact, kept};
}

/* What will have been written. The WAV is whole only after the summary that holds the hashes: it is listed without. */
static bool render_list(struct render *r, const char *effective, struct err *e)
{
    char hex[HASH_TEXT];
    r->report->files = ARENA_TAKE(r->arena, struct render_file, r->scene->n_contacts + 3);
    for (int i = 0; i < r->scene->n_contacts; i++) {
        struct part *p = &r->parts[i];
        if (!p->csv.stream)
            continue;
        if (!outfile_hash(&p->csv, hex, e))
            return false;
        report_file(r, OUTPUT_TABLE, p->csv_path, p->plan.contact->name, hex);
    }
    hash_bytes(effective, strlen(effective), hex);
    report_file(r, OUTPUT_EFFECTIVE, r->scene_path, NULL, hex);
    report_file(r, OUTPUT_SUMMARY, r->summary_path, NULL, NULL);
    if (r->sounds)
        report_file(r, OUTPUT_SOUND, r->wav_path, NULL, NULL);
    return true;
}

static bool render_finish(struct render *r, double start[2], struct err *e)
{
    struct render_report *report = r->report;
    if (r->sound && !sound_finish(r->sound, &report->sound, e))
        return false;
    report->frames = r->frames;
    report->sounds = r->sounds;
    report->seconds = stopwatch_wall() - start[0];
    report->cpu = stopwatch_cpu() - start[1];
    const struct run **runs = ARENA_TAKE(r->arena, const struct run *, r->scene->n_contacts);
    for (int i = 0; i < r->scene->n_contacts; i++)
        runs[i] = r->parts[i].open ? &r->parts[i].run : NULL;
    report->older = outputs_older(r->scene, r->base, r->arena);
    const char *effective = outputs_effective(r->scene, r->scene_path, r->arena);
    if (!render_list(r, effective, e))
        return false;
    summary_warnings(r->scene, runs, report, r->arena);
    report->summary = summary_text(r->scene, runs, report, r->arena);
    fputs(effective, r->effective.stream);
    fputs(report->summary, r->summary.stream);
    return true;
}

/* Whatever can fail is done for every file before the first takes its name: a full disk leaves all earlier results or none. */
static bool render_settle(struct render *r, struct err *e)
{
    for (int i = 0; i < r->scene->n_contacts; i++)
        if (r->parts[i].csv.stream && !outfile_settle(&r->parts[i].csv, e))
            return false;
    return outfile_settle(&r->effective, e) && outfile_settle(&r->summary, e) && (!r->sound || sound_settle(r->sound, e));
}

static bool render_commit(struct render *r, struct err *e)
{
    for (int i = 0; i < r->scene->n_contacts; i++)
        if (r->parts[i].csv.target[0] && !outfile_commit(&r->parts[i].csv, e))
            return false;
    return outfile_commit(&r->effective, e) && outfile_commit(&r->summary, e) && (!r->sound || sound_commit(r->sound, e));
}

static void render_close(struct render *r)
{
    sound_drop(r->sound);
    outfile_drop(&r->effective);
    outfile_drop(&r->summary);
    for (int i = 0; i < r->scene->n_contacts; i++) {
        outfile_drop(&r->parts[i].csv);
        if (r->parts[i].open)
            run_close(&r->parts[i].run);
    }
}

bool render_scene(const struct scene *s, const char *base, struct arena *a, struct render_report *report, struct err *e)
{
    double start[2] = {stopwatch_wall(), stopwatch_cpu()};
    struct render r = {.scene = s, .base = base, .arena = a, .report = report, .parts = ARENA_TAKE(a, struct part, s->n_contacts)};
    *report = (struct render_report){0};
    for (int i = 0; i < s->n_contacts; i++)
        r.parts[i].csv.fd = -1;
    r.effective.fd = r.summary.fd = -1;
    bool ok = render_open(&r, e) && render_blocks(&r, e) && render_finish(&r, start, e) && render_settle(&r, e) && render_commit(&r, e);
    render_close(&r);
    return ok;
}
