/* Sums of decaying exponentials and their energy, exact however nearly they cancel. */
#ifndef CONVOLUTION_DECAYING_H
#define CONVOLUTION_DECAYING_H

struct decaying {                /* (re + j im) e^((-decay + j omega) t), t >= 0 */
    double re, im, decay, omega; /* decay > 0 in 1/s, omega in rad/s */
};

enum { DECAYING_MOST = 8, DECAYING_POINTS = 24, DECAYING_TERMS = 40 };

/* Integral of |sum|^2 over t from 0 on, of n <= DECAYING_MOST terms whose poles lie near the last one's: to 1e-3 of itself or 1e-30 of the energy of the
   terms; to 1e-15 of that where the poles lie further apart than half a bandwidth. */
double decaying_energy(const struct decaying *x, int n);

/* The same until t = end (s), of poles that need not decay (decay >= 0); *alone: that of the last term. To 1e-3 of itself or 1e-26 of the energy of the terms; to
   1e-15 of that where a pole turns away from the last one's by more than DECAYING_APART rad until the end. */
double decaying_energy_until(const struct decaying *x, int n, double end, double *alone);
#define DECAYING_APART 16.0

/* Points of an integral over time, in units of the last term's energy decaying by e: made once for many sums. */
struct decaying_points {
    double x[DECAYING_POINTS];                          /* 2 decay t */
    double share[DECAYING_POINTS];                      /* of e^(-x), its integral */
    double laguerre[DECAYING_TERMS][DECAYING_POINTS];
};

/* From 0 to `range`; beyond DECAYING_RANGE there is nothing left to integrate, and that is taken. */
#define DECAYING_RANGE 32.0
void decaying_points_make(double range, struct decaying_points *p);

/* The same integral, with weight[k] of its integrand at t = x[k]/(2 decay of the last term); *alone: that of the last term. Where poles lie far apart the
   weights' mean, as the last term has it, counts for all. */
double decaying_energy_weighted(const struct decaying *x, int n, const struct decaying_points *p, const double *weight, double *alone);

#endif
