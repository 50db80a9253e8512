/* The table of all stages. */
#ifndef PIPELINE_STAGES_H
#define PIPELINE_STAGES_H
#include "stage.h"

#define STAGE(name) extern const struct stage name##_stage;
#include "pipeline/stages.def"
#undef STAGE

/* Ends with NULL. */
extern const struct stage *const stages_table[];

/* Does the scene want it? */
bool stages_wanted(const struct stage *st, const struct contact *c, const struct scene *s);

#endif
