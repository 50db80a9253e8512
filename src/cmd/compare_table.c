/* rasp compare for tables, CSV or NPY: columns by name, each with its tolerance. Comments before the header count only where everything has to be
   exact: they say where a table comes from. */
#include <math.h>
#include <stdio.h>

#include "base/hash.h"
#include "cmd/compare.h"
#include "file/json_value.h"
#include "file/table.h"

struct tables {
    const struct compare_ask *ask;
    struct csv a, b;
    struct table_distance d;
    char hash[2][HASH_TEXT];
    bool hashed;      /* both are files, not pipes: their bytes can be read again */
    bool equal, held; /* not the least difference; every criterion met */
};

static bool measure(struct tables *t, struct err *e)
{
    const struct compare_ask *ask = t->ask;
    const struct csv *both[2] = {&t->a, &t->b};
    if (!table_read(ask->files[0], ask->arena, &t->a, e) || !table_read(ask->files[1], ask->arena, &t->b, e))
        return false;
    if (t->a.rows == 0)
        return err_set(e, ERR_SCENE, "%s: has no rows: nothing would be compared", ask->files[0]);
    if (!table_distance(both, ask->tolerances, ask->arena, &t->d, e))
        return false;
    struct err none = {0};
    t->hashed = hash_file(ask->files[0], t->hash[0], &none) && hash_file(ask->files[1], t->hash[1], &none);
    t->held = t->a.rows == t->b.rows && !t->d.n_missing && !t->d.n_extra && !t->d.reordered && !(ask->exact && t->d.comment);
    t->equal = t->held && !t->d.comment;
    for (size_t i = 0; i < t->d.n_columns; i++) {
        t->held = t->held && t->d.columns[i].misses == 0;
        t->equal = t->equal && t->d.columns[i].misses == 0 && t->d.columns[i].largest == 0;
    }
    return true;
}

static void print_names(const struct tables *t, const char *what, const char *const *names, size_t n)
{
    if (n == 0)
        return;
    fprintf(t->ask->out, "FAIL columns: %s", what);
    for (size_t i = 0; i < n; i++)
        fprintf(t->ask->out, "%s %s", i ? "," : "", names[i]);
    fputc('\n', t->ask->out);
}

static void print_form(const struct tables *t)
{
    const struct table_distance *d = &t->d;
    print_names(t, "missing in B:", d->missing, d->n_missing);
    print_names(t, "only in B:", d->extra, d->n_extra);
    if (d->reordered)
        fprintf(t->ask->out, "FAIL columns: they stand in another order in B\n");
    if (t->a.rows != t->b.rows)
        fprintf(t->ask->out, "FAIL rows: A has %zu, B has %zu; the first %zu are compared\n", t->a.rows, t->b.rows, d->rows);
    if (d->comment)
        fprintf(t->ask->out, "%s comments: they differ, first in '%s'\n", t->ask->exact ? "FAIL" : "note", d->comment);
}

static void print_column(const struct tables *t, const struct table_distance_column *c)
{
    const struct table_distance_tolerance *to = &c->tolerance;
    char room[2][CSV_ROOM];
    if (c->misses == 0 && c->largest == 0)
        return;
    fprintf(t->ask->out, "%s %s: ", c->misses ? "FAIL" : "ok  ", c->name);
    if (c->misses)
        fprintf(t->ask->out, "%zu of %zu rows differ", c->misses, t->d.rows);
    else
        fprintf(t->ask->out, "differs by at most %.6g", c->largest);
    if (!to->exact)
        fprintf(t->ask->out, "%s abs %g, rel %g", c->misses ? " by more than" : ", within", to->abs, to->rel);
    if (c->misses)
        fprintf(t->ask->out, "; worst in row %zu (line %d, line %d): A '%s', B '%s'", c->worst_row + 1, t->a.lines[c->worst_row],
               t->b.lines[c->worst_row], csv_text(&t->a, c->worst_row, c->a, room[0]), csv_text(&t->b, c->worst_row, c->b, room[1]));
    if (c->misses && isfinite(c->excess) && !to->exact)
        fprintf(t->ask->out, ", %.6g beyond the tolerance", c->excess);
    fputc('\n', t->ask->out);
}

