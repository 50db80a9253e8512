/* Signed mode shapes at the place that is touched, for what gives way under a contact: the object's displacement there
   is sum phi_i q_i,

     q_i'' + 2 sigma_i q_i' + |s_i|^2 q_i = phi_i f,   s_i = -sigma_i + j 2 pi f_i

   phi scaled to unit modal mass (1/sqrt(kg)). Of objects of closed form phi = shape / sqrt(modal mass), exact and
   signed; of a mode table with shared poles the gains must be those of the driving point (heard where it is touched):
   real positive phi_i^2. */
#ifndef RESPONSE_SHAPES_H
#define RESPONSE_SHAPES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "response/modes.h"

struct shapes {
    int n;
    const double *frequency, *decay; /* [n] Hz (damped), 1/s */
    bool moves;                      /* phi depends on the place */
    const struct modes *modes;
    void *self;
};

/* From a body's modes; they must stay. key ("surface"): for messages. ERR_SCENE: separate poles, poles that travel, or
 * gains that are not those of the driving point. */
bool shapes_make(const struct modes *m, const char *key, struct arena *a, struct shapes *s, struct err *e);

/* phi[n] at a place (the scene's coordinates), 1/sqrt(kg). */
void shapes_at(const struct shapes *s, const struct modes_where *where, double *phi);

#endif
