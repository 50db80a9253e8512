/* The upper envelope E of a ball over a surface (surface/envelope.h; in one coordinate crest.h) at the points of a
 * lattice, patch / 4 apart. */
#ifndef SURFACE_CRESTS_H
#define SURFACE_CRESTS_H
#include "surface/grid.h"
#include "surface/rolling.h"

/* `under` is read as it is then, when and where it is needed, and must live as long. */
struct grid crests_make(struct arena *a, const struct relief *under, const struct rolling_plan *p);

/* The side of the square of heights that are held at a time for a piece of the envelope in the plane. */
long crests_side(const struct rolling_plan *p);

/* The envelope that is read in one coordinate. */
struct crest_plan crests_line(const struct rolling_plan *p);

#endif
