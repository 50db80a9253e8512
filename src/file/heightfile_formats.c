#include "file/heightfile_formats.h"

#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "file/npy.h"

static const struct {
    const char *name;
    double per_metre;
} units[] = {{"", 1},        {"m", 1},    {"mm", 1e3}, {"um", 1e6}, {"\xc2\xb5m", 1e6}, {"\xce\xbcm", 1e6},
             {"\xb5m", 1e6}, {"nm", 1e9}, {"pm", 1e12}};

bool heightfile_formats_unit(const char *name, double *per_metre)
{
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (!strcmp(name, units[i].name)) {
            *per_metre = units[i].per_metre;
            return true;
        }
    return false;
}

const char *heightfile_formats_number(char text[32], double value)
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (isnan(value) || strtod(text, NULL) == value) break;
    }
    return isnan(value) ? "nan" : text;
}

/* A grid of numbers as text: one row of the map a line, all of the same length. Cells are separated by semicolons, or
   else by commas, or else by blanks, whichever the first line of numbers has; a cell that is empty or nan is a missing
   point (with blanks: nan). Lines that begin with # and blank lines are passed over. A profile may also stand one
   number a line.  Decimal points, never commas. */

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

bool heightfile_formats_csv_is(const struct bytes *b)
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

/* One line into z (NULL: only counted); p moves to the next. */
static bool read_row(const struct grid *g, const char **p, int line, double *z, size_t *columns)
{
    bool last = false;
    for (*columns = 0; !last; ++*columns) {
        const char *at = *p;
        double v;
        if (!cell(g, p, &v, &last)) {
            at = skip_blanks(at);
            int n = (int)strcspn(at, *g->gaps == ' ' ? " \t\r\n" : *g->gaps == ';' ? ";\r\n" : ",\r\n");
            bool comma = *g->gaps == ';' && memchr(at, ',', (size_t)n);
            return err_set(g->e, ERR_SCENE, "%s:%d: column %zu: '%.*s' is not a number%s", g->path, line, *columns + 1,
                           n < 40 ? n : 40, at, comma ? "; write decimal points instead of commas" : "");
        }
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
                           "%s:%d: has %zu numbers, and line %d has %zu: all rows of a height map are equally long: "
                           "write as many in each",
                           g->path, line, n, first, g->columns);
        g->columns = n;
        g->rows++;
    }
    return true;
}

bool heightfile_formats_csv_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e)
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

void heightfile_formats_csv_write(FILE *f, const struct heightfile *h)
{
    char x[32], y[32];
    fprintf(f, "# heights in m, %zu columns, %zu rows, pitch %s m", h->columns, h->rows,
            heightfile_formats_number(x, h->pitch_x));
    if (h->rows > 1) fprintf(f, " along a row, %s m from row to row", heightfile_formats_number(y, h->pitch_y));
    fputc('\n', f);
    for (size_t i = 0; i < h->columns * h->rows; i++) {
        fputs(heightfile_formats_number(x, h->z[i]), f);
        fputc((i + 1) % h->columns ? ',' : '\n', f);
    }
}

/* Gwyddion Simple Field 1.0 (gwyddion.net, "Gwyddion simple field files"):

     "Gwyddion Simple Field 1.0\n"  lines "name = value\n"  1 to 4 NUL bytes, so that the data begin at a multiple of 4
     XRes * YRes float32, little-endian, row by row

   XRes, YRes: numbers of columns and rows, must be there. XReal, YReal: width and height in XYUnits; the format's
   default of 1 is no size anyone measured, so a file without them does not say its pitch. ZUnits: of the heights.
   Without units: metres. NaN: missing. Other names (XOffset ...) do not matter here. */

static const char gsf_magic[] = "Gwyddion Simple Field 1.0";

enum { GSF_XRES, GSF_YRES, GSF_XREAL, GSF_YREAL, GSF_XYUNITS, GSF_ZUNITS, GSF_TITLE, GSF_NAMES };

static const char *const gsf_names[GSF_NAMES] = {"XRes", "YRes", "XReal", "YReal", "XYUnits", "ZUnits", "Title"};

