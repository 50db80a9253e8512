/* Levels of a recording in short frames. */
#ifndef ANALYSIS_STRIKES_LEVEL_H
#define ANALYSIS_STRIKES_LEVEL_H
#include "base/arena.h"

struct strikes_level {
    long frame, n; /* samples of a frame, frames */
    double *rms;   /* [n] about the frame's own mean */
    double floor;  /* the level that a fiftieth of them stay below */
};

/* Frames of `seconds`; at least one sample each. */
struct strikes_level strikes_level(const double *x, long n, double rate, double seconds, struct arena *a);

/* The longest run of frames no louder than `most`: samples [*from, *to); equal: there is none. */
void strikes_level_quiet(const struct strikes_level *l, double most, long *from, long *to);

#endif
