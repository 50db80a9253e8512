/* Spectrogram of a sound: how strong each frequency is at each time, in dB relative to a full-scale sine. */
#ifndef OUTPUT_SPECTROGRAM_H
#define OUTPUT_SPECTROGRAM_H
#include <stddef.h>

#include "base/arena.h"

struct spectrogram_of {
    const double *x; /* samples, full scale 1; zero before the first and behind the last */
    size_t frames;
    double rate;     /* Hz                                                               */
    double from, to; /* s, the time that the columns share evenly                        */
    int columns;
};

struct spectrogram {
    int columns, bins; /* bins = window/2 + 1, from 0 Hz to rate/2                    */
    size_t window;     /* samples in a window                                         */
    double bin_hz;     /* rate / window                                               */
    double *db;        /* [bins][columns]; -HUGE_VAL where there is nothing           */
};

void spectrogram_make(const struct spectrogram_of *of, struct arena *a, struct spectrogram *g);

#endif
