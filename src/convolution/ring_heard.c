/* The sound ends output.tail after the last motion of the scene; tail auto: as long as the slowest response of all contacts rings, at most 60 s. So a
   contact that starts at t0 is heard for

       max over contacts (start + duration) + tail - t0,

   and nothing that its response does later. Where output.duration says how long the file is, that is the end, be it sooner or later. */
#include "convolution/ring_heard.h"

#include <math.h>

#include "trajectory/trajectory.h"

#define LONGEST_TAIL 60.0 /* s, of tail auto (pipeline/render_parts.c) */

/* Some motions say how long they last only when they are made: by a speed, a file. */
static bool lasts(const struct scene *s, const struct contact *c, double *duration, struct err *e)
{
    struct trajectory tr;
    struct arena *a = arena_open();
    bool ok = trajectory_make(&c->motion, trajectory_seed(s, c), a, &tr, e) || err_at(e, "contact '%s'", c->name);
    if (ok)
        *duration = tr.duration;
    arena_close(a);
    return ok;
}

bool ring_heard(const struct scene *s, const struct contact *c, double ring, struct ring_heard *h, struct err *e)
{
    double end = c->start + h->force, tail = s->output.tail;
    for (int i = 0; i < s->n_contacts; i++) {
        const struct contact *o = &s->contacts[i];
        double duration = o->motion.duration;
        if (o == c)
            continue;
        if (isnan(duration) && !lasts(s, o, &duration, e))
            return false;
        end = fmax(end, o->start + duration);
    }
    if (!isnan(s->output.duration)) {
        h->sound = h->most = fmax(s->output.duration - c->start, 1 / s->output.sample_rate);
        return true;
    }
    h->sound = end - c->start + (isnan(tail) ? fmin(ring, LONGEST_TAIL) : tail);
    h->most = end - c->start + (isnan(tail) ? LONGEST_TAIL : tail);
    return true;
}
