/* `rasp --version`, and with --verbose what a bug report needs. */
#ifndef CMD_VERSION_H
#define CMD_VERSION_H
#include <stdbool.h>

void version_print(bool verbose);

/* Prints if the words ask for no more than that: --version and, before or behind it, --verbose (-V, -v). False: they do
 * not. */
bool version_asked(int argc, char **argv);

/* "0.1.0", and of what state of the source the program was built: "f650ae05d2ab"; "unknown". */
extern const char version_number[], version_revision[];

#endif
