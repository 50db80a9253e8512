/* The part of heightfile.h for a grid of numbers as text. */
#ifndef FILE_HEIGHTFILE_CSV_H
#define FILE_HEIGHTFILE_CSV_H
#include <stdio.h>

#include "file/bytes.h"
#include "file/heightfile.h"

bool heightfile_csv_is(const struct bytes *b);
/* Heights in stored units; empty cells and nan are missing. */
bool heightfile_csv_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);
void heightfile_csv_write(FILE *f, const struct heightfile *h);

#endif
