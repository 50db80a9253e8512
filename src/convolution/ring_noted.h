/* What was chosen for a scene, for others that are equal as far as the choice goes (the replicates of a design's cell, which differ in their noise; cells of other heights or loads): between the scenes that share
   a shelf. */
#ifndef CONVOLUTION_RING_NOTED_H
#define CONVOLUTION_RING_NOTED_H
#include "convolution/ring_choice.h"

/* The key of a contact's choice in the arena: a sha256 as text, of the effective scene with its inputs' hashes, but without what no choice depends on: title, level, heights,
   load, the scraper's mass and the like; the seed only where a motion is drawn by it. NULL: the scene shares nothing. */
const char *ring_noted_key(const struct scene *s, const struct contact *c, struct arena *a);

/* Into *to, which has its modes: all that ring_means_choose sets. False: not known. */
bool ring_noted_find(struct shelf *s, const char *key, struct arena *a, struct ring_choice *to);
void ring_noted_add(struct shelf *s, const char *key, const struct ring_choice *choice);

#endif
