/* Filling missing points from their surroundings. */
#ifndef FILE_HEIGHTFILE_FILL_H
#define FILE_HEIGHTFILE_FILL_H
#include "file/heightfile.h"

/* Replaces h->holes missing points (NaN) by the solution of Laplace's equation with the heights around them, and sets
   h->filled, h->holes. The surface there is as smooth as it can be: it has no roughness of its own. Points at the map's
   edge have no neighbour beyond it (slope 0 across the edge); of a profile this is the straight line between the ends
   of a gap, and level behind the last height. Residual below 1e-12 of the map's range. Nothing happens without holes.
   ERR_SCENE: more than half of the map is missing. ERR_NUMBERS: no convergence. */
bool heightfile_fill(const char *path, struct heightfile *h, struct err *e);

#endif
