/* Places on the crossings of lines: a grid, or a line, which is a grid of one row. The part of places.h that is not
 * triangles. */
#ifndef RESPONSE_PLACES_LATTICE_H
#define RESPONSE_PLACES_LATTICE_H
#include "base/arena.h"
#include "response/places.h"

struct places_lattice;

/* Of n places xy [n][2], in the order order[n] of the caller's (what mixes and edges name), with the axes `axis` (a
   unit vector) and its left normal, which start at `base`: the grid whose crossings they are, each once, to `same` (m)
   across its lines; NULL: they are none. one_row: a line along the axis, whatever lies beside it. */
struct places_lattice_ask {
    int n;
    const double *xy;
    const int *order;
    const double *base, *axis;
    double same;
    bool one_row;
};
struct places_lattice *places_lattice_make(struct arena *a, const struct places_lattice_ask *ask);

/* As places_at, places_smooth_at, places_fill, places_rows, places_edges. */
double places_lattice_at(const struct places_lattice *l, double x, double y, struct places_mix *mix);
double places_lattice_smooth_at(const struct places_lattice *l, double x, double y, struct places_sum *sum);
int places_lattice_rows(const struct places_lattice *l);
void places_lattice_fill(const struct places_lattice *l, int n, double *rows);
int places_lattice_edges(const struct places_lattice *l, const int (**edge)[2]);

/* The line's first and last place, as the caller's indices. */
void places_lattice_ends(const struct places_lattice *l, int ends[2]);

#endif
