/* Places in the plane, triangulated: the part of places.h that is not a line. */
#ifndef RESPONSE_PLACES_PLANE_H
#define RESPONSE_PLACES_PLANE_H
#include "base/arena.h"
#include "response/places.h"

struct places_plane;

/* xy [n][2] must stay. NULL: no triangulation. */
struct places_plane *places_plane_make(struct arena *a, int n, const double *xy);

/* As places_at, places_edges. */
double places_plane_at(const struct places_plane *p, double x, double y, struct places_mix *mix);
int places_plane_edges(const struct places_plane *p, const int (**edge)[2]);

#endif
