#include "force/given.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/file_cache.h"
#include "base/text.h"
#include "file/bytes.h"
#include "file/heightfile_formats.h"
#include "file/npy.h"
#include "file/wav.h"
#include "force/approach.h"
#include "num/resample.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "trajectory/series.h"
#include "trajectory/trajectory.h"

/* ------------------------------------------------------------------ parameters */

#define GIVEN "contact.model=given"

static const struct key keys[] = {
    {ROW_FILE(given_force, file, "contact.given.file"), KEY_NONE, 0, 0, NULL, GIVEN,
     "the force over time: a WAV, a one-dimensional NPY, or a CSV with the columns time_s and force_n",
     .example = "force.wav"},
    {ROW_COUNT(given_force, channel, "contact.given.channel"), KEY_NONE, 1, 1000, "1", GIVEN, "which channel of a WAV"},
    {ROW_NUMBER(given_force, scale, "contact.given.scale"), KEY_FORCE, -1e12, 1e12, "", GIVEN,
     "newtons per stored unit; left out: 1 N for NPY and CSV, and a WAV must say", .shown = "10 N"},
    {ROW_NUMBER(given_force, rate, "contact.given.rate"), KEY_FREQUENCY, 1, 1e8, "", GIVEN,
     "samples per second of an NPY, which does not hold it", .shown = "48 kHz"},
    {ROW_TEXT(given_force, column, "contact.given.column"), KEY_NONE, 0, 0, "force_n", GIVEN,
     "the column of a CSV that is the force"},
    {.path = NULL}};

/* The file's name tells what it is; of other names the file itself does, when it is read. One that is not there is what
 * is wrong first (pipeline/inputs.h). */
static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct given_force *g = own;
    static const char *const kinds[] = {"a WAV", "an NPY", "a CSV"}, *const endings[] = {".wav", ".npy", ".csv"};
    static const char *const paths[] = {"contact.given.channel", "contact.given.rate",
                                        "contact.given.column"}; /* each is of one kind */
    int kind = 0;
    (void)c;
    if (g->scale == 0)
        scene_part_refuse(p, "contact.given.scale", "contact.given.scale", "write for instance: 10 N",
                          " is 0: there would be no force");
    while (g->file && kind < 3 && !text_ends_in(g->file, endings[kind]))
        kind++;
    if (!g->file || kind == 3) return;
    if (kind == 0 && access(g->file, F_OK) == 0)
        scene_part_missing(p, "contact.given.scale", "10 N",
                           ": a WAV does not say how many newtons its full scale stands for");
    if (kind == 1 && access(g->file, F_OK) == 0)
        scene_part_missing(p, "contact.given.rate", "48 kHz", ": an NPY does not say how many samples a second has");
    const bool given[] = {g->channel > 1, !isnan(g->rate),
                          g->column && strcmp(g->column, "force_n") != 0}; /* defaults stand in every effective scene */
    for (int i = 0; i < 3; i++)
        if (i != kind && given[i])
            diag_add(p->yaml->diag, yaml_find(p->map, paths[i])->key->at, "remove it", "%s is of %s, and %s is %s",
                     scene_part_label(p, paths[i]), kinds[i], diag_shown(p->yaml->diag, g->file), kinds[kind]);
}

static bool is_given(const struct contact *c) { return c->contact.model == CONTACT_GIVEN; }

static const struct params given_params = {
    .section = "contact.given",
    .size = sizeof(struct given_force),
    .keys = keys,
    .check = check,
    .given = is_given,
};

static const struct given_force *given_of(const struct contact *c) { return params_of(c, &given_params); }

/* ------------------------------------------------------------------ both kinds of files */

bool given_is_table(const struct contact *c) { return given_of(c)->file && text_ends_in(given_of(c)->file, ".csv"); }

static double given_scale(const struct contact *c) { return isnan(given_of(c)->scale) ? 1 : given_of(c)->scale; }

/* Keys that a file of this kind has no use for: ERR_SCENE. channel: a WAV; rate: an NPY; column: a CSV. */
static bool given_fits(const struct contact *c, const char *kind, struct err *e)
{
    const struct given_force *g = given_of(c);
    const char *key = strcmp(kind, "WAV") != 0 && g->channel != 1                     ? "channel"
                      : strcmp(kind, "NPY") != 0 && !isnan(g->rate)                   ? "rate"
                      : strcmp(kind, "CSV") != 0 && strcmp(g->column, "force_n") != 0 ? "column"
                                                                                      : NULL;
    return !key ||
           err_set(e, ERR_SCENE, "contact '%s': contact.given.%s means nothing for %s, which is read as %s: remove it",
                   c->name, key, g->file, kind);
}

/* A force ends within its motion; last: s after the motion's start, of its last sample or row. */
static bool given_ends(const struct contact *c, double last, double duration, struct err *e)
{
    return last <= duration + 1e-9 || err_set(e, ERR_SCENE,
                                              "contact '%s': contact.given.file: the force of %s lasts %.9g s, but the "
                                              "motion lasts %.9g s: raise motion.duration, or cut "
                                              "the file",
                                              c->name, given_of(c)->file, last, duration);
}

