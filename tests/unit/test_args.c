/* base/args.c: every form of an option against the meaning that POSIX and GNU give it, and every refusal. */
#include "unit.h"

#include "base/args.h"

static const struct args_option options[] = {
    {"output", 'o', "FILE", false, "a value"},
    {"set", 's', "PATH=VALUE", true, "repeatable"},
    {"quiet", 'q', NULL, false, "a flag"},
    {"dry-run", 'n', NULL, false, "a flag"},
    {"jobs", 'j', "N", false, "a number"},
    {"jot", 0, NULL, false, "shares its start"},
    {0},
};

static struct arena *arena;
static struct args g;
static struct err e;

/* Parses words separated by blanks; "_" stands for an empty word. */
static bool parse(const char *line)
{
    static char text[256], empty[1];
    char *argv[32];
    int argc = 0;
    snprintf(text, sizeof text, "%s", line);
    for (char *w = strtok(text, " "); w; w = strtok(NULL, " "))
        argv[argc++] = strcmp(w, "_") ? w : empty;
    arena = arena ? arena : arena_open();
    e = (struct err){0};
    return args_parse(&g, options, argc, argv, arena, &e);
}

static void refused(const char *line, const char *text)
{
    ck_assert_msg(!parse(line), "%s is taken", line);
    ck_assert_int_eq(e.kind, ERR_USAGE);
    ck_assert_msg(strstr(e.text, text) != NULL, "%s: '%s' lacks '%s'", line, e.text, text);
}

START_TEST(test_forms)
{
    static const char *const same[] = {"--output x -q a b", "-o x a --quiet b", "a --output=x b -q",
                                       "-qox a b",          "-qo x a -- b",     "-ox -q -- a b"};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        ck_assert_msg(parse(same[i]), "%s: %s", same[i], e.text);
        ck_assert_str_eq(args_value(&g, "output"), "x");
        ck_assert(args_given(&g, "quiet") && !args_given(&g, "dry-run"));
        ck_assert_int_eq(g.n_operands, 2);
        ck_assert_str_eq(g.operands[0], "a");
        ck_assert_str_eq(g.operands[1], "b");
        ck_assert_ptr_null(g.operands[2]);
    }
}
END_TEST

START_TEST(test_values_as_they_are)
{
    ck_assert(parse("--output=a=b=c"));
    ck_assert_str_eq(args_value(&g, "output"), "a=b=c");
    ck_assert(parse("--output="));
    ck_assert_str_eq(args_value(&g, "output"), "");
    ck_assert(parse("-o --quiet"));
    ck_assert_str_eq(args_value(&g, "output"), "--quiet");
    ck_assert(!args_given(&g, "quiet"));
    ck_assert(parse("-- -q --output"));
    ck_assert_int_eq(g.n_operands, 2);
    ck_assert(parse("- _"));
    ck_assert_int_eq(g.n_operands, 2);
    ck_assert_str_eq(g.operands[0], "-");
    ck_assert_str_eq(g.operands[1], "");
}
END_TEST

START_TEST(test_repeated)
{
    int n;
    ck_assert(parse("-s a=1 x --set b=2 --set=a=3"));
    const char **set = args_values(&g, "set", &n);
    ck_assert_int_eq(n, 3);
    ck_assert_str_eq(set[0], "a=1");
    ck_assert_str_eq(set[1], "b=2");
    ck_assert_str_eq(set[2], "a=3");
    ck_assert_ptr_null(set[3]);
    ck_assert_str_eq(args_value(&g, "set"), "a=3");
    ck_assert(parse("x"));
    args_values(&g, "set", &n);
    ck_assert_int_eq(n, 0);
    ck_assert_ptr_null(args_value(&g, "set"));
}
END_TEST

START_TEST(test_refusals)
{
    refused("--dry", "did you mean --dry-run?");
    refused("--outptu=x", "did you mean --output?");
    refused("--hepl", "did you mean --help?");
    refused("--jo", "no option --jo");
    refused("--zzzzzzzz", "no option --zzzzzzzz");
    refused("-x", "no option -x");
    refused("-qx", "no option -x");
    refused("--output", "--output needs a value: --output=FILE");
    refused("-qo", "--output needs a value");
    refused("--quiet=1", "--quiet takes no value");
    refused("-o a -o b", "--output is given twice");
    refused("-qq", "--quiet is given twice");
}
END_TEST

START_TEST(test_help_ends_the_parse)
{
    ck_assert(parse("a --help --nonsense"));
    ck_assert(g.help);
    ck_assert(parse("-h"));
    ck_assert(g.help);
    ck_assert(parse("-o --help"));
    ck_assert(!g.help);
    ck_assert(parse("-- --help"));
    ck_assert(!g.help);
}
END_TEST

START_TEST(test_numbers)
{
    const double range[2] = {0, 8};
    const long whole[2] = {1, 8};
    double x = 5;
    long n = 5;
    ck_assert(parse("") && args_number(&g, "jobs", range, &x, &e) && x == 5);
    ck_assert(args_whole(&g, "jobs", whole, &n, &e) && n == 5);
    ck_assert(parse("-j 2.5e-1") && args_number(&g, "jobs", range, &x, &e) && x == 0.25);
    ck_assert(parse("-j8") && args_whole(&g, "jobs", whole, &n, &e) && n == 8);
    static const char *const bad[] = {"-j9", "-j -1", "-j 2x", "-j nan", "-j inf", "-j 0x2", "--jobs="};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert(parse(bad[i]));
        ck_assert_msg(!args_number(&g, "jobs", range, &x, &e) && e.kind == ERR_USAGE, "%s is taken", bad[i]);
        ck_assert(x == 0.25);
    }
    ck_assert(parse("-j 2.5") && !args_whole(&g, "jobs", whole, &n, &e));
    ck_assert_ptr_nonnull(strstr(e.text, "whole"));
    ck_assert_int_eq(n, 8);
}
END_TEST

START_TEST(test_words)
{
    static const char *const words[] = {"one", "two", "8", NULL};
    int chosen = 1;
    ck_assert(parse("") && args_word(&g, "jobs", words, &chosen, &e) && chosen == 1);
    ck_assert(parse("-j8") && args_word(&g, "jobs", words, &chosen, &e) && chosen == 2);
    ck_assert(parse("-j3") && !args_word(&g, "jobs", words, &chosen, &e) && chosen == 2);
    ck_assert_str_eq(e.text, "--jobs: '3' is not one, two or 8");
}
END_TEST

UNIT("args", test_forms, test_values_as_they_are, test_repeated, test_refusals, test_help_ends_the_parse, test_numbers,
     test_words)
