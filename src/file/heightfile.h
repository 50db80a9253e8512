/* Height maps from files: NPY and Gwyddion Simple Field (GSF). */
#ifndef FILE_HEIGHTFILE_H
#define FILE_HEIGHTFILE_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

struct heightfile {
    size_t columns, rows;   /* rows = 1: a profile                          */
    double pitch_x, pitch_y;/* m; NAN: the file does not say                */
    double *z;              /* [rows][columns], stored units (GSF: metres)  */
};

/* By content, not name. NPY: <f4 <f8 <i2 <u2 <i4 (and > big-endian), 1-D or 2-D, C order. GSF: metres, or the unit it names
   (m, mm, um, nm and the micro signs). Errors: ERR_INPUT missing or unreadable, ERR_SCENE for content: says what is wrong and
   where (byte offset or header line). Holes (NaN) and infinities are refused with the index of the first. */
bool heightfile_read(const char *path, struct arena *a, struct heightfile *h, struct err *e);

/* Writes a GSF (float32, as the format is: 24 bits, so subtract a large mean first); a pitch of NAN and a title of NULL are left
   out. ERR_CREATE, ERR_IO; ERR_NUMBERS: a height that float32 does not hold; ERR_SCENE: a title of several lines. */
bool heightfile_write_gsf(const char *path, const struct heightfile *h, const char *title, struct err *e);

#endif
