/* See roll_told.h. A ball that follows its lobes does so quasi-statically: driven at w rad/s up and down by h, a mass m
   on a contact that gives way by a spring s rises by h / (1 - w^2/w0^2), w0^2 = s/m, and presses by m w^2 times that. s
   = d(k rho^1.5)/d(rho) = 1.5 N / rest where it lies at rest. At half of w0 the force is a third larger than what N(t)
   says; well above w0 it is s h, that of a roughness, and what N(t) says is far too much. */
#include "force/roll_told.h"

#include <math.h>

#include "num/real.h"
#include "scene/ball.h"
#include "surface/limiter.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

#define DEEP 0.1    /* of the radius: a rest deeper than that is told */
#define FAST 0.5    /* of w0 */
#define SLIGHT 0.05 /* of N: how much it swings */

static void told_depth(struct stage_run *r, double rest)
{
    double radius = r->contact->ball.radius;
    if (rest > DEEP * radius)
        board_warn(r->board, arena_format(r->arena,
                                          "contact '%s': at rest the ball lies %.3g m deep, more than a tenth of its "
                                          "radius, %.3g m: so soft a contact "
                                          "is no ball's; a greater contact.roll.stiffness (or kappa), or a smaller "
                                          "static_penetration, makes it harder",
                                          r->contact->name, rest, radius));
}

static void told_lobes(struct stage_run *r, const struct roll_stiffness *rests)
{
    const struct contact *c = r->contact;
    const struct ball *b = &c->ball;
    double lobes = b->lobes * r->board->trajectory->top_speed / (b->radius - b->offset) / (2 * REAL_PI);
    double own = rests->resonance / (2 * REAL_PI);
    if (b->lobe_height > 0 && lobes > FAST * own)
        board_warn(
            r->board,
            arena_format(
                r->arena,
                "contact '%s': %.3g lobes of the ball pass in a second, and it cannot follow them: on its contact it "
                "swings by itself at %.3g Hz; the force "
                "that they make is too large: take contact.model: roll_coupled, fewer ball.lobes, or a slower motion",
                c->name, lobes, own));
}

/* Equation 7 goes by the extremes of N(t), however near to each other: as N(t) swings less and less, alpha does not
   come near to that of a constant force. The paper has the extremes, and so it stays; force_range makes it continuous.
 */
static void told_alpha(struct stage_run *r)
{
    const struct load_law *l = r->board->load;
    const struct contact *c = r->contact;
    if (r->board->limiter && r->board->limiter->varies && isnan(c->contact.limiter.force_range[0]) &&
        l->most - l->least < SLIGHT * l->most)
        board_warn(r->board, arena_format(r->arena,
                                          "contact '%s': the normal force swings by %.2g %% only, from %.6g to %.6g N, "
                                          "and contact.limiter goes from alpha_max to alpha_min "
                                          "by it; give contact.limiter.force_range, for alpha to go by newtons",
                                          c->name, 100 * (1 - l->least / l->most), l->least, l->most));
}

static void told_weightless(struct stage_run *r)
{
    if (ball_gravity(r->contact) == 0)
        board_warn(r->board,
                   arena_format(r->arena,
                                "contact '%s': nothing presses the ball down but its own turning: contact.gravity is "
                                "0, and for about half of the time it is clear of "
                                "the surface; once off it would stay off, which contact.model: roll_coupled follows",
                                r->contact->name));
}

void roll_told(struct stage_run *r, const struct roll_stiffness *rests)
{
    const struct load_law *l = r->board->load;
    if (!(rests->normal > 0) && !(l && l->most > 0)) {
        board_warn(r->board,
                   arena_format(r->arena,
                                "contact '%s': nothing presses the ball down: it scrapes, but its rolling force is 0",
                                r->contact->name));
        return;
    }
    told_depth(r, rests->rest);
    if (rests->normal > 0) told_lobes(r, rests);
    told_alpha(r);
    told_weightless(r);
}
