/* Comma-separated tables: reading (RFC 4180 quoting, '#' comment lines before the header kept as key: value pairs, LF
   or CRLF) and writing (LF, %.9g). A comment without a colon is a pair with the key "". Blank lines may stand before
   the header and at the end of the file; a cell's blanks belong to it. */
#ifndef FILE_CSV_H
#define FILE_CSV_H
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"
#include "file/bytes.h"

struct csv_pair {
    const char *key, *value;
    int line;
};

struct csv {
    const char *file;
    struct csv_pair *comments; /* "# key: value" lines before the header        */
    size_t n_comments;
    const char **names; /* the header                                    */
    size_t columns, rows;
    const char **cells;    /* [rows][columns], unquoted text, never NULL; NULL as a whole: numbers */
    const double *numbers; /* [rows][columns] of a table that is no text (csv_table_read), else NULL      */
    int *lines;            /* [rows] line each row starts on; of numbers the row's own number, from 1 */
};

enum { CSV_ROOM = 32 };

/* Also of bytes that were read from the path, and are taken apart in place. ERR_INPUT missing or unreadable; ERR_SCENE:
   no header, a row with another number of cells, an open quote, NUL bytes, duplicate or empty column names; the text
   says file:line: what. */
bool csv_read(const char *path, struct arena *a, struct csv *t, struct err *e);

bool csv_read_file(const char *path, struct arena *a, struct csv *t,
                   struct err *e); /* of one that another file names: a pipe, a device or a folder is none, ERR_INPUT */

/* Column by name, or -1. */
int csv_column(const struct csv *t, const char *name);

/* A cell's text; a number is written into `room`, so that it can be read back to the bit. */
const char *csv_text(const struct csv *t, size_t row, int column, char room[CSV_ROOM]);

/* A cell as a finite number; ERR_SCENE "file:line: column 'name': ... is not a number". */
bool csv_number(const struct csv *t, size_t row, int column, double *value, struct err *e);

/* The value of a comment, or NULL. */
const char *csv_comment(const struct csv *t, const char *key);

/* Writes a cell of a number (%.9g; "nan", "inf"); the caller puts the commas. */

void csv_put_number(FILE *f, double value);

/* A table whatever its format: CSV (csv.h) or, known by its first bytes, NPY with named fields of float64, one
 * dimension. */

/* As csv_read. Of NPY t->numbers is set, and t->cells is NULL. ERR_SCENE, too: an NPY array without named fields. */
bool csv_table_read(const char *path, struct arena *a, struct csv *t, struct err *e);

/* A folder whose index.csv says in its column file_name which of the folder's files belong to it. */

/* index.csv and what it names, by name, each "FOLDER/NAME"; index.csv alone where it cannot be read. *n 0: the folder
 * has none, or is no folder. */
const char **csv_folder_files(const char *folder, int *n, struct arena *a);

#endif
