/* The actions of `rasp modes` that rasp-modes has. */
#include "cmd/modes.h"

extern void openblas_set_num_threads(int n);

int modes_heavy_run(struct cmd_call *c, struct err *e)
{
    openblas_set_num_threads(1); /* the order of additions must not depend on the number of processors */
    return modes_dispatch(c, modes_compute_run, e);
}
