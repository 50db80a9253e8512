/* See heightfile.h: which format it is, and what all have in common. */
#include "file/heightfile.h"

#include <math.h>
#include <sys/stat.h>

#include "file/heightfile_csv.h"
#include "file/heightfile_gsf.h"
#include "file/heightfile_gwy.h"
#include "file/heightfile_npy.h"
#include "file/heightfile_png.h"
#include "file/heightfile_sdf.h"
#include "file/npy.h"

/* CSV last: it takes any text that begins with a number. */
static const struct {
    bool (*is)(const struct bytes *b);
    bool (*read)(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);
} formats[] = {
    {npy_is, heightfile_npy_read},
    {heightfile_gsf_is, heightfile_gsf_read},
    {heightfile_gwy_is, heightfile_gwy_read},
    {heightfile_png_is, heightfile_png_read},
    {heightfile_sdf_is, heightfile_sdf_read},
    {heightfile_csv_is, heightfile_csv_read},
};

/* Text takes at most 32 bytes a number; so no file of a map that is read is larger. */
static bool check_size(const char *path, struct err *e)
{
    struct stat s;
    double most = 32 * (double)HEIGHTFILE_MOST;
    return stat(path, &s) != 0 || (double)s.st_size <= most ||
           err_set(e, ERR_SCENE,
                   "%s: has %.3g bytes, more than a height map of %zu samples takes; crop or bin it first", path,
                   (double)s.st_size, HEIGHTFILE_MOST);
}

bool heightfile_room(const char *path, struct heightfile *h, struct arena *a, struct err *e)
{
    size_t n;
    if (h->columns == 0 || h->rows == 0)
        return err_set(e, ERR_SCENE, "%s: the map is empty (%zu x %zu)", path, h->columns, h->rows);
    if (__builtin_mul_overflow(h->columns, h->rows, &n) || n > HEIGHTFILE_MOST)
        return err_set(e, ERR_SCENE,
                       "%s: a map of %zu x %zu samples; at most %zu are read (16384 x 16384, 2 GiB of memory): crop or "
                       "bin it first",
                       path, h->columns, h->rows, HEIGHTFILE_MOST);
    h->z = ARENA_TAKE(a, double, n);
    return true;
}

/* Counts holes, refuses infinities, finds the quantum. */
static bool look_over(const char *path, struct heightfile *h, struct err *e)
{
    double most = 0;
    int power;
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        if (isinf(h->z[i]))
            return err_set(e, ERR_SCENE, "%s: the height at row %zu, column %zu (counted from 0) is infinite", path,
                           i / h->columns, i % h->columns);
        if (isnan(h->z[i])) {
            h->first_hole = h->holes ? h->first_hole : i;
            h->holes++;
        } else
            most = fmax(most, fabs(h->z[i]));
    }
    frexp(most, &power);
    h->quantum = h->step > 0 ? h->step : h->bits > 0 && most > 0 ? ldexp(1, power - h->bits) : 0;
    return true;
}

bool heightfile_read(const char *path, struct arena *a, struct heightfile *h, struct err *e)
{
    struct bytes b;
    struct arena *file = arena_open();
    size_t k = 0, n = sizeof formats / sizeof formats[0];
    *h = (struct heightfile){.pitch_x = NAN, .pitch_y = NAN};
    bool ok = check_size(path, e) && bytes_read(path, file, &b, e);
    while (ok && k < n && !formats[k].is(&b))
        k++;
    if (ok && k == n)
        ok = err_set(e, ERR_SCENE, "%s: is no height map: neither GSF, GWY, SDF, NPY, PNG nor a CSV grid of numbers%s",
                     path, b.n ? "" : ": it is empty; write it again, or name another file");
    ok = ok && formats[k].read(path, &b, a, h, e) && look_over(path, h, e);
    arena_close(file);
    return ok;
}
