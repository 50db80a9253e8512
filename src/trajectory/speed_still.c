/* No speed at all: the motion of a contact that stays where it is. */
#include "trajectory/speed.h"

static void still_at(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    (void)speed, (void)t;
    for (size_t i = 0; i < n; i++) {
        if (u) u[i] = 0;
        if (du) du[i] = 0;
        if (ddu) ddu[i] = 0;
    }
}

void speed_still(struct speed *speed, double duration)
{
    *speed = (struct speed){.duration = duration, .cycle = duration, .detail = 1, .at = still_at};
}