struct gsf {
    const char *path;
    const char *value[GSF_NAMES]; /* NULL: not there */
    int line[GSF_NAMES];
    const char *end; /* of the header: its first NUL */
    struct err *e;
};

static bool gsf_line(struct gsf *g, char *s, int line)
{
    char *equals = strchr(s, '=');
    if (strchr(s, '\r'))
        return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: the line ends in CR LF: write the header with LF",
                       g->path, line);
    if (!equals)
        return err_set(g->e, ERR_SCENE,
                       "%s: GSF header, line %d: '%.40s' is not of the form name = value: the file is damaged", g->path,
                       line, s);
    *equals = '\0';
    for (int i = 0; i < GSF_NAMES; i++) {
        if (strcmp(bytes_trim(s), gsf_names[i]) != 0) continue;
        if (g->value[i])
            return err_set(g->e, ERR_SCENE,
                           "%s: GSF header, line %d: %s is there already, in line %d: the file is damaged", g->path,
                           line, gsf_names[i], g->line[i]);
        g->value[i] = bytes_trim(equals + 1);
        g->line[i] = line;
    }
    return true;
}

/* Takes the header apart; it ends at the first NUL. */
static bool gsf_header(struct gsf *g, char *at)
{
    int line = 2;
    g->end = at;
    for (char *s = at, *stop; *s; s = stop + 1, line++) {
        stop = strchr(s, '\n');
        if (!stop)
            return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: the line has no end: the file is damaged",
                           g->path, line);
        *stop = '\0';
        if (*bytes_trim(s) && !gsf_line(g, s, line)) return false;
        g->end = stop + 1;
    }
    return true;
}

static bool gsf_bad(const struct gsf *g, int name, const char *wants)
{
    return err_set(g->e, ERR_SCENE, "%s: GSF header, line %d: %s must be %s, not '%s'", g->path, g->line[name],
                   gsf_names[name], wants, g->value[name]);
}

static bool gsf_resolution(const struct gsf *g, int name, size_t *n)
{
    const char *s = g->value[name];
    if (!s)
        return err_set(g->e, ERR_SCENE, "%s: the GSF header has no %s: the file is damaged", g->path, gsf_names[name]);
    if (!*s || strspn(s, "0123456789") != strlen(s) || strlen(s) > 9 || strtol(s, NULL, 10) == 0)
        return gsf_bad(g, name, "a whole number from 1 to 999999999");
    *n = (size_t)strtol(s, NULL, 10);
    return true;
}

/* How many of the unit make a metre. */
static bool gsf_unit(const struct gsf *g, int name, double *per_metre)
{
    return heightfile_formats_unit(g->value[name] ? g->value[name] : "", per_metre) ||
           gsf_bad(g, name, "a length (m, mm, um, nm)");
}

static bool gsf_pitch(const struct gsf *g, int name, size_t n, double *pitch)
{
    const char *s = g->value[name];
    char *end;
    double per_metre = 1;
    *pitch = NAN;
    if (!gsf_unit(g, GSF_XYUNITS, &per_metre)) return false;
    if (!s) return true;
    double size = strtod(s, &end);
    if (!*s || *end || !isfinite(size) || size <= 0) return gsf_bad(g, name, "a positive number");
    *pitch = size / per_metre / (double)n;
    return true;
}

static bool gsf_data(const struct gsf *g, const struct bytes *b, struct arena *a, struct heightfile *h)
{
    double per_metre = 1;
    size_t header = (size_t)(g->end - b->at), n = h->rows * h->columns; /* both below 1e9: no overflow */
    size_t start = header + 4 - header % 4, there = b->n > start ? b->n - start : 0;
    if (!gsf_unit(g, GSF_ZUNITS, &per_metre)) return false;
    for (size_t i = header; i < start; i++)
        if (i >= b->n || b->at[i])
            return err_set(g->e, ERR_SCENE, "%s: %zu NUL bytes should follow the GSF header at byte %zu, and %zu do",
                           g->path, start - header, header, i - header);
    if (b->n < start || there != 4 * n)
        return err_set(g->e, ERR_SCENE, "%s: %zu x %zu float32 (%zu bytes) should follow byte %zu, and %zu bytes do",
                       g->path, h->columns, h->rows, 4 * n, start, there);
    if (!heightfile_room(g->path, h, a, g->e)) return false;
    for (size_t i = 0; i < n; i++)
        h->z[i] = bytes_number(b->at + start + 4 * i, 'f', 4) / per_metre;
    h->title = g->value[GSF_TITLE] ? arena_text(a, g->value[GSF_TITLE]) : NULL;
    h->format = "GSF";
    h->metric = true;
    h->bits = 24;
    return true;
}

