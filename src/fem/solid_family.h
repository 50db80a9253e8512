/* The modes of a solid whose elastic constants are not known yet: of an isotropic one for every Poisson's ratio, of one
   whose moduli keep their ratios (a wood) for every modulus. The unknown of papers/003 section C is gamma = E/density
   (eq. 7), at one nu; here nu is free too. */
#ifndef FEM_SOLID_FAMILY_H
#define FEM_SOLID_FAMILY_H
#include "fem/boundary.h"
#include "fem/solid.h"

struct solid_family_ask {
    const struct mesh *mesh, *coarse; /* coarse: the same solid of longer cells, or the same mesh again for the order
                                         below, for the mesh's error; NULL: none */
    const struct boundary *boundary, *coarse_boundary;
    const struct solid_fixed *fixed, *coarse_fixed;
    int n_fixed, order, coarse_order, most; /* most: modes wanted */
    const struct elastic *material; /* of a given material: its moduli keep their ratios, nodes is 1; NULL: isotropic */
    double youngs_modulus;          /* Pa, of that material, the one that gamma is made of */
    const struct boundary_point *point; /* where shapes are wanted */
    int points;
};

struct solid_family {
    int n, nodes;      /* modes, one branch each; values of Poisson's ratio */
    double *nu;        /* [nodes] rising */
    double *log_ratio; /* [nodes][n] log(lambda/gamma), lambda in rad^2/s^2, gamma in m^2/s^2 */
    double *slope;     /* [nodes][n] its derivative to nu; 0 of a given material */
    double *error;     /* [n] by how much (a share) frequencies are too high, by a coarser mesh; NAN: not known */
    double *phi;       /* [nodes][points][n] mode shape along the inward normal times sqrt(density), 1/sqrt(m^3) */
    double volume;     /* m^3 */
    long freedoms;
};

/* Modes are solved for three values of nu; for any other the equations are projected on what these span
   (Rayleigh-Ritz), which costs a dense problem of a few hundred. Branches are followed from node to node by their
   shapes, through crossings. Frequencies at any nu are off by less than 1e-4 of themselves, and by up to 1e-3 where two
   branches all but cross (tests/unit/test_solid_family.c). Errors as solid_modes. */
bool solid_family_make(const struct solid_family_ask *ask, struct arena *a, struct solid_family *f, struct err *e);

/* log(lambda/gamma) [n] and its derivative to nu [n], by cubics through values and slopes; nu within that of the nodes.
 */
void solid_family_at(const struct solid_family *f, double nu, double *log_ratio, double *slope);

#endif
