/* Writing height maps. The file has its name only when it is complete (base/outfile.h). */
#ifndef FILE_HEIGHTFILE_WRITE_H
#define FILE_HEIGHTFILE_WRITE_H
#include "file/heightfile.h"

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
