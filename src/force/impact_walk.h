/* A place on the disk of actions over time: one that stays, one that moves evenly to another, or the rows of a CSV. */
#ifndef FORCE_IMPACT_WALK_H
#define FORCE_IMPACT_WALK_H
#include "force/impact_law.h"

/* l->walk and l->steps of contact.impacts.space. `duration`: s, of the motion. ERR_INPUT, ERR_SCENE with file and line:
   see series_read; radius not in
   [-1, 1]. */
bool impact_walk_make(const struct contact *c, double duration, struct arena *a, struct impact_law *l, struct err *e);

/* Angle (rad) and radius at t in s: straight between the rows, before the first and after the last as there. */
void impact_walk_at(const struct impact_law *l, double t, double *angle, double *radius);

#endif
