/* What sampling folds into a voice's sound is taken out again (alias.h), in the same way for every engine. See
   ring_alias.c. */
#ifndef CONVOLUTION_RING_ALIAS_H
#define CONVOLUTION_RING_ALIAS_H
#include "convolution/ring.h"

struct ring_alias;

/* For a voice whose poles and listener are there. */
struct ring_alias *ring_alias_make(const struct ring *g, const struct ring_voice *v, struct arena *a);

/* Adds to y, of frames [from, to), each call's next to those of the one before. Reads the force ALIAS_REACH frames
   ahead (and, of readout, back). */
void ring_alias_add(struct ring_alias *s, const struct ring *g, const struct ring_voice *v, double *y, long from,
                    long to);

#endif
