/* In which directions each node can move. */
#ifndef FEM_SOLID_FREEDOMS_H
#define FEM_SOLID_FREEDOMS_H
#include "fem/solid.h"
#include "fem/solid_net.h"

struct solid_freedoms {
    int n, nodes;
    int (*of)[3]; /* [nodes] number of the freedom along each direction of the node's frame, rising; -1: held */
    int *frame;   /* [nodes] -1: x y z; else index of its frame */
    double (*frames)[3][3]; /* unit vectors as rows */
    int rigid;              /* motions of the whole that nothing holds, 0 to 6 */
};

/* ERR_SCENE: a face that is not one of the boundary's; nothing is left that moves. */
bool solid_freedoms_make(const struct solid_net *net, const struct solid_ask *ask, struct arena *a,
                         struct solid_freedoms *f, struct err *e);

/* The displacements [nodes][3] along x, y, z of values q [n]. */
void solid_freedoms_spread(const struct solid_freedoms *f, const double *q, double *u);

#endif
