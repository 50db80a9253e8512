/* rasp-modes compute ..., material ...: the actions of `rasp modes` that need sparse and dense linear algebra, in a
 * program of its own, so that rasp starts without them. */
#include "cmd/cmd.h"
#include "cmd/modes.h"

extern void openblas_set_num_threads(int n);

static int modes_run(struct cmd_call *c, struct err *e)
{
    openblas_set_num_threads(1); /* the order of additions must not depend on the number of processors */
    return modes_solids_only(c, e,
                             (int (*const[])(struct cmd_call *, struct err *)){modes_compute_run, modes_material_run});
}

static int run(int argc, char **argv)
{
    struct command modes = modes_command;
    if (version_asked(argc - 1, argv + 1)) return 0;
    modes.run = modes_run;
    return cmd_run(&modes, argc - 1, argv + 1);
}

int main(int argc, char **argv) { return cmd_main(run, argc, argv); }
