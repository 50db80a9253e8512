/* The way of a round tip over a surface: the upper envelope of a ball (surface/envelope.h; in one coordinate
   rolling_envelope.h), smoothed over the contact patch, as a part of a relief that reads the surface when and where it
   is read itself. */
#ifndef SURFACE_CONTACT_PATCH_H
#define SURFACE_CONTACT_PATCH_H
#include "surface/rolling_envelope.h"

enum { PATCH_POINTS = 4 }; /* lattice points in a standard deviation */

/* The part. `under` is read as it is then, and must live as long. */
struct relief_part *contact_patch_part(struct arena *a, const struct relief *under, const struct rolling_plan *p);

/* The side of the square of heights that are held at a time for a piece of the envelope in the plane. */
long contact_patch_side(const struct rolling_plan *p);

#endif
