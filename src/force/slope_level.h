/* The level of a limited trajectory (force/slope.c). */
#ifndef FORCE_SLOPE_LEVEL_H
#define FORCE_SLOPE_LEVEL_H
#include "force/slope.h"

/* 1/m: what of T goes with flat[], aside[] over all that was gone so far: S less the lifts times these has no level. all: else with the first two only. */
void slope_level(const struct slope *s, bool all, double level[SLOPE_LEVELS]);

#endif
