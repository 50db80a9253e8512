/* Reading a mode table (its columns and comments are described in modes.h) and saying, with file and line, what is wrong with it.
   Rows may come in any order; every (place, mode) must be there exactly once. Ids of places and modes are texts. */
#include "response/mode_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PLACE, X, Y, MODE, FREQUENCY, DECAY, GAIN, PHASE, COLUMNS }; /* MODE_TABLE_..., for short */

static const char *const column_names[COLUMNS] = {"place", "x_m", "y_m", "mode", "frequency_hz", "decay_per_s", "gain", "phase_rad"};
static const char *const quantity_names[] = {"displacement", "velocity", "acceleration", NULL};

static const char *cell(const struct mode_table *t, size_t row, int c)
{
    return t->csv.cells[row * t->csv.columns + (size_t)t->column[c]];
}

static bool bad_row(const struct mode_table *t, size_t row, struct err *e)
{
    return err_at(e, "%s:%d", t->csv.file, t->csv.lines[row]);
}

/* ------------------------------------------------------------------ header */

static bool find_columns(struct mode_table *t, struct err *e)
{
    if (t->csv.columns == 1 && t->csv.names[0][strcspn(t->csv.names[0], ";\t")])
        return err_set(e, ERR_SCENE, "%s: the columns are separated by semicolons or tabs; a mode table wants commas (and decimal points)", t->csv.file);
    for (int c = 0; c < COLUMNS; c++)
        if ((t->column[c] = csv_column(&t->csv, column_names[c])) < 0)
            return err_set(e, ERR_SCENE, "%s: a mode table needs the column '%s'; its columns are place, x_m, y_m, mode, "
                           "frequency_hz, decay_per_s, gain, phase_rad", t->csv.file, column_names[c]);
    if (t->csv.columns != COLUMNS)
        return err_set(e, ERR_SCENE, "%s: %zu columns where a mode table has %d (place, x_m, y_m, mode, frequency_hz, decay_per_s, "
                       "gain, phase_rad); remove the others", t->csv.file, t->csv.columns, (int)COLUMNS);
    if (t->csv.rows == 0)
        return err_set(e, ERR_SCENE, "%s: a mode table without modes; give at least one row", t->csv.file);
    return true;
}

/* The comment's value; NULL and an error when it is missing or given twice. */
static const char *comment(const struct csv *t, const char *key, const char *words, struct err *e)
{
    const char *value = csv_comment(t, key);
    int given = 0;
    for (size_t i = 0; i < t->n_comments; i++)
        given += strcmp(t->comments[i].key, key) == 0;
    if (given == 1)
        return value;
    err_set(e, ERR_SCENE, "%s: the comment '# %s: ...' %s; write it once, before the header (%s)", t->file, key,
            given ? "is given more than once" : "is missing", words);
    return NULL;
}

