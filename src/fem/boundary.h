/* The outer faces of a solid of quadratic tetrahedra: six-node triangles, corners 0 1 2 then midsides of 01 12 20,
 * counterclockwise seen from outside. */
#ifndef FEM_BOUNDARY_H
#define FEM_BOUNDARY_H
#include "file/mesh.h"

struct boundary {
    int n;
    int (*face)[6];         /* [n] indices of nodes                                  */
    double area, volume;    /* m^2, m^3, of the curved faces (volume by Gauss' theorem) */
    double outer;           /* m^2, area without the walls of closed cavities         */
    double low[3], high[3]; /* m, box of all nodes                                   */
};

/* A point of the surface. */
struct boundary_point {
    int face;
    double u, v;             /* in it: N_0 at (0, 0), N_1 at (1, 0), N_2 at (0, 1)    */
    double at[3], normal[3]; /* m; unit, outward                                      */
};

void boundary_make(const struct mesh *m, struct arena *a, struct boundary *b);

/* The six shape functions at (u, v). */
void boundary_weights(double u, double v, double w[6]);

/* Where the ray from `from` along `along` (unit) first meets the surface (nearest to `from`, whichever side it comes
   from); curved faces by Newton, to 1e-12 of the size. A ray through an edge counts for one of its faces, always the
   same. false: it misses. */
bool boundary_ray(const struct mesh *m, const struct boundary *b, const double from[3], const double along[3],
                  struct boundary_point *p);

/* The point of the surface nearest to a place; returns its distance, m. */
double boundary_nearest(const struct mesh *m, const struct boundary *b, const double place[3],
                        struct boundary_point *p);

#endif
