/* A mode table: its comments, its rows gathered into one entry per place and mode, and what shared
   or separate poles ask of the entries. */
#include "response/mode_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/text.h"
#include "file/csv.h"
#include "num/real.h"
#include "response/slopes.h"

/* The rows of a mode table's CSV: which columns there are, their numbers, and which rows belong together. */

/* In the order of the three forms' columns; those of an envelope table stand in for decay and gain. */
enum { PLACE, X, Y, MODE, FREQUENCY, DECAY, GAIN, PHASE, SLOPE, COLUMNS, TIME = DECAY, AMPLITUDE = GAIN };

struct rows {
    const struct csv *csv;
    bool envelope, slopes; /* the form */
    int column[COLUMNS];
    size_t places, modes;
    size_t *place, *mode; /* [rows] number of each: places by x, then y, modes by lowest frequency, then names */
    double *value;        /* [rows][COLUMNS] numbers, SI */
    size_t *order;        /* [rows] rows by place, mode, then slope or time */
};

/* Reading the rows of a mode table and saying, with file and line, what is wrong with one. */

static const char *const plain_names[COLUMNS] = {"place",       "x_m",  "y_m",       "mode", "frequency_hz",
                                                 "decay_per_s", "gain", "phase_rad", "slope"};
static const char *const envelope_names[COLUMNS] = {"place",  "x_m",       "y_m",       "mode", "frequency_hz",
                                                    "time_s", "amplitude", "phase_rad", ""};

static const char *cell_of(const struct rows *r, size_t row, int c)
{
    return r->csv->cells[row * r->csv->columns + (size_t)r->column[c]];
}

static const double *values_of(const struct rows *r, size_t row) { return r->value + row * COLUMNS; }

/* Puts "file:line: " before an error; returns false. */
static bool bad_row(const struct rows *r, size_t row, struct err *e)
{
    return err_at(e, "%s:%d", r->csv->file, r->csv->lines[row]);
}

/* ------------------------------------------------------------------ header */

static bool no_column(const struct rows *r, int c, struct err *e)
{
    if (r->envelope)
        return err_set(e, ERR_SCENE,
                       "%s: a table of envelopes needs the column '%s'; its columns are place, x_m, y_m, mode, "
                       "frequency_hz, time_s, amplitude, phase_rad",
                       r->csv->file, envelope_names[c]);
    return err_set(e, ERR_SCENE,
                   "%s: a mode table needs the column '%s'; its columns are place, x_m, y_m, mode, frequency_hz, "
                   "decay_per_s, gain, phase_rad",
                   r->csv->file, plain_names[c]);
}

static bool find_columns(struct rows *r, struct err *e)
{
    const struct csv *t = r->csv;
    if (t->columns == 1 && t->names[0][strcspn(t->names[0], ";\t")])
        return err_set(
            e, ERR_SCENE,
            "%s: the columns are separated by semicolons or tabs; a mode table wants commas (and decimal points)",
            t->file);
    r->envelope = csv_column(t, "time_s") >= 0 || csv_column(t, "amplitude") >= 0;
    r->slopes = !r->envelope && csv_column(t, "slope") >= 0;
    size_t wanted = r->slopes ? COLUMNS : SLOPE;
    for (int c = 0; c < (int)wanted; c++)
        if ((r->column[c] = csv_column(t, r->envelope ? envelope_names[c] : plain_names[c])) < 0)
            return no_column(r, c, e);
    if (t->columns != wanted)
        return err_set(e, ERR_SCENE,
                       "%s: %zu columns where a mode table has %zu (place, x_m, y_m, mode, frequency_hz, %s, "
                       "phase_rad%s); remove the others",
                       t->file, t->columns, wanted, r->envelope ? "time_s, amplitude" : "decay_per_s, gain",
                       r->slopes ? ", slope" : "");
    if (t->rows == 0) return err_set(e, ERR_SCENE, "%s: a mode table without modes; give at least one row", t->file);
    return true;
}

/* ------------------------------------------------------------------ numbers */

static bool whole(double x) { return x >= 1.0 && x <= 100.0 && x == floor(x); }

