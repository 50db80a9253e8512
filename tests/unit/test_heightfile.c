/* heightfile: byte layouts written out by hand here, and hostile files. */
#include "heights.h"

/* An NPY header; its length as NumPy pads it. */
static void npy(int version, const char *dictionary)
{
    size = 0;
    char head[256];
    size_t fixed = version == 1 ? 10 : 12, n = strlen(dictionary) + 1;
    while ((fixed + n) % 64)
        n++;
    put("\x93NUMPY", 6);
    put((unsigned char[]){(unsigned char)version, 0}, 2);
    put((unsigned char[]){(unsigned char)n, (unsigned char)(n >> 8), 0, 0}, version == 1 ? 2 : 4);
    memset(head, ' ', sizeof head);
    memcpy(head, dictionary, strlen(dictionary));
    head[n - 1] = '\n';
    put(head, n);
}

START_TEST(npy_float64)
{
    const double z[] = {1, -2.5, 3e-6, 4, 5, 6};
    for (int version = 1; version <= 3; version++) {
        npy(version, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }");
        put(z, sizeof z);
        ck_assert_msg(read_file(), "%s", e.text);
        ck_assert(h.rows == 2 && h.columns == 3 && isnan(h.pitch_x) && isnan(h.pitch_y));
        ck_assert_mem_eq(h.z, z, sizeof z);
    }
    npy(1, "{'shape':(6,),\"descr\":\"<f8\",'fortran_order':True}"); /* one dimension has no order */
    put(z, sizeof z);
    ck_assert_msg(read_file(), "%s", e.text);
    ck_assert(h.rows == 1 && h.columns == 6);
    ck_assert_mem_eq(h.z, z, sizeof z);
}
END_TEST

static void check_type(const char *descr, const char *bytes, size_t n, double want)
{
    char d[100];
    snprintf(d, sizeof d, "{'descr': '%s', 'fortran_order': False, 'shape': (1, 2), }", descr);
    npy(1, d);
    for (size_t i = 0; i < n; i++)
        put("", 1);
    put(bytes, n);
    ck_assert_msg(read_file(), "%s: %s", descr, e.text);
    ck_assert(h.z[0] == 0 && h.z[1] == want);
}

START_TEST(npy_types_by_hand)
{
    check_type("<f4", "\0\0\x20\xc0", 4, -2.5);
    check_type(">f4", "\xc0\x20\0\0", 4, -2.5);
    check_type("<f8", "\0\0\0\0\0\0\x04\xc0", 8, -2.5);
    check_type(">f8", "\xc0\x04\0\0\0\0\0\0", 8, -2.5);
    check_type("<i2", "\xfe\xff", 2, -2);
    check_type(">i2", "\xff\xfe", 2, -2);
    check_type("<u2", "\xfe\xff", 2, 65534);
    check_type(">u2", "\x01\x02", 2, 258);
    check_type("<i4", "\xfe\xff\xff\xff", 4, -2);
    check_type(">i4", "\x80\0\0\0", 4, -2147483648.0);
}
END_TEST

static void npy_refused(const char *dictionary, const char *says)
{
    npy(1, dictionary);
    put("\0\0\0\0\0\0\0\0", 8);
    refused(says);
}

