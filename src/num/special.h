/* Special functions and quadrature, by arithmetic alone (the same bits on every CPU). */
#ifndef NUM_SPECIAL_H
#define NUM_SPECIAL_H

/* j[0] = J_n(x), j[1] = J_{n+1}(x); n >= 0, x >= 0. Absolute error <= 1e-14, relative 1e-12 away from zeros
 * (tests/unit/test_bessel.c: x <= 500). */
void special_bessel_j(int n, double x, double j[2]);

/* i[0] = e^-x I_n(x), i[1] = e^-x I_{n+1}(x); n >= 0, x >= 0. Relative error <= 1e-13. */
void special_bessel_i(int n, double x, double i[2]);

/* Nodes (rising) and weights [n] on (-1, 1): exact for polynomials up to degree 2n - 1, to a few ulp. */
void special_gauss_legendre(int n, double *node, double *weight);

/* Orthonormal functions on [-1, 1] that vanish to a given order at each end: (1 - x)^a (1 + x)^b times Jacobi's
 * polynomials P_k^(2a,2b). */

enum { JACOBI_MOST = 256 };

struct jacobi {
    int a, b; /* 0 to 2: orders of the zeros at x = 1 and x = -1 */
    double first, center[JACOBI_MOST],
        step[JACOBI_MOST]; /* step[k+1] p_{k+1} = (x - center[k]) p_k - step[k] p_{k-1} */
};

struct jacobi special_jacobi_make(int a, int b);

/* f_0 .. f_{n-1} at x in [-1, 1], n <= JACOBI_MOST. */
void special_jacobi_values(const struct jacobi *j, int n, double x, double *f);

/* The same with first and second derivatives; x inside (-1, 1). */
void special_jacobi_slopes(const struct jacobi *j, int n, double x, double *f, double *f1, double *f2);

/* The standard normal distribution, by arithmetic that gives the same bits everywhere (num/real.h). */

/* exp(-x^2/2) / sqrt(2 pi); relative error <= 1e-15 while it is normal (|x| <= 37.6). */
double special_normal_density(double x);

/* P(Z <= x); relative error <= 4e-15 for -37 <= x, so that special_normal_cdf(-x) is the other tail without loss;
 * below -38.6 it is 0. */
double special_normal_cdf(double x);

/* special_normal_cdf and, into `density`, special_normal_density, in the time of one. */
double special_normal_cdf_density(double x, double *density);

/* x with P(Z <= x) = w, 0 < w < 1; relative error <= 2e-15 (of x; near w = 1/2 of w - 1/2). w = 0 and 1 give -inf and
 * inf. */
double special_normal_quantile(double w);

#endif
