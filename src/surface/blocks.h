/* An endless, aperiodic random profile with a given spectrum, computed where it is read. */
#ifndef SURFACE_BLOCKS_H
#define SURFACE_BLOCKS_H
#include "base/arena.h"
#include "num/noise.h"
#include "surface/profile.h"
#include "surface/spectrum.h"

/* Gaussian profile of that spectrum and noise stream. Close it with its own close(). */
struct profile *blocks_make(struct arena *a, const struct spectrum *s, struct noise stream);

#endif
