/* The operand of `rasp analyse`: a force as WAV, NPY or a table (time_s and a column), or a table of impacts (time_s, amplitude_n and maybe duration_s: what
   output.impacts writes). A table is CSV, or NPY with named fields. NPY is known by its content, CSV by its name. */
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

#include "cmd/analyse.h"
#include "file/bytes.h"
#include "file/heightfile_npy.h"
#include "file/npy.h"
#include "file/table.h"
#include "file/wav.h"
#include "force/impact_series.h"
#include "scene/rules.h"

#define MOST 1e50

static double scale_of(const struct analyse_given *g)
{
    return isnan(g->scale) ? 1 : g->scale;
}

/* ------------------------------------------------------------------ samples */

static bool wav_take(struct analyse_source *s, const struct analyse_given *g, struct arena *a, struct err *e)
{
    struct wav w;
    if (!wav_read(s->file, a, &w, e))
        return false;
    if (g->channel > w.channels)
        return err_set(e, ERR_USAGE, "--channel: %s has %d channel%s", s->file, w.channels, w.channels == 1 ? "" : "s");
    if (isnan(g->scale))
        return err_set(e, ERR_USAGE, "--scale must be given: %s does not say how many newtons its %s stands for", s->file, w.bits ? "full scale" : "unit");
    s->channels = w.channels;
    double *force = ARENA_TAKE(a, double, w.frames);
    for (size_t i = 0; i < w.frames; i++)
        force[i] = g->scale * w.x[i * (size_t)w.channels + (size_t)g->channel - 1];
    s->signal = (struct impact_signal){force, (long)w.frames, w.rate, 0};
    return true;
}

static bool npy_take(struct analyse_source *s, const struct bytes *b, const struct analyse_given *g, struct arena *a, struct err *e)
{
    struct heightfile h;
    if (!heightfile_npy_read(s->file, b, a, &h, e))
        return false;
    if (h.rows > 1)
        return err_set(e, ERR_SCENE, "%s: an array of %zu x %zu; a force has one dimension", s->file, h.rows, h.columns);
    if (isnan(g->rate))
        return err_set(e, ERR_USAGE, "--rate must be given: %s does not say how many samples a second has", s->file);
    for (size_t i = 0; i < h.columns; i++) {
        if (!isfinite(h.z[i]))
            return err_set(e, ERR_SCENE, "%s: element %zu is not a finite number", s->file, i);
        h.z[i] *= scale_of(g);
    }
    s->signal = (struct impact_signal){h.z, (long)h.columns, g->rate, 0};
    return true;
}

/* ------------------------------------------------------------------ tables */

static bool column_take(const struct csv *t, const char *name, struct arena *a, double **x, struct err *e)
{
    int column = csv_column(t, name);
    if (column < 0)
        return err_set(e, ERR_SCENE, "%s: there is no column '%s'", t->file, name);
    *x = ARENA_TAKE(a, double, t->rows + 1);
    for (size_t i = 0; i < t->rows; i++)
        if (!csv_number(t, i, column, &(*x)[i], e))
            return false;
    return true;
}

static bool times_take(const struct csv *t, struct arena *a, double **time, struct err *e)
{
    if (!column_take(t, "time_s", a, time, e))
        return false;
    if (t->rows < 2)
        return err_set(e, ERR_SCENE, "%s: %zu row%s; at least 2 are needed%s", t->file, t->rows, t->rows == 1 ? "" : "s",
                       csv_column(t, "amplitude_n") < 0 ? "" : arena_format(a, ", and %d for statistics, --output and --plot", STATISTICS_LEAST));
    for (size_t i = 1; i < t->rows; i++)
        if (!((*time)[i] > (*time)[i - 1]))
            return err_set(e, ERR_SCENE, "%s:%d: column 'time_s': %.9g s comes after %.9g s; times must rise from row to row", t->file, t->lines[i],
                           (*time)[i], (*time)[i - 1]);
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
    if (!lasts)
        v->duration = ARENA_TAKE(a, double, v->n);
    for (int i = 0; i < v->n; i++) {
        v->alone[i] = lasts;
        if (!lasts)
            v->duration[i] = NAN;
        else if (!(v->duration[i] > 0))
            return err_set(e, ERR_SCENE, "%s:%d: column 'duration_s': %.9g s; an impact lasts longer than 0", s->file, t->lines[i], v->duration[i]);
        s->found.touching += lasts && i > 0 && impact_series_overlap(v->time[i] - v->time[i - 1], v->duration[i - 1], v->duration[i], impact_events_grain(v));
    }
    return true;
}

