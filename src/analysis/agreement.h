/* How long one sound follows another. */
#ifndef ANALYSIS_AGREEMENT_H
#define ANALYSIS_AGREEMENT_H
#include "file/wav.h"

#define AGREEMENT_WINDOW 10e-3 /* s */

/* Frames for which b follows a, the reference: up to the first window of 10 ms in which the difference's energy is a
   quarter of the sound's or more, and in all that comes from there on as well; all that both have when there is none.
   Same rate and number of channels. */
size_t agreement(const struct wav *a, const struct wav *b);

#endif
