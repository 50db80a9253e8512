/* Modes between places at which they have been computed, as a mode table of those places and of complex gains would
   give them. */
#ifndef RESPONSE_MORPH_POINTS_H
#define RESPONSE_MORPH_POINTS_H
#include "response/modes.h"

struct morph_points_ask {
    int n, places;                /* modes, at least 1 */
    const double (*xy)[2];        /* [places] m */
    const struct modes_point *at; /* [places] */
    bool shared;                  /* poles are those of the first place */
};

/* To be read by modes_at of the same arena's lifetime; modes do not fade at half of any rate. ERR_SCENE as places_make.
 */
bool morph_points(const struct morph_points_ask *ask, struct arena *a, struct modes *m, struct err *e);

#endif
