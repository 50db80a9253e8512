/* The limited curvature along a contact's way over a profile, in pieces over which it can be integrated in closed form. */
#ifndef SURFACE_CURVATURE_H
#define SURFACE_CURVATURE_H
#include <stdbool.h>

#include "base/arena.h"
#include "surface/profile.h"

enum { CURVATURE_PIECES = 512, CURVATURE_KNOTS = 1024 };

struct curvature_way {       /* how a stroke lies on a profile: q = offset + scale u */
    struct profile *profile;
    double offset, scale;    /* m, direction cosine in [-1, 1]          */
    double longest;          /* m of u: pieces are no longer than this  */
    long first;              /* knots held: first .. first + CURVATURE_KNOTS - 1; LONG_MIN: none */
    double *slope, *bend, *work;
};

/* Pieces between points k and k + 1; the pieces of one stretch chain. */
struct curvature_pieces {
    int n, points;
    int at[CURVATURE_PIECES];            /* first point of the piece                        */
    int interval[CURVATURE_PIECES];      /* the caller's mark                               */
    int heading[CURVATURE_PIECES];       /* +1 or -1: the sign of du                        */
    double length[CURVATURE_PIECES];     /* m of u, positive                                */
    double alpha[2 * CURVATURE_PIECES];  /* m, of the point                                 */
    double bend[2 * CURVATURE_PIECES];   /* z''(q), 1/m                                     */
    double slope[2 * CURVATURE_PIECES];  /* z'(q)                                           */
    double limited[2 * CURVATURE_PIECES];/* T at the point, 1/m                             */
    double mean[CURVATURE_PIECES];       /* mean of T over the piece, 1/m                   */
    double moment[CURVATURE_PIECES];     /* integral of (s - middle) T ds / length^2, 1/m   */
};

/* One stretch without a turn, from u0 to u1, being cut into pieces. */
struct curvature_stretch {
    double u, end;   /* m of u: where the stretch begins and ends */
    double alpha;
    int interval;
    bool cut;        /* begun, and going on from knot coordinate q */
    double q;
};

struct curvature_way curvature_way_make(struct arena *a, struct profile *p, double offset, double scale, double longest);

/* Adds the stretch's pieces; false when there is no room for all: use the pieces, empty them (n = points = 0), call again. */
bool curvature_cut(struct curvature_way *w, struct curvature_stretch *s, struct curvature_pieces *p);

/* Fills limited[], mean[] and moment[] for T(factor z''), T(c) = tanh(alpha c) / alpha, or T(c) = c when limiter is false. */
void curvature_limit(struct curvature_pieces *p, double factor, bool limiter);

#endif
