/* rasp-modes ACTION ...: `rasp modes` with the actions that need sparse and dense linear algebra, in a program of its own, so that rasp starts without them. */
#include "cmd/modes.h"
#include "cmd/program.h"
#include "cmd/version.h"

static int run(int argc, char **argv)
{
    struct command modes = modes_command;
    if (version_asked(argc - 1, argv + 1))
        return 0;
    modes.run = modes_heavy_run;
    return program_run(&modes, argc - 1, argv + 1);
}

int main(int argc, char **argv)
{
    return program_main(run, argc, argv);
}
