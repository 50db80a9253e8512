/* Places on which something is known, on a line or in the plane, and how a point between them is made of its neighbours. */
#ifndef RESPONSE_PLACES_H
#define RESPONSE_PLACES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

enum places_kind { PLACES_ONE, PLACES_LINE, PLACES_PLANE };

struct places;

struct places_mix {         /* barycentric: x = sum weight[k] x_{index[k]}, weights >= 0, sum 1 */
    int n, index[3];
    double weight[3];
};

/* xy: [n][2] m, n >= 1, different points (copied). Within 1e-9 m of one line: a line; else Delaunay's triangulation. ERR_SCENE: two
   places at the same point, *bad one of them and the text what it does ("is at the same point as another place"); or no triangulation,
   *bad -1. */
bool places_make(struct arena *a, int n, const double *xy, struct places **p, int *bad, struct err *e);
enum places_kind places_kind(const struct places *p);

/* The mix at a point; off the hull that of the hull's nearest point. Returns how far off it is (m), 0 within 1e-9 m; one place alone holds
   everywhere: 0. */
double places_at(const struct places *p, double x, double y, struct places_mix *mix);

/* Where they lie, for a message: "its places lie on 0 <= x <= 40 cm, y = 3.7 cm"; of a slanting line its two ends, of the plane a box that holds them. */
const char *places_told(const struct places *p, struct arena *a);

/* Parameters u in (0, 1), increasing, at which the straight way from `from` to `to` passes from one simplex to the next (kinks of linear
   interpolation), off the hull those of its nearest point; writes the first `most`, returns how many there are. Some may be none: where
   the way goes through a place, or along an edge. */
int places_kinks(const struct places *p, const double from[2], const double to[2], double *u, int most);

/* Neighbours: the edges of the triangulation (of a line: from place to place). Returns their number; (*edge)[k] = two indices. */
int places_edges(const struct places *p, const int (**edge)[2]);

#endif
