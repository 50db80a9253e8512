/* The Gwyddion Simple Field half of heightfile.h. */
#ifndef FILE_HEIGHTFILE_GSF_H
#define FILE_HEIGHTFILE_GSF_H
#include "file/bytes.h"
#include "file/heightfile.h"

bool heightfile_gsf_is(const struct bytes *b);
/* Fills everything, in metres.. */
bool heightfile_gsf_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);

#endif
