/* The operand of `rasp analyse`: a force as WAV, NPY or a table (time_s and a column), or a table of impacts (time_s,
   amplitude_n and maybe duration_s: what output.impacts writes). A table is CSV, or NPY with named fields. NPY is known
   by its content, CSV by its name. */
#include "cmd/analyse.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "analysis/distribution_fit.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "file/bytes.h"
#include "file/csv.h"
#include "file/heightfile_formats.h"
#include "file/npy.h"
#include "file/wav.h"
#include "force/impact_series.h"
#include "num/real.h"
#include "output/mark.h"

#define MOST 1e50

/* ------------------------------------------------------------------ samples */

static bool wav_take(struct analyse_source *s, const struct analyse_given *g, struct arena *a, struct err *e)
{
    struct wav w;
    if (!wav_read(s->file, a, &w, e)) return false;
    if (g->channel > w.channels)
        return err_set(e, ERR_USAGE, "--channel: %s has %d channel%s", s->file, w.channels, w.channels == 1 ? "" : "s");
    if (isnan(g->scale))
        return err_set(e, ERR_USAGE, "--scale must be given: %s does not say how many newtons its %s stands for",
                       s->file, w.bits ? "full scale" : "unit");
    s->channels = w.channels;
    double *force = ARENA_TAKE(a, double, w.frames);
    for (size_t i = 0; i < w.frames; i++)
        force[i] = g->scale * w.x[i * (size_t)w.channels + (size_t)g->channel - 1];
    s->signal = (struct impact_signal){force, (long)w.frames, w.rate, 0};
    return true;
}

static bool npy_take(struct analyse_source *s, const struct bytes *b, const struct analyse_given *g, struct arena *a,
                     struct err *e)
{
    struct heightfile h;
    if (!heightfile_formats_npy_read(s->file, b, a, &h, e)) return false;
    if (h.rows > 1)
        return err_set(e, ERR_SCENE, "%s: an array of %zu x %zu; a force has one dimension", s->file, h.rows,
                       h.columns);
    if (isnan(g->rate))
        return err_set(e, ERR_USAGE, "--rate must be given: %s does not say how many samples a second has", s->file);
    for (size_t i = 0; i < h.columns; i++) {
        if (!isfinite(h.z[i])) return err_set(e, ERR_SCENE, "%s: element %zu is not a finite number", s->file, i);
        h.z[i] *= (isnan(g->scale) ? 1 : g->scale);
    }
    s->signal = (struct impact_signal){h.z, (long)h.columns, g->rate, 0};
    return true;
}

/* ------------------------------------------------------------------ tables */

static bool column_take(const struct csv *t, const char *name, struct arena *a, double **x, struct err *e)
{
    int column = csv_column(t, name);
    if (column < 0) return err_set(e, ERR_SCENE, "%s: there is no column '%s'", t->file, name);
    *x = ARENA_TAKE(a, double, t->rows + 1);
    for (size_t i = 0; i < t->rows; i++)
        if (!csv_number(t, i, column, &(*x)[i], e)) return false;
    return true;
}

static bool times_take(const struct csv *t, struct arena *a, double **time, struct err *e)
{
    if (!column_take(t, "time_s", a, time, e)) return false;
    if (t->rows < 2)
        return err_set(e, ERR_SCENE, "%s: %zu row%s; at least 2 are needed%s", t->file, t->rows,
                       t->rows == 1 ? "" : "s",
                       csv_column(t, "amplitude_n") < 0
                           ? ""
                           : arena_format(a, ", and %d for statistics, --output and --plot", STATISTICS_LEAST));
    for (size_t i = 1; i < t->rows; i++)
        if (!((*time)[i] > (*time)[i - 1]))
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'time_s': %.9g s comes after %.9g s; times must rise from row to row",
                           t->file, t->lines[i], (*time)[i], (*time)[i - 1]);
    return true;
}

