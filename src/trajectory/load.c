/* Normal force of a hand-held scraper, papers/000 equations 8 and 9 generalised to any instant and direction:

     N(t) = (m g + m a_out(t) tan theta) / (1 - mu tan theta)

     m      mass of the scraper, kg           theta  angle of the tool above the horizontal, rad
     g      gravity, m/s^2                    mu     coefficient of friction
     a_out  acceleration along the horizontal direction from the torso outwards (grip.azimuth), m/s^2

   For harmonic motion of amplitude L (half the distance between the ends; the paper does not define its L) along that direction,
   a_out runs from -omega^2 L to omega^2 L, which gives equations 9 and 8 at the two ends. N is largest at the end near the torso, where
   the acceleration points outwards.

   The paper's denominator vanishes at mu tan theta = 1 (the tool jams): refused from 0.999 on. N < 0 means that the hand lifts the
   scraper off: no contact, no force; counted by the force stage. */
#include "trajectory/load.h"

#include "num/real.h"
#include "scene/rules.h"
#include "stage.h"

bool load_make(const struct contact *c, const struct trajectory *tr, struct load_law *l, struct err *e)
{
    double g = c->contact.gravity, m = c->scraper.mass;
    if (!c->grip.given) {
        double n = isnan(c->load.constant) ? m * g : c->load.constant;
        *l = (struct load_law){.still = n, .least = n, .most = n};
        return true;
    }
    double tangent = real_tan(c->grip.angle), slip = rules_slip(&c->grip);
    if (rules_jams(&c->grip))
        return err_set(e, ERR_SCENE,
                       "contact '%s': grip: the tool jams: friction x tan(angle) is %.4g, and must stay below 0.999; lower grip.angle or "
                       "grip.friction",
                       c->name, 1 - slip);
    double outwards = tr->e[0] * real_cos(c->grip.azimuth) + tr->e[1] * real_sin(c->grip.azimuth);
    *l = (struct load_law){.still = m * g / slip, .per_acceleration = m * tangent / slip * outwards};
    return true;
}

/* Extremes over the motion, on 4097 instants of it (of its first cycle when it repeats). A whole cycle of harmonic motion has its extremes
   on the grid; those of a part of a cycle and of the minimum-jerk law lie between and are missed by less than 1e-6 of the range. */
static void load_range(struct load_law *l, const struct trajectory *tr)
{
    double span = tr->path == PATH_BACK_AND_FORTH && tr->duration * tr->rate > 1 ? 1 / tr->rate : tr->duration;
    l->least = HUGE_VAL, l->most = -HUGE_VAL;
    for (int i = 0; i <= 4096; i++) {
        double t = span * i / 4096, a, n;
        trajectory_at(tr, 1, &t, NULL, NULL, &a);
        n = fmax(load_at(l, a), 0);
        l->least = fmin(l->least, n);
        l->most = fmax(l->most, n);
    }
}

/* ------------------------------------------------------------------ the stage: only a grip makes the load vary */

static bool load_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->grip.given;
}

static double load_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 2 * s->accuracy.oversampling;
}

static bool load_open(struct stage_run *r, struct err *e)
{
    struct load_law *l = ARENA_TAKE(r->arena, struct load_law, 1);
    r->board->load = l;
    if (!load_make(r->contact, r->board->trajectory, l, e))
        return false;
    load_range(l, r->board->trajectory);
    return true;
}

static bool load_run(struct stage_run *r, long from, long to, struct err *e)
{
    (void)e;
    const struct board *b = r->board;
    const double *a = board_at(b, ITEM_ACCELERATION, from);
    double *n = board_at(b, ITEM_LOAD, from);
    for (long i = 0; i < (to - from) * b->over; i++)
        n[i] = load_at(b->load, a[i]);
    return true;
}

const struct stage load_stage = {
    .name = "load",
    .does = "normal force of the hand that holds the scraper",
    .paper = "000 eq. 8, 9",
    .idle = "no grip: the load is constant",
    .needs = ITEM_BIT(ITEM_ACCELERATION),
    .gives = ITEM_BIT(ITEM_LOAD),
    .wanted = load_wanted,
    .work = load_work,
    .open = load_open,
    .run = load_run,
};
