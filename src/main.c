/* rasp COMMAND [OPTION]... [OPERAND]...: finds the command and runs it. */
#include <stdio.h>
#include <string.h>

#include "cmd/cmd.h"

static int unknown_command(const char *word)
{
    struct err e = {0};
    const char *meant = cmd_nearest(word), *ending = strrchr(word, '.');
    if (ending && (!strcmp(ending, ".yaml") || !strcmp(ending, ".yml")))
        err_set(&e, ERR_USAGE, "no command '%s'; did you mean 'render %s'?", word, word);
    else if (meant)
        err_set(&e, ERR_USAGE, "no command '%s'; did you mean '%s'?", word, meant);
    else
        err_set(&e, ERR_USAGE, "no command '%s'", word);
    return cmd_complain("", &e);
}

/* `rasp help [COMMAND]`; `rasp help --man` is the body of man rasp(1). */
static int run_help(int argc, char **argv)
{
    if (argc == 0) {
        cmd_print(stdout);
        return 0;
    }
    const struct command *m = cmd_find(argv[0]);
    if (!strcmp(argv[0], "--man"))
        cmd_print_man(stdout);
    else if (m)
        cmd_print_help(m);
    else
        return unknown_command(argv[0]);
    return 0;
}

/* `rasp --version [--verbose]`, `rasp --help`, and what they are mistaken for. */
static int run_bare(int argc, char **argv)
{
    static const struct args_option options[] = {
        {"version", 'V', NULL, false, "the version"},
        {"verbose", 'v', NULL, false, "with --version: compiler, flags and libraries"},
        {0}};
    struct err e = {0};
    struct args g;
    struct arena *a = arena_open();
    int code = 0;
    if (!args_parse(&g, options, argc, argv, a, &e))
        code = cmd_complain("", &e);
    else if (g.help)
        cmd_print(stdout);
    else if (args_given(&g, "version"))
        version_print(args_given(&g, "verbose"));
    else {
        err_set(&e, ERR_USAGE, "options of a command come after its name");
        code = cmd_complain("", &e);
    }
    arena_close(a);
    return code;
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        cmd_print(stderr);
        return ERR_USAGE;
    }
    if (argv[1][0] == '-') return run_bare(argc - 1, argv + 1);
    if (!strcmp(argv[1], "help")) return run_help(argc - 2, argv + 2);
    const struct command *m = cmd_find(argv[1]);
    return m ? cmd_run(m, argc - 2, argv + 2) : unknown_command(argv[1]);
}

int main(int argc, char **argv) { return cmd_main(run, argc, argv); }
