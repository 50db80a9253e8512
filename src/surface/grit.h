/* Scattered grains, as of sandpaper. */
#ifndef SURFACE_GRIT_H
#define SURFACE_GRIT_H
#include "base/arena.h"
#include "base/err.h"
#include "num/noise.h"
#include "scene/scene.h"
#include "surface/relief.h"

struct grit { /* section surface.grit */
    bool given;
    double density;          /* grains per m^2                                                    */
    double diameter, height; /* m, of the mean grain                                              */
    double spread;           /* standard deviation of a grain's size over its mean (log-normal)   */
};

/* The grains of that recipe and noise stream; read without y (along a path or x) it is their trace along y = 0. NULL:
   ERR_SCENE, for so many grains over each other that reading a place would take thousands. */
struct relief_part *grit_part(struct arena *a, const struct grit *recipe, struct noise stream, struct err *e);

/* Mean and mean square of the heights (m, m^2), by Campbell's theorem. */
void grit_moments(const struct grit *recipe, double *mean, double *square);

#endif
