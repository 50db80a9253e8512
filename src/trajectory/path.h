/* A curve in the plane over its own length: path_*.c make them. The straight ones need none of this (trajectory.c). */
#ifndef TRAJECTORY_PATH_H
#define TRAJECTORY_PATH_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "trajectory/course.h"

struct path_out {    /* [n] each; NULL members are not asked for                   */
    double *p[2];    /* m, place                                                   */
    double *e[2];    /* unit tangent                                               */
    double *bend[2]; /* 1/m, de/ds                                                 */
};

struct path {
    double length;         /* m                                                          */
    size_t n_strokes;      /* the motion may rest between strokes; 1: no stops on the way */
    const double *strokes; /* [n_strokes + 1] m: where they begin and end                */
    size_t n_breaks;
    const double *breaks; /* [n_breaks] m, 0 to length: where curvature has kinks; NULL: it is the same everywhere */
    void (*at)(const struct path *, size_t n, const double *s,
               const struct path_out *); /* s in m; beyond the ends the curve goes on */
    void (*curvature)(const struct path *, size_t n, const double *s, double *square,
                      double *rate); /* kappa^2 and its derivative by s */
    const void *state;
};

enum { PATH_CHUNK = 256 };

void path_circle(struct path *, const struct motion *, struct arena *);

/* Through m->points, corners rounded to m->corner. ERR_SCENE: two points in one place, or corners without room. */
bool path_polyline(struct path *, const struct motion *, struct arena *, struct err *);

/* A natural cubic spline through m->points, by length of chords. ERR_SCENE: two points in one place, or a cusp. */
bool path_spline(struct path *, const struct motion *, struct arena *, struct err *);

/* A course over its own length. False where the course (all but) stops: *where is its parameter there. */
bool path_arc(struct path *, const struct course *, struct arena *, double *where);

#endif