/* Index of the largest magnitude of n >= 1 values, `stride` apart. */
static size_t given_largest(size_t n, const double *x, size_t stride)
{
    size_t at = 0;
    for (size_t i = 1; i < n; i++)
        at = fabs(x[i * stride]) > fabs(x[at * stride]) ? i : at;
    return at;
}

/* ------------------------------------------------------------------ samples */

/* A force given as samples, from one channel of a WAV (whatever libsndfile reads) or from a one-dimensional NPY:

     f[n] = scale x[n]     N, at n / rate after the contact's start; 0 before the first and after the last sample

   At the audio rate samples stay what they are; at another they are resampled as a band-limited signal
   (num/resample.h), with the sum over the rate, the momentum, that they have: what would ring before the first is
   folded into the first ones, what rings after the last is kept. */

struct given_samples {
    double rate;      /* Hz, of the file; then of the scene    */
    size_t n, stride; /* samples; values from one to the next  */
    const double *x;  /* as the file has them, or resampled    */
    double scale;     /* N per unit                            */
};

static bool samples_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_GIVEN && !given_is_table(c);
}

/* As the file has them. */
struct given_file {
    bool is_npy;
    struct wav wav;
    struct heightfile npy;
};

static bool given_make(const char *path, const void *how, struct arena *a, void *thing, struct err *e)
{
    struct arena *scratch = arena_open(); /* the file's own bytes are not kept */
    struct given_file *f = thing;
    struct bytes b;
    (void)how;
    bool ok = bytes_read(path, scratch, &b, e);
    f->is_npy = ok && npy_is(&b);
    ok = ok && (f->is_npy ? heightfile_formats_npy_read(path, &b, a, &f->npy, e) : wav_read(path, a, &f->wav, e));
    arena_close(scratch);
    for (size_t i = 0; ok && f->is_npy && f->npy.rows == 1 && i < f->npy.columns; i++)
        ok = isfinite(f->npy.z[i]) || err_set(e, ERR_SCENE, "%s: element %zu is not a finite number: mend it", path, i);
    return ok;
}

static bool wav_take(const struct stage_run *r, const struct wav *w, struct given_samples *g, struct err *e)
{
    const struct given_force *given = given_of(r->contact);
    if (given->channel > w->channels)
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.given.channel is %d, but %s has %d channel%s: give one of those",
                       r->contact->name, given->channel, given->file, w->channels, w->channels == 1 ? "" : "s");
    if (isnan(given->scale))
        return err_set(
            e, ERR_SCENE,
            "contact '%s': contact.given.scale must be given: %s does not say how many newtons its %s stands for",
            r->contact->name, given->file, w->bits ? "full scale" : "unit");
    *g = (struct given_samples){w->rate, w->frames, (size_t)w->channels, w->x + given->channel - 1, given->scale};
    return true;
}

static bool npy_take(const struct stage_run *r, const struct heightfile *h, struct given_samples *g, struct err *e)
{
    const struct given_force *given = given_of(r->contact);
    if (h->rows > 1)
        return err_set(e, ERR_SCENE, "%s: an array of %zu x %zu; a force has one dimension: save one row of it",
                       given->file, h->rows, h->columns);
    if (isnan(given->rate))
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.given.rate must be given: %s does not say how many samples a second has",
                       r->contact->name, given->file);
    *g = (struct given_samples){given->rate, h->columns, 1, h->z, given_scale(r->contact)};
    return true;
}

/* By content. */
static bool samples_take(const struct stage_run *r, struct given_samples *g, struct err *e)
{
    static const struct file_cache_kind forces = {"samples of a force", sizeof(struct given_file), given_make, false};
    const struct given_file *f =
        file_cache_take(r->scene->file_cache,
                        &(struct file_cache_ask){.kind = &forces, .file = given_of(r->contact)->file}, r->arena, e);
    if (!f || !given_fits(r->contact, f->is_npy ? "NPY" : "WAV", e)) return false;
    return f->is_npy ? npy_take(r, &f->npy, g, e) : wav_take(r, &f->wav, g, e);
}

/* To the audio rate, with what rings after the last sample. */
static bool samples_resample(const struct stage_run *r, struct given_samples *g, struct err *e)
{
    double rate = r->board->rate;
    size_t rings = (size_t)ceil(RESAMPLE_REACH * g->rate / fmin(rate, g->rate));
    double *x = ARENA_TAKE(r->arena, double, g->n + rings), *y;
    for (size_t i = 0; i < g->n; i++)
        x[i] = g->scale * g->x[i * g->stride];
    if (!resample(r->arena, x, g->n + rings, g->rate, rate, &y, &g->n, e)) return false;
    g->x = y;
    g->stride = 1;
    g->scale = 1;
    return true;
}

