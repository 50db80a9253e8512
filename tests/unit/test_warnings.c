/* cmd/message.c: which warnings are told together. What is expected is written by hand. */
#include "unit.h"

#include "cmd/message.h"

static struct arena *a;
static struct warning *all;

static void add(const char *file, const char *text, bool exact) { message_add(&all, file, text, exact, a); }

/* "text [files]" of each, with a + where some have other numbers. */
static const char *listed(void)
{
    const char *list = "";
    for (const struct warning *w = all; w; w = w->next) {
        list = arena_format(a, "%s%s%s [", list, w->text, w->numbers ? "+" : "");
        for (int i = 0; i < w->n; i++)
            list = arena_format(a, "%s%s%s", list, i ? " " : "", w->files[i]);
        list = arena_format(a, "%s]%s", list, w->next ? "; " : "");
    }
    all = NULL;
    return list;
}

START_TEST(test_the_same)
{
    a = arena_open();
    add("a", "cut at 4 s", true);
    add("b", "cut at 4 s", true);
    add("b", "cut at 4 s", true);
    add("c", "cut at 4.5 s", true);
    add("d", "off", true);
    add("c", "cut at 4 s", true);
    ck_assert_str_eq(listed(), "cut at 4 s [a b c]; cut at 4.5 s [c]; off [d]");
    arena_close(a);
}
END_TEST

START_TEST(test_other_numbers)
{
    a = arena_open();
    add("a", "cut at 4 s (-3.5 dB)", false);
    add("b", "cut at 4.25e-1 s (+12 dB)", false);
    add("c", "cut at 4 s (-3.5 dB)", false);
    add("d", "cut at 4 m (-3.5 dB)", false);
    add("e", "cut at four s (-3.5 dB)", false);
    add("f", "cut at 4 s", false);
    add("g", "cut at 4", false);
    ck_assert_str_eq(listed(), "cut at 4 s (-3.5 dB)+ [a b c]; cut at 4 m (-3.5 dB) [d]; cut at four s (-3.5 dB) [e]; "
                               "cut at 4 s [f]; cut at 4 [g]");
    arena_close(a);
}
END_TEST

/* Two of one file are told both, each with its like of the next file. */
START_TEST(test_one_file)
{
    a = arena_open();
    add("a", "lifts off for 1 s", false);
    add("a", "lifts off for 2 s", false);
    add("b", "lifts off for 2 s", false);
    add("b", "lifts off for 3 s", false);
    add("c", "lifts off for 1 s", false);
    ck_assert_str_eq(listed(), "lifts off for 1 s+ [a b c]; lifts off for 2 s [a b]");
    arena_close(a);
}
END_TEST

/* What it tells with the numbers of an earlier file counts as told by that one, which is not lost when its own come,
 * too. */
START_TEST(test_crossed)
{
    a = arena_open();
    add("a", "lifts off for 1 s", false);
    add("a", "lifts off for 2 s", false);
    add("b", "lifts off for 3 s", false);
    add("b", "lifts off for 1 s", false);
    ck_assert_str_eq(listed(), "lifts off for 1 s+ [a b]; lifts off for 2 s+ [a b]");
    add("a", "lifts off for 1 s", false);
    add("b", "lifts off for 3 s", false);
    add("b", "lifts off for 1 s", false);
    add("b", "lifts off for 1 s", false);
    ck_assert_str_eq(listed(), "lifts off for 1 s+ [a b]; lifts off for 1 s [b]");
    arena_close(a);
}
END_TEST

START_TEST(test_names)
{
    a = arena_open();
    add("a", "contact 'c1': off", false);
    add("b", "contact 'c2': off", false);
    add("c", "irs/hit-1.csv: 3 modes", false);
    add("d", "irs/hit-2.csv: 3 modes", false);
    add("e", "irs/hit-2.csv: 4 modes", false);
    ck_assert_str_eq(
        listed(),
        "contact 'c1': off [a]; contact 'c2': off [b]; irs/hit-1.csv: 3 modes [c]; irs/hit-2.csv: 3 modes+ [d e]");
    arena_close(a);
}
END_TEST

UNIT("warnings", test_the_same, test_other_numbers, test_one_file, test_crossed, test_names)
