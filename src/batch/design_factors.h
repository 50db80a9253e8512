/* `base`, `set` and `factors` of a design. */
#ifndef BATCH_DESIGN_FACTORS_H
#define BATCH_DESIGN_FACTORS_H
#include "batch/design_reading.h"

/* Fills the design's base, set and factors, and the texts of all three. The rules of level and length have been read: they decide what may be set. */
void design_factors_read(struct design_reading *r);

#endif
