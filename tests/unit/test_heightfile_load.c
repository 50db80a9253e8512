/* heightfile_load: scale, pitch, holes, levelling in their order; what is not plausible is refused, with a hint at the
 * unit. */
#include "file/heightfile.h"

#include "heights.h"

static struct heightfile_options o;

static const struct heightfile_options none = {.pitch = NAN, .height_scale = NAN, .height_range = NAN};

static void grid(const char *s)
{
    size = 0;
    text(s);
}

static bool load(void)
{
    file_write();
    e = (struct err){0};
    bool ok = heightfile_load(path, &o, memory(), &h, &e);
    unlink(path);
    return ok;
}

static void fails(const char *says)
{
    ck_assert_msg(!load(), "accepted; wanted: %s", says);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s (wanted: %s)", e.text, says);
}

START_TEST(scale_and_pitch)
{
    o = none;
    grid("1 2 3 4 5");
    fails("give surface.pitch");
    o.names = &heightfile_load_option_names;
    fails("give --pitch");
    o.pitch = 2e-6;
    o.height_scale = 1e-6;
    ck_assert_msg(load(), "%s", e.text);
    ck_assert(h.pitch_x == 2e-6 && isnan(h.pitch_y) && h.metric && h.z[4] == 5 * 1e-6);
    grid("1 2 3 4\n5 6 7 8\n1 2 3 4\n5 6 7 8\n");
    ck_assert(load() && h.pitch_y == 2e-6);
}
END_TEST

static void sdf(double x, double y)
{
    char head[300];
    snprintf(head, sizeof head,
             "aX\nNumPoints = 4\nNumProfiles = 4\nXscale = %.17g\nYscale = %.17g\nZscale = 1e-6\nDataType = 5\n*\n", x,
             y);
    grid(head);
    text("1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 *");
}

/* A pitch that is given must be the file's, in both directions. */
START_TEST(contradictions)
{
    o = none;
    sdf(2e-6, 2e-6);
    o.pitch = 2.000001e-6;
    ck_assert_msg(load(), "%s", e.text);
    ck_assert(h.pitch_x == 2e-6 && fabs(h.step - 1e-6) < 1e-20);
    o.pitch = 2.00001e-6;
    fails("but the file says 2e-06 m");
    o.pitch = 1e-6;
    fails("surface.pitch is 1e-06 m but the file says 2e-06 m: leave surface.pitch out");
    sdf(1e-6, 2e-6);
    fails("surface.pitch is 1e-06 m but the file says 2e-06 m");
    o.pitch = NAN;
    ck_assert(load() && h.pitch_x == 1e-6 && h.pitch_y == 2e-6);
    sdf(2e-6, 0); /* only one is known: what is given is the other as well */
    fails("give surface.pitch");
    o.pitch = 2e-6;
    ck_assert(load() && h.pitch_y == 2e-6);
    o.height_range = 1e-6;
    fails("surface.height_range is for PNG, where white stands for it; this is SDF (text), which holds metres: leave "
          "it out");
}
END_TEST

START_TEST(png_range)
{
    double z[16];
    struct heightfile_written w;
    struct heightfile m = {.columns = 4, .rows = 4, .pitch_x = 1e-6, .pitch_y = 1e-6, .z = z};
    for (int i = 0; i < 16; i++)
        z[i] = i;
    close(path_make());
    ck_assert(heightfile_write(path, &m, HEIGHTFILE_PNG, &w, &e));
    FILE *f = fopen(path, "rb");
    size = fread(file, 1, sizeof file, f);
    fclose(f);
    unlink(path);
    o = none;
    o.pitch = 1e-6;
    fails("give surface.height_range");
    o.height_range = 30e-6;
    ck_assert_msg(load(), "%s", e.text);
    ck_assert(h.z[0] == 0 && h.z[15] == 30e-6);
    ck_assert_double_eq_tol(h.z[5], 10e-6, 1e-20); /* 21845 of 65535 */
    ck_assert_double_eq_tol(h.quantum, 30e-6 / 65535, 1e-22);
    o.height_scale = 2;
    fails("leave surface.height_scale out");
}
END_TEST

