/* Cubic splines on knots at any distances, as far as their knots alone decide: the slopes at the knots of what is known
 * there. */
#ifndef RESPONSE_PLACES_SMOOTH_H
#define RESPONSE_PLACES_SMOOTH_H
#include "base/arena.h"
#include "response/places.h"

struct places_spline {
    int n;                         /* knots                                                                  */
    double *step;                  /* [n - 1] distances                                                      */
    double *below, *pivot, *above; /* [n] the slopes' equations, eliminated: row k less below[k] of row k - 1 */
};

/* at[n], increasing, n >= 3. */
struct places_spline places_smooth_spline_make(struct arena *a, int n, const double *at);

/* Slopes m[k][count] at the knots from the values f[k][count]. */
void places_smooth_spline_slopes(const struct places_spline *s, int count, const double *const *f, double *const *m);

/* How many times as large as the values' largest error the spline's may become, at eighths of the intervals. */
double places_smooth_spline_grows(const struct places_spline *s, struct arena *a);

/* Where they are so uneven that an error may come out more than so many times as large, all that is made of places
 * stays linear. */
#define PLACES_SMOOTH_SPLINE_GROWS 6.0

/* Places on the crossings of lines: a grid, or a line, which is a grid of one row. The part of places.h that is not
 * triangles. */
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

struct places_lattice *places_smooth_lattice_make(struct arena *a, const struct places_lattice_ask *ask);

/* As places_at, places_smooth_at, places_fill, places_rows, places_edges. */
double places_smooth_lattice_at(const struct places_lattice *l, double x, double y, struct places_mix *mix);

double places_smooth_lattice_smooth_at(const struct places_lattice *l, double x, double y, struct places_sum *sum);

int places_smooth_lattice_rows(const struct places_lattice *l);

void places_smooth_lattice_fill(const struct places_lattice *l, int n, double *rows);

int places_smooth_lattice_edges(const struct places_lattice *l, const int (**edge)[2]);

/* Places on rings round a centre: the part of places.h that is smooth where places are round. */
struct places_rings;

/* Of n places xy [n][2], in the order order[n] of the caller's: the rings that they make, each of RINGS_LEAST or more
   places at equal angles, to `same` (m), round the mean of all places, and maybe one place in the middle; NULL: they
   make none. */
enum { PLACES_RINGS_LEAST = 5 };

struct places_rings *places_smooth_rings_make(struct arena *a, int n, const double *xy, const int *order, double same);

/* As places_rows, places_fill, places_smooth_at. */
int places_smooth_rings_rows(const struct places_rings *p);

void places_smooth_rings_fill(const struct places_rings *p, int n, double *rows);

double places_smooth_rings_smooth_at(const struct places_rings *p, double x, double y, struct places_sum *sum);

#endif
