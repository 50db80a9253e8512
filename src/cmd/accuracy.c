/* rasp accuracy: what accuracy costs in time: what is rendered, the renders, and what their errors say. */
#include "cmd/accuracy.h"

#include <gsl/gsl_sort_double.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "analysis/convergence.h"
#include "base/outfile.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "batch/pool.h"
#include "num/real.h"
#include "output/gnuplot.h"
#include "output/mark.h"
#include "pipeline/error_budget.h"
#include "pipeline/outputs.h"
#include "pipeline/plan.h"
#include "pipeline/render.h"
#include "response/response.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "scene/scene_places.h"
#include "trajectory/motion.h"

enum { PRESETS = 4 };

static bool steps(int knob) { return keys_knobs[knob].scale == KEY_STEPS; }

/* --errors=N,N...: in dB, each once, from coarse to fine. */
static bool errors_read(struct accuracy_sweep *s, struct err *e)
{
    const char *word, *given = args_value(&s->call->args, "errors");
    char *rest = arena_text(s->call->arena, given ? given : "-40,-60,-80,-100,-120");
    double x;
    while ((word = strsep(&rest, ","))) {
        if (!text_double(word, &x) || !(x < 0 && x >= -240))
            return err_set(e, ERR_USAGE,
                           "--errors: '%s' is no number of dB from -240 to below 0, as in --errors=-40,-60", word);
        int at = 0;
        while (at < s->n_errors && s->errors[at] > x)
            at++;
        if (at < s->n_errors && s->errors[at] == x) continue;
        if (s->n_errors == ACCURACY_VALUES)
            return err_set(e, ERR_USAGE, "--errors: more than %d are given; leave some out", ACCURACY_VALUES);
        memmove(s->errors + at + 1, s->errors + at, (size_t)(s->n_errors++ - at) * sizeof x);
        s->errors[at] = x;
    }
    return true;
}

/* --values KNOB=N,N... of `rasp accuracy`: which values of which knobs are rendered besides those of the presets. */

static bool values_one(const char *given, struct arena *a, struct accuracy_values *to, struct err *e)
{
    const char *equals = strchr(given, '='), *names[KNOBS + 1] = {NULL}, *all = "";
    if (!equals || !equals[1])
        return err_set(e, ERR_USAGE, "--values: '%s' is not of the form KNOB=NUMBER,NUMBER..., as in oversampling=2,16",
                       given);
    const char *name = arena_format(a, "%.*s", (int)(equals - given), given), *word;
    int knob = -1;
    for (int k = 0; k < KNOBS; k++) {
        names[k] = keys_knobs[k].name;
        all = arena_format(a, "%s%s%s", all, k ? ", " : "", names[k]);
        knob = strcmp(name, names[k]) ? knob : k;
    }
    const char *near = knob < 0 ? text_nearest(name, names) : NULL;
    if (near) return err_set(e, ERR_USAGE, "--values: there is no knob '%s'; did you mean '%s'?", name, near);
    if (knob < 0) return err_set(e, ERR_USAGE, "--values: there is no knob '%s'; there are %s", name, all);
    for (char *rest = arena_text(a, equals + 1); (word = strsep(&rest, ","));) {
        const struct key_knob *k = &keys_knobs[knob];
        double x;
        if (!text_double(word, &x))
            return err_set(e, ERR_USAGE, "--values: '%s' is not a number (in KNOB=NUMBER,NUMBER..., without units)",
                           word);
        if (!accuracy_takes((enum knob)knob, x))
            return err_set(
                e, ERR_USAGE,
                "--values: accuracy.%s cannot be %s: it takes %snumbers from %g to %g; see rasp explain accuracy.%s",
                k->name, word, k->whole ? "whole " : "", k->low, k->high, k->name);
        if (to[knob].n == ACCURACY_VALUES)
            return err_set(e, ERR_USAGE, "--values: accuracy.%s is given more than %d values; leave some out", k->name,
                           ACCURACY_VALUES);
        to[knob].x[to[knob].n++] = x;
    }
    return true;
}

