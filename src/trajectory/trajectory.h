/* Where the contact is at any instant: the signed distance u along the path, the place in the plane, and their
   derivatives.

   A path is a curve (path.h); a speed law moves the contact along it (speed.h). Recorded motions and scribbles have
   times of their own (path.h). u is 0 where the motion starts and grows along the path; on back_and_forth, and on an
   incline on which it comes back, it goes back to 0 on the way back, on all other paths it never falls. On straight
   paths (back_and_forth, line, four_in_line, incline, still: motion_straight()) the place is from + u e; of what is
   still, u is 0 and e is +x. Other paths are taken as curved even where they happen to have no curve. */
#ifndef TRAJECTORY_TRAJECTORY_H
#define TRAJECTORY_TRAJECTORY_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"

struct trajectory_state;

struct trajectory {
    bool straight;
    double from[2], e[2]; /* start; unit vector of a straight path, of a curved one that at the start */
    double length;        /* m, of the path (back_and_forth: between its ends)   */
    double duration;      /* s                                                  */
    double top_speed;     /* m/s, largest |du/dt|                               */
    double mean_speed;    /* m/s, distance travelled over duration              */
    double box[2][2];     /* m: least and greatest x, y that the motion reaches */
    double reach[2];      /* m: least and greatest u                            */
    double lap;           /* m, once round a circle; of what is none, beyond bounds */
    bool starts_at_rest, ends_at_rest;
    double clock;                         /* s: what a recording's own time says at the start; else 0 */
    double cycle;                         /* s, after which the motion repeats itself; else the duration */
    long detail;                          /* instants of a cycle that show all of its shape (for series_range) */
    const struct trajectory_state *state; /* the path's and the law's own         */
};

struct trajectory_out { /* [n] each, SI; NULL: not asked for */
    double *u, *du, *ddu;
    double *x, *y, *vx, *vy, *ax, *ay;
};

/* The seed of a contact's scribble: two contacts of one scene do not draw the same. */
uint64_t trajectory_seed(const struct scene *s, const struct contact *c);

/* Reads what files the motion names. seed: trajectory_seed, of a scribble. Errors: ERR_INPUT, ERR_SCENE. */
bool trajectory_make(const struct motion *m, uint64_t seed, struct arena *a, struct trajectory *tr, struct err *e);

/* Frames at that rate (Hz) that the motion touches, the one at its end or just behind it included. */
long trajectory_frames(const struct trajectory *tr, double rate);

/* At n instants t (s after the contact's start). Instants before 0 and after the duration give the ends' values
   (derivatives as the limits from inside). Errors of position are below 1e-12 m (and 2^-52 of u); derivatives are those
   of the very function that gives the position. Thread-safe; any order, fastest in order of time. */
void trajectory_at(const struct trajectory *tr, size_t n, const double *t, struct trajectory_out out);

/* Where the motion's formula puts the contact before its start and after its end (inside: as trajectory_at): x, y in m.
   For what interpolates around an instant: the contact itself stays at the ends. */
void trajectory_continued(const struct trajectory *tr, double t, double place[2]);

/* The instant in (t0, t1) at which the motion turns round on itself, or NAN: its velocity passes through 0 (or so near
   to it that between t0 and t1 the direction turns by more than 90 degrees) and is then of opposite direction. At most
   one is expected between two force samples. */
double trajectory_turning(const struct trajectory *tr, double t0, double t1);

#endif
