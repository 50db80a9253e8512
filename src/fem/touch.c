/* See touch.h. */
#include "fem/touch.h"

void touch_shapes(const struct solid_modes *s, const struct boundary_point *p, double *phi)
{
    double w[SOLID_LATTICE_FACE];
    const int nodes = s->lattice.on_face, *face = s->face + (long)p->face * nodes;
    solid_lattice_face(&s->lattice, p->u, p->v, w);
    for (int i = 0; i < s->n; i++) {
        phi[i] = 0;
        for (int k = 0; k < nodes; k++) {
            const double *u = s->shape + 3 * (s->nodes * i + face[k]);
            phi[i] -= w[k] * (u[0] * p->normal[0] + u[1] * p->normal[1] + u[2] * p->normal[2]);
        }
    }
}
