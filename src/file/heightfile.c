/* See heightfile.h: what the formats have in common. The formats are in heightfile_npy.c and heightfile_gsf.c. */
#include "file/heightfile.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/outfile.h"
#include "file/heightfile_gsf.h"
#include "file/heightfile_npy.h"

static bool check_finite(const char *path, const struct heightfile *h, struct err *e)
{
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (!isfinite(h->z[i]))
            return err_set(e, ERR_SCENE, "%s: the height at row %zu, column %zu (counted from 0) is %s; fill the hole first", path,
                           i / h->columns, i % h->columns, isnan(h->z[i]) ? "missing (NaN)" : "infinite");
    return true;
}

bool heightfile_read(const char *path, struct arena *a, struct heightfile *h, struct err *e)
{
    struct bytes b;
    if (!bytes_read(path, a, &b, e))
        return false;
    *h = (struct heightfile){.pitch_x = NAN, .pitch_y = NAN};
    bool ok = heightfile_npy_is(&b)   ? heightfile_npy_read(path, &b, a, h, e)
              : heightfile_gsf_is(&b) ? heightfile_gsf_read(path, &b, a, h, e)
                                      : err_set(e, ERR_SCENE, "%s: is neither NPY nor Gwyddion Simple Field (GSF)%s", path,
                                                b.n ? "" : ": it is empty");
    return ok && check_finite(path, h, e);
}

static void write_heights(FILE *f, const struct heightfile *h)
{
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        float v = (float)h->z[i];
        uint32_t w;
        memcpy(&w, &v, 4);
        unsigned char u[4] = {(unsigned char)w, (unsigned char)(w >> 8), (unsigned char)(w >> 16), (unsigned char)(w >> 24)};
        fwrite(u, 1, 4, f);
    }
}

/* A failed write shows in the stream, which the commit looks at. */
static void write_gsf(FILE *f, const struct heightfile *h, const char *title)
{
    static const char nul[4];
    fprintf(f, "Gwyddion Simple Field 1.0\nXRes = %zu\nYRes = %zu\n", h->columns, h->rows);
    if (!isnan(h->pitch_x))
        fprintf(f, "XReal = %.17g\n", h->pitch_x * (double)h->columns);
    if (!isnan(h->pitch_y))
        fprintf(f, "YReal = %.17g\n", h->pitch_y * (double)h->rows);
    fprintf(f, "XYUnits = m\nZUnits = m\n");
    if (title)
        fprintf(f, "Title = %s\n", title);
    fwrite(nul, 1, (size_t)(4 - ftello(f) % 4), f);
    write_heights(f, h);
}

static bool check_writable(const char *path, const struct heightfile *h, const char *title, struct err *e)
{
    if (title && title[strcspn(title, "\r\n")])
        return err_set(e, ERR_SCENE, "%s: the title of a GSF is one line", path);
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (!(fabs(h->z[i]) <= (double)FLT_MAX))
            return err_set(e, ERR_NUMBERS, "%s: the height at row %zu, column %zu is %g, which float32 does not hold", path,
                           i / h->columns, i % h->columns, h->z[i]);
    return true;
}

bool heightfile_write_gsf(const char *path, const struct heightfile *h, const char *title, struct err *e)
{
    struct outfile o;
    if (!check_writable(path, h, title, e) || !outfile_open(&o, path, e))
        return false;
    write_gsf(o.stream, h, title);
    return outfile_commit(&o, e);
}