/* Impacts are taken to stand alone: their durations are what made them, not what was seen of them. */
static bool impacts_take(struct analyse_source *s, const struct csv *t, struct arena *a, struct err *e)
{
    struct impact_events *v = &s->found.events;
    bool lasts = csv_column(t, "duration_s") >= 0;
    if (!times_take(t, a, &v->time, e) || !column_take(t, "amplitude_n", a, &v->amplitude, e) ||
        (lasts && !column_take(t, "duration_s", a, &v->duration, e)))
        return false;
    v->n = (int)t->rows;
    v->alone = ARENA_TAKE(a, bool, v->n);
    if (!lasts) v->duration = ARENA_TAKE(a, double, v->n);
    for (int i = 0; i < v->n; i++) {
        v->alone[i] = lasts;
        if (!lasts)
            v->duration[i] = NAN;
        else if (!(v->duration[i] > 0))
            return err_set(e, ERR_SCENE, "%s:%d: column 'duration_s': %.9g s; an impact lasts longer than 0", s->file,
                           t->lines[i], v->duration[i]);
        s->found.touching += lasts && i > 0 &&
                             impact_series_overlap(v->time[i] - v->time[i - 1], v->duration[i - 1], v->duration[i],
                                                   impact_events_grain(v));
    }
    return true;
}

/* Rows must follow each other evenly: within 1 % of a row. Reported is the first row whose step is not the usual one,
   or, where steps change little by little, the one that drifted. */
static bool evenly(const struct csv *t, const double *time, struct arena *a, struct err *e)
{
    size_t n = t->rows - 1, drifted = 1, bad = 1;
    double step = (time[n] - time[0]) / (double)n, *steps = ARENA_TAKE(a, double, n);
    while (drifted <= n &&
           fabs(time[drifted] - time[0] - step * (double)drifted) <= 0.01 * step + 1e-9 * fabs(time[drifted]))
        drifted++;
    if (drifted > n) return true;
    for (size_t i = 0; i < n; i++)
        steps[i] = time[i + 1] - time[i];
    gsl_sort(steps, 1, n);
    step = gsl_stats_median_from_sorted_data(steps, 1, n);
    while (bad <= n && fabs(time[bad] - time[bad - 1] - step) <= 0.01 * step + 2e-9 * fabs(time[bad]))
        bad++;
    if (bad > n) bad = drifted;
    return err_set(e, ERR_SCENE,
                   "%s:%d: rows are not evenly spaced: %.9g s comes %.6g s after the row before, where most come after "
                   "%.6g s. A force is read at one rate (a table of impacts has the column amplitude_n)",
                   t->file, t->lines[bad], time[bad], time[bad] - time[bad - 1], step);
}

static bool force_take(struct analyse_source *s, const struct csv *t, const struct analyse_given *g, struct arena *a,
                       struct err *e)
{
    const char *column = g->column ? g->column : csv_column(t, "force_n") >= 0 ? "force_n" : "force_mean_n";
    double *time, *force;
    if (!g->column && csv_column(t, column) < 0)
        return err_set(e, ERR_SCENE,
                       "%s: there is neither a column force_n nor force_mean_n (a force: --column names another), nor "
                       "amplitude_n (impacts)",
                       s->file);
    if (!times_take(t, a, &time, e) || !column_take(t, column, a, &force, e) || !evenly(t, time, a, e)) return false;
    for (size_t i = 0; i < t->rows; i++)
        force[i] *= (isnan(g->scale) ? 1 : g->scale);
    s->signal =
        (struct impact_signal){force, (long)t->rows, (double)(t->rows - 1) / (time[t->rows - 1] - time[0]), time[0]};
    return true;
}

static bool table_take(struct analyse_source *s, const struct analyse_given *g, struct arena *a, struct err *e)
{
    struct arena *scratch = arena_open();
    struct csv t;
    bool ok = csv_table_read(s->file, scratch, &t, e);
    if (ok) {
        s->has_force = csv_column(&t, "amplitude_n") < 0 || (g->column && csv_column(&t, g->column) >= 0);
        ok = s->has_force ? force_take(s, &t, g, a, e) : impacts_take(s, &t, a, e);
    }
    arena_close(scratch);
    return ok;
}

/* ------------------------------------------------------------------ all */

/* Powers of what is read are taken: none may leave a double's range. 0 is no fault. */
static bool in_range(const struct analyse_source *s, const char *what, double x, const char *unit, struct err *e)
{
    return x == 0 || (x >= 1 / MOST && x <= MOST) ||
           err_set(e, ERR_SCENE, "%s: %s of %.6g %s lies outside %g to %g; is the unit right?", s->file, what, x, unit,
                   1 / MOST, MOST);
}