/* ------------------------------------------------------------------ the excerpt

   How long all will take is estimated from the work that plans predict (stage.h), so that the same scene has the same
   excerpt everywhere. In seconds of a core of 3 GHz, for each second of the motion, w being the work of a setting:

     renders       w(reference) and half of it for its neighbour; runs x w of all others; an asked error's lies between
                   those of draft, standard and high, taken for -40, -70 and -100 dB
     choices       2 w(reference) + 1.3 w(every knob at its finest): measured on the shipped scenes within a factor
                   of 3 where choosing takes a second or more

   Where the finest is refused for its memory, pilot runs go as far as memory does, and cost that whatever the motion's
   length: then the excerpt is the shortest, and errors are -40, -70 and -100 dB.

   Strikes and given forces are not cut: they refer to all of their motion, and are cheap. */

#define HERTZ 3e9
#define BUDGET 8.0       /* s: what is predicted is not more than doubled */
#define SHORTEST 0.05    /* s */
#define STARTING 0.01    /* s, of a render that is next to nothing */
#define NEARLY_WHOLE 0.8 /* of the motion: an excerpt that long is none */
#define LONGEST 11.0     /* s, that all takes where more than LEAST_RUNS are made of each setting */
#define LEAST_RUNS 3

/* Predicted cycles for a second of sound; 0: there is no plan, as a render will tell. */
static double work(const struct accuracy_sweep *s, const struct accuracy *set)
{
    struct scene scene = s->scene;
    struct arena *a = arena_open();
    struct err none = {0};
    double sum = 0;
    scene.accuracy = *set;
    struct render_parts p = render_parts_make(&scene, a);
    bool ok = render_parts_plan(&p, &none);
    for (int i = 0; ok && i < scene.n_contacts; i++)
        for (const struct plan_row *r = p.parts[i].plan.rows, *end = r + p.parts[i].plan.n; r < end; r++)
            sum += r->verdict == PLAN_RUNS ? r->work * scene.output.sample_rate : 0;
    arena_close(a);
    return sum;
}

static bool is_cut(const struct contact *c)
{
    return c->contact.model != CONTACT_STRIKE && c->contact.model != CONTACT_GIVEN;
}

/* Sets s->excerpt, s->estimate, and both scenes' motions. */
static void excerpt(struct accuracy_sweep *s)
{
    struct accuracy set = s->scene.accuracy;
    struct plan_scene_estimate x;
    struct err none = {0};
    double w[PRESETS], finest, each, least = SHORTEST;
    bool some = false, falls = false;
    for (int i = 0; i < PRESETS; i++) {
        accuracy_preset(&set, keys_presets[i]);
        w[i] = work(s, &set) / HERTZ;
    }
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k) accuracy_turn(&set, (enum knob)k, steps(k) ? keys_knobs[k].high : keys_knobs[k].low);
    finest = work(s, &set) / HERTZ;
    struct scene scene = s->scene;
    scene.accuracy = set;
    bool full = !plan_scene_estimate(&scene, s->call->arena, &x, &none) &&
                plan_scene_estimate(&s->scene, s->call->arena, &x, &(struct err){0});
    if (full && !args_given(&s->call->args, "errors"))
        memcpy(s->errors, (const double[]){-40, -70, -100}, (size_t)(s->n_errors = 3) * sizeof *s->errors);
    for (int i = 0; i < s->scene.n_contacts; i++)
        falls = falls || s->scene.contacts[i].load.falls; /* and bounces: no error can be had */
    int asks = falls ? 0 : s->n_errors;
    each = 1.5 * w[3] + s->runs * (w[0] + w[1] + w[2]) + (asks ? 2 * w[3] + 1.3 * finest : 0);
    for (int i = 0; i < asks; i++) {
        double at = fmax((-40 - s->errors[i]) / 30, 0), from = at < 1 ? w[0] : w[1], to = at < 1 ? w[1] : w[2];
        each += s->runs * from * (from > 0 ? real_pow(to / from, at < 1 ? at : at - 1) : 0);
    }
    double length = plan_scene_estimate(&s->scene, s->call->arena, &x, &(struct err){0})
                        ? (double)x.length.motion / s->scene.output.sample_rate
                        : NAN;
    struct contact *c = ARENA_TAKE(s->call->arena, struct contact, s->scene.n_contacts);
    for (int i = 0; i < s->scene.n_contacts; i++) {
        c[i] = s->scene.contacts[i];
        some = some || is_cut(&c[i]);
        least = fmax(least, 2 * (fmax(c[i].load.approach, 0) + fmax(c[i].load.release, 0)));
    }
    s->whole = length;
    if (!(s->excerpt > 0)) {
        double digit = real_exp10(floor(real_log10(BUDGET / each)) - 1);
        s->excerpt = full ? least : fmax(floor(BUDGET / each / digit) * digit, least);
        if (!(s->excerpt < NEARLY_WHOLE * length)) s->excerpt = NAN;
    }
    if (!some || !(s->excerpt < length)) s->excerpt = NAN;
    for (int i = 0; s->excerpt > 0 && i < s->scene.n_contacts; i++)
        if (is_cut(&c[i])) c[i].motion.until = motion_cut(&c[i].motion, s->excerpt);
    s->scene.contacts = s->asked.contacts = c;
    s->estimate = each * (s->excerpt > 0 ? s->excerpt : fmax(length, 0)) + STARTING * s->runs * (s->n_errors + PRESETS);
}