bool heightfile_formats_gsf_is(const struct bytes *b)
{
    return b->n >= 22 && !memcmp(b->at, gsf_magic, 22); /* up to the version */
}

bool heightfile_formats_gsf_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e)
{
    struct gsf g = {.path = path, .e = e};
    size_t n = strlen(gsf_magic);
    if (b->n <= n || memcmp(b->at, gsf_magic, n) != 0 || b->at[n] != '\n')
        return err_set(e, ERR_SCENE, "%s: GSF header, line 1: is not '%s' with a line feed%s: the file is damaged",
                       path, gsf_magic, b->n > n && b->at[n] == '\r' ? " (it ends in CR LF)" : "");
    if (!memchr(b->at, '\0', b->n))
        return err_set(e, ERR_SCENE, "%s: it is cut short: no NUL byte ends the GSF header", path);
    return gsf_header(&g, b->at + n + 1) && gsf_resolution(&g, GSF_XRES, &h->columns) &&
           gsf_resolution(&g, GSF_YRES, &h->rows) && gsf_pitch(&g, GSF_XREAL, h->columns, &h->pitch_x) &&
           gsf_pitch(&g, GSF_YREAL, h->rows, &h->pitch_y) && gsf_data(&g, b, a, h);
}

/* Heights from NPY (npy.h): an array of one or two dimensions, of plain numbers. The data must fill the rest of the
 * file exactly. */

static const struct npy_type {
    char name[3];
    size_t size;
    int bits;
} npy_types[] = {{"f4", 4, 24}, {"f8", 8, 53}, {"i2", 2, 16}, {"u2", 2, 16}, {"i4", 4, 32}};

bool heightfile_formats_npy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e)
{
    struct npy head;
    const struct npy_type *type = NULL;
    if (!npy_read(path, b, a, &head, e)) return false;
    if (head.n_fields)
        return err_set(e, ERR_SCENE,
                       "%s: a table of %zu fields, not an array of plain numbers; save one of them, as in "
                       "numpy.save(file, t['%s'])",
                       path, head.n_fields, head.fields[0]);
    for (size_t i = 0; i < sizeof npy_types / sizeof npy_types[0]; i++)
        if (strchr("<>", head.descr[0]) && !strcmp(head.descr + 1, npy_types[i].name)) type = &npy_types[i];
    if (!type)
        return err_set(e, ERR_SCENE,
                       "%s: NPY numbers of type '%s'; f4, f8, i2, u2 and i4 are read: save the array as float64", path,
                       head.descr);
    const char *at = b->at + head.data;
    size_t n, bytes, there = b->n - head.data;
    h->pitch_x = h->pitch_y = NAN;
    h->rows = head.dimensions == 2 ? head.shape[0] : 1;
    h->columns = head.shape[head.dimensions - 1];
    if (h->rows == 0 || h->columns == 0)
        return err_set(e, ERR_SCENE, "%s: the array is empty (%zu x %zu)", path, h->rows, h->columns);
    if (__builtin_mul_overflow(h->rows, h->columns, &n) || __builtin_mul_overflow(n, type->size, &bytes) ||
        bytes != there)
        return err_set(e, ERR_SCENE, "%s: %zu x %zu numbers of %zu bytes should follow byte %zu, and %zu bytes do",
                       path, h->rows, h->columns, type->size, head.data, there);
    if (!heightfile_room(path, h, a, e)) return false;
    h->format = "NPY";
    h->bits = type->bits;
    h->step = type->name[0] == 'f' ? 0 : 1;
    if (!strcmp(head.descr, "<f8")) { /* as in memory: rasp is for x86-64 */
        memcpy(h->z, at, bytes);
        return true;
    }
    for (size_t i = 0; i < n; i++) {
        char turned[8]; /* of big-endian numbers the bytes are turned round */
        for (size_t k = 0; k < type->size; k++)
            turned[k] = at[i * type->size + (head.descr[0] == '>' ? type->size - 1 - k : k)];
        h->z[i] = bytes_number(turned, type->name[0], type->size);
    }
    return true;
}

