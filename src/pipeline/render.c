#include "pipeline/render.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/stopwatch.h"
#include "num/scaled.h"
#include "output/stems.h"
#include "pipeline/inputs.h"
#include "pipeline/outputs.h"
#include "pipeline/stages.h"
#include "pipeline/summary.h"
#include "response/listener.h"
#include "response/modes.h"
#include "trajectory/contact.h"
#include "trajectory/trajectory.h"

struct render {
    const struct scene *scene;
    const char *base;
    bool set;   /* render_make: no summary is written */
    bool waits; /* for its gain: no effective scene is written */
    struct watch inputs;
    struct arena *arena;
    struct render_parts parts;
    bool sounds;
    struct render_length length;
    double *block;       /* STAGE_BLOCK frames of all channels */
    struct sound *sound; /* NULL: nothing rings */
    struct stems *stems; /* NULL: none are asked for */
    char *wav_path, *scene_path, *summary_path;
    const char *stem_paths[STEMS];
    struct outfile effective, summary;
    struct render_report *report;
};

static bool render_open(struct render *r, struct err *e)
{
    double start = stopwatch_cpu();
    if (!inputs_check(r->scene, r->arena, e) || !render_parts_plan(&r->parts, e)) return false;
    r->report->planned = stopwatch_cpu() - start;
    if ((!r->waits && !outfile_open(&r->effective, r->scene_path, e)) ||
        (!r->set && !outfile_open(&r->summary, r->summary_path, e)))
        return false;
    for (struct render_part *one = r->parts.parts; one < r->parts.parts + r->scene->n_contacts; one++) {
        unsigned targets = one->plan.targets;
        one->table_path = outputs_path(r->scene, r->base, OUTPUT_TABLE, one->plan.contact, r->arena);
        one->listing_path = outputs_path(r->scene, r->base, OUTPUT_LISTING, one->plan.contact, r->arena);
        if ((targets & ITEM_BIT(ITEM_TABLE) && !outfile_open(&one->table, one->table_path, e)) ||
            (targets & ITEM_BIT(ITEM_LISTING) && !outfile_open(&one->listing, one->listing_path, e)))
            return false;
        one->rows.stream = one->table.stream;
        one->impacts.stream = one->listing.stream;
        if (!targets) continue;
        if (!run_open(&one->run, &one->plan, r->scene, &(struct run_sinks){&one->rows, &one->impacts}, e)) return false;
        one->open = true;
    }
    if (!render_parts_agree(&r->parts, e) || !render_parts_length(&r->parts, &r->length, e)) return false;
    r->sounds = r->parts.asked & ITEM_BIT(ITEM_SOUND);
    r->block = ARENA_TAKE(r->arena, double, STAGE_BLOCK *listener_channels(&r->scene->output));
    if (r->sounds && !(r->sound = sound_open(r->scene, r->wav_path, r->length.frames, r->arena, e))) return false;
    return !r->scene->output.stems ||
           (r->stems = stems_open(r->scene, r->stem_paths, r->length.frames, r->arena, e)) != NULL;
}

/* Adds what a contact gives; a body's sound times the contact's gain, as the sound itself is. */
static void part_sum(const struct render_part *p, enum item item, const long range[2], double *sum)
{
    long begin = range[0] > p->start ? range[0] - p->start : 0, end = range[1] - p->start;
    bool body = item == ITEM_SURFACE_SOUND || item == ITEM_SCRAPER_SOUND;
    if (end <= begin || !p->open || !(p->plan.targets & ITEM_BIT(item))) return;
    const double *x = board_at(&p->run.board, item, begin);
    double gain = body ? p->plan.contact->gain : 1;
    int width = p->run.board.signals[item].per_frame;
    sum += (begin + p->start - range[0]) * width;
    scaled_add(sum, gain, x, (end - begin) * width);
}

