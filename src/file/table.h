/* A table whatever its format: CSV (csv.h) or, known by its first bytes, NPY with named fields of float64, one
 * dimension. */
#ifndef FILE_TABLE_H
#define FILE_TABLE_H
#include "file/csv.h"

/* As csv_read. Of NPY t->numbers is set, and t->cells is NULL. ERR_SCENE, too: an NPY array without named fields. */
bool table_read(const char *path, struct arena *a, struct csv *t, struct err *e);
bool table_read_bytes(const char *path, struct bytes b, struct arena *a, struct csv *t, struct err *e);

#endif
