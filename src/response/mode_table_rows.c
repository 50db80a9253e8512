/* Reading the rows of a mode table and saying, with file and line, what is wrong with one. */
#include "response/mode_table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PLACE,
    X,
    Y,
    MODE,
    FREQUENCY,
    DECAY,
    GAIN,
    PHASE,
    SLOPE,
    COLUMNS,
    TIME = DECAY,
    AMPLITUDE = GAIN
}; /* MODE_TABLE_..., for short */

static const char *const plain_names[COLUMNS] = {"place",       "x_m",  "y_m",       "mode", "frequency_hz",
                                                 "decay_per_s", "gain", "phase_rad", "slope"};
static const char *const envelope_names[COLUMNS] = {"place",  "x_m",       "y_m",       "mode", "frequency_hz",
                                                    "time_s", "amplitude", "phase_rad", ""};

const char *mode_table_rows_cell(const struct mode_table_rows *r, size_t row, int c)
{
    return r->csv->cells[row * r->csv->columns + (size_t)r->column[c]];
}

const double *mode_table_rows_values(const struct mode_table_rows *r, size_t row) { return r->value + row * COLUMNS; }

bool mode_table_rows_bad(const struct mode_table_rows *r, size_t row, struct err *e)
{
    return err_at(e, "%s:%d", r->csv->file, r->csv->lines[row]);
}

/* ------------------------------------------------------------------ header */

static bool no_column(const struct mode_table_rows *r, int c, struct err *e)
{
    if (r->envelope)
        return err_set(e, ERR_SCENE,
                       "%s: a table of envelopes needs the column '%s'; its columns are place, x_m, y_m, mode, "
                       "frequency_hz, time_s, amplitude, "
                       "phase_rad",
                       r->csv->file, envelope_names[c]);
    return err_set(e, ERR_SCENE,
                   "%s: a mode table needs the column '%s'; its columns are place, x_m, y_m, mode, frequency_hz, "
                   "decay_per_s, gain, phase_rad",
                   r->csv->file, plain_names[c]);
}

static bool find_columns(struct mode_table_rows *r, struct err *e)
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

static bool check_values(const struct mode_table_rows *r, const double *v, struct err *e)
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
                       "the place (%g, %g) m lies farther than 1000 m from the origin; x_m and y_m are in metres", v[X],
                       v[Y]);
    if (!whole(v[SLOPE])) return err_set(e, ERR_SCENE, "slope %g is not a whole number from 1 to 100", v[SLOPE]);
    return true;
}