static bool check_values(const struct rows *r, const double *v, struct err *e)
{
    if (!(v[FREQUENCY] > 0.0))
        return err_set(e, ERR_SCENE, "frequency_hz is %g, and must be above 0: take the row out, or correct it",
                       v[FREQUENCY]);
    if (!r->envelope && !(v[DECAY] >= 0.0))
        return err_set(e, ERR_SCENE, "decay_per_s %g must not be negative: the mode would grow for ever", v[DECAY]);
    if (r->envelope && !(v[TIME] >= 0.0 && v[TIME] <= 3600.0))
        return err_set(e, ERR_SCENE, "time_s %g must lie between 0 (the impulse) and 3600", v[TIME]);
    if (!(fabs(v[X]) <= 1000.0 && fabs(v[Y]) <= 1000.0))
        return err_set(e, ERR_SCENE,
                       "the place (%g, %g) m lies farther than 1000 m from the origin; give x_m and y_m in metres",
                       v[X], v[Y]);
    if (!whole(v[SLOPE])) return err_set(e, ERR_SCENE, "slope %g is not a whole number from 1 to 100", v[SLOPE]);
    return true;
}

static bool read_numbers(struct rows *r, struct arena *a, struct err *e)
{
    r->value = ARENA_TAKE(a, double, r->csv->rows *COLUMNS);
    for (size_t i = 0; i < r->csv->rows; i++) {
        double *v = r->value + i * COLUMNS;
        v[SLOPE] = 1.0;
        for (int c = 0; c < (r->slopes ? COLUMNS : SLOPE); c++)
            if (c != PLACE && c != MODE && !csv_number(r->csv, i, r->column[c], &v[c], e)) return false;
        if (!check_values(r, v, e)) return bad_row(r, i, e);
    }
    return true;
}

/* ------------------------------------------------------------------ ids */

struct label {
    const char *text;
    size_t row;
};

static int label_order(const void *a, const void *b)
{
    const struct label *p = a, *q = b;
    int texts = strcmp(p->text, q->text);
    return texts ? texts : (p->row > q->row) - (p->row < q->row);
}

/* Numbers the different texts of a column in order of first appearance; returns how many there are. */
static size_t number_labels(const struct rows *r, int c, struct arena *a, size_t *id)
{
    size_t rows = r->csv->rows, n = 0;
    struct label *l = ARENA_TAKE(a, struct label, rows);
    for (size_t i = 0; i < rows; i++)
        l[i] = (struct label){cell_of(r, i, c), i};
    qsort(l, rows, sizeof *l, label_order);
    for (size_t i = 0, first = 0; i < rows; i++) {
        if (strcmp(l[i].text, l[first].text) != 0) first = i;
        id[l[i].row] = l[first].row;
    }
    for (size_t i = 0; i < rows; i++)
        id[i] = id[i] == i ? n++ : id[id[i]];
    return n;
}

struct number {
    double first, second;
    const char *text;
    size_t old;
};

static int number_order(const void *a, const void *b)
{
    const struct number *p = a, *q = b;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    if (p->second != q->second) return p->second < q->second ? -1 : 1;
    return strcmp(p->text, q->text);
}

/* Numbers anew what has been numbered as it appeared: places by x, then y; modes by their lowest frequency; what is
   equal in that, by name. So nothing that follows can depend on the order of rows. */
static void renumber(const struct rows *r, int c, struct arena *a)
{
    size_t n = c == PLACE ? r->places : r->modes, *id = c == PLACE ? r->place : r->mode, *to = ARENA_TAKE(a, size_t, n);
    struct number *s = ARENA_TAKE(a, struct number, n);
    for (size_t i = r->csv->rows; i-- > 0;) {
        const double *v = values_of(r, i);
        struct number *at = &s[id[i]];
        double lowest = at->text ? fmin(at->first, v[FREQUENCY]) : v[FREQUENCY];
        *at = (struct number){c == PLACE ? v[X] : lowest, c == PLACE ? v[Y] : 0.0, cell_of(r, i, c), id[i]};
    }
    qsort(s, n, sizeof *s, number_order);
    for (size_t k = 0; k < n; k++)
        to[s[k].old] = k;
    for (size_t i = 0; i < r->csv->rows; i++)
        id[i] = to[id[i]];
}

/* ------------------------------------------------------------------ order */

struct key {
    size_t place, mode, row;
    double within; /* slope, or time */
};

