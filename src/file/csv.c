/* See csv.h. The file is read as a whole and taken apart in place: unquoting only shortens a cell, and the comma or
   line end after it becomes its terminator, so cells are pointers into the file. */
#include "file/csv.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file/npy.h"
#include "num/decimal.h"

struct csv_reader {
    const char *file;
    struct arena *arena;
    char *at, *end; /* *end is 0 */
    int line;
    struct err *e;
};

enum { MOST_COLUMNS = 10000 }; /* names are searched one by one */

enum csv_ends { CSV_BAD, CSV_COMMA, CSV_LINE, CSV_FILE };

static bool csv_bad(const struct csv_reader *r, int line, const char *what)
{
    return err_set(r->e, ERR_SCENE, "%s:%d: %s", r->file, line, what);
}

/* Steps over what follows a cell and ends the cell there (at `last`, which may lie before). */
static enum csv_ends csv_after(struct csv_reader *r, char *last)
{
    enum csv_ends ends = CSV_FILE;
    if (r->at < r->end && *r->at == ',') {
        ends = CSV_COMMA;
        r->at++;
    } else if (r->at < r->end) {
        if (*r->at == '\r' && *++r->at != '\n')
            return csv_bad(r, r->line, "a carriage return that is not at the end of a line"), CSV_BAD;
        ends = CSV_LINE;
        r->at++;
        r->line++;
    }
    *last = '\0';
    return ends;
}

static enum csv_ends csv_quoted(struct csv_reader *r, char **cell)
{
    int line = r->line;
    char *to = ++r->at;
    *cell = to;
    for (; r->at < r->end; *to++ = *r->at++) {
        if (*r->at == '\n') r->line++;
        if (*r->at != '"') continue;
        if (*++r->at == '"') continue;
        if (r->at < r->end && !strchr(",\r\n", *r->at))
            return csv_bad(r, r->line, "text after a closing quote; a quote inside a quoted cell is written twice"),
                   CSV_BAD;
        return csv_after(r, to);
    }
    return csv_bad(r, line, "a quote is opened here and never closed: close it, or take it out"), CSV_BAD;
}

static enum csv_ends csv_cell(struct csv_reader *r, char **cell)
{
    if (*r->at == '"') return csv_quoted(r, cell);
    *cell = r->at;
    r->at += strcspn(r->at, ",\r\n\"");
    if (*r->at == '"')
        return csv_bad(r, r->line,
                       "a quote inside a cell that does not begin with one: write the cell in quotes, and those in it "
                       "twice"),
               CSV_BAD;
    return csv_after(r, r->at);
}

static size_t csv_count(const char *at, const char *end, char c)
{
    size_t n = 0;
    while ((at = memchr(at, c, (size_t)(end - at))) != NULL) {
        n++;
        at++;
    }
    return n;
}

static bool csv_comments(struct csv_reader *r, struct csv *t)
{
    while (r->at < r->end && strchr("#\r\n", *r->at)) {
        int line = r->line++;
        char *s = r->at, *stop = memchr(s, '\n', (size_t)(r->end - s));
        r->at = stop ? stop + 1 : r->end;
        if (stop) *stop = '\0';
        size_t n = strlen(s);
        if (n > 0 && s[n - 1] == '\r') s[n - 1] = '\0'; /* the line's end, of the other kind */
        if (*s != '#') continue;
        char *colon = strchr(s, ':'), *value = colon ? colon + 1 : s + 1;
        if (colon) *colon = '\0';
        t->comments[t->n_comments++] = (struct csv_pair){colon ? bytes_trim(s + 1) : "", bytes_trim(value), line};
    }
    return r->at < r->end || csv_bad(r, r->line, "there is no header line");
}

static bool csv_header(struct csv_reader *r, struct csv *t)
{
    int line = r->line;
    for (enum csv_ends ends = CSV_COMMA; ends == CSV_COMMA;) {
        char *cell;
        if ((ends = csv_cell(r, &cell)) == CSV_BAD) return false;
        if (!*cell)
            return err_set(r->e, ERR_SCENE, "%s:%d: column %zu has no name: give it one", r->file, line,
                           t->columns + 1);
        if (csv_column(t, cell) >= 0)
            return err_set(r->e, ERR_SCENE, "%s:%d: two columns are called '%s': rename one", r->file, line, cell);
        if (t->columns == MOST_COLUMNS)
            return err_set(r->e, ERR_SCENE, "%s:%d: more than %d columns: leave some out", r->file, line, MOST_COLUMNS);
        t->names[t->columns++] = cell;
    }
    return true;
}

static bool csv_row(struct csv_reader *r, struct csv *t)
{
    int line = r->line;
    size_t n = 0;
    if (strchr("\r\n", *r->at))
        return csv_bad(r, line,
                       "a blank line among the rows (an empty cell of a table with one column is written \"\")");
    for (enum csv_ends ends = CSV_COMMA; ends == CSV_COMMA; n++) {
        char *cell;
        if ((ends = csv_cell(r, &cell)) == CSV_BAD) return false;
        if (n < t->columns) t->cells[t->rows * t->columns + n] = cell;
    }
    if (n != t->columns)
        return err_set(
            r->e, ERR_SCENE,
            "%s:%d: %zu cells, where the header has %zu columns: mend the row; every row has one cell for each column",
            r->file, line, n, t->columns);
    t->lines[t->rows++] = line;
    return true;
}