bool analyse_read(const char *file, const struct analyse_given *g, struct arena *a, struct analyse_source *s,
                  struct err *e)
{
    *s = (struct analyse_source){.file = file, .kind = "CSV", .has_force = true};
    if (text_ends_in(file, ".csv"))
        table_take(s, g, a, e);
    else {
        struct arena *scratch = arena_open();
        struct bytes b;
        struct npy head = {0};
        bool ok = bytes_read(file, scratch, &b, e), npy = ok && npy_is(&b);
        s->kind = npy ? "NPY" : "WAV";
        ok = ok && (!npy || npy_read(file, &b, scratch, &head, e));
        ok = ok && (!npy ? wav_take(s, g, a, e) : head.n_fields ? table_take(s, g, a, e) : npy_take(s, &b, g, a, e));
        arena_close(scratch);
    }
    if (e->kind) return false;
    if (s->has_force && !impact_find(&s->signal, &g->options, a, &s->found, e)) return err_at(e, "%s", file);
    const struct impact_events *v = &s->found.events;
    double amplitude = 0, least = HUGE_VAL, longest = 0;
    for (int i = 0; i < v->n; i++) {
        amplitude = fmax(amplitude, fabs(v->amplitude[i]));
        longest = fmax(longest, v->duration[i]); /* not of NAN */
        least = fmin(least, v->duration[i]);
    }
    return in_range(s, "an amplitude", amplitude, "N", e) && in_range(s, "a duration", longest, "s", e) &&
           (longest == 0 || in_range(s, "a duration", least, "s", e)) &&
           in_range(s, "a time", fmax(fabs(v->time[0]), fabs(v->time[v->n - 1])), "s", e) &&
           in_range(s, "a time from first to last", v->time[v->n - 1] - v->time[0], "s", e);
}

/* What makes the estimates of `rasp analyse` doubtful. */

static void __attribute__((format(printf, 2, 3))) note(struct analysis *a, const char *format, ...)
{
    char text[600];
    va_list list;
    if (a->n_notes == ANALYSE_NOTES) return;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    a->notes[a->n_notes++] = arena_text(a->arena, text);
}

const char *analyse_notes_unknown(const struct analysis *a)
{
    const struct impact_events *v = &a->source.found.events;
    if (a->source.has_force) return "beside no maximum does the force fall to half of it";
    return isnan(v->duration[0]) ? "there is no column duration_s" : "all amplitudes are 0";
}

/* Runs of samples, 3 and more, that stand at x. */
static int levels(const struct impact_signal *s, double x)
{
    int runs = 0, length = 0;
    for (long i = 0; i < s->n; i++) {
        length = s->force[i] == x ? length + 1 : 0;
        runs += length == 3;
    }
    return runs;
}