static int key_order(const void *a, const void *b)
{
    const struct key *p = a, *q = b;
    if (p->place != q->place) return p->place < q->place ? -1 : 1;
    if (p->mode != q->mode) return p->mode < q->mode ? -1 : 1;
    if (p->within != q->within) return p->within < q->within ? -1 : 1;
    return (p->row > q->row) - (p->row < q->row);
}

static bool duplicate(const struct rows *r, const struct key *p, const struct key *q, struct err *e)
{
    char what[32] = "";
    if (r->envelope)
        snprintf(what, sizeof what, "the time %.9g s of ", p->within);
    else if (r->slopes)
        snprintf(what, sizeof what, "slope %.0f of ", p->within);
    return err_set(e, ERR_SCENE, "%s:%d: place '%.60s' has %smode '%.60s' again, after line %d: remove one of the two",
                   r->csv->file, r->csv->lines[q->row], cell_of(r, q->row, PLACE), what, cell_of(r, q->row, MODE),
                   r->csv->lines[p->row]);
}

static bool sort_rows(struct rows *r, struct arena *a, struct err *e)
{
    size_t rows = r->csv->rows;
    struct key *k = ARENA_TAKE(a, struct key, rows);
    r->order = ARENA_TAKE(a, size_t, rows);
    for (size_t i = 0; i < rows; i++)
        k[i] = (struct key){r->place[i], r->mode[i], i, r->value[i * COLUMNS + (r->envelope ? TIME : SLOPE)]};
    qsort(k, rows, sizeof *k, key_order);
    for (size_t i = 0; i < rows; i++) {
        if (i && k[i - 1].place == k[i].place && k[i - 1].mode == k[i].mode &&
            k[i].within - k[i - 1].within < (r->envelope ? 1e-9 : 0.5)) /* the fit must tell times apart */
            return duplicate(r, &k[i - 1], &k[i], e);
        r->order[i] = k[i].row;
    }
    return true;
}

/* A place is at one point, that of its first row. */
static bool check_points(const struct rows *r, struct arena *a, struct err *e)
{
    size_t *first = ARENA_TAKE(a, size_t, r->places), seen = 0;
    for (size_t i = 0; i < r->csv->rows; i++) {
        if (r->place[i] == seen) first[seen++] = i;
        size_t o = first[r->place[i]];
        const double *v = values_of(r, i), *w = values_of(r, o);
        if (v[X] != w[X] || v[Y] != w[Y])
            return err_set(e, ERR_SCENE,
                           "place '%.60s' is at (%g, %g) m here and at (%g, %g) m in line %d: make both the same",
                           cell_of(r, i, PLACE), v[X], v[Y], w[X], w[Y], r->csv->lines[o]) ||
                   bad_row(r, i, e);
    }
    return true;
}

/* Columns, numbers and their ranges, one point per place, no row twice. */
static bool rows_read(const struct csv *csv, struct arena *a, struct rows *r, struct err *e)
{
    *r = (struct rows){.csv = csv};
    if (!find_columns(r, e) || !read_numbers(r, a, e)) return false;
    r->place = ARENA_TAKE(a, size_t, csv->rows);
    r->mode = ARENA_TAKE(a, size_t, csv->rows);
    r->places = number_labels(r, PLACE, a, r->place);
    r->modes = number_labels(r, MODE, a, r->mode);
    if (!check_points(r, a, e)) return false;
    renumber(r, PLACE, a);
    renumber(r, MODE, a);
    return sort_rows(r, a, e);
}

/* Sampled envelopes of a mode table as slopes: each place's own, or where poles are shared one set of decays for a mode
 * at all places. */

struct envelopes {
    const struct rows *r;
    struct mode_table *t;
    const size_t *from;
    double worst; /* error, relative */
    size_t worst_row;
    int poor; /* above -40 dB */
};

static double decibel(double error) { return 20.0 * real_log10(error); }

