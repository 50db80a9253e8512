/* csv: what RFC 4180 says, and every refusal with its line. */
#include <unistd.h>

#include "base/arena.h"
#include "file/csv.h"
#include "unit.h"

static char path[] = "/tmp/test_csv.XXXXXX";
static struct arena *arena;
static struct csv t;
static struct err e;

static bool read_bytes(const char *bytes, size_t n)
{
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, bytes, n), (ssize_t)n);
    close(fd);
    if (!arena) arena = arena_open();
    e = (struct err){0};
    bool ok = csv_read(path, arena, &t, &e);
    unlink(path);
    memcpy(path + strlen(path) - 6, "XXXXXX", 6);
    return ok;
}

static bool read_text(const char *text) { return read_bytes(text, strlen(text)); }

static const char *cell(size_t row, const char *name)
{
    int c = csv_column(&t, name);
    ck_assert_int_ge(c, 0);
    ck_assert_uint_lt(row, t.rows);
    return t.cells[row * t.columns + (size_t)c];
}

START_TEST(plain)
{
    ck_assert(read_text("a,b\n1,2\n3,\n"));
    ck_assert_uint_eq(t.rows, 2);
    ck_assert_uint_eq(t.columns, 2);
    ck_assert_str_eq(cell(0, "b"), "2");
    ck_assert_str_eq(cell(1, "a"), "3");
    ck_assert_str_eq(cell(1, "b"), "");
    ck_assert_int_eq(t.lines[1], 3);
    ck_assert_int_eq(csv_column(&t, "c"), -1);
    ck_assert(read_text("a,b\n1,2\n3,4")); /* no end of line at the end */
    ck_assert_str_eq(cell(1, "b"), "4");
    ck_assert(read_text("a\n"));
    ck_assert_uint_eq(t.rows, 0);
    ck_assert(read_text("a"));
    ck_assert_uint_eq(t.columns, 1);
}
END_TEST

START_TEST(quotes)
{
    ck_assert(read_text("\"a,1\",b\n\"say \"\"hi\"\"\",\"two\nlines\"\n\"\",\"\"\"\"\nx,\" y \""));
    ck_assert_str_eq(t.names[0], "a,1");
    ck_assert_str_eq(cell(0, "a,1"), "say \"hi\"");
    ck_assert_str_eq(cell(0, "b"), "two\nlines");
    ck_assert_str_eq(cell(1, "a,1"), "");
    ck_assert_str_eq(cell(1, "b"), "\"");
    ck_assert_str_eq(cell(2, "b"), " y ");
    ck_assert_int_eq(t.lines[1], 4); /* the cell of line 2 goes on in line 3 */
}
END_TEST

START_TEST(line_ends_and_mark)
{
    ck_assert(read_text("\xef\xbb\xbf# k: v\r\na,b\r\n1,\"2\"\r\n\r\n\n"));
    ck_assert_str_eq(t.names[0], "a");
    ck_assert_uint_eq(t.rows, 1);
    ck_assert_str_eq(cell(0, "b"), "2");
    ck_assert_str_eq(csv_comment(&t, "k"), "v");
}
END_TEST

START_TEST(comments)
{
    ck_assert(read_text("# poles: shared\n\n#  source :  a: b  \n# just words\na\n# not a comment\n"));
    ck_assert_uint_eq(t.n_comments, 3);
    ck_assert_str_eq(csv_comment(&t, "poles"), "shared");
    ck_assert_str_eq(csv_comment(&t, "source"), "a: b");
    ck_assert_str_eq(csv_comment(&t, ""), "just words");
    ck_assert_ptr_null(csv_comment(&t, "quantity"));
    ck_assert_int_eq(t.comments[1].line, 3);
    ck_assert_str_eq(cell(0, "a"), "# not a comment");
}
END_TEST

static void check_refused(const char *text, const char *says)
{
    ck_assert_msg(!read_text(text), "accepted: %s", text);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s (wanted: %s)", e.text, says);
}

