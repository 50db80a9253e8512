/* What a round tip or a ball costs on a metre of ground that it has not been over, for predictions. */
#ifndef SURFACE_TIP_WORK_H
#define SURFACE_TIP_WORK_H
#include "scene/scene.h"

#define TIP_DIP 1e-3 /* of the span of heights: what the way of a tip without a patch may dip between two of them */

/* Cycles per metre, as far as the scene alone tells; `dense`: accuracy.tip_heights. */
double tip_work_metre(const struct contact *c, double dense);

#endif