static bool read_comments(const struct csv *t, int *quantity, struct err *e)
{
    const char *poles = comment(t, "poles", "shared", e);
    const char *word = poles ? comment(t, "quantity", "displacement, velocity or acceleration", e) : NULL;
    if (!word)
        return false;
    if (strcmp(poles, "separate") == 0)
        return err_set(e, ERR_SCENE, "%s: separate poles need morphing, which this version does not offer; fit the places with shared "
                       "poles, or give each place its own table", t->file);
    if (strcmp(poles, "shared") != 0)
        return err_set(e, ERR_SCENE, "%s: poles: '%.60s' is neither shared nor separate", t->file, poles);
    for (*quantity = 0; quantity_names[*quantity]; (*quantity)++)
        if (strcmp(word, quantity_names[*quantity]) == 0)
            return true;
    return err_set(e, ERR_SCENE, "%s: quantity: '%.60s' is not displacement, velocity or acceleration (per N s)", t->file, word);
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
static size_t number_labels(const struct mode_table *t, int c, struct arena *a, size_t *id)
{
    size_t rows = t->csv.rows, n = 0;
    struct label *l = ARENA_TAKE(a, struct label, rows);
    for (size_t i = 0; i < rows; i++)
        l[i] = (struct label){cell(t, i, c), i};
    qsort(l, rows, sizeof *l, label_order);
    for (size_t i = 0, first = 0; i < rows; i++) {
        if (strcmp(l[i].text, l[first].text) != 0)
            first = i;
        id[l[i].row] = l[first].row;
    }
    for (size_t i = 0; i < rows; i++)
        id[i] = id[i] == i ? n++ : id[id[i]];
    return n;
}

struct entry {
    size_t place, mode, row;
};

static int entry_order(const void *a, const void *b)
{
    const struct entry *p = a, *q = b;
    if (p->place != q->place)
        return p->place < q->place ? -1 : 1;
    if (p->mode != q->mode)
        return p->mode < q->mode ? -1 : 1;
    return (p->row > q->row) - (p->row < q->row);
}

static bool duplicate(const struct mode_table *t, const struct entry *p, const struct entry *q, struct err *e)
{
    return err_set(e, ERR_SCENE, "%s:%d: place '%.60s' has mode '%.60s' again, after line %d", t->csv.file, t->csv.lines[q->row],
                   cell(t, q->row, PLACE), cell(t, q->row, MODE), t->csv.lines[p->row]);
}

static const char *label_of(const struct mode_table *t, const size_t *id, size_t number, int c)
{
    size_t i = 0;
    while (id[i] != number)
        i++;
    return cell(t, i, c);
}

static bool missing(const struct mode_table *t, size_t index, struct err *e)
{
    size_t place = index / t->modes, i = 0;
    while (t->place[i] != place)
        i++;
    return err_set(e, ERR_SCENE, "%s:%d: place '%.60s', which starts here, has no mode '%.60s'; every place needs every mode (a mode that is "
                   "silent there has gain 0)", t->csv.file, t->csv.lines[i], cell(t, i, PLACE),
                   label_of(t, t->mode, index % t->modes, MODE));
}

/* Fills row[place][mode]; every pair must be there once. */
static bool arrange(struct mode_table *t, struct arena *a, struct err *e)
{
    size_t rows = t->csv.rows;
    struct entry *s = ARENA_TAKE(a, struct entry, rows);
    t->place = ARENA_TAKE(a, size_t, rows);
    t->mode = ARENA_TAKE(a, size_t, rows);
    t->row = ARENA_TAKE(a, size_t, rows);
    t->places = number_labels(t, PLACE, a, t->place);
    t->modes = number_labels(t, MODE, a, t->mode);
    for (size_t i = 0; i < rows; i++)
        s[i] = (struct entry){t->place[i], t->mode[i], i};
    qsort(s, rows, sizeof *s, entry_order);
    for (size_t i = 0; i < rows; i++) {
        if (i && s[i].place == s[i - 1].place && s[i].mode == s[i - 1].mode)
            return duplicate(t, &s[i - 1], &s[i], e);
        if (s[i].place != i / t->modes || s[i].mode != i % t->modes)
            return missing(t, i, e);
        t->row[i] = s[i].row;
    }
    return rows == t->places * t->modes || missing(t, rows, e);
}

/* ------------------------------------------------------------------ numbers */

static bool read_row(struct mode_table *t, size_t row, struct err *e)
{
    double *v = t->value + row * COLUMNS;
    for (int c = 0; c < COLUMNS; c++)
        if (c != PLACE && c != MODE && !csv_number(&t->csv, row, t->column[c], &v[c], e))
            return false;
    if (!(v[FREQUENCY] > 0.0))
        err_set(e, ERR_SCENE, "frequency_hz %g must be above 0", v[FREQUENCY]);
    else if (!(v[DECAY] >= 0.0))
        err_set(e, ERR_SCENE, "decay_per_s %g must not be negative: the mode would grow for ever", v[DECAY]);
    else if (!(fabs(v[X]) <= 1000.0 && fabs(v[Y]) <= 1000.0))
        err_set(e, ERR_SCENE, "the place (%g, %g) m lies farther than 1000 m from the origin; x_m and y_m are in metres", v[X], v[Y]);
    else
        return true;
    return bad_row(t, row, e);
}

static bool unequal(double a, double b)
{
    return fabs(a - b) > 1e-9 * fmax(fabs(a), fabs(b));
}

static bool check_row(const struct mode_table *t, size_t place, size_t mode, struct err *e)
{
    size_t row = t->row[place * t->modes + mode], first = t->row[mode], origin = t->row[place * t->modes];
    const double *v = t->value + row * COLUMNS, *w = t->value + first * COLUMNS, *o = t->value + origin * COLUMNS;
    if (v[X] != o[X] || v[Y] != o[Y])
        err_set(e, ERR_SCENE, "place '%.60s' is at (%g, %g) m here and at (%g, %g) m in line %d", cell(t, row, PLACE), v[X], v[Y], o[X],
                o[Y], t->csv.lines[origin]);
    else if (unequal(v[FREQUENCY], w[FREQUENCY]) || unequal(v[DECAY], w[DECAY]))
        err_set(e, ERR_SCENE, "mode '%.60s' has frequency %.12g Hz and decay %.12g/s here, %.12g Hz and %.12g/s in line %d; with shared "
                "poles they are the same at every place", cell(t, row, MODE), v[FREQUENCY], v[DECAY], w[FREQUENCY], w[DECAY],
                t->csv.lines[first]);
    else
        return true;
    return bad_row(t, row, e);
}

static bool read_numbers(struct mode_table *t, struct arena *a, struct err *e)
{
    t->value = ARENA_TAKE(a, double, t->csv.rows * COLUMNS);
    for (size_t i = 0; i < t->csv.rows; i++)
        if (!read_row(t, i, e))
            return false;
    for (size_t p = 0; p < t->places; p++)
        for (size_t m = 0; m < t->modes; m++)
            if (!check_row(t, p, m, e))
                return false;
    return true;
}

bool mode_table_read(const char *path, struct arena *a, struct mode_table *t, struct err *e)
{
    *t = (struct mode_table){0};
    return csv_read(path, a, &t->csv, e) && read_comments(&t->csv, &t->quantity, e) && find_columns(t, e) && arrange(t, a, e) &&
           read_numbers(t, a, e);
}

const double *mode_table_values(const struct mode_table *t, size_t place, size_t mode)
{
    return t->value + t->row[place * t->modes + mode] * COLUMNS;
}

bool mode_table_bad_place(const struct mode_table *t, size_t place, const char *text, struct err *e)
{
    size_t row = t->row[place * t->modes];
    err_set(e, ERR_SCENE, "place '%.60s' %s", cell(t, row, PLACE), text);
    return bad_row(t, row, e);
}
