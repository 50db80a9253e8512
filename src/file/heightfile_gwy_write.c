/* Writing Gwyddion's native format: see heightfile_gwy.c. Sizes stand before what they measure, so they are added up
 * first. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "file/heightfile_gwy.h"
#include "file/heightfile_unit.h"

enum {
    GWY_UNIT = 10 + 4 + 8 + 1 + 2, /* "GwySIUnit" size; "unitstr" s "m"          */
    GWY_FIELD = 5 + 5 + 5 + 5 + 6 + 9 + 6 + 9 + (11 + 1) + (10 + 1) + 5 + 1 +
                4 /* names with their NULs, types, numbers, length */
};

static size_t gwy_field_size(const struct heightfile *h)
{
    return GWY_FIELD + 2 * (size_t)GWY_UNIT + 8 * h->columns * h->rows;
}

static size_t gwy_title_size(const struct heightfile *h)
{
    return h->title ? sizeof "/0/data/title" + 1 + strlen(h->title) + 1 : 0;
}

/* Of the container: a component is name, type, object (name, size, contents). */
static size_t gwy_all(const struct heightfile *h)
{
    size_t field = 1 + sizeof "GwyDataField" + 4 + gwy_field_size(h);
    return sizeof "/0/data" + field + (h->holes ? sizeof "/0/mask" + field : 0) + gwy_title_size(h);
}

bool heightfile_gwy_write_fits(const struct heightfile *h) { return gwy_all(h) <= UINT32_MAX; }

static void gwy_put_text(FILE *f, const char *s) { fwrite(s, 1, strlen(s) + 1, f); }

static void gwy_put_head(FILE *f, const char *name, char type)
{
    gwy_put_text(f, name);
    fputc(type, f);
}

static void gwy_put_i(FILE *f, const char *name, size_t v)
{
    gwy_put_head(f, name, 'i');
    heightfile_unit_put(f, v, 4);
}

static void gwy_put_d(FILE *f, const char *name, double v)
{
    gwy_put_head(f, name, 'd');
    heightfile_unit_put_f64(f, v);
}

static void gwy_put_unit(FILE *f, const char *name, const char *unit)
{
    gwy_put_head(f, name, 'o');
    gwy_put_text(f, "GwySIUnit");
    heightfile_unit_put(f, 8 + 1 + 2, 4);
    gwy_put_head(f, "unitstr", 's');
    gwy_put_text(f, unit);
}

static void gwy_put_field(FILE *f, const char *name, const struct heightfile *h, bool mask)
{
    size_t n = h->columns * h->rows;
    gwy_put_head(f, name, 'o');
    gwy_put_text(f, "GwyDataField");
    heightfile_unit_put(f, gwy_field_size(h), 4);
    gwy_put_i(f, "xres", h->columns);
    gwy_put_i(f, "yres", h->rows);
    gwy_put_d(f, "xreal", h->pitch_x * (double)h->columns);
    gwy_put_d(f, "yreal", (h->rows > 1 ? h->pitch_y : h->pitch_x) * (double)h->rows);
    gwy_put_unit(f, "si_unit_xy", "m");
    gwy_put_unit(f, "si_unit_z", "m");
    gwy_put_head(f, "data", 'D');
    heightfile_unit_put(f, n, 4);
    for (size_t i = 0; i < n; i++)
        heightfile_unit_put_f64(f, mask ? (isnan(h->z[i]) ? 1 : 0) : isnan(h->z[i]) ? 0 : h->z[i]);
}

void heightfile_gwy_write(FILE *f, const struct heightfile *h)
{
    fwrite("GWYP", 1, 4, f);
    gwy_put_text(f, "GwyContainer");
    heightfile_unit_put(f, gwy_all(h), 4);
    gwy_put_field(f, "/0/data", h, false);
    if (h->title) {
        gwy_put_head(f, "/0/data/title", 's');
        gwy_put_text(f, h->title);
    }
    if (h->holes) gwy_put_field(f, "/0/mask", h, true);
}
