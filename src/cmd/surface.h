/* Parts of `rasp surface`: each action is a file of its own, called with its operands only. */
#ifndef CMD_SURFACE_H
#define CMD_SURFACE_H
#include "cmd/cmd.h"
#include "file/heightfile_load.h"

/* --NAME as a length in [range[0], range[1]] m, with a unit or bare in metres; *x is left alone when it is not given. ERR_USAGE */
bool surface_length(struct cmd_call *c, const char *name, const double range[2], double *x, struct err *e);

/* --pitch, --height-scale, --height-range, --holes (else `holes`), --levelling. ERR_USAGE */
bool surface_options(struct cmd_call *c, enum heightfile_holes holes, struct heightfile_options *o, struct err *e);

/* The actions; exit codes as a command's run. */
int surface_info_run(struct cmd_call *c, struct err *e);
int surface_convert_run(struct cmd_call *c, struct err *e);
int surface_synth_run(struct cmd_call *c, struct err *e);

#endif
