/* Remarks on a ball of model roll that lies outside of what its model is of. */
#ifndef FORCE_ROLL_TOLD_H
#define FORCE_ROLL_TOLD_H
#include "force/roll_rehearsal.h"
#include "stage.h"

/* As it is opened, when the rehearsal is done. */
void roll_told(struct stage_run *r, const struct roll_rehearsal *found);

#endif
