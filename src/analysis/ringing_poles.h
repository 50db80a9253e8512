/* Poles of sums of exponentials. */
#ifndef ANALYSIS_RINGING_POLES_H
#define ANALYSIS_RINGING_POLES_H
#include <complex.h>

#include "base/arena.h"

struct ringing_poles {
    int rows;               /* of the Hankel matrix */
    double *value;          /* [rows] squared singular values, rising */
    double complex *vector; /* [rows][rows] left singular vectors, one after the other */
};

/* y[places][n]: series that share their poles. */
void ringing_poles_decompose(const double complex *y, int places, long n, struct arena *a, struct ringing_poles *p);

/* How many singular values stand above those of noise, and above `least` (squared). */
int ringing_poles_order(const struct ringing_poles *p, double least);

/* The poles of the `order` greatest; returns how many were found (0: LAPACK failed). zeta[order]. */
int ringing_poles_make(const struct ringing_poles *p, int order, struct arena *a, double complex *zeta);

#endif
