/* See roll_ground.h. The modes are those that sound (ring_choice.h): the strongest of the band, below 0.45 of the
 * sample rate; the give of all others is left out. */
#include "convolution/roll_ground.h"

#include "convolution/ring.h"
#include "scene/ablation.h"
#include "scene/rules.h"
#include "trajectory/trajectory.h"

static bool is_modal(const struct contact *c)
{
    const struct response *given = &c->surface.response;
    return c->contact.roll.ground != GROUND_RIGID && rules_responds(given) && !rules_is_recorded(given);
}

static void ground_phi(const struct roll_ground *g, long frame, double *phi)
{
    double t = (double)frame / g->board->rate;
    struct modes_where at = g->first;
    if (g->moves) trajectory_at(g->board->trajectory, 1, &t, (struct trajectory_out){.x = &at.x, .y = &at.y});
    modes_shapes_at(&g->shapes, &at, phi);
}

static void ground_ramps(struct roll_ground *g, const struct stage_run *r)
{
    g->moves = g->shapes.moves && r->contact->motion.path != PATH_STILL && !ablation_one_place(r->contact);
    g->first = ring_first_place(r->contact, g->board->trajectory);
    g->ramp = (long)r->scene->accuracy.gain_ramp;
    g->phi = ARENA_TAKE(r->arena, double, g->shapes.n);
    g->from = ARENA_TAKE(r->arena, double, g->shapes.n);
    g->to = ARENA_TAKE(r->arena, double, g->shapes.n);
    ground_phi(g, 0, g->to);
}

bool roll_ground_make(struct roll_ground *g, const struct stage_run *r, struct err *e)
{
    const struct contact *c = r->contact;
    const struct response *given = &c->surface.response;
    const struct ring_choice *choice = given->choice;
    *g = (struct roll_ground){.board = r->board};
    if (!is_modal(c))
        return c->contact.roll.ground != GROUND_ELASTIC ||
               err_set(e, ERR_SCENE,
                       "contact '%s': contact.roll.ground: elastic needs modes of the surface, and %s; give "
                       "surface.object, or take ground: rigid",
                       c->name, rules_responds(given) ? "a recorded response has none" : "it has no response");
    if (!choice && !ring_choice_make(c, r->scene, RING_SURFACE, r->arena, &choice, e)) return false;
    if (!modes_shapes_make(&choice->modes, "surface", r->arena, &g->shapes, e))
        return err_at(e, "contact '%s'", c->name);
    ground_ramps(g, r);
    return ring_reach(&choice->modes, r, e) || err_about(e, c->name, ring_choice_about(c, RING_SURFACE));
}

const double *roll_ground_start(const struct roll_ground *g) { return g->shapes.n > 0 ? g->to : NULL; }

const double *roll_ground_next(struct roll_ground *g, long frame, long *frames)
{
    if (!g->moves) return NULL;
    if (frame == g->ramp_end) {
        double *from = g->to;
        g->to = g->from;
        g->from = from;
        g->ramp_end += g->ramp;
        ground_phi(g, g->ramp_end, g->to);
    }
    if (frame + *frames >= g->ramp_end) {
        *frames = g->ramp_end - frame;
        return g->to;
    }
    double share = 1 - (double)(g->ramp_end - frame - *frames) / (double)g->ramp;
    for (int i = 0; i < g->shapes.n; i++)
        g->phi[i] = g->from[i] + share * (g->to[i] - g->from[i]);
    return g->phi;
}

double roll_ground_modes(const struct contact *c)
{
    const struct response *given = &c->surface.response;
    return !is_modal(c) ? 0 : given->choice ? given->choice->modes.n : given->modes;
}
