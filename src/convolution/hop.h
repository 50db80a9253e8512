/* How far apart the places may be whose responses stand for all, for an error asked for (hop.c has the formula and its source). */
#ifndef CONVOLUTION_HOP_H
#define CONVOLUTION_HOP_H

/* Relative rms error (amplitude) of interpolation of order 1, 2 or 4 between responses whose pole moves by `rho` half bandwidths from one to
   the next. */
double hop_error(int order, double rho);

/* The rho that makes that error. */
double hop_rho(int order, double error);

#endif
