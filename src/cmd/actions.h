/* Commands of several actions: `rasp COMMAND ACTION OPERANDS`, one table of options for all of them. */
#ifndef CMD_ACTIONS_H
#define CMD_ACTIONS_H
#include "cmd/cmd.h"

enum { ACTIONS_OPTIONS = 40 };

struct action {
    const char *name;
    const char *operands;                 /* what it takes, for a message                                          */
    int least, most;                      /* number of operands behind the action's name; most < 0: any number     */
    const char *options[ACTIONS_OPTIONS]; /* those of the command's that it takes; fewer than that many end in NULL */
    int (*run)(struct cmd_call *c, struct err *e);
};

/* Runs the action that the first operand names, with the operands behind it; `table` ends with name NULL. An option that belongs to another
   action is refused. Exit codes as a command's run. ERR_USAGE */
int actions_run(const char *command, const struct action *table, struct cmd_call *c, struct err *e);

#endif
