/* Curves in the plane. A course has a parameter of its own, P(w): of a recorded motion and of a scribble w is time in
   s, of a spline through points the length of chords in m. A path is a curve over its own length; the straight ones
   need none of this (trajectory.c). */
#ifndef TRAJECTORY_PATH_H
#define TRAJECTORY_PATH_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "trajectory/panels.h"

struct course_out {
    double *p[2], *d[2], *dd[2], *ddd[2]; /* [n] each: P and its derivatives by w; NULL: not asked for */
};

struct course {
    double end;           /* w runs from 0 to it; beyond, the formula goes on                */
    const double *breaks; /* [n_breaks] rising from 0 to end: where P''' may jump            */
    size_t n_breaks;
    void (*at)(const struct course *, size_t n, const double *w, const struct course_out *);
    const void *state;
};

/* |P'| and its derivative by w, as a slope of panels.h; self is the course. Where P' is 0 the derivative is that from
 * the right. */
void path_course_speed(const void *self, size_t n, const double *w, double *g, double *dg);

/* A hand's wandering loops. Never ends; `end` is as asked for. */
void path_scribble(struct course *, const struct motion *, uint64_t seed, double end, struct arena *);

/* Reads m->file (time_s, x_m, y_m) and smooths it at m->cutoff. The course's parameter is s after the first row; *clock
   is that row's time. Ends with the file, or earlier after the duration (s; NAN: not said). ERR_INPUT, ERR_SCENE. */
bool path_recorded(const struct motion *m, double duration, struct arena *, struct course *, double *clock,
                   struct err *);

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