static bool render_blocks(struct render *r, struct err *e)
{
    static const enum item items[STEMS] = {ITEM_FORCE, ITEM_SURFACE_SOUND, ITEM_SCRAPER_SOUND, ITEM_SCRAPER_SOUND};
    const struct output *o = &r->scene->output;
    struct render_part *parts = r->parts.parts;
    int n = r->scene->n_contacts;
    for (long from = 0, to; from < r->length.frames; from = to) {
        to = from + STAGE_BLOCK < r->length.frames ? from + STAGE_BLOCK : r->length.frames;
        if (interrupt_seen())
            return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
        for (struct render_part *one = parts; one < parts + n; one++)
            if (one->open && to > one->start && !run_block(&one->run, to - one->start, e)) return false;
        for (int k = 0; k < STEMS; k++) {
            if (!stems_asked(o, (enum stem)k)) continue;
            memset(r->block, 0, (size_t)((to - from) * stems_channels(o, (enum stem)k)) * sizeof *r->block);
            for (int i = 0; i < n; i++) /* what touches the surface is of one stem or of the other */
                if (k != (contact_rolls(&r->scene->contacts[i]) ? STEM_SCRAPER : STEM_BALL))
                    part_sum(&parts[i], items[k], (const long[2]){from, to}, r->block);
            if (!stems_add(r->stems, (enum stem)k, r->block, to - from, e)) return false;
        }
        if (!r->sound) continue;
        memset(r->block, 0, (size_t)((to - from) * listener_channels(o)) * sizeof *r->block);
        for (int i = 0; i < n; i++)
            part_sum(&parts[i], ITEM_SOUND, (const long[2]){from, to}, r->block);
        if (!sound_add(r->sound, r->block, to - from, e)) return false;
    }
    return true;
}

static struct render_file *list(struct render *r, enum output_kind kind, const char *path)
{
    struct render_file *f = &r->report->files[r->report->n_files++];
    *f = (struct render_file){.kind = outputs_kind(r->scene, kind),
                              .path = path,
                              .stem = kind >= OUTPUT_STEM ? stems_names[kind - OUTPUT_STEM] : NULL};
    return f;
}

/* A file of a contact's own. */
static bool list_part(struct render *r, struct render_part *p, enum output_kind kind, struct err *e)
{
    struct outfile *file = kind == OUTPUT_TABLE ? &p->table : &p->listing;
    char hex[HASH_TEXT];
    if (!file->stream) return true;
    if (!outfile_hash(file, hex, e)) return false;
    struct render_file *f = list(r, kind, kind == OUTPUT_TABLE ? p->table_path : p->listing_path);
    f->file = file;
    f->contact = p->plan.contact->name;
    f->sha256 = arena_text(r->arena, hex);
    return true;
}

static void list_track(struct render *r, enum output_kind kind, const char *path, struct track *track)
{
    struct render_file *f = list(r, kind, path);
    f->track = track;
    f->written = track_written(track, r->arena);
}

/* What will have been written. A WAV is whole only after the summary that holds the hashes: it is listed without. */
static bool render_list(struct render *r, const char *effective, struct err *e)
{
    char hex[HASH_TEXT];
    r->report->files = ARENA_TAKE(r->arena, struct render_file, 2 * r->scene->n_contacts + OUTPUT_KINDS);
    for (int i = 0; i < r->scene->n_contacts; i++)
        if (!list_part(r, &r->parts.parts[i], OUTPUT_TABLE, e) || !list_part(r, &r->parts.parts[i], OUTPUT_LISTING, e))
            return false;
    if (!r->waits) {
        struct render_file *f = list(r, OUTPUT_EFFECTIVE, r->scene_path);
        hash_bytes(effective, strlen(effective), hex);
        f->file = &r->effective;
        f->sha256 = arena_text(r->arena, hex);
    }
    if (!r->set) list(r, OUTPUT_SUMMARY, r->summary_path)->file = &r->summary;
    if (r->sounds) list_track(r, OUTPUT_SOUND, r->wav_path, sound_track(r->sound));
    for (int k = 0; k < STEMS; k++)
        if (stems_asked(&r->scene->output, (enum stem)k))
            list_track(r, OUTPUT_STEM + k, r->stem_paths[k], stems_track(r->stems, (enum stem)k));
    return true;
}

