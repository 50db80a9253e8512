/* A comb filter on the force, as of what comes back from the edge of a finite surface,

     f_out(t) = f_in(t) + g f_in(t - tau)        tau = 2 d(t) / c

     g    contact.comb.gain                      d    m, |contact.comb.distance - u|: to the edge, along the path
     c    contact.comb.speed, m/s                u    m, signed distance along the path

   so that each mode swells and fades as the contact comes nearer to the edge: papers/002, section VII, names "the
   amplitude variation of the modes over time when the ball is rolling on a finite surface", and "a comb-filtering
   process" for it, and prints no formula: this one is ours. A plate's bending waves have a speed for each frequency;
   here it is one. Objects whose response depends on the place (surface.object, tables with places) vary so by
   themselves.

   What comes back is let go with the contact, over load.release, as what a gesture's low-pass holds is.

   Between samples f_in is the cubic through four of them (Lagrange): off by less than 1e-3 below a tenth of the sample
   rate, and half a sample's delay takes 1 dB at a quarter of it. */
#include <math.h>

#include "scene/rows.h"
#include "stage.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

struct comb {
    bool given;
    double gain, distance, speed; /* 1, m, m/s */
};

static const struct key keys[] = {{ROW_NUMBER(comb, gain, "contact.comb.gain"), KEY_NONE, -1, 1, "0.7", NULL,
                                   "g, the share of the force that comes back from the edge; below 0: turned over"},
                                  {ROW_NUMBER(comb, distance, "contact.comb.distance"), KEY_LENGTH, 0, 10, "30 cm",
                                   NULL, "how far from the edge the motion starts, along the path"},
                                  {ROW_NUMBER(comb, speed, "contact.comb.speed"), KEY_SPEED, 10, 1e4, "200 m/s", NULL,
                                   "c, the speed of waves to the edge and back"},
                                  {.path = NULL}};

static const struct params comb_params = {
    .section = "contact.comb",
    .meaning = "what comes back from the edge of a finite surface, as a comb filter on the force (Conan et al. 2014a, "
               "section VII)",
    .size = sizeof(struct comb),
    .keys = keys,
};

enum { AROUND = 4 }; /* samples that a value between them is made of */

struct comb_state {
    struct comb comb;
    struct load_law fade;
    double *past; /* [size], f_in at n in [n % size] */
    long size;
};

static bool comb_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return params_given(c, &comb_params);
}

/* m: furthest from the edge. */
static double comb_furthest(const struct comb *c, const struct trajectory *tr)
{
    return fmax(fabs(c->distance - tr->reach[0]), fabs(c->distance - tr->reach[1]));
}

static bool comb_open(struct stage_run *r, struct err *e)
{
    struct comb_state *s = ARENA_TAKE(r->arena, struct comb_state, 1);
    const struct board *b = r->board;
    s->comb = *(const struct comb *)params_of(r->contact, &comb_params);
    s->size = (long)ceil(2 * comb_furthest(&s->comb, b->trajectory) / s->comb.speed * b->rate) + 2 * AROUND;
    s->past = ARENA_TAKE(r->arena, double, s->size);
    r->state = s;
    if (!load_make(r->contact, b->trajectory, r->arena, &s->fade, e)) return false;
    if (r->contact->contact.model == CONTACT_GIVEN) s->fade.release = fmin(LOAD_APPROACH, s->fade.duration);
    return true;
}

static double comb_past(const struct comb_state *s, long n) { return n < 0 ? 0 : s->past[n % s->size]; }

/* f_in at n - delay, which is not in the future. */
static double comb_late(const struct comb_state *s, long n, double delay)
{
    long first = (long)floor(delay);
    first = first > 0 ? first - 1 : 0; /* samples back that the newest of four lies */
    double x = delay - (double)first, a = comb_past(s, n - first), b = comb_past(s, n - first - 1),
           c = comb_past(s, n - first - 2), d = comb_past(s, n - first - 3);
    return -a * (x - 1) * (x - 2) * (x - 3) / 6 + b * x * (x - 2) * (x - 3) / 2 - c * x * (x - 1) * (x - 3) / 2 +
           d * x * (x - 1) * (x - 2) / 6;
}

static bool comb_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct comb_state *s = r->state;
    const struct board *b = r->board;
    const double *u = board_at(b, ITEM_POSITION, from);
    double *force = board_at(b, ITEM_FORCE, from);
    (void)e;
    for (long n = from; n < to; n++) {
        double way = fabs(s->comb.distance - u[(n - from) * b->over]);
        s->past[n % s->size] = force[n - from];
        force[n - from] += s->comb.gain * load_lowered(&s->fade, (double)n / b->rate) *
                           comb_late(s, n, 2 * way / s->comb.speed * b->rate);
    }
    return true;
}

static void comb_skip(struct stage_run *r, long frame)
{
    struct comb_state *s = r->state;
    (void)frame;
    for (long i = 0; i < s->size; i++)
        s->past[i] = 0;
}

const struct stage comb_stage = {
    .name = "comb",
    .does = "what comes back from an edge, as a comb filter on the force",
    .paper = "002 sec. VII",
    .idle = "no contact.comb",
    .params = &comb_params,
    .needs = ITEM_BIT(ITEM_FORCE) | ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_MOTION),
    .gives = ITEM_BIT(ITEM_FORCE),
    .wanted = comb_wanted,
    .cycles = 60,
    .open = comb_open,
    .run = comb_run,
    .skip = comb_skip,
};