/* ------------------------------------------------------------------ what is rendered

   The knobs that are chosen for each asked error, the presets, and the scene as it is; where single knobs are asked
   for, each knob's values, once with all other knobs at `reference` (what it spoils alone) and once as the scene has
   them (what it costs). Knobs that turn nothing are left as they are, so that settings which differ in those are one.

   All are compared with a reference: every knob as the preset reference has it, or twice as fine as the finest that an
   asked error takes. Its own error is bounded by its difference from a neighbour of half its fineness: an error that
   falls by 6 dB or more for each doubling is no more than that. */

static bool same(const struct accuracy_sweep *s, const struct accuracy *x, const struct accuracy *y)
{
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k && accuracy_knob(x, (enum knob)k) != accuracy_knob(y, (enum knob)k)) return false;
    return true;
}

static int render_new(struct accuracy_sweep *s, const struct accuracy *set)
{
    s->renders[s->n_renders] = (struct accuracy_render){.set = *set, .contact_share = NAN};
    return s->n_renders++;
}

static int render_of(struct accuracy_sweep *s, const struct accuracy *set, bool timed)
{
    int i = 0;
    while (i < s->n_renders && (s->renders[i].words || !same(s, &s->renders[i].set, set)))
        i++;
    if (i == s->n_renders) render_new(s, set);
    s->renders[i].timed |= timed;
    return i;
}

static struct accuracy_row *row_add(struct accuracy_sweep *s, int knob, const char *name, const char *value)
{
    struct accuracy_row *r = &s->rows[s->n_rows++];
    *r = (struct accuracy_row){.knob = knob,
                               .name = name,
                               .value = value,
                               .alone = -1,
                               .fine = NAN,
                               .order = NAN,
                               .predicted = NAN,
                               .choosing = NAN};
    return r;
}

/* A row whose knobs are those of an accuracy, chosen if it asks for an error: one that cannot be had is refused. */
static bool row_settle(struct accuracy_sweep *s, const char *name, const char *value, const struct accuracy *set,
                       struct err *e)
{
    struct accuracy_row *r = row_add(s, -1, name, value);
    struct scene asked = s->asked, chosen;
    struct error_budget budget;
    struct err refused = {0};
    struct arena *a = arena_open();
    double start = stopwatch_cpu();
    asked.accuracy = *set;
    bool ok = error_budget_apply(&asked, a, &chosen, &budget, &refused);
    if (!isnan(set->error)) r->choosing = stopwatch_cpu() - start;
    r->set = chosen.accuracy;
    if (ok && budget.chosen) r->predicted = budget.predicted;
    if (!ok) r->refused = arena_text(s->call->arena, refused.text);
    arena_close(a);
    return ok || refused.kind == ERR_SCENE || err_set(e, refused.kind, "%s", refused.text);
}

