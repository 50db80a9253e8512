/* The impulse response that, convolved with a known force, comes nearest to a known sound. */
#ifndef ANALYSIS_STRIKES_SOLVE_H
#define ANALYSIS_STRIKES_SOLVE_H
#include "base/arena.h"

struct strikes_system {
    long n, length;       /* samples of force and sound; of the response */
    const double *force;  /* [n] */
    const double *sound;  /* [n] */
    const double *weight; /* [n] of each sample of the sound; 0: it does not count */
    const double *lag;    /* [length] about the weight that each sample of the response has: for speed alone */
    double *power;        /* [n_power/2 + 1] sum |F|^2 of the pulses alone, at j/n_power cycles per sample; n_power strikes_solve_size */
    double ridge;         /* added to it */
};

/* The transforms' size: even. */
long strikes_solve_size(long n, long length);

/* h[length]: least sum of weight (sound - sum_m force[k - m] h[m])^2 + ridge sum h^2. Returns how many iterations it took; *left: what was left of the
   gradient, as a share. */
int strikes_solve(const struct strikes_system *s, double *h, double *left);

/* y[n] = sum_m force[k - m] h[m] */
void strikes_solve_sound(const struct strikes_system *s, const double *h, double *y);

#endif
