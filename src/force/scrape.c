/* The force of a scraper that follows one limited trajectory S along its path (`force: directional`).

     dS'/ds + S'/l = T(c(s))          S' slope of S along the direction of travel, s arc length           after papers/000 eq. 4, 5
     f_v = d/dt (m |v| S')            vertical force, N                                                   papers/000 eq. 1
     f_h = beta1 | |v| S' |^beta2     horizontal force, N                                                 papers/000 eq. 3

     m     mass of the scraper, kg                    c      z's curvature along the path, 1/m (surface/curvature.c)
     v     velocity along the path, m/s               T      tanh(alpha c) / alpha
     l     contact.leak, m                            beta1  N (s/m)^beta2

   Departures from papers/000, and why. Equation 2 keeps only S'' v^2 of the second time derivative of S: the term S' a is missing, so
   that momentum is lost at every reversal, and in two dimensions it is not invariant under rotation; here f_v is the whole derivative, along
   the path. The paper defines only S'' (equations 4, 5) but uses S' in equation 3; the integral of the limited curvature drifts away as a random
   walk, hence the leak l. One S serves both forces: the raw slope z' would bring back what the limiter removed. S' starts from 0 at the
   start of the motion, and changes sign where the motion turns round.

   Each sub-interval's mean is exact: that of f_v is the difference of m |v| S' across it, whatever the surface does inside; that of f_h for
   beta2 = 1 is beta1 / dt times the integral of |S'| ds. Over a piece of length h (z = h/l <= 1/16, phi(z) = (1 - e^-z)/z)

     S'(end)           = (1 - z phi) S' + phi h mean(T) + z (1 - z/2) h moment(T)
     integral of S' ds = h (phi S' + chi h mean(T) - (1 - z/2) h moment(T)),   chi = (1 - phi)/z

   mean and first moment of T in closed form (surface/curvature.c). Left out is the leak's weight beyond its straight line: z^2/24 of what
   T varies by within the piece. Where S' changes sign inside a piece its magnitude is taken as two triangles. */
#include <string.h>

#include "force/steps.h"
#include "num/real.h"
#include "num/vecmath.h"

struct scrape {
    struct steps steps;
    double leak, beta1, beta2, mass;
    double slope;                    /* dS/du now: S' times the sign of du           */
    double momentum;                 /* m |v| S' at the end of the last sub-interval */
    double ends[STEPS_CHUNK];        /* dS/du at each sub-interval's end             */
    double crossed[STEPS_CHUNK];     /* integral of |S'|^beta2 ds over it            */
    double travelled[STEPS_CHUNK];   /* m; more than |u1 - u0| where it turns        */
    int filled;                      /* ends[] up to here are known                  */
};

/* (1 - e^-z) / z for 0 <= z <= 1/16: the series' first term left out is z^8 / 9! < 1e-15. */
static double leak_phi(double z)
{
    return 1 - z / 2 * (1 - z / 3 * (1 - z / 4 * (1 - z / 5 * (1 - z / 6 * (1 - z / 7 * (1 - z / 8))))));
}

/* (1 - leak_phi(z)) / z */
static double leak_chi(double z)
{
    return 0.5 * (1 - z / 3 * (1 - z / 4 * (1 - z / 5 * (1 - z / 6 * (1 - z / 7 * (1 - z / 8))))));
}

/* Integral of |S'| over a piece on which S' goes from a to b and whose integral of S' is `plain`. */
static double crossed_slope(double h, double a, double b, double plain)
{
    return a * b < 0 ? h * (a * a + b * b) / (2 * (fabs(a) + fabs(b))) : fabs(plain);
}

/* The same of |S'|^beta2: Simpson's rule on each side of a zero. */
static double crossed_power(double h, const double s[3], double beta2)
{
    double p[3] = {fabs(s[0]), fabs(s[1]), fabs(s[2])};
    vecmath_pow(3, p, beta2, p);
    if (s[0] * s[2] < 0)
        return h * (p[0] * fabs(s[0]) + p[2] * fabs(s[2])) / ((fabs(s[0]) + fabs(s[2])) * (1 + beta2));
    return h * (p[0] + 4 * p[1] + p[2]) / 6;
}

static void scrape_fill(struct scrape *s, int upto)
{
    for (; s->filled < upto; s->filled++)
        s->ends[s->filled] = s->slope;
}

static void scrape_use(void *self, struct curvature_pieces *p)
{
    struct scrape *s = self;
    for (int i = 0; i < p->n; i++) {
        double h = p->length[i], z = h / s->leak, phi = leak_phi(z), moment = (1 - z / 2) * h * p->moment[i];
        double a = s->slope * p->heading[i], b = (1 - z * phi) * a + phi * h * p->mean[i] + z * moment;
        double plain = phi * a + leak_chi(z) * h * p->mean[i] - moment; /* mean of S' */
        s->travelled[p->interval[i]] += h;
        if (s->beta1 != 0)
            s->crossed[p->interval[i]] += s->beta2 == 1 ? crossed_slope(h, a, b, h * plain)
                                                        : crossed_power(h, (double[]){a, 1.5 * plain - 0.25 * (a + b), b}, s->beta2);
        scrape_fill(s, p->interval[i]);
        s->slope = b * p->heading[i];
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
    return (c->contact.limiter.curve == LIMITER_TANH ? 230 : 100) * steps_pieces(c, s);
}

static bool scrape_open(struct stage_run *r, struct err *e)
{
    const struct contact_model *m = &r->contact->contact;
    struct scrape *s = ARENA_TAKE(r->arena, struct scrape, 1);
    (void)e;
    s->leak = m->leak;
    s->beta1 = m->beta1;
    s->beta2 = m->beta2;
    s->mass = r->contact->scraper.mass;
    steps_make(&s->steps, r, m->leak / 16);
    s->steps.use = scrape_use;
    s->steps.self = s;
    r->state = s;
    r->ahead = 1;
    return true;
}

/* Means over the chunk's sub-intervals, from the slopes at their ends. */
static void scrape_forces(struct scrape *s, const struct board *b, long first, int n)
{
    const double *v = steps_values(b, ITEM_VELOCITY, first);
    double *force = steps_values(b, ITEM_SUBFORCE, first), per_second = b->rate * b->over;
    for (int i = 0; i < n; i++) {
        double momentum = s->mass * v[i + 1] * s->ends[i], speed = s->travelled[i] * per_second;
        force[i] = (momentum - s->momentum) * per_second;
        if (s->crossed[i] > 0)
            force[i] += s->beta1 * per_second * s->crossed[i] * (s->beta2 == 1 ? 1 : real_pow(speed, s->beta2 - 1));
        s->momentum = momentum;
    }
}

static bool scrape_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct scrape *s = r->state;
    struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = steps_some(first, last);
        memset(s->crossed, 0, sizeof s->crossed);
        memset(s->travelled, 0, sizeof s->travelled);
        s->filled = 0;
        steps_run(&s->steps, r, first, n);
        scrape_fill(s, n);
        scrape_forces(s, b, first, n);
        steps_lift(b, first, n);
        first += n;
    }
    return true;
}

const struct stage scrape_stage = {
    .name = "scrape",
    .does = "contact force of one limited trajectory along the path",
    .paper = "000 eq. 1, 3, 4, 5",
    .idle = "contact.force is paper",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA) | ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .wanted = scrape_wanted,
    .work = scrape_work,
    .open = scrape_open,
    .run = scrape_run,
};
