/* How a contact begins: the ramp at the scene's start (output.ramp) fades in what comes as early. */
#ifndef FORCE_APPROACH_H
#define FORCE_APPROACH_H
#include "stage.h"

/* Warns when `at` (s after the contact's start), at which `what` comes, lies within the ramp. */
void approach_warn(struct stage_run *r, const char *what, double at);

#endif
