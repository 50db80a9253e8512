/* The force of a ball that rolls over a surface, papers/000 section 4.

     f     = scraping (f_h + f_v) + f_roll                      equation 19     scraping  contact.roll.scraping, how much the ball slips
     f_roll = k rho^1.5 (1 + mu rho') for rho > 0, else 0       equation 15     lambda = mu k; force/roll_law.c
     rho   = rho_0 + rest ((N(t)/N)^(2/3) - 1) + D              for equation 16 m, penetration; rest = (N/k)^(2/3), that at rest
     D     = S less its mean                                    m, way of the ball's geometric centre over the ground; force/roll_centre.c

   f_h, f_v are those of what scrapes (force/scrape.c), of the same trajectory S; with contact.force: paper those of equations 2 and 3 as printed
   (force/paper.c), and the rolling term is added to them, not smoothed, as there what is smoothed are curvatures. S follows the ball's rolling curve
   (surface/tip.c), its curvature limited by an alpha that varies with the normal force N(t) (equation 7), whose mean is N.

   Departure. Equation 16 has rho = R - r cos(x/R) + S: it puts the rise of the centre of mass, about -r cos(theta),
   into the penetration, so that its force
   is largest where the centre of mass is highest. By Newton's second law the normal force, N(t) = m (g + d2(-r cos theta)/dt2), is largest where it is
   lowest; and millimetres of rise stand against micrometres of S. So here rho is of the way over the ground, and what goes up and down with the ball's
   turning, the offset and the lobes of its rim (bulge, which is not in the paper), presses it deeper and less deep as N(t) does, quasi-statically: on level
   ground f_roll is N(t) (mu aside: a ball turns slowly; force/roll_told.c says where it does not). With penetration:
   paper, rho = R - r cos(x/R) + S + bulge
   as printed, k and lambda by hand, and N(t) without the lobes.

   rho_0 and, where it is not given, k come from a rehearsal of the motion (force/roll_rehearsal.c). Where N(t) < 0, as when an offset ball spins fast,
   it is clear of the surface: no force at all. */
#include <string.h>

#include "force/lift.h"
#include "force/roll_centre.h"
#include "force/roll_law.h"
#include "force/roll_pass.h"
#include "force/roll_rehearsal.h"
#include "force/roll_told.h"
#include "force/scrape.h"
#include "num/real.h"
#include "scene/ball.h"
#include "scene/rules.h"
#include "surface/tip_work.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

struct roll_state {
    struct scrape scrape;
    struct roll_centre centre;
    struct roll_law law;
    struct roll_rehearsal found;
    bool printed;               /* penetration: paper                                          */
    bool added;                 /* the scraping terms are there, from force/paper.c            */
    bool idle;                  /* nothing presses the ball                                    */
    bool touches;               /* the ball lay on the surface at the end of the last sub-interval */
    double rho[WAY_CHUNK + 1];  /* m, at the start of the chunk's first sub-interval and at each one's end */
    double rate[WAY_CHUNK + 1]; /* m/s, of S there */
    double rate_last;           /* m/s, at the end of the last sub-interval */
    double slow[2];             /* m, rho less S where the last sub-interval began and ended */
    bool begun;
};

static bool roll_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_ROLL && c->contact.force == FORCE_DIRECTIONAL;
}

static bool roll_added_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_ROLL && c->contact.force == FORCE_PAPER;
}

/* m, once over, as far as the scene tells; else as far as no stiffness asks for more. */
static double roll_way(const struct motion *m)
{
    double dx = m->to[0] - m->from[0], dy = m->to[1] - m->from[1];
    if (m->path == PATH_CIRCLE)
        return 2 * REAL_PI * m->radius * fmin(fabs(m->turns), 1);
    return rules_straight(m) ? sqrt(dx * dx + dy * dy) : isnan(m->duration) ? 1 : rules_speed(m) * m->duration;
}

