/* The lowest pairs of K u = lambda M u, how many lie below a value, one basis where frequencies are equal. */
#ifndef FEM_SOLID_EIGEN_H
#define FEM_SOLID_EIGEN_H
#include "fem/solid_matrices.h"

struct solid_search {
    int want;       /* pairs; as many as there are freedoms at most */
    double shift;   /* rad^2/s^2, below 0: near minus the lowest lambda that is not 0 */
    unsigned start; /* which start vectors */
};

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

/* The number of lambda below shift (rad^2/s^2), without computing any; `like` is a supernodal factor of a matrix of the
   same pattern. -1: no memory, or a pivot is 0 (a lambda is shift itself). */
long solid_eigen_count(struct solid_matrices *x, const cholmod_factor *like, double shift);

struct solid_place {
    const struct solid_net *net;
    const struct solid_freedoms *freedoms;
};

/* Turns the pairs from the first-th on, where their frequencies are equal to 1e-6, and gives each of such a cluster the
 * mean lambda. false: no memory. */
bool solid_eigen_basis(struct solid_matrices *x, const struct solid_place *at, int first, struct solid_pairs *p);

/* u [n]: times 1 or -1, so that the component of largest magnitude (the first of those within 1e-6 of it) is positive.
 */
void solid_eigen_sign(double *u, size_t n);

#endif