/* Of a force, of an impact that outweighs all others (in squares), of the fitted shapes, of the series. */
static void notes_force(struct analysis *a, const struct analyse_source *s)
{
    const struct impact_found *f = &s->found;
    const struct impact_events *v = &f->events;
    double n = v->n, samples = 0, known = 0;
    if (!a->given.options.both && f->least < -0.3 * f->greatest)
        note(a, "%s: the force falls to %.4g N: only impacts above 0 are looked for unless --signed is given", s->file,
             f->least);
    for (int i = 0; i < v->n; i++)
        if (!isnan(v->duration[i])) {
            samples += real_log(v->duration[i] * s->signal.rate);
            known++;
        }
    if (known > 0 && real_exp(samples / known) < 6)
        note(a,
             "%s: impacts last %.2g samples: the low-pass of the sample rate widens them, and its ripples may "
             "count as impacts: use a higher rate, or raise --prominence to 0.25",
             s->file, real_exp(samples / known));
    if ((double)f->ripples > 10 * n)
        note(a,
             "%s: %ld maxima are left out as not prominent, against %.0f impact%s: a force that ripples "
             "without falling between, as of a contact that never parts, is no series of impacts; a lower "
             "--prominence takes the ripples",
             s->file, f->ripples, n, v->n == 1 ? "" : "s");
    if ((double)f->touching > 0.05 * n)
        note(a, "%s: %.0f %% of the impacts run into a neighbour: amplitudes and widths are those of sums", s->file,
             100 * (double)f->touching / n);
    if ((double)f->merged > 0.01 * n)
        note(a, "%s: %.1f %% of the impacts have a shoulder: two that made one maximum, and were taken as one", s->file,
             100 * (double)f->merged / n);
    /* A recording that clips stands still at its greatest value, again and again. */

    int runs = levels(&s->signal, f->greatest) + (a->given.options.both ? levels(&s->signal, f->least) : 0);
    if (runs > 1)
        note(a,
             "%s: the force stands still at its greatest value, %.4g N, %d times, as where a recording clips: "
             "how strong those impacts were is lost, and theta with it",
             s->file, f->greatest, runs);
    /* Are contact times what they seem? */

    if (f->feet == 0)
        note(a,
             "%s: no impact of 12 samples and more stands alone: contact times are taken as twice the widths "
             "at half height, as raised cosines have them",
             s->file);
    else if (f->feet < IMPACT_FEET_MANY)
        note(a,
             "%s: contact times rest on the ends of %ld impact%s: at least %d are wanted, and single merged "
             "ones may have spoilt them",
             s->file, f->feet, f->feet == 1 ? "" : "s", IMPACT_FEET_MANY);
    if (f->stretch < 1.7 || f->stretch > 2.1)
        note(a,
             "%s: contact times come out as %.3g times the widths at half height, where raised cosines have 2 "
             "and Hertz's impacts 1.82: many of those that stand alone are merged, or of another shape; zeta "
             "is as wrong as that",
             s->file, f->stretch);
}

/* rasp analyse: the impacts in a force, their statistics, and the scene part that draws impacts like them. */

const char *const analyse_series_names[STATISTICS_SERIES] = {"amplitude", "interval"};

bool analyse_tabled(const struct analysis *a, int series)
{
    const struct series_statistics *s = &a->statistics.series[series];
    return !s->flat && a->distribution != ANALYSE_GAUSSIAN &&
           (a->distribution == ANALYSE_TABLE ||
            distribution_fit_polygon_needed(s->white.gaussian_distance, a->statistics.n - 1));
}

bool analyse_one_process(const struct analysis *a) { return a->statistics.one_process >= STATISTICS_ONE_PROCESS; }

/* ------------------------------------------------------------------ duration */

static bool duration_find(struct analysis *a, struct err *e)
{
    struct impact_duration *d = &a->duration;
    *d = (struct impact_duration){.theta = NAN,
                                  .theta_error = NAN,
                                  .theta_single = NAN,
                                  .zeta_single = NAN,
                                  .r2_single = NAN,
                                  .r2_single_log = NAN};
    /* Where theta comes from, in this order: --theta; --single; the impacts of the series that stand alone. */
    if (!isnan(a->given.theta)) {
        a->theta = ANALYSE_THETA_GIVEN;
        d->theta = a->given.theta;
    } else if (a->single.file) {
        a->theta = ANALYSE_THETA_FILE;
        if (!impact_find_duration_single(&a->single.found.events, true, d))
            return err_set(e, ERR_SCENE, "%s: %ld impact%s alone; theta takes at least %d, of different amplitudes",
                           a->single.file, d->singles, d->singles == 1 ? " stands" : "s stand", IMPACT_DURATION_LEAST);
    } else if (impact_find_duration_single(&a->source.found.events, true, d))
        a->theta = ANALYSE_THETA_ALONE;
    else {
        a->theta = ANALYSE_THETA_NONE;
        d->theta = 0;
    }
    if (d->theta < -0.01 && d->theta < -2 * d->theta_error)
        note(a, "stronger impacts last longer here (theta %.3g); a scene's theta is 0 or more, and 0 is taken",
             d->theta);
    d->theta = fmax(d->theta, 0);
    a->lasts = impact_find_duration_series(&a->source.found.events, d);
    if (!a->lasts)
        note(a, "no duration is known: %s", analyse_notes_unknown(a));
    else {
        /* A law that does not hold gives way to a constant, the durations' median; so does a theta of 0, which is one,
   unless all durations are alike. A theta that was asked for stays. */

        double r2 = d->r2_log, theta = d->theta;
        bool given = a->theta == ANALYSE_THETA_GIVEN, few = d->n < IMPACT_DURATION_MANY;
        a->constant = !given && (a->theta == ANALYSE_THETA_NONE || few || (theta > 0 ? r2 < 0 : !isnan(r2)));
        if (a->constant) impact_find_duration_constant(&a->source.found.events, a->arena, d);
        const char *taken = given ? "and zeta means little" : "so the median is taken for all, and theta as 0";
        if (a->theta == ANALYSE_THETA_NONE)
            note(a, "too few impacts stand alone, or amplitudes are all alike, to tell how durations depend on them: "
                    "the median is taken for all, and theta as 0. Single impacts (--single) help, or --theta");
        else if (few)
            note(a, "the duration of only %ld of %d impacts is known, where %d tell a law, %s", d->n,
                 a->source.found.events.n, IMPACT_DURATION_MANY, taken);
        else if (a->constant && theta > 0)
            note(a, "theta %.3g does not hold here (R2 of the logarithm %.4g: a constant does better), %s", theta, r2,
                 taken);
    }
    if (a->lasts && !a->constant && d->theta > 0 && d->r2 < -0.05)
        note(a,
             "theta %.3g does not hold here (R2 %.4g: a constant duration would do better). Where outliers "
             "made it, as impacts that run into each other do, single impacts (--single) help, or --theta",
             d->theta, d->r2);
    return true;
}

