/* The data of `rasp plot`: a sound, a table of diagnostics, or a mode table, and what a render writes beside it (NAME.json: title, contacts, and the tables' hashes;
   NAME.csv or NAME.CONTACT.csv, or .npy; NAME.scene.yaml), brought down to one value per column of pixels. A column shows the smallest and largest sample, the largest magnitude of
   the peak force, the root of the mean square force, the mean of the rest: nothing falls between two columns. */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "cmd/plot.h"
#include "cmd/plot_summary.h"
#include "cmd/tell.h"
#include "file/table.h"
#include "file/wav.h"

static const char *const plot_names[] = {
    [PLOT_PEAK] = "force_peak_n", [PLOT_RMS] = "force_rms_n", [PLOT_NORMAL] = "normal_force_n", [PLOT_ALPHA] = "alpha_m"};

bool plot_data_has(const struct plot_page *p, enum plot_column column)
{
    for (int i = 0; i < p->n_tables; i++)
        if (p->tables[i].x[column])
            return true;
    return false;
}

/* ------------------------------------------------------------------ times */

/* The time shown, once the end of the data is known. */
static bool span_set(struct plot_page *p, double end, struct err *e)
{
    p->from = isnan(p->from) ? 0 : p->from;
    if (p->from >= end || (!isnan(p->to) && p->to > end + 1e-9))
        return err_set(e, ERR_USAGE, "--%s: %s ends at %.6g s", p->from >= end ? "from" : "to", p->file, end);
    p->to = isnan(p->to) ? end : p->to;
    return p->from < p->to || err_set(e, ERR_USAGE, "--from must be before --to");
}

/* ------------------------------------------------------------------ sound */

static void sound_columns(struct plot_sound *o, const double *x, long first, long last)
{
    double squares = 0;
    for (int c = 0; c < o->n; c++) {
        long from = first + (last - first) * c / o->n, to = first + (last - first) * (c + 1) / o->n;
        o->least[c] = o->most[c] = x[from > first ? from - 1 : from]; /* columns join */
        for (long i = from; i < to; i++) {
            o->least[c] = fmin(o->least[c], x[i]);
            o->most[c] = fmax(o->most[c], x[i]);
            o->peak = fmax(o->peak, fabs(x[i]));
            squares += x[i] * x[i];
        }
    }
    o->rms = sqrt(squares / (double)(last - first));
}

/* One channel of the sound. */
static bool sound_gather(struct plot_page *p, struct err *e)
{
    struct plot_sound *o = ARENA_TAKE(p->arena, struct plot_sound, 1);
    struct wav w;
    if (!wav_read(p->file, p->arena, &w, e) || !span_set(p, (double)w.frames / w.rate, e))
        return false;
    p->channels = w.channels;
    if (p->channel > w.channels)
        return err_set(e, ERR_USAGE, "--channel: %s has %d channel%s", p->file, w.channels, w.channels == 1 ? "" : "s");
    for (size_t i = 0; i < w.frames; i++)
        w.x[i] = w.x[i * (size_t)w.channels + (size_t)p->channel - 1];
    long first = (long)floor(p->from * w.rate), last = (long)fmin(ceil(p->to * w.rate), (double)w.frames);
    o->rate = w.rate;
    o->n = last - first < PLOT_COLUMNS ? (int)(last - first) : PLOT_COLUMNS;
    o->least = ARENA_TAKE(p->arena, double, o->n);
    o->most = ARENA_TAKE(p->arena, double, o->n);
    sound_columns(o, w.x, first, last);
    spectrogram_make(&(struct spectrogram_of){w.x, w.frames, w.rate, p->from, p->to, PLOT_COLUMNS}, p->arena, &o->spectrogram);
    p->sound = o;
    return true;
}

/* ------------------------------------------------------------------ tables */

/* Column of a row at a time; -1: not shown. */
static int pixel_of(const struct plot_page *p, double time, int columns)
{
    double at = (time - p->from) / (p->to - p->from) * columns;
    return at >= 0 && time <= p->to ? (int)fmin(at, columns - 1) : -1;
}

/* Adds one row to its column of pixels. */
static bool row_add(struct plot_table *t, const struct csv *csv, size_t row, int at, struct err *e)
{
    for (int k = 0; k < PLOT_TABLE_COLUMNS; k++) {
        double v;
        if (!t->x[k])
            continue;
        if (!csv_number(csv, row, csv_column(csv, plot_names[k]), &v, e))
            return false;
        t->x[k][at] = k == PLOT_PEAK ? fmax(t->x[k][at], fabs(v)) : t->x[k][at] + (k == PLOT_RMS ? v * v : v);
    }
    return true;
}

