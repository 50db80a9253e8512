/* The panels of `rasp plot`: their words, which have data, which are asked for. */
#include "cmd/plot.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/tell.h"
#include "file/csv.h"
#include "file/wav.h"
#include "output/gnuplot.h"
#include "output/mark.h"
#include "pipeline/outputs.h"
#include "scene/scene_read.h"

static void plot_page(void *self, struct gnuplot *g);

const char *const plot_panels_words[PLOT_PANELS] = {"waveform", "spectrogram", "force", "normal",
                                                    "motion",   "modes",       "decays"};

/* Told apart by colour-blind people too (Okabe and Ito's set). */
const char *plot_panels_colour(int i)
{
    static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
    return colours[i % (int)(sizeof colours / sizeof colours[0])];
}

static bool read_word(const char *word, unsigned *asked, struct err *e)
{
    const char *names[PLOT_PANELS + 1] = {NULL}, *meant;
    memcpy(names, plot_panels_words, sizeof plot_panels_words);
    for (int k = 0; k < PLOT_PANELS; k++)
        if (!strcmp(word, names[k])) {
            *asked |= 1u << k;
            return true;
        }
    meant = text_nearest(word, names);
    return err_set(
        e, ERR_USAGE,
        "--panels: '%s' is no panel%s%s; there are waveform, spectrogram, force, normal, motion, modes and decays",
        word, meant ? "; did you mean " : "", meant ? meant : "");
}

bool plot_panels_read(const char *words, unsigned *asked, struct arena *a, struct err *e)
{
    *asked = 0;
    for (char *p = words ? arena_text(a, words) : NULL, *next; p; p = next) {
        next = strchr(p, ',');
        if (next) *next++ = '\0';
        if (!read_word(p, asked, e)) return false;
    }
    return true;
}

static bool has_data(const struct plot_page *p, int panel)
{
    switch (panel) {
    case PLOT_FORCE:
        return plot_data_has(p, PLOT_PEAK) || plot_data_has(p, PLOT_RMS);
    case PLOT_HAND:
        return plot_data_has(p, PLOT_NORMAL) || plot_data_has(p, PLOT_ALPHA);
    case PLOT_MOTION:
        return p->n_ways > 0;
    case PLOT_MODES:
    case PLOT_DECAYS:
        return p->n_bodies > 0;
    default:
        return p->sound != NULL;
    }
}

bool plot_panels_there(const struct plot_page *p, int panel)
{
    bool wanted = p->asked ? p->asked >> panel & 1 : panel != PLOT_DECAYS || p->table_of_modes;
    return wanted && has_data(p, panel);
}

static bool plot_panels_check(const struct plot_page *p, struct err *e)
{
    static const char *const lacks[PLOT_PANELS] = {
        "a sound (a WAV)",
        "a sound (a WAV)",
        "a table of diagnostics of the same render with contact forces (in the scene: output: {diagnostics: {rate: 1 "
        "kHz}})",
        "a table of diagnostics of the same render with the normal force or alpha (in the scene: output: {diagnostics: "
        "{rate: 1 kHz}})",
        "a contact that moves, by a table of diagnostics with x_m and y_m, or by the .scene.yaml and .json of the "
        "render beside the sound",
        "a mode table, or, beside a sound, the .scene.yaml and .json of its render, whose responses are modes",
        NULL};
    for (int k = 0; k < PLOT_PANELS; k++)
        if (p->asked >> k & 1 && !has_data(p, k))
            return err_set(e, ERR_SCENE, "%s: the panel %s needs %s", p->file, plot_panels_words[k],
                           lacks[k == PLOT_DECAYS ? PLOT_MODES : k]);
    return true;
}

static const char *text_of(const json_t *object, const char *key, struct arena *a)
{
    const char *text = json_string_value(json_object_get(object, key));
    return arena_text(a, text ? text : "");
}

static void contacts_read(struct plot_summary *s, const json_t *list, struct arena *a)
{
    size_t n = json_array_size(list);
    s->contacts = ARENA_TAKE(a, const char *, n);
    for (size_t i = 0; i < n; i++)
        s->contacts[s->n_contacts++] = text_of(json_array_get(list, i), "name", a);
}

