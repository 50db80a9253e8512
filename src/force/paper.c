/* The contact force as papers/000 prints it (`force: paper`), in two stages around the smoothing.

     S_xx = T(z_xx; alpha_x),  S_yy = T(z_yy; alpha_y)     equations 4, 5       means over each sub-interval, exact
     f_v  = m (S_xx v_x^2 + S_yy v_y^2)                    equation 2
     f_h  = beta1 | v_x dz/dx + v_y dz/dy |^beta2          equation 3, with the slope of the surface z: only S'' is defined by the paper

   Along a path a profile has one axis, the path itself: v_x is the velocity along it and the y terms are zero; with surface.along: x they are
   zero too. alpha_y = limiter.ratio_y alpha_x. The paper's smoothing acts on the limited curvatures, "the window size in each dimension ...
   proportional to alpha_x and alpha_y" (section 2.2, last paragraph); the force is formed from them afterwards. At rest the curvature is that of
   the point touched. Under a ball that rolls these are the scraping terms of equation 19, times contact.roll.scraping. */
#include <string.h>

#include "force/lift.h"
#include "force/way.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "scene/rules.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"

struct paper {
    struct way way;
    double beta1, beta2;
    double bend[WAY_CHANNELS][WAY_CHUNK], slope[WAY_CHUNK], length[WAY_CHUNK]; /* integrals over sub-intervals; m travelled */
    double touched[WAY_CHANNELS][WAY_CHUNK], last[WAY_CHANNELS];               /* at the last point of a sub-interval; of all */
};

/* Integral of |dz/du|^beta2 over a piece on which the slope is a parabola: Simpson's rule, with two triangles at a zero. */
static double slope_crossed(double h, double a, double b, double beta2, double middle)
{
    double p[3] = {fabs(a), fabs(middle), fabs(b)};
    if (beta2 != 1)
        vecmath_pow(3, p, beta2, p);
    if (a * b < 0)
        return h * (p[0] * fabs(a) + p[2] * fabs(b)) / ((fabs(a) + fabs(b)) * (1 + beta2));
    return h * (p[0] + 4 * p[1] + p[2]) / 6;
}

static void paper_use(void *self, const struct way_pieces *p)
{
    struct paper *s = self;
    for (int i = 0; i < p->n; i++) {
        int k = p->interval[i], at = p->at[i];
        double h = p->length[i], middle = 0.5 * (p->slope[at] + p->slope[at + 1]) + h * p->heading[i] / 8 * (p->bend[at] - p->bend[at + 1]);
        for (int c = 0; c < s->way.channels; c++) {
            s->bend[c][k] += h * p->mean[c][i];
            s->touched[c][k] = p->limited[c][at + 1];
        }
        if (s->beta1 != 0)
            s->slope[k] += slope_crossed(h, p->slope[at], p->slope[at + 1], s->beta2, middle);
        s->length[k] += h;
    }
}

static bool paper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return (c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_ROLL) && c->contact.force == FORCE_PAPER;
}

static double paper_work(const struct contact *c, const struct scene *s)
{
    return (c->contact.limiter.curve == LIMITER_TANH ? 200 : 80) * way_work(c, s);
}

static bool paper_curvature_open(struct stage_run *r, struct err *e)
{
    struct paper *s = ARENA_TAKE(r->arena, struct paper, 1);
    s->beta1 = r->contact->contact.beta1;
    s->beta2 = r->contact->contact.beta2;
    s->way.use = paper_use;
    s->way.self = s;
    r->state = s;
    r->ahead = 1;
    return way_make(&s->way, r, WAY_AXES, HUGE_VAL, e);
}

/* Means of one curvature over the chunk's sub-intervals. */
static void paper_curvatures(struct paper *s, int channel, double *out, int n)
{
    for (int i = 0; i < n; i++) {
        out[i] = s->length[i] > 0 ? s->bend[channel][i] / s->length[i] : s->last[channel];
        s->last[channel] = s->length[i] > 0 ? s->touched[channel][i] : s->last[channel];
    }
}