static bool lay_out(struct arena *a, const struct envelopes *v, size_t entry, struct slopes_series *s, struct err *e)
{
    size_t n = v->from[entry + 1] - v->from[entry];
    double *time = ARENA_TAKE(a, double, n), *amplitude = ARENA_TAKE(a, double, n);
    for (size_t i = 0; i < n; i++) {
        const double *w = values_of(v->r, v->r->order[v->from[entry] + i]);
        time[i] = w[TIME];
        amplitude[i] = w[AMPLITUDE];
    }
    *s = (struct slopes_series){(int)n, time, amplitude, {0}};
    if (n >= 2) return true;
    return err_set(e, ERR_SCENE, "the envelope of mode '%.60s' at place '%.60s' has one sample; give at least 2",
                   cell_of(v->r, v->t->entry[entry].row, MODE), cell_of(v->r, v->t->entry[entry].row, PLACE)) ||
           bad_row(v->r, v->t->entry[entry].row, e);
}

static bool judge(struct envelopes *v, size_t row, double error, struct err *e)
{
    v->poor += error > 0.01;
    if (error > v->worst) {
        v->worst = error;
        v->worst_row = row;
    }
    if (!(error > 0.1)) return true;
    return err_set(e, ERR_SCENE,
                   "the envelope of mode '%.60s' is met by decaying exponentials to %.1f dB only, which is above -20 "
                   "dB; give "
                   "it as it decays, without what precedes the rise, or as several modes",
                   cell_of(v->r, row, MODE), decibel(error)) ||
           bad_row(v->r, row, e);
}

/* Fits the envelopes of n entries with the same decays. */
static bool fit(struct envelopes *v, struct arena *a, const size_t *entries, int n, struct err *e)
{
    struct slopes_series *s = ARENA_TAKE(a, struct slopes_series, n);
    for (int i = 0; i < n; i++)
        if (!lay_out(a, v, entries[i], &s[i], e)) return false;
    struct slopes_fit f = slopes_fit(s, n);
    for (int i = 0; i < n; i++) {
        struct mode_entry *m = &v->t->entry[entries[i]];
        double phase = values_of(v->r, m->row)[PHASE];
        m->n = f.n;
        m->slope = ARENA_TAKE(a, struct mode_slope, f.n);
        for (int k = 0; k < f.n; k++)
            m->slope[k] = (struct mode_slope){f.decay[k], s[i].gain[k], phase};
    }
    return judge(v, v->t->entry[entries[0]].row, f.error, e);
}

/* Fits the slopes of every entry of t; entry k has the rows r->order[from[k]] to before r->order[from[k + 1]]. Sets
   t->note where a fit is not met to -40 dB; ERR_SCENE: not to -20 dB, or less than two samples. With shared poles every
   place must have every mode. */
static bool envelopes_fit(const struct rows *r, const size_t *from, struct arena *a, struct mode_table *t,
                          struct err *e)
{
    struct envelopes all = {.r = r, .t = t, .from = from}, *v = &all;
    size_t entries = v->t->first[v->t->places], *same = ARENA_TAKE(a, size_t, v->t->places);
    for (size_t k = 0; k < (v->t->shared ? v->t->modes : entries); k++) {
        for (size_t p = 0; v->t->shared && p < v->t->places; p++)
            same[p] = v->t->first[p] + k; /* every place has every mode */
        if (!fit(v, a, v->t->shared ? same : &k, v->t->shared ? (int)v->t->places : 1, e)) return false;
    }
    if (v->poor)
        v->t->note = arena_format(a,
                                  "%s:%d: the envelope of mode '%.60s' is met by decaying exponentials to %.1f dB "
                                  "only; %d of %zu are not met to -40 dB",
                                  v->r->csv->file, v->r->csv->lines[v->worst_row], cell_of(v->r, v->worst_row, MODE),
                                  decibel(v->worst), v->poor, v->t->shared ? v->t->modes : entries);
    return true;
}

/* Writing a mode table: A = gain e^(j phase). Twelve digits of closed forms: what a reader
   needs (relative error 5e-13), and less than what the last bits of sums would show. */

void mode_table_write_header(FILE *f) { fputs("place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n", f); }

static double unsigned_zero(double x) { return x == 0.0 ? 0.0 : x; }

