/* Factors that are not heard: stimuli that differ in one and have the same samples. A key that does nothing in a scene is often meant to do something. So are replicates of scenes
   in which nothing is random. */
#ifndef BATCH_UNHEARD_H
#define BATCH_UNHEARD_H
#include "batch/manifest.h"

/* One sentence that names the factors, or says replicates, and two of the stimuli; "": there are none. Recordings, and what makes no sound, do not count. ERR_IO: a record cannot be read again */
bool unheard_find(const struct results *all, struct arena *a, const char **text, struct err *e);

#endif
