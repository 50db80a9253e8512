/* One curved face: x(u, v) = sum N_i x_i, its derivatives, and the box it lies in. */
#ifndef FEM_BOUNDARY_FACE_H
#define FEM_BOUNDARY_FACE_H
#include "fem/boundary.h"

struct boundary_face_at {
    double at[3], du[3], dv[3], across[3]; /* x, dx/du, dx/dv, dx/du x dx/dv (outward, of length d area / du dv) */
};

static inline double boundary_face_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void boundary_face_at(const struct mesh *m, const int face[6], const double uv[2], struct boundary_face_at *x);

/* d2x/du2, d2x/dudv, d2x/dv2: the same in all of the face. */
void boundary_face_bend(const struct mesh *m, const int face[6], double bend[3][3]);

/* The box of the face's control points as a Bezier triangle, in whose hull it lies. */
void boundary_face_box(const struct mesh *m, const int face[6], double low[3], double high[3]);

/* Place and unit normal of a point whose face, u and v are known. */
void boundary_face_point(const struct mesh *m, const struct boundary *b, struct boundary_point *p);

/* Largest extent, m. */
double boundary_face_size(const struct boundary *b);

#endif
