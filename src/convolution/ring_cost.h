/* What an engine will cost, in cycles for each sample of the sound: all that it does, from the search for its hops to the last sample, over their number. */
#ifndef CONVOLUTION_RING_COST_H
#define CONVOLUTION_RING_COST_H
#include "convolution/ring_means.h"

/* c->to->ramp is known. */
double ring_cost_resonators(const struct ring_choosing *c);

/* c->to->hops are known. */
double ring_cost_launch(const struct ring_choosing *c);
double ring_cost_recall(const struct ring_choosing *c);

/* One hop for all, in frames; by overlap-add, or read at the present place. */
double ring_cost_overlap(const struct ring_choosing *c, double hop);

/* A response of modes that does not move; c->to->nodes.n of them. */
double ring_cost_still(const struct ring_choosing *c);
double ring_cost_nodes(const struct ring_choosing *c);

/* Convolution with that many samples as they are, read from a file. */
double ring_cost_recorded(double samples);

/* Of what listens, made once. */
double ring_cost_listening(const struct ring_choosing *c);

/* Of looking along the motion for hops, as far as that has been done. */
double ring_cost_search(const struct ring_choosing *c);

#endif