/* 16-bit grey PNG through libpng: heights 0 .. 65535, white being the top. Gamma and physical-size chunks are not
   looked at: a height is no brightness, and programs write 72 dpi into everything. 8 bits are refused: 256 levels over
   20 um are steps of 78 nm, whose noise in the curvature is far above what the limiter lets pass (step
   sqrt(6/12)/pitch^2).

   Written are Gwyddion's text chunks Gwy::XReal, YReal, ZMin, ZMax, XYUnit, ZUnit, Title, so that Gwyddion opens the
   file in metres. */

struct reading {
    const char *path;
    const struct bytes *b;
    size_t at;
    struct err *e;
    png_structp png;
    png_infop info;
    png_bytepp rows;
    struct arena *own;
};

static void png_fails(png_structp png, png_const_charp text)
{
    struct reading *r = png_get_error_ptr(png);
    err_set(r->e, ERR_SCENE, "%s: damaged PNG at byte %zu of %zu: %s", r->path, r->at, r->b->n, text);
    png_longjmp(png, 1);
}

static void png_warns(png_structp png, png_const_charp text) { (void)png, (void)text; }

static void png_gives(png_structp png, png_bytep to, size_t n)
{
    struct reading *r = png_get_io_ptr(png);
    if (r->b->n - r->at < n) png_error(png, "the file is cut short");
    memcpy(to, r->b->at + r->at, n);
    r->at += n;
}

/* Deflate packs at most 1032 to one. */
static bool check_kind(struct reading *r, struct heightfile *h)
{
    int bits = png_get_bit_depth(r->png, r->info), kind = png_get_color_type(r->png, r->info);
    if (kind != PNG_COLOR_TYPE_GRAY)
        return err_set(r->e, ERR_SCENE, "%s: the PNG is in colour or has transparency; a height map is 16-bit grey",
                       r->path);
    if (bits != 16)
        return err_set(
            r->e, ERR_SCENE,
            "%s: the PNG has %d bits, so %d heights: too coarse, the steps would be heard; export 16-bit grey, or GSF",
            r->path, bits, 1 << bits);
    h->columns = png_get_image_width(r->png, r->info);
    h->rows = png_get_image_height(r->png, r->info);
    return (double)h->columns * (double)h->rows * 2 <= 1100 * (double)r->b->n ||
           err_set(r->e, ERR_SCENE, "%s: the PNG says %zu x %zu samples, and has %zu bytes: it is cut short", r->path,
                   h->columns, h->rows, r->b->n);
}

/* libpng's way out of an error is a jump: so what changes after setjmp lies in *r and *h. */
static bool png_run(struct reading *r, struct arena *a, struct heightfile *h)
{
    if (setjmp(png_jmpbuf(r->png))) return false;
    png_set_read_fn(r->png, r, png_gives);
    png_set_keep_unknown_chunks(r->png, PNG_HANDLE_CHUNK_NEVER, NULL,
                                -1); /* else memory is taken for whatever length a damaged chunk says */
    png_read_info(r->png, r->info);
    if (!check_kind(r, h) || !heightfile_room(r->path, h, a, r->e)) return false;
    unsigned char *all = arena_take(r->own, h->rows * h->columns, 2);
    r->rows = ARENA_TAKE(r->own, png_bytep, h->rows);
    for (size_t i = 0; i < h->rows; i++)
        r->rows[i] = all + i * h->columns * 2;
    png_read_image(r->png, r->rows);
    png_read_end(r->png, NULL);
    return true;
}

