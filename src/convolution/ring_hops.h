/* Hops that keep an error, by measuring it (ring_error.h). In asks `hop` is the longest allowed, in frames; found hops are whole frames, 1 at least,
   where the error is none. */
#ifndef CONVOLUTION_RING_HOPS_H
#define CONVOLUTION_RING_HOPS_H
#include "convolution/ring_error.h"

/* One hop for all modes, the longest within 10 % or so; `error`: relative rms (amplitude) asked for. *reached: what it makes, measured. */
int ring_hops_one(const struct ring_survey *s, const struct ring_error_ask *ask, double error, double *reached);

/* The same among powers of two. */
int ring_hops_power(const struct ring_survey *s, const struct ring_error_ask *ask, double error, double *reached);

/* A power of two for each mode, so that each keeps the error by itself: hop[n]. Returns what all make together. */
double ring_hops_each(const struct ring_survey *s, const struct ring_error_ask *ask, double error, double *hop);

#endif
