/* How often a surface is read, for the predicted work of its parts. */
#ifndef SURFACE_READING_H
#define SURFACE_READING_H
#include "scene/scene.h"

/* Points per audio sample: both ends and the middle of each sub-interval, and of each cell crossed at 0.2 m/s. */
static inline double reading_points(const struct scene *s, double finest)
{
    return 2 * (s->accuracy.oversampling + 0.2 / (s->output.sample_rate * finest));
}

#endif
