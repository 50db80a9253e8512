/* The equations of a whole solid: its nodes, in which directions they can move, stiffness and mass. */
#ifndef FEM_SOLID_MATRICES_H
#define FEM_SOLID_MATRICES_H
#include <suitesparse/cholmod.h>

#include "fem/boundary.h"
#include "fem/solid.h"
#include "fem/solid_element.h"

/* The nodes on which the displacement is given: those of a mesh raised to an order of its own. The mesh's places stay
 * what they are, quadratic. */
struct solid_net {
    const struct mesh *mesh;
    const struct boundary *boundary;
    struct solid_lattice lattice;
    int nodes;
    double (*at)[3];           /* [nodes] m */
    const int *element, *face; /* [elements][lattice.n], [boundary->n][lattice.on_face] */
};

/* Order 2: the mesh's own nodes, by the same numbers. */
void solid_matrices_net(const struct mesh *m, const struct boundary *b, int order, struct arena *a,
                        struct solid_net *net);

/* In which directions each node can move. */
struct solid_freedoms {
    int n, nodes;
    int (*of)[3]; /* [nodes] number of the freedom along each direction of the node's frame, rising; -1: held */
    int *frame;   /* [nodes] -1: x y z; else index of its frame */
    double (*frames)[3][3]; /* unit vectors as rows */
    int rigid;              /* motions of the whole that nothing holds, 0 to 6 */
};

/* ERR_SCENE: a face that is not one of the boundary's; nothing is left that moves. */
bool solid_matrices_freedoms(const struct solid_net *net, const struct solid_ask *ask, struct arena *a,
                             struct solid_freedoms *f, struct err *e);

/* The displacements [nodes][3] along x, y, z of values q [n]. */
void solid_matrices_spread(const struct solid_freedoms *f, const double *q, double *u);

/* The values q [n] of displacements that do not move what is held. */
void solid_matrices_gather(const struct solid_freedoms *f, const double *u, double *q);

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

/* Says that memory does not suffice; returns false. */
bool solid_matrices_no_memory(size_t freedoms, struct err *e);

#endif
