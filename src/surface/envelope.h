/* The upper envelope of a ball that slides over heights on a square lattice, without its constant R (grey-scale
   dilation by the ball):
     E(p) = max over |d| <= R of z(p + d) + sqrt(R^2 - |d|^2) - R */
#ifndef SURFACE_ENVELOPE_H
#define SURFACE_ENVELOPE_H
#include "base/arena.h"

struct envelope;

/* For a ball of that radius (m) over `columns` x `rows` heights, `pitch` m apart in both directions; rows 1: in one
 * coordinate. */
struct envelope *envelope_make(struct arena *a, double radius, double pitch, long columns, long rows);

/* The heights, m, in rows that begin `stride` numbers apart: to be written, then envelope_prepare. */
double *envelope_heights(struct envelope *e, long *stride);
void envelope_prepare(struct envelope *e);

/* E at a lattice point, m, over the heights there are, and the place of the height that the ball touches (of several
   the first row's, and there the first column's). The very same whatever was asked before. Fast when neighbours are
   asked for one after the other. */
double envelope_at(struct envelope *e, long column, long row, long place[2]);

#endif
