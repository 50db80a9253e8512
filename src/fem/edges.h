/* Edges as pairs of nodes, each with a number that is the same for all who share it. */
#ifndef FEM_EDGES_H
#define FEM_EDGES_H
#include "base/arena.h"

struct edges {
    struct arena *arena;
    int n, room; /* edges; slots, a power of two */
    struct edges_edge {
        int low, high, value;
    } * slot; /* high 0: free */
};

/* The nodes of a tetrahedron's six edges, in the order of its midsides. */
extern const int edges_nodes[6][2];

void edges_open(struct edges *t, struct arena *a);

/* Where the edge's number stands; it is -1 when the edge was not there before. Stays valid until the next call. */
int *edges_at(struct edges *t, int one, int other);

#endif
