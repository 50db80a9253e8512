/* Remarks on a ball of model roll that lies outside of what its model is of. */
#ifndef FORCE_ROLL_TOLD_H
#define FORCE_ROLL_TOLD_H
#include "force/roll_stiffness.h"
#include "stage.h"

/* As it is opened. */
void roll_told(struct stage_run *r, const struct roll_stiffness *rests);

#endif
