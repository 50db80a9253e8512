/* Parallel ridges or grooves. */
#ifndef SURFACE_RIDGES_H
#define SURFACE_RIDGES_H
#include "base/arena.h"
#include "num/noise.h"
#include "scene/scene.h"
#include "surface/relief.h"

enum ridge_shape { RIDGE_SINE, RIDGE_ROUND, RIDGE_GROOVE };

struct ridges { /* section surface.ridges */
    bool given;
    double spacing, height; /* m, from ridge to ridge; from valley to top                        */
    double width;           /* m, of a ridge or groove at half height (shapes other than sine)   */
    double direction;       /* rad, of the ridges' crests, 0 = +x                                */
    double jitter;          /* standard deviation of a ridge's place over the spacing            */
    double variation;       /* standard deviation of a ridge's height over the height            */
    int shape;              /* enum ridge_shape                                                  */
};

/* The ridges of that recipe and noise stream, in the coordinates `along` (decided): on a line (path, x) they lie across
 * it, ridge 0 at 0. */
struct relief_part *ridges_part(struct arena *a, const struct ridges *recipe, int along, struct noise stream);

#endif
