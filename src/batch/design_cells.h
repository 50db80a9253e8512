/* The cells of a design: crossed or listed, without those that are excluded, and the recordings. */
#ifndef BATCH_DESIGN_CELLS_H
#define BATCH_DESIGN_CELLS_H
#include "batch/design_reading.h"

/* Fills r->cells. The factors have been read without error. */
void design_cells_make(struct design_reading *r);

#endif
