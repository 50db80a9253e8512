/* See heightfile_write.h. */
#include "file/heightfile_write.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>

#include "base/outfile.h"
#include "file/heightfile_csv.h"
#include "file/heightfile_gwy.h"
#include "file/heightfile_png.h"
#include "file/heightfile_sdf.h"
#include "file/heightfile_unit.h"

static const struct {
    const char *ending;
    enum heightfile_format format;
} endings[] = {{".gsf", HEIGHTFILE_GSF}, {".gwy", HEIGHTFILE_GWY}, {".sdf", HEIGHTFILE_SDF},
               {".npy", HEIGHTFILE_NPY}, {".png", HEIGHTFILE_PNG}, {".csv", HEIGHTFILE_CSV}};

bool heightfile_write_format(const char *path, enum heightfile_format *format, struct err *e)
{
    size_t n = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (n > 4 && !strcasecmp(path + n - 4, endings[i].ending)) {
            *format = endings[i].format;
            return true;
        }
    return err_set(e, ERR_USAGE,
                   "%s: the name's ending says the format, and must be .gsf, .gwy, .sdf, .npy, .png or .csv", path);
}

/* A failed write shows in the stream, which the commit looks at. */
static void write_gsf(FILE *f, const struct heightfile *h, const char *title)
{
    static const char nul[4];
    char number[32];
    fprintf(f, "Gwyddion Simple Field 1.0\nXRes = %zu\nYRes = %zu\n", h->columns, h->rows);
    if (!isnan(h->pitch_x)) fprintf(f, "XReal = %s\n", heightfile_unit_text(number, h->pitch_x * (double)h->columns));
    if (!isnan(h->pitch_y)) fprintf(f, "YReal = %s\n", heightfile_unit_text(number, h->pitch_y * (double)h->rows));
    fprintf(f, "XYUnits = m\nZUnits = m\n");
    if (title) fprintf(f, "Title = %s\n", title);
    fwrite(nul, 1, (size_t)(4 - ftello(f) % 4), f);
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        float v = (float)h->z[i];
        uint32_t w;
        memcpy(&w, &v, 4);
        heightfile_unit_put(f, w, 4);
    }
}

/* The dictionary ends in a line feed at a multiple of 64. */
static void write_npy(FILE *f, const struct heightfile *h)
{
    char text[192];
    int n = snprintf(text, sizeof text, "{'descr': '<f8', 'fortran_order': False, 'shape': (");
    n += h->rows > 1 ? snprintf(text + n, sizeof text - (size_t)n, "%zu, %zu), }", h->rows, h->columns)
                     : snprintf(text + n, sizeof text - (size_t)n, "%zu,), }", h->columns);
    int length = (10 + n + 1 + 63) / 64 * 64 - 10;
    fwrite("\x93NUMPY\1\0", 1, 8, f);
    heightfile_unit_put(f, (uint64_t)length, 2);
    fprintf(f, "%-*s\n", length - 1, text);
    for (size_t i = 0; i < h->rows * h->columns; i++)
        heightfile_unit_put_f64(f, h->z[i]);
}

static bool check_heights(const char *path, const struct heightfile *h, double most, struct err *e)
{
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (!(fabs(h->z[i]) <= most) && !(isnan(h->z[i]) && h->holes))
            return err_set(e, ERR_NUMBERS, "%s: the height at row %zu, column %zu is %g, which %s", path,
                           i / h->columns, i % h->columns, h->z[i],
                           isfinite(h->z[i]) ? "float32 does not hold" : "is no height");
    return true;
}

static bool check_title(const char *path, const char *title, struct err *e)
{
    return !title || !title[strcspn(title, "\r\n")] ||
           err_set(e, ERR_SCENE, "%s: the title of a GSF is one line", path);
}

static bool check_fits(const char *path, const struct heightfile *h, enum heightfile_format format, struct err *e)
{
    bool sdf = format == HEIGHTFILE_SDF;
    if (sdf && (h->columns > 65535 || h->rows > 65535))
        return err_set(
            e, ERR_SCENE,
            "%s: %zu x %zu samples; binary SDF holds at most 65535 x 65535: write SDF as text, or GSF, GWY, NPY", path,
            h->columns, h->rows);
    if (format == HEIGHTFILE_PNG && h->holes)
        return err_set(e, ERR_SCENE, "%s: PNG has no way to say that a point is missing, and %zu are: fill them", path,
                       h->holes);
    if (format == HEIGHTFILE_PNG && (h->columns > 1000000 || h->rows > 1000000))
        return err_set(e, ERR_SCENE, "%s: %zu x %zu samples; a PNG may have 1000000 a side", path, h->columns, h->rows);
    return format != HEIGHTFILE_GWY || heightfile_gwy_write_fits(h) ||
           err_set(e, ERR_SCENE, "%s: %zu x %zu samples are more than a GWY file holds (4 GiB): write GSF or NPY", path,
                   h->columns, h->rows);
}

static struct heightfile_written extent(const struct heightfile *h, enum heightfile_format format)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        low = fmin(low, h->z[i]);
        high = fmax(high, h->z[i]);
    }
    return (struct heightfile_written){low, high - low, format == HEIGHTFILE_PNG ? (high - low) / 65535 : 0};
}

static bool write_it(FILE *f, const struct heightfile *h, enum heightfile_format format,
                     const struct heightfile_written *w, struct err *e)
{
    switch (format) {
    case HEIGHTFILE_GSF:
        write_gsf(f, h, h->title);
        break;
    case HEIGHTFILE_GWY:
        heightfile_gwy_write(f, h);
        break;
    case HEIGHTFILE_SDF:
        heightfile_sdf_write(f, h, true);
        break;
    case HEIGHTFILE_SDF_TEXT:
        heightfile_sdf_write(f, h, false);
        break;
    case HEIGHTFILE_NPY:
        write_npy(f, h);
        break;
    case HEIGHTFILE_PNG:
        return heightfile_png_write(f, h, w->low, w->range, e);
    case HEIGHTFILE_CSV:
        heightfile_csv_write(f, h);
        break;
    }
    return true;
}

bool heightfile_write(const char *path, const struct heightfile *h, enum heightfile_format format,
                      struct heightfile_written *w, struct err *e)
{
    struct outfile o;
    double most = format == HEIGHTFILE_GSF ? (double)FLT_MAX : DBL_MAX;
    *w = extent(h, format);
    if (!check_fits(path, h, format, e) || !check_heights(path, h, most, e) ||
        !check_title(path, format == HEIGHTFILE_GSF ? h->title : NULL, e) || !outfile_open(&o, path, e))
        return false;
    if (write_it(o.stream, h, format, w, e)) return outfile_commit(&o, e);
    outfile_drop(&o);
    return err_at(e, "%s", path);
}

bool heightfile_write_gsf(const char *path, const struct heightfile *h, const char *title, struct err *e)
{
    struct outfile o;
    if (!check_title(path, title, e) || !check_heights(path, h, (double)FLT_MAX, e) || !outfile_open(&o, path, e))
        return false;
    write_gsf(o.stream, h, title);
    return outfile_commit(&o, e);
}
