/* heightfile_write: round trips through every format, the bytes of short files, and what a format does not hold. */
#include "file/heightfile.h"

#include "heights.h"

enum { W = 7, H = 5 };

static double z[W * H];
static struct heightfile m;
static struct heightfile_written w;

static void fill(void)
{
    m = (struct heightfile){
        .columns = W, .rows = H, .pitch_x = 1.394068e-6, .pitch_y = 2.5e-6, .z = z, .title = "a map"};
    for (int k = 0; k < W * H; k++)
        z[k] = 1e-6 * (k * k % 17) / 3 - 1e-6;
}

static bool write_to(enum heightfile_format format)
{
    close(path_make());
    e = (struct err){0};
    return heightfile_write(path, &m, format, &w, &e);
}

static void back(enum heightfile_format format, const char *name)
{
    ck_assert_msg(write_to(format), "%s: %s", name, e.text);
    e = (struct err){0};
    ck_assert_msg(heightfile_read(path, memory(), &h, &e), "%s: %s", name, e.text);
    unlink(path);
    ck_assert_msg(h.columns == m.columns && h.rows == m.rows && !strcmp(h.format, name), "%zu x %zu %s", h.columns,
                  h.rows, h.format);
    ck_assert_uint_eq(h.holes, m.holes);
}

static void same(double tolerance)
{
    for (size_t i = 0; i < m.columns * m.rows; i++)
        ck_assert_msg(isnan(z[i]) ? isnan(h.z[i]) : fabs(h.z[i] - z[i]) <= tolerance, "%zu: %g, not %g", i, h.z[i],
                      z[i]);
}

static void pitch(void)
{
    ck_assert_double_eq_tol(h.pitch_x / m.pitch_x, 1, 5e-16); /* times n, over n */
    if (m.rows > 1) ck_assert_double_eq_tol(h.pitch_y / m.pitch_y, 1, 5e-16);
}

static void round_trips(void)
{
    back(HEIGHTFILE_GSF, "GSF");
    same(0x1p-24 * 4.4e-6); /* half the last place of float32 */
    pitch();
    back(HEIGHTFILE_GWY, "GWY");
    same(0);
    pitch();
    back(HEIGHTFILE_SDF, "SDF (binary)");
    same(0);
    pitch();
    back(HEIGHTFILE_SDF_TEXT, "SDF (text)");
    same(0);
    pitch();
    back(HEIGHTFILE_NPY, "NPY");
    same(0);
    back(HEIGHTFILE_CSV, "CSV");
    same(0);
}

START_TEST(every_format)
{
    fill();
    round_trips();
    ck_assert(h.title == NULL);
    back(HEIGHTFILE_GWY, "GWY");
    ck_assert_str_eq(h.title, "a map");
    m.rows = 1;
    round_trips();
    m.title = NULL;
    round_trips();
}
END_TEST

START_TEST(holes)
{
    fill();
    z[0] = z[9] = z[34] = NAN;
    m.holes = 3;
    round_trips();
    ck_assert(!write_to(HEIGHTFILE_PNG) && e.kind == ERR_SCENE && strstr(e.text, "3 are: fill them"));
    unlink(path);
    m.holes = 0; /* a NaN that nobody counted is a mistake */
    ck_assert(!write_to(HEIGHTFILE_NPY) && e.kind == ERR_NUMBERS && strstr(e.text, "row 0, column 0 is nan"));
    unlink(path);
}
END_TEST

/* Lowest 0, highest 65535; read back with the range that was reported within half a step. */
START_TEST(png)
{
    fill();
    ck_assert_msg(write_to(HEIGHTFILE_PNG), "%s", e.text);
    const struct heightfile_options o = {.pitch = 1e-6, .height_scale = NAN, .height_range = w.range};
    ck_assert_msg(heightfile_load(path, &o, memory(), &h, &e), "%s", e.text);
    unlink(path);
    ck_assert_double_eq(w.step, w.range / 65535);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < W * H; k++) {
        low = fmin(low, h.z[k]);
        high = fmax(high, h.z[k]);
        ck_assert_double_eq_tol(h.z[k] + w.low, z[k], 0.5001 * w.step);
    }
    ck_assert(low == 0 && high == w.range && fabs(h.quantum - w.step) <= 1e-15 * w.step);
    for (int k = 0; k < W * H; k++)
        z[k] = 5e-6;
    ck_assert(write_to(HEIGHTFILE_PNG) && w.range == 0); /* flat: all 0 */
    ck_assert(heightfile_read(path, memory(), &h, &e) && h.z[7] == 0);
    unlink(path);
}
END_TEST