/* The first row whose step is not the usual one, else (steps change little by little) row `drifted`. */
static bool not_even(const struct csv *t, const double *time, size_t drifted, struct arena *a, struct err *e)
{
    size_t n = t->rows - 1, bad = 1;
    double *steps = ARENA_TAKE(a, double, n);
    for (size_t i = 0; i < n; i++)
        steps[i] = time[i + 1] - time[i];
    gsl_sort(steps, 1, n);
    double step = gsl_stats_median_from_sorted_data(steps, 1, n);
    while (bad <= n && fabs(time[bad] - time[bad - 1] - step) <= 0.01 * step + 2e-9 * fabs(time[bad]))
        bad++;
    if (bad > n)
        bad = drifted;
    return err_set(e, ERR_SCENE, "%s:%d: rows are not evenly spaced: %.9g s comes %.6g s after the row before, where most come after %.6g s. A force is read at one "
                                 "rate (a table of impacts has the column amplitude_n)", t->file, t->lines[bad], time[bad], time[bad] - time[bad - 1], step);
}

/* Rows must follow each other evenly: within 1 % of a row. */
static bool evenly(const struct csv *t, const double *time, struct arena *a, struct err *e)
{
    size_t n = t->rows;
    double step = (time[n - 1] - time[0]) / (double)(n - 1);
    for (size_t i = 0; i < n; i++)
        if (fabs(time[i] - time[0] - step * (double)i) > 0.01 * step + 1e-9 * fabs(time[i]))
            return not_even(t, time, i, a, e);
    return true;
}

static bool force_take(struct analyse_source *s, const struct csv *t, const struct analyse_given *g, struct arena *a, struct err *e)
{
    const char *column = g->column ? g->column : csv_column(t, "force_n") >= 0 ? "force_n" : "force_mean_n";
    double *time, *force;
    if (!g->column && csv_column(t, column) < 0)
        return err_set(e, ERR_SCENE, "%s: there is neither a column force_n nor force_mean_n (a force: --column names another), nor amplitude_n (impacts)", s->file);
    if (!times_take(t, a, &time, e) || !column_take(t, column, a, &force, e) || !evenly(t, time, a, e))
        return false;
    for (size_t i = 0; i < t->rows; i++)
        force[i] *= scale_of(g);
    s->signal = (struct impact_signal){force, (long)t->rows, (double)(t->rows - 1) / (time[t->rows - 1] - time[0]), time[0]};
    return true;
}

static bool table_take(struct analyse_source *s, const struct analyse_given *g, struct arena *a, struct err *e)
{
    struct arena *scratch = arena_open();
    struct csv t;
    bool ok = table_read(s->file, scratch, &t, e);
    if (ok) {
        s->has_force = csv_column(&t, "amplitude_n") < 0 || (g->column && csv_column(&t, g->column) >= 0);
        ok = s->has_force ? force_take(s, &t, g, a, e) : impacts_take(s, &t, a, e);
    }
    arena_close(scratch);
    return ok;
}

/* ------------------------------------------------------------------ all */

static bool samples_take(struct analyse_source *s, const struct analyse_given *g, struct arena *a, struct err *e)
{
    struct arena *scratch = arena_open();
    struct bytes b;
    bool ok = bytes_read(s->file, scratch, &b, e);
    if (ok) {
        bool npy = npy_is(&b);
        struct npy head;
        s->kind = npy ? "NPY" : "WAV";
        ok = !npy || npy_read(s->file, &b, scratch, &head, e);
        ok = ok && (!npy ? wav_take(s, g, a, e) : head.n_fields ? table_take(s, g, a, e) : npy_take(s, &b, g, a, e));
    }
    arena_close(scratch);
    return ok;
}

/* Powers of what is read are taken: none may leave a double's range. 0 is no fault. */
static bool in_range(const struct analyse_source *s, const char *what, double x, const char *unit, struct err *e)
{
    return x == 0 || (x >= 1 / MOST && x <= MOST) ||
           err_set(e, ERR_SCENE, "%s: %s of %.6g %s lies outside %g to %g; is the unit right?", s->file, what, x, unit, 1 / MOST, MOST);
}

static bool all_in_range(const struct analyse_source *s, struct err *e)
{
    const struct impact_events *v = &s->found.events;
    double amplitude = 0, least = HUGE_VAL, longest = 0;
    for (int i = 0; i < v->n; i++) {
        amplitude = fmax(amplitude, fabs(v->amplitude[i]));
        longest = fmax(longest, v->duration[i]); /* not of NAN */
        least = fmin(least, v->duration[i]);
    }
    return in_range(s, "an amplitude", amplitude, "N", e) && in_range(s, "a duration", longest, "s", e) &&
           (longest == 0 || in_range(s, "a duration", least, "s", e)) && in_range(s, "a time", fmax(fabs(v->time[0]), fabs(v->time[v->n - 1])), "s", e) &&
           in_range(s, "a time from first to last", v->time[v->n - 1] - v->time[0], "s", e);
}

bool analyse_read(const char *file, const struct analyse_given *g, struct arena *a, struct analyse_source *s, struct err *e)
{
    *s = (struct analyse_source){.file = file, .kind = "CSV", .has_force = true};
    if (!(rules_ends_in(file, ".csv") ? table_take(s, g, a, e) : samples_take(s, g, a, e)))
        return false;
    if (s->has_force && !impact_find(&s->signal, &g->options, a, &s->found, e))
        return err_at(e, "%s", file);
    return all_in_range(s, e);
}
