/* What the program is called in manifests. */
#ifndef CMD_BATCH_BUILD_H
#define CMD_BATCH_BUILD_H
#include "base/arena.h"
#include "base/err.h"

/* "rasp 0.1.0 f650ae05d2ab", or, when that does not say which source it was made from (changes that are not committed, no git), with the program's own hash behind it,
   so that results of two builds are never taken for each other's. ERR_INPUT */
const char *batch_build(struct arena *a, struct err *e);

#endif
