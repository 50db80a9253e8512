/* The four sides of each tetrahedron, as lists in which those of the same corners stand together. */
#ifndef FEM_FACES_H
#define FEM_FACES_H
#include "file/mesh.h"

struct faces_face {
    int corner[3]; /* rising indices */
    int element, side;
};

/* Nodes of side s within an element: corners, counterclockwise seen from outside, then midsides of 01 12 20. */
extern const int faces_nodes[4][6];

/* [4 elements], sorted by corners, then by element and side. */
struct faces_face *faces_sorted(const struct mesh *m, struct arena *a);

/* How many faces from f[0] on, of those that are left, have its corners. */
int faces_alike(const struct faces_face *f, int left);

#endif
