/* Delaunay's triangulation of points in the plane. */
#ifndef RESPONSE_PLACES_DELAUNAY_H
#define RESPONSE_PLACES_DELAUNAY_H
#include "base/arena.h"

/* The corners [returned number][3] of the triangles of the points xy [n][2] (m, n >= 3, different, not on one line),
   anticlockwise; slivers along the hull, within 1e-9 m of a line, are left out. 0: no triangulation. See
   places_delaunay.c. */
int places_delaunay(struct arena *a, int n, const double *xy, const int (**corner)[3]);

#endif