/* ------------------------------------------------------------------ the command */

static bool find_options(struct cmd_call *c, struct analysis *a, struct err *e)
{
    struct analyse_given *g = &a->given;
    static const char *const words[] = {"auto", "gaussian", "table", NULL};
    static const double positive[2] = {1e-300, 1e300}, rates[2] = {1, 1e9}, share[2] = {0, 1}, quiet[2] = {1e-6, 0.1};
    *g = (struct analyse_given){.scale = NAN,
                                .rate = NAN,
                                .theta = NAN,
                                .keep_modulation = args_given(&c->args, "keep-modulation"),
                                .channel = 1,
                                .column = args_value(&c->args, "column"),
                                .options = impact_find_options};
    g->options.both = args_given(&c->args, "signed");
    return args_word(&c->args, "distribution", words, &a->distribution, e) &&
           args_number(&c->args, "scale", positive, &g->scale, e) &&
           args_number(&c->args, "rate", rates, &g->rate, e) &&
           args_number(&c->args, "theta", (const double[2]){0, 2}, &g->theta, e) &&
           args_whole(&c->args, "channel", (const long[2]){1, 1024}, &g->channel, e) &&
           args_number(&c->args, "threshold", share, &g->options.threshold, e) &&
           args_number(&c->args, "prominence", share, &g->options.prominence, e) &&
           args_number(&c->args, "silence", quiet, &g->options.quiet, e);
}

/* An option that no file has a use for is an error. */
static bool options_used(struct cmd_call *c, const struct analysis *a, struct err *e)
{
    static const char *const options[][2] = {{"rate", "NPY"},   {"channel", "WAV"},  {"column", "CSV"},
                                             {"scale", NULL},   {"threshold", NULL}, {"prominence", NULL},
                                             {"silence", NULL}, {"signed", NULL}};
    const struct analyse_source *s[2] = {&a->source, &a->single};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        bool used = !args_given(&c->args, options[i][0]); /* by a file of that kind, or, of NULL, one with a force */
        for (int k = 0; k < 2; k++)
            used = used || (s[k]->file && s[k]->has_force && (!options[i][1] || !strcmp(s[k]->kind, options[i][1])));
        if (!used)
            return err_set(e, ERR_USAGE, "--%s means nothing for %s, which is read as %s%s", options[i][0],
                           a->source.file, a->source.kind, a->source.has_force ? "" : " of impacts");
    }
    return true;
}

static bool analyse_all(struct cmd_call *c, struct analysis *a, struct err *e)
{
    if (!find_options(c, a, e) || !analyse_read(c->args.operands[0], &a->given, a->arena, &a->source, e)) return false;
    const char *single = args_value(&c->args, "single");
    if (single && args_given(&c->args, "theta")) return err_set(e, ERR_USAGE, "--single and --theta: give one of them");
    return (!single || analyse_read(single, &a->given, a->arena, &a->single, e)) && options_used(c, a, e) &&
           analyse_make(a, e);
}

