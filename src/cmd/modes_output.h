/* The table that `rasp modes` writes, looked at before any work. */
#ifndef CMD_MODES_OUTPUT_H
#define CMD_MODES_OUTPUT_H
#include <stdbool.h>

#include "base/err.h"

/* The output is not the file that is read, under whatever name (same device and inode; NULL: none is read). ERR_CREATE */
bool modes_output_spares(const char *output, const char *input, struct err *e);

/* Can it be created? Nothing is left. ERR_CREATE: a device, pipe or folder, write-protected, its folder is not there. */
bool modes_output_possible(const char *output, struct err *e);

#endif
