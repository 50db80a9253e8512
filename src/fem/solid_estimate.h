/* How far the modes of a mesh are off, from those of a coarser mesh of the same solid. */
#ifndef FEM_SOLID_ESTIMATE_H
#define FEM_SOLID_ESTIMATE_H
#include "fem/solid.h"

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
 * fourth power of the cells' length. See solid_estimate.c for what that is worth. */
void solid_estimate(const struct solid_side *fine, const struct solid_side *coarse, struct arena *a,
                    struct solid_estimate *s);

#endif