static bool render_finish(struct render *r, double start[2], struct err *e)
{
    struct render_report *report = r->report;
    report->sound.gain = 1;
    if ((r->sound && !sound_finish(r->sound, &report->sound, e)) ||
        (r->stems && !stems_finish(r->stems, report->sound.gain, e)))
        return false;
    report->frames = r->length.frames;
    report->length = r->length;
    report->sounds = r->sounds;
    report->quantity = render_parts_quantity(&r->parts);
    report->seconds = stopwatch_wall() - start[0];
    report->cpu = stopwatch_cpu() - start[1];
    report->older = r->set ? ARENA_TAKE(r->arena, const char *, 1) : outputs_older(r->scene, r->base, r->arena);
    const struct run **runs = ARENA_TAKE(r->arena, const struct run *, r->scene->n_contacts);
    int n = 0;
    for (int i = 0; i < r->scene->n_contacts; i++) {
        runs[i] = r->parts.parts[i].open ? &r->parts.parts[i].run : NULL;
        n += runs[i] ? runs[i]->n : 0;
    }
    struct render_time *time = report->times = ARENA_TAKE(r->arena, struct render_time, n);
    for (int i = 0; i < r->scene->n_contacts; i++)
        for (int k = 0; runs[i] && k < runs[i]->n; k++)
            *time++ = (struct render_time){runs[i]->stages[k].opened, runs[i]->stages[k].seconds};
    const char *effective = outputs_effective(r->scene, r->scene_path, r->arena);
    if (!render_list(r, effective, e)) return false;
    summary_notes(r->scene, runs, report, r->arena);
    summary_warnings(r->scene, runs, report, r->arena);
    report->summary = summary_text(r->scene, runs, report, !r->set, r->arena);
    if (!r->waits) fputs(effective, r->effective.stream);
    if (!r->set) fputs(report->summary, r->summary.stream);
    return true;
}

void render_drop(struct render *r)
{
    sound_drop(r->sound);
    stems_drop(r->stems);
    outfile_drop(&r->effective);
    outfile_drop(&r->summary);
    render_parts_close(&r->parts);
}

/* All together or none, also where a signal comes. */
bool render_commit(struct render *r, struct err *e)
{
    interrupt_hold();
    bool ok = true;
    for (int k = 0; k < r->report->n_files && ok; k++) {
        struct render_file *f = &r->report->files[k];
        ok = f->file ? outfile_commit(f->file, e) : track_commit(f->track, e);
    }
    interrupt_go();
    render_drop(r);
    return ok;
}

/* names NULL: as render_scene. */
static struct render *make(const struct scene *s, const char *base, const struct render_names *names, struct arena *a,
                           struct render_report *report, struct err *e)
{
    double start[2] = {stopwatch_wall(), stopwatch_cpu()};
    struct scene *copy = ARENA_TAKE(a, struct scene, 1);
    struct render *r = ARENA_TAKE(a, struct render, 1);
    *r = (struct render){.scene = copy,
                         .base = base,
                         .set = names,
                         .waits = names && names->sounds,
                         .inputs = inputs_watch(s, a),
                         .arena = a,
                         .report = report};
    *report = (struct render_report){.quantity = -1};
    if (!error_budget_apply(s, a, copy, &report->error_budget, e)) return NULL;
    report->accuracy = copy->accuracy;
    r->parts = render_parts_make(copy, a);
    r->effective.fd = r->summary.fd = -1;
    const char *sounds = r->waits ? names->sounds : base;
    r->wav_path = outputs_path(copy, sounds, OUTPUT_SOUND, NULL, a);
    r->scene_path = outputs_path(copy, base, OUTPUT_EFFECTIVE, NULL, a);
    r->summary_path = outputs_path(copy, base, OUTPUT_SUMMARY, NULL, a);
    for (int k = 0; k < STEMS; k++)
        r->stem_paths[k] = outputs_path(copy, sounds, OUTPUT_STEM + k, NULL, a);
    bool ok = render_open(r, e) && render_blocks(r, e) && render_finish(r, start, e);
    /* Whatever can fail is done for every file before the first takes its name: a full disk leaves all earlier results
       or none. */
    for (struct render_file *f = report->files; ok && f < report->files + report->n_files; f++) {
        ok = f->file ? outfile_finalise(f->file, e) : track_finalise(f->track, e);
        if (ok) f->temporary = f->file ? f->file->temporary : wav_temporary(f->track->wav);
    }
    if (ok && inputs_still(&r->inputs, e)) return r;
    render_drop(r);
    return NULL;
}

struct render *render_make(const struct scene *s, const struct render_names *names, struct arena *a,
                           struct render_report *report, struct err *e)
{
    return make(s, names->base, names, a, report, e);
}

bool render_scene(const struct scene *s, const char *base, struct arena *a, struct render_report *report, struct err *e)
{
    struct render *r = make(s, base, NULL, a, report, e);
    return r && render_commit(r, e);
}

