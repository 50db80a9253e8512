/* Names of stimuli from the template. */
#ifndef BATCH_DESIGN_NAMES_H
#define BATCH_DESIGN_NAMES_H
#include "batch/design_reading.h"

/* Reads the template into r->template; the factors are known. */
void design_names_template(struct design_reading *r);

/* Fills the name of every stimulus; r->cells[cell] is its cell. Tells names that cannot be or clash. */
void design_names_make(struct design_reading *r);

#endif
