/* The sparse matrices of the whole solid. */
#ifndef FEM_SOLID_MATRICES_H
#define FEM_SOLID_MATRICES_H
#include <suitesparse/cholmod.h>

#include "fem/solid_freedoms.h"

struct solid_matrices {
    cholmod_common common;
    cholmod_sparse *k, *m;  /* lower halves, of the same pattern */
    cholmod_sparse *m_thin; /* m without its zeros, to multiply with */
    double mass;            /* kg, of all of the solid */
};

/* ERR_SCENE: an element that is turned inside out; too large for the memory. Close it in any case. */
bool solid_matrices_open(const struct solid_net *net, const struct elastic *s, const struct solid_freedoms *f,
                         struct solid_matrices *x, struct err *e);
void solid_matrices_close(struct solid_matrices *x);

/* K - shift M, as a new matrix; NULL: no memory. */
cholmod_sparse *solid_matrices_shifted(struct solid_matrices *x, double shift);

/* y = A v. */
void solid_matrices_times(struct solid_matrices *x, cholmod_sparse *a, const double *v, double *y);

/* The same of SOLID_MATRICES_WIDE vectors, v and y [WIDE][n], by one reading of A; room: 2 WIDE n numbers. */
enum { SOLID_MATRICES_WIDE = 8 };
void solid_matrices_times_block(const cholmod_sparse *a, const double *v, double *y, double *room);

/* An array as CHOLMOD wants it. */
cholmod_dense solid_matrices_column(double *v, size_t n);

/* Says that memory does not suffice; returns false. */
bool solid_matrices_no_memory(size_t freedoms, struct err *e);

#endif
