/* The free vibration of an elastic solid by tetrahedra of order 2 to 4: K u = lambda M u, papers/003 section A. */
#ifndef FEM_SOLID_H
#define FEM_SOLID_H
#include "fem/boundary.h"
#include "fem/solid_element.h"
#include "file/mesh.h"

enum solid_hold { SOLID_FREE, SOLID_CLAMPED, SOLID_SUPPORTED };

struct solid_fixed { /* faces that are held: clamped, u = 0; supported: u along the face = 0, free along its normal (a
                       hinge for what is thin) */
    int hold;        /* enum solid_hold */
    int n;
    int (*corner)[3]; /* corners of the faces, of the mesh's boundary */
};

struct solid_ask {
    const struct elastic *material;
    const struct solid_fixed *fixed;
    int n_fixed;
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

/* Mode shapes where the surface is touched: phi[s->n], 1/sqrt(kg): displacement of each mode along the inward normal,
 * that of a force that presses. */
void solid_participation(const struct solid_modes *s, const struct boundary_point *p, double *phi);

/* How far the modes of a mesh are off, from those of a coarser mesh of the same solid. */
struct solid_side {
    const struct mesh *mesh;
    const struct boundary *boundary;
    const struct solid_modes *modes;
};

struct solid_estimate {
    double ratio;  /* of the cells' lengths, coarse to fine (mean of the elements' longest edges); 1: the same mesh */
    double share;  /* of the difference, 1/(ratio^4 - 1); of the same mesh 1 */
    double *error; /* [fine modes] (f - f_true)/f, about; NAN: none of the coarse modes moves alike */
    int unpaired;
    double median, most; /* of |error|, of those paired; NAN: none is */
    int worst;           /* which is `most` */
};

/* Richardson's extrapolation, mode by mode: error = (f_coarse - f)/f/(ratio^4 - 1), as if frequencies fell with the
 * fourth power of the cells' length. See solid.c for what that is worth. */
void solid_estimate(const struct solid_side *fine, const struct solid_side *coarse, struct arena *a,
                    struct solid_estimate *s);

#endif
