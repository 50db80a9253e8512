/* YAML texts against the tree and the places that YAML's specification gives them by hand, and texts that must be
 * refused. */
#include "file/yaml.h"

#include <sys/stat.h>
#include <unistd.h>

#include "base/text.h"
#include "unit.h"

static struct yaml_node *parsed(struct yaml *y, const char *text)
{
    return yaml_parse(y, yaml_source(y, "t.yaml", text, strlen(text)));
}

static void place_is(const struct yaml_node *node, int line, int column, int width)
{
    ck_assert_int_eq(node->at.line, line);
    ck_assert_int_eq(node->at.column, column);
    ck_assert_int_eq(node->at.width, width);
}

START_TEST(test_tree)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    struct yaml_node *root =
        parsed(y, "# remark\nmass: 20 g  # heavy\nmotion:\n  to: [3 cm, \"x\"]\n  law: {p: 'q'}\nlist:\n- a\n- b: c\n");
    ck_assert(root && y->diag->n == 0 && root->kind == YAML_MAP && root->n == 3);
    struct yaml_node *mass = yaml_get(root, "mass"), *to = yaml_find(root, "motion.to"),
                     *p = yaml_find(root, "motion.law.p");
    ck_assert_str_eq(mass->text, "20 g");
    ck_assert(mass->plain && !to->first->next->plain && !p->plain);
    place_is(mass, 2, 7, 4);
    place_is(mass->key, 2, 1, 4);
    place_is(to, 4, 7, 11);
    place_is(to->first->next, 4, 14, 3);
    place_is(yaml_find(root, "motion.law"), 5, 8, 8);
    ck_assert_int_eq(yaml_get(root, "list")->n, 2);
    ck_assert_ptr_null(yaml_get(root, "no"));
    ck_assert_ptr_null(yaml_find(root, "mass.no"));
    arena_close(a);
}
END_TEST

START_TEST(test_alias)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    struct yaml_node *root = parsed(y, "a: &x {m: 1, n: [2, 3]}\nb: *x\nc: &y word\nd: *y\n");
    ck_assert(root && y->diag->n == 0);
    struct yaml_node *b = yaml_find(root, "b.n");
    ck_assert(b && b != yaml_find(root, "a.n") && b->n == 2);
    ck_assert_str_eq(b->first->next->text, "3");
    ck_assert_int_eq(b->at.line, 1);
    ck_assert_str_eq(yaml_get(root, "d")->text, "word");
    arena_close(a);
}
END_TEST

START_TEST(test_byte_order_mark) /* it is no letter of the first key, and columns count from behind it */
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    struct yaml_node *root = parsed(y, "\xef\xbb\xbf"
                                       "a: 1\n");
    ck_assert(root && y->diag->n == 0);
    ck_assert_str_eq(yaml_get(root, "a")->text, "1");
    place_is(yaml_get(root, "a"), 1, 4, 1);
    arena_close(a);
}
END_TEST

static const struct {
    const char *text;
    const char *place; /* how the message starts */
    const char *caret, *cure;
} bad[] = {
    {"a: 1\nb: 2\na: 3\n", "t.yaml:3:1: error: duplicate key 'a'", "^", "first set on line 1"},
    {"a:\n  b: 1\n  \"b\": 2\n", "t.yaml:3:3: error: duplicate key 'b'", "^~~", "first set on line 2"},
    {"a: &x {b: 1}\nc:\n  <<: *x\n", "t.yaml:3:3: error: '<<' is not supported", "^~", "include"},
    {"a: 1\n---\nb: 2\n", "t.yaml:2:1: error: a second document", "^~~", "one document"},
    {"", "t.yaml: error: there is nothing in it", "", "rasp new"},
    {"# only a remark\n", "t.yaml: error: there is nothing in it", "", "rasp new"},
    {"[a, b]: 1\n", "t.yaml:1:1: error: a key must be a word", "^~~~~~", "a word, a colon"},
    {"? {a: b}\n: 1\n", "t.yaml:1:3: error: a key must be a word", "^~~~~~", "a word, a colon"},
    {"a: !!float 3\n", "t.yaml:1:4: error: tags are not supported", "^~~~~~~~~", "remove the tag"},
    {"a: !x {b: 1}\n", "t.yaml:1:4: error: tags are not supported", "^~~~", "remove the tag"},
    {"a: *nothing\n", "t.yaml:1:4: error: no anchor 'nothing'", "^~~~~~~~", "quotes"},
    {"a: &a [*a]\n", "t.yaml:1:8: error: no anchor 'a'", "^~", "anchor"},
    {"a: [1, 2\nb: 3\n", "t.yaml:2:2: error: not valid YAML", "^", "bracket that opens on line 1"},
    {"a:\n  b 1\n  c: 2\n", "t.yaml:3:4: error: not valid YAML: mapping values", "^", "the key above for its"},
    {"a: 1\nb 1\n# c\nc: 2\n", "t.yaml:2:1: error: not valid YAML: could not find expected", "^", "followed by"},
    {"RIFF....WAVE", "t.yaml: error: is a sound", "", "rasp play"},
    {"a: b: c\n", "t.yaml:1:5: error: not valid YAML: mapping values", "^", "quotes around a text"},
    {"a:\n\tb: 1\n", "t.yaml:2:1: error: not valid YAML: found character", "^", "spaces, not tabs"},
    {"a: @x\n", "t.yaml:1:4: error: not valid YAML: found character", "^", "quotes"},
    {"a: \"x\n", "t.yaml:1:4: error: not valid YAML: these quotes", "^", "same quotes"},
    {"a: 1\n b: 2\n", "t.yaml:2:3: error: not valid YAML", "^", "indentation"},
    {"a: \"x\\0y\"\n", "t.yaml:1:4: error: a text must not hold a NUL", "^~~~~~", "remove"},
    {"a: \xc3(\n", "t.yaml:1:4: error: not valid UTF-8", "^", "UTF-8"},
    {"b: \xc2\xb5\na: \xff\n", "t.yaml:2:4: error: not valid UTF-8", "^", "UTF-8"},
    {"a: \xc2\xb5\xff\n", "t.yaml:1:5: error: not valid UTF-8", "^", "UTF-8"},
    {"a: x\x07\n", "t.yaml:1:5: error: control character U+0007", "^", "remove"},
    {"\xff\xfe"
     "a",
     "t.yaml: error: encoded as UTF-16", "", "UTF-8"},
    {"%YAML 3.0\n---\na: 1\n", "t.yaml:1:1: error: not valid YAML", "^", "near here"},
};