void mode_table_write_place(FILE *f, const struct mode_table_place *place, int n, const int *order,
                            const struct modes_point *p, int quantity)
{
    for (int k = 0; k < n; k++) {
        int i = order[k];
        double along = quantity == MODES_VELOCITY ? p->im[i] : quantity == MODES_ACCELERATION ? -p->re[i] : p->re[i];
        double sign = along < 0.0 ? -1.0 : 1.0, gain = sign * sqrt(p->re[i] * p->re[i] + p->im[i] * p->im[i]);
        double phase = gain != 0.0 ? real_atan2(sign * p->im[i], sign * p->re[i]) : 0.0;
        int d = place->digits;
        fprintf(f, "%d,%.*g,%.*g,%d,%.*g,%.*g,%.*g,%.*g\n", place->id, d, unsigned_zero(place->x), d,
                unsigned_zero(place->y), k + 1, d, p->frequency[i], d, p->decay[i], d, unsigned_zero(gain), d,
                unsigned_zero(phase));
    }
}

/* ------------------------------------------------------------------ comments */

/* The comment's value; NULL where it is not given, and an error when it is given twice. */
static bool comment(const struct csv *t, const char *key, const char **value, struct err *e)
{
    int given = 0;
    for (size_t i = 0; i < t->n_comments; i++)
        given += strcmp(t->comments[i].key, key) == 0;
    *value = csv_comment(t, key);
    return given < 2 || err_set(e, ERR_SCENE,
                                "%s: the comment '# %s: ...' is given more than once; write it once, before the header",
                                t->file, key);
}

/* by_frequency: -1 where the table does not say. */
static bool read_comments(struct mode_table *t, int *by_frequency, struct err *e)
{
    enum { POLES, QUANTITY, PAIRING, GAINS, KEYS };
    static const struct {
        const char *key, *needed; /* NULL: it may be left out */
        const char *const words[4];
    } rows[KEYS] = {
        {"poles", "shared or separate", {"shared", "separate"}},
        {"quantity", "displacement, velocity or acceleration", {"displacement", "velocity", "acceleration"}},
        {"pairing", NULL, {"ids", "frequency"}},
        {"gains", NULL, {"logarithmic", "complex"}}};
    const char *value[KEYS];
    int index[KEYS] = {-1, -1, -1, -1};
    *by_frequency = -1;
    for (int k = 0; k < KEYS; k++) {
        if (!comment(&t->csv, rows[k].key, &value[k], e)) return false;
        if (!value[k] && rows[k].needed)
            return err_set(e, ERR_SCENE,
                           "%s: the comment '# %s: ...' is missing; write it once, before the header (%s)%s",
                           t->csv.file, rows[k].key, rows[k].needed,
                           t->csv.n_comments ? "" : "; is it a table of modes? rasp modes makes them");
    }
    for (int k = 0; k < KEYS; k++) {
        const char *const *words = rows[k].words;
        if (!value[k]) continue;
        for (index[k] = 0; words[index[k]] && strcmp(value[k], words[index[k]]) != 0;)
            index[k]++;
        if (words[index[k]]) continue;
        return k == QUANTITY ? err_set(e, ERR_SCENE,
                                       "%s: quantity: '%.60s' is not displacement, velocity or acceleration (per N s): "
                                       "write one of them",
                                       t->csv.file, value[k])
                             : err_set(e, ERR_SCENE, "%s: %s: '%.60s' is neither %s nor %s", t->csv.file, rows[k].key,
                                       value[k], words[0], words[1]);
    }
    *by_frequency = index[PAIRING];
    t->quantity = index[QUANTITY];
    t->shared = index[POLES] == 0;
    t->complex = index[GAINS] == 1;
    if (t->shared && index[GAINS] == 0)
        return err_set(e, ERR_SCENE,
                       "%s: gains: logarithmic is for separate poles; those of shared ones pass zero at nodal lines: "
                       "remove that line",
                       t->csv.file);
    if (t->shared && *by_frequency == 1)
        return err_set(
            e, ERR_SCENE,
            "%s: pairing: frequency is for separate poles; with shared ones a mode has the same id at every place",
            t->csv.file);
    t->radius = NAN;
    const char *radius;
    if (!comment(&t->csv, "radius_m", &radius, e)) return false;
    if (radius && !(text_double(radius, &t->radius) && t->radius > 0.0 && t->radius <= 1000.0))
        return err_set(e, ERR_SCENE, "%s: radius_m: '%.60s' is not a number above 0, at most 1000 (metres)",
                       t->csv.file, radius);
    return true;
}

/* ------------------------------------------------------------------ entries */

static int slope_order(const void *a, const void *b)
{
    const struct mode_slope *p = a, *q = b;
    return (p->decay > q->decay) - (p->decay < q->decay);
}

