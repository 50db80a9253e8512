/* Gauss-Legendre quadrature. */
#ifndef NUM_GAUSS_H
#define NUM_GAUSS_H

/* Nodes (rising) and weights [n] on (-1, 1): exact for polynomials up to degree 2n - 1, to a few ulp. */
void gauss_legendre(int n, double *node, double *weight);

#endif