/* Finer errors than one that is refused are, too. */
static bool ask_all(struct accuracy_sweep *s, struct err *e)
{
    struct pool_progress p;
    bool ok = true;
    pool_progress_begin(&p, s->n_errors, 0, false);
    if (p.shown)
        fprintf(stderr, "%s: about %.0f s: %d asked errors, %d presets, %d runs%s\n", s->file, ceil(s->estimate),
                s->n_errors, PRESETS, s->runs,
                s->excerpt > 0 ? arena_format(s->call->arena, "; of its first %.3g s (--excerpt)", s->excerpt) : "");
    for (int i = 0; ok && i < s->n_errors; i++) {
        struct accuracy set = {.preset = s->scene.accuracy.preset, .error = s->errors[i]};
        const char *value = arena_format(s->call->arena, "%.9g", s->errors[i]);
        const struct accuracy_row *before = i > 0 ? &s->rows[i - 1] : NULL;
        if (before && before->refused)
            row_add(s, -1, "asked", value)->refused = before->refused;
        else
            ok = row_settle(s, "asked", value, &set, e);
        pool_progress_step(&p, arena_format(s->call->arena, "knobs for %s dB", value), 0, 0, 0);
    }
    pool_progress_clear(&p);
    return ok;
}

void accuracy_finer(struct accuracy *reference, const struct accuracy *own, unsigned used)
{
    for (int k = 0; k < KNOBS; k++) {
        double x = accuracy_knob(own, (enum knob)k), y = accuracy_knob(reference, (enum knob)k),
               finer = steps(k) ? fmin(2 * x, keys_knobs[k].high) : fmax(floor(x / 2), keys_knobs[k].low),
               z = used & 1u << k ? finer : x;
        accuracy_turn(reference, (enum knob)k, steps(k) ? fmax(z, y) : fmin(z, y));
    }
}

/* The reference and its neighbour, which are rendered first. */
static void reference_rows(struct accuracy_sweep *s, const struct accuracy *reference)
{
    struct accuracy near = *reference;
    for (int k = 0; k < KNOBS; k++) {
        double x = accuracy_knob(reference, (enum knob)k);
        if (s->knobs & 1u << k)
            accuracy_turn(&near, (enum knob)k,
                          steps(k) ? fmax(floor(x / 2), keys_knobs[k].low) : fmin(2 * x, keys_knobs[k].high));
    }
    s->reference = render_new(s, reference);
    s->near = render_new(s, &near);
}

static void knob_rows(struct accuracy_sweep *s, int k, const struct accuracy_values *own)
{
    double x[PRESETS + ACCURACY_VALUES], sign = steps(k) ? 1.0 : -1.0;
    int n = 0;
    for (int i = 0; i < PRESETS + own->n; i++) { /* presets' values and those given, coarse to fine, each once */
        double v = i < PRESETS ? keys_knobs[k].preset[i] : own->x[i - PRESETS];
        int at = 0;
        while (at < n && sign * x[at] < sign * v)
            at++;
        if (at < n && x[at] == v) continue;
        memmove(x + at + 1, x + at, (size_t)(n++ - at) * sizeof *x);
        x[at] = v;
    }
    for (int i = 0; i < n; i++) {
        struct accuracy alone = s->renders[s->reference].set, all = s->scene.accuracy;
        struct accuracy_row *r = row_add(s, k, keys_knobs[k].name, arena_format(s->call->arena, "%.9g", x[i]));
        accuracy_turn(&alone, (enum knob)k, x[i]);
        accuracy_turn(&all, (enum knob)k, x[i]);
        r->alone = render_of(s, &alone, false);
        r->total = render_of(s, &all, true);
        r->chosen = x[i] == accuracy_knob(&s->scene.accuracy, (enum knob)k);
        r->fine = sign * real_log(x[i]) / real_log(2.0);
    }
}

