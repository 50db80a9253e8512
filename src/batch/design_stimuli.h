/* Stimuli from cells: replicates, noise seeds, the order of presentation; and the hash of what a design means. */
#ifndef BATCH_DESIGN_STIMULI_H
#define BATCH_DESIGN_STIMULI_H
#include "batch/design_reading.h"

/* Fills stimuli but for their names. */
void design_stimuli_make(struct design_reading *r);

/* Fills sha256, when all else is there. */
void design_stimuli_hash(struct design_reading *r);

#endif
