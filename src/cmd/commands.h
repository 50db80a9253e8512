/* The table of subcommands, in groups as the usage shows them. */
#ifndef CMD_COMMANDS_H
#define CMD_COMMANDS_H
#include <stdio.h>

#include "cmd/cmd.h"

const struct command *commands_find(const char *name); /* NULL: none */
const char *commands_nearest(const char *word);        /* NULL: nothing like it */
const struct command *commands_at(int i);              /* from 0, in the order of the usage; NULL: there are fewer */
void commands_print(FILE *f);                          /* the usage with all commands */
void commands_print_man(FILE *f);                      /* the commands and their options, in mdoc */

#endif
