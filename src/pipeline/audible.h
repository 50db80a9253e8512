/* What of a contact's force is heard: the power of its sound over that of the force, by frequency. */
#ifndef PIPELINE_AUDIBLE_H
#define PIPELINE_AUDIBLE_H
#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"

enum { AUDIBLE_BINS = 513 }; /* from 0 to half the sample rate */

/* power[AUDIBLE_BINS] of the contact's sound at a place (m) that is touched and left: its response to a unit impulse,
   all listening places together, of the first AUDIBLE_FRAMES frames (what rings longer is counted less than it rings:
   all of it, by the same bands). Where nothing rings, and of a contact whose gain is 0, it is 1: the force itself.
   Errors: those of plans and stages. */
enum { AUDIBLE_FRAMES = 16384 };
bool audible_power(const struct scene *s, const struct contact *c, const double place[2], double *power, struct err *e);

#endif
