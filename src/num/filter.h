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

/* Gaussian of standard deviation sigma >= 0 samples, sum 1 to rounding; sigma = 0 gives the unit impulse. From
   FILTER_NARROW on it is sampled, and cut at 6.5 sigma. A narrower one would lose its width by that: it has 9 taps,
   whose spectrum is off by less than 1e-5 up to 1/6 of the rate, 6e-3 up to 1/3. */
#define FILTER_NARROW 0.8
struct filter filter_gaussian(struct arena *a, double sigma);
int filter_gaussian_reach(double sigma);

/* One kernel for x first through b, then through c, both of sum 1: ends that add up to at most 1e-7 (absolute values)
   are cut off, as many taps on both sides, and the rest has sum 1 again. */
struct filter filter_joined(struct arena *a, const struct filter *b, const struct filter *c);

/* What a linear-phase filter makes of a signal before that signal begins: its lead, of y[n] the part at n < 0.

   There is no sample for it, since nothing sounds before its cause: not at the file's start, nor at a contact's. Cut
   off, it takes momentum along, or leaves too much: of an impulse within the first sample, whose lead is (-1)^n/n or
   so, up to 15 %. So it is folded into the first samples:

     y[m - 1] += y[-m],   m >= 1           reflected half a sample before the start: the sum stays what it is, exactly
     y[0..b) += d/b^2,   y[b..2b) -= d/b^2,   d = sum (2 m - 1) y[-m]

   The reflection comes later by d, which the second line takes back, over a time b as short as the filter lets through.

   Momentum (the sum) and time of arrival (the first moment) are then those of the whole filter's output.

   Why reflected: a lead alternates from sample to sample, and half a sample beside its mirror image it takes the most
   of itself away. Largest error of the spectrum, relative to that of an impulse within the first three samples, four
   sub-intervals a sample (the true kernel of filter_decimator), at 0.001, 0.01, 0.1, 0.2, 0.3 of the rate:

     cut off                               -17  -17  -17  -16  -14 dB, that is 1.2 dB of level
     added to y[0]                         -64  -44  -24  -18  -13
     reflected about y[0]                  -58  -38  -18  -12   -8
     reflected half a sample before        -70  -50  -30  -23  -17
     that, with the first moment           -115 -74  -34  -22  -14   0.2 dB of level up to 0.1, 1.6 dB up to 0.3
     by three moments on y[0..2]           -136 -96  -39  -21  -11   what does not alternate becomes a spike */

/* lead[m - 1], m = 1..n, holds y[-m]; it becomes what y[m - 1] is to be raised by. apart: b, 2 b <= n; 0: the first
   moment is left as the reflection has it. That is right where the lead is a smoothing's, which is of one sign: without
   coming before the start it cannot but come later. */
void filter_fold_lead(double *lead, long n, long distance);

/* Values of a band-limited signal between its samples. */

enum { BETWEEN_PHASES = 32, BETWEEN_REACH = 24 };

struct filter_between {
    double *tap; /* [BETWEEN_PHASES][2 BETWEEN_REACH] */
};

struct filter_between filter_between_make(struct arena *a);

/* x at k / BETWEEN_PHASES samples; beyond its ends x is 0. At whole samples x itself; error below 1e-4 of a sinusoid's
   amplitude up to 0.44 of the sample rate, below 4e-5 up to 0.4. */
double filter_between_at(const struct filter_between *b, const double *x, long n, long k);

#endif
