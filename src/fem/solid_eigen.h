/* The lowest eigenpairs of K u = lambda M u. */
#ifndef FEM_SOLID_EIGEN_H
#define FEM_SOLID_EIGEN_H
#include "fem/solid_lanczos.h"

struct solid_pairs {
    int n; /* by rising lambda */
    size_t freedoms;
    double *lambda; /* [n] Rayleigh quotients, rad^2/s^2 */
    double *vector; /* [n][freedoms], u^T M u = 1 */
};

/* `factor` becomes the supernodal factor of K - shift M, NULL where a few freedoms are solved densely. ERR_NUMBERS: no
   convergence; ERR_SCENE: too large for the memory. Close the pairs and free the factor in any case. */
bool solid_eigen(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor,
                 struct solid_pairs *p, struct err *e);
void solid_eigen_close(struct solid_pairs *p);

/* Greatest |K u - lambda M u| / |lambda M u| of n of the pairs, from the first-th on. */
double solid_eigen_residual(const struct solid_matrices *x, const struct solid_pairs *p, int first, int n);

#endif