/* Rows of one place and mode: one frequency, and of an envelope one phase. */
static bool one_mode(const struct rows *r, const size_t *rows, size_t n, struct err *e)
{
    const double *v = values_of(r, rows[0]);
    for (size_t i = 1; i < n; i++) {
        const double *w = values_of(r, rows[i]);
        if (w[FREQUENCY] == v[FREQUENCY] && (!r->envelope || w[PHASE] == v[PHASE])) continue;
        return err_set(e, ERR_SCENE,
                       "mode '%.60s' of place '%.60s' has frequency %.12g Hz and phase %.12g here, %.12g Hz and %.12g "
                       "in line "
                       "%d; %s",
                       cell_of(r, rows[i], MODE), cell_of(r, rows[i], PLACE), w[FREQUENCY], w[PHASE], v[FREQUENCY],
                       v[PHASE], r->csv->lines[rows[0]],
                       r->envelope ? "an envelope belongs to one frequency and phase: write the same ones"
                                   : "the slopes of a mode have one frequency") ||
               bad_row(r, rows[i], e);
    }
    return true;
}

/* One entry per place and mode; slopes of an envelope table are fitted later. *from: [entries] where its rows begin in
 * r->order. */
static bool gather(const struct rows *r, struct arena *a, struct mode_table *t, size_t **from, struct err *e)
{
    size_t rows = r->csv->rows, n = 0;
    t->entry = ARENA_TAKE(a, struct mode_entry, rows);
    t->first = ARENA_TAKE(a, size_t, r->places + 1);
    *from = ARENA_TAKE(a, size_t, rows + 1);
    for (size_t i = 0, end; i < rows; i = end) {
        const size_t *row = r->order + i;
        for (end = i + 1;
             end < rows && r->place[r->order[end]] == r->place[*row] && r->mode[r->order[end]] == r->mode[*row];)
            end++;
        struct mode_entry *m = &t->entry[n];
        *m = (struct mode_entry){r->place[*row], r->mode[*row], *row, values_of(r, *row)[FREQUENCY],
                                 (int)(end - i), NULL};
        (*from)[n++] = i;
        (*from)[n] = end;
        t->first[m->place + 1] = n;
        if (!one_mode(r, row, end - i, e)) return false;
        if (r->envelope) continue;
        m->slope = ARENA_TAKE(a, struct mode_slope, end - i);
        for (int k = 0; k < m->n; k++) {
            const double *v = values_of(r, row[k]);
            m->slope[k] = (struct mode_slope){v[DECAY], v[GAIN], v[PHASE]};
        }
        qsort(m->slope, (size_t)m->n, sizeof *m->slope, slope_order);
    }
    return true;
}

static void take_places(const struct rows *r, struct arena *a, struct mode_table *t)
{
    t->places = r->places;
    t->modes = r->modes;
    t->xy = ARENA_TAKE(a, double, 2 * r->places);
    t->row = ARENA_TAKE(a, size_t, r->places);
    for (size_t i = r->csv->rows; i-- > 0;) {
        const double *v = values_of(r, i);
        t->row[r->place[i]] = i;
        t->xy[2 * r->place[i]] = v[X];
        t->xy[2 * r->place[i] + 1] = v[Y];
    }
}

/* ------------------------------------------------------------------ poles */

static bool missing(const struct rows *r, const struct mode_table *t, size_t place, size_t mode, struct err *e)
{
    size_t first = 0;
    while (r->mode[first] != mode)
        first++;
    return err_set(e, ERR_SCENE,
                   "%s:%d: place '%.60s', which starts here, has no mode '%.60s'; every place needs every mode (a mode "
                   "that is silent there has gain 0)",
                   t->csv.file, t->csv.lines[t->row[place]], cell_of(r, t->row[place], PLACE), cell_of(r, first, MODE));
}

/* Returns the first mode the place lacks, or their number. */
static size_t lacks(const struct mode_table *t, size_t place)
{
    size_t n = t->first[place + 1] - t->first[place], k = 0;
    while (k < n && t->entry[t->first[place] + k].mode == k)
        k++;
    return k;
}

static bool unequal(double a, double b) { return fabs(a - b) > 1e-9 * fmax(fabs(a), fabs(b)); }