bool accuracy_rows(struct accuracy_sweep *s, const struct accuracy_values *own, struct err *e)
{
    int most = s->n_errors + PRESETS + 1;
    for (int k = 0; k < KNOBS; k++)
        most += PRESETS + own[k].n;
    s->rows = ARENA_TAKE(s->call->arena, struct accuracy_row, most);
    s->renders = ARENA_TAKE(s->call->arena, struct accuracy_render, 2 * most + 2);
    if (!ask_all(s, e)) return false;
    struct accuracy reference = s->scene.accuracy, set;
    accuracy_preset(&reference, "reference");
    for (int i = 0; i < s->n_rows; i++)
        if (!s->rows[i].refused) accuracy_finer(&reference, &s->rows[i].set, s->knobs);
    struct scene finest = s->scene;
    finest.accuracy = reference;
    if (s->n_errors &&
        !plan_scene_estimate(&finest, s->call->arena, &(struct plan_scene_estimate){0}, &(struct err){0}))
        accuracy_preset(&reference, "reference"); /* it takes too much memory */
    reference_rows(s, &reference);
    for (int i = 0; keys_presets[i]; i++) {
        set = (struct accuracy){.error = NAN};
        accuracy_preset(&set, keys_presets[i]);
        if (!row_settle(s, "preset", keys_presets[i], &set, e)) return false;
    }
    bool met = false;
    for (int i = 0; i < s->n_rows; i++)
        met = met || (!s->rows[i].refused && same(s, &s->rows[i].set, &s->scene.accuracy));
    if (!met && !row_settle(s, "scene", "", &s->asked.accuracy, e)) return false;
    for (int i = 0; i < s->n_rows; i++) {
        struct accuracy_row *r = &s->rows[i];
        bool again = r->refused && i > 0 && r->refused == r[-1].refused;
        r->total = again        ? r[-1].total
                   : r->refused ? render_new(s, &(struct accuracy){0})
                                : render_of(s, &r->set, true);
        r->chosen = !r->refused && same(s, &r->set, &s->scene.accuracy);
        if (!r->refused || again) continue;
        s->renders[r->total].code = ERR_SCENE;
        s->renders[r->total].words = r->refused;
    }
    for (int k = 0; k < KNOBS && s->single; k++)
        if (s->knobs & 1u << k) knob_rows(s, k, &own[k]);
    return true;
}

const char *accuracy_rows_name(const struct accuracy_sweep *s, int render)
{
    for (int i = 0; i < s->n_rows; i++) {
        const struct accuracy_row *r = &s->rows[i];
        if (r->total == render || r->alone == render)
            return arena_format(s->call->arena, "%s%s%s%s", r->name, *r->value ? " " : "", r->value,
                                r->total == render ? "" : ", else reference");
    }
    return render == s->near ? "the reference half as fine" : "the reference";
}

/* What the errors of a sweep say: the order with which each knob's own error falls between neighbours, with all other
   knobs at `reference`, and which settings are worth their time. Of a sound that diverges, two renders which are
   equally right differ by as much as the reference and its neighbour: a distance below that is no merit. */

#define OCTAVE_DB 6.020599913279624 /* 20 log10 2 */

static const struct accuracy_render *alone(const struct accuracy_sweep *s, const struct accuracy_row *r)
{
    return r->alone >= 0 && s->renders[r->alone].code == 0 ? &s->renders[r->alone] : NULL;
}

/* The median of n, and of its order statistics those two the farthest in between which it lies with 93 % or more (of
   less than 5: the least and the greatest). Rises. Returns the probability (binomial, p = 1/2). */
static double median_interval(int n, double *x, double out[3])
{
    double term = real_exp10(-n * real_log10(2.0)), sum = term;
    int k = 0;
    gsl_sort(x, 1, (size_t)n);
    for (; 2 * (sum + term * (n - k) / (k + 1)) <= 0.07; k++)
        sum += term *= (double)(n - k) / (k + 1);
    out[0] = x[k];
    out[1] = 0.5 * (x[(n - 1) / 2] + x[n / 2]);
    out[2] = x[n - 1 - k];
    return 1 - 2 * sum;
}

