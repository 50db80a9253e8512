/* The header of NumPy's array format: what stands before the numbers. heightfile_formats.c reads arrays of heights
 * behind it, csv.h tables. */
#ifndef FILE_NPY_H
#define FILE_NPY_H
#include <stdio.h>

#include "file/bytes.h"

enum { NPY_NAME = 64, NPY_FIELDS = 1000, NPY_HEADER = 16384 };

struct npy {
    char descr[NPY_NAME]; /* such as "<f8"; "": fields, each '<f8' */
    const char **fields;  /* [n_fields] */
    size_t n_fields;
    bool fortran;
    size_t shape[2], dimensions;
    size_t data; /* the byte at which the numbers begin   */
};

bool npy_is(const struct bytes *b);

/* ERR_SCENE: "path: NPY header, byte 12: what". */
bool npy_read(const char *path, const struct bytes *b, struct arena *a, struct npy *to, struct err *e);

/* The header of a table of so many rows, which follow as n little-endian doubles each. Fields: all together shorter
   than NPY_HEADER - 20 n - 100 characters. A failed write shows in the stream. */
void npy_write(FILE *f, const char *const *fields, size_t n, size_t rows);

/* The header of an array of doubles; of one row: of one dimension. */
void npy_write_array(FILE *f, size_t rows, size_t columns);

#endif
