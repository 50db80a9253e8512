/* A curve in the plane with a parameter of its own, P(w): of a recorded motion and of a scribble w is time in s, of a
   spline through points the length of chords in m. */
#ifndef TRAJECTORY_COURSE_H
#define TRAJECTORY_COURSE_H
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
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

enum { COURSE_CHUNK = 256 };

/* |P'| and its derivative by w, as a slope of panels.h; self is the course. Where P' is 0 the derivative is that from
 * the right. */
void course_speed(const void *self, size_t n, const double *w, double *g, double *dg);

/* Natural cubic spline through p[n][2] at rising knots[n >= 2]; straight beyond its ends. */
void course_cubic(struct course *, size_t n, const double *knots, const double (*p)[2], struct arena *);

/* Ends a course at `end`, before its own. */
void course_cut(struct course *, double end, struct arena *);

/* A hand's wandering loops: course_scribble.c. Never ends; `end` is as asked for. */
void course_scribble(struct course *, const struct motion *, uint64_t seed, double end, struct arena *);

#endif
