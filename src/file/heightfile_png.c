/* 16-bit grey PNG through libpng: heights 0 .. 65535, white being the top. Gamma and physical-size chunks are not
   looked at: a height is no brightness, and programs write 72 dpi into everything. 8 bits are refused: 256 levels over
   20 um are steps of 78 nm, whose noise in the curvature is far above what the limiter lets pass (step
   sqrt(6/12)/pitch^2).

   Written are Gwyddion's text chunks Gwy::XReal, YReal, ZMin, ZMax, XYUnit, ZUnit, Title, so that Gwyddion opens the
   file in metres. */
#include "file/heightfile_png.h"

#include <math.h>
#include <png.h>
#include <string.h>

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

static void make_rows(struct reading *r, const struct heightfile *h)
{
    unsigned char *all = arena_take(r->own, h->rows * h->columns, 2);
    r->rows = ARENA_TAKE(r->own, png_bytep, h->rows);
    for (size_t i = 0; i < h->rows; i++)
        r->rows[i] = all + i * h->columns * 2;
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
    make_rows(r, h);
    png_read_image(r->png, r->rows);
    png_read_end(r->png, NULL);
    return true;
}

bool heightfile_png_is(const struct bytes *b) { return b->n >= 8 && !memcmp(b->at, "\x89PNG\r\n\x1a\n", 8); }

bool heightfile_png_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e)
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

static void png_say_all(struct writing *w)
{
    png_say_number(w, "Gwy::XReal", w->h->pitch_x * (double)w->h->columns);
    png_say_number(w, "Gwy::YReal", (w->h->rows > 1 ? w->h->pitch_y : w->h->pitch_x) * (double)w->h->rows);
    png_say_number(w, "Gwy::ZMin", w->low);
    png_say_number(w, "Gwy::ZMax", w->low + w->range);
    png_say(w, "Gwy::XYUnit", "m");
    png_say(w, "Gwy::ZUnit", "m");
    if (w->h->title) png_say(w, "Gwy::Title", w->h->title);
}

static void png_put_row(struct writing *w, const double *z)
{
    for (size_t i = 0; i < w->h->columns; i++) {
        unsigned v = w->range > 0 ? (unsigned)rint((z[i] - w->low) / w->range * 65535) : 0;
        w->row[2 * i] = (unsigned char)(v >> 8);
        w->row[2 * i + 1] = (unsigned char)v;
    }
    png_write_row(w->png, w->row);
}

static bool png_put(struct writing *w)
{
    if (setjmp(png_jmpbuf(w->png))) return false;
    png_init_io(w->png, w->f);
    png_set_IHDR(w->png, w->info, (png_uint_32)w->h->columns, (png_uint_32)w->h->rows, 16, PNG_COLOR_TYPE_GRAY,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_say_all(w);
    png_write_info(w->png, w->info);
    for (size_t i = 0; i < w->h->rows; i++)
        png_put_row(w, w->h->z + i * w->h->columns);
    png_write_end(w->png, w->info);
    return true;
}

bool heightfile_png_write(FILE *f, const struct heightfile *h, double low, double range, struct err *e)
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
