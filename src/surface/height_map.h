/* The measured map under a contact, and a map as a tensor-product cubic spline:
     z(x, y) = sum_ij c_ij B((x - origin_x)/pitch_x - i) B((y - origin_y)/pitch_y - j) */
#ifndef SURFACE_HEIGHT_MAP_H
#define SURFACE_HEIGHT_MAP_H
#include <stddef.h>

#include "base/arena.h"
#include "file/heightfile.h"
#include "surface/profile.h"
#include "surface/relief.h"

struct height_map {
    const double *z; /* m, [rows][columns]; rows = 1: a profile */
    size_t columns, rows;
    double pitch[2]; /* m along x (or the path) and y */
};

struct height_map_file {            /* keys surface.height_map, pitch, ... */
    const char *path;               /* NPY, GSF, SDF, GWY, 16-bit PNG or CSV; NULL: none */
    struct heightfile_options read; /* names: NULL */
    int off_map;                    /* enum off_map */
};

/* m between the samples of a contact's map, as far as the scene tells, or of a usual one. */
double height_map_pitch(const struct contact *c);

struct height_map_spline {
    long columns, rows;
    double pitch[2];
    int off_map;
    double base, *c; /* m; coefficients above base, so that a flat map is flat to the bit */
};

/* The spline through the heights (at least 4 x 4), continued beyond its edges by the rule (enum off_map; error
 * continues as mirror does). */
struct height_map_spline *height_map_spline(struct arena *a, const struct height_map *m, int off_map);

/* It as a part of a relief, and any number of reliefs: column i lies at x = origin[0] + i pitch[0], row j at y =
 * origin[1] + j pitch[1]. */
struct relief_part *height_map_part(struct arena *a, const struct height_map_spline *m, const double origin[2],
                                    const char *name);

#endif
