/* No contact, no force: clears the means of ITEM_SUBFORCE over those of the n sub-intervals from number `first` on whose mean normal force is
   negative, and counts their time on the board. */
#ifndef FORCE_LIFT_H
#define FORCE_LIFT_H
#include "stage.h"

void lift_off(struct board *b, long first, int n);

#endif
