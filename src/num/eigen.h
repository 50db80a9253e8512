/* Real symmetric eigenproblems, the largest eigenvalues first, by + - * / sqrt alone (num/lanes.h): the same bits on
   every CPU. Measured beside GSL in tests/unit/test_eigen.c. */
#ifndef NUM_EIGEN_H
#define NUM_EIGEN_H
#include <stdbool.h>

#include "base/arena.h"

/* Of matrices [n][n] only what lies at and below the diagonal is read and written. */

/* a becomes its inverse; false: it is not positive definite. A matrix D S D, D diagonal, loses what S alone would. */
bool eigen_inverse(int n, double *a);

/* The eigenvalues above `least`, falling, into value[n], and their vectors, of unit length, as the rows of *vector
   [found][n] (in the arena). Error of values: at most 2e-16 n of the largest magnitude. Returns how many; -1: QL has
   no end. a is lost. Fastest where the last rows hold most of the large eigenvalues. */
int eigen_above(int n, double *a, double least, struct arena *arena, double *value, double **vector);

#endif