/* Sums become means; columns of pixels without a row are left out. */
static void table_pack(struct plot_table *t, const int *rows, int columns)
{
    for (int c = 0; c < columns; c++) {
        if (rows[c] == 0)
            continue;
        t->time[t->n] = t->time[c] / rows[c];
        for (int k = 0; k < PLOT_TABLE_COLUMNS; k++) {
            if (!t->x[k])
                continue;
            double v = k == PLOT_PEAK ? t->x[k][c] : t->x[k][c] / rows[c];
            t->x[k][t->n] = k == PLOT_RMS ? sqrt(v) : v;
            t->most[k] = fmax(t->most[k], t->x[k][t->n]);
        }
        t->n++;
    }
}

static bool table_rows(struct plot_page *p, const struct csv *csv, const double *times, struct plot_table *t, struct err *e)
{
    int *rows = ARENA_TAKE(p->arena, int, PLOT_COLUMNS);
    t->time = ARENA_TAKE(p->arena, double, PLOT_COLUMNS);
    for (int k = 0; k < PLOT_TABLE_COLUMNS; k++)
        if (csv_column(csv, plot_names[k]) >= 0)
            t->x[k] = ARENA_TAKE(p->arena, double, PLOT_COLUMNS);
    for (size_t row = 0; row < csv->rows; row++) {
        int at = pixel_of(p, times[row], PLOT_COLUMNS);
        if (at < 0)
            continue;
        t->time[at] += times[row];
        rows[at]++;
        if (!row_add(t, csv, row, at, e))
            return false;
    }
    table_pack(t, rows, PLOT_COLUMNS);
    return plot_way_table(p, t->name, csv, times, e);
}

/* Times of the rows, and where the last one ends. */
static bool table_times(const struct csv *csv, double *times, double *end, struct err *e)
{
    int column = csv_column(csv, "time_s");
    size_t n = csv->rows;
    if (column < 0 || n == 0)
        return err_set(e, ERR_SCENE, "%s: %s: not a table of diagnostics", csv->file, column < 0 ? "no column time_s" : "no rows");
    for (size_t row = 0; row < n; row++)
        if (!csv_number(csv, row, column, &times[row], e))
            return false;
    *end = n > 1 ? times[n - 1] + (times[n - 1] - times[0]) / (double)(n - 1) : times[0];
    return true;
}

/* One table; the first sets the time shown when there is no sound. */
static bool table_add(struct plot_page *p, const char *path, const char *name, struct err *e)
{
    struct csv csv;
    struct plot_table *t = &p->tables[p->n_tables];
    double end = 0;
    t->name = name;
    if (!table_read(path, p->arena, &csv, e))
        return false;
    double *times = ARENA_TAKE(p->arena, double, csv.rows + 1);
    if (!table_times(&csv, times, &end, e) || (!p->sound && !p->n_tables && !span_set(p, end, e)) || !table_rows(p, &csv, times, t, e))
        return false;
    p->n_tables++;
    return true;
}

/* ------------------------------------------------------------------ what lies beside the sound */

static const char *beside(const struct plot_page *p, const char *ending)
{
    size_t n = strlen(p->file);
    n -= n > 4 && p->file[n - 4] == '.' ? 4 : 0;
    return arena_format(p->arena, "%.*s%s", (int)n, p->file, ending);
}

/* Is the table of the render that the summary is of? Where that cannot be known it is taken to be, and this is said. */
static bool table_belongs(const struct plot_page *p, const struct plot_summary *s, const char *path, const char *contact, struct err *e)
{
    const char *why;
    if (!s->lists)
        tell_warning(p->call, path, arena_format(p->call->arena, "%s %s: that the table is of the same render is assumed", s->file,
                                                  s->there ? "does not say which files are of its render" : "is not there"));
    if (!s->lists || plot_summary_has(s, path, contact, &why, e))
        return true;
    if (e->kind == ERR_NONE)
        tell_warning(p->call, path, arena_format(p->call->arena, "left out, as it is of another render: %s %s", s->file, why));
    return false;
}

