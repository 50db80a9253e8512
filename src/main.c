/* rasp COMMAND [OPTION]... [OPERAND]...: finds the command, parses its options, runs it, and checks that stdout took everything. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cmd/cmd.h"
#include "cmd/commands.h"
#include "cmd/version.h"

/* Where stdin, stdout or stderr is closed, an output file would take its number and messages would land in it. Reading this end of
   /dev/null gives nothing and writing it fails. */
static void fill_standard_streams(void)
{
    int fd;
    do
        fd = open("/dev/null", O_RDONLY);
    while (fd >= 0 && fd <= STDERR_FILENO);
    if (fd >= 0)
        close(fd);
}

/* What was printed has to have arrived: a full disk or a closed pipe is an error, unless there is a worse one already. */
static int close_stdout(int code)
{
    int failed = ferror(stdout), pending = __fpending(stdout) != 0;
    errno = 0;
    if (fclose(stdout) != 0)
        failed |= pending || errno != EBADF;
    if (!failed)
        return code;
    fprintf(stderr, "rasp: error: cannot write to standard output: %s\n", errno ? strerror(errno) : "what was printed is not complete");
    return code ? code : ERR_IO;
}

static int complain(const char *command, const struct err *e)
{
    fprintf(stderr, "rasp%s%s: error: %s\n", *command ? " " : "", command, e->text);
    if (e->kind == ERR_USAGE)
        fprintf(stderr, "Try: rasp %s%s--help\n", command, *command ? " " : "");
    return (int)e->kind;
}

static bool count_operands(const struct command *m, const struct args *g, struct err *e)
{
    if (g->n_operands < m->least)
        return err_set(e, ERR_USAGE, "%s missing; usage: rasp %s [OPTION]... %s", m->least > 1 ? "operands are" : "an operand is", m->name,
                       m->operands);
    if (m->most >= 0 && g->n_operands > m->most)
        return err_set(e, ERR_USAGE, "extra operand '%s'; usage: rasp %s [OPTION]... %s", g->operands[m->most], m->name, m->operands);
    return true;
}

static int run_command(const struct command *m, int argc, char **argv)
{
    struct err e = {0};
    struct cmd_call c = {.arena = arena_open()};
    int code = 0;
    if (!args_parse(&c.args, m->options, argc, argv, c.arena, &e))
        code = (int)e.kind;
    else if (c.args.help)
        cmd_print_help(m);
    else if (count_operands(m, &c.args, &e))
        code = m->run(&c, &e);
    if (e.kind)
        code = complain(m->name, &e);
    arena_close(c.arena);
    return code;
}

static int unknown_command(const char *word)
{
    struct err e = {0};
    const char *meant = commands_nearest(word);
    if (meant)
        err_set(&e, ERR_USAGE, "no command '%s'; did you mean '%s'?", word, meant);
    else
        err_set(&e, ERR_USAGE, "no command '%s'", word);
    return complain("", &e);
}

/* `rasp help [COMMAND]`; `rasp help --man` is the body of man rasp(1). */
static int run_help(int argc, char **argv)
{
    if (argc == 0) {
        commands_print(stdout);
        return 0;
    }
    const struct command *m = commands_find(argv[0]);
    if (!strcmp(argv[0], "--man"))
        commands_print_man(stdout);
    else if (m)
        cmd_print_help(m);
    else
        return unknown_command(argv[0]);
    return 0;
}

/* `rasp --version [--verbose]`, `rasp --help`, and what they are mistaken for. */
static int run_bare(int argc, char **argv)
{
    static const struct args_option options[] = {{"version", 'V', NULL, false, "the version"},
                                                 {"verbose", 'v', NULL, false, "with --version: compiler, flags and libraries"},
                                                 {0}};
    struct err e = {0};
    struct args g;
    struct arena *a = arena_open();
    int code = 0;
    if (!args_parse(&g, options, argc, argv, a, &e))
        code = complain("", &e);
    else if (g.help)
        commands_print(stdout);
    else if (args_given(&g, "version"))
        version_print(args_given(&g, "verbose"));
    else {
        err_set(&e, ERR_USAGE, "options of a command come after its name");
        code = complain("", &e);
    }
    arena_close(a);
    return code;
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        commands_print(stderr);
        return ERR_USAGE;
    }
    if (argv[1][0] == '-')
        return run_bare(argc - 1, argv + 1);
    if (!strcmp(argv[1], "help"))
        return run_help(argc - 2, argv + 2);
    const struct command *m = commands_find(argv[1]);
    return m ? run_command(m, argc - 2, argv + 2) : unknown_command(argv[1]);
}

int main(int argc, char **argv)
{
    fill_standard_streams();
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a file that grows past its limit is a write error, exit 74 */
    return close_stdout(run(argc, argv));
}
