/* What a solid is made of: Hooke's law in three dimensions. */
#ifndef FEM_ELASTIC_H
#define FEM_ELASTIC_H
#include <stdbool.h>

#include "base/err.h"

struct elastic {
    double c[6][6]; /* Pa, stresses xx yy zz yz zx xy of strains (engineering shear); symmetric, positive definite */
    double density; /* kg/m^3 */
};

/* Isotropic. ERR_USAGE: E or density not above 0, nu not in (-1, 0.5). */
bool elastic_isotropic(double youngs_modulus, double poisson, double density, struct elastic *s, struct err *e);

struct elastic_wood { /* orthotropic: x along the grain (L), y tangential (T), z radial (R), a flat-sawn board */
    double e[3];      /* Pa, along x, y, z */
    double g[3];      /* Pa, of the planes yz, zx, xy */
    double nu[3];     /* Poisson's ratios nu_yz (pull along y, contraction along z), nu_xz, nu_xy */
    double density;
};

/* ERR_USAGE: not positive definite. */
bool elastic_orthotropic(const struct elastic_wood *w, struct elastic *s, struct err *e);

#endif
