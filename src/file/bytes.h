/* A whole file in memory. */
#ifndef FILE_BYTES_H
#define FILE_BYTES_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

struct bytes {
    char *at; /* at[n] is 0, so that text is a string */
    size_t n;
};

/* Also from pipes. ERR_INPUT: missing, a folder, or unreadable; "path: why". */
bool bytes_read(const char *path, struct arena *a, struct bytes *b, struct err *e);

#endif
