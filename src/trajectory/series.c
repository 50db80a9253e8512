/* See series.h. */
#include "trajectory/series.h"

#include "file/csv.h"

static bool series_column(const struct csv *t, const char *name, const char *const columns[2], double *out,
                          struct err *e)
{
    int column = csv_column(t, name);
    if (column < 0)
        return err_set(e, ERR_SCENE,
                       "%s: there is no column '%s'; what is read here are time_s, %s%s%s, separated by commas",
                       t->file, name, columns[0], columns[1] ? ", " : "", columns[1] ? columns[1] : "");
    for (size_t i = 0; i < t->rows; i++)
        if (!csv_number(t, i, column, &out[i], e)) return false;
    return true;
}

bool series_read(const char *file, const char *const columns[2], struct arena *a, struct series *s, struct err *e)
{
    struct csv t;
    if (!csv_read(file, a, &t, e)) return false;
    *s = (struct series){.n = t.rows, .lines = t.lines, .time = ARENA_TAKE(a, double, t.rows + 1)};
    if (!series_column(&t, "time_s", columns, s->time, e)) return false;
    for (int k = 0; k < 2 && columns[k]; k++) {
        s->x[k] = ARENA_TAKE(a, double, t.rows + 1);
        if (!series_column(&t, columns[k], columns, s->x[k], e)) return false;
    }
    if (t.rows < 2)
        return err_set(e, ERR_SCENE, "%s: %zu row%s; at least 2 are needed: add some", file, t.rows,
                       t.rows == 1 ? "" : "s");
    for (size_t i = 1; i < s->n; i++)
        if (!(s->time[i] > s->time[i - 1]))
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'time_s': %.9g s comes after %.9g s; times must rise from row to row", file,
                           t.lines[i], s->time[i], s->time[i - 1]);
    return true;
}

static const double NEAREST = 1e-9; /* s */

bool series_spaced(const struct series *s, const char *file, struct err *e)
{
    for (size_t i = 1; i < s->n; i++)
        if (s->time[i] - s->time[i - 1] < NEAREST)
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'time_s': %.9g s comes %.3g s after the row before; a smooth way through the "
                           "rows needs them 1 ns apart or more: remove one of them",
                           file, s->lines[i], s->time[i], s->time[i] - s->time[i - 1]);
    return true;
}
