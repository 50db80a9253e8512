/* The rules of a design that hold for the whole set. */
#ifndef BATCH_DESIGN_RULES_H
#define BATCH_DESIGN_RULES_H
#include "batch/design_reading.h"

/* Version, title, seed, replicates, order, level, length. */
void design_rules_read(struct design_reading *r);

/* `independent`, when the factors are known. */
void design_rules_independent(struct design_reading *r);

#endif
