#include "pipeline/stages.h"

const struct stage *const stages_table[] = {
#define STAGE(name) &name##_stage,
#include "pipeline/stages.def"
#undef STAGE
    NULL,
};
