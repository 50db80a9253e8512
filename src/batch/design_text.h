/* The texts of trials, what a listener reads (design_text of design.h). */
#ifndef BATCH_DESIGN_TEXT_H
#define BATCH_DESIGN_TEXT_H
#include "batch/design_reading.h"

/* Reads the design's `text` and tells what is wrong with it; the factors are known. */
void design_text_read(const struct design_reading *r);

#endif
