/* A design for rasp check. */
#ifndef CMD_CHECK_DESIGN_H
#define CMD_CHECK_DESIGN_H
#include "cmd/cmd.h"

/* Reads the design and the scene of every stimulus, as far as can be known before rendering. A fault that many stimuli have is told once. *remark: what is worth
   knowing of a design without fault, or NULL. */
bool check_design(struct cmd_call *c, const char *file, const char **remark, struct err *e);

#endif
