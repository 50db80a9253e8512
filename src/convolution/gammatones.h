/* Gammatones whose poles do not move: a cascade of equal complex poles per mode, exact. See gammatones.c; as resonators.h otherwise. */
#ifndef CONVOLUTION_GAMMATONES_H
#define CONVOLUTION_GAMMATONES_H
#include "base/arena.h"
#include "response/modes.h"

struct gammatones;

struct gammatones_ask {
    int n, gamma;                    /* components; 2 to GAMMATONE_MOST */
    double rate;                     /* Hz                              */
    const double *frequency, *decay; /* [n]                             */
};

/* States and gains zero. */
struct gammatones *gammatones_make(struct arena *a, const struct gammatones_ask *ask);

/* As resonators_run and _set, with gains as gammatone_gains gives them: y[n] = (1/rate) sum_m t^(gamma-1) Im(A(m) e^(s t)) f[m], t = (n - m)/rate. */
void gammatones_run(struct gammatones *g, const double *f, double *y, int frames, const struct modes_point *to);
void gammatones_set(struct gammatones *g, const struct modes_point *at);

/* Is every state exactly zero? */
int gammatones_silent(const struct gammatones *g);

#endif
