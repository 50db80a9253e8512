/* What others ask of the smoothing. */
#ifndef FORCE_SMOOTH_H
#define FORCE_SMOOTH_H
#include <stdbool.h>

#include "num/filter.h"
#include "scene/scene.h"
#include "stage.h"

/* s, sigma of a smoothing of the force, at its widest; 0: there is none. */
double smooth_sigma(const struct contact *c, bool *varies);

/* Items from which the width of a smoothing of the force follows. */
unsigned smooth_joined_asks(const struct contact *c, const struct scene *s);

/* A smoothing of varying width, and a filter of constant width behind it (NULL: none), at every `each`-th sub-sample,
   at most so many at a time. Returns how many sub-samples away from its place an output is reached from. */
struct smooth;
int smooth_join(struct smooth *s, const struct filter *then, int each, long outputs, struct arena *a);

/* y: the next so many outputs, those before frame `to`. */
void smooth_spread(struct smooth *s, const struct board *b, long to, long outputs, double *y);

#endif
