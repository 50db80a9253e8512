/* No contact, no force: where the hand lifts the scraper, or a ball is clear of the surface. */
#ifndef FORCE_LIFT_H
#define FORCE_LIFT_H
#include "stage.h"

/* N, ITEM_LOAD from number `first` on: lifted off where it is negative; NULL: it never is. */
const double *lift_load(const struct board *b, long first);

/* The share of a sub-interval over which it presses, of a normal force (N) that goes in a straight line from a to b. */
double lift_pressed(double a, double b);

/* Of a force's parts over that sub-interval (force/hats.h) makes those of what of it falls into that share. The rest is
   cut off, and the force is taken as the straight line that has both parts. */
void lift_cut(double a, double b, double *early, double *late);

/* Counts on the board the time of the n sub-intervals from number `first` on over which it is negative. */
void lift_count(struct board *b, long first, int n);

#endif
