/* The nodes on which the displacement of a solid is given: those of a mesh raised to an order of its own. The mesh's
 * places stay what they are, quadratic. */
#ifndef FEM_SOLID_NET_H
#define FEM_SOLID_NET_H
#include "fem/boundary.h"
#include "fem/solid_lattice.h"

struct solid_net {
    const struct mesh *mesh;
    const struct boundary *boundary;
    struct solid_lattice lattice;
    int nodes;
    double (*at)[3];           /* [nodes] m */
    const int *element, *face; /* [elements][lattice.n], [boundary->n][lattice.on_face] */
};

/* Order 2: the mesh's own nodes, by the same numbers. */
void solid_net_make(const struct mesh *m, const struct boundary *b, int order, struct arena *a, struct solid_net *net);

#endif
