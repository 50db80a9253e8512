/* No contact, no force: where the hand lifts the scraper, or a ball is clear of the surface. */
#ifndef FORCE_LIFT_H
#define FORCE_LIFT_H
#include "stage.h"

/* Is the mean normal force over sub-interval number k negative? */
bool lift_off(const struct board *b, long k);

/* N, ITEM_LOAD from number `first` on: lifted off over sub-interval first + i where [i] + [i + 1] is negative; NULL: it never is. */
const double *lift_load(const struct board *b, long first);

/* Counts on the board the time of those of the n sub-intervals from number `first` on over which it is. */
void lift_count(struct board *b, long first, int n);

#endif