struct render_parts render_parts_make(const struct scene *s, struct arena *a)
{
    struct render_parts p = {.scene = s, .arena = a, .parts = ARENA_TAKE(a, struct render_part, s->n_contacts)};
    for (int i = 0; i < s->n_contacts; i++)
        p.parts[i].table.fd = p.parts[i].listing.fd = -1;
    return p;
}

/* ------------------------------------------------------------------ plans */

bool render_parts_plan(struct render_parts *p, struct err *e)
{
    for (int i = 0; i < p->scene->n_contacts; i++) {
        struct render_part *one = &p->parts[i];
        if (!plan_make(stages_table, &p->scene->contacts[i], p->scene, p->arena, &one->plan, e)) return false;
        one->start = contact_first_frame(&p->scene->contacts[i], p->scene->output.sample_rate);
        p->asked |= one->plan.targets;
    }
    return p->asked || err_about(e, p->scene->contacts[0].name, "gain") ||
           err_set(e, ERR_SCENE,
                   "the gain of every contact is 0: nothing is left to render; give one of them another gain");
}

/* ------------------------------------------------------------------ runs */

/* The first run whose sound says its quantity. */
static const struct run *stated(const struct render_parts *p)
{
    for (int i = 0; i < p->scene->n_contacts; i++)
        if (p->parts[i].open && p->parts[i].run.board.quantity >= 0) return &p->parts[i].run;
    return NULL;
}

int render_parts_quantity(const struct render_parts *p)
{
    const struct run *run = stated(p);
    return run ? run->board.quantity : -1;
}

/* What is summed is of one quantity; contacts that ring by WAVs, which do not say theirs, go with any. */
bool render_parts_agree(const struct render_parts *p, struct err *e)
{
    const struct run *first = stated(p);
    for (int i = 0; i < p->scene->n_contacts; i++) {
        const struct run *run = &p->parts[i].run;
        if (p->parts[i].open && run->board.quantity >= 0 && run->board.quantity != first->board.quantity)
            return err_about(e, run->plan.contact->name, "surface.response") ||
                   err_set(e, ERR_SCENE,
                           "contact '%s' gives %s, but contact '%s' %s: they cannot be summed; use mode tables of one "
                           "quantity, or choose one by "
                           "output.quantity",
                           run->plan.contact->name, modes_quantity_name(run->board.quantity), first->plan.contact->name,
                           modes_quantity_name(first->board.quantity));
    }
    if (!isnan(p->scene->output.level.dbfs_at_1_pa) && render_parts_quantity(p) != MODES_PRESSURE)
        return err_set(e, ERR_SCENE,
                       "output.level.dbfs_at_1_pa: the sound is not in pascals but %s: choose output.listen.radiator: "
                       "monopole or plate, or give "
                       "output.level.full_scale",
                       first ? modes_quantity_name(first->board.quantity)
                             : "in what its recorded responses are, which they do not say");
    return true;
}

bool render_parts_length(const struct render_parts *p, struct render_length *length, struct err *e)
{
    double tail = p->scene->output.tail, ring = 0, rate = p->scene->output.sample_rate;
    long end = 0;
    for (int i = 0; i < p->scene->n_contacts; i++) {
        const struct render_part *one = &p->parts[i];
        const struct contact *c = one->plan.contact;
        struct trajectory tr;
        long moving = one->open ? one->run.board.moving : 0;
        if (!one->open) { /* a muted one has no run */
            if (!trajectory_make(&c->motion, trajectory_seed(p->scene, c), p->arena, &tr, e))
                return err_at(e, "contact '%s'", c->name);
            moving = trajectory_frames(&tr, rate);
        }
        end = one->start + moving > end ? one->start + moving : end;
        if (one->open) ring = fmax(ring, one->run.board.ring);
    }
    length->motion = end;
    length->natural =
        end + (p->asked & ITEM_BIT(ITEM_SOUND) ? (long)ceil((isnan(tail) ? fmin(ring, 60) : tail) * rate) : 0);
    length->frames = !isnan(p->scene->output.duration) ? (long)rint(p->scene->output.duration * rate) : length->natural;
    return true;
}

void render_parts_close(struct render_parts *p)
{
    for (int i = 0; i < p->scene->n_contacts; i++) {
        outfile_drop(&p->parts[i].table);
        outfile_drop(&p->parts[i].listing);
        if (p->parts[i].open) run_close(&p->parts[i].run);
    }
}
