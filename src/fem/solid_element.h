/* One tetrahedron, its places quadratic, its displacement of order 2 to 4: stiffness and mass. */
#ifndef FEM_SOLID_ELEMENT_H
#define FEM_SOLID_ELEMENT_H
#include "fem/elastic.h"
#include "fem/solid_lattice.h"

struct solid_element {
    double k[3 * SOLID_LATTICE_NODES][3 * SOLID_LATTICE_NODES]; /* N/m, of the displacement 3 node + axis */
    double m[SOLID_LATTICE_NODES][SOLID_LATTICE_NODES];         /* kg, the same for each axis */
    double volume;                                              /* m^3 */
};

/* Values [10] and slopes [10][3] (of L1, L2, L3) of the quadratic shape functions where the corners' coordinates are 1
   - L1 - L2 - L3, L1, L2, L3; nodes as in file/mesh.h. */
void solid_element_shapes(const double l[3], double value[10], double slope[10][3]);

/* at: m. false: turned inside out, or of no volume, at a point of the quadrature. */
bool solid_element_make(const double at[10][3], const struct solid_lattice *t, const struct elastic *s,
                        struct solid_element *x);

#endif
