/* The part of heightfile.h for Gwyddion's own format. */
#ifndef FILE_HEIGHTFILE_GWY_H
#define FILE_HEIGHTFILE_GWY_H
#include <stdio.h>

#include "file/bytes.h"
#include "file/heightfile.h"

bool heightfile_gwy_is(const struct bytes *b);
/* Field number 0, or the first there is; heights in metres. What its mask marks is missing. */
bool heightfile_gwy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);
/* One data field, /0/data, and if there are holes its mask. */
void heightfile_gwy_write(FILE *f, const struct heightfile *h);
bool heightfile_gwy_write_fits(const struct heightfile *h); /* its sizes are 32-bit numbers */

#endif