static void files_read(struct plot_summary *s, const json_t *list, struct arena *a)
{
    size_t n = json_array_size(list);
    s->lists = json_is_array(list);
    for (int k = 0; k < 2; k++)
        s->tables[k] = ARENA_TAKE(a, const char *, n);
    for (size_t i = 0; i < n; i++) {
        const json_t *file = json_array_get(list, i);
        const char *kind = text_of(file, "kind", a);
        s->sounds = s->sounds || strcmp(kind, "wav") == 0;
        if (strcmp(kind, "scene") == 0) s->effective = text_of(file, "sha256", a);
        if (strcmp(kind, "csv") != 0 && strcmp(kind, "npy") != 0) continue;
        s->tables[0][s->n_tables] = text_of(file, "contact", a);
        s->tables[1][s->n_tables++] = text_of(file, "sha256", a);
    }
}

struct plot_summary plot_summary_read(const char *file, struct arena *a)
{
    json_t *whole = json_load_file(file, 0, NULL);
    struct plot_summary s = {.file = file, .title = text_of(whole, "scene", a), .there = whole, .effective = ""};
    contacts_read(&s, json_object_get(whole, "contacts"), a);
    files_read(&s, json_object_get(whole, "files"), a);
    json_decref(whole);
    return s;
}

/* NULL: it is not listed. Of several contacts each has a table, of one contact it needs no name. */
static const char *hash_of(const struct plot_summary *s, const char *contact)
{
    for (int i = 0; i < s->n_tables; i++)
        if (*contact ? s->n_tables > 1 && strcmp(s->tables[0][i], contact) == 0 : s->n_tables == 1)
            return s->tables[1][i];
    return NULL;
}

/* Is that file the table of the contact ("": of the only one) that the summary lists? *why: why not. ERR_INPUT: it
 * cannot be read. */
static bool plot_summary_has(const struct plot_summary *s, const char *path, const char *contact, const char **why,
                             struct err *e)
{
    char hex[HASH_TEXT];
    const char *hash = hash_of(s, contact);
    *why = hash ? "gives another sha256" : "does not list it";
    return hash && hash_file(path, hex, e) && strcmp(hash, hex) == 0;
}

/* The data of `rasp plot`: a sound, a table of diagnostics, or a mode table, and what a render writes beside it
   (NAME.json: title, contacts, and the tables' hashes; NAME.csv or NAME.CONTACT.csv, or .npy; NAME.scene.yaml), brought
   down to one value per column of pixels. A column shows the smallest and largest sample, the largest magnitude of the
   peak force, the root of the mean square force, the mean of the rest: nothing falls between two columns. */

static const char *const plot_names[] = {[PLOT_PEAK] = "force_peak_n",
                                         [PLOT_RMS] = "force_rms_n",
                                         [PLOT_NORMAL] = "normal_force_n",
                                         [PLOT_ALPHA] = "alpha_m"};

bool plot_data_has(const struct plot_page *p, enum plot_column column)
{
    for (int i = 0; i < p->n_tables; i++)
        if (p->tables[i].x[column]) return true;
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
    if (!wav_read(p->file, p->arena, &w, e) || !span_set(p, (double)w.frames / w.rate, e)) return false;
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
    spectrogram_make(&(struct spectrogram_of){w.x, w.frames, w.rate, p->from, p->to, PLOT_COLUMNS}, p->arena,
                     &o->spectrogram);
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
        if (!t->x[k]) continue;
        if (!csv_number(csv, row, csv_column(csv, plot_names[k]), &v, e)) return false;
        t->x[k][at] = k == PLOT_PEAK ? fmax(t->x[k][at], fabs(v)) : t->x[k][at] + (k == PLOT_RMS ? v * v : v);
    }
    return true;
}

