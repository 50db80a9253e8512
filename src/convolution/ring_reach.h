/* Does the motion stay on the surface's object? */
#ifndef CONVOLUTION_RING_REACH_H
#define CONVOLUTION_RING_REACH_H
#include "response/modes.h"
#include "stage.h"

/* Of a surface whose modes are m. ERR_SCENE, which names key and place: the motion leaves the hull of its places, and surface.extrapolate is error. */
bool ring_reach(const struct modes *m, const struct stage_run *r, struct err *e);

#endif
