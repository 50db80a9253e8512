/* How places of the plane in which scenes move lie on the surface of a solid. */
#ifndef FEM_CHART_H
#define FEM_CHART_H
#include "fem/boundary.h"

/* The side from which the solid is looked at, and what a place (x, y) is there, m:
     top, bottom     x, y: the outermost point of the surface over (under) it
     right, left     y, z: from +x, from -x
     back, front     x, z: from +y, from -y
     around          x: length of arc round the z axis, on a circle of the chart's radius, from +x towards +y; y: the
   height z; the outermost point there inside          the same, the innermost point: of what is hollow */
enum chart_face {
    CHART_TOP,
    CHART_BOTTOM,
    CHART_RIGHT,
    CHART_LEFT,
    CHART_BACK,
    CHART_FRONT,
    CHART_AROUND,
    CHART_INSIDE,
    CHART_FACES
};
extern const char *const chart_faces[CHART_FACES + 1]; /* their words, then NULL */

struct chart {
    const struct mesh *mesh;
    const struct boundary *boundary;
    int face;               /* enum chart_face                              */
    double radius;          /* m, of around and inside                      */
    double low[2], high[2]; /* m: box of the places that there may be       */
};

/* The radius is half of the solid's smaller extent along x and y (of a mug without its handle); the axis is the z axis
 * itself. */
void chart_make(const struct mesh *m, const struct boundary *b, int face, struct chart *c);

/* The point of a place; false: there is none. */
bool chart_point(const struct chart *c, double x, double y, struct boundary_point *p);

#endif