START_TEST(npy_hostile)
{
    npy_refused("{'descr': '<f8', 'fortran_order': True, 'shape': (1, 1), }", "Fortran order");
    npy_refused("{'descr': '<i8', 'fortran_order': False, 'shape': (1,), }", "type '<i8'");
    npy_refused("{'descr': '=f8', 'fortran_order': False, 'shape': (1,), }", "type '=f8'");
    npy_refused("{'descr': '', 'fortran_order': False, 'shape': (1,), }", "type ''");
    npy_refused("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (1,), }", "a table of 1 fields");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (), }", "single number");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1), }", "more than two dimensions");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (0, 5), }", "empty (0 x 5)");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (-1,), }", "not a whole number");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967297), }", "and 8 bytes do");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 12297829382473034411), }",
                "and 8 bytes do"); /* 1 mod 2^64 */
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (2305843009213693953,), }", "and 8 bytes do");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999999,), }", "too large");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }",
                "2 numbers of 8 bytes should follow byte 128");
    npy_refused("{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }", "8 bytes do"); /* trailing data */
    npy_refused("{'descr': '<f8', 'fortran_order': False, }", "is missing");
    npy_refused("{'descr': '<f8', 'fortran_order': 0, 'shape': (1,), }", "neither True nor False");
    npy_refused("{'descr': '<f8', 'other': 1, 'shape': (1,), }", "a key that is not");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (1,), ", "a quoted key");
    npy_refused("{'descr': '<f8", "not a plain number type");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (1", "not a list of sizes");
    npy_refused("{'descr': '<f8', 'fortran_order': False, 'shape': (1,), } x", "text after");
    npy_refused("[1]", "a dictionary should begin");
    npy_refused("", "a dictionary should begin");
}
END_TEST

START_TEST(npy_cut_short)
{
    npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }");
    put("\0\0\0\0\0\0\0\0", 8);
    ck_assert(read_file());
    while (size-- > 6)
        refused(size < 7 ? "NPY version" : size < 128 ? "the file ends inside its NPY header" : "bytes do");
}
END_TEST

START_TEST(npy_header_beyond_the_file)
{
    npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }");
    file[9] = 0xff;
    refused("ends inside its NPY header");
    npy(2, "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }");
    memset(file + 8, 0xff, 4);
    refused("ends inside its NPY header");
    file[6] = 9;
    refused("NPY version 9");
}
END_TEST

START_TEST(holes_are_kept_and_infinities_refused)
{
    double z[] = {1, 2, 3, NAN, NAN, 4};
    npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }");
    put(z, sizeof z);
    accepted();
    ck_assert(h.holes == 2 && h.first_hole == 3 && isnan(h.z[3]) && isnan(h.z[4]) && h.z[5] == 4);
    z[5] = -INFINITY;
    npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }");
    put(z, sizeof z);
    refused("row 1, column 2 (counted from 0) is infinite");
}
END_TEST

/* The last place of the largest height: 2^-23 of 1 <= 1.5 < 2, 2^-52 likewise; integers: 1. */
START_TEST(quantum)
{
    npy(1, "{'descr': '<f4', 'fortran_order': False, 'shape': (3,), }");
    put((const float[]){0.1F, -1.5F, 0.9F}, 12);
    accepted();
    ck_assert(h.quantum == 0x1p-23 && h.bits == 24 && h.step == 0 && !h.metric && !strcmp(h.format, "NPY") &&
              h.holes == 0);
    npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }");
    put((const double[]){1, 0.5}, 16);
    accepted();
    ck_assert(h.quantum == 0x1p-52 && h.bits == 53);
    npy(1, "{'descr': '<i2', 'fortran_order': False, 'shape': (2,), }");
    put((const int16_t[]){-300, 20}, 4);
    accepted();
    ck_assert(h.quantum == 1 && h.bits == 16 && h.step == 1);
}
END_TEST

static void gsf(const char *header, size_t padding, size_t data)
{
    size = 0;
    text(header);
    for (size_t i = 0; i < padding; i++)
        put("", 1);
    for (size_t i = 0; i < data; i++)
        put((const float[]){(float)i - 1.5F}, 4);
}

#define GSF "Gwyddion Simple Field 1.0\n"

START_TEST(gsf_layout)
{
    for (size_t extra = 0; extra < 4; extra++) { /* every length of padding */
        char head[200];
        snprintf(head, sizeof head,
                 GSF "XRes = 3\nYRes=2\n  XReal =  6e-6 \nYReal = 8e-6\nXYUnits = m\n\nTitle = a = b%.*s\n", (int)extra,
                 "xyz");
        gsf(head, 4 - strlen(head) % 4, 6);
        ck_assert_msg(read_file(), "%s", e.text);
        ck_assert(h.columns == 3 && h.rows == 2 && h.metric && !strncmp(h.title, "a = b", 5) &&
                  !strcmp(h.format, "GSF"));
        ck_assert_double_eq_tol(h.pitch_x, 2e-6, 1e-21); /* one rounding */
        ck_assert_double_eq_tol(h.pitch_y, 4e-6, 1e-21);
        for (int i = 0; i < 6; i++)
            ck_assert_double_eq(h.z[i], i - 1.5);
    }
}
END_TEST