double accuracy_judge_error(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    if (r->code != 0) return NAN;
    return isfinite(s->until) ? fmax(r->error.spectral, s->renders[s->near].error.spectral) : -r->error.snr;
}

bool accuracy_judge_below(const struct accuracy_sweep *s, const struct accuracy_render *r)
{
    return r->code == 0 && isfinite(r->error.snr) && r->error.snr > s->own_db;
}

void accuracy_judge(struct accuracy_sweep *s)
{
    for (int i = 1; i < s->n_rows; i++) {
        const struct accuracy_row *before = &s->rows[i - 1], *r = &s->rows[i];
        const struct accuracy_render *reference = &s->renders[s->reference], *x = alone(s, before), *y = alone(s, r);
        if (r->knob < 0 || !x || !y || before->knob != r->knob || y == reference || x == reference) continue;
        double fine[2] = {before->fine, r->fine}, error[2] = {-x->error.snr / OCTAVE_DB, -y->error.snr / OCTAVE_DB};
        s->rows[i].order = convergence_slope(fine, error);
    }
    s->own_db = isfinite(s->until) ? INFINITY : s->renders[s->near].error.snr;
    int n = s->n_renders;
    double *from = ARENA_TAKE(s->call->arena, double, 3 * n), *to = from + n, *error = to + n;
    bool *on = ARENA_TAKE(s->call->arena, bool, n);
    for (int i = 0; i < n; i++) {
        struct accuracy_render *r = &s->renders[i];
        if (r->n_runs) r->covers = median_interval(r->n_runs, r->runs, r->cpu);
        from[i] = r->timed && r->n_runs ? r->cpu[0] : NAN;
        to[i] = r->cpu[2];
        error[i] = accuracy_judge_error(s, r);
    }
    convergence_front(n, from, to, error, 0.1, on); /* dB: an ear by far does not tell them apart */
    for (int i = 0; i < s->n_renders; i++)
        s->renders[i].front = on[i];
}

/* ------------------------------------------------------------------ the command */

static const struct args_option accuracy_options[] = {
    {"errors", 'e', "DB,DB...", false, "the errors that are asked for (-40,-60,-80,-100,-120)"},
    {"excerpt", 0, "TIME", false,
     "how much of each motion is rendered (as much as takes some 10 s in all, by the work that plans predict); more "
     "than it lasts: all of it"},
    {"knobs", 'k', NULL, false, "single knobs, too: each with the values of the presets"},
    {"values", 0, "KNOB=N,N...", true, "--knobs, with further values, as in oversampling=2,16; may be repeated"},
    {"runs", 'n', "N", false,
     "how often each setting is rendered for its CPU time, in turns (5; 3 where they take long)"},
    {"csv", 0, "FILE", false, "write the table to FILE, which ends in .csv"},
    {"plot", 0, "FILE", false, "draw error against CPU time into FILE, which ends in .png or .svg"},
    {"json", 0, NULL, false, "print the table as JSON"},
    {"force", 'f', NULL, false, "replaces the files of --csv and --plot if they exist"},
    CMD_SCENE_OPTIONS,
    {0},
};

/* ------------------------------------------------------------------ asking */

bool accuracy_silent(const struct scene *s)
{
    for (int i = 0; i < s->n_contacts; i++)
        if (s->contacts[i].gain != 0 && response_audible(&s->contacts[i], &s->output)) return false;
    return true;
}

