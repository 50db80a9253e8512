/* Values and derivatives of a tensor-product cubic B-spline at many places at once. A batch of points is laid out as
   vector loops want it: the share of its cell that each point has covered, and the 16 coefficients about it. */
#ifndef SURFACE_BICUBIC_H
#define SURFACE_BICUBIC_H
#include <stdbool.h>

#include "num/lanes.h"
#include "surface/relief.h"

enum { BICUBIC_POINTS = 64, BICUBIC_ROOM = BICUBIC_POINTS + LANES };

struct bicubic {
    int n;
    double column[BICUBIC_POINTS], row[BICUBIC_POINTS]; /* the cell: whole numbers                     */
    double f[BICUBIC_POINTS], g[BICUBIC_POINTS];        /* shares of it, in [0, 1)                     */
    double c[16][BICUBIC_ROOM];                         /* [4 row + column]                            */
    double z[BICUBIC_POINTS], x[BICUBIC_POINTS], y[BICUBIC_POINTS], xx[BICUBIC_POINTS], xy[BICUBIC_POINTS],
        yy[BICUBIC_POINTS];
};

/* Cells and shares of n points p, q, in pitches (finite, below 2^51), n <= BICUBIC_POINTS. */
void bicubic_cells(struct bicubic *b, int n, const double *p, const double *q);

/* The end of the run of points from i on that lie in the cell of i. */
static inline int bicubic_run(const struct bicubic *b, int i)
{
    int end = i + 1;
    while (end < b->n && b->column[end] == b->column[i] && b->row[end] == b->row[i])
        end++;
    return end;
}

/* The coefficients of points i to end - 1: from[0 .. 3], and three rows more, `stride` numbers apart. To be called in
   rising order: what lies behind end is overwritten. */
void bicubic_put(struct bicubic *b, int i, int end, const double *from, long stride);

/* The end of the points from i on that lie each in the next cell of its row; at most LANES of them. */
static inline int bicubic_row(const struct bicubic *b, int i)
{
    int end = i + 1;
    while (end < b->n && end < i + LANES && b->column[end] == b->column[end - 1] + 1 && b->row[end] == b->row[i])
        end++;
    return end;
}

/* The same of up to LANES points that bicubic_row counts: from[0 .. LANES + 2], and three rows more. */
void bicubic_put_row(struct bicubic *b, int i, const double *from, long stride);

/* sum of c[j][k] B(f - k) B(g - j) and its derivatives per pitch (across columns u, rows v: both 1/m) into z ... yy:
   all that v asks for, the rest perhaps too. A value has the same bits whatever else is asked for. */
void bicubic_sum(struct bicubic *b, double u, double v, const struct relief_values *asked);

#endif
