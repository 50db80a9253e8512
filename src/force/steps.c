#include "force/steps.h"

#include <math.h>

#include "surface/limiter.h"
#include "trajectory/trajectory.h"

void steps_make(struct steps *s, struct stage_run *r, double longest)
{
    const struct contact *c = r->contact;
    const struct trajectory *tr = r->board->trajectory;
    bool x = c->surface.along == ALONG_X;
    double offset = x ? tr->from[0] - c->surface.origin[0] : 0, scale = x ? tr->e[0] : 1;
    if (x && fabs(scale) * tr->length < 1e-6 * r->board->profile->pitch)
        scale = 0; /* straight across the profile: what the decimals of the two ends leave in x is no motion along it */
    s->way = curvature_way_make(r->arena, r->board->profile, offset, scale, longest);
    s->directional = c->contact.force == FORCE_DIRECTIONAL;
}

static void steps_use(struct steps *s, const struct stage_run *r)
{
    bool limiter = r->contact->contact.limiter.curve == LIMITER_TANH;
    curvature_limit(&s->pieces, s->directional ? s->way.scale * s->way.scale : 1, limiter);
    s->use(s->self, &s->pieces);
    s->pieces.n = s->pieces.points = 0;
}

static void steps_stretch(struct steps *s, const struct stage_run *r, struct curvature_stretch part)
{
    if (part.end == part.u || s->way.scale == 0)
        return;
    while (!curvature_cut(&s->way, &part, &s->pieces))
        steps_use(s, r);
}

void steps_run(struct steps *s, const struct stage_run *r, long first, int n)
{
    const struct board *b = r->board;
    const double *u = steps_values(b, ITEM_POSITION, first), *v = steps_values(b, ITEM_VELOCITY, first);
    const double *alpha = board_has(b, ITEM_ALPHA) ? steps_values(b, ITEM_ALPHA, first) : NULL;
    double fixed = limiter_constant(r->contact), dt = 1 / (b->rate * b->over);
    for (int i = 0; i < n; i++) {
        struct curvature_stretch part = {.u = u[i], .end = u[i + 1], .interval = i,
                                         .alpha = alpha ? 0.5 * (alpha[i] + alpha[i + 1]) : fixed};
        if (v[i] * v[i + 1] < 0) {
            double turn = trajectory_turning(b->trajectory, (double)(first + i) * dt, (double)(first + i + 1) * dt), at;
            if (!isnan(turn)) {
                trajectory_at(b->trajectory, 1, &turn, &at, NULL, NULL);
                part.end = at;
                steps_stretch(s, r, part);
                part.u = at;
                part.end = u[i + 1];
            }
        }
        steps_stretch(s, r, part);
    }
    steps_use(s, r);
}

void steps_lift(struct board *b, long first, int n)
{
    if (!board_has(b, ITEM_LOAD))
        return;
    const double *load = steps_values(b, ITEM_LOAD, first);
    double *force = steps_values(b, ITEM_SUBFORCE, first);
    for (int i = 0; i < n; i++)
        if (load[i] + load[i + 1] < 0) {
            force[i] = 0;
            if ((first + i) / b->over < b->moving - 1)
                b->lifted += 1 / (b->rate * b->over);
        }
}

double steps_pieces(const struct contact *c, const struct scene *s)
{
    double pitch = c->surface.roughness.given ? c->surface.roughness.shortest / 4 : isnan(c->surface.pitch) ? 5e-6 : c->surface.pitch;
    struct trajectory tr = trajectory_make(&c->motion);
    double travelled = tr.path == PATH_BACK_AND_FORTH ? 2 * tr.rate * tr.length : tr.length / tr.duration;
    return s->accuracy.oversampling + travelled / (s->output.sample_rate * pitch);
}
