/* The normal equations of one set of poles. */
#ifndef ANALYSIS_RINGING_NORMAL_H
#define ANALYSIS_RINGING_NORMAL_H
#include <complex.h>

#include "analysis/ringing_fit.h"

struct ringing_normal {
    int w;               /* 2 m: rows of the basis */
    double *g[3];        /* [w][w] inner products with t^0, t^1, t^2; columns scaled by `scale`; g[0] becomes its Cholesky factor */
    double *scale;       /* [w] 1/norm of each row */
    double *cross;       /* [w][w] g0^-1 g1 */
    double *schur;       /* [w][w] g2 - g1 g0^-1 g1 */
};

void ringing_normal_make(const struct ringing_fit *f, struct arena *a, struct ringing_normal *n);

/* x[w] <- (scaled g0)^-1 x. */
void ringing_normal_solve(const struct ringing_normal *n, double *x);

/* Cholesky's factor of a symmetric matrix [w][w] with as small a ridge as makes it positive; returns the ridge. */
double ringing_normal_factor(double *matrix, int w);

/* [w][w] of poles: sum over places of weight[p][i]^(1/2) M' schur M weight[p][k]^(1/2), M the gains as 2 x 2 matrices; ties and held poles included. */
void ringing_normal_poles(const struct ringing_fit *f, const struct ringing_normal *n, const double *weight, double *h);

/* From the derivative by each pole to that by the parameters: ties add up, held ones are 0. */
void ringing_normal_reduce(const struct ringing_fit *f, double *g);
/* ... and back. */
void ringing_normal_expand(const struct ringing_fit *f, double *step);

#endif
