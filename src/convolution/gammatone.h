/* Modes that begin softly: each one's envelope is that of a gammatone in place of an exponential. See gammatone.c. Of gamma 1 all of these leave things as they are. */
#ifndef CONVOLUTION_GAMMATONE_H
#define CONVOLUTION_GAMMATONE_H
#include "response/ir.h"
#include "response/modes.h"

enum { GAMMATONE_MOST = 4 };

/* Turns gains A of p's n components into those of t^(gamma - 1) e^(s t): times (e decay / (gamma - 1))^(gamma - 1). */
void gammatone_gains(int gamma, int n, const double *decay, const struct modes_point *p);

/* ir_sample of such gains, times t^(gamma - 1): no jump, no direct term. */
void gammatone_sample(int gamma, double rate, struct ir_sampler *s, int quantity, const struct modes_point *p, double *h, size_t length);

/* dB by which e^(-t/tau) has fallen when the gammatone has fallen `decibel` (> 0) below its greatest value, after that; and the other way round, of times
   after the greatest value. */
double gammatone_decibel(int gamma, double decibel);
double gammatone_fallen(int gamma, double decibel);

/* What the error of interpolation over hops, where poles move, is larger by than that of exponentials, at most. */
double gammatone_harder(int gamma, int order);

/* Cost of a mode and sample over that of a plain resonator. */
double gammatone_cost(int gamma);

#endif
