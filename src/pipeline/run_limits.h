/* Until when each stage of a run need work. */
#ifndef PIPELINE_RUN_LIMITS_H
#define PIPELINE_RUN_LIMITS_H
#include "pipeline/run.h"

/* Sets the `limit` of all stages, which are open and have their leads (run_offsets): the frame from which what a stage
   gives is zero, or is read by nobody. The runner makes zeros of it there. LONG_MAX: none is known. */
void run_limits(struct run *r);

#endif
