/* table_distance: tables small enough to be judged by eye. */
#include <unistd.h>

#include "analysis/table_distance.h"
#include "unit.h"

static struct arena *arena;
static struct err e;

static const char *file_of(const char *text)
{
    static char path[2][40];
    static int k;
    char *p = path[k++ % 2];
    strcpy(p, "/tmp/test_table.XXXXXX");
    int fd = mkstemp(p);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, text, strlen(text)), (ssize_t)strlen(text));
    close(fd);
    return p;
}

static struct csv table(const char *text)
{
    struct csv t;
    struct err bad = {0};
    arena = arena ? arena : arena_open();
    const char *path = file_of(text);
    ck_assert_msg(csv_read(path, arena, &t, &bad), "%s", bad.text);
    unlink(path);
    return t;
}

static struct table_distance compare(const char *a, const char *b, const struct table_distance_tolerance *t)
{
    static const struct table_distance_tolerance none[] = {{0}};
    struct table_distance d;
    struct csv x = table(a), y = table(b);
    e = (struct err){0};
    ck_assert_msg(table_distance((const struct csv *[2]){&x, &y}, t ? t : none, arena, &d, &e), "%s", e.text);
    return d;
}

START_TEST(exact_is_text)
{
    struct table_distance d = compare("t,v\n0,1\n1,2\n2,x\n3,nan\n", "t,v\n0,1.0\n1,2\n2,y\n3,nan\n", NULL);
    ck_assert(d.rows == 4 && d.n_columns == 2 && d.columns[0].misses == 0 && d.columns[1].misses == 2);
    ck_assert_uint_eq(d.columns[1].worst_row, 2);
    ck_assert(d.columns[1].excess == INFINITY && !d.comment && !d.reordered);
}
END_TEST

START_TEST(tolerance_is_abs_plus_rel_of_a)
{
    const struct table_distance_tolerance t[] = {{"v", 0.25, 0.5, false}, {0}};
    /* allowed: 0.25 + 0.5 * 4 = 2.25, and 0.25 around 0 */
    struct table_distance d = compare("v\n4\n4\n-4\n0\n0\n", "v\n6.25\n6.5\n-6.5\n-0.25\n1\n", t);
    ck_assert_uint_eq(d.columns[0].misses, 3);
    ck_assert_uint_eq(d.columns[0].worst_row, 4);
    ck_assert_double_eq(d.columns[0].excess, 0.75);
    ck_assert_double_eq(d.columns[0].largest, 2.5);
}
END_TEST

START_TEST(not_a_number_equals_only_itself)
{
    const struct table_distance_tolerance t[] = {{"*", 1e9, 1e9, false}, {0}};
    struct table_distance d =
        compare("v\nnan\nnan\n1\ninf\ninf\n\"\"\n\"\"\nx\n1\n", "v\nNaN\n1\nnan\nInf\n-inf\n\"\"\n0\nx\n1 m\n", t);
    ck_assert_uint_eq(d.columns[0].misses, 5); /* rows 1, 2, 4, 6, 8 */
    ck_assert_uint_eq(d.columns[0].worst_row, 1);
}
END_TEST

START_TEST(star_is_for_the_others)
{
    const struct table_distance_tolerance t[] = {{"b", 1, 0, false}, {"*", 3, 0, false}, {"c", 0, 0, false}, {0}};
    struct table_distance d = compare("a,b,c\n0,0,0\n", "a,b,c\n2,2,2\n", t);
    ck_assert(d.columns[0].misses == 0 && d.columns[1].misses == 1 && d.columns[2].misses == 1);
    ck_assert(d.columns[0].tolerance.abs == 3 && d.columns[1].tolerance.abs == 1 && d.columns[2].tolerance.abs == 0);
}
END_TEST

START_TEST(shapes)
{
    struct table_distance d = compare("a,b,c,d\n1,2,3,4\n5,6,7,8\n", "d,x,a,b\n4,0,1,2\n", NULL);
    ck_assert(d.rows == 1 && d.n_columns == 3 && d.reordered);
    ck_assert(d.n_missing == 1 && !strcmp(d.missing[0], "c") && d.n_extra == 1 && !strcmp(d.extra[0], "x"));
    ck_assert(d.columns[0].misses + d.columns[1].misses + d.columns[2].misses == 0);
    ck_assert(!compare("a,b\n1,2\n", "a,x,b\n1,0,2\n", NULL).reordered);
    ck_assert_str_eq(compare("# k: 1\n# l: 2\na\n", "# k: 1\n# l: 3\na\n", NULL).comment, "l");
    ck_assert_str_eq(compare("# k: 1\na\n", "# k: 1\n# m: 3\na\n", NULL).comment, "m");
    ck_assert_ptr_null(compare("# k: 1\na\n", "#k:1\na\n", NULL).comment);
}
END_TEST

START_TEST(tolerance_for_no_column)
{
    const struct table_distance_tolerance t[] = {{"speed", 1, 0, false}, {0}};
    struct csv x = table("a\n1\n");
    struct table_distance d;
    e = (struct err){0};
    ck_assert(!table_distance((const struct csv *[2]){&x, &x}, t, arena, &d, &e) && e.kind == ERR_SCENE);
    ck_assert_msg(strstr(e.text, "no column 'speed'") != NULL, "%s", e.text);
}
END_TEST

static struct table_distance_tolerance *tolerances(const char *text)
{
    arena = arena ? arena : arena_open();
    e = (struct err){0};
    const char *path = file_of(text);
    struct table_distance_tolerance *t = table_distance_read(path, arena, &e);
    unlink(path);
    return t;
}

START_TEST(tolerance_files)
{
    const struct table_distance_tolerance *t = tolerances("column,abs,rel\nv,1e-6,0.5\n*,0,1\n");
    ck_assert_msg(t != NULL, "%s", e.text);
    ck_assert(!strcmp(t[0].column, "v") && t[0].abs == 1e-6 && t[0].rel == 0.5 && !t[0].exact);
    ck_assert(!strcmp(t[1].column, "*") && t[1].rel == 1 && !t[2].column);
    ck_assert(!tolerances("v,1,2\n") && strstr(e.text, "header 'column,abs,rel'"));
    ck_assert(!tolerances("column,abs,rel\nv,-1,2\n") && strstr(e.text, ":2: a tolerance is not negative"));
    ck_assert(!tolerances("column,abs,rel\nv,x,2\n") && strstr(e.text, ":2: column 'abs': 'x' is not a number"));
    ck_assert(!tolerances("column,abs,rel\nv,0,2\nv,0,1\n") && strstr(e.text, ":3: a second tolerance for 'v'"));
    ck_assert(!tolerances("") && e.kind == ERR_SCENE);
}
END_TEST

UNIT("table_distance", exact_is_text, tolerance_is_abs_plus_rel_of_a, not_a_number_equals_only_itself,
     star_is_for_the_others, shapes, tolerance_for_no_column, tolerance_files)
