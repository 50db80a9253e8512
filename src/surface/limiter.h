/* alpha(N): how much curvature the contact can follow. Papers/000 equations 6 and 7. */
#ifndef SURFACE_LIMITER_H
#define SURFACE_LIMITER_H
#include <stdbool.h>
#include <stddef.h>

#include "scene/scene.h"

struct limiter_law {
    double alpha_min, alpha_max, zeta; /* m, m, -                                      */
    double least, most;                /* N_min, N_max                                 */
    double fixed;                      /* m: alpha when the normal force does not vary */
    bool varies;
};

/* least, most: the range of N over the scene, used unless the scene gives its own. */
struct limiter_law limiter_make(const struct limiter *given, double least, double most);

/* alpha[n] (m) for normal forces[n] (N); forces outside the range count as its ends (negative ones as 0). */
void limiter_alpha(const struct limiter_law *l, size_t n, const double *force, double *alpha);

/* alpha of a contact whose load is constant; of one whose load varies (load_varies) it says nothing. */
double limiter_constant(const struct contact *c);

struct stage_run;
/* Warns where a normal force from `least` to `most` N leaves limiter.force_range. */
void limiter_told(struct stage_run *r, double least, double most);

#endif
