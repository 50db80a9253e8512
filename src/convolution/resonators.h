/* One exact recursion per mode: z <- p z + a f, y = Im z (papers/000 eq. 10, 13 with the force sample launched at its own place).
   See resonators.c for the formula, its discrete convention and its cost. */
#ifndef CONVOLUTION_RESONATORS_H
#define CONVOLUTION_RESONATORS_H
#include "base/arena.h"
#include "response/modes.h"

struct resonators;

/* Bank for the modes (all of them, as they are then; every one below rate/2) at that sample rate; state and gains zero. `ramp`: samples
   per call, for which work space is kept; calls may be of any length. `m` must outlive the bank. */
struct resonators *resonators_make(struct arena *a, const struct modes *m, double rate, int ramp);

/* Adds to y[frames] the response to f[frames] newtons, while the complex gains go linearly, sample by sample, from those last given
   (zero before any, see resonators_set_gains) to gain[n] at the end of the frames. A sample uses the gain at its own instant.
   y is in the table's quantity: y[n] = (1/rate) sum_m h(n-m) f[m], half of h(0+) at n = m. */
void resonators_run(struct resonators *r, const double *f, double *y, int frames, const double *gain_re, const double *gain_im);

/* Sets the gains at once (a start, or a contact that does not move). */
void resonators_set_gains(struct resonators *r, const double *gain_re, const double *gain_im);

/* True when every state is exactly zero (they are flushed below 1e-200). */
int resonators_silent(const struct resonators *r);

#endif
