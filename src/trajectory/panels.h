/* A function that is known by its slope alone, as quintic pieces: an integral, or the inverse of one. */
#ifndef TRAJECTORY_PANELS_H
#define TRAJECTORY_PANELS_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

enum { PANELS_BLOCK = 64 };

struct panels_piece {
    double edge; /* where it begins                                      */
    double c[6]; /* value at edge + q (next edge - edge): sum of c_j q^j */
};

struct panels {
    size_t n, room;              /* pieces; blocks there is room for */
    double end;                  /* the last edge                    */
    struct panels_piece **block; /* of PANELS_BLOCK pieces     */
};

/* Piece i < n, and edge i <= n. */
static inline const struct panels_piece *panels_piece(const struct panels *p, size_t i)
{
    return &p->block[i / PANELS_BLOCK][i % PANELS_BLOCK];
}

static inline double panels_edge(const struct panels *p, size_t i)
{
    return i < p->n ? panels_piece(p, i)->edge : p->end;
}

/* The slope g at n places, and its derivative dg; g >= 0 where an inverse is asked for. */
struct panels_slope {
    void (*at)(const void *self, size_t n, const double *x, double *g, double *dg);
    const void *self;
};

/* f(x) = integral of g from breaks[0] to x. breaks[n_breaks >= 2], rising: where g' may jump; also where bisection
 * begins. */
void panels_integral(const struct panels_slope *slope, const double *breaks, size_t n_breaks, struct arena *a,
                     struct panels *p);

/* x as a function of that integral. False, and *where is the place, if g is not above `least`. */
bool panels_inverse(const struct panels_slope *slope, const double *breaks, size_t n_breaks, double least,
                    struct arena *a, struct panels *p, double *where);

/* f and its first two derivatives (NULL: not asked for) at n places x, in any order, fastest in rising order; x is held
 * in the range. */
void panels_at(const struct panels *p, size_t n, const double *x, double *f, double *df, double *ddf);

/* The value at the last edge. */
double panels_last(const struct panels *p);

#endif
