/* See table.h. */
#include "file/table.h"

#include <limits.h>
#include <string.h>

#include "file/npy.h"

static bool table_names(const struct npy *head, struct csv *t, struct err *e)
{
    t->names = head->fields;
    for (; t->columns < head->n_fields; t->columns++)
        if (csv_column(t, head->fields[t->columns]) >= 0)
            return err_set(e, ERR_SCENE, "%s: two fields are called '%s'", t->file, head->fields[t->columns]);
    return true;
}

static bool table_numbers(const struct bytes *b, const struct npy *head, struct arena *a, struct csv *t, struct err *e)
{
    size_t row = head->n_fields * sizeof(double), bytes, there = b->n - head->data;
    t->rows = head->shape[0];
    if (__builtin_mul_overflow(t->rows, row, &bytes) || bytes != there || t->rows > INT_MAX)
        return err_set(e, ERR_SCENE, "%s: %zu rows of %zu bytes should follow byte %zu, and %zu bytes do", t->file,
                       t->rows, row, head->data, there);
    double *numbers = ARENA_TAKE(a, double, t->rows * t->columns + 1);
    memcpy(numbers, b->at + head->data,
           bytes); /* as in memory: rasp is for x86-64; the file's bytes need not lie at a multiple of 8 */
    t->numbers = numbers;
    t->lines = ARENA_TAKE(a, int, t->rows + 1);
    for (size_t i = 0; i < t->rows; i++)
        t->lines[i] = (int)i + 1;
    return true;
}

bool table_read_bytes(const char *path, struct bytes b, struct arena *a, struct csv *t, struct err *e)
{
    struct npy head;
    if (!npy_is(&b)) return csv_read_bytes(path, b, a, t, e);
    *t = (struct csv){.file = arena_text(a, path)};
    if (!npy_read(path, &b, a, &head, e)) return false;
    if (!head.n_fields || head.dimensions != 1)
        return err_set(e, ERR_SCENE,
                       "%s: not a table: an NPY array %s; a table has one dimension and fields with names, such as "
                       "dtype [('time_s', '<f8'), ...]",
                       path, head.n_fields ? "of two dimensions" : "without named fields");
    return table_names(&head, t, e) && table_numbers(&b, &head, a, t, e);
}

bool table_read(const char *path, struct arena *a, struct csv *t, struct err *e)
{
    struct bytes b;
    return bytes_read(path, a, &b, e) && table_read_bytes(path, b, a, t, e);
}
