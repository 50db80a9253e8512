/* The common case of a way (force/way.h): straight, one channel. The sub-intervals' first knots are looked for all at
   once, and where one ends in the same place and at the same alpha as the next begins, their pieces share the point. */
#ifndef FORCE_WAY_STRAIGHT_H
#define FORCE_WAY_STRAIGHT_H
#include "force/way.h"

struct way_straight {
    const double *u;             /* m: sub-interval i goes from u[i] to u[i + 1]  */
    double alpha[WAY_CHUNK];     /* m */
    double first[WAY_CHUNK];     /* m: length of its first piece                  */
    double second[WAY_CHUNK];    /* m: behind its first piece no knot is nearer   */
    int pieces[WAY_CHUNK];       /* 1 or 2, where that is known beforehand; else 0 */
    void (*flush)(struct way *); /* uses the pieces and empties them              */
};

/* Can such a way be cut so? To be asked, once, when all else in it is made. */
bool way_straight(struct way *w);

/* first[] and pieces[] of n sub-intervals. */
void way_straight_look(const struct way *w, struct way_straight *s, int n);

/* Adds the pieces of sub-intervals i to end - 1, the same as way_cut does. */
void way_straight_cut(struct way *w, const struct way_straight *s, int i, int end);

#endif
