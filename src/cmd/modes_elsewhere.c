/* Runs rasp-modes in place of rasp, with the same words: it stands beside rasp, or, installed, in ../libexec/rasp.

   OpenBLAS reads when it is loaded which of its kernels to use, and each adds in an order of its own. Here are taken
   those that every x86-64 CPU can run, whatever the CPU and the environment say, so that a solid has one table: shapes
   differ by up to 1e-9 between kernels, which no rounding hides in all of thousands of gains. The others are faster by a
   quarter. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "cmd/modes.h"

enum { PATH_LENGTH = 4096 };

int modes_elsewhere_run(struct cmd_call *c, struct err *e)
{
    static const char *const places[] = {"rasp-modes", "../libexec/rasp/rasp-modes"};
    char self[PATH_LENGTH];
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    self[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(self, '/');
    if (slash)
        slash[1] = '\0';
    char **argv = arena_take(c->arena, (size_t)c->argc + 2, sizeof *argv);
    argv[0] = arena_text(c->arena, "rasp-modes");
    memcpy(argv + 1, c->argv, (size_t)c->argc * sizeof *argv);
    argv[c->argc + 1] = NULL;
    if (!interrupt_pass_on()) {
        err_set(e, ERR_INTERRUPTED, "interrupted; run the same command again");
        return (int)e->kind;
    }
    setenv("OPENBLAS_CORETYPE", "Prescott", 1);
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        execv(arena_format(c->arena, "%s%s", self, places[i]), argv);
    err_set(e, ERR_UNBUILT, "cannot run rasp-modes, which stands beside rasp or in ../libexec/rasp: %s; `make` builds it", strerror(errno));
    return (int)e->kind;
}
