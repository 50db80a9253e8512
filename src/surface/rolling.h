/* The way of a round tip over a surface: the upper envelope of a ball (surface/envelope.h; in one coordinate crest.h),
   smoothed over the contact patch, as a part of a relief that reads the surface when and where it is read itself. */
#ifndef SURFACE_ROLLING_H
#define SURFACE_ROLLING_H
#include "base/arena.h"
#include "surface/crest_part.h"
#include "surface/relief.h"

struct rolling_plan {
    double radius, patch;     /* m; patch: standard deviation of the Gaussian                                    */
    double reach;             /* m: heights further from the ball's centre than this are not looked at; <= radius */
    int finer;                /* in the plane heights are read at patch / 4 / finer                              */
    double pitch;             /* m: in one coordinate, at its multiples                                          */
    bool points;              /* in one coordinate: the surface has kinks, and only its heights there count      */
    double span;              /* m between the greatest and least height that reach was made for; HUGE_VAL: any  */
    void (*exceeded)(void *); /* called once when the heights read span more; may be NULL                      */
    void *self;
};

enum { ROLLING_PER_PATCH = 4 }; /* lattice points in a standard deviation */

/* The part. `under` is read as it is then, and must live as long. */
struct relief_part *rolling_part(struct arena *a, const struct relief *under, const struct rolling_plan *p);

#endif
