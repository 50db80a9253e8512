/* How often a surface is read, for the predicted work of its parts. */
#ifndef SURFACE_READING_H
#define SURFACE_READING_H
#include <math.h>

#include "scene/scene.h"

#define READING_MAP_PITCH 5e-6 /* m, of a map whose file says it */

/* m, the finest scale of roughness, as far as the scene tells: a quarter of its shortest wave. Roughness like a map has
 * the map's waves, and so its pitch. */
static inline double reading_roughness(const struct roughness *r)
{
    return !r->like ? r->shortest / 4 : isnan(r->like_pitch) ? READING_MAP_PITCH : r->like_pitch;
}

/* Points per audio sample: both ends and the middle of each sub-interval, and of each cell crossed at 0.2 m/s. */
static inline double reading_points(const struct scene *s, double finest)
{
    return 2 * (s->accuracy.oversampling + 0.2 / (s->output.sample_rate * finest));
}

#endif
