/* A sinusoid in the amplitudes of impacts: A_n = (mean + X_n)(1 + m sin(2 pi nu T_n + phi)). See modulation.c. */
#ifndef ANALYSIS_MODULATION_H
#define ANALYSIS_MODULATION_H
#include <stdbool.h>

#include "base/arena.h"

#define MODULATION_PROBABILITY 0.001

struct modulation {
    double depth, rate, phase;      /* m, nu in Hz, phi in rad                                                     */
    double depth_error, rate_error; /* standard errors; NAN where it was not found                              */
    double probability;             /* that noise of the spectrum found makes a sinusoid as strong somewhere        */
    bool found;                     /* it is below MODULATION_PROBABILITY                                           */
};

/* The strongest sinusoid between two cycles in all and half a cycle an impact. time[n] in s, rising; n >= 8. Values
   that are all alike, or whose mean is not told from 0 (there is nothing that a sinusoid could be a share of), have
   none: depth 0, probability 1. */
void modulation_find(const double *time, const double *amplitude, int n, struct arena *a, struct modulation *m);

/* out[n] = amplitude/(1 + m sin). May be the amplitudes themselves. */
void modulation_divide(const struct modulation *m, const double *time, const double *amplitude, int n, double *out);

#endif
