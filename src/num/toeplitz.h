/* M h = c by conjugate gradients, M symmetric, positive definite and Toeplitz: a part of a circulant matrix, whose
   spectrum is known. With a preconditioner, which is the circulant's inverse, few steps do where the spectrum is
   positive (Chan and Ng, Conjugate gradient methods for Toeplitz systems, SIAM Review 38, 1996). */
#ifndef NUM_TOEPLITZ_H
#define NUM_TOEPLITZ_H
#include <stdbool.h>

#include "num/fft.h"

struct toeplitz {
    struct fft *fft;
    long n, size;           /* of h and c; of the circulant, 2 n at least */
    const double *spectrum; /* [size/2 + 1] */
    bool preconditioned;
    int most;      /* steps */
    double enough; /* of the squares of c, that the rest may have */
};

/* h[n] from the one there is. Returns the steps. */
int toeplitz_solve(const struct toeplitz *t, const double *c, double *h);

#endif
