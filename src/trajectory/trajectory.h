/* Where the contact is: the signed distance u(t) along a straight stroke from motion.from towards motion.to, and its derivatives.
   In the plane the contact is at from + u e, e the unit vector of the stroke. */
#ifndef TRAJECTORY_TRAJECTORY_H
#define TRAJECTORY_TRAJECTORY_H
#include <stddef.h>

#include "scene/scene.h"

struct trajectory {
    int path, law;
    double from[2], e[2];
    double length;     /* m between the ends                          */
    double duration;   /* s                                           */
    double rate;       /* Hz, back_and_forth                          */
    double top_speed;  /* m/s                                         */
};

struct trajectory trajectory_make(const struct motion *m);

/* Frames at that rate (Hz) that the motion touches, the one at its end or just behind it included. */
long trajectory_frames(const struct trajectory *tr, double rate);

/* u, v = du/dt, a = dv/dt at n instants (any output may be NULL). Instants before 0 and after the duration give the ends' values (v and a
   as the limits from inside). Harmonic: absolute error of u below 1e-15 + 3.5e-16 rate t of the length (the phase is one rounded product). */
void trajectory_at(const struct trajectory *tr, size_t n, const double *t, double *u, double *v, double *a);

/* Where the motion's formula puts the contact before its start and after its end (inside: as trajectory_at). For what interpolates around an
   instant: the contact itself stays at the ends. */
double trajectory_continued(const struct trajectory *tr, double t);

/* The instant in (t0, t1) at which the motion turns round, or NAN. At most one is expected between two force samples. */
double trajectory_turning(const struct trajectory *tr, double t0, double t1);

#endif
