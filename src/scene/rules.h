/* Rules about a contact's values to each other that the reader tells with their place, and the stages keep to once more. */
#ifndef SCENE_RULES_H
#define SCENE_RULES_H
#include "num/real.h"
#include "scene/scene.h"

#define RULES_SMOOTHING_WIDEST 0.1 /* s: a wider sigma leaves nothing to hear, and its kernels cost minutes per second of sound */

/* 1 - mu tan theta, the denominator of papers/000 equations 8 and 9. */
static inline double rules_slip(const struct grip *g)
{
    return 1 - g->friction * real_tan(g->angle);
}

/* The tool jams where mu tan theta reaches 1: refused from 0.999 on. (tan 45 degrees is 1 - 1e-16 in binary, and 0.999 of it is to be
   refused.) */
static inline bool rules_jams(const struct grip *g)
{
    return rules_slip(g) <= 1e-3 + 1e-12;
}

/* Standard deviation in s of the Gaussian smoothing for an alpha in m; without a limiter as for 3 cm. */
static inline double rules_sigma(const struct contact_model *c, double alpha)
{
    return c->smoothing * (c->limiter.curve == LIMITER_TANH ? alpha : 0.03) / 0.03;
}

#endif
