/* The surface's heights are the force (`contact.model: playback`): the surface is played like a record, at the
   contact's speed. FoleyAutomatic (van den Doel, Kry and Pai 2001), as papers/002 section II-B describes it, plays a
   noise "at varying speeds according to the relative velocity of the interacting objects", which is "assumed to model
   the surface roughness", such as a fractal surface.

     f(t) = k z(x(t))          f force, N      k contact.playback.stiffness, N/m      z height of the surface where the
                                               contact is, m

   Departures. The paper plays a sampled noise; here it is the surface itself, whatever it is made of, in metres and
   newtons, and in the plane too. Heights are taken as they are: a mean is a constant force (surface.levelling takes
   that of a map away). Nothing follows the surface: no limiter, no mass, no load. Before the motion begins and after it
   has ended there is no force.

   Each sub-interval's value is the mean of k z(x(t)) over it, so that momentum is kept and no asperity is skipped
   however fast the contact goes. Inside a sub-interval each coordinate is the cubic in time through places and
   velocities at its ends (error h^4 d4x/dt4 / 384: below 1e-16 m for hands; where a velocity jumps inside, at most dv h
   / 8). It is cut where a coordinate turns, at every line of knots of the surface, and into lengths of at most half the
   surface's finest scale; over each piece z is smooth, and is integrated over time by Gauss and Legendre's rule of five
   points: exact to rounding for cubic and bicubic splines at steady speed, else to 1e-9 of the heights. */
#include <math.h>
#include <string.h>

#include "force/path_cells.h"
#include "scene/rows.h"
#include "trajectory/trajectory.h"

enum { BATCH = 512, GAUSS = 5, TURNS = 4 };

/* Abscissae on [0, 1] and weights (Abramowitz and Stegun, 25.4.30). */
static const double gauss_at[GAUSS] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                       0.953089922969332};
static const double gauss_share[GAUSS] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                          0.23931433524968324, 0.11846344252809454};

struct cubic {
    double a[4]; /* a0 + q (a1 + q (a2 + q a3)), q the share of the sub-interval's time, 0 to 1 */
};

struct playback {
    struct path_cells path; /* its places and knots alone */
    double stiffness, longest;
    double *force; /* of the present chunk */
    int n;         /* points */
    int interval[BATCH];
    double x[BATCH], y[BATCH], share[BATCH];
};

struct crossing {    /* of one family of knots */
    double knot, at; /* number; q, HUGE_VAL: none */
};

/* ------------------------------------------------------------------ cubics */

static struct cubic cubic_of(double x0, double x1, double v0, double v1, double h)
{
    double d = x1 - x0, p = v0 * h, q = v1 * h;
    return (struct cubic){{x0, p, 3 * d - 2 * p - q, p + q - 2 * d}};
}

static struct cubic cubic_times(struct cubic c, double from, double by)
{
    return (struct cubic){{from + by * c.a[0], by * c.a[1], by * c.a[2], by * c.a[3]}};
}

static double cubic_at(const struct cubic *c, double q)
{
    return c->a[0] + q * (c->a[1] + q * (c->a[2] + q * c->a[3]));
}

static double cubic_slope(const struct cubic *c, double q) { return c->a[1] + q * (2 * c->a[2] + q * 3 * c->a[3]); }

/* Adds the places inside (0, 1) at which it turns. */
static int cubic_turns(const struct cubic *c, double *turn, int n)
{
    double a = 3 * c->a[3], b = c->a[2], root = b * b - a * c->a[1],
           s = b < 0 ? b - sqrt(fmax(root, 0)) : b + sqrt(fmax(root, 0));
    double at[2] = {a != 0 ? -s / a : 0, s != 0 ? -c->a[1] / s : 0};
    for (int k = 0; k < 2 && root > 0; k++)
        if (at[k] > 0 && at[k] < 1) turn[n++] = at[k];
    return n;
}

/* Where it reaches `value` between from and to, over which it rises or falls throughout: Newton's steps, halving where
 * they lead outside. */
static double cubic_reaches(const struct cubic *c, double value, double from, double to)
{
    double a = cubic_at(c, from), b = cubic_at(c, to), low = from, high = to,
           q = from + (to - from) * (value - a) / (b - a);
    for (int i = 0; i < 60; i++) {
        double off = cubic_at(c, q) - value, slope = cubic_slope(c, q), step = slope != 0 ? off / slope : HUGE_VAL;
        *((off < 0) == (a < b) ? &low : &high) = q;
        double next = q - step;
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        if (fabs(next - q) <= 1e-13) return next;
        q = next;
    }
    return q;
}

/* ------------------------------------------------------------------ points */

static void playback_flush(struct playback *p)
{
    double z[BATCH];
    if (p->n == 0) return;
    relief_at(p->path.relief,
              &(struct relief_points){(size_t)p->n, p->x, p->path.relief->along == ALONG_PLANE ? p->y : NULL},
              &(struct relief_values){.z = z});
    for (int i = 0; i < p->n; i++)
        p->force[p->interval[i]] += p->share[i] * z[i];
    p->n = 0;
}

static void playback_piece(struct playback *p, const struct cubic c[2], int interval, double from, double to,
                           double share)
{
    if (p->n + GAUSS > BATCH) playback_flush(p);
    for (int k = 0; k < GAUSS; k++, p->n++) {
        double q = from + (to - from) * gauss_at[k];
        p->x[p->n] = cubic_at(&c[0], q);
        p->y[p->n] = cubic_at(&c[1], q);
        p->share[p->n] = share * (to - from) * gauss_share[k];
        p->interval[p->n] = interval;
    }
}

/* ------------------------------------------------------------------ cutting */