static void print_text(const struct tables *t)
{
    fprintf(t->ask->out, "A %s\nB %s\n", t->ask->files[0], t->ask->files[1]);
    if (t->hashed)
        fprintf(t->ask->out, "sha256  A %s B %s\n", t->hash[0], t->hash[1]);
    print_form(t);
    for (size_t i = 0; i < t->d.n_columns; i++)
        print_column(t, &t->d.columns[i]);
    if (t->held)
        fprintf(t->ask->out, "%s: %zu rows, %zu columns\n", t->equal ? "equal" : "within the tolerances", t->a.rows, t->a.columns);
}

static json_t *json_names(const char *const *names, size_t n)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++)
        json_array_append_new(list, json_value_text(names[i]));
    return list;
}

static json_t *json_worst(const struct tables *t, const struct table_distance_column *c)
{
    char room[2][CSV_ROOM];
    if (c->misses == 0)
        return json_null();
    return json_pack("{s:I, s:i, s:i, s:o, s:o, s:o}",
                     "row", (json_int_t)c->worst_row + 1,
                     "line_a", t->a.lines[c->worst_row],
                     "line_b", t->b.lines[c->worst_row],
                     "a", json_value_text(csv_text(&t->a, c->worst_row, c->a, room[0])),
                     "b", json_value_text(csv_text(&t->b, c->worst_row, c->b, room[1])),
                     "excess", json_value_number(c->excess));
}

static json_t *json_columns(const struct tables *t)
{
    json_t *list = json_array();
    for (size_t i = 0; i < t->d.n_columns; i++) {
        const struct table_distance_column *c = &t->d.columns[i];
        const struct table_distance_tolerance *to = &c->tolerance;
        json_array_append_new(list, json_pack("{s:o, s:b, s:o, s:o, s:I, s:o, s:o}",
                                              "name", json_value_text(c->name),
                                              "exact", to->exact,
                                              "abs", json_value_number(to->exact ? 0 : to->abs),
                                              "rel", json_value_number(to->exact ? 0 : to->rel),
                                              "misses", (json_int_t)c->misses,
                                              "largest_difference", json_value_number(c->largest),
                                              "worst", json_worst(t, c)));
    }
    return list;
}

static json_t *json_hashes(const struct tables *t)
{
    return t->hashed ? json_pack("[s, s]", t->hash[0], t->hash[1]) : json_null();
}

static json_t *json_table(const char *file, const struct csv *t)
{
    return json_pack("{s:o, s:I}", "file", json_value_text(file), "rows", (json_int_t)t->rows);
}

static bool print_json(const struct tables *t, struct err *e)
{
    const struct table_distance *d = &t->d;
    json_t *j = json_pack("{s:b, s:b, s:o, s:o, s:o, s:I, s:o, s:o, s:b, s:o, s:o}",
                          "equal", t->equal,
                          "held", t->held,
                          "file_sha256", json_hashes(t),
                          "a", json_table(t->ask->files[0], &t->a),
                          "b", json_table(t->ask->files[1], &t->b),
                          "rows_compared", (json_int_t)d->rows,
                          "missing_columns", json_names(d->missing, d->n_missing),
                          "extra_columns", json_names(d->extra, d->n_extra),
                          "columns_reordered", d->reordered,
                          "differing_comment", json_value_text(d->comment),
                          "columns", json_columns(t));
    bool ok = j && json_dumpf(j, t->ask->out, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    fputc('\n', t->ask->out);
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

int compare_table(const struct compare_ask *ask, struct err *e)
{
    struct tables *t = ARENA_TAKE(ask->arena, struct tables, 1);
    t->ask = ask;
    if (!measure(t, e))
        return (int)e->kind;
    if (ask->quiet && t->held)
        return 0;
    if (ask->json && !print_json(t, e))
        return (int)e->kind;
    if (!ask->json)
        print_text(t);
    return t->held ? 0 : ERR_DIFFERS;
}
