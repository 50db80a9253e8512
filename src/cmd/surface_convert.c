/* rasp surface convert IN OUT: a height map in another format, or a part of it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cmd/spares.h"
#include "cmd/surface.h"
#include "file/heightfile_write.h"
#include "output/mark.h"
#include "scene/units.h"

struct convert {
    struct cmd_call *c;
    struct heightfile h;
    double crop[4];      /* m: left, top, width, height */
    bool cropped;
};

/* X,Y,W,H, or X,W, each a length. */
static bool read_crop(struct convert *v, struct err *e)
{
    const char *text = args_value(&v->c->args, "crop");
    double x[4];
    int n = 0;
    v->cropped = text != NULL;
    if (!text)
        return true;
    for (char *p = arena_text(v->c->arena, text), *next; p; p = next) {
        struct units_fault fault = {NULL, NULL};
        next = strchr(p, ',');
        if (next)
            *next++ = '\0';
        if (n == 4 || !units_read(p, KEY_LENGTH, &x[n++], v->c->arena, &fault))
            return err_set(e, ERR_USAGE, "--crop: '%s': %s %s", text, fault.text ? p : "has", fault.text ? fault.text : "more than four lengths");
    }
    if (n != 4 && n != 2)
        return err_set(e, ERR_USAGE, "--crop: '%s' is not of the form X,Y,W,H (of a profile X,W), as in 1mm,1mm,5mm,5mm", text);
    v->crop[0] = x[0];
    v->crop[1] = n == 4 ? x[1] : 0;
    v->crop[2] = n == 4 ? x[2] : x[1];
    v->crop[3] = n == 4 ? x[3] : HUGE_VAL;
    return (v->crop[0] >= 0 && v->crop[1] >= 0 && v->crop[2] > 0 && v->crop[3] > 0) ||
           err_set(e, ERR_USAGE, "--crop: '%s': a part begins at 0 or later and is larger than 0", text);
}

/* The first sample and the number of samples of [from, from + size), in samples of one direction; sample i lies at i pitch. */
static bool crop_range(const char *what, double from, double size, double pitch, size_t n, size_t range[2], struct err *e)
{
    double first = ceil(from / pitch - 1e-6), last = ceil((from + size) / pitch - 1e-6);
    if (isinf(size))
        last = (double)n;
    if (last > (double)n)
        return err_set(e, ERR_SCENE, "--crop: the %s goes from %g to %g m, and the map to %g m", what, from, from + size, pitch * (double)n);
    if (last - first < 1)
        return err_set(e, ERR_SCENE, "--crop: no sample lies in the %s from %g to %g m; they are %g m apart", what, from, from + size, pitch);
    range[0] = (size_t)first;
    range[1] = (size_t)(last - first);
    return true;
}

/* Keeps columns x[0] .. and rows y[0] ..; in place. */
static void keep(struct heightfile *h, const size_t x[2], const size_t y[2])
{
    for (size_t j = 0; j < y[1]; j++)
        memmove(h->z + j * x[1], h->z + (y[0] + j) * h->columns + x[0], x[1] * sizeof *h->z);
    h->columns = x[1];
    h->rows = y[1];
    h->holes = 0;
    for (size_t i = 0; i < h->columns * h->rows; i++)
        h->holes += isnan(h->z[i]);
}

static bool crop(struct convert *v, struct err *e)
{
    struct heightfile *h = &v->h;
    size_t x[2], y[2] = {0, 1};
    if (!v->cropped)
        return true;
    if (h->rows == 1 && isfinite(v->crop[3]))
        return err_set(e, ERR_USAGE, "--crop: a profile has no height: give X,W");
    if (h->rows > 1 && isinf(v->crop[3]))
        return err_set(e, ERR_USAGE, "--crop: a map needs X,Y,W,H");
    if (!crop_range("width", v->crop[0], v->crop[2], h->pitch_x, h->columns, x, e) ||
        (h->rows > 1 && !crop_range("height", v->crop[1], v->crop[3], h->pitch_y, h->rows, y, e)))
        return false;
    keep(h, x, y);
    return true;
}

static bool take_row(struct convert *v, struct err *e)
{
    static const long range[2] = {0, 0x7fffffff};
    long k = -1;
    size_t x[2] = {0, v->h.columns}, y[2] = {0, 1};
    if (!args_whole(&v->c->args, "row", range, &k, e))
        return false;
    if (k < 0)
        return true;
    if ((size_t)k >= v->h.rows)
        return err_set(e, ERR_SCENE, "--row: row %ld is asked for, and the map has rows 0 to %zu", k, v->h.rows - 1);
    y[0] = (size_t)k;
    keep(&v->h, x, y);
    return true;
}

/* One line: what was written, and what a reader of it has to know. */
static void report(const struct convert *v, const char *out, enum heightfile_format format, const struct heightfile_written *w)
{
    const struct heightfile *h = &v->h;
    printf("%s: ", out);
    if (h->rows > 1)
        printf("%zu x %zu samples, pitch %.9g um x %.9g um", h->columns, h->rows, h->pitch_x * 1e6, h->pitch_y * 1e6);
    else
        printf("%zu samples, pitch %.9g um", h->columns, h->pitch_x * 1e6);
    printf(", heights from %.6g to %.6g um", w->low * 1e6, (w->low + w->range) * 1e6);
    if (h->filled)
        printf(", missing points filled: %zu", h->filled);
    if (h->holes)
        printf(", missing points: %zu", h->holes);
    if (format == HEIGHTFILE_PNG)
        printf("; height range %.9g um (--height-range), 0 stands for %.9g um, steps of %.4g nm", w->range * 1e6, w->low * 1e6, w->step * 1e9);
    if (format == HEIGHTFILE_NPY || format == HEIGHTFILE_CSV || format == HEIGHTFILE_PNG)
        printf("; the format does not hold the pitch: give it when reading");
    putchar('\n');
}

static bool pick_format(const struct cmd_call *c, enum heightfile_format *format, struct err *e)
{
    if (!heightfile_write_format(c->args.operands[1], format, e))
        return false;
    if (args_given(&c->args, "text") && *format != HEIGHTFILE_SDF)
        return err_set(e, ERR_USAGE, "--text is for SDF, which has two forms");
    if (args_given(&c->args, "text"))
        *format = HEIGHTFILE_SDF_TEXT;
    return true;
}

int surface_convert_run(struct cmd_call *c, struct err *e)
{
    struct convert v = {.c = c};
    struct heightfile_options o;
    struct heightfile_written w;
    enum heightfile_format format;
    const char *in = c->args.operands[0], *out = c->args.operands[1];
    if (!pick_format(c, &format, e) || !spares(out, "the heights", in, "a file of another name", e) ||
        !mark_absent(out, args_given(&c->args, "force"), e) || !surface_options(c, HEIGHTFILE_REFUSE, &o, e) || !read_crop(&v, e) ||
        !heightfile_load(in, &o, c->arena, &v.h, e) || !crop(&v, e) || !take_row(&v, e) || !heightfile_write(out, &v.h, format, &w, e))
        return (int)e->kind;
    if (!args_given(&c->args, "quiet"))
        report(&v, out, format, &w);
    return 0;
}
