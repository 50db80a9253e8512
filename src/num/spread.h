/* A Gaussian whose width is each element's own, and a filter of constant width behind it, in one. */
#ifndef NUM_SPREAD_H
#define NUM_SPREAD_H
#include <stdbool.h>

#include "num/filter.h"

/* Output n is the sum over elements i, from 0 on, of x[i] g(each n - i; v[i]), where g is the Gaussian of variance v
   (elements^2), as num/filter.h has it, through the filter `then` (NULL: none). What would be spread to before output 0
   is reflected half an output before it: as heat is at an insulated end, and the sum stays what it is. */
struct spread;

/* For variances up to `widest` (still: for that one alone), and at most so many outputs at a time. */
struct spread *spread_open(struct arena *a, double widest, bool still, const struct filter *then, int each,
                           long outputs);
void spread_close(struct spread *s);

/* How many elements away from its place an output is reached from, at most. */
int spread_reach(double widest, const struct filter *then, int each);

/* The next n elements. */
void spread_add(struct spread *s, const double *x, const double *v, long n);

/* The next n outputs, before which each n + reach elements from the first of them on must have been added, no more. */
void spread_take(struct spread *s, double *y, long n);

/* Begins anew: the next element and the next output are the first. */
void spread_restart(struct spread *s);

#endif
