/* The prototypes: rubbing, scratching, rolling (papers/004, papers/002), and what a scene states itself. */
#ifndef FORCE_IMPACT_ANCHORS_H
#define FORCE_IMPACT_ANCHORS_H
#include "force/impact_law.h"

/* Fills l->alone, and l->density and l->anchor of those anchors that contact.impacts.prototype needs; least_amplitude,
   shortest and unit_force are left to impact_law.c. ERR_SCENE: `custom` without a value that it needs; errors of
   tables. */
bool impact_anchors_make(const struct contact *c, struct arena *a, struct impact_law *l, struct err *e);

#endif
