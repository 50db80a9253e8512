/* A contact's path over its surface in cells: each sub-interval of the force becomes one stretch, or two where the
   motion turns, and stretches are cut at the surface's knots, so that inside a cell curvature is smooth and can be
   integrated in closed form. */
#ifndef FORCE_PATH_CELLS_H
#define FORCE_PATH_CELLS_H
#include "stage.h"
#include "surface/limiter.h"
#include "surface/relief.h"

enum { CELLS_CHUNK = 128, CELLS_CHANNELS = 2, CELLS_KNOTS = 16 };

/* What is limited, one or two curvatures:
     CELLS_ALONG  [0] along the path, e' H e; [1], where the path is curved, e' H n
     CELLS_AXES   [0] z_xx (along the path of a profile: z''); [1], in the plane, z_yy
   H are the surface's second derivatives, e is the unit vector of increasing u, n = e turned by +90 degrees. */
enum cells_kind { CELLS_ALONG, CELLS_AXES };

struct cells {
    int n, points;
    int at[LIMITER_CELLS];        /* first point of the cell; its other end is the next one */
    int interval[LIMITER_CELLS];  /* number of the sub-interval in the chunk                 */
    int heading[LIMITER_CELLS];   /* +1 or -1: the sign of du                                */
    double length[LIMITER_CELLS]; /* m, positive                                             */
    double sagitta[CELLS_CHANNELS][LIMITER_CELLS];
    double x[LIMITER_POINTS], y[LIMITER_POINTS];      /* place, as the relief wants it         */
    double ex[LIMITER_POINTS], ey[LIMITER_POINTS];    /* e; (1, 0) along a path                */
    double alpha[CELLS_CHANNELS][LIMITER_POINTS];     /* m                                     */
    double slope[LIMITER_POINTS];                     /* dz/du; CELLS_AXES only                                    */
    double bend[LIMITER_POINTS];                      /* d2z/du2 of the surface; CELLS_AXES only                   */
    double curvature[CELLS_CHANNELS][LIMITER_POINTS]; /* 1/m                                   */
    double limited[CELLS_CHANNELS][LIMITER_POINTS];   /* T at the points, 1/m                  */
    double mean[CELLS_CHANNELS][LIMITER_CELLS];       /* of T over the cell, 1/m              */
    double moment[CELLS_CHANNELS][LIMITER_CELLS];     /* as in surface/limiter.h, 1/m          */
};

struct knot_lines { /* one family of knots */
    int axis;       /* 0: x, 1: y */
    double pitch, origin, per; /* m; 1/pitch */
};

struct path_cells {
    enum cells_kind kind;
    int channels;
    bool field;  /* the relief is read in the scene's plane, not along the path     */
    bool curved; /* field, and the path is no straight line: places come from X, Y  */
    bool halves; /* curvature is not a straight line between knots: cells come in pairs, bulges known */
    bool along;  /* and it goes along x: z_xx is what is limited                    */
    bool limiter;
    double ratio;         /* alpha of channel 1 over that of channel 0                       */
    double longest;       /* m: no cell is longer                                           */
    double from[2], e[2]; /* a straight path in the coordinates of the relief: from + u e    */
    struct knot_lines knots[CELLS_KNOTS];
    int n_knots;
    struct relief *relief;
    struct cells cells;
    double xx[LIMITER_POINTS], xy[LIMITER_POINTS], yy[LIMITER_POINTS];
    void (*integrate)(void *self, const struct cells *p); /* called with limited cells, in the order travelled */
    void *self;
};

/* longest: m, no cell is longer; integrate and self are the caller's to set. ERR_SCENE when the surface has too many
 * families of knots. */
bool path_cells_make(struct path_cells *w, struct stage_run *r, enum cells_kind kind, double longest, struct err *e);

/* The part of it that is about places alone: relief, field, curved, from, e and knots. */
bool path_cells_place(struct path_cells *w, const struct stage_run *r, struct err *e);

/* Cuts the n <= CELLS_CHUNK sub-intervals from number `first` on (since the start) and hands all their cells to
   integrate(). */
void path_cells_run(struct path_cells *w, const struct stage_run *r, long first, int n);

/* Items of the board that a stage with a path reads besides POSITION, VELOCITY and SURFACE. */
unsigned path_cells_asks(const struct contact *c, const struct scene *s);

/* Predicted per audio sample: knots of one family, in its finest pitch, and cells. */
double path_cells_knots(const struct contact *c, const struct scene *s);
double path_cells_work(const struct contact *c, const struct scene *s);

/* Values of a sub-sampled item from sub-sample `first` on. */
static inline double *cells_values(const struct board *b, enum item item, long first)
{
    return board_at(b, item, first / b->over) + first % b->over;
}

/* Sub-intervals of the next chunk of [first, last). */
static inline int cells_chunk(long first, long last)
{
    return (int)(last - first < CELLS_CHUNK ? last - first : CELLS_CHUNK);
}

#endif
