/* Tables as NPY against the format's own description (numpy.lib.format): bytes written by hand, and what npy_write
 * writes. */
#include <unistd.h>

#include "file/csv.h"
#include "file/npy.h"
#include "unit.h"

static struct arena *arena;
static struct csv t;
static struct err e;

static bool read_file(const void *bytes, size_t n)
{
    char path[] = "/tmp/test_table.XXXXXX";
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, bytes, n), (ssize_t)n);
    close(fd);
    arena = arena ? arena : arena_open();
    e = (struct err){0};
    bool ok = csv_table_read(path, arena, &t, &e);
    unlink(path);
    return ok;
}

/* Version 1.0 with a header that ends at no multiple of 8, then these numbers. */
static bool read_npy(const char *header, const double *x, size_t n)
{
    char file[4096] = "\x93NUMPY\1\0";
    size_t length = strlen(header), at = 10 + length;
    file[8] = (char)length;
    memcpy(file + 10, header, length);
    memcpy(file + at, x, n * sizeof *x);
    return read_file(file, at + n * sizeof *x);
}

static void refused(const char *header, size_t n, const char *says)
{
    static const double x[8];
    ck_assert_msg(!read_npy(header, x, n), "%s was read", header);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s (wanted: %s)", e.text, says);
}

START_TEST(fields_by_hand)
{
    const double x[] = {0, 1.5, 0.25, -1e-300, 0.5, NAN};
    double v;
    ck_assert_msg(
        read_npy("{'fortran_order': False, 'shape': (3,), 'descr': [(\"time_s\", '<f8'), ('force_n','<f8')]} ", x, 6),
        "%s", e.text);
    ck_assert_uint_eq(t.rows, 3);
    ck_assert_uint_eq(t.columns, 2);
    ck_assert_str_eq(t.names[1], "force_n");
    ck_assert_int_eq(csv_column(&t, "time_s"), 0);
    ck_assert(csv_number(&t, 1, 1, &v, &e) && v == -1e-300);
    char room[CSV_ROOM];
    ck_assert_str_eq(csv_text(&t, 0, 1, room), "1.5");
    ck_assert(!csv_number(&t, 2, 1, &v, &e));
    ck_assert_msg(strstr(e.text, ":3: column 'force_n': 'nan' is not a number") ||
                      strstr(e.text, ":3: column 'force_n': 'nan' is not a finite number"),
                  "%s", e.text);
    ck_assert(read_npy("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (0,)}", x, 0));
    ck_assert_uint_eq(t.rows, 0);
}
END_TEST

START_TEST(refusals)
{
    refused("{'descr': '<f8', 'fortran_order': False, 'shape': (2,)}", 2, "without named fields");
    refused("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (1, 2)}", 2, "of two dimensions");
    refused("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (3,)}", 2,
            "3 rows of 8 bytes should follow byte");
    refused("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (1,)}", 2, "and 16 bytes do");
    refused("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (2305843009213693953,)}", 1,
            "and 8 bytes do"); /* 8 times it is 8 mod 2^64 */
    refused("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2,)}", 1, "not of the type '<f8'");
    refused("{'descr': [('a', '<f8', (2,))], 'fortran_order': False, 'shape': (1,)}", 2, "a field should stand here");
    refused("{'descr': [('a', '<f8') ('b', '<f8')], 'fortran_order': False, 'shape': (1,)}", 2,
            "the end of the list of fields");
    refused("{'descr': [('a', '<f8'), ('a', '<f8')], 'fortran_order': False, 'shape': (1,)}", 2,
            "two fields are called 'a'");
    refused("{'descr': [], 'fortran_order': False, 'shape': (1,)}", 1, "a list without fields");
    refused("{'descr': [('a', '<f8')", 1, "NPY header");
}
END_TEST

/* The format asks for a header that ends in a line feed, and for data at a multiple of 64. */
START_TEST(written_is_read)
{
    static const char *const names[] = {"time_s", "force_rms_n", "acceleration_m_per_s2", "x_m", "a", "bb", "ccc",
                                        "dddd",   "eeeee"};
    for (size_t n = 1; n <= 9; n++)
        for (size_t rows = 1; rows <= 1000; rows *= 10) {
            char *text;
            size_t size;
            FILE *f = open_memstream(&text, &size);
            npy_write(f, names, n, rows);
            ck_assert_int_eq(ftell(f) % 64, 0);
            for (size_t i = 0; i < n * rows; i++)
                fwrite(&(double){1.0 / (double)(i + 1)}, sizeof(double), 1, f);
            fclose(f);
            ck_assert_mem_eq(text, "\x93NUMPY\1\0", 8);
            size_t header = (size_t)(unsigned char)text[8] + 256 * (size_t)(unsigned char)text[9];
            ck_assert_uint_eq((10 + header) % 64, 0);
            ck_assert_int_eq(text[10 + header - 1], '\n');
            ck_assert_msg(read_file(text, size), "%s", e.text);
            ck_assert_uint_eq(t.rows, rows);
            ck_assert_uint_eq(t.columns, n);
            ck_assert_str_eq(t.names[n - 1], names[n - 1]);
            ck_assert(t.numbers[n * rows - 1] == 1.0 / (double)(n * rows));
            free(text);
        }
}
END_TEST

START_TEST(text_is_csv)
{
    ck_assert(read_file("a,b\n1,x\n", 8));
    ck_assert_ptr_null(t.numbers);
    ck_assert_str_eq(csv_text(&t, 0, 1, (char[CSV_ROOM]){0}), "x");
}
END_TEST

UNIT("table", fields_by_hand, refusals, written_is_read, text_is_csv)