START_TEST(refusals)
{
    check_refused("", ":1: there is no header");
    check_refused("\n\n# k: v\n", ":4: there is no header");
    check_refused("a,b\n1,2\n1\n", ":3: 1 cells, where the header has 2");
    check_refused("a,b\n1,2,3\n", ":2: 3 cells");
    check_refused("a,b,a\n", ":1: two columns are called 'a'");
    check_refused("a,,b\n", ":1: column 2 has no name");
    check_refused("a,\n", ":1: column 2 has no name");
    check_refused("a,b\n1,\"2\n3,4\n", ":2: a quote is opened here and never closed");
    check_refused("a,b\n1,\"2\"x\n", ":2: text after a closing quote");
    check_refused("a,b\n1,2\"\n", ":2: a quote inside a cell");
    check_refused("a,b\n1,2\n\n3,4\n", ":3: a blank line");
    check_refused("a,b\n1\r,2\n", ":2: a carriage return");
    check_refused("a,\"b\n", ":1: a quote is opened");
    ck_assert(!read_bytes("a,b\n1,\0\n", 8));
    ck_assert_msg(strstr(e.text, ":2: a NUL byte") != NULL, "%s", e.text);
}
END_TEST

START_TEST(files_that_cannot_be_read)
{
    struct arena *a = arena_open();
    struct err f = {0};
    ck_assert(!csv_read("/tmp", a, &t, &f));
    ck_assert_int_eq(f.kind, ERR_INPUT);
    f = (struct err){0};
    ck_assert(!csv_read("/nowhere/a.csv", a, &t, &f));
    ck_assert_int_eq(f.kind, ERR_INPUT);
    ck_assert_str_eq(f.text, "/nowhere/a.csv: No such file or directory");
    arena_close(a);
}
END_TEST

START_TEST(too_many_columns)
{
    static char many[200001];
    size_t n = 0;
    for (int i = 0; i < 20000; i++)
        n += (size_t)snprintf(many + n, sizeof many - n, "c%d,", i);
    check_refused(many, "more than 10000 columns");
}
END_TEST

START_TEST(numbers)
{
    static const char *const bad[] = {"", "x", "1x", "1,5", "0x10", "nan", "inf", "1e999", "1 2", "-", "1e"};
    double v = 0;
    ck_assert(read_text("v\n1.5e-3\n -2 \n+.5\n1e308\n"));
    ck_assert(csv_number(&t, 0, 0, &v, &e) && v == 1.5e-3);
    ck_assert(csv_number(&t, 1, 0, &v, &e) && v == -2);
    ck_assert(csv_number(&t, 2, 0, &v, &e) && v == 0.5);
    ck_assert(csv_number(&t, 3, 0, &v, &e) && v == 1e308);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "w,v\n1,\"%s\"\n", bad[i]);
        ck_assert(read_text(text));
        ck_assert_msg(!csv_number(&t, 0, 1, &v, &e), "'%s' is taken for %g", bad[i], v);
        ck_assert_int_eq(e.kind, ERR_SCENE);
        ck_assert_msg(strstr(e.text, ":2: column 'v': '") != NULL, "%s", e.text);
    }
}
END_TEST

static void put_quoted(FILE *f, const char *text)
{
    fputc('"', f);
    for (; *text; text++)
        fprintf(f, *text == '"' ? "\"\"" : "%c", *text);
    fputc('"', f);
}

START_TEST(written_is_read)
{
    static const char *const texts[] = {"plain", "", "a,b", "\"", "two\nlines", "# no comment", " blanks "};
    enum { N = sizeof texts / sizeof texts[0] };
    char *text;
    size_t n;
    double v;
    FILE *f = open_memstream(&text, &n);
    put_quoted(f, "a,b");
    fputs(",v\n", f);
    for (int i = 0; i < N; i++) {
        put_quoted(f, texts[i]);
        fputc(',', f);
        csv_put_number(f, i == 0 ? -NAN : 1.0 / i);
        fputc('\n', f);
    }
    fclose(f);
    ck_assert(read_bytes(text, n));
    for (size_t i = 0; i < N; i++) {
        ck_assert_str_eq(cell(i, "a,b"), texts[i]);
        ck_assert(i == 0 || (csv_number(&t, i, 1, &v, &e) && fabs(v * (double)i - 1) <= 5e-9)); /* 9 digits */
    }
    ck_assert_str_eq(cell(0, "v"), "nan");
    ck_assert_str_eq(cell(1, "v"), "1");
    ck_assert_str_eq(cell(3, "v"), "0.333333333");
    free(text);
}
END_TEST

UNIT("csv", plain, quotes, line_ends_and_mark, comments, refusals, files_that_cannot_be_read, too_many_columns, numbers,
     written_is_read)
