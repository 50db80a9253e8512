/* The linear part of slopes.c. */
#ifndef RESPONSE_SLOPES_GAINS_H
#define RESPONSE_SLOPES_GAINS_H
#include "response/slopes.h"

struct slopes_gains {
    struct slopes_series *series;
    int count, samples;                      /* series; samples of all */
    double *t, *a;                           /* [samples] time/T, amplitudes/largest, series after series */
    double *e[SLOPES_MOST], *q[SLOPES_MOST]; /* [samples] columns e^(-exp(x) t), orthogonal columns */
    double *r;                               /* [samples] residual */
};

/* Fits the gains for the decays exp(x[k])/T; returns the sum of squares that is left (in r). */
double slopes_gains_fit(struct slopes_gains *g, const double *x, int k);

void slopes_gains_exponentials(const struct slopes_gains *g, double x, double *e);

/* Takes the directions q[0 .. k) off x[from .. from + n), twice; coefficients are added to c (NULL: not wanted). */
void slopes_gains_project(const struct slopes_gains *g, int k, double *x, int from, int n, double *c);

/* Unit length, or 0 when next to nothing is left of `before`. Returns the length. */
double slopes_gains_unit(double *x, int n, double before);

double slopes_gains_dot(const double *x, const double *y, int n);

#endif
