/* Lagrange's tetrahedra and triangles of order 2 to 4. */
#ifndef FEM_SOLID_LATTICE_H
#define FEM_SOLID_LATTICE_H

enum { SOLID_LATTICE_LEAST = 2, SOLID_LATTICE_MOST = 4, SOLID_LATTICE_NODES = 35, SOLID_LATTICE_FACE = 15 };

struct solid_lattice {
    int order, n, on_face; /* nodes of a tetrahedron, of a triangle */
    int at[SOLID_LATTICE_NODES]
          [4]; /* the node's barycentric coordinates times the order: corners, edges 01 12 20 03 13 23, faces, inside */
    int face[SOLID_LATTICE_FACE][3]; /* corners, edges 01 12 20, inside */
};

struct solid_lattice solid_lattice_make(int order);

/* Values [n] and slopes [n][3] (of L1, L2, L3) where the corners' coordinates are 1 - L1 - L2 - L3, L1, L2, L3. */
void solid_lattice_shapes(const struct solid_lattice *t, const double l[3], double *value, double (*slope)[3]);

/* Values [on_face] at (u, v): corner 0 at (0, 0), 1 at (1, 0), 2 at (0, 1). */
void solid_lattice_face(const struct solid_lattice *t, double u, double v, double *value);

#endif
