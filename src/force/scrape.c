/* The force of a scraper that follows one limited trajectory S along its path (`force: directional`).

     f_v = d/dt (m |v| S')                  vertical force, N                                        papers/000 eq. 1
     f_h = beta1 | |v| S' |^beta2           horizontal force, N                                      papers/000 eq. 3

     m     mass of the scraper, kg          v        velocity along the path, m/s
     S'    dS/ds, force/slope.c             beta1    N (s/m)^beta2

   Departures from papers/000, and why. Equation 2 keeps only S'' v^2 of the second time derivative of S and leaves out 2 S_xy v_x v_y and the
   gradient times the acceleration: momentum is lost at every reversal, and the force changes when the axes are turned; here f_v is the whole
   derivative along the path. One S serves both forces.

   Each sub-interval's mean is exact: that of f_v is the difference of m |v| S' across it, whatever the surface does inside; that of f_h for
   beta2 = 1 is beta1 / dt times the integral of |S'| ds. */
#include "force/scrape.h"

#include "force/lift.h"
#include "num/real.h"

bool scrape_make(struct scrape *s, struct stage_run *r, double share, struct err *e)
{
    const struct contact_model *m = &r->contact->contact;
    s->beta1 = m->beta1;
    s->beta2 = m->beta2;
    s->mass = r->contact->scraper.mass;
    s->share = share;
    s->slope.crossing = share * m->beta1 != 0;
    return slope_make(&s->slope, r, e);
}

void scrape_force(struct scrape *s, const struct stage_run *r, long first, int n)
{
    const struct board *b = r->board;
    const struct slope *l = &s->slope;
    slope_run(&s->slope, r, first, n);
    const double *v = way_values(b, ITEM_VELOCITY, first);
    double *force = way_values(b, ITEM_SUBFORCE, first), per_second = b->rate * b->over;
    for (int i = 0; i < n; i++) {
        double momentum = s->mass * v[i + 1] * l->ends[i], speed = l->travelled[i] * per_second;
        force[i] = (momentum - s->momentum) * per_second;
        if (l->crossed[i] > 0)
            force[i] += s->beta1 * per_second * l->crossed[i] * (s->beta2 == 1 ? 1 : real_pow(speed, s->beta2 - 1));
        force[i] *= s->share;
        s->momentum = momentum;
    }
}

/* ------------------------------------------------------------------ the stage */

static bool scrape_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_SCRAPE && c->contact.force == FORCE_DIRECTIONAL;
}

static double scrape_work(const struct contact *c, const struct scene *s)
{
    return (c->contact.limiter.curve == LIMITER_TANH ? 230 : 100) * way_work(c, s);
}

static bool scrape_open(struct stage_run *r, struct err *e)
{
    struct scrape *s = ARENA_TAKE(r->arena, struct scrape, 1);
    r->state = s;
    r->ahead = 1;
    return scrape_make(s, r, 1, e);
}

static bool scrape_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = way_some(first, last);
        scrape_force(r->state, r, first, n);
        lift_off(b, first, n);
        first += n;
    }
    return true;
}

static unsigned scrape_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    return way_asks(c);
}

const struct stage scrape_stage = {
    .name = "scrape",
    .does = "contact force of one limited trajectory along the path",
    .paper = "000 eq. 1, 3, 4, 5",
    .idle = "contact.model is not scrape, or contact.force is paper",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA) | ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .asks = scrape_asks,
    .wanted = scrape_wanted,
    .work = scrape_work,
    .open = scrape_open,
    .run = scrape_run,
};