START_TEST(shapes)
{
    o = none;
    o.pitch = 1e-6;
    grid("1 2 3");
    fails("3 samples are too few for a profile (at least 4)");
    grid("1 2 3 4\n5 6 7 8\n1 2 3 4\n");
    fails("4 x 3 samples are too few for a map (at least 4 x 4)");
    grid("1 2 3\n4 5 6\n7 8 9\n1 2 3\n");
    fails("3 x 4 samples are too few");
    sdf(1e-6, 1e-6);
    char *n = strstr((char *)file, "NumPoints = 4\nNumProfiles = 4");
    memcpy(n, "NumPoints = 1\nNumProfiles =16", 29); /* one pixel wide */
    fails("1 x 16 samples are too few");
}
END_TEST

/* The order: scale, then holes, then limits, then levelling. */
START_TEST(holes_and_levelling)
{
    o = none;
    o.pitch = 1e-6;
    o.height_scale = 1e-6;
    grid("1 2 nan 4 5 nan 7 8");
    fails("missing heights (NaN): 2 of 8, the first at row 0, column 2 (counted from 0): set surface.holes: fill");
    o.holes = HEIGHTFILE_LEAVE;
    ck_assert(load() && h.holes == 2 && isnan(h.z[2]) && h.filled == 0);
    o.holes = HEIGHTFILE_FILL;
    ck_assert(load() && h.holes == 0 && h.filled == 2);
    ck_assert_double_eq_tol(h.z[2], 3e-6, 1e-20);
    o.levelling = HEIGHTFILE_LEVEL_PLANE;
    ck_assert(load());
    ck_assert_double_eq_tol(h.levelled.mean, 4.5e-6, 1e-20);
    ck_assert_double_eq_tol(h.levelled.slope_x, 1, 1e-14);
    for (int i = 0; i < 8; i++)
        ck_assert(fabs(h.z[i]) < 1e-20);
    o.levelling = HEIGHTFILE_LEVEL_MEAN;
    ck_assert(load() && h.levelled.slope_x == 0);
    grid("nan nan nan nan");
    o.holes = HEIGHTFILE_LEAVE;
    fails("all heights are missing");
    o.holes = HEIGHTFILE_FILL;
    fails("4 of 4 points are missing: too many");
}
END_TEST

START_TEST(units)
{
    o = none;
    o.pitch = 1.4;
    grid("1 2 3 4");
    fails("a pitch of 1.4 m between samples is not that of a surface profile (10 nm to 1 mm); check surface.pitch "
          "(taken as micrometres it would be 1.4e-06 m)");
    o.pitch = 1e-12;
    fails("check surface.pitch (1e+06 times that would make sense: was a unit applied twice?)");
    o.pitch = 1e-6;
    fails("heights span 3 m, which is not a surface profile's (1 nm to 10 mm); check its unit and surface.height_scale "
          "(taken as micrometres it would be 3e-06 m)");
    grid("0 1e-15 0 0");
    fails("heights span 1e-15 m");
    grid("0 0.011 0 0");
    fails("(taken as millimetres it would be 1.1e-05 m)");
    grid("5 5 5 5"); /* flat is flat */
    ck_assert_msg(load(), "%s", e.text);
    grid("0 1e-9 0 0");
    ck_assert(load());
    grid("0 0.01 0 0");
    ck_assert(load());
}
END_TEST

/* What the header says is not believed beyond the file's size, and at most 2^28 samples. */
START_TEST(too_large)
{
    static const char head[] = "Gwyddion Simple Field 1.0\nXRes = 16385\nYRes = 16384\nXReal = 1\nYReal = 1\n";
    o = none;
    grid(head);
    put("\0\0\0\0", 4 - strlen(head) % 4);
    fails("should follow byte");
    h = (struct heightfile){.columns = 16385, .rows = 16384};
    e = (struct err){0};
    ck_assert(!heightfile_room("big.gsf", &h, memory(), &e) &&
              strstr(e.text, "16385 x 16384 samples; at most 268435456 are read"));
    h.columns = (size_t)1 << 40, h.rows = (size_t)1 << 40;
    e = (struct err){0};
    ck_assert(!heightfile_room("big.gsf", &h, memory(), &e) && e.kind == ERR_SCENE);
    file_write();
    ck_assert_int_eq(truncate(path, 32 * (off_t)HEIGHTFILE_MOST + 1), 0); /* sparse */
    e = (struct err){0};
    ck_assert(!heightfile_load(path, &o, memory(), &h, &e) && strstr(e.text, "bytes, more than a height map"));
    unlink(path);
}
END_TEST

UNIT("heightfile_load", scale_and_pitch, contradictions, png_range, shapes, holes_and_levelling, units, too_large)
