/* What a recording's channels tell of themselves: offset, clipping, rounding. */
#ifndef ANALYSIS_STRIKES_CHANNEL_H
#define ANALYSIS_STRIKES_CHANNEL_H
#include "analysis/strikes.h"

/* Takes a considerable offset off both channels (copies of them) and finds where they clip; returns lines that say so,
 * or NULL. */
const char *strikes_channel_prepare(struct strikes_recording *r, struct arena *a);

/* Levels at which x[n] clips, below and above; 0: it does not. */
void strikes_channel_clip(const double *x, long n, double clip[2]);

#endif
