/* Orthonormal functions on [-1, 1] that vanish to a given order at each end: (1 - x)^a (1 + x)^b times Jacobi's
 * polynomials P_k^(2a,2b). */
#ifndef NUM_JACOBI_H
#define NUM_JACOBI_H

enum { JACOBI_MOST = 256 };

struct jacobi {
    int a, b; /* 0 to 2: orders of the zeros at x = 1 and x = -1 */
    double first, center[JACOBI_MOST],
        step[JACOBI_MOST]; /* step[k+1] p_{k+1} = (x - center[k]) p_k - step[k] p_{k-1} */
};

struct jacobi jacobi_make(int a, int b);

/* f_0 .. f_{n-1} at x in [-1, 1], n <= JACOBI_MOST. */
void jacobi_values(const struct jacobi *j, int n, double x, double *f);

/* The same with first and second derivatives; x inside (-1, 1). */
void jacobi_slopes(const struct jacobi *j, int n, double x, double *f, double *f1, double *f2);

#endif
