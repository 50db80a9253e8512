/* The normal force N(t): constant, or from the hand that moves the tool. */
#ifndef TRAJECTORY_LOAD_H
#define TRAJECTORY_LOAD_H
#include <stdbool.h>
#include <stddef.h>

#include "base/err.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

struct load_law {
    double still;       /* N without acceleration                       */
    double per_acceleration; /* N per m/s^2 along the stroke             */
    double least, most; /* N, over the motion, negative ones counted as 0 */
};

/* ERR_SCENE when the grip jams (mu tan theta >= 0.999). */
bool load_make(const struct contact *c, const struct trajectory *tr, struct load_law *l, struct err *e);

/* Normal force for an acceleration along the stroke; negative: the scraper is lifted off. */
static inline double load_at(const struct load_law *l, double acceleration)
{
    return l->still + l->per_acceleration * acceleration;
}

#endif
