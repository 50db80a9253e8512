/* Damped exponentials over a whole response: their sums, what they hold of a signal, and their sound. */
#ifndef ANALYSIS_RINGING_BASIS_H
#define ANALYSIS_RINGING_BASIS_H
#include <complex.h>

#include "base/arena.h"

enum { RINGING_BLOCK = 256 }; /* samples */

struct ringing_basis {        /* of m poles s_i: row 2i of a table is Re e^(s_i t), row 2i + 1 is -Im e^(s_i t) */
    int m;
    long n;
    double rate;
    long blocks;
    double *table, *moment;   /* [2m][RINGING_BLOCK]; the same times t */
    double complex *step;     /* [blocks][m] e^(s_i t) at the beginning of each block */
    double complex *turned;   /* [blocks] */
    double *work, *work1;     /* [blocks][2m] */
    double *signal;           /* [blocks][RINGING_BLOCK] */
};

/* Room for up to `most` poles. */
void ringing_basis_open(struct ringing_basis *b, int most, long n, double rate, struct arena *a);
void ringing_basis_set(struct ringing_basis *b, int m, const double *decay, const double *omega);

/* out[i] = sum_n x[n] conj(e^(s_i t_n)); first[i]: the same with t_n x[n]. */
void ringing_basis_project(struct ringing_basis *b, const double *x, double complex *out, double complex *first);

/* y[n] = x[n] - Re sum_i gain[i] e^(s_i t_n). */
void ringing_basis_subtract(struct ringing_basis *b, const double *x, const double complex *gain, double *y);

/* sum[q] = sum over n samples of t^q e^(u t), q = 0, 1, 2, t = 0, 1/rate, ...: by doubling, exact to n roundings for any u with Re u <= 0. */
void ringing_basis_sums(double complex u, long n, double rate, double complex sum[3]);

/* Inner products of the rows above over the signal with weights t^q, q = 0, 1, 2: g[q][2m][2m], symmetric. */
void ringing_basis_gram(int m, const double *decay, const double *omega, const struct ringing_basis *b, double *g[3]);

#endif
