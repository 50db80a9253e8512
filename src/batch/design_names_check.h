/* Names that cannot be: of files beside each other in one folder. */
#ifndef BATCH_DESIGN_NAMES_CHECK_H
#define BATCH_DESIGN_NAMES_CHECK_H
#include "batch/design_reading.h"

/* Tells names that climb out of the folder, hide, or are too long, and two stimuli whose files would be the same. */
void design_names_check(const struct design_reading *r);

#endif
