/* A contact's way over its surface in pieces: each sub-interval of the force becomes one stretch, or two where the
   motion turns, and stretches are cut at the surface's knots, so that inside a piece curvature is smooth and can be
   integrated in closed form. */
#ifndef FORCE_WAY_H
#define FORCE_WAY_H
#include "stage.h"
#include "surface/limited.h"
#include "surface/relief.h"

enum { WAY_CHUNK = 128, WAY_CHANNELS = 2, WAY_GRIDS = 16 };

/* What is limited, one or two curvatures:
     WAY_ALONG  [0] along the path, e' H e; [1], where the path is curved, e' H n   (H the surface's second derivatives)
     WAY_AXES   [0] z_xx (along the path of a profile: z''); [1], in the plane, z_yy
   e is the unit vector of increasing u, n = e turned by +90 degrees. */
enum way_kind { WAY_ALONG, WAY_AXES };

struct way_pieces {
    int n, points;
    int at[LIMITED_PIECES];        /* first point of the piece; its other end is the next one */
    int interval[LIMITED_PIECES];  /* number of the sub-interval in the chunk                 */
    int heading[LIMITED_PIECES];   /* +1 or -1: the sign of du                                */
    double length[LIMITED_PIECES]; /* m, positive                                             */
    double bulge[WAY_CHANNELS][LIMITED_PIECES];
    double x[LIMITED_POINTS], y[LIMITED_POINTS];    /* place, as the relief wants it         */
    double ex[LIMITED_POINTS], ey[LIMITED_POINTS];  /* e; (1, 0) along a path                */
    double alpha[WAY_CHANNELS][LIMITED_POINTS];     /* m                                     */
    double slope[LIMITED_POINTS];                   /* dz/du; WAY_AXES only                                    */
    double bend[LIMITED_POINTS];                    /* d2z/du2 of the surface; WAY_AXES only                   */
    double curvature[WAY_CHANNELS][LIMITED_POINTS]; /* 1/m                                   */
    double limited[WAY_CHANNELS][LIMITED_POINTS];   /* T at the points, 1/m                  */
    double mean[WAY_CHANNELS][LIMITED_PIECES];      /* of T over the piece, 1/m              */
    double moment[WAY_CHANNELS][LIMITED_PIECES];    /* as in surface/limited.h, 1/m          */
};

struct way_grid { /* one family of knots */
    int axis;     /* 0: x, 1: y */
    double pitch, origin;
};

struct way {
    enum way_kind kind;
    int channels;
    bool field;    /* the relief is read in the scene's plane, not along the path     */
    bool curved;   /* field, and the path is no straight line: places come from X, Y  */
    bool halves;   /* curvature is not a straight line between knots: pieces come in pairs, bulges known */
    bool straight; /* force/way_straight.h cuts it                                    */
    bool along;    /* and it goes along x: z_xx is what is limited                    */
    bool limiter;
    double ratio;         /* alpha of channel 1 over that of channel 0                       */
    double longest;       /* m: no piece is longer                                           */
    double from[2], e[2]; /* a straight path in the coordinates of the relief: from + u e    */
    struct way_grid grids[WAY_GRIDS];
    int n_grids;
    struct relief *relief;
    struct way_pieces pieces;
    double xx[LIMITED_POINTS], xy[LIMITED_POINTS], yy[LIMITED_POINTS];
    void (*use)(void *self, const struct way_pieces *p); /* called with limited pieces, in the order travelled */
    void *self;
};

/* longest: m, no piece is longer; use and self are the caller's to set. ERR_SCENE when the surface has too many
 * families of knots. */
bool way_make(struct way *w, struct stage_run *r, enum way_kind kind, double longest, struct err *e);

/* The part of it that is about places alone: relief, field, curved, from, e and grids. */
bool way_place(struct way *w, const struct stage_run *r, struct err *e);

/* Cuts the n <= WAY_CHUNK sub-intervals from number `first` on (since the start) and hands all their pieces to use().
 */
void way_run(struct way *w, const struct stage_run *r, long first, int n);

/* Items of the board that a stage with a way reads besides POSITION, VELOCITY and SURFACE. */
unsigned way_asks(const struct contact *c);

/* Predicted pieces per audio sample. */
double way_work(const struct contact *c, const struct scene *s);

/* Values of a sub-sampled item from sub-sample `first` on. */
static inline double *way_values(const struct board *b, enum item item, long first)
{
    return board_at(b, item, first / b->over) + first % b->over;
}

/* Sub-intervals of the next chunk of [first, last). */
static inline int way_some(long first, long last) { return (int)(last - first < WAY_CHUNK ? last - first : WAY_CHUNK); }

#endif
