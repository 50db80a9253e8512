/* Procedural roughness: an endless Gaussian profile with a power-law spectrum, computed where it is read. */
#ifndef SURFACE_ROUGHNESS_H
#define SURFACE_ROUGHNESS_H
#include "base/arena.h"
#include "num/noise.h"
#include "scene/scene.h"
#include "surface/profile.h"

/* Profile of that recipe and noise stream. Close it with its own close(). */
struct profile *roughness_make(struct arena *a, const struct roughness *recipe, struct noise stream);

/* One-sided power spectral density (m^2 per cycle/m) that the profile has at k cycles/m, in the ensemble mean. */
double roughness_density(const struct roughness *recipe, double k);

#endif
