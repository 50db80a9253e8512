/* See program.h. */
#include "cmd/program.h"

#include <errno.h>
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <jansson.h>
#include <signal.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/lastwords.h"
#include "base/memory.h"
#include "cmd/tell.h"

/* What was printed has to have arrived: a full disk or a closed pipe is an error, unless there is a worse one already.
 */
static int close_stdout(int code)
{
    int failed = ferror(stdout);
    if (failed && __fpending(stdout) == 0)
        putchar('\n'); /* else nothing is left that would say why it cannot be written */
    int pending = __fpending(stdout) != 0;
    errno = 0;
    if (fclose(stdout) != 0) failed |= pending || errno != EBADF;
    if (!failed) return code;
    fprintf(stderr, "rasp: error: cannot write to standard output: %s\n",
            errno ? strerror(errno) : "what was printed is not complete");
    return code ? code : ERR_IO;
}

int program_complain(const char *command, const struct err *e)
{
    char line[sizeof e->text + 64];
    snprintf(line, sizeof line, "rasp%s%s: error: %s\n", *command ? " " : "", command, e->text);
    tell_paint(stderr, line);
    if (e->kind == ERR_USAGE) fprintf(stderr, "Try: rasp %s%s--help\n", command, *command ? " " : "");
    return (int)e->kind;
}

static bool count_operands(const struct command *m, const struct args *g, struct err *e)
{
    if (g->n_operands < m->least)
        return err_set(e, ERR_USAGE, "%s missing; usage: rasp %s [OPTION]... %s",
                       m->least > 1 ? "operands are" : "an operand is", m->name, m->operands);
    if (m->most >= 0 && g->n_operands > m->most)
        return err_set(e, ERR_USAGE, "extra operand '%s'; usage: rasp %s [OPTION]... %s", g->operands[m->most], m->name,
                       m->operands);
    return true;
}

/* Known before anything is taken: --diagnostics=json, or two words. */
static bool asks_json(int argc, char **argv)
{
    for (int i = 0; i < argc; i++)
        if (!strcmp(argv[i], "--diagnostics=json") ||
            (!strcmp(argv[i], "--diagnostics") && i + 1 < argc && !strcmp(argv[i + 1], "json")))
            return true;
    return false;
}

int program_run(const struct command *m, int argc, char **argv)
{
    bool json = asks_json(argc, argv);
    if (json) lastwords_as_json();
    struct err e = {0};
    struct cmd_call c = {.arena = arena_open(), .argc = argc, .argv = argv};
    if (json) tell_as_json(&c);
    int code = 0;
    if (!args_parse(&c.args, cmd_options(m, c.arena), argc, argv, c.arena, &e))
        code = (int)e.kind;
    else if (c.args.help)
        cmd_print_help(m);
    else if (tell_begin(&c, &e) && count_operands(m, &c.args, &e))
        code = m->run(&c, &e);
    tell_end(&c);
    if (e.kind == ERR_INTERRUPTED) interrupt_tell();
    if (e.kind) {
        tell_error(&c, m->name, &e);
        code = (int)e.kind;
    }
    arena_close(c.arena);
    return code;
}

/* GSL's own way with errors, but for one: no memory left is no fault of the program. */
static void gsl_complains(const char *reason, const char *file, int line, int code)
{
    if (code == GSL_ENOMEM) memory_out("GSL: %s", reason);
    fprintf(stderr, "gsl: %s:%d: %s\n", file, line, reason);
    abort();
}

int program_main(int (*run)(int argc, char **argv), int argc, char **argv)
{
    /* Where stdin, stdout or stderr is closed, an output file would take its number and messages would land in it.
   Reading this end of /dev/null gives nothing and writing it fails. */
    int fd;
    do
        fd = open("/dev/null", O_RDONLY);
    while (fd >= 0 && fd <= STDERR_FILENO);
    if (fd >= 0) close(fd);
    interrupt_catch();
    gsl_set_error_handler(gsl_complains);
    json_set_alloc_funcs(memory_take, free); /* what jansson gets no memory for is else left out */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a file that grows past its limit is a write error, exit 74 */
    return close_stdout(run(argc, argv));
}
