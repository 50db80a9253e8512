/* The NPY half of heightfile.h. */
#ifndef FILE_HEIGHTFILE_NPY_H
#define FILE_HEIGHTFILE_NPY_H
#include "file/bytes.h"
#include "file/heightfile.h"

/* Fills columns, rows, z; the pitch is NAN. */
bool heightfile_npy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);

#endif