static bool read_numbers(struct mode_table_rows *r, struct arena *a, struct err *e)
{
    r->value = ARENA_TAKE(a, double, r->csv->rows *COLUMNS);
    for (size_t i = 0; i < r->csv->rows; i++) {
        double *v = r->value + i * COLUMNS;
        v[SLOPE] = 1.0;
        for (int c = 0; c < (r->slopes ? COLUMNS : SLOPE); c++)
            if (c != PLACE && c != MODE && !csv_number(r->csv, i, r->column[c], &v[c], e)) return false;
        if (!check_values(r, v, e)) return mode_table_rows_bad(r, i, e);
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
static size_t number_labels(const struct mode_table_rows *r, int c, struct arena *a, size_t *id)
{
    size_t rows = r->csv->rows, n = 0;
    struct label *l = ARENA_TAKE(a, struct label, rows);
    for (size_t i = 0; i < rows; i++)
        l[i] = (struct label){mode_table_rows_cell(r, i, c), i};
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
static void settle_numbers(const struct mode_table_rows *r, int c, struct arena *a)
{
    size_t n = c == PLACE ? r->places : r->modes, *id = c == PLACE ? r->place : r->mode, *to = ARENA_TAKE(a, size_t, n);
    struct number *s = ARENA_TAKE(a, struct number, n);
    for (size_t i = r->csv->rows; i-- > 0;) {
        const double *v = mode_table_rows_values(r, i);
        struct number *at = &s[id[i]];
        double lowest = at->text ? fmin(at->first, v[FREQUENCY]) : v[FREQUENCY];
        *at =
            (struct number){c == PLACE ? v[X] : lowest, c == PLACE ? v[Y] : 0.0, mode_table_rows_cell(r, i, c), id[i]};
    }
    qsort(s, n, sizeof *s, number_order);
    for (size_t k = 0; k < n; k++)
        to[s[k].old] = k;
    for (size_t i = 0; i < r->csv->rows; i++)
        id[i] = to[id[i]];
}

size_t mode_table_rows_first(const struct mode_table_rows *r, int column, size_t number)
{
    const size_t *id = column == PLACE ? r->place : r->mode;
    size_t i = 0;
    while (id[i] != number)
        i++;
    return i;
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

static bool duplicate(const struct mode_table_rows *r, const struct key *p, const struct key *q, struct err *e)
{
    char what[32] = "";
    if (r->envelope)
        snprintf(what, sizeof what, "the time %.9g s of ", p->within);
    else if (r->slopes)
        snprintf(what, sizeof what, "slope %.0f of ", p->within);
    return err_set(e, ERR_SCENE, "%s:%d: place '%.60s' has %smode '%.60s' again, after line %d: remove one of the two",
                   r->csv->file, r->csv->lines[q->row], mode_table_rows_cell(r, q->row, PLACE), what,
                   mode_table_rows_cell(r, q->row, MODE), r->csv->lines[p->row]);
}

/* Times of an envelope must be told apart by the fit. */
static bool twice(const struct mode_table_rows *r, const struct key *p, const struct key *q)
{
    return p->place == q->place && p->mode == q->mode && q->within - p->within < (r->envelope ? 1e-9 : 0.5);
}

static bool sort_rows(struct mode_table_rows *r, struct arena *a, struct err *e)
{
    size_t rows = r->csv->rows;
    struct key *k = ARENA_TAKE(a, struct key, rows);
    r->order = ARENA_TAKE(a, size_t, rows);
    for (size_t i = 0; i < rows; i++)
        k[i] = (struct key){r->place[i], r->mode[i], i, r->value[i * COLUMNS + (r->envelope ? TIME : SLOPE)]};
    qsort(k, rows, sizeof *k, key_order);
    for (size_t i = 0; i < rows; i++) {
        if (i && twice(r, &k[i - 1], &k[i])) return duplicate(r, &k[i - 1], &k[i], e);
        r->order[i] = k[i].row;
    }
    return true;
}

/* A place is at one point, that of its first row. */
static bool check_points(const struct mode_table_rows *r, struct arena *a, struct err *e)
{
    size_t *first = ARENA_TAKE(a, size_t, r->places), seen = 0;
    for (size_t i = 0; i < r->csv->rows; i++) {
        if (r->place[i] == seen) first[seen++] = i;
        size_t o = first[r->place[i]];
        const double *v = mode_table_rows_values(r, i), *w = mode_table_rows_values(r, o);
        if (v[X] != w[X] || v[Y] != w[Y]) {
            err_set(e, ERR_SCENE,
                    "place '%.60s' is at (%g, %g) m here and at (%g, %g) m in line %d: make both the same",
                    mode_table_rows_cell(r, i, PLACE), v[X], v[Y], w[X], w[Y], r->csv->lines[o]);
            return mode_table_rows_bad(r, i, e);
        }
    }
    return true;
}

bool mode_table_rows_read(const struct csv *csv, struct arena *a, struct mode_table_rows *r, struct err *e)
{
    *r = (struct mode_table_rows){.csv = csv};
    if (!find_columns(r, e) || !read_numbers(r, a, e)) return false;
    r->place = ARENA_TAKE(a, size_t, csv->rows);
    r->mode = ARENA_TAKE(a, size_t, csv->rows);
    r->places = number_labels(r, PLACE, a, r->place);
    r->modes = number_labels(r, MODE, a, r->mode);
    if (!check_points(r, a, e)) return false;
    settle_numbers(r, PLACE, a);
    settle_numbers(r, MODE, a);
    return sort_rows(r, a, e);
}