static void check_unit(const char *xy, const char *z, double metre_xy, double metre_z)
{
    char head[200];
    snprintf(head, sizeof head, GSF "XRes = 2\nYRes = 1\nXReal = 3\nXYUnits = %s\nZUnits = %s\n", xy, z);
    gsf(head, 4 - strlen(head) % 4, 2);
    ck_assert_msg(read_file(), "%s", e.text);
    ck_assert(isnan(h.pitch_y));
    ck_assert_double_eq_tol(h.pitch_x / (1.5 * metre_xy), 1, 1e-15);
    ck_assert_double_eq_tol(h.z[1] / (-0.5 * metre_z), 1, 1e-15);
}

START_TEST(gsf_units)
{
    check_unit("m", "m", 1, 1);
    check_unit("", "", 1, 1);
    check_unit("mm", "um", 1e-3, 1e-6);
    check_unit("\xc2\xb5m", "nm", 1e-6, 1e-9);    /* micro sign */
    check_unit("\xce\xbcm", "\xb5m", 1e-6, 1e-6); /* Greek mu; Latin-1 */
}
END_TEST

static void gsf_refused(const char *rest, const char *says)
{
    char head[300];
    snprintf(head, sizeof head, GSF "%s", rest);
    gsf(head, 4 - strlen(head) % 4, 2);
    refused(says);
}

START_TEST(gsf_hostile)
{
    gsf_refused("YRes = 1\n", "has no XRes");
    gsf_refused("XRes = 2\n", "has no YRes");
    gsf_refused("XRes = 2.0\nYRes = 1\n", "line 2: XRes must be a whole number from 1 to 999999999, not '2.0'");
    gsf_refused("XRes = 0\nYRes = 1\n", "XRes must be a whole number from 1 to 999999999, not '0'");
    gsf_refused("XRes = -2\nYRes = 1\n", "999999999, not '-2'");
    gsf_refused("XRes = 99999999999999999999\nYRes = 1\n", "999999999, not '9999");
    gsf_refused("XRes = 999999999\nYRes = 999999999\n", "and 8 bytes do");
    gsf_refused("XRes = 1\nYRes = 1\n", "(4 bytes) should follow byte 48, and 8 bytes do");
    gsf_refused("XRes = 3\nYRes = 1\n", "(12 bytes) should follow byte 48, and 8 bytes do");
    gsf_refused("XRes = 2\nYRes = 1\nXReal = 0\n", "XReal must be a positive number, not '0'");
    gsf_refused("XRes = 2\nYRes = 1\nXReal = nan\n", "a positive number, not 'nan'");
    gsf_refused("XRes = 2\nYRes = 1\nXReal = 1 mm\n", "a positive number, not '1 mm'");
    gsf_refused("XRes = 2\nYRes = 1\nXYUnits = s\n", "XYUnits must be a length");
    gsf_refused("XRes = 2\nYRes = 1\nZUnits = V\n", "line 4: ZUnits must be a length (m, mm, um, nm), not 'V'");
    gsf_refused("XRes = 2\nYRes = 1\nXRes = 2\n", "line 4: XRes is there already, in line 2");
    gsf_refused("XRes = 2\r\nYRes = 1\r\n", "line 2: the line ends in CR LF");
    gsf_refused("XRes = 2\nYRes\n", "line 3: 'YRes' is not of the form");
    gsf_refused("XRes = 2\nYRes = 1", "line 3: the line has no end");
    gsf("Gwyddion Simple Field 1.0\r\nXRes = 2\nYRes = 1\n", 3, 2);
    refused("CR LF");
    gsf("Gwyddion Simple Field 2.0\nXRes = 2\nYRes = 1\n", 4, 2);
    refused("line 1: is not 'Gwyddion Simple Field 1.0'");
    gsf(GSF "XRes = 2\nYRes = 1\n", 0, 0);
    refused("no NUL byte");
}
END_TEST

