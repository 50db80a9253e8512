/* The formats of heightfile.h, each its own reader and writer. */
#ifndef FILE_HEIGHTFILE_FORMATS_H
#define FILE_HEIGHTFILE_FORMATS_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "file/bytes.h"
#include "file/heightfile.h"

/* How many of the unit make a metre: "" and m: 1; mm, um (with either micro sign, also in Latin-1), nm, pm. False: not
 * a length. */
bool heightfile_formats_unit(const char *name, double *per_metre);

/* The shortest of %.15g, %.16g and %.17g that reads back as the same double; nan as it is. */
const char *heightfile_formats_number(char text[32], double value);

/* A grid of numbers as text. */
bool heightfile_formats_csv_is(const struct bytes *b);
/* Heights in stored units; empty cells and nan are missing. */
bool heightfile_formats_csv_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e);

void heightfile_formats_csv_write(FILE *f, const struct heightfile *h);

/* Gwyddion Simple Field. */
bool heightfile_formats_gsf_is(const struct bytes *b);
/* Fills everything, in metres. */
bool heightfile_formats_gsf_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e);

/* NPY: fills columns, rows, z; the pitch is NAN. */
bool heightfile_formats_npy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e);

/* PNG, 16-bit grey. */
bool heightfile_formats_png_is(const struct bytes *b);
/* Heights are the stored values, 0 to 65535 (white). */
bool heightfile_formats_png_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                                 struct err *e);

/* Writes v = rint(65535 (z - low)/range), with Gwyddion's text chunks that say so. ERR_IO */
bool heightfile_formats_png_write(FILE *f, const struct heightfile *h, double low, double range, struct err *e);

/* SDF (ISO 25178-71), text and binary. */
bool heightfile_sdf_is(const struct bytes *b);
/* Heights in metres; a Yscale of 0, as profiles have it, is a pitch_y of NAN. */
bool heightfile_sdf_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);

/* binary: 64-bit floating point; at most 65535 x 65535 samples, as the format has it. */
void heightfile_sdf_write(FILE *f, const struct heightfile *h, bool binary);

/* Gwyddion's own format. */
bool heightfile_gwy_is(const struct bytes *b);
/* Field number 0, or the first there is; heights in metres. What its mask marks is missing. */
bool heightfile_gwy_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h, struct err *e);

/* One data field, /0/data, and if there are holes its mask. */
void heightfile_gwy_write(FILE *f, const struct heightfile *h);

bool heightfile_gwy_write_fits(const struct heightfile *h); /* its sizes are 32-bit numbers */

#endif
