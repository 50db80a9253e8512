/* See impact_walk.h. Straight means in angle and radius: from angle 0 to 360 degrees is once round; from radius 1 to -1
   is through the centre to the other side. Times count from the contact's start. */
#include "force/impact_walk.h"

#include "num/real.h"
#include "trajectory/series.h"

static bool walk_read(const char *file, struct arena *a, struct impact_law *l, struct err *e)
{
    static const char *const columns[2] = {"angle_deg", "radius"};
    struct series s;
    if (!series_read(file, columns, a, &s, e)) return false;
    l->steps = (int)s.n;
    l->walk = ARENA_TAKE(a, double, 3 * s.n);
    for (size_t i = 0; i < s.n; i++) {
        if (!(fabs(s.x[1][i]) <= 1))
            return err_set(e, ERR_SCENE, "%s:%d: column 'radius': %.9g lies outside the disk; a radius is in -1 .. 1",
                           file, s.lines[i], s.x[1][i]);
        l->walk[3 * i] = s.time[i];
        l->walk[3 * i + 1] = s.x[0][i] * (REAL_PI / 180);
        l->walk[3 * i + 2] = s.x[1][i];
    }
    return true;
}

bool impact_walk_make(const struct contact *c, double duration, struct arena *a, struct impact_law *l, struct err *e)
{
    const struct impacts *m = &c->contact.impacts;
    if (m->walk) return walk_read(m->walk, a, l, e);
    l->steps = duration > 0 && (!isnan(m->angle_to) || !isnan(m->radius_to)) ? 2 : 1;
    l->walk = ARENA_TAKE(a, double, 6);
    l->walk[1] = m->angle;
    l->walk[2] = m->radius;
    l->walk[3] = duration;
    l->walk[4] = isnan(m->angle_to) ? m->angle : m->angle_to;
    l->walk[5] = isnan(m->radius_to) ? m->radius : m->radius_to;
    return true;
}

void impact_walk_at(const struct impact_law *l, double t, double *angle, double *radius)
{
    const double *w = l->walk;
    int low = 0, high = l->steps - 1;
    if (t >= w[3 * high]) low = high;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (w[3 * middle] <= t)
            low = middle;
        else
            high = middle;
    }
    w += 3 * low;
    double share = low == high || t <= w[0] ? 0 : (t - w[0]) / (w[3] - w[0]);
    *angle = share > 0 ? w[1] + share * (w[4] - w[1]) : w[1];
    *radius = share > 0 ? w[2] + share * (w[5] - w[2]) : w[2];
}
