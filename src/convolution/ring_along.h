/* What rings along a motion, at any instant. */
#ifndef CONVOLUTION_RING_ALONG_H
#define CONVOLUTION_RING_ALONG_H
#include <stdbool.h>

#include "response/modes.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

struct ring_along {
    const struct modes *modes;
    const struct trajectory *trajectory;
    bool stays;             /* what rings is still retuned, or read, where the motion ends */
    struct modes_point end; /* work space */
};

struct ring_along ring_along_make(const struct modes *m, const struct trajectory *tr, bool stays, struct arena *a);

/* Poles and gains t seconds after the contact's start. Before the motion's start and after its end, where there is no force, they go on so
   that interpolation between instants keeps its order up to there: straight in the logarithm, or back where the motion rests; unless it stays. */
void ring_along_at(const struct ring_along *g, double t, const struct modes_point *p);

/* Does it go back before the start (t < 0) or after the end? */
bool ring_along_returns(const struct modes *m, const struct trajectory *tr, double t);

/* p <- end^2 / p, of n components: what goes on straight in the logarithm beyond the end, where p is as far inside. Poles only if p->frequency is
   not NULL. */
void ring_along_mirror(int n, const struct modes_point *end, const struct modes_point *p);

/* The motion's place, and the share of its duration that has passed. */
struct modes_where ring_along_where(const struct trajectory *tr, double t);

/* The place whose response it is all the time, of one that does not change: where the motion starts, or what ablation.place says. */
struct modes_where ring_along_first(const struct contact *c, const struct trajectory *tr);

#endif
