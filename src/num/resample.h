/* Sample-rate conversion (libsoxr, very high quality), the same bits on every CPU: see resample.c. */
#ifndef NUM_RESAMPLE_H
#define NUM_RESAMPLE_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

enum { RESAMPLE_REACH = 160 }; /* periods of the lower rate that the filter reaches to either side; it ends after 144 */

/* x[n] at rate_in to *y[*m] at rate_out (Hz), *m = ceil(n rate_out / rate_in); sample 0 of both is the same instant,
   and values are those of the band-limited signal (an impulse response is not rescaled by the ratio of rates: its
   values per second stay), zero before and after x. What would ring before sample 0 is folded into the first samples
   (num/filter.h): the sum over the rate stays, if what rings after x is kept, too, by zeros at its end
   (RESAMPLE_REACH). Errors: ERR_UNBUILT (a libsoxr without its portable double-precision code), ERR_SCENE (rates more
   than a factor of 1000 apart). Threads wait for each other. */
bool resample(struct arena *a, const double *x, size_t n, double rate_in, double rate_out, double **y, size_t *m,
              struct err *e);

/* Sets the environment that libsoxr reads: once, before a program starts threads, which may be reading it. */
void resample_prepare(void);

#endif
