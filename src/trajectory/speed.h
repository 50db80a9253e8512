/* How far along a path the motion is at time t. */
#ifndef TRAJECTORY_SPEED_H
#define TRAJECTORY_SPEED_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "trajectory/path.h"

struct speed {
    double duration; /* s                                                     */
    double top;      /* m/s, largest                                          */
    double distance; /* m, travelled in the duration                          */
    double reach[2]; /* m, least and greatest u                               */
    double cycle;    /* s, after which it repeats itself; else the duration   */
    long detail;     /* instants of a cycle that show all of its shape        */
    void (*at)(const struct speed *, size_t n, const double *t, double *u, double *du,
               double *ddu); /* [n] each, NULL: not asked for;
               before 0 and after the duration the formula goes on */
    double (*turning)(const struct speed *, double t0,
                      double t1); /* instant in (t0, t1) at which u turns back, or NAN; NULL: never */
    const void *state;
};

/* harmonic, constant, minimum_jerk (two_thirds where curvature does not vary), over each of the path's strokes in turn.
 */
void speed_strokes(struct speed *, int law, const struct path *, double duration, struct arena *);

/* The same there and back between u = 0 and length, 2 rate strokes a second. */
void speed_strokes_folded(struct speed *, int law, double length, double rate, double duration, struct arena *);

/* At rest at u = 0 all the time. */
void speed_still(struct speed *, double duration);

/* v in proportion to (kappa^2 + 1 / straight^2)^(-1/6) over the whole path. */
void speed_two_thirds(struct speed *, const struct path *, double straight, double duration, struct arena *);

/* Free motion on a slope: motion.h. ERR_SCENE: motion_incline_can. */
bool speed_incline(struct speed *, const struct motion *, struct arena *, struct err *);

/* A table of speed over time (CSV). fold: m after which it turns back; NAN: it does not. ERR_INPUT, ERR_SCENE. */
bool speed_given(struct speed *, const char *file, double fold, struct arena *, struct err *);

/* Ends a table's way at the path's end. ERR_SCENE when it leads beyond that by more than 1e-6 of it. */
bool speed_given_ends(struct speed *, double length, const char *file, struct err *);

#endif