START_TEST(test_bad)
{
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct arena *a = arena_open();
        struct yaml *y = yaml_open(a);
        parsed(y, bad[i].text);
        const char *text = diag_text(y->diag), *carets = arena_format(a, "| %s\n", bad[i].caret);
        const char *caret = strrchr(text, '^');
        ck_assert_msg(strncmp(text, bad[i].place, strlen(bad[i].place)) == 0, "case %zu: %s", i, text);
        ck_assert_msg(strstr(text, bad[i].cure) != NULL, "case %zu: %s", i, text);
        ck_assert_msg(strstr(text, "\n1 error\n") != NULL, "case %zu: %s", i, text);
        ck_assert_msg(!caret == !*bad[i].caret && (!caret || strncmp(caret, carets + 2, strlen(carets) - 2) == 0),
                      "case %zu: %s", i, text);
        arena_close(a);
    }
}
END_TEST

START_TEST(test_nul)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    ck_assert_ptr_null(yaml_parse(y, yaml_source(y, "t.yaml", "a: b\0c\n", 7)));
    ck_assert(strstr(diag_text(y->diag), "t.yaml:1:5: error: a NUL byte"));
    arena_close(a);
}
END_TEST

/* Ten aliases of ten aliases ...: 10^9 values. Refused quickly and in bounded memory. */
START_TEST(test_bomb)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    char text[4096] = "l0: &l0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 9; i++) {
        char line[256];
        int n = snprintf(line, sizeof line, "l%d: &l%d [", i, i);
        for (int j = 0; j < 10; j++)
            n += snprintf(line + n, sizeof line - (size_t)n, "%s*l%d", j ? ", " : "", i - 1);
        snprintf(line + n, sizeof line - (size_t)n, "]\n");
        strcat(text, line);
    }
    ck_assert_ptr_null(parsed(y, text));
    ck_assert(strstr(diag_text(y->diag), "more than 100000 values after expanding aliases"));
    ck_assert_uint_lt(arena_bytes(a), 64u << 20);
    arena_close(a);
}
END_TEST

static void repeated_is(const char *before, const char *unit, int times, const char *says)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    size_t n = strlen(unit), head = strlen(before);
    char *text = arena_take(a, head + n * (size_t)times + 1, 1);
    memcpy(text, before, head);
    for (int i = 0; i < times; i++)
        memcpy(text + head + n * (size_t)i, unit, n);
    ck_assert_msg(!parsed(y, text) == !!says, "%s", unit);
    ck_assert_msg(!says || strstr(diag_text(y->diag), says), "%s", diag_text(y->diag));
    arena_close(a);
}

START_TEST(test_limits)
{
    repeated_is("a: ", "[", 5000, "nested more than 64 deep");
    repeated_is("", "- ", 5000, "nested more than 64 deep");
    repeated_is("", "? ", 5000, "nested more than 64 deep");
    repeated_is("", "- ", 64, "nested more than 64 deep"); /* 64 lists and the empty value in them */
    repeated_is("", "- ", 63, NULL);
    repeated_is("", "- x\n", 100001, "more than 100000 values");
    repeated_is("", "- x\n", 90000, NULL);
    repeated_is("", "- &a x\n", 2000, "more than 1000 anchors");
    repeated_is("# ", "0123456789abcdef", (4 << 20) / 16, "larger than 4 MiB");
}
END_TEST

START_TEST(test_keys_limit)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    char *text = ARENA_TAKE(a, char, 20000);
    for (int i = 0, n = 0; i < 1001; i++)
        n += sprintf(text + n, "k%d: 1\n", i);
    ck_assert_ptr_null(parsed(y, text));
    ck_assert(strstr(diag_text(y->diag), "t.yaml:1001:1: error: more than 1000 keys in one map"));
    arena_close(a);
}
END_TEST

