/* Means of a force weighted by a hat about each sub-interval's start: linear B-splines, so that what lies beyond the
   sub-rate folds in with sinc^2.

     F_j = 1/dt integral of f(t) max(0, 1 - |t - t_j| / dt) dt = early_j + late_(j-1)          t_j = j dt

     early_i, late_i   N: over sub-interval i, (1/dt) integral of (1 - q) f dt and of q f dt, q = (t - t_i) / dt, from 0
   to 1

   The hats add up to 1: what each sub-interval gives is early + late, its plain mean, so that momentum is kept. */
#ifndef FORCE_HATS_H
#define FORCE_HATS_H
#include "force/way.h"

struct hats {
    double early[WAY_CHUNK], late[WAY_CHUNK];
    double carried; /* late part of the last sub-interval before the chunk */
};

/* Writes ITEM_SUBFORCE from number `first` on, of n sub-intervals, which must come in order. Where the contact is
   lifted off (force/lift.h: to the instant) there is no force; the time is counted on the board. */
void hats_lay(struct hats *h, struct board *b, long first, int n);

/* The same, added to what is there and counted already. */
void hats_add(struct hats *h, struct board *b, long first, int n);

#endif
