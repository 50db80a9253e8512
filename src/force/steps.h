/* A contact's way in steps: each sub-interval of the force becomes one stretch over the profile, or two where the motion turns. */
#ifndef FORCE_STEPS_H
#define FORCE_STEPS_H
#include "stage.h"
#include "surface/curvature.h"

enum { STEPS_CHUNK = 256 };

struct steps {
    struct curvature_way way;
    bool directional;                 /* curvature along the path: factor scale^2; paper: z'' of the profile's axis */
    struct curvature_pieces pieces;
    void (*use)(void *self, struct curvature_pieces *p); /* called with limited pieces, in the order travelled */
    void *self;
};

/* longest: m, no piece is longer. */
void steps_make(struct steps *s, struct stage_run *r, double longest);

/* Cuts the n <= STEPS_CHUNK sub-intervals from number `first` on (since the start) and hands all their pieces to use(); a piece's mark
   is the sub-interval's number in the chunk. */
void steps_run(struct steps *s, const struct stage_run *r, long first, int n);

/* Predicted pieces per audio sample: one per sub-interval, and one per knot passed (height maps that do not say their pitch here count as
   5 um). */
double steps_pieces(const struct contact *c, const struct scene *s);

/* No contact, no force: clears the force of sub-intervals whose mean normal force is negative, and counts their time. */
void steps_lift(struct board *b, long first, int n);

/* Values of a sub-sampled item from sub-sample `first` on. */
static inline double *steps_values(const struct board *b, enum item item, long first)
{
    return board_at(b, item, first / b->over) + first % b->over;
}

/* Sub-intervals of the next chunk of [first, last). */
static inline int steps_some(long first, long last)
{
    return (int)(last - first < STEPS_CHUNK ? last - first : STEPS_CHUNK);
}

#endif
