/* The free vibration of an elastic solid by tetrahedra of order 2 to 4: K u = lambda M u, papers/003 section A. */
#ifndef FEM_SOLID_H
#define FEM_SOLID_H
#include "fem/boundary.h"
#include "fem/elastic.h"
#include "fem/solid_lattice.h"
#include "file/mesh.h"

enum solid_hold { SOLID_FREE, SOLID_CLAMPED, SOLID_SUPPORTED };

struct solid_held { /* faces that are held: clamped, u = 0; supported: u along the face = 0, free along its normal (a
                       hinge for what is thin) */
    int hold;       /* enum solid_hold */
    int n;
    int (*corner)[3]; /* corners of the faces, of the mesh's boundary */
};

struct solid_ask {
    const struct elastic *material;
    const struct solid_held *held;
    int n_held;
    int order;  /* of the displacement, 2 to 4; 0: 2 */
    int most;   /* modes, rigid ones not counted */
    double top; /* Hz, modes above are left out */
};

struct solid_modes {
    int n, rigid;   /* elastic modes by rising frequency; rigid motions that were dropped (6 of a free solid) */
    double *lambda; /* [n] rad^2/s^2 */
    long nodes;     /* of the displacement; of order 2 those of the mesh */
    struct solid_lattice lattice;
    const int *face; /* [boundary faces][lattice.on_face] */
    double *shape;   /* [n][nodes][3] mass-normalised, u^T M u = 1 kg m^2 (shapes in 1/sqrt(kg)) */
    double mass;     /* kg */
    double residual; /* greatest |K u - lambda M u| / |lambda M u| */
    bool all; /* every mode below `top` is there (Sylvester's count of negative pivots agrees); false: `most` were taken
               */
    long freedoms;
};

/* Rigid modes are those of lambda below 1e-6 times the lowest elastic one, and their number must be that of the rigid
   motions that what is held leaves free (found from the geometry: rank of the six rigid motions on the held freedoms),
   else ERR_NUMBERS. Shapes of equal frequencies (1e-6) are turned into a basis that depends on nothing but the
   geometry; the sign is such that the component of largest magnitude (ties to 1e-6: the first) is positive.
   ERR_NUMBERS: no convergence; ERR_SCENE: no mode below top; too large for the memory, with the number of freedoms. */
bool solid_modes(const struct mesh *m, const struct boundary *b, const struct solid_ask *ask, struct arena *a,
                 struct solid_modes *s, struct err *e);

#endif
