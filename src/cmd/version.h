/* `rasp --version`, and with --verbose what a bug report needs. */
#ifndef CMD_VERSION_H
#define CMD_VERSION_H
#include <stdbool.h>

void version_print(bool verbose);

/* "0.1.0", and of what state of the source the program was built: "f650ae05d2ab"; "unknown". */
extern const char version_number[], version_revision[];

#endif
