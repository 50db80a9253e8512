/* What sampling a response folds into the audible band, and the short filter on the force that takes it out again. See
 * alias.c. */
#ifndef CONVOLUTION_ALIAS_H
#define CONVOLUTION_ALIAS_H
#include "base/arena.h"

enum { ALIAS_REACH = 16, ALIAS_TAPS = 2 * ALIAS_REACH + 1 }; /* samples before and after the force's own */

struct alias; /* what is the same for all modes */

/* gamma: of the modes' onset (gammatone.h); 1: at once. */
struct alias *alias_make(struct arena *a, int gamma, double rate);

/* A component t^(gamma-1) Im(A e^(s t)), s = -decay + j 2 pi frequency, sampled at that rate as y(n) = (1/rate) sum_m
   h(n-m) f(m) with half of h(0+) at m = n, plus sum over k from 0 to ALIAS_TAPS - 1 of Im(A (re[k] + j im[k])) f(n +
   ALIAS_REACH - k), is what h makes in continuous time. */
void alias_taps(const struct alias *f, double frequency, double decay, double re[ALIAS_TAPS], double im[ALIAS_TAPS]);

/* Adds Im(A (re[k] + j im[k])) of such a component to to[ALIAS_TAPS], A = gain[0] + j gain[1], with taps within 2e-6 of
 * |A|/rate^gamma (2e-8 below 0.3 of the rate); some 20 times as fast. */
void alias_add(struct alias *f, double frequency, double decay, const double gain[2], double to[ALIAS_TAPS]);

#endif
