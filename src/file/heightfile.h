/* Height maps and profiles from files. Told apart by content, not name:

     GSF   Gwyddion Simple Field                heightfile_formats.c
     GWY   Gwyddion's own format                heightfile_gwy.c   (what Gwyddion reads, it can turn into this)
     SDF   ISO 25178-71, text and binary        heightfile_sdf.c
     NPY   NumPy's arrays, 1-D and 2-D          heightfile_formats.c
     PNG   16-bit grey                          heightfile_formats.c
     CSV   a grid of numbers                    heightfile_formats.c

   Scale, pitch, holes, levelling and what is plausible: heightfile_load, which is what
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

/* For the readers: room for h->rows x h->columns heights, none of them 0; refuses more than HEIGHTFILE_MOST. */
bool heightfile_room(const char *path, struct heightfile *h, struct arena *a, struct err *e);

/* Levelling a height map: what is subtracted before its roughness is looked at. Missing points are left out of the fit.
 */
enum heightfile_levelling { HEIGHTFILE_LEVEL_NONE, HEIGHTFILE_LEVEL_MEAN, HEIGHTFILE_LEVEL_PLANE };

/* The least-squares plane (of a profile: line) through the heights; a direction without two different places has slope
 * 0. */
struct heightfile_plane heightfile_level_fit(const struct heightfile *h);

/* Subtracts the mean or the plane and says what it was; with NONE nothing. */
struct heightfile_plane heightfile_level(struct heightfile *h, enum heightfile_levelling levelling);

/* Replaces h->holes missing points (NaN) by the solution of Laplace's equation with the heights around them, and sets
   h->filled, h->holes. The surface there is as smooth as it can be: it has no roughness of its own. Points at the map's
   edge have no neighbour beyond it (slope 0 across the edge); of a profile this is the straight line between the ends
   of a gap, and level behind the last height. Residual below 1e-12 of the map's range. Nothing happens without holes.
   ERR_SCENE: more than half of the map is missing. ERR_NUMBERS: no convergence. */
bool heightfile_fill(const char *path, struct heightfile *h, struct err *e);

/* A height map ready for use: in metres, with its pitch, holes filled or refused, levelled, and plausible. What the
   scene's height maps, `rasp surface` and roughness.like share. */

enum heightfile_holes { HEIGHTFILE_REFUSE, HEIGHTFILE_FILL, HEIGHTFILE_LEAVE };

/* How the caller's user sets these things, for messages. */
struct heightfile_names {
    const char *pitch, *height_scale, *height_range; /* "surface.pitch"                     */
    const char *fill;                                /* "surface.holes: fill", the whole    */
};

extern const struct heightfile_names heightfile_load_option_names;

struct heightfile_options {
    double pitch;        /* m, both ways; NAN: the file says it                                        */
    double height_scale; /* factor on the heights: m per stored unit; NAN or 1: none                   */
    double height_range; /* m that white stands for (PNG); NAN: not given                              */
    int holes;           /* enum heightfile_holes                                                      */
    int levelling;       /* enum heightfile_levelling                                                  */
    const struct heightfile_names *names; /* NULL: as in a scene                         */
};

/* Fills h: metres; pitch_x, and for a map pitch_y, are numbers. Order: scale, holes, limits, levelling (which leaves
   h->levelled). ERR_INPUT, ERR_SCENE as heightfile_read; and ERR_SCENE: fewer than 4 samples along a direction; pitch
   not known, given and not that of the file, or outside 10 nm to 1 mm; heights that span less than 1 nm (but are not
   all the same) or more than 10 mm: a unit is wrong, and the message says which would make sense; holes; a height range
   that is missing, or given where the file has none. ERR_NUMBERS: filling fails. */
bool heightfile_load(const char *path, const struct heightfile_options *o, struct arena *a, struct heightfile *h,
                     struct err *e);

/* What of a height map's heights looks like a slip of their unit: reported wherever a map is read, in the same words.
 */
enum { HEIGHTFILE_WARNINGS = 2 };

/* The heights, as loaded: reported in the names of whoever reads (NULL: a scene's). How many texts there are. */
int heightfile_warnings(const struct heightfile *h, const struct heightfile_names *names, struct arena *a,
                        const char *texts[HEIGHTFILE_WARNINGS]);

/* "5.2 um"; "unknown" of NAN. */
const char *heightfile_length_text(double x, struct arena *a);

/* Writing height maps. The file has its name only when it is complete (base/outfile.h). */
enum heightfile_format {
    HEIGHTFILE_GSF,      /* float32                                                         */
    HEIGHTFILE_GWY,      /* float64                                                         */
    HEIGHTFILE_SDF,      /* binary float64; at most 65535 samples a side                    */
    HEIGHTFILE_SDF_TEXT, /* as many digits as read back as the same double                  */
    HEIGHTFILE_NPY,      /* float64; does not hold the pitch; a profile is one-dimensional  */
    HEIGHTFILE_PNG,      /* 16-bit grey; holds neither pitch nor range for other programs   */
    HEIGHTFILE_CSV       /* the same; the pitch stands in a comment                         */
};

/* The format that a name's ending asks for (gsf, gwy, sdf, npy, png, csv; any case). ERR_USAGE: none of them. */
bool heightfile_write_format(const char *path, enum heightfile_format *format, struct err *e);

/* What became of the heights: z was written as its distance from `low`, in steps of `step` m (0: floating point). */
struct heightfile_written {
    double low, range, step;
};

/* h in metres, with its pitch; missing points (h->holes) are written as NaN, in SDF text as BAD, in GWY as a mask; PNG
   refuses them. Errors: ERR_CREATE, ERR_IO; ERR_SCENE what the format does not hold; ERR_NUMBERS a height that is
   infinite, or too large for it. */
bool heightfile_write(const char *path, const struct heightfile *h, enum heightfile_format format,
                      struct heightfile_written *w, struct err *e);

#endif