static bool table_rows(struct plot_page *p, const struct csv *csv, const double *times, struct plot_table *t,
                       struct err *e)
{
    int *rows = ARENA_TAKE(p->arena, int, PLOT_COLUMNS);
    t->time = ARENA_TAKE(p->arena, double, PLOT_COLUMNS);
    for (int k = 0; k < PLOT_TABLE_COLUMNS; k++)
        if (csv_column(csv, plot_names[k]) >= 0) t->x[k] = ARENA_TAKE(p->arena, double, PLOT_COLUMNS);
    for (size_t row = 0; row < csv->rows; row++) {
        int at = pixel_of(p, times[row], PLOT_COLUMNS);
        if (at < 0) continue;
        t->time[at] += times[row];
        rows[at]++;
        if (!row_add(t, csv, row, at, e)) return false;
    }
    /* Sums become means; columns of pixels without a row are left out. */
    for (int c = 0; c < PLOT_COLUMNS; c++) {
        if (rows[c] == 0) continue;
        t->time[t->n] = t->time[c] / rows[c];
        for (int k = 0; k < PLOT_TABLE_COLUMNS; k++) {
            if (!t->x[k]) continue;
            double v = k == PLOT_PEAK ? t->x[k][c] : t->x[k][c] / rows[c];
            t->x[k][t->n] = k == PLOT_RMS ? sqrt(v) : v;
            t->most[k] = fmax(t->most[k], t->x[k][t->n]);
        }
        t->n++;
    }
    return plot_bodies_way_table(p, t->name, csv, times, e);
}

