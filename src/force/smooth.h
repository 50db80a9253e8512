/* What others ask of the smoothing. */
#ifndef FORCE_SMOOTH_H
#define FORCE_SMOOTH_H
#include "scene/scene.h"

/* s, sigma of a smoothing of the force whose width is constant; 0: there is none, or it varies. */
double smooth_still(const struct contact *c);

#endif
