/* See table_distance.h. a is the reference: its value scales the relative tolerance. */
#include "analysis/table_distance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cell as a number, also nan and inf; false: text. */
static bool cell_number(const char *s, double *v)
{
    char *end;
    *v = strtod(s, &end);
    return end > s && end[strspn(end, " \t")] == '\0';
}

struct cell {
    const char *text; /* NULL: of a table of numbers */
    double number;
    bool is_number;
};

static struct cell cell_at(const struct csv *t, size_t row, int column)
{
    size_t at = row * t->columns + (size_t)column;
    struct cell c = {
        .text = t->numbers ? NULL : t->cells[at], .number = t->numbers ? t->numbers[at] : 0, .is_number = true};
    if (c.text) c.is_number = cell_number(c.text, &c.number);
    return c;
}

static bool cell_same(const struct cell *a, const struct cell *b)
{
    if (a->text && b->text) return !strcmp(a->text, b->text);
    return a->is_number && b->is_number && (a->number == b->number || (isnan(a->number) && isnan(b->number)));
}

/* How far b is beyond the tolerance around a: > 0 is a miss. */
static double cell_excess(struct cell a, struct cell b, const struct table_distance_tolerance *t, double *off)
{
    double p = a.number, q = b.number;
    bool numbers = a.is_number && b.is_number, same = cell_same(&a, &b);
    bool finite = numbers && isfinite(p) && isfinite(q);
    *off = finite ? fabs(q - p) : 0;
    if (same || (numbers && !t->exact && ((isnan(p) && isnan(q)) || p == q))) return -INFINITY;
    if (!finite) return INFINITY;
    return t->exact ? fmax(*off, 0x1p-1074) : *off - (t->abs + t->rel * fabs(p));
}

static void compare_column(const struct csv *tables[2], size_t rows, struct table_distance_column *c)
{
    c->excess = -INFINITY;
    for (size_t i = 0; i < rows; i++) {
        double off;
        double excess = cell_excess(cell_at(tables[0], i, c->a), cell_at(tables[1], i, c->b), &c->tolerance, &off);
        c->largest = fmax(c->largest, off);
        if (!(excess > 0)) continue;
        c->misses++;
        if (excess > c->excess) {
            c->excess = excess;
            c->worst_row = i;
        }
    }
}

static struct table_distance_tolerance tolerance_of(const char *name, const struct table_distance_tolerance *t)
{
    struct table_distance_tolerance found = {name, 0, 0, true};
    for (; t->column; t++)
        if (!strcmp(t->column, name) || (!strcmp(t->column, "*") && found.column == name)) found = *t;
    return found;
}

/* Which of x's columns y does not have. */
static const char **only_in(const struct csv *x, const struct csv *y, struct arena *arena, size_t *n)
{
    const char **names = ARENA_TAKE(arena, const char *, x->columns);
    *n = 0;
    for (size_t i = 0; i < x->columns; i++)
        if (csv_column(y, x->names[i]) < 0) names[(*n)++] = x->names[i];
    return names;
}

static const char *differing_comment(const struct csv *a, const struct csv *b)
{
    size_t n = a->n_comments < b->n_comments ? a->n_comments : b->n_comments;
    for (size_t i = 0; i < n; i++)
        if (strcmp(a->comments[i].key, b->comments[i].key) || strcmp(a->comments[i].value, b->comments[i].value))
            return a->comments[i].key;
    return a->n_comments > n ? a->comments[n].key : b->n_comments > n ? b->comments[n].key : NULL;
}

static bool check_names(const struct csv *a, const struct table_distance_tolerance *t, struct err *e)
{
    for (; t->column; t++)
        if (strcmp(t->column, "*") != 0 && csv_column(a, t->column) < 0)
            return err_set(e, ERR_SCENE, "%s: has no column '%s', for which a tolerance is given", a->file, t->column);
    return true;
}

bool table_distance(const struct csv *tables[2], const struct table_distance_tolerance *tolerances, struct arena *arena,
                    struct table_distance *d, struct err *e)
{
    const struct csv *a = tables[0], *b = tables[1];
    int before = -1;
    if (!check_names(a, tolerances, e)) return false;
    *d = (struct table_distance){.rows = a->rows < b->rows ? a->rows : b->rows, .comment = differing_comment(a, b)};
    d->missing = only_in(a, b, arena, &d->n_missing);
    d->extra = only_in(b, a, arena, &d->n_extra);
    d->columns = ARENA_TAKE(arena, struct table_distance_column, a->columns);
    for (size_t i = 0; i < a->columns; i++) {
        int there = csv_column(b, a->names[i]);
        if (there < 0) continue;
        d->reordered = d->reordered || there < before;
        before = there;
        struct table_distance_column *c = &d->columns[d->n_columns++];
        *c = (struct table_distance_column){.name = a->names[i], .a = (int)i, .b = there};
        c->tolerance = tolerance_of(a->names[i], tolerances);
        compare_column(tables, d->rows, c);
    }
    return true;
}

static bool read_row(const struct csv *t, size_t row, struct table_distance_tolerance *to, struct err *e)
{
    to->column = t->cells[row * t->columns];
    if (!csv_number(t, row, 1, &to->abs, e) || !csv_number(t, row, 2, &to->rel, e)) return false;
    if (to->abs < 0 || to->rel < 0)
        return err_set(e, ERR_SCENE, "%s:%d: a tolerance is not negative", t->file, t->lines[row]);
    return true;
}

struct table_distance_tolerance *table_distance_read(const char *path, struct arena *a, struct err *e)
{
    struct csv t;
    if (!csv_read(path, a, &t, e)) return NULL;
    if (t.columns != 3 || strcmp(t.names[0], "column") || strcmp(t.names[1], "abs") || strcmp(t.names[2], "rel")) {
        err_set(e, ERR_SCENE, "%s: a table of tolerances has the header 'column,abs,rel'", path);
        return NULL;
    }
    struct table_distance_tolerance *list = ARENA_TAKE(a, struct table_distance_tolerance, t.rows + 1);
    for (size_t i = 0; i < t.rows; i++) {
        if (!read_row(&t, i, &list[i], e)) return NULL;
        for (size_t k = 0; k < i; k++)
            if (!strcmp(list[k].column, list[i].column)) {
                err_set(e, ERR_SCENE, "%s:%d: a second tolerance for '%s'", path, t.lines[i], list[i].column);
                return NULL;
            }
    }
    return list;
}
