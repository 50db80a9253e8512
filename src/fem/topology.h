/* How tetrahedra hang together: edges and faces that they share, points that coincide, parts that are joined. */
#ifndef FEM_TOPOLOGY_H
#define FEM_TOPOLOGY_H
#include "base/arena.h"
#include "file/mesh.h"

/* Edges as pairs of nodes, each with a number that is the same for all who share it. */
struct topology_edges {
    struct arena *arena;
    int n, room; /* edges; slots, a power of two */
    struct topology_edge {
        int low, high, value;
    } * slot; /* high 0: free */
};

/* The nodes of a tetrahedron's six edges, in the order of its midsides. */
extern const int topology_edge_nodes[6][2];

void topology_edges_open(struct topology_edges *t, struct arena *a);

/* Where the edge's number stands; it is -1 when the edge was not there before. Stays valid until the next call. */
int *topology_edges_at(struct topology_edges *t, int one, int other);

/* The four sides of each tetrahedron, as lists in which those of the same corners stand together. */
struct topology_face {
    int corner[3]; /* rising indices */
    int element, side;
};

/* Nodes of side s within an element: corners, counterclockwise seen from outside, then midsides of 01 12 20. */
extern const int topology_face_nodes[4][6];

/* [4 elements], sorted by corners, then by element and side. */
struct topology_face *topology_faces(const struct mesh *m, struct arena *a);

/* Three indices in rising order. */
void topology_rise(int c[3]);

/* How many faces from f[0] on, of those that are left, have its corners. */
int topology_faces_alike(const struct topology_face *f, int left);

/* Points that coincide within a share of a size have one number. */
struct topology_merge {
    double size, same; /* same: share of the size within which points are one, at most 1e-6 */
    size_t room;       /* slots, a power of two above twice the points */
    struct topology_merge_slot {
        double at[3];
        int number, used;
    } * slot;
};

/* At most `most` points. */
void topology_merge_open(struct topology_merge *g, double size, double same, size_t most, struct arena *a);

/* Where the number of the point there stands; -1 when there was none before. */
int *topology_merge_at(struct topology_merge *g, const double at[3]);

/* Which things belong together, as pairs are joined (union and find with path halving; the least index is the root). */
static inline int *topology_roots(int n, struct arena *a)
{
    int *root = ARENA_TAKE(a, int, n);
    for (int i = 0; i < n; i++)
        root[i] = i;
    return root;
}

static inline int topology_root_of(int *root, int i)
{
    while (root[i] != i)
        i = root[i] = root[root[i]];
    return i;
}

static inline void topology_join(int *root, int i, int j)
{
    i = topology_root_of(root, i);
    j = topology_root_of(root, j);
    root[i > j ? i : j] = i > j ? j : i;
}

/* Linear tetrahedra lock where something bends: midsides make them quadratic. A node in the middle of each edge, shared
   by all elements with that edge; appends the warning to m->note: that faces stay flat, so what is round wants a finer
   mesh or a quadratic one (gmsh -order 2). m->linear becomes false. Nothing to do for a quadratic mesh. */
void topology_elevate(struct mesh *m, struct arena *a);

#endif
