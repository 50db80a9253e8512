/* The sound ends output.tail after the last motion of the scene; tail auto: as long as the slowest response of all contacts rings, at most 60 s. So a
   contact that starts at t0 is heard for

       max over contacts (start + duration) + tail - t0,

   and nothing that its response does later. Others' motions are not made for this: where one says its length by a speed or a file, the end is not known. */
#include "convolution/ring_heard.h"

#include <math.h>

#define LONGEST_TAIL 60.0 /* s, of tail auto (pipeline/render_parts.c) */

struct ring_heard ring_heard(const struct scene *s, const struct contact *c, double duration, double ring)
{
    double end = c->start + duration, tail = s->output.tail;
    bool known = true;
    for (int i = 0; i < s->n_contacts; i++) {
        const struct contact *o = &s->contacts[i];
        if (o == c)
            continue;
        known = known && !isnan(o->motion.duration);
        if (!isnan(o->motion.duration))
            end = fmax(end, o->start + o->motion.duration);
    }
    double left = end - c->start;
    return (struct ring_heard){duration, left + (isnan(tail) ? fmin(ring, LONGEST_TAIL) : tail),
                               known ? left + (isnan(tail) ? LONGEST_TAIL : tail) : HUGE_VAL};
}
