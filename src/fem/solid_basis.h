/* One basis, and one sign, for modes of equal frequency. */
#ifndef FEM_SOLID_BASIS_H
#define FEM_SOLID_BASIS_H
#include "fem/solid_eigen.h"

struct solid_place {
    const struct solid_net *net;
    const struct solid_freedoms *freedoms;
};

/* Turns the pairs from the first-th on, where their frequencies are equal to 1e-6, and gives each of such a cluster the
 * mean lambda. false: no memory. */
bool solid_basis(struct solid_matrices *x, const struct solid_place *at, int first, struct solid_pairs *p);

/* u [n]: times 1 or -1, so that the component of largest magnitude (the first of those within 1e-6 of it) is positive.
 */
void solid_basis_sign(double *u, size_t n);

#endif
