/* The SDF part of heightfile.h (ISO 25178-71), text and binary. */
#ifndef FILE_HEIGHTFILE_SDF_H
#define FILE_HEIGHTFILE_SDF_H
#include <stdio.h>

#include "file/bytes.h"
#include "file/heightfile.h"

bool heightfile_sdf_is(const struct bytes *b);
/* Heights in metres; a Yscale of 0, as profiles have it, is a pitch_y of NAN. */
bool heightfile_sdf_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);
/* binary: 64-bit floating point; at most 65535 x 65535 samples, as the format has it. */
void heightfile_sdf_write(FILE *f, const struct heightfile *h, bool binary);

#endif
