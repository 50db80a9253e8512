/* An endless, aperiodic, C2 random field in the plane with a given spectrum, computed where it is read. */
#ifndef SURFACE_TILES_H
#define SURFACE_TILES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "num/noise.h"
#include "surface/relief.h"
#include "surface/spectrum.h"

/* Features are `ratio` times longer along `direction` (rad, 0 = +x) than across; ratio 1: isotropic. */
struct tiles_grain {
    double ratio, direction;
    bool once; /* it is read on a way that does not come back: made again where it does, for less memory */
};

/* A part whose traces across the grain (along any line if isotropic) have the spectrum. A density that no surface has
   (spectrum_beyond) is an error, ERR_SCENE; unless `lost` is given: then what is negative is left out, the rest scaled
   to the same rms, and *lost is the share of the power so moved. Gaussian, but for an excess kurtosis within 0.1. Close
   it with its own close(). */
struct relief_part *tiles_part(struct arena *a, const struct spectrum *s, const struct tiles_grain *g,
                               struct noise stream, double *lost, struct err *e);

#endif
