/* A mode table: its comments, its rows (mode_table_rows.c) gathered into one entry per place and mode, and what shared
   or separate poles ask of the entries. */
#include "response/mode_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "response/mode_table_envelopes.h"
#include "response/mode_table_rows.h"

static const char *const quantity_names[] = {"displacement", "velocity", "acceleration", NULL};

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

static bool needed(const struct csv *t, const char *key, const char *words, const char **value, struct err *e)
{
    if (!comment(t, key, value, e)) return false;
    return *value ||
           err_set(e, ERR_SCENE, "%s: the comment '# %s: ...' is missing; write it once, before the header (%s)",
                   t->file, key, words);
}

/* Index of the word among up to three. */
static bool choose(const struct csv *t, const char *value, const char *const *words, int *index, struct err *e)
{
    for (*index = 0; words[*index]; (*index)++)
        if (strcmp(value, words[*index]) == 0) return true;
    return words == quantity_names
               ? err_set(
                     e, ERR_SCENE,
                     "%s: quantity: '%.60s' is not displacement, velocity or acceleration (per N s): write one of them",
                     t->file, value)
               : err_set(e, ERR_SCENE, "%s: %s: '%.60s' is neither %s nor %s", t->file,
                         strcmp(words[0], "shared") == 0 ? "poles"
                         : strcmp(words[0], "ids") == 0  ? "pairing"
                                                         : "gains",
                         value, words[0], words[1]);
}

static bool read_radius(const struct csv *t, double *radius, struct err *e)
{
    const char *value;
    *radius = NAN;
    if (!comment(t, "radius_m", &value, e)) return false;
    if (value && !(text_double(value, radius) && *radius > 0.0 && *radius <= 1000.0))
        return err_set(e, ERR_SCENE, "%s: radius_m: '%.60s' is not a number above 0, at most 1000 (metres)", t->file,
                       value);
    return true;
}

/* by_frequency: -1 where the table does not say. */
static bool read_comments(struct mode_table *t, int *by_frequency, struct err *e)
{
    static const char *const poles_words[] = {"shared", "separate", NULL},
                             *const pairing_words[] = {"ids", "frequency", NULL},
                             *const gains_words[] = {"logarithmic", "complex", NULL};
    const char *poles, *quantity, *pairing, *gains;
    int separate, complex = 0;
    *by_frequency = -1;
    if (!needed(&t->csv, "poles", "shared or separate", &poles, e) ||
        !needed(&t->csv, "quantity", "displacement, velocity or acceleration", &quantity, e) ||
        !comment(&t->csv, "pairing", &pairing, e) || !comment(&t->csv, "gains", &gains, e) ||
        !choose(&t->csv, poles, poles_words, &separate, e) ||
        !choose(&t->csv, quantity, quantity_names, &t->quantity, e) ||
        (pairing && !choose(&t->csv, pairing, pairing_words, by_frequency, e)) ||
        (gains && !choose(&t->csv, gains, gains_words, &complex, e)))
        return false;
    t->shared = !separate;
    t->complex = complex;
    if (t->shared && gains && !complex)
        return err_set(e, ERR_SCENE,
                       "%s: gains: logarithmic is for separate poles; those of shared ones pass zero at nodal lines: "
                       "remove that line",
                       t->csv.file);
    if (t->shared && *by_frequency == 1)
        return err_set(
            e, ERR_SCENE,
            "%s: pairing: frequency is for separate poles; with shared ones a mode has the same id at every place",
            t->csv.file);
    return read_radius(&t->csv, &t->radius, e);
}

/* ------------------------------------------------------------------ entries */

static int slope_order(const void *a, const void *b)
{
    const struct mode_slope *p = a, *q = b;
    return (p->decay > q->decay) - (p->decay < q->decay);
}

/* Rows of one place and mode: one frequency, and of an envelope one phase. */
static bool one_mode(const struct mode_table_rows *r, const size_t *rows, size_t n, struct err *e)
{
    const double *v = mode_table_rows_values(r, rows[0]);
    for (size_t i = 1; i < n; i++) {
        const double *w = mode_table_rows_values(r, rows[i]);
        if (w[MODE_TABLE_FREQUENCY] == v[MODE_TABLE_FREQUENCY] &&
            (!r->envelope || w[MODE_TABLE_PHASE] == v[MODE_TABLE_PHASE]))
            continue;
        err_set(e, ERR_SCENE,
                "mode '%.60s' of place '%.60s' has frequency %.12g Hz and phase %.12g here, %.12g Hz and %.12g in line "
                "%d; %s",
                mode_table_rows_cell(r, rows[i], MODE_TABLE_MODE), mode_table_rows_cell(r, rows[i], MODE_TABLE_PLACE),
                w[MODE_TABLE_FREQUENCY], w[MODE_TABLE_PHASE], v[MODE_TABLE_FREQUENCY], v[MODE_TABLE_PHASE],
                r->csv->lines[rows[0]],
                r->envelope ? "an envelope belongs to one frequency and phase"
                            : "the slopes of a mode have one frequency");
        return mode_table_rows_bad(r, rows[i], e);
    }
    return true;
}

static void take_slopes(const struct mode_table_rows *r, const size_t *rows, struct mode_entry *m)
{
    for (int i = 0; i < m->n; i++) {
        const double *v = mode_table_rows_values(r, rows[i]);
        m->slope[i] = (struct mode_slope){v[MODE_TABLE_DECAY], v[MODE_TABLE_GAIN], v[MODE_TABLE_PHASE]};
    }
    qsort(m->slope, (size_t)m->n, sizeof *m->slope, slope_order);
}

