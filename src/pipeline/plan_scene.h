/* The plans of a whole scene, as a render would have them. */
#ifndef PIPELINE_PLAN_SCENE_H
#define PIPELINE_PLAN_SCENE_H
#include "pipeline/plan.h"
#include "pipeline/render_parts.h"

/* The plans of all contacts, [s->n_contacts], after all that a render does before its first sample: every file is there
   (pipeline/inputs.h), every stage can begin; with what it warns of by then, which ends with NULL. ERR_INPUT, ERR_SCENE
   and what stages give; NULL then. Nothing is written. */
const struct plan *plan_scene(const struct scene *s, struct arena *a, const char ***warnings, struct err *e);

struct plan_scene_estimate {
    struct render_length length;
    double cycles;         /* predicted, of the whole render: of one core with 256-bit vectors */
    bool sounds;           /* there is a WAV */
    int quantity;          /* of the sound, enum modes_quantity; -1: not stated */
    const char **warnings; /* what the render warns of before its first sample; ends with NULL */
};

/* How long the render will be and what it will cost; as plan_scene otherwise, but a sound that is too short for its
 * level is none of its errors. */
bool plan_scene_estimate(const struct scene *s, struct arena *a, struct plan_scene_estimate *x, struct err *e);

/* The knobs of scene/accuracy.def that some contact's plan depends on: as the scene stands, or in one of the presets
   (which may choose other engines; one that cannot be planned counts for nothing). Responses are read, stages are not
   opened. ERR_SCENE and what reading gives: of the scene as it stands. */
bool plan_scene_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e);

#endif
