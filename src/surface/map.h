/* A height map as a tensor-product cubic spline:
     z(x, y) = sum_ij c_ij B((x - origin_x)/pitch_x - i) B((y - origin_y)/pitch_y - j) */
#ifndef SURFACE_MAP_H
#define SURFACE_MAP_H
#include <stddef.h>

#include "base/arena.h"
#include "surface/relief.h"

/* The spline through z[rows][columns] (m; at least 4 x 4), continued beyond its edges by the rule (enum off_map; error continues as mirror
   does). Column i lies at x = origin[0] + i pitch[0], row j at y = origin[1] + j pitch[1]. */
struct relief_part *map_part(struct arena *a, const double *z, size_t columns, size_t rows, const double pitch[2], const double origin[2],
                             int off_map, const char *name);

#endif