START_TEST(test_files)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    struct diag_place none = {NULL, 0, 0, 0};
    char folder[] = "/tmp/test_yaml_XXXXXX", name[64];
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(name, sizeof name, "%s/no.yaml", folder);
    ck_assert(!yaml_bytes_read(y, name, none) && y->missing);
    ck_assert(!yaml_bytes_read(y, folder, none));
    const char *text = diag_text(y->diag);
    ck_assert(strstr(text, "no.yaml: error: cannot be read: No such file") &&
              strstr(text, "error: cannot be read: Is a directory"));
    FILE *f = fopen(name, "w");
    for (int i = 0; i < 100000; i++) /* more than one step of the buffer */
        fprintf(f, "#%d\n", i);
    fputs("a: 1\n", f);
    fclose(f);
    struct diag_source *s = yaml_bytes_read(y, name, none);
    struct yaml_node *root = yaml_parse(y, s);
    ck_assert(root && yaml_get(root, "a")->at.line == 100001);
    unlink(name);
    rmdir(folder);
    arena_close(a);
}
END_TEST

/* Values of options: places count from the option's text; plain ones are taken whole. */
START_TEST(test_value)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    const char *text = "\xc2\xb5.to= [3 cm, 2 cm]", *title = "title= Fast: #1, *really*";
    struct diag_source *s = yaml_source(y, "--set x", text, strlen(text));
    struct yaml_node *list = yaml_parse_value(y, s, 6);
    ck_assert(list && list->kind == YAML_LIST && list->n == 2);
    place_is(list, 1, 7, 12);
    place_is(list->first->next, 1, 14, 4);
    struct yaml_node *word = yaml_parse_value(y, yaml_source(y, "--set title", title, strlen(title)), 6);
    ck_assert_str_eq(word->text, "Fast: #1, *really*");
    ck_assert(yaml_null(yaml_parse_value(y, yaml_source(y, "x", "a=~", 3), 2)));
    ck_assert_int_eq(y->diag->n, 0);
    arena_close(a);
}
END_TEST

/* Tabs are copied into the caret's line, columns count characters, a long line is cut around the place. */
START_TEST(test_caret)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    parsed(y, "\xc2\xb5\xe2\x82\xac: {x:\t\t*no}\n");
    ck_assert_str_eq(diag_text(y->diag), "t.yaml:1:10: error: no anchor 'no' before this\n"
                                         "    1 | \xc2\xb5\xe2\x82\xac: {x:\t\t*no}\n"
                                         "      |        \t\t^~~\n"
                                         "      = help: an anchor (&name) must stand before its aliases (*name); put "
                                         "quotes around a text that starts with *\n"
                                         "1 error\n");
    y = yaml_open(a);
    char *text = ARENA_TAKE(a, char, 3000);
    memset(text, ' ', 2000);
    memcpy(text, "a: [", 4);
    strcpy(text + 1990, "*no]\n");
    parsed(y, text);
    const char *told = diag_text(y->diag);
    ck_assert(strncmp(told, "t.yaml:1:1991: error: ", 22) == 0 && strlen(told) < 700 && strstr(told, "*no]"));
    arena_close(a);
}
END_TEST

/* Nothing that a terminal would obey or choke on is printed. */
START_TEST(test_shown)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    parsed(y, "a\x1b[31m: \xff");
    ck_assert(strstr(diag_text(y->diag), "    1 | a?[31m: ?\n      |  ^\n"));
    y = yaml_open(a);
    parsed(y, "\"\\e[31m\": *\xc2\xb5");
    const char *told = diag_text(y->diag);
    ck_assert_msg(!strchr(told, '\x1b'), "%s", told);
    diag_add(y->diag, (struct diag_place){NULL, 0, 0, 0}, "\x9b\xc2\x9b", "%s", "\x1b\xc2\xb5\xff");
    ck_assert(strstr(diag_text(y->diag), "error: \\x1b\xc2\xb5\\xff\n") &&
              strstr(diag_text(y->diag), "help: \\x9b\\xc2\\x9b\n"));
    arena_close(a);
}
END_TEST

START_TEST(test_many)
{
    struct arena *a = arena_open();
    struct yaml *y = yaml_open(a);
    char *text = ARENA_TAKE(a, char, 40000);
    for (int i = 0, n = 0; i < 3000; i++)
        n += sprintf(text + n, "k: 1\n");
    parsed(y, text);
    const char *told = diag_text(y->diag), *end = "... and 2979 more\n2999 errors\n";
    ck_assert_str_eq(told + strlen(told) - strlen(end), end);
    int shown = 0;
    for (const char *s = told; (s = strstr(s, "error: ")); s++)
        shown++;
    ck_assert_int_eq(shown, 20);
    arena_close(a);
}
END_TEST

UNIT("yaml", test_tree, test_alias, test_byte_order_mark, test_bad, test_nul, test_bomb, test_limits, test_keys_limit,
     test_files, test_value, test_caret, test_shown, test_many)