static bool read_bytes(const char *path, struct bytes b, struct arena *a, struct csv *t, struct err *e)
{
    *t = (struct csv){.file = arena_text(a, path)};
    const char *nul = memchr(b.at, '\0', b.n);
    if (nul)
        return err_set(e, ERR_SCENE, "%s:%zu: a NUL byte: this is not text; save the table as CSV in UTF-8", path,
                       csv_count(b.at, nul, '\n') + 1);
    struct csv_reader r = {t->file, a, b.at, b.at + b.n, 1, e};
    if (b.n >= 3 && !memcmp(b.at, "\xef\xbb\xbf", 3)) /* the byte order mark of spreadsheet programs */
        r.at += 3;
    /* room by the most there can be: a cell ends at a comma or a line end */
    size_t lines = csv_count(r.at, r.end, '\n') + 1, cells = csv_count(r.at, r.end, ',') + lines;
    t->comments = ARENA_TAKE(a, struct csv_pair, lines);
    t->names = ARENA_TAKE(a, const char *, cells);
    t->cells = ARENA_TAKE(a, const char *, cells);
    t->lines = ARENA_TAKE(a, int, lines);
    if (!csv_comments(&r, t) || !csv_header(&r, t)) return false;
    while (r.at + strspn(r.at, "\r\n") != r.end) /* only blank lines are left */
        if (!csv_row(&r, t)) return false;
    return true;
}

bool csv_read(const char *path, struct arena *a, struct csv *t, struct err *e)
{
    struct bytes b;
    return bytes_read(path, a, &b, e) && read_bytes(path, b, a, t, e);
}

bool csv_read_file(const char *path, struct arena *a, struct csv *t, struct err *e)
{
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) return err_set(e, ERR_INPUT, "%s: is not a file", path);
    return csv_read(path, a, t, e);
}

int csv_column(const struct csv *t, const char *name)
{
    for (size_t i = 0; i < t->columns; i++)
        if (!strcmp(t->names[i], name)) return (int)i;
    return -1;
}

const char *csv_text(const struct csv *t, size_t row, int column, char room[CSV_ROOM])
{
    size_t at = row * t->columns + (size_t)column;
    if (!t->numbers) return t->cells[at];
    snprintf(room, CSV_ROOM, "%.17g", t->numbers[at]);
    return room;
}

bool csv_number(const struct csv *t, size_t row, int column, double *value, struct err *e)
{
    char *end, room[CSV_ROOM];
    if (t->numbers && isfinite(*value = t->numbers[row * t->columns + (size_t)column])) return true;
    const char *s = csv_text(t, row, column, room);
    double v = strtod(s, &end);
    bool whole = end > s && end[strspn(end, " \t")] == '\0' && strspn(s, " \t0123456789+-.eE") == strlen(s);
    if (!whole || !isfinite(v))
        return err_set(e, ERR_SCENE, "%s:%d: column '%s': '%s' is not a %snumber: mend the cell", t->file,
                       t->lines[row], t->names[column], s, whole ? "finite " : "");
    *value = v;
    return true;
}

const char *csv_comment(const struct csv *t, const char *key)
{
    for (size_t i = 0; i < t->n_comments; i++)
        if (!strcmp(t->comments[i].key, key)) return t->comments[i].value;
    return NULL;
}

void csv_put_number(FILE *f, double value)
{
    char text[DECIMAL_ROOM];
    fwrite(text, 1, decimal_9g(value, text), f);
}

bool csv_table_read(const char *path, struct arena *a, struct csv *t, struct err *e)
{
    struct bytes b;
    struct npy head;
    size_t bytes;
    if (!bytes_read(path, a, &b, e)) return false;
    if (!npy_is(&b)) return read_bytes(path, b, a, t, e);
    *t = (struct csv){.file = arena_text(a, path)};
    if (!npy_read(path, &b, a, &head, e)) return false;
    if (!head.n_fields || head.dimensions != 1)
        return err_set(e, ERR_SCENE,
                       "%s: not a table: an NPY array %s; a table has one dimension and fields with names, such as "
                       "dtype [('time_s', '<f8'), ...]",
                       path, head.n_fields ? "of two dimensions" : "without named fields");
    t->names = head.fields;
    for (; t->columns < head.n_fields; t->columns++)
        if (csv_column(t, head.fields[t->columns]) >= 0)
            return err_set(e, ERR_SCENE, "%s: two fields are called '%s'", t->file, head.fields[t->columns]);
    size_t row = head.n_fields * sizeof(double), there = b.n - head.data;
    t->rows = head.shape[0];
    if (__builtin_mul_overflow(t->rows, row, &bytes) || bytes != there || t->rows > INT_MAX)
        return err_set(e, ERR_SCENE, "%s: %zu rows of %zu bytes should follow byte %zu, and %zu bytes do", t->file,
                       t->rows, row, head.data, there);
    double *numbers = ARENA_TAKE(a, double, t->rows * t->columns + 1);
    /* as in memory: rasp is for x86-64; the file's bytes need not lie at a multiple of 8 */
    memcpy(numbers, b.at + head.data, bytes);
    t->numbers = numbers;
    t->lines = ARENA_TAKE(a, int, t->rows + 1);
    for (size_t i = 0; i < t->rows; i++)
        t->lines[i] = (int)i + 1;
    return true;
}

static int by_name(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

const char **csv_folder_files(const char *folder, int *n, struct arena *a)
{
    const char *index = arena_format(a, "%s/index.csv", folder);
    struct csv t;
    struct err unreadable = {0};
    *n = 0;
    if (access(index, F_OK) != 0) return NULL;
    int column = csv_read_file(index, a, &t, &unreadable) && t.cells ? csv_column(&t, "file_name") : -1;
    size_t rows = column >= 0 ? t.rows : 0;
    const char **files = ARENA_TAKE(a, const char *, rows + 1);
    files[(*n)++] = index;
    for (size_t i = 0; i < rows; i++)
        files[(*n)++] = arena_format(a, "%s/%s", folder, t.cells[i * t.columns + (size_t)column]);
    qsort(files, (size_t)*n, sizeof *files, by_name);
    return files;
}
