/* `rasp --version`, and with --verbose what a bug report needs. */
#ifndef CMD_VERSION_H
#define CMD_VERSION_H
#include <stdbool.h>

void version_print(bool verbose);

#endif
