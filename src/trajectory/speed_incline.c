/* The law of free motion on a slope: scene/incline.c has its formula. The acceleration jumps where what moves turns
   round under friction, and where it comes to rest; speed and way do not. */
#include <math.h>

#include "scene/incline.h"
#include "trajectory/speed.h"

/* Within the duration u lies between 0 and the way's end: rounding leaves 1e-17 m beyond them. */
static void incline_fill(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    const struct incline *s = speed->state;
    double at[3];
    for (size_t i = 0; i < n; i++) {
        bool inside = t[i] >= 0 && t[i] <= speed->duration;
        incline_at(s, t[i], at);
        if (u) u[i] = inside ? fmin(fmax(at[0], 0), s->length) : at[0];
        if (du) du[i] = at[1];
        if (ddu) ddu[i] = at[2];
    }
}

static double incline_turning(const struct speed *speed, double t0, double t1)
{
    const struct incline *s = speed->state;
    return s->back < 0 && s->stop > t0 && s->stop < t1 && s->stop < speed->duration ? s->stop : NAN;
}

bool speed_incline(struct speed *speed, const struct motion *m, struct arena *a, struct err *e)
{
    struct incline *s = ARENA_TAKE(a, struct incline, 1);
    double end[3], duration;
    *s = incline_make(m);
    if (!incline_can(s, m, e)) return false;
    duration = incline_lasts(s, m);
    if (s->over != INCLINE_RESTS) duration = fmin(duration, s->end);
    incline_at(s, duration, end);
    *speed = (struct speed){.duration = duration,
                            .top = fmax(s->speed, fabs(end[1])),
                            .distance = incline_way(s, duration),
                            .cycle = duration,
                            .detail = 64,
                            .at = incline_fill,
                            .turning = incline_turning,
                            .state = s};
    speed->reach[1] = fmin(duration > s->stop ? s->top : end[0], s->length);
    return true;
}