/* Where the stiffness is made: what the means are of, where the way turns or alpha varies, what is gone over beyond a short motion, and, where the tip reads more densely, the whole way as it reads plainly. Cycles per
   metre, those of the tip (surface/tip.c) among them. */
static double roll_ground_work(const struct contact *c, const struct scene *s)
{
    double way = roll_way(&c->motion), again = s->accuracy.tip_heights != 1 ? way : 0;
    double lasts = isnan(c->motion.duration) ? way / rules_speed(&c->motion) : c->motion.duration;
    double pass = rules_along(c) == ALONG_PLANE ? 0 : 340 / roll_pass_grain(c), plain = tip_work_metre(c, 1) + pass, dense = tip_work_metre(c, s->accuracy.tip_heights) + pass;
    bool one = rules_straight(&c->motion) || rules_along(c) == ALONG_PATH;
    bool means = c->contact.limiter.curve == LIMITER_TANH && (!one || load_varies(c)); /* force/slope_heading.c */
    double looked = means ? fmax(ball_ground(c), one ? 0 : fmin(way, 4 * ball_ground(c))) : 0;
    bool made = ball_beyond(c, 1e-9) > 0; /* of next to no ground, if of any */
    double work = looked * dense + (made ? ball_beyond(c, way) + again : 0) * plain;
    return way > 0 && lasts > 0 ? work / (lasts * s->output.sample_rate) : 0;
}

/* The rehearsal goes the whole way once more, in grains of its own. */
static double roll_work(const struct contact *c, const struct scene *s)
{
    bool round = c->ball.offset == 0 && c->ball.lobe_height == 0, printed = c->contact.roll.penetration == PENETRATION_PAPER;
    double way = (c->contact.limiter.curve == LIMITER_TANH ? 180 : 80) * way_work(c, s), over = s->accuracy.oversampling;
    double grains = printed ? 0 : roll_pass_rate(c, 1, rules_speed(&c->motion)) / s->output.sample_rate;
    double again = printed ? 0 : (c->whole ? 2 : 1) * way * fmax(grains / over, rules_speed(&c->motion) > 0 ? 0.5 : 0);
    return way + again + (round ? 30 : 180) * over + (load_varies(c) ? 300 : 110) * grains + roll_ground_work(c, s);
}

/* ------------------------------------------------------------------ opening */

static bool roll_printed(const struct contact *c, struct roll_state *s, struct err *e)
{
    s->law.mu = c->contact.roll.lambda / s->law.stiffness;
    s->found = (struct roll_rehearsal){.normal = rules_load(c), .deviation = NAN};
    s->found.rest = roll_law_rest(s->found.normal, s->law.stiffness);
    return !isnan(s->law.stiffness) ||
           err_set(e, ERR_SCENE, "contact '%s': contact.roll.penetration: paper needs contact.roll.stiffness (or kappa)", c->name);
}

static bool roll_rehearse(struct stage_run *r, struct roll_state *s, struct err *e)
{
    const struct contact *c = r->contact;
    s->law.mu = c->contact.roll.mu;
    if (!roll_rehearsal_run(r, s->scrape.slope.turned.heading, &s->law, &s->found, e))
        return false;
    s->idle = !(s->found.normal > 0);
    roll_told(r, &s->found);
    return true;
}

static bool roll_open(struct stage_run *r, struct err *e)
{
    const struct contact *c = r->contact;
    struct roll_state *s = ARENA_TAKE(r->arena, struct roll_state, 1);
    struct roll_report *report = &r->board->roll;
    s->law.stiffness = ball_stiffness(c);
    s->scrape.slope.rising = true;
    s->scrape.slope.turned.heading = slope_heading_make(r, r->arena);
    s->centre = roll_centre_make(c);
    s->touches = true;
    s->added = c->contact.force == FORCE_PAPER;
    s->printed = c->contact.roll.penetration == PENETRATION_PAPER;
    r->state = s;
    r->ahead = 1;
    if (!scrape_make(&s->scrape, r, c->contact.roll.scraping, e) || !(s->printed ? roll_printed(c, s, e) : roll_rehearse(r, s, e)))
        return false;
    r->board->hats = true;
    report->stiffness = s->law.stiffness;
    report->rest = s->found.rest;
    report->deviation = s->found.deviation;
    r->board->rolls = !s->idle;
    return true;
}

