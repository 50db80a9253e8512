/* The PNG part of heightfile.h: 16-bit grey. */
#ifndef FILE_HEIGHTFILE_PNG_H
#define FILE_HEIGHTFILE_PNG_H
#include <stdio.h>

#include "file/bytes.h"
#include "file/heightfile.h"

bool heightfile_png_is(const struct bytes *b);
/* Heights are the stored values, 0 to 65535 (white). */
bool heightfile_png_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);
/* Writes v = rint(65535 (z - low)/range), with Gwyddion's text chunks that say so. ERR_IO */
bool heightfile_png_write(FILE *f, const struct heightfile *h, double low, double range, struct err *e);

#endif
