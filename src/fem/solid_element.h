/* One tetrahedron: what it is made of (Hooke's law in three dimensions), how displacement and places are given in it,
   its stiffness and mass. */
#ifndef FEM_SOLID_ELEMENT_H
#define FEM_SOLID_ELEMENT_H
#include <stdbool.h>

#include "base/err.h"

struct elastic {
    double c[6][6]; /* Pa, stresses xx yy zz yz zx xy of strains (engineering shear); symmetric, positive definite */
    double density; /* kg/m^3 */
};

/* Isotropic. ERR_USAGE: E or density not above 0, nu not in (-1, 0.5). */
bool solid_element_isotropic(double youngs_modulus, double poisson, double density, struct elastic *s, struct err *e);

struct elastic_wood { /* orthotropic: x along the grain (L), y tangential (T), z radial (R), a flat-sawn board */
    double e[3];      /* Pa, along x, y, z */
    double g[3];      /* Pa, of the planes yz, zx, xy */
    double nu[3];     /* Poisson's ratios nu_yz (pull along y, contraction along z), nu_xz, nu_xy */
    double density;
};

/* ERR_USAGE: not positive definite. */
bool solid_element_orthotropic(const struct elastic_wood *w, struct elastic *s, struct err *e);

/* Lagrange's tetrahedra and triangles of order 2 to 4. */
enum { SOLID_LATTICE_LEAST = 2, SOLID_LATTICE_MOST = 4, SOLID_LATTICE_NODES = 35, SOLID_LATTICE_FACE = 15 };

struct solid_lattice {
    int order, n, on_face; /* nodes of a tetrahedron, of a triangle */
    int at[SOLID_LATTICE_NODES]
          [4]; /* the node's barycentric coordinates times the order: corners, edges 01 12 20 03 13 23, faces, inside */
    int face[SOLID_LATTICE_FACE][3]; /* corners, edges 01 12 20, inside */
};

struct solid_lattice solid_element_lattice(int order);

/* Values [n] and slopes [n][3] (of L1, L2, L3) where the corners' coordinates are 1 - L1 - L2 - L3, L1, L2, L3. */
void solid_element_lattice_shapes(const struct solid_lattice *t, const double l[3], double *value, double (*slope)[3]);

/* Values [on_face] at (u, v): corner 0 at (0, 0), 1 at (1, 0), 2 at (0, 1). */
void solid_element_lattice_face(const struct solid_lattice *t, double u, double v, double *value);

/* Places are quadratic, displacements of order 2 to 4. */
struct solid_element {
    double k[3 * SOLID_LATTICE_NODES][3 * SOLID_LATTICE_NODES]; /* N/m, of the displacement 3 node + axis */
    double m[SOLID_LATTICE_NODES][SOLID_LATTICE_NODES];         /* kg, the same for each axis */
    double volume;                                              /* m^3 */
};

/* Values [10] and slopes [10][3] (of L1, L2, L3) of the quadratic shape functions where the corners' coordinates are 1
   - L1 - L2 - L3, L1, L2, L3; nodes as in file/mesh.h. */
void solid_element_shapes(const double l[3], double value[10], double slope[10][3]);

/* Are the edges straight, with midsides in their middle (to 1e-8 of their length)? The Jacobian then is constant. */
bool solid_element_straight(const double at[10][3]);

/* Cofactors of the places' derivatives to L1, L2, L3; returns their determinant, m^3. */
double solid_element_jacobian(const double at[10][3], const double l[3], double cof[3][3]);

/* at: m. false: turned inside out, or of no volume, at a point of the quadrature. */
bool solid_element_make(const double at[10][3], const struct solid_lattice *t, const struct elastic *s,
                        struct solid_element *x);

#endif
