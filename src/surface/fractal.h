/* The fractal profile of the papers on rolling: heights on an even pitch, drawn from a power law, that repeat
 * themselves. */
#ifndef SURFACE_FRACTAL_H
#define SURFACE_FRACTAL_H
#include <stddef.h>

#include "base/err.h"
#include "num/noise.h"
#include "scene/scene.h"
#include "surface/relief.h"

/* The heights of one period, m: z[rules_fractal_size(f)]. */
void fractal_heights(const struct fractal *f, struct noise stream, double *z);

/* The profile as a part of a relief of one coordinate, height number 0 lies at x = 0. ERR_SCENE: too few or too many
 * heights. */
struct relief_part *fractal_part(struct arena *a, const struct fractal *f, struct noise stream, struct err *e);

#endif