/* The table of a contact ("": of the only one), as CSV or NPY, if it is there and of the same render. */
static bool table_find(struct plot_page *p, const struct plot_summary *s, const char *contact, struct err *e)
{
    for (int npy = 0; npy < 2; npy++) {
        const char *ending = npy ? "npy" : "csv", *path = beside(p, *contact ? arena_format(p->arena, ".%s.%s", contact, ending) : npy ? ".npy" : ".csv");
        if (access(path, F_OK) == 0 && table_belongs(p, s, path, contact, e))
            return table_add(p, path, contact, e);
        if (e->kind != ERR_NONE)
            return false;
    }
    return true;
}

static bool tables_find(struct plot_page *p, const struct plot_summary *s, struct err *e)
{
    int n = s->n_contacts;
    p->tables = ARENA_TAKE(p->arena, struct plot_table, n + 1);
    if ((n <= 1 || s->lists) && !table_find(p, s, "", e))
        return false;
    for (int i = 0; n > 1 && i < n; i++)
        if (*s->contacts[i] && !table_find(p, s, s->contacts[i], e))
            return false;
    return true;
}

/* A summary of another render: what it says is not of the file that is shown, and is not used. */
static bool summary_foreign(const struct plot_page *p, const struct plot_summary *s, bool table, struct err *e)
{
    const char *why = p->silent ? "lists a sound" : "lists no sound";
    bool ours = !s->lists || (table ? plot_summary_has(s, p->file, "", &why, e) : s->sounds != p->silent);
    if (!ours && e->kind == ERR_NONE)
        tell_warning(p->call, p->file, arena_format(p->call->arena, "%s is of another render (it %s), and is not used", s->file, why));
    return !ours;
}

/* The table that is to be drawn: diagnostics, or modes. */
static bool table_alone(struct plot_page *p, struct err *e)
{
    struct csv csv;
    if (!table_read(p->file, p->arena, &csv, e))
        return false;
    if (plot_bodies_is_table(&csv))
        return (isnan(p->from) && isnan(p->to)) ? plot_bodies_table(p, e) : err_set(e, ERR_USAGE, "--%s: %s is a mode table, which has no time", isnan(p->from) ? "to" : "from", p->file);
    if (csv_column(&csv, "stimulus_id") >= 0)
        return err_set(e, ERR_USAGE, "%s: is the manifest of a set: rasp plot --gallery %s makes a page of all its sounds", p->file, p->file);
    p->tables = ARENA_TAKE(p->arena, struct plot_table, 1);
    return table_add(p, p->file, "", e);
}

/* What a render without sound left: tables, or nothing but where it went. */
static bool silent_gather(struct plot_page *p, const struct plot_summary *s, struct err *e)
{
    return tables_find(p, s, e) && (p->n_tables || span_set(p, p->length, e));
}

static bool anything(const struct plot_page *p, struct err *e)
{
    for (int k = 0; k < PLOT_PANELS; k++)
        if (plot_panels_there(p, k))
            return true;
    if (p->silent)
        return err_set(e, ERR_SCENE, "no sound, and nothing else that can be drawn");
    return err_set(e, ERR_SCENE, "%s: has none of the columns that are drawn (%s, %s, %s, %s)", p->file, plot_names[PLOT_PEAK], plot_names[PLOT_RMS],
                   plot_names[PLOT_NORMAL], plot_names[PLOT_ALPHA]);
}

/* "glass_1Hz: a tool scraped back and forth": of a set every stimulus has the same title. */
static const char *titled(const struct plot_page *p, const char *title)
{
    const char *slash = strrchr(p->file, '/'), *name = slash ? slash + 1 : p->file, *dot = strrchr(name, '.');
    return arena_format(p->arena, "%.*s: %s", (int)(dot && dot > name ? (size_t)(dot - name) : strlen(name)), name, title);
}

bool plot_data(struct plot_page *p, struct err *e)
{
    size_t n = strlen(p->file);
    bool table = n > 4 && (strcmp(p->file + n - 4, ".csv") == 0 || strcmp(p->file + n - 4, ".npy") == 0);
    struct plot_summary summary = plot_summary_read(beside(p, ".json"), p->arena);
    bool foreign = summary_foreign(p, &summary, table, e);
    const char *title = *summary.title && !foreign ? titled(p, summary.title) : p->file;
    if (e->kind != ERR_NONE)
        return false;
    if (table ? !table_alone(p, e) : p->silent ? !silent_gather(p, &summary, e) : !sound_gather(p, e) || !(foreign || tables_find(p, &summary, e)))
        return false;
    if (!p->title)
        p->title = title;
    if (!foreign && !p->table_of_modes && !plot_bodies(p, &summary, beside(p, ".scene.yaml"), e))
        return false;
    return plot_panels_check(p, e) && anything(p, e);
}
