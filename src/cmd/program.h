/* What rasp and rasp-modes have in common: parsing a command's options, running it, checking that stdout took
 * everything. */
#ifndef CMD_PROGRAM_H
#define CMD_PROGRAM_H
#include "cmd/cmd.h"

/* The whole of main: standard streams that are closed are filled, signals are set, `run` is called, stdout is closed.
 * Returns the exit code. */
int program_main(int (*run)(int argc, char **argv), int argc, char **argv);

/* Runs a command with the words behind its name, and tells of its error. Returns the exit code. */
int program_run(const struct command *m, int argc, char **argv);

/* Prints "rasp COMMAND: error: text" ("": of rasp itself) and returns the exit code. */
int program_complain(const char *command, const struct err *e);

#endif