static void bytes(enum heightfile_format format, const void *want, size_t n)
{
    ck_assert_msg(write_to(format), "%s", e.text);
    FILE *f = fopen(path, "rb");
    size = fread(file, 1, sizeof file, f);
    fclose(f);
    unlink(path);
    ck_assert_uint_eq(size, n);
    ck_assert_mem_eq(file, want, n);
}

START_TEST(bytes_by_hand)
{
    double two[] = {1, -2.5};
    m = (struct heightfile){.columns = 2, .rows = 1, .pitch_x = 0.5, .pitch_y = NAN, .z = two};
    bytes(HEIGHTFILE_CSV, "# heights in m, 2 columns, 1 rows, pitch 0.5 m\n1,-2.5\n", 54);
    static const char npy[] =
        "\x93NUMPY\1\0\x76\0{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }"
        "                                                            \n\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\x04\xc0";
    bytes(HEIGHTFILE_NPY, npy, sizeof npy - 1);
    static const char sdf[] = "bISO-1.0rasp\0\0\0\0\0\0"
                              "010120000000"
                              "010120000000"
                              "\2\0\1\0"
                              "\0\0\0\0\0\0\xe0\x3f"
                              "\0\0\0\0\0\0\0\0"
                              "\0\0\0\0\0\0\xf0\x3f"
                              "\0\0\0\0\0\0\xf0\xbf"
                              "\0\7\0"
                              "\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\x04\xc0";
    bytes(HEIGHTFILE_SDF, sdf, sizeof sdf - 1);
    static const char gsf[] = "Gwyddion Simple Field 1.0\nXRes = 2\nYRes = 1\nXReal = 1\nXYUnits = m\nZUnits = "
                              "m\n\0\0\0\0\0\x80\x3f\0\0\x20\xc0";
    bytes(HEIGHTFILE_GSF, gsf, sizeof gsf - 1);
}
END_TEST

static void cannot(enum heightfile_format format, enum err_kind kind, const char *says)
{
    ck_assert(!write_to(format));
    unlink(path);
    ck_assert_msg(e.kind == kind && strstr(e.text, says), "%s", e.text);
}

START_TEST(refusals)
{
    fill();
    m.columns = 65536;
    m.rows = 1;
    m.z = calloc(1000001, sizeof *m.z);
    cannot(HEIGHTFILE_SDF, ERR_SCENE, "at most 65535 x 65535");
    m.columns = 1000001;
    cannot(HEIGHTFILE_PNG, ERR_SCENE, "may have 1000000 a side");
    free(m.z);
    fill();
    m.title = "two\nlines";
    cannot(HEIGHTFILE_GSF, ERR_SCENE, "one line");
    m.title = NULL;
    z[8] = 1e39;
    cannot(HEIGHTFILE_GSF, ERR_NUMBERS, "row 1, column 1 is 1e+39, which float32 does not hold");
    z[8] = INFINITY;
    cannot(HEIGHTFILE_CSV, ERR_NUMBERS, "row 1, column 1 is inf, which is no height");
}
END_TEST

START_TEST(endings)
{
    static const struct {
        const char *name;
        enum heightfile_format format;
    } good[] = {{"a.gsf", HEIGHTFILE_GSF}, {"b.GWY", HEIGHTFILE_GWY}, {"x/c.sdf", HEIGHTFILE_SDF},
                {"d.npy", HEIGHTFILE_NPY}, {"e.Png", HEIGHTFILE_PNG}, {"f.csv", HEIGHTFILE_CSV}};
    static const char *const bad[] = {"", ".gsf", "gsf", "a.gsf2", "a.tif", "a"};
    enum heightfile_format format;
    e = (struct err){0};
    for (size_t i = 0; i < 6; i++)
        ck_assert(heightfile_write_format(good[i].name, &format, &e) && format == good[i].format);
    for (size_t i = 0; i < 6; i++) {
        e = (struct err){0};
        ck_assert(!heightfile_write_format(bad[i], &format, &e) && e.kind == ERR_USAGE);
    }
}
END_TEST

UNIT("heightfile_write", every_format, holes, png, bytes_by_hand, refusals, endings)
