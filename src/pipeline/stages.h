/* The table of all stages. */
#ifndef PIPELINE_STAGES_H
#define PIPELINE_STAGES_H
#include "stage.h"

#define STAGE(name) extern const struct stage name##_stage;
#define PARAMS(name) extern const struct params name##_params;
#include "pipeline/stages.def"
#undef STAGE

/* Ends with NULL. */
extern const struct stage *const stages_table[];

/* Does the scene want it? Predicted cycles per audio sample. */
bool stages_wanted(const struct stage *st, const struct contact *c, const struct scene *s);
double stages_work(const struct stage *st, const struct contact *c, const struct scene *s);

#endif
