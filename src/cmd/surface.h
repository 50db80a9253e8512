/* Parts of `rasp surface`: each action is called with its operands only. */
#ifndef CMD_SURFACE_H
#define CMD_SURFACE_H
#include "cmd/cmd.h"
#include "file/heightfile.h"

/* --pitch, --height-scale, --height-range, --holes (else `holes`), --levelling. ERR_USAGE */
bool surface_options(struct cmd_call *c, enum heightfile_holes holes, struct heightfile_options *o, struct err *e);

int surface_info_run(struct cmd_call *c, struct err *e);

#endif