bool analyse_make(struct analysis *a, struct err *e)
{
    if (a->source.has_force) notes_force(a, &a->source);
    if (a->single.file && a->single.has_force) notes_force(a, &a->single);
    const struct impact_events *v = &a->source.found.events;
    double squares = 0;
    int most = 0;
    /* A force in which one maximum, of which the threshold is a share, hides the others. */
    const struct impact_found *f = &a->source.found;
    if (f->events.n < STATISTICS_LEAST && f->low >= STATISTICS_LEAST)
        note(a,
             "%s: %ld maxima lie below the threshold, %.3g of the greatest force, %.4g N. If they are the "
             "impacts, it outweighs them all: is it one? Leave it out of the file, or lower --threshold",
             a->source.file, f->low, a->given.options.threshold,
             fmax(f->greatest, a->given.options.both ? -f->least : 0));
    for (int i = 1; i < v->n; i++)
        most = fabs(v->amplitude[i]) > fabs(v->amplitude[most]) ? i : most;
    for (int i = 0; i < v->n; i++)
        squares += i == most ? 0 : v->amplitude[i] / v->amplitude[most] * (v->amplitude[i] / v->amplitude[most]);
    if (v->n >= STATISTICS_LEAST && squares < 1)
        note(a,
             "%s: one impact, of %.4g N at %.6g s, outweighs all others together: the amplitudes' mean, "
             "deviation and filter are its own. Is it one? Leave it out of the file",
             a->source.file, v->amplitude[most], v->time[most]);
    if (!duration_find(a, e)) return false;
    if (a->source.has_force) impact_shape_make(&a->source.signal, &a->source.found, a->arena, &a->shape);
    /* Of raised cosines 1; of Hertz's impacts, to which a raised cosine is fitted, 1.1. */
    const struct impact_shape *h = &a->shape;
    if (h->fitted > 0 && (h->stretch < 0.95 || h->stretch > 1.15))
        note(a,
             "fitted raised cosines last %.3g times the contact times, where it is 1 if the impacts are raised "
             "cosines and 1.1 if they are Hertz's",
             h->stretch);
    a->counted = a->source.found.events.n >= STATISTICS_LEAST;
    if (!a->counted)
        note(a, "%d impact%s: statistics of the series take at least %d, and are left out", a->source.found.events.n,
             a->source.found.events.n == 1 ? "" : "s", STATISTICS_LEAST);
    else if (impact_statistics_make(&a->source.found.events, !a->given.keep_modulation, a->arena, &a->statistics, e)) {
        for (int i = 0; i < STATISTICS_WARNINGS && a->statistics.warnings[i]; i++)
            note(a, "%s", a->statistics.warnings[i]);
    } else
        return err_at(e, "%s", a->source.file);
    return true;
}

/* The report is printed even where a file cannot be written. */
static int analyse_run(struct cmd_call *c, struct err *e)
{
    struct analysis *a = ARENA_TAKE(c->arena, struct analysis, 1);
    const char *output = args_value(&c->args, "output");
    static const char *const formats[] = {"png", "svg"};
    int svg = 0;
    a->arena = c->arena;
    a->force = args_given(&c->args, "force");
    if (!cmd_either(c, "format", formats, &svg, e)) return (int)e->kind;
    if (output && !text_ends(output, ".yaml"))
        return err_set(e, ERR_USAGE, "--output %s: must end in .yaml", output), (int)e->kind;
    if ((output && !mark_absent(output, a->force, e)) || !analyse_all(c, a, e)) return (int)e->kind;
    struct analyse_files *all = ARENA_TAKE(a->arena, struct analyse_files, 1);
    const char *plot = args_value(&c->args, "plot");
    if ((output || plot) && !a->counted)
        err_set(e, ERR_SCENE, "%s: %d impact%s; statistics, of which --output and --plot are made, take at least %d",
                a->source.file, a->source.found.events.n, a->source.found.events.n == 1 ? "" : "s", STATISTICS_LEAST);
    if (output && e->kind == ERR_NONE) analyse_report_part(a, output, all, e);
    if (plot && e->kind == ERR_NONE) analyse_report_plot(a, plot, svg, all, e);
    a->written = all->name;
    a->n_written = outfile_commit_all(all->o, all->n, e);
    analyse_report(a, args_given(&c->args, "json"), e);
    return (int)e->kind;
}

