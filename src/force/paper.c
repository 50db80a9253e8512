/* The contact force as papers/000 prints it (`force: paper`), in two stages around the smoothing.

     S_xx = T(z_xx)                                       equation 4           mean over each sub-interval, exact
     f_v  = m S_xx v_x^2                                  equation 2
     f_h  = beta1 | v_x dz/dx |^beta2                     equation 3, with the slope of the surface z: only S'' is defined by the paper

   A profile has one axis: the y terms are zero. Along the path v_x is the velocity along the stroke; with surface.along: x it is the x
   component. The paper's smoothing acts on the limited curvature (section 2.2, last paragraph), the force is formed from it afterwards. At
   rest the curvature is that of the point touched. */
#include <string.h>

#include "force/steps.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "trajectory/trajectory.h"

struct paper {
    struct steps steps;
    double beta1, beta2;
    double bend[STEPS_CHUNK], slope[STEPS_CHUNK], length[STEPS_CHUNK]; /* integrals over sub-intervals; m travelled */
    double touched[STEPS_CHUNK], last_bend;                            /* at the last point of a sub-interval; of all */
};

/* Integral of |z'|^beta2 over a piece: z' is a parabola there; Simpson's rule, with two triangles at a zero. */
static double slope_crossed(double h, double a, double b, double beta2, double middle)
{
    double p[3] = {fabs(a), fabs(middle), fabs(b)};
    if (beta2 != 1)
        vecmath_pow(3, p, beta2, p);
    if (a * b < 0)
        return h * (p[0] * fabs(a) + p[2] * fabs(b)) / ((fabs(a) + fabs(b)) * (1 + beta2));
    return h * (p[0] + 4 * p[1] + p[2]) / 6;
}

static void paper_use(void *self, struct curvature_pieces *p)
{
    struct paper *s = self;
    for (int i = 0; i < p->n; i++) {
        int k = p->interval[i], at = p->at[i];
        double h = p->length[i], run = h * s->steps.way.scale * p->heading[i];
        double middle = 0.5 * (p->slope[at] + p->slope[at + 1]) + run / 8 * (p->bend[at] - p->bend[at + 1]);
        s->bend[k] += h * p->mean[i];
        if (s->beta1 != 0)
            s->slope[k] += slope_crossed(h, p->slope[at], p->slope[at + 1], s->beta2, middle);
        s->length[k] += h;
        s->touched[k] = p->limited[at + 1];
    }
}

static bool paper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_SCRAPE && c->contact.force == FORCE_PAPER;
}

static double paper_work(const struct contact *c, const struct scene *s)
{
    return (c->contact.limiter.curve == LIMITER_TANH ? 200 : 80) * steps_pieces(c, s);
}

static bool paper_curvature_open(struct stage_run *r, struct err *e)
{
    struct paper *s = ARENA_TAKE(r->arena, struct paper, 1);
    (void)e;
    s->beta1 = r->contact->contact.beta1;
    s->beta2 = r->contact->contact.beta2;
    steps_make(&s->steps, r, HUGE_VAL);
    s->steps.use = paper_use;
    s->steps.self = s;
    r->state = s;
    r->ahead = 1;
    return true;
}

static bool paper_curvature_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct paper *s = r->state;
    struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = steps_some(first, last);
        double *bend = steps_values(b, ITEM_CURVATURE, first), *slope = steps_values(b, ITEM_SLOPE, first);
        memset(s->bend, 0, sizeof s->bend);
        memset(s->slope, 0, sizeof s->slope);
        memset(s->length, 0, sizeof s->length);
        steps_run(&s->steps, r, first, n);
        for (int i = 0; i < n; i++) {
            bend[i] = s->length[i] > 0 ? s->bend[i] / s->length[i] : s->last_bend;
            slope[i] = s->length[i] > 0 ? s->slope[i] / s->length[i] : 0;
            s->last_bend = s->length[i] > 0 ? s->touched[i] : s->last_bend;
        }
        first += n;
    }
    return true;
}

const struct stage paper_curvature_stage = {
    .name = "paper_curvature",
    .does = "limited curvature and slope of the surface, per axis",
    .paper = "000 eq. 4, 5",
    .idle = "contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA),
    .gives = ITEM_BIT(ITEM_CURVATURE) | ITEM_BIT(ITEM_SLOPE),
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

static bool paper_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct board *b = r->board;
    const struct contact_model *m = &r->contact->contact;
    double per_second = b->rate * b->over, scale = r->contact->surface.along == ALONG_X ? b->trajectory->e[0] : 1;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = steps_some(first, last);
        const double *u = steps_values(b, ITEM_POSITION, first), *bend = steps_values(b, ITEM_CURVATURE, first);
        const double *slope = steps_values(b, ITEM_SLOPE, first);
        double *force = steps_values(b, ITEM_SUBFORCE, first);
        for (int i = 0; i < n; i++) {
            double speed = fabs((u[i + 1] - u[i]) * per_second * scale);
            force[i] = r->contact->scraper.mass * bend[i] * speed * speed;
            if (slope[i] > 0)
                force[i] += m->beta1 * slope[i] * (m->beta2 == 1 ? speed : real_pow(speed, m->beta2));
        }
        steps_lift(r->board, first, n);
        first += n;
    }
    return true;
}

const struct stage paper_stage = {
    .name = "paper",
    .does = "contact force as printed, from curvature and slope",
    .paper = "000 eq. 2, 3",
    .idle = "contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_CURVATURE) | ITEM_BIT(ITEM_SLOPE),
    .takes = ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .wanted = paper_wanted,
    .work = paper_force_work,
    .open = paper_open,
    .run = paper_run,
};