bool heightfile_formats_png_is(const struct bytes *b) { return b->n >= 8 && !memcmp(b->at, "\x89PNG\r\n\x1a\n", 8); }

bool heightfile_formats_png_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e)
{
    struct reading r = {.path = path, .b = b, .e = e, .own = arena_open()};
    r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, png_fails, png_warns);
    r.info = r.png ? png_create_info_struct(r.png) : NULL;
    bool ok = r.info ? png_run(&r, a, h) : err_set(e, ERR_MEMORY, "%s: libpng cannot begin", path);
    for (size_t i = 0; ok && i < h->rows * h->columns; i++)
        h->z[i] = r.rows[0][2 * i] << 8 | r.rows[0][2 * i + 1];
    h->format = "PNG";
    h->bits = 16;
    h->step = 1;
    h->white = 65535;
    png_destroy_read_struct(&r.png, &r.info, NULL);
    arena_close(r.own);
    return ok;
}

/* ------------------------------------------------------------------ writing */

struct writing {
    struct err *e;
    png_structp png;
    png_infop info;
    FILE *f;
    const struct heightfile *h;
    double low, range;
    unsigned char *row;
    struct arena *own;
};

static void png_cannot(png_structp png, png_const_charp text)
{
    struct writing *w = png_get_error_ptr(png);
    err_set(w->e, ERR_IO, "the PNG cannot be written: %s", text);
    png_longjmp(png, 1);
}

static void png_say(struct writing *w, const char *key, const char *value)
{
    png_text t = {
        .compression = PNG_TEXT_COMPRESSION_NONE, .key = arena_text(w->own, key), .text = arena_text(w->own, value)};
    png_set_text(w->png, w->info, &t, 1);
}

static void png_say_number(struct writing *w, const char *key, double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    png_say(w, key, text);
}

static bool png_put(struct writing *w)
{
    if (setjmp(png_jmpbuf(w->png))) return false;
    png_init_io(w->png, w->f);
    png_set_IHDR(w->png, w->info, (png_uint_32)w->h->columns, (png_uint_32)w->h->rows, 16, PNG_COLOR_TYPE_GRAY,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_say_number(w, "Gwy::XReal", w->h->pitch_x * (double)w->h->columns);
    png_say_number(w, "Gwy::YReal", (w->h->rows > 1 ? w->h->pitch_y : w->h->pitch_x) * (double)w->h->rows);
    png_say_number(w, "Gwy::ZMin", w->low);
    png_say_number(w, "Gwy::ZMax", w->low + w->range);
    png_say(w, "Gwy::XYUnit", "m");
    png_say(w, "Gwy::ZUnit", "m");
    if (w->h->title) png_say(w, "Gwy::Title", w->h->title);
    png_write_info(w->png, w->info);
    for (const double *z = w->h->z, *end = z + w->h->rows * w->h->columns; z < end; z += w->h->columns) {
        for (size_t i = 0; i < w->h->columns; i++) {
            unsigned v = w->range > 0 ? (unsigned)rint((z[i] - w->low) / w->range * 65535) : 0;
            w->row[2 * i] = (unsigned char)(v >> 8);
            w->row[2 * i + 1] = (unsigned char)v;
        }
        png_write_row(w->png, w->row);
    }
    png_write_end(w->png, w->info);
    return true;
}

bool heightfile_formats_png_write(FILE *f, const struct heightfile *h, double low, double range, struct err *e)
{
    struct arena *own = arena_open();
    struct writing w = {.e = e, .f = f, .h = h, .low = low, .range = range, .own = own};
    w.row = ARENA_TAKE(own, unsigned char, 2 * h->columns);
    w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &w, png_cannot, png_warns);
    w.info = w.png ? png_create_info_struct(w.png) : NULL;
    bool ok = w.info ? png_put(&w) : err_set(e, ERR_MEMORY, "libpng cannot begin");
    png_destroy_write_struct(&w.png, &w.info);
    arena_close(own);
    return ok;
}
