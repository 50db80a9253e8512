/* Where a force comes so early that the ramp at the scene's start (output.ramp) fades it in. */
#ifndef FORCE_ONSET_H
#define FORCE_ONSET_H
#include "stage.h"

/* Warns when `at` (s after the contact's start), at which `what` comes, lies within the ramp. */
void onset_told(struct stage_run *r, const char *what, double at);

/* Index of the largest magnitude; n >= 1. */
size_t onset_largest(size_t n, const double *x);

#endif