static bool paper_curvature_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct paper *s = r->state;
    struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = way_some(first, last);
        double *slope = way_values(b, ITEM_SLOPE, first);
        memset(s->bend, 0, sizeof s->bend);
        memset(s->slope, 0, sizeof s->slope);
        memset(s->length, 0, sizeof s->length);
        way_run(&s->way, r, first, n);
        paper_curvatures(s, 0, way_values(b, ITEM_CURVATURE, first), n);
        if (board_has(b, ITEM_CURVATURE_Y))
            paper_curvatures(s, 1, way_values(b, ITEM_CURVATURE_Y, first), n);
        for (int i = 0; i < n; i++)
            slope[i] = s->length[i] > 0 ? s->slope[i] / s->length[i] : 0;
        first += n;
    }
    return true;
}

static unsigned paper_curvature_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    return way_asks(c);
}

const struct stage paper_curvature_stage = {
    .name = "paper_curvature",
    .does = "limited curvature and slope of the surface, per axis",
    .paper = "000 eq. 4, 5",
    .idle = "contact.model is neither scrape nor roll, or contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA),
    .gives = ITEM_BIT(ITEM_CURVATURE) | ITEM_BIT(ITEM_CURVATURE_Y) | ITEM_BIT(ITEM_SLOPE),
    .asks = paper_curvature_asks,
    .wanted = paper_wanted,
    .work = paper_work,
    .open = paper_curvature_open,
    .run = paper_curvature_run,
};

/* ------------------------------------------------------------------ equations 2 and 3 */

static bool paper_open(struct stage_run *r, struct err *e)
{
    (void)e;
    r->ahead = 1;
    return true;
}

static double paper_force_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 8 * s->accuracy.oversampling;
}

/* Mean velocity along one axis over sub-interval number k. */
static double paper_velocity(const struct board *b, long k, int axis)
{
    const struct trajectory *tr = b->trajectory;
    bool path = b->relief->along == ALONG_PATH, ends = path || tr->straight;
    const double *place = way_values(b, ends ? ITEM_POSITION : axis ? ITEM_Y : ITEM_X, k);
    double scale = path ? axis == 0 : tr->straight ? tr->e[axis] : 1;
    return (place[1] - place[0]) * b->rate * b->over * scale;
}

static double paper_force(const struct stage_run *r, long k, const double *yy)
{
    const struct board *b = r->board;
    const struct contact_model *m = &r->contact->contact;
    double vx = paper_velocity(b, k, 0), vy = b->relief->along == ALONG_PLANE ? paper_velocity(b, k, 1) : 0;
    double slope = *way_values(b, ITEM_SLOPE, k), speed = fabs(*way_values(b, ITEM_POSITION, k + 1) - *way_values(b, ITEM_POSITION, k)) * b->rate * b->over;
    double force = r->contact->scraper.mass * (*way_values(b, ITEM_CURVATURE, k) * vx * vx + (yy ? *yy * vy * vy : 0));
    force = slope > 0 ? force + m->beta1 * slope * (m->beta2 == 1 ? speed : real_pow(speed, m->beta2)) : force;
    return m->model == CONTACT_ROLL ? m->roll.scraping * force : force;
}

static bool paper_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = way_some(first, last);
        double *force = way_values(b, ITEM_SUBFORCE, first);
        for (int i = 0; i < n; i++)
            force[i] = paper_force(r, first + i, board_has(b, ITEM_CURVATURE_Y) ? way_values(b, ITEM_CURVATURE_Y, first + i) : NULL);
        lift_off(b, first, n);
        first += n;
    }
    return true;
}

static unsigned paper_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    return way_asks(c) | (rules_plane(c) ? ITEM_BIT(ITEM_CURVATURE_Y) : 0);
}

const struct stage paper_stage = {
    .name = "paper",
    .does = "contact force as printed, from curvature and slope",
    .paper = "000 eq. 2, 3",
    .idle = "contact.model is neither scrape nor roll, or contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_CURVATURE) | ITEM_BIT(ITEM_SLOPE),
    .takes = ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .asks = paper_asks,
    .wanted = paper_wanted,
    .work = paper_force_work,
    .open = paper_open,
    .run = paper_run,
};
