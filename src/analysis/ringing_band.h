/* A response in overlapping sub-bands. */
#ifndef ANALYSIS_RINGING_BAND_H
#define ANALYSIS_RINGING_BAND_H
#include <complex.h>

#include "analysis/ringing.h"

enum { RINGING_BAND_TAPS = 10 }; /* times the decimation */

struct ringing_band {
    int decimation;        /* D: a power of two */
    int bands;             /* D + 1, band c at c rate/(2 D) */
    int places;
    long n;                /* outputs of each, D samples apart */
    double complex *y;     /* [bands][places][n]; an exponential z^k of the response gives z^(D n), exactly */
};

/* Of the first `length` samples of x[places][n]. */
void ringing_band_make(const double *const *x, int places, long length, int decimation, struct arena *a, struct ringing_band *b);

/* The pole of the response (decay 1/s, omega rad/s) whose z^D is zeta in band c; false: it lies outside the band's half, which is widened by `margin` of itself. */
bool ringing_band_pole(const struct ringing_band *b, int c, double rate, double complex zeta, double margin, double pole[2]);

#endif
