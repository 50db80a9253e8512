/* How many eigenvalues of K u = lambda M u lie below a value, without computing any. */
#ifndef FEM_SOLID_COUNT_H
#define FEM_SOLID_COUNT_H
#include "fem/solid_matrices.h"

/* The number of lambda below shift (rad^2/s^2); `like` is a supernodal factor of a matrix of the same pattern. -1: no
   memory, or a pivot is 0 (a lambda is shift itself). */
long solid_count(struct solid_matrices *x, const cholmod_factor *like, double shift);

#endif
