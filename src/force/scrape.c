/* The force of a scraper that follows one limited trajectory S along its path (`force: directional`).

     dS'/ds + S'/l = T(c) + kappa S_n       S' = dS/ds, slope of S along the path; s arc length      after papers/000 eq. 4, 5
     dS_n/ds + S_n/l = T(d) - kappa S'      S_n, slope across the path (only where the path is curved)
     f_v = d/dt (m |v| S')                  vertical force, N                                        papers/000 eq. 1
     f_h = beta1 | |v| S' |^beta2           horizontal force, N                                      papers/000 eq. 3

     m     mass of the scraper, kg          c = e' H e, d = e' H n   second derivatives of z along the unit tangent e, and mixed with the
     v     velocity along the path, m/s                              normal n, 1/m; H the surface's Hessian
     l     contact.leak, m                  kappa                    curvature of the path in the plane, 1/m
     T     tanh(alpha c) / alpha            beta1                    N (s/m)^beta2

   Departures from papers/000, and why. Equation 2 keeps only S'' v^2 of the second time derivative of S and leaves out 2 S_xy v_x v_y and the
   gradient times the acceleration: momentum is lost at every reversal, and the force changes when the axes are turned; here f_v is the whole
   derivative along the path. The paper defines only S'' (equations 4, 5) but uses S' in equation 3; the integral of the limited curvature drifts
   away as a random walk, hence the leak l. One S serves both forces: the raw slope z' would bring back what the limiter removed. (S', S_n) is one
   vector, the slope of S in the plane; kappa turns it as the path turns, so that a tight turn and a reversal, where S' changes sign, are the
   same thing in the limit. Along a profile that follows the path there is no S_n. Both slopes start from 0 at the start of the motion.

   Each sub-interval's mean is exact: that of f_v is the difference of m |v| S' across it, whatever the surface does inside; that of f_h for
   beta2 = 1 is beta1 / dt times the integral of |S'| ds. Over a piece of length h (z = h/l <= 1/16, phi(z) = (1 - e^-z)/z)

     S'(end)           = (1 - z phi) S' + phi h mean(T) + z (1 - z/2) h moment(T)
     integral of S' ds = h (phi S' + chi h mean(T) - (1 - z/2) h moment(T)),   chi = (1 - phi)/z

   mean and first moment of T in closed form (surface/limited.c). Left out is the leak's weight beyond its straight line: z^2/24 of what
   T varies by within the piece. The turn of a piece is taken half before, half after it (error (kappa h)^2/24 of the
   piece's part), with kappa h moment(T) of T across it. Where S' changes sign inside a
   piece it is taken as a parabola (beta2 = 1) or two straight lines. */
#include <string.h>

#include "force/lift.h"
#include "force/way.h"
#include "num/real.h"
#include "num/vecmath.h"

