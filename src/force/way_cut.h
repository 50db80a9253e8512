/* Cutting one stretch of a way (force/way.h) at the surface's knots. */
#ifndef FORCE_WAY_CUT_H
#define FORCE_WAY_CUT_H
#include <stdbool.h>

#include "force/way.h"

struct way_curve {                           /* Hermite curve of a curved path over one stretch */
    double x[2], y[2], ex[2], ey[2], length; /* ends, unit tangents in the direction of travel, m */
};

struct way_stretch {
    double u, end; /* m: where the stretch begins and ends  */
    double alpha;  /* m, of channel 0                       */
    int interval;
    struct way_curve path; /* of a curved way                       */
    bool cut;              /* begun, and going on from `done`       */
    double done;           /* m travelled                           */
};

/* Adds the stretch's pieces; false when there is no room for all: use the pieces, empty them, call again. */
bool way_cut(struct way *w, struct way_stretch *s);

#endif
