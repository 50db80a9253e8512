/* The plans of a whole scene, as a render would have them. */
#ifndef PIPELINE_PLAN_SCENE_H
#define PIPELINE_PLAN_SCENE_H
#include "pipeline/plan.h"

/* The plans of all contacts, [s->n_contacts], after all that a render does before its first sample: every file is there (pipeline/inputs.h), every stage can
   begin. ERR_INPUT, ERR_SCENE and what stages give; NULL then. Nothing is written. */
const struct plan *plan_scene(const struct scene *s, struct arena *a, struct err *e);

#endif
