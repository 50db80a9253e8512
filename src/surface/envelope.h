/* The upper envelope of a ball that slides over heights on an endless square lattice, without its constant R
   (grey-scale dilation by the ball):
     E(p) = max over |d| <= R of z(p + d) + sqrt(R^2 - |d|^2) - R */
#ifndef SURFACE_ENVELOPE_H
#define SURFACE_ENVELOPE_H
#include "base/arena.h"

struct envelope;

enum { ENVELOPE_HEIGHTS = 64, ENVELOPE_POINTS = 16 }; /* a side of the squares in which heights are asked for, and E */

/* Writes the heights, m, of square (column, row), one row after the other; they must depend on nothing else. */
typedef void envelope_heights(void *self, long column, long row, double *z);

/* For a ball of that radius, m, over heights `pitch` m apart, of which it touches none further away than `reach` of
 * them; E is asked for at every `finer`-th of them, from the one at (0, 0) on. */
struct envelope *envelope_make(struct arena *a, double radius, double pitch, long reach, long finer,
                               envelope_heights *heights, void *self);

/* At the points of square (column, row), one row after the other: E, m, over the heights within reach, and the height
   that the ball touches (of several the first row's, and there the first column's), counted from (0, 0). The very same
   whatever was asked before. */
void envelope_square(struct envelope *e, long column, long row, double *reached, long (*places)[2]);

/* The side of the square of heights that are looked at for a square of points. */
long envelope_side(long reach, long finer);

#endif
