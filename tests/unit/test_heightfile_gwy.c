/* heightfile_gwy: Gwyddion's format put together by hand from its description, and damaged in every byte. */
#include "heights.h"

/* Where an object's size stands, to be set when it ends. */
static size_t begin(const char *name)
{
    put(name, strlen(name) + 1);
    number(0, 4);
    return size;
}

static void end(size_t at)
{
    for (int i = 0; i < 4; i++)
        file[at - 4 + (size_t)i] = (unsigned char)((size - at) >> 8 * i);
}

static void component(const char *name, char type)
{
    put(name, strlen(name) + 1);
    put(&type, 1);
}

static void unit(const char *name, const char *unit)
{
    component(name, 'o');
    size_t at = begin("GwySIUnit");
    component("unitstr", 's');
    put(unit, strlen(unit) + 1);
    end(at);
}

struct field {
    int xres, yres, there;
    double xreal, yreal, first, step;
    const char *xy, *z;
};

static void field(const char *name, const struct field *f)
{
    component(name, 'o');
    size_t at = begin("GwyDataField");
    component("xres", 'i');
    number((uint32_t)f->xres, 4);
    component("yres", 'i');
    number((uint32_t)f->yres, 4);
    component("cache", 'O'); /* arrays of objects and texts are passed over */
    number(1, 4);
    end(begin("Thing"));
    component("xreal", 'd');
    f64(f->xreal);
    component("yreal", 'd');
    f64(f->yreal);
    if (f->xy) unit("si_unit_xy", f->xy);
    if (f->z) unit("si_unit_z", f->z);
    component("data", 'D');
    number((uint32_t)f->there, 4);
    for (int i = 0; i < f->there; i++)
        f64(f->first + f->step * i);
    end(at);
}

static const struct field good = {3, 2, 6, 6e-6, 8e-6, -1e-6, 0.5e-6, "m", "m"};

/* Everything an older and a newer Gwyddion put beside the data. */
static size_t start(void)
{
    size = 0;
    text("GWYP");
    size_t at = begin("GwyContainer");
    component("/0/base/palette", 's');
    put("Gray", 5);
    component("/0/show", 'b');
    number(1, 1);
    component("/filename", 'S');
    number(2, 4);
    put("a\0b", 4);
    component("/0/select", 'I');
    number(2, 4);
    number(1, 8);
    component("/0/q", 'q');
    number(1, 8);
    return at;
}

START_TEST(one_channel)
{
    size_t at = start();
    field("/0/data", &good);
    component("/0/data/title", 's');
    put("Topography", 11);
    end(at);
    accepted();
    ck_assert(h.columns == 3 && h.rows == 2 && h.metric && h.bits == 53 && !strcmp(h.format, "GWY") &&
              !strcmp(h.title, "Topography"));
    ck_assert_double_eq_tol(h.pitch_x, 2e-6, 1e-21); /* one rounding */
    ck_assert_double_eq_tol(h.pitch_y, 4e-6, 1e-21);
    for (int i = 0; i < 6; i++)
        ck_assert_double_eq(h.z[i], -1e-6 + 0.5e-6 * i);
}
END_TEST

/* Channel 0 wins wherever it stands; else the first. */
START_TEST(which_channel)
{
    const struct field other = {1, 1, 1, 1e-6, 1e-6, 5, 0, "m", "m"};
    size_t at = start();
    field("/3/data", &other);
    field("/0/data", &good);
    end(at);
    accepted();
    ck_assert(h.columns == 3);
    at = start();
    field("/12/data", &good);
    field("/3/data", &other);
    end(at);
    accepted();
    ck_assert(h.columns == 3);
}
END_TEST

START_TEST(mask_and_units)
{
    const struct field mask = {3, 2, 6, 6e-6, 8e-6, -3, 1, "m", ""}; /* above 0 in the last two */
    struct field f = good;
    f.xy = "\xc2\xb5m";
    f.z = "nm";
    size_t at = start();
    field("/0/mask", &mask);
    field("/0/data", &f);
    end(at);
    accepted();
    ck_assert(h.holes == 2 && h.first_hole == 4 && h.z[0] == -1e-6 / 1e9);
    ck_assert_double_eq_tol(h.pitch_x, 2e-12, 1e-27);
    f.z = "V";
    at = start();
    field("/0/data", &f);
    end(at);
    refused("'V', not lengths");
}
END_TEST

static void wrong(struct field f, const char *says)
{
    size_t at = start();
    field("/0/data", &f);
    end(at);
    refused(says);
}

START_TEST(contradictions)
{
    struct field f = good;
    f.xres = 4;
    wrong(f, "4 x 2 samples, and 6 are there");
    f.xres = -3, f.yres = -2;
    wrong(f, "-3 x -2 samples");
    f = good, f.xreal = 0;
    wrong(f, "size is 0 x");
    f = good, f.yreal = NAN;
    wrong(f, "x nan");
    const struct field mask = {2, 3, 6, 6e-6, 8e-6, 0, 1, "m", ""};
    size_t at = start();
    field("/0/data", &good);
    field("/0/mask", &mask);
    end(at);
    refused("the mask has 2 x 3 samples and its data field 3 x 2");
    end(start());
    refused("holds no image");
    size = 0;
    text("GWYP");
    end(begin("GwyDataField"));
    refused("does not begin with a GwyContainer");
    size = 0;
    text("GWYQ");
    refused("is no height map");
}
END_TEST

/* Cut short at every byte: always an error, never a crash; and with every byte changed: no crash. */
START_TEST(damaged)
{
    size_t at = start(), whole;
    field("/0/data", &good);
    end(at);
    whole = size;
    for (size = 4; size < whole; size++) {
        ck_assert_msg(!read_file(), "cut at %zu", size);
        ck_assert_int_eq(e.kind, ERR_SCENE);
    }
    size = whole;
    for (size_t i = 4; i < whole; i++)
        for (int bit = 0; bit < 8; bit += 7) {
            file[i] ^= (unsigned char)(1 << bit);
            bool ok = read_file();
            ck_assert(ok ? h.columns * h.rows == 6 : e.kind == ERR_SCENE);
            file[i] ^= (unsigned char)(1 << bit);
        }
}
END_TEST

UNIT("heightfile_gwy", one_channel, which_channel, mask_and_units, contradictions, damaged)