/* ------------------------------------------------------------------ running */

/* rho over the chunk, from the way of the centre. Of what nothing presses it is 0: it just touches. */
static void roll_press(struct roll_state *s, const double *load, int n)
{
    double deeper[WAY_CHUNK + 1] = {0};
    if (load && !s->printed && !s->idle)
        roll_rehearsal_press(&s->found, n + 1, load, deeper);
    for (int i = 0; i <= n; i++)
        s->rho[i] = s->idle ? 0 : s->printed ? s->centre.spin.radius + s->centre.at[i] + s->centre.in_rho[i]
                                             : s->found.base + deeper[i] + (s->centre.at[i] - s->found.mean);
}

/* The share of sub-interval i of the chunk in contact, and whether in it the ball leaves the surface. */
static double roll_contact(struct roll_state *s, const double *load, int i, bool *leaves)
{
    double pressed = load ? lift_pressed(load[i], load[i + 1]) : 1;
    bool before = s->touches;
    s->touches = s->idle || (!(load && load[i + 1] < 0) && s->rho[i + 1] > 0);
    *leaves = before && !s->touches;
    return s->idle ? 0 : pressed * roll_law_contact(s->rho[i], s->rho[i + 1]);
}

/* m, of the centre of mass; 0 where S and the rim have their mean height and the centre of mass lies lowest. */
static double roll_height(const struct roll_state *s, int i)
{
    return s->centre.at[i] - s->found.mean + (s->centre.round ? 0 : s->centre.rise[i] + s->centre.spin.offset);
}

/* Report and ITEM_ROLL over the chunk's sub-intervals. */
static void roll_tell(struct roll_state *s, struct board *b, const double *load, long first, int n)
{
    double dt = 1 / (b->rate * b->over), last = b->trajectory->duration / dt;
    for (int i = 0; i < n; i++) {
        bool leaves;
        double share = roll_contact(s, load, i, &leaves);
        if ((double)(first + i) + 0.5 < last) {
            b->roll.contact += share * dt;
            b->roll.time += dt;
            b->roll.lift_offs += leaves;
        }
        if (!board_has(b, ITEM_ROLL))
            continue;
        double *value = board_at(b, ITEM_ROLL, (first + i) / b->over);
        if ((first + i) % b->over == 0) {
            value[ROLL_PENETRATION] = s->rho[i];
            value[ROLL_HEIGHT] = roll_height(s, i);
            value[ROLL_CONTACT] = value[ROLL_LIFT_OFFS] = 0;
        }
        value[ROLL_CONTACT] += share / b->over;
        value[ROLL_LIFT_OFFS] += leaves;
    }
}

/* dS/dt = v (dS/du + S/l) - |v| S/l at the chunk's instants; rate[0] is the last one's of the chunk before. */
static void roll_rates(struct roll_state *s, const double *v, int n)
{
    const struct slope *l = &s->scrape.slope;
    s->rate[0] = s->rate_last;
    for (int i = 0; i < n; i++)
        s->rate[i + 1] = v[i + 1] * l->climbs[i] - fabs(v[i + 1]) * l->heights[i] / l->leak;
    s->rate_last = s->rate[n];
}

/* rho less S changes slowly: its rates at a sub-interval's ends are made of its last two steps. */
static void roll_ends(struct roll_state *s, int i, double dt, struct roll_end ends[2])
{
    double slow = s->rho[i + 1] - s->scrape.slope.heights[i], step = slow - s->slow[1], bend = s->begun ? step - (s->slow[1] - s->slow[0]) : 0;
    ends[0] = (struct roll_end){s->rho[i], s->rate[i] + (step - 0.5 * bend) / dt};
    ends[1] = (struct roll_end){s->rho[i + 1], s->rate[i + 1] + (step + 0.5 * bend) / dt};
    s->slow[0] = s->slow[1];
    s->slow[1] = slow;
    s->begun = true;
}