/* Times of the rows, and where the last one ends. */
static bool table_times(const struct csv *csv, double *times, double *end, struct err *e)
{
    int column = csv_column(csv, "time_s");
    size_t n = csv->rows;
    if (column < 0 || n == 0)
        return err_set(e, ERR_SCENE, "%s: %s: not a table of diagnostics", csv->file,
                       column < 0 ? "no column time_s" : "no rows");
    for (size_t row = 0; row < n; row++)
        if (!csv_number(csv, row, column, &times[row], e)) return false;
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
    if (!csv_table_read(path, p->arena, &csv, e)) return false;
    double *times = ARENA_TAKE(p->arena, double, csv.rows + 1);
    if (!table_times(&csv, times, &end, e) || (!p->sound && !p->n_tables && !span_set(p, end, e)) ||
        !table_rows(p, &csv, times, t, e))
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
static bool table_belongs(const struct plot_page *p, const struct plot_summary *s, const char *path,
                          const char *contact, struct err *e)
{
    const char *why;
    if (!s->lists)
        tell_warning(p->call, path,
                     arena_format(p->call->arena, "%s %s: that the table is of the same render is assumed", s->file,
                                  s->there ? "does not say which files are of its render" : "is not there"));
    if (!s->lists || plot_summary_has(s, path, contact, &why, e)) return true;
    if (e->kind == ERR_NONE)
        tell_warning(p->call, path,
                     arena_format(p->call->arena, "left out, as it is of another render: %s %s", s->file, why));
    return false;
}

/* The table of a contact ("": of the only one), as CSV or NPY, if it is there and of the same render. */
static bool table_find(struct plot_page *p, const struct plot_summary *s, const char *contact, struct err *e)
{
    for (int npy = 0; npy < 2; npy++) {
        const char *ending = npy ? "npy" : "csv",
                   *path = beside(p, *contact ? arena_format(p->arena, ".%s.%s", contact, ending)
                                     : npy    ? ".npy"
                                              : ".csv");
        if (access(path, F_OK) == 0 && table_belongs(p, s, path, contact, e)) return table_add(p, path, contact, e);
        if (e->kind != ERR_NONE) return false;
    }
    return true;
}

static bool tables_find(struct plot_page *p, const struct plot_summary *s, struct err *e)
{
    int n = s->n_contacts;
    p->tables = ARENA_TAKE(p->arena, struct plot_table, n + 1);
    if ((n <= 1 || s->lists) && !table_find(p, s, "", e)) return false;
    for (int i = 0; n > 1 && i < n; i++)
        if (*s->contacts[i] && !table_find(p, s, s->contacts[i], e)) return false;
    return true;
}

/* The table that is to be drawn: diagnostics, or modes. */
static bool table_alone(struct plot_page *p, struct err *e)
{
    struct csv csv;
    if (!csv_table_read(p->file, p->arena, &csv, e)) return false;
    if (plot_bodies_is_table(&csv))
        return (isnan(p->from) && isnan(p->to)) ? plot_bodies_table(p, e)
                                                : err_set(e, ERR_USAGE, "--%s: %s is a mode table, which has no time",
                                                          isnan(p->from) ? "to" : "from", p->file);
    if (csv_column(&csv, "stimulus_id") >= 0)
        return err_set(e, ERR_USAGE,
                       "%s: is the manifest of a set: rasp plot --gallery %s makes a page of all its sounds", p->file,
                       p->file);
    p->tables = ARENA_TAKE(p->arena, struct plot_table, 1);
    return table_add(p, p->file, "", e);
}

static bool anything(const struct plot_page *p, struct err *e)
{
    for (int k = 0; k < PLOT_PANELS; k++)
        if (plot_panels_there(p, k)) return true;
    if (p->silent) return err_set(e, ERR_SCENE, "no sound, and nothing else that can be drawn");
    return err_set(e, ERR_SCENE, "%s: has none of the columns that are drawn (%s, %s, %s, %s)", p->file,
                   plot_names[PLOT_PEAK], plot_names[PLOT_RMS], plot_names[PLOT_NORMAL], plot_names[PLOT_ALPHA]);
}

/* "glass_1Hz: a tool scraped back and forth": of a set every stimulus has the same title. */
static const char *titled(const struct plot_page *p, const char *title)
{
    const char *slash = strrchr(p->file, '/'), *name = slash ? slash + 1 : p->file, *dot = strrchr(name, '.');
    return arena_format(p->arena, "%.*s: %s", (int)(dot && dot > name ? (size_t)(dot - name) : strlen(name)), name,
                        title);
}

bool plot_data(struct plot_page *p, struct err *e)
{
    size_t n = strlen(p->file);
    bool table = n > 4 && (strcmp(p->file + n - 4, ".csv") == 0 || strcmp(p->file + n - 4, ".npy") == 0);
    struct plot_summary summary = plot_summary_read(beside(p, ".json"), p->arena);
    /* A summary of another render: what it says is not of the file that is shown, and is not used. */
    const char *why = p->silent ? "lists a sound" : "lists no sound";
    bool ours =
        !summary.lists || (table ? plot_summary_has((&summary), p->file, "", &why, e) : summary.sounds != p->silent);
    if (!ours && e->kind == ERR_NONE)
        tell_warning(
            p->call, p->file,
            arena_format(p->call->arena, "%s is of another render (it %s), and is not used", summary.file, why));
    bool foreign = !ours;
    const char *title = *summary.title && !foreign ? titled(p, summary.title) : p->file;
    if (e->kind != ERR_NONE) return false;
    if (table       ? !table_alone(p, e)
        : p->silent ? !(tables_find(p, (&summary), e) && (p->n_tables || span_set(p, p->length, e)))
                    : !sound_gather(p, e) || !(foreign || tables_find(p, &summary, e)))
        return false;
    if (!p->title) p->title = title;
    if (!foreign && !p->table_of_modes && !plot_bodies(p, &summary, beside(p, ".scene.yaml"), e)) return false;
    return plot_panels_check(p, e) && anything(p, e);
}

/* rasp plot: a picture of a render or mode table, or a page of pictures of many. */

static const struct args_option plot_options[] = {
    {"output", 'o', "FILE", false,
     "where to write; default: NAME.png beside NAME.wav, or NAME.svg; of a gallery gallery.html in the folder"},
    {"panels", 'p', "PANEL,...", false,
     "which of waveform, spectrogram, force, normal, motion, modes and decays; default: all that there are data for, "
     "of a gallery waveform and spectrogram of what has a sound"},
    {"gallery", 'g', NULL, false,
     "a page of HTML for a folder of renders, or for the manifest.csv of a set: a picture, the sound and the factors "
     "of each"},
    {"format", 'f', "png|svg", false, "format of the picture; default: by the output's ending, else png"},
    {"title", 't', "TEXT", false,
     "title; default: the file's name and the scene's title, if its summary lies beside the sound, else the file's "
     "name"},
    {"from", 0, "SECONDS", false, "start of the time shown; default: 0"},
    {"channel", 'c', "N", false,
     "which channel of the sound, from 1 (of several listening places each is one); default: 1"},
    {"to", 0, "SECONDS", false, "end of the time shown; default: the end of the sound"},
    {"force", 0, NULL, false, "replaces a file that rasp did not draw, or writes through a link"},
    {0},
};

static const char *const formats[] = {"png", "svg"};

static bool plot_format(struct cmd_call *c, struct plot_page *p, struct err *e)
{
    const char *o = args_value(&c->args, "output");
    int svg = o && text_ends(o, ".svg");
    if (!cmd_either(c, "format", formats, &svg, e)) return false;
    if (o && !text_ends(o, ".png") && !text_ends(o, ".svg"))
        return err_set(e, ERR_USAGE, "--output %s: must end in .png or .svg", o);
    p->svg = svg;
    return !o || text_ends(o, svg ? ".svg" : ".png") ||
           err_set(e, ERR_USAGE, "--output %s: does not end in .%s, the format that is asked for", o, formats[svg]);
}

/* Nor of the sound, or what lies beside it. */
static bool plot_spares_drawn(const struct plot_page *p, const char *target, const struct stat *t, struct err *e)
{
    static const char *const endings[] = {".wav", ".csv", ".npy", ".json", ".scene.yaml"};
    struct stat s;
    for (int i = 0; i < 5; i++) {
        const char *file = arena_format(p->arena, "%.*s%s", (int)strlen(p->file) - 4, p->file, endings[i]);
        if (stat(file, &s) == 0 && s.st_dev == t->st_dev && s.st_ino == t->st_ino)
            return err_set(e, ERR_CREATE,
                           "%s: the picture would overwrite %s, which it shows; write elsewhere: -o OTHER.png", target,
                           file);
    }
    return true;
}

/* A picture takes the place of no file that the sound was made from. */
static bool plot_spares(const struct plot_page *p, const char *target, struct err *e)
{
    struct scene scene;
    struct stat t;
    struct err unreadable = {0};
    const char *effective = arena_format(p->arena, "%.*s.scene.yaml", (int)strlen(p->file) - 4, p->file), *messages;
    int n = 0;
    const struct outputs_source *sources = NULL;
    if (stat(target, &t) != 0) return true;
    if (!plot_spares_drawn(p, target, &t, e)) return false;
    if (access(effective, F_OK) == 0 && scene_read(effective, NULL, p->arena, &scene, &messages, &unreadable))
        sources = outputs_sources(&scene, &n, p->arena);
    for (int i = 0; i < n; i++)
        if (sources[i].device == t.st_dev && sources[i].inode == t.st_ino)
            return err_set(e, ERR_CREATE,
                           "%s: the picture would overwrite an input of %s (%s); write elsewhere: -o OTHER.png", target,
                           effective, sources[i].what);
    return true;
}

static void plot_page(void *self, struct gnuplot *g) { plot_draw(self, g); }

static int gallery_run(struct cmd_call *c, struct err *e)
{
    const char *panels = args_value(&c->args, "panels");
    int svg = 0;
    struct plot_gallery g = {.source = c->args.operands[0],
                             .output = args_value(&c->args, "output"),
                             .title = args_value(&c->args, "title"),
                             .arena = c->arena,
                             .call = c,
                             .force = args_given(&c->args, "force")};
    static const char *const others[] = {"from", "to", "channel"};
    for (int k = 0; k < 3; k++)
        if (args_given(&c->args, others[k]))
            return err_set(e, ERR_USAGE, "--%s: not of a gallery, which shows whole sounds", others[k]), (int)e->kind;
    if (!cmd_either(c, "format", formats, &svg, e)) return (int)e->kind;
    g.svg = svg;
    if (g.output && !text_ends(g.output, ".html"))
        err_set(e, ERR_USAGE, "--output %s: a gallery is a page of HTML, its name must end in .html", g.output);
    else if (plot_panels_read(panels ? panels : "waveform,spectrogram", &g.asked, c->arena, e))
        plot_gallery(&g, e);
    return (int)e->kind;
}

static int plot_run(struct cmd_call *c, struct err *e)
{
    struct plot_page p = {.file = c->args.operands[0],
                          .title = args_value(&c->args, "title"),
                          .from = NAN,
                          .to = NAN,
                          .arena = c->arena,
                          .call = c};
    const double range[2] = {0, 1e9};
    long channel = 1;
    if (args_given(&c->args, "gallery")) return gallery_run(c, e);
    if (!text_ends(p.file, ".wav") && !text_ends(p.file, ".csv") && !text_ends(p.file, ".npy"))
        return err_set(e, ERR_USAGE,
                       "%s: neither a sound (.wav) nor a table of diagnostics (.csv, .npy) or modes (.csv); of a "
                       "folder --gallery makes a page",
                       p.file),
               (int)e->kind;
    if (!plot_format(c, &p, e) || !plot_panels_read(args_value(&c->args, "panels"), &p.asked, c->arena, e) ||
        !args_number(&c->args, "from", range, &p.from, e) || !args_number(&c->args, "to", range, &p.to, e) ||
        !args_whole(&c->args, "channel", (const long[2]){1, 1024}, &channel, e))
        return (int)e->kind;
    p.channel = (int)channel;
    const char *o = args_value(&c->args, "output");
    const char *target =
        o ? o : arena_format(c->arena, "%.*s.%s", (int)strlen(p.file) - 4, p.file, p.svg ? "svg" : "png");
    if (!plot_data(&p, e) || !plot_spares(&p, target, e) ||
        !mark_permits(target, NULL, args_given(&c->args, "force"), e) ||
        !gnuplot_write(target, p.svg, plot_page, &p, e))
        return (int)e->kind;
    printf("%s ", target);
    /* what the page shows, as a line */
    static const char *const names[PLOT_PANELS] = {"waveform", "spectrogram", "contact force", "normal force",
                                                   "motion",   "modes",       "decays"};
    const char *comma = "";
    for (int k = 0; k < PLOT_PANELS; k++)
        if (plot_panels_there((&p), k)) {
            fprintf(stdout, "%s %s%s", comma, names[k],
                    k == PLOT_HAND && plot_data_has((&p), PLOT_ALPHA) ? ", alpha" : "");
            comma = ",";
        }
    fputc('\n', stdout);
    return 0;
}

const struct command plot_command = {
    .name = "plot",
    .summary = "draws a render: waveform, spectrogram, forces, motion, modes",
    .does =
        "For NAME.wav writes NAME.png: the waveform, the spectrogram (Hann window of 20 ms, the 80 dB below the "
        "loudest place, up to 20 kHz) and, from the diagnostics beside it (NAME.csv, NAME.npy, or NAME.CONTACT.csv), "
        "the contact force and the normal force with alpha, on one time axis; below them the way of the contact from "
        "above, coloured by speed, and the modes of what rings (NAME.scene.yaml): stems of their largest gain on that "
        "way, coloured by their time of decay. A table that is not of the same render, as the hashes in NAME.json "
        "tell, is left out with a warning; without NAME.json it is taken to be. Panels without data are left out; what "
        "was drawn is printed. For NAME.csv or NAME.npy, of a render without sound, what the table has; a mode table "
        "gives the modes, and their decays over frequency. Of several channels one is drawn. Needs gnuplot.\n"
        "With --gallery the operand is a folder that rasp batch made, or its manifest.csv, or any folder of sounds. "
        "The page shows every stimulus, with its factors, and plays it (of what has no sound: contact and normal force "
        "and motion), or says why it failed; it needs no script, and nothing from elsewhere. Its pictures are drawn "
        "anew, into a folder beside it: gallery_files/ of gallery.html. Sounds are linked where they are.",
    .operands = "NAME.wav|NAME.csv|NAME.npy|FOLDER/|manifest.csv",
    .least = 1,
    .most = 1,
    .options = plot_options,
    .examples = "rasp plot out/basswood_scrape.wav\n"
                "rasp plot out/basswood_scrape.wav -o stroke.svg --from 0.25 --to 0.5\n"
                "rasp plot out/basswood_scrape.wav --panels motion,modes -o plan.svg\n"
                "rasp plot out/forces_only.csv\n"
                "rasp plot irs/basswood_plank.csv -o plank.png\n"
                "rasp plot --gallery out/ -o out/gallery.html\n",
    .run = plot_run,
};
