/* Places on which something is known, on a line, a grid or anywhere in the plane, and how a point between them is made
   of its neighbours. Nothing depends on the order in which they are given. */
#ifndef RESPONSE_PLACES_H
#define RESPONSE_PLACES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

enum places_kind { PLACES_ONE, PLACES_LINE, PLACES_GRID, PLACES_PLANE };

struct places;

struct places_mix { /* x = sum weight[k] x_{index[k]}, weights >= 0, sum 1; one place, two, a triangle's or a cell's
                       corners in turn */
    int n, index[4];
    double weight[4];
};

struct places_sum { /* of rows as places_fill makes them */
    int n, index[16];
    double weight[16];
};

/* xy: [n][2] m, n >= 1, different points (copied). Within 1e-9 m of one line: a line; the crossings of two sets of
   parallel lines, at right angles, each once and to 1e-4 of their extent: a grid; else the plane, with
   Delaunay's triangulation, and, if they are such, rings round a centre (places_smooth.h).
   ERR_SCENE: two places at the same point, *bad the later of them and the text what it does ("is at the same point as
   another place: remove one ..."); or no triangulation, *bad -1. */
bool places_make(struct arena *a, int n, const double *xy, struct places **p, int *bad, struct err *e);

enum places_kind places_kind(const struct places *p);

/* The mix at a point, linear along lines and edges: on a grid bilinear. Off the hull that of the hull's nearest point.
   Returns how far off it is (m), 0 within 1e-9 m; one place alone holds everywhere: 0. */
double places_at(const struct places *p, double x, double y, struct places_mix *mix);

/* The smooth interpolation: cubic splines on lines and grids (places_smooth.c says when) and on rings round a centre
   (places_smooth.c), else the mix. It takes rows[places_rows()][n], of which the first [places][n] are the values at
   the places; places_fill computes the others (their slopes) once. Then the value at a point is sum weight[k]
   rows[index[k]][]. Returns as places_at; of rings the hull is the outermost's circle. */
bool places_smooth(const struct places *p); /* is it another than the mix? */

int places_rows(const struct places *p);

void places_fill(const struct places *p, int n, double *rows);

double places_smooth_at(const struct places *p, double x, double y, struct places_sum *sum);

/* Where they lie, for a message: "its places lie on 0 <= x <= 40 cm, y = 3.7 cm"; of a slanting line its two ends, of
 * the plane a box that holds them. */
const char *places_text(const struct places *p, struct arena *a);

/* Neighbours: the edges of the triangulation, on lines and grids from place to place along the lines. Returns their
 * number; (*edge)[k] = two indices. */
int places_edges(const struct places *p, const int (**edge)[2]);

#endif