START_TEST(gsf_padding)
{
    static const char head[] = GSF "XRes = 2\nYRes = 1\n"; /* 44 bytes: a whole 4 NULs */
    gsf(head, 5, 2);
    refused("(8 bytes) should follow byte 48, and 9 bytes do");
    gsf(head, 3, 2); /* -1.5F begins with a zero byte, so that only the length is wrong */
    refused("and 7 bytes do");
    gsf(head, 0, 0);
    put("\0\0\1\2\3\4\5\6\7", 10);
    refused("4 NUL bytes should follow the GSF header at byte 44, and 2 do");
    gsf(head, 2, 0);
    refused("4 NUL bytes should follow the GSF header at byte 44, and 2 do");
}
END_TEST

START_TEST(neither)
{
    size = 0;
    refused("it is empty");
    text("x,y\n1,2\n");
    refused("is no height map");
    struct arena *a = arena_open();
    e = (struct err){0};
    ck_assert(!heightfile_read("/nowhere/z.npy", a, &h, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    arena_close(a);
}
END_TEST

static bool gsf_to(const char *to, const struct heightfile *w, const char *title)
{
    struct heightfile titled = *w;
    struct heightfile_written written;
    titled.title = title;
    return heightfile_write(to, &titled, HEIGHTFILE_GSF, &written, &e);
}

static bool write_and_read(const struct heightfile *w, const char *title)
{
    close(path_make());
    e = (struct err){0};
    size = 0;
    bool ok = gsf_to(path, w, title);
    FILE *f = fopen(path, "rb");
    size = fread(file, 1, sizeof file, f);
    fclose(f);
    unlink(path);
    return ok && read_file();
}

START_TEST(write_gsf)
{
    double z[] = {1e-6, -2.5e-6, 0, 1, 1 + 0x1p-23, 7e-7};
    struct heightfile w = {.columns = 3, .rows = 2, .pitch_x = 1.394068e-6, .pitch_y = 2e-6, .z = z};
    static const char *const titles[] = {NULL, "t", "ti", "tit", "titl"};
    for (size_t k = 0; k < 5; k++) {
        ck_assert_msg(write_and_read(&w, titles[k]), "%s", e.text);
        ck_assert(h.columns == 3 && h.rows == 2);
        ck_assert_double_eq_tol(h.pitch_x / w.pitch_x, 1, 3e-16); /* times n, over n: two roundings */
        ck_assert_double_eq_tol(h.pitch_y / w.pitch_y, 1, 3e-16);
        for (int i = 0; i < 6; i++)
            ck_assert_double_eq(h.z[i], (float)z[i]);
    }
    w.pitch_x = w.pitch_y = NAN;
    ck_assert(write_and_read(&w, NULL) && isnan(h.pitch_x) && isnan(h.pitch_y));
    ck_assert(!write_and_read(&w, "two\nlines") && e.kind == ERR_SCENE);
    z[4] = NAN;
    ck_assert(!write_and_read(&w, NULL) && e.kind == ERR_NUMBERS);
    ck_assert_msg(strstr(e.text, "row 1, column 1 is nan") != NULL, "%s", e.text);
    e = (struct err){0};
    z[4] = 0;
    ck_assert(!gsf_to("/nowhere/a.gsf", &w, NULL) && e.kind == ERR_CREATE);
}
END_TEST

UNIT("heightfile", npy_float64, npy_types_by_hand, npy_hostile, npy_cut_short, npy_header_beyond_the_file,
     holes_are_kept_and_infinities_refused, quantum, gsf_layout, gsf_units, gsf_hostile, gsf_padding, neither,
     write_gsf)
