/* The rolling curve of papers/002, fig. 1, over heights in one coordinate, exact: the upper envelope of a disc of radius R that slides over them, read
   by its lowest point (the path of its centre, less R),

     E(x) = max over i of z_i + sqrt(R^2 - (x - x_i)^2) - R,   |x - x_i| <= R

   at any x, not only at the lattice. Two arcs of one radius cross once, so that the envelope is a row of arcs found in one pass: time linear in the number of heights. */
#ifndef SURFACE_CREST_H
#define SURFACE_CREST_H
#include "base/arena.h"
#include "surface/relief.h"

struct crest;

/* For windows of at most `most` heights, `pitch` m apart. */
struct crest *crest_make(struct arena *a, double radius, double pitch, long most);

/* The envelope of z[n], 1 <= n <= most, z[0] at x = first * pitch. */
void crest_set(struct crest *c, const double *z, long n, long first);

/* E and its slope at x[m] (m; in any order, fastest in rising order); slope may be NULL, and is that of the arc on the right at a kink. Where no height
   is within R, values mean nothing (never on a pitch of 2 R or less, between the first height and the last). */
void crest_at(const struct crest *c, size_t m, const double *x, double *e, double *slope);

struct crest_plan {
    double radius;          /* m                                                                               */
    double pitch;           /* m between heights, which lie at its multiples; at most 2 R but for readers of heights at those alone */
    double reach;           /* m: heights further from the disc's centre than this need not be looked at; <= radius */
    double span;            /* m between the greatest and least height that reach was made for; HUGE_VAL: any  */
    void (*exceeded)(void *); /* called once when the heights read span more; may be NULL                      */
    void *self;
};

/* How many heights are held at a time for a piece of the envelope. */
long crest_window(const struct crest_plan *p);

/* The rolling curve as a part of a relief of one coordinate: heights and, as it has kinks, slopes and second derivatives of its arcs, kinks left out: for readers of
   heights only. `under` is read as it is then, when and where it is needed, and must live as long; results do not depend on the order of reading. */
struct relief_part *crest_part(struct arena *a, const struct relief *under, const struct crest_plan *p);

#endif
