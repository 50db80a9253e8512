/* See program.h. */
#include "cmd/program.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <string.h>
#include <unistd.h>

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

int program_complain(const char *command, const struct err *e)
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

int program_run(const struct command *m, int argc, char **argv)
{
    struct err e = {0};
    struct cmd_call c = {.arena = arena_open(), .argc = argc, .argv = argv};
    int code = 0;
    if (!args_parse(&c.args, m->options, argc, argv, c.arena, &e))
        code = (int)e.kind;
    else if (c.args.help)
        cmd_print_help(m);
    else if (count_operands(m, &c.args, &e))
        code = m->run(&c, &e);
    if (e.kind)
        code = program_complain(m->name, &e);
    arena_close(c.arena);
    return code;
}

int program_main(int (*run)(int argc, char **argv), int argc, char **argv)
{
    fill_standard_streams();
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a file that grows past its limit is a write error, exit 74 */
    return close_stdout(run(argc, argv));
}
