/* Colours of messages, on a terminal only. */
#ifndef CMD_PAINT_H
#define CMD_PAINT_H
#include <stdbool.h>
#include <stdio.h>

/* A terminal, whose TERM is neither empty nor dumb, and NO_COLOR is not set or empty (no-color.org). */
bool paint_wanted(FILE *f);

/* Prints messages as base/diag.h lays them out, in colours if they are wanted: the words error: and warning:, the line of carets, help:. */
void paint_lines(FILE *f, const char *lines);

#endif
