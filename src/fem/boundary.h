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
    double (*box)[2][3];    /* [n] m, of each face: lowest and highest corner        */
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

/* One curved face: x(u, v) = sum N_i x_i, and its derivatives. */
struct boundary_face_at {
    double at[3], du[3], dv[3], across[3]; /* x, dx/du, dx/dv, dx/du x dx/dv (outward, of length d area / du dv) */
};

static inline double boundary_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void boundary_cross(const double x[3], const double y[3], double z[3])
{
    for (int k = 0; k < 3; k++)
        z[k] = x[(k + 1) % 3] * y[(k + 2) % 3] - x[(k + 2) % 3] * y[(k + 1) % 3];
}

void boundary_face_at(const struct mesh *m, const int face[6], const double uv[2], struct boundary_face_at *x);

/* How places of the plane in which scenes move lie on the surface of a solid.
   The side from which the solid is looked at, and what a place (x, y) is there, m:
     top, bottom     x, y: the outermost point of the surface over (under) it
     right, left     y, z: from +x, from -x
     back, front     x, z: from +y, from -y
     around          x: length of arc round the z axis, on a circle of the map's radius, from +x towards +y; y: the
   height z; the outermost point there inside          the same, the innermost point: of what is hollow */
enum boundary_side {
    BOUNDARY_TOP,
    BOUNDARY_BOTTOM,
    BOUNDARY_RIGHT,
    BOUNDARY_LEFT,
    BOUNDARY_BACK,
    BOUNDARY_FRONT,
    BOUNDARY_AROUND,
    BOUNDARY_INSIDE,
    BOUNDARY_SIDES
};

extern const char *const boundary_map_sides[BOUNDARY_SIDES + 1]; /* their words, then NULL */

struct boundary_map {
    const struct mesh *mesh;
    const struct boundary *boundary;
    int face;               /* enum boundary_side                              */
    double radius;          /* m, of around and inside                      */
    double low[2], high[2]; /* m: box of the places that there may be       */
};

/* The radius is half of the solid's smaller extent along x and y (of a mug without its handle); the axis is the z axis
 * itself. */
void boundary_map_make(const struct mesh *m, const struct boundary *b, int face, struct boundary_map *c);

/* The point of a place; false: there is none. */
bool boundary_map_point(const struct boundary_map *c, double x, double y, struct boundary_point *p);

#endif