static bool samples_open(struct stage_run *r, struct err *e)
{
    struct given_samples *g = ARENA_TAKE(r->arena, struct given_samples, 1);
    r->state = g;
    if (!samples_take(r, g, e) ||
        !given_ends(r->contact, (double)(g->n - 1) / g->rate, r->board->trajectory->duration, e))
        return false;
    if (r->contact->start < r->scene->output.ramp)
        approach_warn(r, "the largest force", (double)given_largest(g->n, g->x, g->stride) / g->rate);
    return g->rate == r->board->rate || samples_resample(r, g, e) || err_at(e, "%s", given_of(r->contact)->file);
}

static bool samples_fill(struct stage_run *r, long from, long to, struct err *e)
{
    const struct given_samples *g = r->state;
    double *force = board_at(r->board, ITEM_FORCE, from);
    (void)e;
    long some = (long)g->n < from ? 0 : (long)g->n < to ? (long)g->n - from : to - from;
    for (long i = 0; i < some; i++)
        force[i] = g->scale * g->x[(size_t)(from + i) * g->stride];
    memset(force + some, 0, (size_t)(to - from - some) * sizeof *force);
    return true;
}

const struct stage given_samples_stage = {
    .name = "given_samples",
    .does = "contact force from the samples of a file",
    .paper = "",
    .idle = "contact.model is not given, or contact.given.file is a table",
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_FORCE),
    .wanted = samples_wanted,
    .cycles = 2,
    .open = samples_open,
    .run = samples_fill,
};

/* ------------------------------------------------------------------ a table */

/* A force given as a table over time (CSV: time_s, and the column contact.given.column), taken as piecewise linear
   between its times, which may lie at any distances; times two rows of which are near make a step. Times are those of a
   recorded motion's file, else they count from the contact's start. Before the first and after the last row the force
   is 0.

   Means over sub-intervals are exact: each piece of the table within one adds its value at the middle of what it shares
   with it. Times are turned into sub-intervals once, so that pieces meet where they should. */

struct given_table {
    size_t n, piece;    /* rows; the piece in which the last sub-interval ended */
    double *at, *force; /* [n] sub-intervals after the contact's start; N       */
};

static bool table_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_GIVEN && given_is_table(c);
}

static double table_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 12 * s->accuracy.oversampling;
}

static bool table_open(struct stage_run *r, struct err *e)
{
    const struct given_force *given = given_of(r->contact);
    const struct trajectory *tr = r->board->trajectory;
    const char *const columns[2] = {given->column, NULL};
    struct given_table *g = ARENA_TAKE(r->arena, struct given_table, 1);
    struct series s;
    if (!given_fits(r->contact, "CSV", e) || !series_read(given->file, columns, r->arena, &s, e)) return false;
    *g = (struct given_table){
        .n = s.n, .at = ARENA_TAKE(r->arena, double, s.n), .force = ARENA_TAKE(r->arena, double, s.n)};
    double first = s.time[0] - tr->clock, last = s.time[s.n - 1] - tr->clock;
    if (first < -1e-9)
        return err_set(e, ERR_SCENE,
                       "%s:%d: column 'time_s': %.9g s lies before the motion's start, %.9g s: take away the rows "
                       "before it, or let "
                       "motion.file begin earlier",
                       given->file, s.lines[0], s.time[0], tr->clock);
    if (!given_ends(r->contact, last, tr->duration, e)) return false;
    approach_warn(r, "the largest force", s.time[given_largest(s.n, s.x[0], 1)] - tr->clock);
    for (size_t i = 0; i < s.n; i++) {
        g->at[i] = (s.time[i] - tr->clock) * r->board->rate * r->board->over;
        g->force[i] = given_scale(r->contact) * s.x[0][i];
    }
    r->state = g;
    return true;
}

/* Mean over sub-interval k; k does not fall from call to call. */
static double table_mean(struct given_table *g, double k)
{
    double sum = 0;
    for (; g->piece + 1 < g->n; g->piece++) {
        const double *at = g->at + g->piece, *force = g->force + g->piece;
        double lo = fmax(at[0] - k, 0), hi = fmin(at[1] - k, 1), middle = 0.5 * (lo + hi);
        if (hi > lo) sum += (hi - lo) * (force[0] + (force[1] - force[0]) * ((middle - (at[0] - k)) / (at[1] - at[0])));
        if (at[1] - k > 1) break;
    }
    return sum;
}

static bool table_fill(struct stage_run *r, long from, long to, struct err *e)
{
    struct given_table *g = r->state;
    const struct board *b = r->board;
    double *force = board_at(b, ITEM_SUBFORCE, from), first = (double)(from * b->over);
    (void)e;
    for (long i = 0; i < (to - from) * b->over; i++)
        force[i] = table_mean(g, first + (double)i);
    return true;
}

const struct stage given_table_stage = {
    .name = "given_table",
    .does = "contact force from a table over time",
    .paper = "",
    .idle = "contact.model is not given, or contact.given.file holds samples",
    .params = &given_params,
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .wanted = table_wanted,
    .work = table_work,
    .open = table_open,
    .run = table_fill,
};
