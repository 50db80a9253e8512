/* The panels of `rasp plot`: their words, which have data, which are asked for. */
#include "cmd/plot.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/relpath.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "file/csv.h"
#include "file/wav.h"
#include "output/gnuplot.h"
#include "output/mark.h"
#include "pipeline/outputs.h"
#include "response/mode_table.h"
#include "response/object.h"
#include "response/space.h"
#include "scene/scene_read.h"
#include "trajectory/contact.h"
#include "trajectory/trajectory.h"

const char *const plot_panels_words[PLOT_PANELS] = {"waveform",   "spectrogram", "force", "normal",
                                                    "trajectory", "motion",      "modes", "decays"};

bool plot_panels_read(const char *words, unsigned *asked, struct arena *a, struct err *e)
{
    *asked = 0;
    for (char *rest = words ? arena_text(a, words) : NULL, *word; (word = strsep(&rest, ","));) {
        const char *names[PLOT_PANELS + 1] = {NULL}, *meant;
        int k = 0;
        memcpy(names, plot_panels_words, sizeof plot_panels_words);
        while (names[k] && strcmp(word, names[k]) != 0)
            k++;
        meant = names[k] ? NULL : text_nearest(word, names);
        if (!names[k])
            return err_set(e, ERR_USAGE,
                           "--panels: '%s' is no panel%s%s; there are waveform, spectrogram, force, normal, "
                           "trajectory, motion, modes and decays",
                           word, meant ? "; did you mean " : "", meant ? meant : "");
        *asked |= 1u << k;
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
    case PLOT_FOLLOWED:
        return plot_data_has(p, PLOT_GROUND) || plot_data_has(p, PLOT_TRAJECTORY);
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

static const char *text_of(const json_t *object, const char *key, struct arena *a)
{
    const char *text = json_string_value(json_object_get(object, key));
    return arena_text(a, text ? text : "");
}

struct plot_summary plot_summary_read(const char *file, struct arena *a)
{
    json_t *whole = json_load_file(file, 0, NULL), *contacts = json_object_get(whole, "contacts"),
           *files = json_object_get(whole, "files"), *each;
    struct plot_summary s = {.file = file, .title = text_of(whole, "scene", a), .there = whole, .effective = ""};
    size_t i;
    s.contacts = ARENA_TAKE(a, const char *, json_array_size(contacts));
    json_array_foreach(contacts, i, each) s.contacts[s.n_contacts++] = text_of(each, "name", a);
    s.lists = json_is_array(files);
    for (int k = 0; k < 2; k++)
        s.tables[k] = ARENA_TAKE(a, const char *, json_array_size(files));
    json_array_foreach(files, i, each)
    {
        const char *kind = text_of(each, "kind", a);
        s.sounds = s.sounds || strcmp(kind, "wav") == 0;
        if (strcmp(kind, "scene") == 0) s.effective = text_of(each, "sha256", a);
        if (strcmp(kind, "csv") != 0 && strcmp(kind, "npy") != 0) continue;
        s.tables[0][s.n_tables] = text_of(each, "contact", a);
        s.tables[1][s.n_tables++] = text_of(each, "sha256", a);
    }
    json_decref(whole);
    return s;
}

/* Is that file the table of the contact ("": of the only one) that the summary lists? Of several contacts each has a
   table, of one contact it needs no name. *why: why not. ERR_INPUT: it cannot be read. */
static bool summary_has(const struct plot_summary *s, const char *path, const char *contact, const char **why,
                        struct err *e)
{
    char hex[HASH_TEXT];
    const char *hash = NULL;
    for (int i = s->n_tables - 1; i >= 0; i--)
        if (*contact ? s->n_tables > 1 && strcmp(s->tables[0][i], contact) == 0 : s->n_tables == 1)
            hash = s->tables[1][i];
    *why = hash ? "gives another sha256" : "does not list it";
    return hash && hash_file(path, hex, e) && strcmp(hash, hex) == 0;
}

/* The data of `rasp plot`: a sound, a table of diagnostics, or a mode table, and what a render writes beside it
   (NAME.json: title, contacts, and the tables' hashes; NAME.csv or NAME.CONTACT.csv, or .npy; NAME.scene.yaml), brought
   down to one value per column of pixels. A column shows the smallest and largest sample, the largest magnitude of the
   peak force, the root of the mean square force, the mean of the rest: nothing falls between two columns. */

static const char *const plot_names[] = {
    [PLOT_PEAK] = "force_peak_n", [PLOT_RMS] = "force_rms_n", [PLOT_NORMAL] = "normal_force_n",
    [PLOT_ALPHA] = "alpha_m",     [PLOT_GROUND] = "ground_m", [PLOT_TRAJECTORY] = "trajectory_m"};

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
    double squares = 0;
    for (int c = 0; c < o->n; c++) {
        long from = first + (last - first) * c / o->n, to = first + (last - first) * (c + 1) / o->n;
        o->least[c] = o->most[c] = w.x[from > first ? from - 1 : from]; /* columns join */
        for (long i = from; i < to; i++) {
            o->least[c] = fmin(o->least[c], w.x[i]);
            o->most[c] = fmax(o->most[c], w.x[i]);
            o->peak = fmax(o->peak, fabs(w.x[i]));
            squares += w.x[i] * w.x[i];
        }
    }
    o->rms = sqrt(squares / (double)(last - first));
    spectrogram_make(&(struct spectrogram_of){w.x, w.frames, w.rate, p->from, p->to, PLOT_COLUMNS}, p->arena,
                     &o->spectrogram);
    p->sound = o;
    return true;
}

/* ------------------------------------------------------------------ the way of a contact

   As its table of diagnostics has it, or, where there is none, as the scene's motion goes. Not more places than a panel
   can show. */

enum { MOST = 4000 };

static void add(struct plot_page *p, const struct plot_path *path)
{
    bool moves = false;
    for (int i = 1; i < path->n; i++)
        moves = moves || path->at[i][0] != path->at[0][0] || path->at[i][1] != path->at[0][1];
    if (!moves) return;
    p->ways = arena_more(p->arena, p->ways, p->n_ways, sizeof *p->ways);
    p->ways[p->n_ways++] = *path;
}

/* Where a contact was in the time shown, by its table; one that stays has no way. Columns of x, y and speed; the last
   may be missing. */
static bool path_of_table(struct plot_page *p, const char *name, const struct csv *csv, const double *times,
                          struct err *e)
{
    struct plot_path path = {.name = name};
    int column[3] = {csv_column(csv, "x_m"), csv_column(csv, "y_m"), csv_column(csv, "speed_m_per_s")};
    size_t shown = 0, each = 0;
    if (column[0] < 0 || column[1] < 0) return true;
    for (size_t row = 0; row < csv->rows; row++)
        shown += times[row] >= p->from && times[row] <= p->to;
    size_t step = (shown + MOST - 1) / MOST;
    path.at = (double(*)[3])arena_take(p->arena, MOST + 2, sizeof *path.at);
    for (size_t row = 0; row < csv->rows; row++) {
        if (!(times[row] >= p->from && times[row] <= p->to) || (each++ % step && each != shown)) continue;
        double *to = path.at[path.n++];
        for (int k = 0; k < 3; k++)
            if (column[k] >= 0 && !csv_number(csv, row, column[k], &to[k], e)) return false;
    }
    add(p, &path);
    return true;
}

static bool path_of_scene(struct plot_page *p, const struct scene *s, const struct contact *c, struct err *e)
{
    struct trajectory tr;
    if (!trajectory_make(&c->motion, trajectory_seed(s, c), p->arena, &tr, e)) return false;
    double from = fmax(p->from - c->start, 0), to = fmin(p->to - c->start, tr.duration),
           *t = ARENA_TAKE(p->arena, double, 4 * MOST), *x = t + MOST, *y = x + MOST, *du = y + MOST;
    struct plot_path path = {s->n_contacts > 1 ? c->name : "", MOST,
                             (double(*)[3])arena_take(p->arena, MOST, sizeof *path.at)};
    if (!(from < to)) return true;
    for (int i = 0; i < MOST; i++)
        t[i] = from + (to - from) * i / (MOST - 1);
    trajectory_at(&tr, MOST, t, (struct trajectory_out){.x = x, .y = y, .du = du});
    for (int i = 0; i < MOST; i++)
        memcpy(path.at[i], (const double[3]){x[i], y[i], fabs(du[i])}, sizeof path.at[i]);
    add(p, &path);
    return true;
}

/* NULL: none */
static const struct plot_path *path_of(const struct plot_page *p, const struct scene *s, const struct contact *c)
{
    for (int i = 0; i < p->n_ways; i++)
        if (s->n_contacts == 1 || !strcmp(p->ways[i].name, c->name)) return &p->ways[i];
    return NULL;
}

/* What rings in a render, for `rasp plot`: the modes that its effective scene names, each with its largest gain along
   the motion; the edges of objects and the places of tables. Or the modes of a mode table, each with its largest gain
   over the places. */

enum { PLACES = 33 /* along the motion */ };

/* ------------------------------------------------------------------ a mode table */

static void count(struct plot_mode *m, double frequency, double decay, double gain)
{
    if (gain > m->gain) *m = (struct plot_mode){frequency, decay, gain};
}

/* ------------------------------------------------------------------ a response */

/* Nothing: a recording, or none. */
static bool modes_of(const struct response *r, double rate, struct arena *a, struct modes *m, struct err *e)
{
    struct modes_ask ask = {
        .strongest = r->modes, .band = {r->band[0], r->band[1]}, .pairing = r->pairing, .rate = rate};
    struct object *o = ARENA_TAKE(a, struct object, 1);
    const char *note;
    bool ok = true;
    m->n = 0;
    if (r->object.given) {
        ok = object_make(
            &r->object,
            &(struct object_ask){.key = "object", .low = r->band[0], .top = r->band[1], .most = 4 * r->modes}, a, o,
            &note, e);
        if (ok) object_modes(o, r->object.origin, NULL, r->modes, a, m);
    } else if (r->space.given) {
        ok = space_modes(&r->space, &ask, a, m, e);
    } else if (r->file && text_ends(r->file, ".csv")) {
        ok = modes_table(r->file, &ask, a, m, e);
    }
    if (ok && m->n) modes_drop_above(m, rate);
    return ok;
}

static void add_body(struct plot_page *p, const struct modes *m, const struct plot_path *path, double share,
                     const char *name)
{
    struct modes_point point = modes_point_make(p->arena, m->n);
    struct plot_body *b = &p->bodies[p->n_bodies++];
    *b = (struct plot_body){name, m->n, ARENA_TAKE(p->arena, struct plot_mode, m->n)};
    for (int k = 0; k < PLACES; k++) {
        int at = path ? (int)((long)k * (path->n - 1) / (PLACES - 1)) : -1;
        struct modes_where where = {at < 0 ? m->home[0] : path->at[at][0], at < 0 ? m->home[1] : path->at[at][1],
                                    (double)k / (PLACES - 1)};
        modes_at(m, &where, &point);
        for (int i = 0; i < m->n; i++)
            count(&b->modes[i], m->shared ? m->frequency[i] : point.frequency[i],
                  m->shared ? m->decay[i] : point.decay[i],
                  share * sqrt(point.re[i] * point.re[i] + point.im[i] * point.im[i]));
    }
}

/* ------------------------------------------------------------------ seen from above */

static bool add_ground(struct plot_page *p, const struct response *r, const struct modes *m, struct err *e)
{
    struct plot_ground *g = &p->grounds[p->n_grounds++];
    if (r->object.given && m->object && r->object.shape != OBJECT_SHELL) {
        g->box = true;
        int shape = r->object.shape;
        g->round = shape == OBJECT_DISK || shape == OBJECT_MEMBRANE || shape == OBJECT_DRUM;
        for (int k = 0; k < 2; k++) {
            g->low[k] = r->object.origin[k] + m->object->low[k];
            g->high[k] = r->object.origin[k] + m->object->high[k];
        }
    } else if (r->file && text_ends(r->file, ".csv") && !r->object.given && !r->space.given) {
        struct mode_table t;
        if (!mode_table_read(r->file, p->arena, &t, e)) return false;
        g->n = t.places > 1 ? (int)t.places : 0;
        g->places = (double(*)[2])arena_take(p->arena, t.places, sizeof *g->places);
        memcpy(g->places, t.xy, t.places * sizeof *g->places);
    }
    return true;
}

/* ------------------------------------------------------------------ a scene */

static bool add_contact(struct plot_page *p, const struct scene *s, const struct contact *c, struct err *e)
{
    const char *which = s->n_contacts > 1 ? arena_format(p->arena, " of %s", c->name) : "", *tool = contact_tool(c);
    struct modes m = {0};
    if (!path_of(p, s, c) && !path_of_scene(p, s, c, e)) return false;
    if (!modes_of(&c->surface.response, s->output.sample_rate, p->arena, &m, e) ||
        !add_ground(p, &c->surface.response, &m, e))
        return false;
    if (m.n) add_body(p, &m, path_of(p, s, c), fabs(c->gain), arena_format(p->arena, "surface%s", which));
    if (c->scraper.weight == 0) return true;
    if (!modes_of(&c->scraper.response, s->output.sample_rate, p->arena, &m, e)) return false;
    if (m.n) add_body(p, &m, NULL, fabs(c->gain * c->scraper.weight), arena_format(p->arena, "%s%s", tool, which));
    return true;
}

static bool add_bodies(struct plot_page *p, const struct plot_summary *s, const char *effective, struct err *e)
{
    struct scene *scene = ARENA_TAKE(p->arena, struct scene, 1);
    const char *messages;
    char hex[HASH_TEXT];
    struct err why = {0};
    if (!*s->effective || access(effective, F_OK) != 0) return true;
    if (!hash_file(effective, hex, e)) return false;
    if (strcmp(hex, s->effective) != 0)
        err_set(&why, ERR_SCENE, "it is of another render: %s gives another sha256", s->file);
    else if (scene_read(effective, NULL, p->arena, scene, &messages, &why)) {
        p->bodies = ARENA_TAKE(p->arena, struct plot_body, 2 * scene->n_contacts);
        p->grounds = ARENA_TAKE(p->arena, struct plot_ground, scene->n_contacts);
        for (int i = 0; i < scene->n_contacts && !why.kind; i++)
            add_contact(p, scene, &scene->contacts[i], &why);
    }
    if (why.kind) {
        message_warning(p->call, effective, arena_format(p->call->arena, "what rings is not drawn: %s", why.text));
        p->n_bodies = p->n_grounds = 0;
    }
    return true;
}

/* ------------------------------------------------------------------ tables */

static bool table_rows(struct plot_page *p, const struct csv *csv, const double *times, struct plot_table *t,
                       struct err *e)
{
    int *rows = ARENA_TAKE(p->arena, int, PLOT_COLUMNS);
    t->time = ARENA_TAKE(p->arena, double, PLOT_COLUMNS);
    for (int k = 0; k < PLOT_TABLE_COLUMNS; k++)
        if (csv_column(csv, plot_names[k]) >= 0) t->x[k] = ARENA_TAKE(p->arena, double, PLOT_COLUMNS);
    for (size_t row = 0; row < csv->rows; row++) {
        double share = (times[row] - p->from) / (p->to - p->from) * PLOT_COLUMNS;
        if (!(share >= 0 && times[row] <= p->to)) continue;
        int at = (int)fmin(share, PLOT_COLUMNS - 1);
        t->time[at] += times[row];
        rows[at]++;
        for (int k = 0; k < PLOT_TABLE_COLUMNS; k++) {
            double v, *x = t->x[k] ? &t->x[k][at] : NULL;
            if (!x) continue;
            if (!csv_number(csv, row, csv_column(csv, plot_names[k]), &v, e)) return false;
            *x = k == PLOT_PEAK ? fmax(*x, fabs(v)) : *x + (k == PLOT_RMS ? v * v : v);
        }
    }
    /* Sums become means; columns of pixels without a row are left out. */
    for (int c = 0; c < PLOT_COLUMNS; c++) {
        if (rows[c] == 0) continue;
        t->time[t->n] = t->time[c] / rows[c];
        for (int k = 0; k < PLOT_TABLE_COLUMNS; k++) {
            if (!t->x[k]) continue;
            double v = k == PLOT_PEAK ? t->x[k][c] : t->x[k][c] / rows[c];
            t->x[k][t->n] = k == PLOT_RMS ? sqrt(v) : v;
            t->most[k] = fmax(t->most[k], fabs(t->x[k][t->n]));
        }
        t->n++;
    }
    return path_of_table(p, t->name, csv, times, e);
}

/* One table; the first sets the time shown when there is no sound. */
static bool table_add(struct plot_page *p, const char *path, const char *name, struct err *e)
{
    struct csv csv;
    struct plot_table *t = &p->tables[p->n_tables];
    t->name = name;
    if (!csv_table_read(path, p->arena, &csv, e)) return false;
    int column = csv_column(&csv, "time_s");
    size_t n = csv.rows;
    if (column < 0 || n == 0)
        return err_set(e, ERR_SCENE, "%s: %s: not a table of diagnostics", csv.file,
                       column < 0 ? "no column time_s" : "no rows");
    double *times = ARENA_TAKE(p->arena, double, n);
    for (size_t row = 0; row < n; row++)
        if (!csv_number(&csv, row, column, &times[row], e)) return false;
    double end = n > 1 ? times[n - 1] + (times[n - 1] - times[0]) / (double)(n - 1) : times[0];
    if ((!p->sound && !p->n_tables && !span_set(p, end, e)) || !table_rows(p, &csv, times, t, e)) return false;
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

/* The table of a contact ("": of the only one), as CSV or NPY, if it is there and of the same render. */
static bool table_find(struct plot_page *p, const struct plot_summary *s, const char *contact, struct err *e)
{
    for (int npy = 0; npy < 2; npy++) {
        const char *ending = npy ? "npy" : "csv",
                   *path = beside(p, *contact ? arena_format(p->arena, ".%s.%s", contact, ending)
                                     : npy    ? ".npy"
                                              : ".csv");
        if (access(path, F_OK) != 0) continue;
        const char *why;
        if (!s->lists) /* where it cannot be known to be of the same render it is taken to be */
            message_warning(p->call, path,
                            arena_format(p->call->arena, "%s %s: that the table is of the same render is assumed",
                                         s->file,
                                         s->there ? "does not say which files are of its render" : "is not there"));
        if (!s->lists || summary_has(s, path, contact, &why, e)) return table_add(p, path, contact, e);
        if (e->kind != ERR_NONE) return false;
        message_warning(p->call, path,
                        arena_format(p->call->arena, "left out, as it is of another render: %s %s", s->file, why));
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
    if (csv_column(&csv, "frequency_hz") >= 0 && csv_column(&csv, "mode") >= 0) {
        struct mode_table t;
        if (!isnan(p->from) || !isnan(p->to))
            return err_set(e, ERR_USAGE, "--%s: %s is a mode table, which has no time", isnan(p->from) ? "to" : "from",
                           p->file);
        if (!mode_table_read(p->file, p->arena, &t, e)) return false;
        struct plot_body *b = p->bodies = ARENA_TAKE(p->arena, struct plot_body, 1);
        *b = (struct plot_body){"", (int)t.modes, ARENA_TAKE(p->arena, struct plot_mode, t.modes)};
        for (size_t k = 0; k < t.first[t.places]; k++)
            for (int s = 0; s < t.entry[k].n; s++)
                count(&b->modes[t.entry[k].mode], t.entry[k].frequency, t.entry[k].slope[s].decay,
                      fabs(t.entry[k].slope[s].gain));
        const char *title = csv_comment(&t.csv, "title");
        p->title = p->title ? p->title : title ? title : p->file;
        p->n_bodies = 1;
        return p->table_of_modes = true;
    }
    if (csv_column(&csv, "stimulus_id") >= 0)
        return err_set(e, ERR_USAGE,
                       "%s: is the manifest of a set: rasp plot --gallery %s makes a page of all its sounds", p->file,
                       p->file);
    p->tables = ARENA_TAKE(p->arena, struct plot_table, 1);
    return table_add(p, p->file, "", e);
}

bool plot_data(struct plot_page *p, struct err *e)
{
    bool table = text_ends(p->file, ".csv") || text_ends(p->file, ".npy");
    struct plot_summary summary = plot_summary_read(beside(p, ".json"), p->arena);
    /* A summary of another render: what it says is not of the file that is shown, and is not used. */
    const char *why = "lists no sound";
    bool ours = !summary.lists || (table ? summary_has(&summary, p->file, "", &why, e) : summary.sounds);
    if (!ours && e->kind == ERR_NONE)
        message_warning(
            p->call, p->file,
            arena_format(p->call->arena, "%s is of another render (it %s), and is not used", summary.file, why));
    const char *title = p->file; /* "glass_1Hz: a tool scraped back and forth": of a set all have the same title */
    if (*summary.title && ours)
        title = arena_format(p->arena, "%s: %s", relpath_stem(p->file, p->arena), summary.title);
    if (e->kind != ERR_NONE) return false;
    if (table ? !table_alone(p, e) : !sound_gather(p, e) || !(!ours || tables_find(p, &summary, e))) return false;
    if (!p->title) p->title = title;
    if (ours && !p->table_of_modes && !add_bodies(p, &summary, beside(p, ".scene.yaml"), e)) return false;
    bool anything = false;
    for (int k = 0; k < PLOT_PANELS; k++)
        anything = anything || plot_panels_there(p, k);
    static const char *const lacks[PLOT_PANELS] = {
        "a sound (a WAV)",
        "a sound (a WAV)",
        "a table of diagnostics of the same render with contact forces (in the scene: output: {diagnostics: {rate: 1 "
        "kHz}})",
        "a table of diagnostics of the same render with the normal force or alpha (in the scene: output: {diagnostics: "
        "{rate: 1 kHz}})",
        "a table of diagnostics of the same render that names ground_m or trajectory_m (in the scene: output: "
        "{diagnostics: {columns: [time_s, ground_m, trajectory_m]}})",
        "a contact that moves, by a table of diagnostics with x_m and y_m, or by the .scene.yaml and .json of the "
        "render beside the sound",
        "a mode table, or, beside a sound, the .scene.yaml and .json of its render, whose responses are modes",
        NULL};
    for (int k = 0; k < PLOT_PANELS; k++)
        if (p->asked >> k & 1 && !has_data(p, k))
            return err_set(e, ERR_SCENE, "%s: the panel %s needs %s", p->file, plot_panels_words[k],
                           lacks[k == PLOT_DECAYS ? PLOT_MODES : k]);
    if (anything) return true;
    return err_set(e, ERR_SCENE, "%s: has none of the columns that are drawn (%s, %s, %s, %s, %s, %s)", p->file,
                   plot_names[PLOT_PEAK], plot_names[PLOT_RMS], plot_names[PLOT_NORMAL], plot_names[PLOT_ALPHA],
                   plot_names[PLOT_GROUND], plot_names[PLOT_TRAJECTORY]);
}

/* rasp plot: a picture of a render or mode table, or a page of pictures of many. */

static const struct args_option plot_options[] = {
    {"output", 'o', "FILE", false,
     "where to write; default: NAME.png beside NAME.wav, or NAME.svg; of a gallery gallery.html in the folder"},
    {"panels", 'p', "PANEL,...", false,
     "which of waveform, spectrogram, force, normal, trajectory, motion, modes and decays; default: all that there are "
     "data for"},
    {"gallery", 'g', NULL, false,
     "a page of HTML for a folder of sounds, or for the manifest.csv of a set: a spectrogram, the sound and the "
     "factors "
     "of each"},
    {"jobs", 'j', "N", false, "how many pictures of a gallery are made at once, 1 to 256; default: one for each core"},
    {"format", 'f', "png|svg", false, "format of the picture; default: by the output's ending, else png"},
    {"title", 't', "TEXT", false,
     "title; default: the file's name and the scene's title, if its summary lies beside the sound, else the file's "
     "name; of a gallery the design's title, else the folder's name"},
    {"from", 0, "SECONDS", false, "start of the time shown; default: 0"},
    {"channel", 'c', "N", false,
     "which channel of the sound, from 1 (of several listening places each is one); default: 1"},
    {"to", 0, "SECONDS", false, "end of the time shown; default: the end of the sound"},
    {"force", 0, NULL, false, "replaces a file that rasp did not draw, or writes through a link"},
    {0},
};

/* A picture takes the place of no file that the sound was made from. */
static bool plot_spares(const struct plot_page *p, const char *target, struct err *e)
{
    struct scene scene;
    struct stat t;
    struct err unreadable = {0};
    static const char *const endings[] = {".wav", ".flac", ".csv", ".npy", ".json", ".scene.yaml"};
    const char *effective = arena_format(p->arena, "%s.scene.yaml", relpath_base(p->file, p->arena)), *messages;
    int n = 0;
    const struct outputs_source *sources = NULL;
    if (stat(target, &t) != 0) return true;
    for (int i = 0; i < 6; i++) { /* nor of the sound, or what lies beside it */
        const char *file = arena_format(p->arena, "%s%s", relpath_base(p->file, p->arena), endings[i]);
        if (cmd_same_file(file, target))
            return err_set(e, ERR_CREATE,
                           "%s: the picture would overwrite %s, which it shows; write elsewhere: -o OTHER.png", target,
                           file);
    }
    if (access(effective, F_OK) == 0 && scene_read(effective, NULL, p->arena, &scene, &messages, &unreadable))
        sources = outputs_sources(&scene, &n, p->arena);
    for (int i = 0; i < n; i++)
        if (sources[i].device == t.st_dev && sources[i].inode == t.st_ino)
            return err_set(e, ERR_CREATE,
                           "%s: the picture would overwrite an input of %s (%s); write elsewhere: -o OTHER.png", target,
                           effective, sources[i].what);
    return true;
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
    if (args_given(&c->args, "gallery")) return plot_gallery_run(c, e);
    if (!wav_is_name(p.file) && !text_ends(p.file, ".csv") && !text_ends(p.file, ".npy"))
        return err_set(e, ERR_USAGE,
                       "%s: neither a sound (.wav) nor a table of diagnostics (.csv, .npy) or modes (.csv); of a "
                       "folder --gallery makes a page",
                       p.file),
               (int)e->kind;
    static const char *const formats[] = {"png", "svg"};
    const char *o = args_value(&c->args, "output");
    int svg = o && text_ends(o, ".svg");
    if (!cmd_either(c, "format", formats, &svg, e)) return (int)e->kind;
    if (o && !text_ends(o, ".png") && !text_ends(o, ".svg"))
        return err_set(e, ERR_USAGE, "--output %s: must end in .png or .svg", o), (int)e->kind;
    if (o && !text_ends(o, svg ? ".svg" : ".png"))
        return err_set(e, ERR_USAGE, "--output %s: does not end in .%s, the format that is asked for", o, formats[svg]),
               (int)e->kind;
    p.svg = svg;
    if (!plot_panels_read(args_value(&c->args, "panels"), &p.asked, c->arena, e) ||
        !args_number(&c->args, "from", range, &p.from, e) || !args_number(&c->args, "to", range, &p.to, e) ||
        !args_whole(&c->args, "channel", (const long[2]){1, 1024}, &channel, e))
        return (int)e->kind;
    p.channel = (int)channel;
    const char *target = o ? o : arena_format(c->arena, "%s.%s", relpath_base(p.file, c->arena), formats[svg]);
    if (!plot_data(&p, e) || !plot_spares(&p, target, e) ||
        !mark_permits(target, NULL, args_given(&c->args, "force"), e) ||
        !gnuplot_write(target, p.svg, plot_draw, &p, e))
        return (int)e->kind;
    printf("%s ", target);
    /* what the page shows, as a line */
    static const char *const names[PLOT_PANELS] = {"waveform",   "spectrogram", "contact force", "normal force",
                                                   "trajectory", "motion",      "modes",         "decays"};
    const char *comma = "";
    for (int k = 0; k < PLOT_PANELS; k++)
        if (plot_panels_there(&p, k)) {
            fprintf(stdout, "%s %s%s", comma, names[k],
                    k == PLOT_HAND && plot_data_has(&p, PLOT_ALPHA) ? ", alpha" : "");
            comma = ",";
        }
    fputc('\n', stdout);
    return 0;
}

const struct command plot_command = {
    .name = "plot",
    .summary = "draws a render: waveform, spectrogram, forces, motion, modes",
    .does = "For NAME.wav this writes NAME.png. On one time axis there are the waveform and the spectrogram (Hann "
            "window of 20 ms, the 80 dB below the loudest place, up to 20 kHz). From the diagnostics beside it "
            "(NAME.csv, NAME.npy, or NAME.CONTACT.csv) come the contact force and the normal force with alpha. The "
            "ground with the limited trajectory follows where the table has them. Below them is the way of the "
            "contact from above, coloured by speed. Last come the modes of what rings (NAME.scene.yaml): stems of "
            "their largest gain on that way, coloured by their time of decay.\n"
            "A table that is not of the same render, by the hashes in NAME.json, is left out with a warning. Without "
            "NAME.json it is taken to be. Panels without data are left out, and what was drawn is printed. For "
            "NAME.csv or NAME.npy, of a render without sound, what the table has is drawn. A mode table gives the "
            "modes, and their decays over frequency. Of several channels one is drawn. All this needs gnuplot.\n"
            "With --gallery the operand is a folder that rasp batch made, or its manifest.csv, or any folder of "
            "sounds. The page shows every stimulus in a table, with its factors, a small spectrogram and a player. "
            "Rows can be sorted and filtered, and two sounds can be marked and compared. The page lists its keys. All "
            "spectrograms have the same axes: the longest sound's time, and frequency from 50 Hz to half the sample "
            "rate or 20 kHz. All show the 80 dB below the loudest place of all sounds, of the first channel.\n"
            "They are made anew, into a folder beside the page: gallery/ of gallery.html. Sounds are linked where "
            "they are. The page needs neither gnuplot nor a network.",
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