/* One entry per place and mode; slopes of an envelope table are fitted later. *from: [entries] where its rows begin in
 * r->order. */
static bool gather(const struct mode_table_rows *r, struct arena *a, struct mode_table *t, size_t **from, struct err *e)
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
        *m = (struct mode_entry){r->place[*row], r->mode[*row],
                                 *row,           mode_table_rows_values(r, *row)[MODE_TABLE_FREQUENCY],
                                 (int)(end - i), NULL};
        (*from)[n++] = i;
        (*from)[n] = end;
        t->first[m->place + 1] = n;
        if (!one_mode(r, row, end - i, e)) return false;
        if (r->envelope) continue;
        m->slope = ARENA_TAKE(a, struct mode_slope, end - i);
        take_slopes(r, row, m);
    }
    return true;
}

static void take_places(const struct mode_table_rows *r, struct arena *a, struct mode_table *t)
{
    t->places = r->places;
    t->modes = r->modes;
    t->xy = ARENA_TAKE(a, double, 2 * r->places);
    t->row = ARENA_TAKE(a, size_t, r->places);
    for (size_t i = r->csv->rows; i-- > 0;) {
        const double *v = mode_table_rows_values(r, i);
        t->row[r->place[i]] = i;
        t->xy[2 * r->place[i]] = v[MODE_TABLE_X];
        t->xy[2 * r->place[i] + 1] = v[MODE_TABLE_Y];
    }
}

/* ------------------------------------------------------------------ poles */

static bool missing(const struct mode_table_rows *r, const struct mode_table *t, size_t place, size_t mode,
                    struct err *e)
{
    return err_set(
        e, ERR_SCENE,
        "%s:%d: place '%.60s', which starts here, has no mode '%.60s'; every place needs every mode (a mode that is "
        "silent there has gain 0)",
        t->csv.file, t->csv.lines[t->row[place]], mode_table_rows_cell(r, t->row[place], MODE_TABLE_PLACE),
        mode_table_rows_cell(r, mode_table_rows_first(r, MODE_TABLE_MODE, mode), MODE_TABLE_MODE));
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

static bool same_poles(const struct mode_table_rows *r, const struct mode_entry *m, const struct mode_entry *w,
                       struct err *e)
{
    if (m->n != w->n) {
        err_set(e, ERR_SCENE,
                "mode '%.60s' has %d slopes at this place, %d at that of line %d; with shared poles they are as many "
                "at every place",
                mode_table_rows_cell(r, m->row, MODE_TABLE_MODE), m->n, w->n, r->csv->lines[w->row]);
        return mode_table_rows_bad(r, m->row, e);
    }
    for (int k = 0; k < m->n; k++)
        if (unequal(m->frequency, w->frequency) || unequal(m->slope[k].decay, w->slope[k].decay)) {
            err_set(e, ERR_SCENE,
                    "mode '%.60s' has frequency %.12g Hz and decay %.12g/s here, %.12g Hz and %.12g/s in line %d; with "
                    "shared "
                    "poles they are the same at every place: correct one, or let the table say # poles: separate",
                    mode_table_rows_cell(r, m->row, MODE_TABLE_MODE), m->frequency, m->slope[k].decay, w->frequency,
                    w->slope[k].decay, r->csv->lines[w->row]);
            return mode_table_rows_bad(r, m->row, e);
        }
    return true;
}

static bool check_shared(const struct mode_table_rows *r, const struct mode_table *t, struct err *e)
{
    for (size_t i = 0; i < t->first[t->places]; i++)
        if (!same_poles(r, &t->entry[i], &t->entry[t->entry[i].mode], e)) return false;
    return true;
}

/* Separate decays are interpolated in the log. */
static bool check_separate(const struct mode_table_rows *r, const struct mode_table *t, struct err *e)
{
    for (size_t i = 0; t->places > 1 && i < t->first[t->places]; i++)
        if (!(t->entry[i].slope[0].decay > 0.0)) {
            err_set(e, ERR_SCENE,
                    "decay_per_s is 0: separate poles are interpolated between places in the log, where 0 has no "
                    "value; give a small decay");
            return mode_table_rows_bad(r, t->entry[i].row, e);
        }
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
                               "above the table's header to keep to that, "
                               "or \"# pairing: %s\"",
                               t->csv.file, hold ? "name" : "frequency, for their names do not hold",
                               hold ? "ids" : "frequency", hold ? "frequency" : "ids");
}

static bool read_entries(struct mode_table *t, int by_frequency, struct arena *a, struct err *e)
{
    struct mode_table_rows r;
    size_t *from, whole = 0;
    if (!mode_table_rows_read(&t->csv, a, &r, e) || !gather(&r, a, t, &from, e)) return false;
    take_places(&r, a, t);
    for (size_t p = 0, k; p < t->places; p++, whole += k == t->modes)
        if ((k = lacks(t, p)) < t->modes && t->shared) return missing(&r, t, p, k, e);
    t->by_frequency = by_frequency > 0;
    if (by_frequency < 0 && whole < t->places) guess_pairing(t, a);
    if (r.envelope && !mode_table_envelopes_fit(&r, from, a, t, e)) return false;
    return t->shared ? check_shared(&r, t, e) : check_separate(&r, t, e);
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