/* To the scraping terms' hats, or (added) to what is on the board already. */
static void roll_add(struct roll_state *s, struct board *b, long first, int n)
{
    struct hats *h = &s->scrape.hats;
    double dt = 1 / (b->rate * b->over);
    roll_rates(s, way_values(b, ITEM_VELOCITY, first), n);
    if (!s->begun)
        s->slow[1] = s->rho[0];
    for (int i = 0; i < n; i++) {
        struct roll_end ends[2];
        roll_ends(s, i, dt, ends);
        struct roll_parts f = s->idle ? (struct roll_parts){0} : roll_law_force(&s->law, &ends[0], &ends[1], dt);
        h->early[i] = f.early + (s->added ? 0 : h->early[i]);
        h->late[i] = f.late + (s->added ? 0 : h->late[i]);
    }
    if (s->added)
        hats_add(h, b, first, n);
    else
        hats_lay(h, b, first, n);
}

static void roll_level(struct roll_centre *m, const double *level, int n)
{
    double *const lifts[SLOPE_LEVELS] = {m->lifts[0], m->lifts[1]};
    roll_centre_level(m->at, n, lifts, level);
}

static bool roll_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct roll_state *s = r->state;
    struct board *b = r->board;
    bool forces = board_has(b, ITEM_SUBFORCE); /* a table may ask for the ball's height alone */
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = way_some(first, last);
        const double *load = board_has(b, ITEM_LOAD) ? way_values(b, ITEM_LOAD, first) : NULL;
        if (forces && !s->added)
            scrape_force(&s->scrape, r, first, n);
        else
            slope_run(&s->scrape.slope, r, first, n);
        roll_centre_run(&s->centre, &s->scrape.slope, b, first, n);
        roll_level(&s->centre, s->found.level, n + 1);
        roll_press(s, load, n);
        if (forces)
            roll_add(s, b, first, n);
        roll_tell(s, b, load, first, n);
        first += n;
    }
    return true;
}

static void roll_skip(struct stage_run *r, long frame)
{
    struct roll_state *s = r->state;
    (void)frame;
    scrape_forget(&s->scrape);
    s->centre.height = s->rate_last = 0;
    memset(s->centre.lift, 0, sizeof s->centre.lift);
    s->touches = true;
    s->begun = false;
}

static unsigned roll_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    return way_asks(c);
}

const struct stage roll_stage = {
    .name = "roll",
    .does = "contact force of a ball that rolls: penetration, and the scraping terms of one limited trajectory",
    .paper = "000 eq. 15, 16, 18, 19",
    .idle = "contact.model is not roll, or contact.force is paper",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA) | ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE) | ITEM_BIT(ITEM_ROLL),
    .knobs = KNOB_BIT(oversampling),
    .asks = roll_asks,
    .wanted = roll_wanted,
    .work = roll_work,
    .open = roll_open,
    .run = roll_run,
    .skip = roll_skip,
};

const struct stage roll_added_stage = {
    .name = "roll_added",
    .does = "rolling term of the contact force, added to the scraping terms as printed",
    .paper = "000 eq. 15, 16, 18, 19",
    .idle = "contact.model is not roll, or contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE) | ITEM_BIT(ITEM_SUBFORCE),
    .takes = ITEM_BIT(ITEM_ALPHA) | ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE) | ITEM_BIT(ITEM_ROLL),
    .knobs = KNOB_BIT(oversampling),
    .asks = roll_asks,
    .wanted = roll_added_wanted,
    .work = roll_work,
    .open = roll_open,
    .run = roll_run,
    .skip = roll_skip,
};
