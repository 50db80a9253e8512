/* Roughness finer than a measured map holds. */
#ifndef SURFACE_CONTINUATION_H
#define SURFACE_CONTINUATION_H
#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "surface/height_map.h"
#include "surface/spectrum.h"

struct continuation { /* section surface.continuation */
    bool given;
    double exponent; /* of its spectrum; NAN: that of the map's own last octaves               */
    double from;     /* m, wavelength where it takes over; NAN: the map's band limit, measured */
    double shortest; /* m                                                                      */
};

/* The continuation's spectrum under a map. ERR_SCENE: nothing to continue, or nothing to tell it from. */
bool continuation_spectrum(struct arena *a, const struct continuation *c, const struct height_map *map,
                           struct spectrum *s, struct err *e);

#endif
