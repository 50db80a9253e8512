/* The places' hull is convex. A straight motion is inside when its ends are; of a curved one as many instants are looked at as show all of
   its shape: what is left out between two of them is far less than the distance of two places. */
#include "convolution/ring_reach.h"

#include <math.h>

#include "convolution/ring_along.h"
#include "convolution/ring_choice.h"
#include "response/places.h"
#include "scene/ablation.h"
#include "trajectory/trajectory.h"

#define REACH_SLACK 1e-9 /* m */

static bool reach_told(const struct modes *m, const struct stage_run *r, const double p[2], double out, struct err *e)
{
    bool place = ablation_one_place(r->contact) && !isnan(r->contact->ablation.place[0]);
    return err_set(e, ERR_SCENE, "contact '%s': %s: %s [%g m, %g m], %.3g m beyond the places of %s%s%s; move it, or set surface.extrapolate: nearest", r->contact->name,
                   ring_choice_about(r->contact, RING_SURFACE), place ? "ablation.place is" : "the motion reaches", p[0], p[1], out, m->name, m->places ? ": " : "",
                   m->places ? places_told(m->places, r->arena) : "");
}

bool ring_reach(const struct modes *m, const struct stage_run *r, struct err *e)
{
    const struct response *given = &r->contact->surface.response;
    const struct trajectory *tr = r->board->trajectory;
    struct modes_point point = modes_point_make(r->arena, m->n);
    bool one = ablation_one_place(r->contact);
    struct modes_where first = ring_along_first(r->contact, tr);
    long steps = one ? 0 : tr->straight ? 1 : tr->detail;
    for (long i = 0; i <= steps && given->extrapolate == EXTRAPOLATE_ERROR; i++) {
        double t = one ? 0 : tr->duration * (double)i / (double)steps, p[2] = {first.x, first.y};
        if (tr->straight && !one)
            for (int xy = 0; xy < 2; xy++)
                p[xy] = tr->from[xy] + tr->reach[i] * tr->e[xy];
        else if (!one)
            trajectory_at(tr, 1, &t, (struct trajectory_out){.x = &p[0], .y = &p[1]});
        double out = modes_at(m, &(struct modes_where){p[0], p[1], 0}, &point);
        if (out > REACH_SLACK)
            return reach_told(m, r, p, out, e);
    }
    return true;
}
