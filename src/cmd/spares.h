/* What a command writes does not take the place of what it reads. */
#ifndef CMD_SPARES_H
#define CMD_SPARES_H
#include <stdbool.h>

#include "base/err.h"

/* The output is not the input, under whatever name (same device and inode; NULL: none is read or written). what: "the table"; cure: "-o OTHER.csv". ERR_CREATE */
bool spares(const char *output, const char *what, const char *input, const char *cure, struct err *e);

#endif