static bool ask_scene(struct accuracy_sweep *s, struct err *e)
{
    struct accuracy_values own[KNOBS] = {{0}};
    int n;
    const char **given = args_values(&s->call->args, "values", &n);
    for (int k = 0; k < KNOBS; k++)
        own[k].x = ARENA_TAKE(s->call->arena, double, ACCURACY_VALUES);
    for (int i = 0; i < n; i++)
        if (!values_one(given[i], s->call->arena, own, e)) return false;
    if (!errors_read(s, e) || !cmd_read_scene(s->call, s->file, &s->asked, e)) return false;
    if (!error_budget_apply(&s->asked, s->call->arena, &s->scene, NULL, e)) return scene_places_report(&s->asked, e);
    s->scene.contacts = s->asked.contacts; /* engines are chosen for each setting */
    s->force = accuracy_silent(&s->scene);
    if (s->force) s->scene.output.quantity = s->asked.output.quantity = QUANTITY_FORCE;
    const char *paths[] = {s->csv, s->plot};
    for (int i = 0; i < 2; i++) { /* what is written must not be what is read; and can it be written? */
        enum output_kind kind = OUTPUT_TABLE;
        struct outputs o = {.scene = &s->scene, .base = "", .paths = &paths[i], .kinds = &kind, .n = 1};
        struct outfile probe;
        if (!paths[i]) continue;
        if (!outputs_check_overwrite(&o, 1, s->call->arena, &(struct err){0}))
            return err_set(e, ERR_CREATE, "%s is a file that the scene reads: give --%s another name", paths[i],
                           i ? "plot" : "csv");
        bool force = args_given(&s->call->args, "force");
        bool may = i ? mark_permits(paths[i], NULL, force, e) : mark_absent(paths[i], force, e);
        if (!may || !outfile_open_fd(&probe, paths[i], e)) return false;
        outfile_drop(&probe);
    }
    if (!plan_scene_knobs(&s->scene, s->call->arena, &s->knobs, e)) return scene_places_report(&s->scene, e);
    for (int k = 0; k < KNOBS; k++)
        if (own[k].n > 0 && !(s->knobs & 1u << k))
            return err_set(e, ERR_USAGE,
                           "--values: no stage of this scene depends on %s; rasp plan lists the knobs of each",
                           keys_knobs[k].name);
    excerpt(s);
    struct scene part;
    if (s->excerpt > 0) { /* as each row's */
        if (!error_budget_apply(&s->asked, s->call->arena, &part, NULL, e)) return scene_places_report(&s->asked, e);
        s->scene.accuracy = part.accuracy;
    }
    return accuracy_rows(s, own, e) || scene_places_report(&s->asked, e);
}

/* ------------------------------------------------------------------ doing */

/* Each setting once more, from one run to another: runs of one setting lie apart, so that what slows the machine for a
   while slows one run of each. The reference has the first alone. */
static bool passes(struct accuracy_sweep *s, int from, int to, struct err *e)
{
    struct pool_progress p;
    double *w = ARENA_TAKE(s->call->arena, double, s->n_renders), all = 0;
    int n = 0;
    bool ok = true;
    for (int i = 0; i < s->n_renders; i++) {
        struct accuracy_render *r = &s->renders[i];
        bool again = r->timed && i != s->reference;
        r->ahead = r->code != 0 ? 0 : again || from == 0 ? to - from : 0;
        w[i] = from > 0 && r->n_runs ? r->runs[0] : 1;
        all += r->ahead * w[i];
        n += r->ahead;
    }
    pool_progress_begin(&p, n, all, false);
    for (int run = from; ok && run < to; run++)
        for (int i = 0; ok && i < s->n_renders; i++) {
            struct accuracy_render *r = &s->renders[i];
            if (!r->ahead) continue;
            r->tried = true;
            ok = accuracy_child(s, i, e) && (run > 0 || r->code != 0 || accuracy_child_compare(s, i, e));
            pool_progress_step(&p, accuracy_rows_name(s, i), w[i], 0, s->length);
        }
    pool_progress_clear(&p);
    return ok;
}

/* How often times are taken follows from what they are, where nobody says it; all else is the same everywhere. */
static bool sweep(struct accuracy_sweep *s, struct err *e)
{
    double spent = 0, pass = 1e-9;
    if (!passes(s, 0, 1, e)) return false;
    for (int i = 0; i < s->n_rows; i++)
        spent += isnan(s->rows[i].choosing) ? 0 : s->rows[i].choosing;
    for (int i = 0; i < s->n_renders; i++) {
        const struct accuracy_render *r = &s->renders[i];
        spent += r->n_runs ? r->runs[0] : 0;
        pass += r->n_runs && r->timed && i != s->reference ? r->runs[0] : 0;
    }
    if (!args_given(&s->call->args, "runs"))
        s->runs = (int)fmax(fmin((LONGEST - spent) / pass + 1, s->runs), LEAST_RUNS);
    return passes(s, 1, s->runs, e);
}

