/* Modes that begin softly: each one's envelope is that of a gammatone in place of an exponential. See gammatone.c. Of
   gamma 1 all of these leave things as they are. */
#ifndef CONVOLUTION_GAMMATONE_H
#define CONVOLUTION_GAMMATONE_H
#include "base/arena.h"
#include "response/ir.h"
#include "response/modes.h"

enum { GAMMATONE_MOST = 4 };

/* Turns gains A of p's n components into those of t^(gamma - 1) e^(s t): times (e decay / (gamma - 1))^(gamma - 1). */
void gammatone_gains(int gamma, int n, const double *decay, const struct modes_point *p);

/* ir_sample of such gains, times t^(gamma - 1): no jump, no direct term. */
void gammatone_sample(int gamma, double rate, struct ir_sampler *s, int quantity, const struct modes_point *p,
                      double *h, size_t length);

/* dB by which e^(-t/tau) has fallen when the gammatone has fallen `decibel` (> 0) below its greatest value, after that;
   and the other way round, of times after the greatest value. */
double gammatone_decibel(int gamma, double decibel);
double gammatone_fallen(int gamma, double decibel);

/* Cost of a mode and sample over that of a plain resonator. */
double gammatone_cost(int gamma);

/* ------------------------------------------------------------------ where poles do not move: a cascade of equal
   complex poles per mode, exact */

struct gammatone_bank;

struct gammatone_bank_ask {
    int n, gamma;                    /* components; 2 to GAMMATONE_MOST */
    double rate;                     /* Hz                              */
    const double *frequency, *decay; /* [n]                             */
};

/* States and gains zero. */
struct gammatone_bank *gammatone_bank_make(struct arena *a, const struct gammatone_bank_ask *ask);

/* As resonators_run and _set, with gains as gammatone_gains gives them: y[n] = (1/rate) sum_m t^(gamma-1) Im(A(m) e^(s
   t)) f[m], t = (n - m)/rate. */
void gammatone_bank_run(struct gammatone_bank *g, const double *f, double *y, int frames, const struct modes_point *to);
void gammatone_bank_set(struct gammatone_bank *g, const struct modes_point *at);

/* Is every state exactly zero? */
int gammatone_bank_silent(const struct gammatone_bank *g);

#endif
