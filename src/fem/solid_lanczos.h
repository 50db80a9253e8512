/* The lowest pairs of large sparse K u = lambda M u by block Lanczos. */
#ifndef FEM_SOLID_LANCZOS_H
#define FEM_SOLID_LANCZOS_H
#include "fem/solid_matrices.h"

struct solid_pairs;

struct solid_search {
    int want;       /* pairs; as many as there are freedoms at most */
    double shift;   /* rad^2/s^2, below 0: near minus the lowest lambda that is not 0 */
    unsigned start; /* which start vectors */
};

/* p->n vectors of p->freedoms, M-orthonormal, in p->vector, greatest theta first; `factor` is that of K - shift M.
 * ERR_NUMBERS: no convergence; ERR_SCENE: too large for the memory. */
bool solid_lanczos(struct solid_matrices *x, cholmod_factor *factor, const struct solid_search *ask,
                   struct solid_pairs *p, struct err *e);

#endif