/* The family's next knot behind that of `from` (NAN: the first), up to `to`. */
static struct crossing playback_next(const struct knot_lines *g, const struct cubic *c, double from, double to,
                                     double last)
{
    double a = (cubic_at(c, from) - g->origin) / g->pitch, b = (cubic_at(c, to) - g->origin) / g->pitch;
    double knot = isnan(last) ? (a < b ? floor(a) + 1 : ceil(a) - 1) : last + (a < b ? 1 : -1);
    bool within = a < b ? knot < b : knot > b;
    return (struct crossing){knot,
                             a != b && within ? cubic_reaches(c, g->origin + knot * g->pitch, from, to) : HUGE_VAL};
}

/* Both coordinates rise or fall throughout. */
static void playback_stretch(struct playback *p, const struct cubic c[2], int interval, const double ends[2],
                             double share)
{
    struct crossing next[CELLS_KNOTS];
    const struct path_cells *w = &p->path;
    double fastest = 0, at = ends[0], to = ends[1];
    for (int k = 0; k < 2; k++)
        fastest += fabs(c[k].a[1]) + 2 * fabs(c[k].a[2]) + 3 * fabs(c[k].a[3]);
    double step = fastest > 0 ? p->longest / fastest : HUGE_VAL;
    for (int g = 0; g < w->n_knots; g++)
        next[g] = playback_next(&w->knots[g], &c[w->knots[g].axis], at, to, NAN);
    while (at < to) {
        double end = fmin(to, fmax(at + step, at + 1e-12));
        for (int g = 0; g < w->n_knots; g++)
            end = fmin(end, fmax(next[g].at, at));
        if (end > at) playback_piece(p, c, interval, at, end, share);
        at = end;
        for (int g = 0; g < w->n_knots; g++)
            if (next[g].at <= at) next[g] = playback_next(&w->knots[g], &c[w->knots[g].axis], at, to, next[g].knot);
    }
}

static void playback_interval(struct playback *p, const struct cubic c[2], int interval, double share)
{
    double turn[TURNS + 1];
    int n = cubic_turns(&c[1], turn, cubic_turns(&c[0], turn, 0));
    turn[n++] = 1;
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && turn[k] < turn[k - 1]; k--) {
            double swap = turn[k];
            turn[k] = turn[k - 1];
            turn[k - 1] = swap;
        }
    for (int i = 0; i < n; i++)
        playback_stretch(p, c, interval, (double[2]){i ? turn[i - 1] : 0, turn[i]}, share);
}

/* ------------------------------------------------------------------ the stage */

static void playback_place(const struct path_cells *w, const struct board *b, long k, double h, struct cubic c[2])
{
    if (w->curved) {
        const double *x = cells_values(b, ITEM_X, k), *y = cells_values(b, ITEM_Y, k),
                     *vx = cells_values(b, ITEM_VX, k), *vy = cells_values(b, ITEM_VY, k);
        c[0] = cubic_of(x[0], x[1], vx[0], vx[1], h);
        c[1] = cubic_of(y[0], y[1], vy[0], vy[1], h);
        return;
    }
    const double *u = cells_values(b, ITEM_POSITION, k), *v = cells_values(b, ITEM_VELOCITY, k);
    struct cubic along = cubic_of(u[0], u[1], v[0], v[1], h);
    for (int axis = 0; axis < 2; axis++)
        c[axis] = cubic_times(along, w->from[axis], w->e[axis]);
}

/* Behind the motion's end the board holds what was there at the end: so the last sub-interval runs up to it. */
static void playback_chunk(struct playback *p, const struct board *b, long first, int n)
{
    double dt = 1 / (b->rate * b->over), end = b->trajectory->duration;
    p->force = cells_values(b, ITEM_SUBFORCE, first);
    memset(p->force, 0, (size_t)n * sizeof *p->force);
    for (int i = 0; i < n; i++) {
        double h = fmin(dt, end - (double)(first + i) * dt);
        struct cubic c[2];
        if (!(h > 0)) break;
        playback_place(&p->path, b, first + i, h, c);
        playback_interval(p, c, i, p->stiffness * h / dt);
    }
    playback_flush(p);
}

struct playback_given {
    double stiffness; /* N/m: force for a metre of the surface's height */
};

static const struct key keys[] = {{ROW_NUMBER(playback_given, stiffness, "contact.playback.stiffness"), KEY_STIFFNESS,
                                   1e-6, 1e15, "1e5 N/m", "contact.model=playback",
                                   "force for a metre of the surface's height"},
                                  {.path = NULL}};

static bool plays(const struct contact *c) { return c->contact.model == CONTACT_PLAYBACK; }

static const struct params playback_params = {
    .section = "contact.playback", .size = sizeof(struct playback_given), .keys = keys, .given = plays};

static double playback_work(const struct contact *c, const struct scene *s) { return 90 * path_cells_work(c, s); }

static bool playback_open(struct stage_run *r, struct err *e)
{
    struct playback *p = ARENA_TAKE(r->arena, struct playback, 1);
    r->state = p;
    r->ahead = 1;
    p->stiffness = ((const struct playback_given *)params_of(r->contact, &playback_params))->stiffness;
    p->longest = relief_finest(r->board->relief) / 2;
    return path_cells_place(&p->path, r, e);
}

static bool playback_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = cells_chunk(first, last);
        playback_chunk(r->state, b, first, n);
        first += n;
    }
    return true;
}

const struct stage playback_stage = {
    .name = "playback",
    .params = &playback_params,
    .does = "the surface's heights are the force, played at the contact's speed",
    .paper = "002 sec. II-B",
    .idle = "contact.model is not playback",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .asks = path_cells_asks,
    .work = playback_work,
    .open = playback_open,
    .run = playback_run,
};
