/* Parallel ridges or grooves. */
#ifndef SURFACE_RIDGES_H
#define SURFACE_RIDGES_H
#include "base/arena.h"
#include "num/noise.h"
#include "scene/scene.h"
#include "surface/relief.h"

/* The ridges of that recipe and noise stream, in the coordinates `along` (decided): on a line (path, x) they lie across
 * it, ridge 0 at 0. */
struct relief_part *ridges_part(struct arena *a, const struct ridges *recipe, int along, struct noise stream);

#endif
