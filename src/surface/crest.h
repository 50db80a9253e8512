/* The rolling curve of papers/002, fig. 1, over ground in one coordinate: the upper envelope of a disc of radius R that
   slides over it, read by its lowest point (the path of its centre, less R),

     E(x) = max over t of z(t) + sqrt(R^2 - (x - t)^2) - R,   |x - t| <= R

   at any x, exact for ground made of polynomials between places where its height, slope and bend are known
   (crest_piece.h), or of its heights there alone. Time is linear in the number of places. */
#ifndef SURFACE_CREST_H
#define SURFACE_CREST_H
#include <stddef.h>

#include "base/arena.h"

struct crest;

struct crest_ground {
    const double *z;            /* m, at places `pitch` apart                                                     */
    const double *slope, *bend; /* 1, 1/m: first and second derivatives there; NULL: the ground is these points alone */
};

/* For windows of at most `most` places, `pitch` m apart. */
struct crest *crest_make(struct arena *a, double radius, double pitch, long most);

/* The envelope of the ground at n places, 1 <= n <= most (2 <= n of ground with slopes), the first at x = first *
 * pitch. */
void crest_set(struct crest *c, const struct crest_ground *g, long n, long first);

/* E and its slope at x[m] (m; in any order, fastest in rising order); slope may be NULL, and is that on the right at a
   kink. Where no place is within R, values mean nothing (never on a pitch of 2 R or less, between the first place and
   the last). */
void crest_at(const struct crest *c, size_t m, const double *x, double *e, double *slope);

/* What it is made of: stretches in each of which the disc rests on one piece or point. */
enum {
    CREST_FROM,
    CREST_AT,
    CREST_PIECE,
    CREST_NUMBERS = CREST_PIECE + 6
}; /* m, where it comes up; m, the piece's middle; its terms, m (crest_piece.h) */

/* The stretches from `from` to `to` (m): how many, and to *first the first, CREST_NUMBERS numbers each. */
long crest_between(const struct crest *c, double from, double to, const double **first);

/* The last of n stretches that comes up at x or before, looked for from number `hint` on. */
long crest_find(const double *stretches, long n, long hint, double x);

#endif