static const struct args_option analyse_options[] = {
    {"scale", 0, "NEWTONS", false,
     "newtons that a unit of the file stands for (full scale of a WAV of integers); a WAV needs it, else 1"},
    {"rate", 0, "HZ", false, "samples per second of an NPY"},
    {"channel", 0, "N", false, "channel of a WAV, from 1; default: 1"},
    {"column", 0, "NAME", false, "column of a CSV with the force; default: force_n, else force_mean_n"},
    {"threshold", 0, "SHARE", false, "least force of an impact, as a share of the greatest; default: 0.001"},
    {"prominence", 0, "SHARE", false,
     "how much a maximum must rise above the valleys beside it, as a share of the greatest force within 24 samples; "
     "default: 0.02"},
    {"silence", 0, "SHARE", false,
     "share of an impact's force that counts as 0: whether it stands alone; default: 0.01"},
    {"signed", 0, NULL, false, "impacts in both directions (rubbing and scratching): maxima of the force's magnitude"},
    {"single", 0, "FILE", false,
     "single impacts (a bounce train, say), from which theta is taken; read with the same options"},
    {"theta", 0, "NUMBER", false,
     "theta of zeta A^-theta; default: from --single, else from the impacts that stand alone"},
    {"keep-modulation", 0, NULL, false, "amplitudes as they are: a modulation is neither looked for nor taken out"},
    {"distribution", 0, "auto|gaussian|table", false,
     "of the whitened series in the parameter file; default: auto, a table where it is not normal"},
    {"output", 'o', "FILE.yaml", false, "writes the parameter file, and tables beside it where they are needed"},
    {"force", 'f', NULL, false, "replaces what exists of FILE.yaml, the tables beside it, and the plots"},
    {"plot", 0, "PREFIX", false,
     "draws PREFIX.correlations.png, .distributions.png, .duration.png and .shape.png; a folder: its files are called "
     "as FILE is"},
    {"format", 0, "png|svg", false, "format of the plots; default: png"},
    {"json", 'j', NULL, false, "prints the figures as one JSON object; null stands for one that is not there"},
    {0},
};

const struct command analyse_command = {
    .name = "analyse",
    .summary = "impacts in a force: their statistics, and a scene part that draws impacts like them",
    .does =
        "Finds the impacts in a force, or takes them from a table. A force is a WAV, a one-dimensional NPY, or a CSV "
        "with time_s and a column of newtons, such as diagnostics at the sample rate. A table is a CSV with time_s, "
        "amplitude_n and maybe duration_s, as output.impacts writes it.\n"
        "Prints what Conan et al. (2014, on rolling sounds) estimate of the impacts' amplitudes and of the times "
        "between them, with 95 % intervals: means, ARMA(1,1) filters, the whitened series and their distributions, "
        "whether one process drives both, and a modulation. It also prints how durations depend on amplitudes, in "
        "that paper's two steps, and which shape impacts have (raised cosine, Meixner window). Notes say what makes "
        "the estimates doubtful.\n"
        "Draws that were raised to a floor bias means (too high) and deviations (too small). They are told in a table "
        "of impacts. In a force, where weak impacts close together merge, they mostly are not. In a series of a long "
        "tail (marginal lognormal, rough) a slight modulation may be found where there is none: --keep-modulation "
        "leaves it.\n"
        "The parameter file is a scene part with contact.model impacts. A scene that includes it draws other impacts "
        "of the amplitudes, intervals and durations found. How near it comes depends on how well the force is a "
        "series of impacts: bounces are, a contact that never parts is not, and the notes say so. The force should be "
        "whole: what output.ramp, load.approach or load.release fade is weaker but no longer, and theta comes out too "
        "small.",
    .operands = "FILE",
    .least = 1,
    .most = 1,
    .options = analyse_options,
    .examples = "rasp analyse out/bouncing.wav --scale 10 -o out/rolling_part.yaml\n"
                "rasp analyse out/rolling.impacts.csv --plot out/\n"
                "rasp analyse rolling.csv --single bounces.csv --json\n",
    .run = analyse_run,
};
