/* Height maps and profiles from files. Told apart by content, not name:

     GSF   Gwyddion Simple Field                heightfile_gsf.c
     GWY   Gwyddion's own format                heightfile_gwy.c   (what Gwyddion reads, it can turn into this)
     SDF   ISO 25178-71, text and binary        heightfile_sdf.c
     NPY   NumPy's arrays, 1-D and 2-D          heightfile_npy.c
     PNG   16-bit grey                          heightfile_png.c
     CSV   a grid of numbers                    heightfile_csv.c

   Writing: heightfile_write.h. Scale, pitch, holes, levelling and what is plausible: heightfile_load.h, which is what
   callers want. */
#ifndef FILE_HEIGHTFILE_H
#define FILE_HEIGHTFILE_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

/* z = mean + slope_x (x - x of the middle) + slope_y (y - y of the middle); slopes in m/m. */
struct heightfile_plane {
    double mean, slope_x, slope_y;
};

struct heightfile {
    size_t columns, rows;    /* rows = 1: a profile                                                     */
    double pitch_x, pitch_y; /* m; NAN: the file does not say                                           */
    double *z;               /* [rows][columns], NAN: missing; metres if `metric`, else stored units    */
    bool metric;             /* the file says that heights are metres, or what makes them so            */
    double white;            /* stored value that stands for the whole height range (PNG); 0: no such   */
    double step;             /* of stored whole numbers, in the unit of z; 0: floating point or text    */
    int bits;                /* of a stored number, of floating point those of the fraction; 0: text    */
    double quantum; /* smallest difference between large heights, in the unit of z: `step`, or the last place of the
                       largest height; 0: text, as fine as it is written                       */
    size_t holes, first_hole;         /* missing points, and the index of the first in z                         */
    const char *format;               /* "GSF", "SDF (text)" ...                                                 */
    const char *title;                /* NULL: none                                                              */
    size_t filled;                    /* by heightfile_load: points that were missing                            */
    struct heightfile_plane levelled; /* by heightfile_load: what was subtracted                        */
};

/* A map of 16384 x 16384, 2 GiB as doubles. More is refused. */
#define HEIGHTFILE_MOST ((size_t)1 << 28)

/* Reads any of the formats. Memory: 8 bytes a sample, in `a`, and while it reads the file's size. Errors: ERR_INPUT
   missing or unreadable, ERR_SCENE for content: says what is wrong and where (byte offset, line, or index). Infinite
   heights are refused. */
bool heightfile_read(const char *path, struct arena *a, struct heightfile *h, struct err *e);

/* Writes a GSF (float32, as the format is: 24 bits, so subtract a large mean first); a pitch of NAN and a title of NULL
   are left out. ERR_CREATE, ERR_IO; ERR_NUMBERS: a height that float32 does not hold; ERR_SCENE: a title of several
   lines. All other formats, and maps with holes: heightfile_write.h. */
bool heightfile_write_gsf(const char *path, const struct heightfile *h, const char *title, struct err *e);

/* For the readers: room for h->rows x h->columns heights, none of them 0; refuses more than HEIGHTFILE_MOST. */
bool heightfile_room(const char *path, struct heightfile *h, struct arena *a, struct err *e);

#endif