static int accuracy_run(struct cmd_call *c, struct err *e)
{
    const struct args *g = &c->args;
    struct accuracy_sweep s = {.call = c,
                               .file = g->operands[0],
                               .until = INFINITY,
                               .json = args_given(g, "json"),
                               .single = args_given(g, "knobs") || args_given(g, "values"),
                               .excerpt = NAN,
                               .csv = args_value(g, "csv"),
                               .plot = args_value(g, "plot")};
    long runs = 5;
    if (!args_whole(g, "runs", (const long[2]){1, 1000}, &runs, e)) return (int)e->kind;
    s.runs = (int)runs;
    if (!cmd_quantity(c, "excerpt", KEY_TIME, &s.excerpt, e)) return (int)e->kind;
    if (s.excerpt <= 1e-3)
        err_set(e, ERR_USAGE, "--excerpt: it must be longer than 1 ms");
    else if (s.csv && !text_ends(s.csv, ".csv"))
        err_set(e, ERR_USAGE, "--csv %s: must end in .csv", s.csv);
    else if (s.plot && !text_ends(s.plot, ".png") && !text_ends(s.plot, ".svg"))
        err_set(e, ERR_USAGE, "--plot %s: must end in .png or .svg", s.plot);
    if (e->kind || !ask_scene(&s, e) || !accuracy_child_folder(&s, e)) return (int)e->kind;
    bool ok = sweep(&s, e);
    accuracy_child_end(&s);
    if (!ok) return (int)e->kind;
    accuracy_judge(&s);
    struct outfile files[2]; /* all that can fail is done before the first gets its name */
    int n = 0;
    if (s.plot && gnuplot_draw(&files[n], s.plot, text_ends(s.plot, ".svg"), accuracy_report_plot, &s, e)) n++;
    if (s.csv && e->kind == ERR_NONE && outfile_open(&files[n], s.csv, e)) accuracy_report_table(&s, files[n++].stream);
    outfile_commit_all(files, n, e);
    if (e->kind == ERR_NONE) accuracy_report(&s, e);
    return (int)e->kind;
}

const struct command accuracy_command = {
    .name = "accuracy",
    .summary = "shows what accuracy costs: time against error",
    .does =
        "Chooses the knobs for errors from -40 to -120 dB (accuracy.error), and renders the scene with each of them "
        "and with each preset. For each it prints what error was asked, predicted and measured, and which knobs that "
        "takes. It prints what it costs, too: time to choose, CPU time of the render as a median with an interval, "
        "times real time, and peak memory.\n"
        "Errors are measured against a reference finer than all of these, whose own error is bounded. Smaller ones "
        "are marked with <. An error that cannot be had is a row that says why. A row marked with * is one that "
        "nothing else beats in both error and CPU time, where intervals tell.\n"
        "Of a long or dear scene an excerpt is measured (motion.until), as the first lines say. With --knobs single "
        "knobs are rendered, too: alone, with all others at reference, and in all, with all others as the scene has "
        "them.\n"
        "Where two renders diverge, as of a ball that bounces, the command says from when on, and compares third "
        "octaves, spectra and levels of what comes after. A scene without a sound is compared by its contact force. "
        "Each render is a process of its own, one at a time, in a temporary folder.",
    .operands = "SCENE",
    .least = 1,
    .most = 1,
    .options = accuracy_options,
    .examples = "rasp accuracy scenes/forces_only.yaml\n"
                "rasp accuracy scenes/basswood_scrape.yaml --errors=-40,-70 --csv cost.csv --plot cost.png\n"
                "rasp accuracy scenes/strike.yaml --values oversampling=2,16 --runs 1 --json\n",
    .run = accuracy_run,
};
