/* A grid of numbers as text: one row of the map a line, all of the same length. Cells are separated by semicolons, or
   else by commas, or else by blanks, whichever the first line of numbers has; a cell that is empty or nan is a missing
   point (with blanks: nan). Lines that begin with # and blank lines are passed over. A profile may also stand one
   number a line.  Decimal points, never commas. */
#include "file/heightfile_csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "file/heightfile_unit.h"

struct grid {
    const char *path, *end;
    const char *gaps; /* what separates cells */
    size_t columns, rows;
    struct err *e;
};

static const char *skip_blanks(const char *p) { return p + strspn(p, " \t"); }

/* The first line of numbers at or behind p; lines are counted in *line. */
static const char *next_row(const char *p, const char *end, int *line)
{
    while (p < end) {
        const char *q = skip_blanks(p);
        if (*q && !strchr("#\r\n", *q)) return p;
        p = q + strcspn(q, "\n");
        if (*p != '\n') break; /* the end, or a NUL */
        p++;
        *line += 1;
    }
    return NULL;
}

/* One number or nan; 0: neither. */
static size_t number_length(const char *p)
{
    size_t n = text_number_length(p);
    return n > 0 || strncasecmp(p, "nan", 3) != 0 ? n : 3;
}

static const char *after_bom(const struct bytes *b)
{
    return b->at + (b->n >= 3 && !memcmp(b->at, "\xef\xbb\xbf", 3) ? 3 : 0);
}

bool heightfile_csv_is(const struct bytes *b)
{
    int line = 0;
    const char *row = next_row(after_bom(b), b->at + b->n, &line), *p = row ? skip_blanks(row) : NULL;
    if (!p || memchr(b->at, '\0', b->n)) return false;
    p += *p == ',' || *p == ';' ? 1 + strspn(p + 1, ",; \t") : 0;
    size_t n = number_length(p);
    return n > 0 && (p[n] == '\0' || strchr(",; \t\r\n", p[n]));
}

/* One cell; p moves behind it and its separator. False: neither a number, nan nor (between separators) empty. */
static bool cell(const struct grid *g, const char **p, double *z, bool *last)
{
    const char *at = skip_blanks(*p);
    size_t n = number_length(at);
    *z = n == 0 || (*at | 32) == 'n' ? NAN : strtod(at, NULL);
    const char *stop = skip_blanks(at + n);
    *last = *stop == '\0' || *stop == '\n' || *stop == '\r';
    if (*g->gaps == ' ')
        *p = stop;
    else
        *p = stop + (*stop == *g->gaps);
    return *g->gaps == ' ' ? n > 0 && (*last || stop > at + n) : *last || *stop == *g->gaps;
}

static bool bad_cell(const struct grid *g, int line, size_t column, const char *p)
{
    p = skip_blanks(p);
    int n = (int)strcspn(p, *g->gaps == ' ' ? " \t\r\n" : *g->gaps == ';' ? ";\r\n" : ",\r\n");
    bool comma = *g->gaps == ';' && memchr(p, ',', (size_t)n);
    return err_set(g->e, ERR_SCENE, "%s:%d: column %zu: '%.*s' is not a number%s", g->path, line, column + 1,
                   n < 40 ? n : 40, p, comma ? "; write decimal points instead of commas" : "");
}

/* One line into z (NULL: only counted); p moves to the next. */
static bool read_row(const struct grid *g, const char **p, int line, double *z, size_t *columns)
{
    bool last = false;
    for (*columns = 0; !last; ++*columns) {
        const char *at = *p;
        double v;
        if (!cell(g, p, &v, &last)) return bad_cell(g, line, *columns, at);
        if (z && *columns < g->columns) z[*columns] = v;
    }
    *p += strcspn(*p, "\n");
    *p += **p == '\n';
    return true;
}

/* All lines: counted, and with z read. */
static bool read_grid(struct grid *g, const char *from, double *z)
{
    int line = 1, first = 0;
    size_t n;
    g->rows = 0;
    for (const char *p = from; (p = next_row(p, g->end, &line)) != NULL; line++) {
        if (!read_row(g, &p, line, z ? z + g->rows * g->columns : NULL, &n)) return false;
        first = first ? first : line;
        if (g->rows > 0 && n != g->columns)
            return err_set(g->e, ERR_SCENE,
                           "%s:%d: has %zu numbers, and line %d has %zu: all rows of a height map are equally long",
                           g->path, line, n, first, g->columns);
        g->columns = n;
        g->rows++;
    }
    return true;
}

bool heightfile_csv_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e)
{
    int line = 0;
    const char *from = after_bom(b), *row = next_row(from, b->at + b->n, &line);
    size_t n = strcspn(row, "\r\n");
    struct grid g = {.path = path,
                     .end = b->at + b->n,
                     .gaps = memchr(row, ';', n)   ? ";"
                             : memchr(row, ',', n) ? ","
                                                   : " ",
                     .e = e};
    if (!read_grid(&g, from, NULL)) return false;
    h->rows = g.columns == 1 ? 1 : g.rows;
    h->columns = g.columns == 1 ? g.rows : g.columns;
    h->format = "CSV";
    return heightfile_room(path, h, a, e) && read_grid(&g, from, h->z);
}

void heightfile_csv_write(FILE *f, const struct heightfile *h)
{
    char x[32], y[32];
    fprintf(f, "# heights in m, %zu columns, %zu rows, pitch %s m", h->columns, h->rows,
            heightfile_unit_text(x, h->pitch_x));
    if (h->rows > 1) fprintf(f, " along a row, %s m from row to row", heightfile_unit_text(y, h->pitch_y));
    fputc('\n', f);
    for (size_t i = 0; i < h->columns * h->rows; i++) {
        fputs(heightfile_unit_text(x, h->z[i]), f);
        fputc((i + 1) % h->columns ? ',' : '\n', f);
    }
}
