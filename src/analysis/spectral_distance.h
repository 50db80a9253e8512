/* How far two sounds differ, as an ear or a spectrogram sees it. */
#ifndef ANALYSIS_SPECTRAL_DISTANCE_H
#define ANALYSIS_SPECTRAL_DISTANCE_H
#include "file/wav.h"

struct spectral_distance {
    double third_octave_mean, third_octave_worst; /* dB, |difference of levels| over the third octaves that lie in the
                                                     band and within 40 dB of the loudest */
    double worst_at;                              /* Hz */
    int bands;
    double log_spectral; /* dB rms over times and frequencies, see spectral_distance.c */
};

struct spectral_distance_band {
    double rate, low, high; /* Hz */
    double floor; /* power per bin (of a Hann window of 2048 samples, sum of squares 1) of the noise: neither counts
                     below; 0: none */
};

/* a is the reference, [n] samples each. */
struct spectral_distance spectral_distance(const double *a, const double *b, long n,
                                           const struct spectral_distance_band *in);

/* The log-spectral distance of two sounds, dB: the mean of the distances with windows of about 5, 20 and 80 ms; 0:
   equal, or the reference is silent. a is the reference; both have the same rate and number of channels, and what both
   have in time is compared. */
double spectral_distance_sounds(const struct wav *a, const struct wav *b);

#endif