static bool same_poles(const struct rows *r, const struct mode_entry *m, const struct mode_entry *w, struct err *e)
{
    if (m->n != w->n)
        return err_set(e, ERR_SCENE,
                       "mode '%.60s' has %d slopes at this place, %d at that of line %d; with shared poles they are as "
                       "many "
                       "at every place",
                       cell_of(r, m->row, MODE), m->n, w->n, r->csv->lines[w->row]) ||
               bad_row(r, m->row, e);
    for (int k = 0; k < m->n; k++)
        if (unequal(m->frequency, w->frequency) || unequal(m->slope[k].decay, w->slope[k].decay))
            return err_set(e, ERR_SCENE,
                           "mode '%.60s' has frequency %.12g Hz and decay %.12g/s here, %.12g Hz and %.12g/s in line "
                           "%d; with "
                           "shared poles they are the same at every place: correct one, or let the table say # poles: "
                           "separate",
                           cell_of(r, m->row, MODE), m->frequency, m->slope[k].decay, w->frequency, w->slope[k].decay,
                           r->csv->lines[w->row]) ||
                   bad_row(r, m->row, e);
    return true;
}

/* Names that several places have: do most of them stand for nearly the same frequency wherever they do? Numbers that
   each place gives anew do not, from the first mode on that one place lacks. */
static bool names_hold(const struct mode_table *t)
{
    size_t again = 0, near = 0;
    for (size_t i = 0; i < t->first[t->places]; i++)
        for (size_t j = 0; j < i; j++)
            if (t->entry[j].mode == t->entry[i].mode) {
                again++;
                near += fabs(t->entry[i].frequency - t->entry[j].frequency) < 0.12 * t->entry[j].frequency;
                break;
            }
    return 2 * near > again;
}

/* Names differ from place to place, and the table does not say what that means. */
static void guess_pairing(struct mode_table *t, struct arena *a)
{
    bool hold = names_hold(t), again = t->modes < t->first[t->places];
    t->by_frequency = !hold;
    if (again)
        t->note = arena_format(a,
                               "%s: not every place has the same modes; they are paired by %s; say \"# pairing: %s\" "
                               "above the table's header to keep to that, or \"# pairing: %s\"",
                               t->csv.file, hold ? "name" : "frequency, for their names do not hold",
                               hold ? "ids" : "frequency", hold ? "frequency" : "ids");
}

static bool read_entries(struct mode_table *t, int by_frequency, struct arena *a, struct err *e)
{
    struct rows r;
    size_t *from, whole = 0;
    if (!rows_read(&t->csv, a, &r, e) || !gather(&r, a, t, &from, e)) return false;
    take_places(&r, a, t);
    for (size_t p = 0, k; p < t->places; p++, whole += k == t->modes)
        if ((k = lacks(t, p)) < t->modes && t->shared) return missing(&r, t, p, k, e);
    t->by_frequency = by_frequency > 0;
    if (by_frequency < 0 && whole < t->places) guess_pairing(t, a);
    if (r.envelope && !envelopes_fit(&r, from, a, t, e)) return false;
    for (size_t i = 0; t->shared && i < t->first[t->places]; i++)
        if (!same_poles(&r, &t->entry[i], &t->entry[t->entry[i].mode], e)) return false;
    for (size_t i = 0; !t->shared && t->places > 1 && i < t->first[t->places]; i++)
        if (!(t->entry[i].slope[0].decay > 0.0))
            return err_set(e, ERR_SCENE,
                           "decay_per_s is 0: separate poles are interpolated between places in the log, where 0 has "
                           "no value; give a small decay") ||
                   bad_row(&r, t->entry[i].row, e);
    return true;
}

bool mode_table_read(const char *path, struct arena *a, struct mode_table *t, struct err *e)
{
    int by_frequency;
    *t = (struct mode_table){0};
    return csv_read(path, a, &t->csv, e) && read_comments(t, &by_frequency, e) && read_entries(t, by_frequency, a, e);
}

bool mode_table_bad_place(const struct mode_table *t, size_t place, const char *text, struct err *e)
{
    size_t row = t->row[place];
    int column = csv_column(&t->csv, "place");
    return err_set(e, ERR_SCENE, "%s:%d: place '%.60s' %s", t->csv.file, t->csv.lines[row],
                   t->csv.cells[row * t->csv.columns + (size_t)column], text);
}