struct scrape {
    struct way way;
    double leak, beta1, beta2, mass;
    double slope, across;            /* dS/du, dS/dn now                             */
    double ex, ey;                   /* e where they are; 0, 0: nowhere yet          */
    double momentum;                 /* m v dS/du at the end of the last sub-interval */
    double ends[WAY_CHUNK];          /* dS/du at each sub-interval's end             */
    double crossed[WAY_CHUNK];       /* integral of |S'|^beta2 ds over it            */
    double travelled[WAY_CHUNK];     /* m; more than |u1 - u0| where it turns        */
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

/* Integral of |S'| over a piece on which S' goes from a to b, with that mean: of the parabola a (1 - q) + b q + bow q (1 - q), which has one zero
   between ends of opposite signs. */
static double crossed_slope(double h, double a, double b, double mean)
{
    double bow = 6 * (mean - 0.5 * (a + b)), p = b - a + bow, root = sqrt(fmax(p * p + 4 * bow * a, 0));
    double s = p < 0 ? p - root : p + root, q = s != 0 ? -2 * a / s : 0;
    if (a * b >= 0)
        return h * fabs(mean);
    if (!(q >= 0 && q <= 1))
        q = s / (2 * bow);
    double before = q * (a + q * (0.5 * p - q * bow / 3));
    return h * (fabs(before) + fabs(mean - before));
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

/* The slope vector as seen from axes turned by the angle of that sine and cosine. */
static void scrape_rotate(struct scrape *s, double sine, double cosine)
{
    double slope = s->slope;
    s->slope = slope * cosine + s->across * sine;
    s->across = s->across * cosine - slope * sine;
}

/* From the axes the slope is in to those at a point; at once where the path has a corner. */
static void scrape_face(struct scrape *s, double ex, double ey)
{
    if (s->ex != 0 || s->ey != 0)
        scrape_rotate(s, s->ex * ey - s->ey * ex, s->ex * ex + s->ey * ey);
    s->ex = ex;
    s->ey = ey;
}

/* The unit vector half way between the axes at a piece's two ends, which are never opposed (force/way.c). */
static void scrape_halfway(const struct way_pieces *p, int i, double *ex, double *ey)
{
    double x = p->ex[p->at[i]] + p->ex[p->at[i] + 1], y = p->ey[p->at[i]] + p->ey[p->at[i] + 1], length = sqrt(x * x + y * y);
    *ex = x / length;
    *ey = y / length;
}

/* Slope at the piece's end from that at its start, both in the direction of travel; the mean of the slope. */
static double scrape_step(const struct scrape *s, const struct way_pieces *p, int i, int channel, double a, double *mean)
{
    double h = p->length[i], z = h / s->leak, phi = leak_phi(z), moment = (1 - z / 2) * h * p->moment[channel][i];
    *mean = phi * a + leak_chi(z) * h * p->mean[channel][i] - moment;
    return (1 - z * phi) * a + phi * h * p->mean[channel][i] + z * moment;
}

/* What T varies by within a piece that turns goes partly to the side: T is taken along e half way, and e turns about it. */
static void scrape_lean(struct scrape *s, const struct way_pieces *p, int i)
{
    int a = p->at[i], b = a + 1;
    double turn = p->length[i] * (p->ex[a] * p->ey[b] - p->ey[a] * p->ex[b]);
    s->slope -= turn * p->moment[1][i];
    s->across += turn * p->moment[0][i];
}

static void scrape_piece(struct scrape *s, const struct way_pieces *p, int i)
{
    double h = p->length[i], ex, ey, a, mean, sideways;
    scrape_fill(s, p->interval[i]);
    if (s->way.curved) {
        scrape_halfway(p, i, &ex, &ey);
        scrape_face(s, p->ex[p->at[i]], p->ey[p->at[i]]);
        scrape_face(s, ex, ey);
        s->across = p->heading[i] * scrape_step(s, p, i, 1, s->across * p->heading[i], &sideways);
    }
    a = s->slope * p->heading[i];
    double b = scrape_step(s, p, i, 0, a, &mean);
    s->travelled[p->interval[i]] += h;
    if (s->beta1 != 0)
        s->crossed[p->interval[i]] += s->beta2 == 1 ? crossed_slope(h, a, b, mean)
                                                    : crossed_power(h, (double[]){a, 1.5 * mean - 0.25 * (a + b), b}, s->beta2);
    s->slope = b * p->heading[i];
    if (s->way.curved) {
        scrape_lean(s, p, i);
        scrape_face(s, p->ex[p->at[i] + 1], p->ey[p->at[i] + 1]);
    }
}

static void scrape_use(void *self, const struct way_pieces *p)
{
    for (int i = 0; i < p->n; i++)
        scrape_piece(self, p, i);
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
    const struct contact_model *m = &r->contact->contact;
    struct scrape *s = ARENA_TAKE(r->arena, struct scrape, 1);
    s->leak = m->leak;
    s->beta1 = m->beta1;
    s->beta2 = m->beta2;
    s->mass = r->contact->scraper.mass;
    s->way.use = scrape_use;
    s->way.self = s;
    r->state = s;
    r->ahead = 1;
    return way_make(&s->way, r, WAY_ALONG, m->leak / 16, e);
}

/* Means over the chunk's sub-intervals, from the slopes at their ends. */
static void scrape_forces(struct scrape *s, const struct board *b, long first, int n)
{
    const double *v = way_values(b, ITEM_VELOCITY, first);
    double *force = way_values(b, ITEM_SUBFORCE, first), per_second = b->rate * b->over;
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
        int n = way_some(first, last);
        memset(s->crossed, 0, sizeof s->crossed);
        memset(s->travelled, 0, sizeof s->travelled);
        s->filled = 0;
        way_run(&s->way, r, first, n);
        scrape_fill(s, n);
        scrape_forces(s, b, first, n);
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
