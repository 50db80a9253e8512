/* What the manifest calls a factor, in what unit its values stand there. */
#ifndef BATCH_DESIGN_COLUMNS_H
#define BATCH_DESIGN_COLUMNS_H
#include "batch/design_reading.h"

/* Fills column, unit and meaning of every factor and the values of its levels; tells names that clash. A factor whose labels are all quantities of one
   dimension has numbers: in the unit that they are written with where it is the same for all, else in SI. */
void design_columns_make(struct design_reading *r);

#endif
