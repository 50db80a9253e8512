/* Mode shapes where the surface of a solid is touched. */
#ifndef FEM_TOUCH_H
#define FEM_TOUCH_H
#include "fem/solid.h"

/* phi[s->n], 1/sqrt(kg): displacement of each mode along the inward normal, that of a force that presses. */
void touch_shapes(const struct solid_modes *s, const struct boundary_point *p, double *phi);

#endif
