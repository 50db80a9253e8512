/* Linear-phase kernels: decimators of sub-interval means, and Gaussians. */
#ifndef NUM_FILTER_H
#define NUM_FILTER_H
#include "base/arena.h"

/* A symmetric kernel of `taps`, tap[j + reach], j from -reach on. 2 reach + 1 of them, tap[reach + j] = tap[reach - j];
   filter_decimator: 2 reach, tap[reach + j] = tap[reach - 1 - j]. */
struct filter {
    int reach, taps;
    double *tap;
};

/* Decimator from means over intervals of T = 1/(over fs) to samples at fs, over >= 1. The mean with index i is that
   over [i, i+1) T; output n is the signal at t = n/fs, which is the boundary between intervals over n - 1 and over n:

       output[n] = sum over j = -reach..reach-1 of tap[j + reach] mean[over n + j].

   From the continuous signal to the output (the droop of the means, sin(pi f T)/(pi f T), included) the gain is 1
   within 2e-6 up to 0.4535 fs, at most 1e-6 (-120 dB) from 0.5465 fs to over fs/2, and 1 to rounding at 0; the phase is
   0. Content beyond over fs/2 has been aliased by taking means and cannot be stopped here. For over = 1 the stop band
   lies beyond fs/2 and the kernel interpolates half a sample; its gain falls to 0 at fs/2. */
struct filter filter_decimator(struct arena *a, int over);

/* The same of means weighted by a hat about each i T, 1 - |t/T - i|, whose droop is the square of that:

       output[n] = sum over j = -reach..reach of tap[j + reach] hat[over n + j],

   with the same gains, content beyond over fs/2 apart. For over = 1 only the droop is undone: there is no low-pass, and
   up to fs/2 the gain is 1 within 0.05. */
struct filter filter_decimator_bspline(struct arena *a, int over);

/* Sampled, normalised Gaussian (sum 1 to rounding) of standard deviation sigma >= 0 samples, cut at 6.5 sigma; sigma =
   0 gives the unit impulse. The sampled Gaussian's own deviation is sigma within 1e-6 for sigma >= 1; for smaller ones
   it is less. */
struct filter filter_gaussian(struct arena *a, double sigma);

/* One kernel for x first through b, then through c, both of sum 1: ends that add up to at most `left` (absolute values)
   are cut off, as many taps on both sides, and the rest has sum 1 again. */
struct filter filter_joined(struct arena *a, const struct filter *b, const struct filter *c, double left);

#endif
