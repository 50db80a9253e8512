/* Stretches. Between two force samples a curved path is the cubic Hermite curve through both places with both unit
   tangents, its parameter w from 0 to the arc length h travelled: within h^4 kappa''.. / 384 of the path, below 1e-16 m
   at 10 um. Along a profile, and on a straight path, places are exact straight lines in u.

   Knots. The next knot is looked for along each family's coordinate, which runs nearly straight over a stretch: one
   Newton step from the tangent's crossing. A knot missed by rounding, or a knot line that a curve just touches between
   two places, leaves a kink inside a cell: the cell's mean is off by half the kink of its slope times what was missed
   (a part in 1e7 of a pitch by rounding, kappa h^2 / 8 of a line touched).

   Measured on a circle over roughness, where cutting was a quarter of all: the step is made for knots alone that may be
   the next ones, on one coordinate; and a stretch that begins where the one before ended shares its point, so that a
   third fewer are read and limited. */
#include "force/path_cells.h"

#include <math.h>
#include <string.h>

#include "num/lanes.h"
#include "scene/rules.h"
#include "surface/height_map.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "surface/roughness.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

#define INLINE static inline __attribute__((always_inline))
/* ------------------------------------------------------------------ values at the points */

LANES_CLONES
static void values_along(struct path_cells *w)
{
    struct cells *p = &w->cells;
    int n = p->points;
#pragma omp simd
    for (int k = 0; k < n; k++) {
        double x = p->ex[k], y = p->ey[k];
        p->curvature[0][k] = x * x * w->xx[k] + 2 * x * y * w->xy[k] + y * y * w->yy[k];
    }
    n = w->channels == 2 ? n : 0;
#pragma omp simd
    for (int k = 0; k < n; k++) {
        double x = p->ex[k], y = p->ey[k];
        p->curvature[1][k] = x * y * (w->yy[k] - w->xx[k]) + (x * x - y * y) * w->xy[k];
    }
}

static void values_axes(struct path_cells *w)
{
    struct cells *p = &w->cells;
    for (int k = 0; k < p->points; k++) {
        double x = p->ex[k], y = p->ey[k];
        p->curvature[0][k] = w->xx[k];
        p->curvature[1][k] = w->yy[k];
        p->bend[k] = x * x * w->xx[k] + 2 * x * y * w->xy[k] + y * y * w->yy[k];
    }
}

static void values_slope(struct cells *p, const double *zx, const double *zy)
{
    for (int k = 0; k < p->points; k++)
        p->slope[k] = p->ex[k] * zx[k] + p->ey[k] * zy[k];
}

/* Pieces come in pairs (a, m), (m, b): of a parabola through the three, each half bulges by a quarter of what m lies
 * above the chord. */
static void values_sagitta(struct cells *p, int channel)
{
    const double *c = p->curvature[channel];
    for (int i = 0; i < p->n; i += 2) {
        int a = p->at[i];
        p->sagitta[channel][i] = p->sagitta[channel][i + 1] = 0.25 * (c[a + 1] - 0.5 * (c[a] + c[a + 2]));
    }
}

static void cells_flush(struct path_cells *w)
{
    struct cells *p = &w->cells;
    bool plane = w->relief->along == ALONG_PLANE, axes = w->kind == CELLS_AXES;
    double zx[LIMITER_POINTS], zy[LIMITER_POINTS] = {0};
    if (p->n == 0) return;
    relief_at(w->relief, &(struct relief_points){(size_t)p->points, p->x, plane ? p->y : NULL},
              &(struct relief_values){.x = axes ? zx : NULL,
                                      .y = axes && plane ? zy : NULL,
                                      .xx = w->along ? p->curvature[0] : w->xx,
                                      .xy = plane ? w->xy : NULL,
                                      .yy = plane ? w->yy : NULL});
    if (axes) values_slope(p, zx, zy);
    if (axes)
        values_axes(w);
    else if (!w->along)
        values_along(w);
    for (int k = 0; k < w->channels; k++) {
        if (w->halves) values_sagitta(p, k);
        limiter_cells(&(struct limiter_cells){p->n, p->points, p->at, p->alpha[k], p->curvature[k],
                                              w->halves ? p->sagitta[k] : NULL, p->limited[k], p->mean[k],
                                              p->moment[k]},
                      w->limiter);
    }
    w->integrate(w->self, p);
    p->n = p->points = 0;
}

/* ------------------------------------------------------------------ cutting a stretch at the knots */

struct hermite {                             /* Hermite curve of a curved path over one stretch */
    double x[2], y[2], ex[2], ey[2], length; /* ends, unit tangents in the direction of travel, m */
};

struct stretch {
    double u, end; /* m: where the stretch begins and ends  */
    double alpha;  /* m, of channel 0                       */
    int interval;
    struct hermite path; /* of a curved path                       */
};

struct spot {
    double x, y, ex, ey; /* as the relief wants it; e in the direction of increasing u */
};

/* Hermite basis at share q, and its derivatives over q. */
static struct spot curve_at(const struct hermite *c, double w)
{
    double q = w / c->length, p = 1 - q, h = c->length;
    double a = p * p * (1 + 2 * q), b = q * q * (1 + 2 * p), s = q * p * p * h, t = -q * q * p * h;
    double da = -6 * q * p / h, ds = p * (p - 2 * q), dt = q * (q - 2 * p);
    struct spot r = {.x = a * c->x[0] + b * c->x[1] + s * c->ex[0] + t * c->ex[1],
                     .y = a * c->y[0] + b * c->y[1] + s * c->ey[0] + t * c->ey[1]};
    double dx = da * (c->x[0] - c->x[1]) + ds * c->ex[0] + dt * c->ex[1],
           dy = da * (c->y[0] - c->y[1]) + ds * c->ey[0] + dt * c->ey[1];
    double d = sqrt(dx * dx + dy * dy);
    r.ex = d > 0 ? dx / d : c->ex[0];
    r.ey = d > 0 ? dy / d : c->ey[0];
    return r;
}

static int heading(const struct stretch *s) { return s->end > s->u ? 1 : -1; }

/* `done` m into the stretch. */
static struct spot spot_at(const struct path_cells *w, const struct stretch *s, double done)
{
    double u = s->u + heading(s) * done;
    if (!w->curved) return (struct spot){w->from[0] + u * w->e[0], w->from[1] + u * w->e[1], w->e[0], w->e[1]};
    struct spot r = curve_at(&s->path, done);
    r.ex *= heading(s);
    r.ey *= heading(s);
    return r;
}

/* One coordinate of the curve; *rate: its derivative. */
static double curve_along(const struct hermite *c, int axis, double w, double *rate)
{
    const double *x = axis ? c->y : c->x, *e = axis ? c->ey : c->ex;
    double h = c->length, q = w / h, p = 1 - q, b = q * q * (1 + 2 * p);
    *rate = 6 * q * p / h * (x[1] - x[0]) + p * (p - 2 * q) * e[0] + q * (q - 2 * p) * e[1];
    return x[0] + b * (x[1] - x[0]) + q * p * h * (p * e[0] - q * e[1]);
}

/* Where the stretch reaches the family's next knot, along the tangent; corrected once if that may be before `nearest`.
 */
static double grid_next(const struct path_cells *w, const struct knot_lines *g, const struct stretch *s, double done,
                        const struct spot *at, double nearest)
{
    double rate = heading(s) * (g->axis ? at->ey : at->ex) / g->pitch,
           q = ((g->axis ? at->y : at->x) - g->origin) / g->pitch;
    double slack = 1e-7 * (1 + fabs(q) * 1e-6); /* a knot just reached is not the next one */
    if (fabs(rate) * (fabs(s->end - s->u) - done) < 1e-9) return HUGE_VAL;
    double edge = rate > 0 ? floor(q + slack) + 1 : ceil(q - slack) - 1, next = done + (edge - q) / rate;
    if (!w->curved || !(next < s->path.length) || next - done > 2 * (nearest - done)) return next;
    double speed, left = edge - (curve_along(&s->path, g->axis, next, &speed) - g->origin) / g->pitch,
                  better = next + left * g->pitch / speed;
    return fabs(speed) > 0.1 * fabs(rate * g->pitch) && better > done ? better : next;
}

static void add_point(struct path_cells *w, const struct stretch *s, const struct spot *at)
{
    struct cells *p = &w->cells;
    int k = p->points++;
    p->x[k] = at->x;
    p->y[k] = at->y;
    p->ex[k] = at->ex;
    p->ey[k] = at->ey;
    p->alpha[0][k] = s->alpha;
    p->alpha[1][k] = s->alpha * w->ratio;
}

/* Is the last point this very one, and of the same alpha? */
static bool last_point(const struct cells *p, const struct stretch *s, const struct spot *at)
{
    int k = p->points - 1;
    return k >= 0 && p->x[k] == at->x && p->y[k] == at->y && p->ex[k] == at->ex && p->ey[k] == at->ey &&
           p->alpha[0][k] == s->alpha;
}

static void add_cell(struct path_cells *w, const struct stretch *s, double length, const struct spot *end)
{
    struct cells *p = &w->cells;
    int i = p->n++;
    p->at[i] = p->points - 1;
    p->interval[i] = s->interval;
    p->heading[i] = heading(s);
    p->length[i] = length;
    add_point(w, s, end);
}

/* Adds the stretch's cells. */
static void cut_stretch(struct path_cells *w, const struct stretch *s)
{
    struct cells *p = &w->cells;
    double whole = fabs(s->end - s->u), done = 0;
    struct spot at = spot_at(w, s, done);
    bool chained = false;
    while (done < whole) {
        double next = fmin(whole, done + w->longest);
        if (p->n + 2 > LIMITER_CELLS || p->points + 3 > LIMITER_POINTS) {
            cells_flush(w);
            chained = false;
        }
        for (int k = 0; k < w->n_knots; k++)
            next = fmin(next, grid_next(w, &w->knots[k], s, done, &at, next));
        if (!(next > done)) next = done + fmax(1e-12 * whole, 4e-16 * fabs(done)); /* no progress in floating point */
        struct spot end = spot_at(w, s, next);
        if (!chained && !last_point(p, s, &at)) add_point(w, s, &at);
        chained = true;
        if (w->halves) {
            struct spot middle = spot_at(w, s, 0.5 * (done + next));
            add_cell(w, s, 0.5 * (next - done), &middle);
            add_cell(w, s, 0.5 * (next - done), &end);
        } else {
            add_cell(w, s, next - done, &end);
        }
        at = end;
        done = next;
    }
}

/* ------------------------------------------------------------------ the common case */

/* A straight path, one channel. The sub-intervals' first knots are looked for all at once, and where one ends in the
   same place and at the same alpha as the next begins, their cells share the point. Measured on a line over roughness
   at one sub-interval a sample: a third of what cut_stretch takes for each cell, and half the points where alpha is
   constant; a whole render in draft over a map on a line fell from 794 to 621 cycles a sample. Operations are those of
   cut_stretch in the same order: so are the bits. */
struct straight_chunk {
    const double *u;            /* m: sub-interval i goes from u[i] to u[i + 1]  */
    double alpha[CELLS_CHUNK];  /* m */
    double first[CELLS_CHUNK];  /* m: length of its first cell                  */
    double second[CELLS_CHUNK]; /* m: behind its first cell no knot is nearer   */
    int cells[CELLS_CHUNK];     /* 1 or 2, where that is known beforehand; else 0 */
};

struct knots {
    double from, e, origin, pitch;
    int n;
};

/* One family's: first[i] m into the sub-interval or before is the nearest knot of all, not before second[i] the one
 * after it. */
LANES_CLONES
static void knots_first(const struct knots *g, const double *u, double *first, double *second)
{
    double from = g->from, e = g->e, origin = g->origin, pitch = g->pitch, each = pitch / fabs(e), along = e / pitch;
    int n = g->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double heading = lanes_select(u[i + 1] > u[i], 1, -1), whole = fabs(u[i + 1] - u[i]);
        double rate = heading * along, q = (from + u[i] * e - origin) / pitch, slack = 1e-7 * (1 + fabs(q) * 1e-6);
        double edge = lanes_select(rate > 0, lanes_floor(q + slack) + 1, lanes_ceil(q - slack) - 1);
        int none = fabs(rate) * whole < 1e-9;
        double next = lanes_select(none, HUGE_VAL, (edge - q) / lanes_select(none, 1, rate));
        double later = lanes_select(next < first[i], first[i], next) - 1e-6 * each, again = next + 0.99 * each;
        later = lanes_select(again < later, again, later);
        first[i] = lanes_select(next < first[i], next, first[i]);
        second[i] = lanes_select(later < second[i], later, second[i]);
    }
}

/* A sub-interval without a knot is one cell; with one knot, and none that may lie near behind it, it is two. */
LANES_CLONES
static void cells_count(const struct path_cells *w, struct straight_chunk *s, int n)
{
    const double *u = s->u, *second = s->second;
    double longest = w->longest, *first = s->first;
    int *cells = s->cells;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double whole = fabs(u[i + 1] - u[i]), most = lanes_select(whole < longest, whole, longest);
        double length = lanes_select(first[i] < most, first[i], most), left = whole - length;
        int one = (left == 0) & (whole > 0), two = (left > 0) & (whole < second[i]) & (whole <= longest);
        first[i] = length;
        cells[i] = one + 2 * two;
    }
}

static void look_ahead(const struct path_cells *w, struct straight_chunk *s, int n)
{
    for (int i = 0; i < n; i++)
        s->first[i] = s->second[i] = HUGE_VAL;
    for (int k = 0; k < w->n_knots; k++) {
        const struct knot_lines *g = &w->knots[k];
        if (w->e[g->axis] != 0)
            knots_first(&(struct knots){w->from[g->axis], w->e[g->axis], g->origin, g->pitch, n}, s->u, s->first,
                        s->second);
    }
    cells_count(w, s, n);
}

/* A sub-interval. */
struct interval {
    int i, heading;
    double u, alpha;
};

/* Where the next cell ends that begins `done` m into the sub-interval. */
static double cell_end(const struct path_cells *w, const struct interval *v, double whole, double done)
{
    double next = done + w->longest < whole ? done + w->longest : whole;
    for (int k = 0; k < w->n_knots; k++) {
        const struct knot_lines *g = &w->knots[k];
        double at = w->from[g->axis] + (v->u + v->heading * done) * w->e[g->axis];
        double rate = v->heading * w->e[g->axis] / g->pitch, q = (at - g->origin) / g->pitch,
               slack = 1e-7 * (1 + fabs(q) * 1e-6);
        if (fabs(rate) * (whole - done) < 1e-9) continue;
        double knot = done + ((rate > 0 ? lanes_floor(q + slack) + 1 : lanes_ceil(q - slack) - 1) - q) / rate;
        next = knot < next ? knot : next;
    }
    return next > done ? next : done + fmax(1e-12 * whole, 4e-16 * fabs(done)); /* no progress in floating point */
}

/* Point k, `done` m into the sub-interval. */
INLINE void put_point(struct path_cells *w, int k, const struct interval *v, double done, bool halves)
{
    double u = v->u + v->heading * done;
    w->cells.x[k] = w->from[0] + u * w->e[0];
    if (halves) w->cells.y[k] = w->from[1] + u * w->e[1];
    w->cells.alpha[0][k] = v->alpha;
}

/* The point where cells begin, `done` m into the sub-interval; the last one counts as it where it is the same. Makes
 * room for four cells. */
INLINE void put_start(struct path_cells *w, const struct interval *v, double done, bool halves)
{
    struct cells *p = &w->cells;
    if (p->n + 4 > LIMITER_CELLS || p->points + 5 > LIMITER_POINTS) cells_flush(w);
    int k = p->points;
    put_point(w, k, v, done, halves);
    if (k == 0 || p->x[k - 1] != p->x[k] || (halves && p->y[k - 1] != p->y[k]) || p->alpha[0][k - 1] != v->alpha)
        p->points++;
}

INLINE void put_cell(struct cells *p, int k, const struct interval *v, double length)
{
    p->at[p->n + k] = p->points - 1 + k;
    p->interval[p->n + k] = v->i;
    p->heading[p->n + k] = v->heading;
    p->length[p->n + k] = length;
}

/* What lies between `done` and `next` m, as cell k behind those that are counted, or its two halves as cells 2 k and
 * 2 k + 1. */
INLINE void put_part(struct path_cells *w, int k, const struct interval *v, double done, double next, bool halves)
{
    struct cells *p = &w->cells;
    if (!halves) {
        put_cell(p, k, v, next - done);
        put_point(w, p->points + k, v, next, false);
        return;
    }
    put_cell(p, 2 * k, v, 0.5 * (next - done));
    put_cell(p, 2 * k + 1, v, 0.5 * (next - done));
    put_point(w, p->points + 2 * k, v, 0.5 * (done + next), true);
    put_point(w, p->points + 2 * k + 1, v, next, true);
}

INLINE void count_parts(struct cells *p, int n, bool halves)
{
    p->n += halves ? 2 * n : n;
    p->points += halves ? 2 * n : n;
}

static struct interval interval_of(const struct straight_chunk *s, int i)
{
    return (struct interval){i, s->u[i + 1] > s->u[i] ? 1 : -1, s->u[i], s->alpha[i]};
}

static void cut_one(struct path_cells *w, const struct straight_chunk *s, int i)
{
    struct interval v = interval_of(s, i);
    double whole = fabs(s->u[i + 1] - s->u[i]), done = 0, next = s->first[i];
    for (; done < whole; done = next, next = done < whole ? cell_end(w, &v, whole, done) : 0) {
        put_start(w, &v, done, w->halves);
        put_part(w, 0, &v, done, next, w->halves);
        count_parts(&w->cells, 1, w->halves);
    }
}

/* Sub-intervals of one or two cells: whether a knot lies inside is for a CPU to guess, and it guesses wrong, so that
   two are written every time and one or two are counted. A third of what cut_one takes. */
INLINE void cut_few(struct path_cells *w, const struct straight_chunk *s, int i, int end, bool halves)
{
    for (; i < end; i++) {
        struct interval v = interval_of(s, i);
        put_start(w, &v, 0, halves);
        put_part(w, 0, &v, 0, s->first[i], halves);
        put_part(w, 1, &v, s->first[i], fabs(s->u[i + 1] - s->u[i]), halves);
        count_parts(&w->cells, s->cells[i], halves);
    }
}

static void cut_straight(struct path_cells *w, const struct straight_chunk *s, int i, int end)
{
    while (i < end) {
        int from = i;
        while (i < end && s->cells[i])
            i++;
        if (w->halves)
            cut_few(w, s, from, i, true);
        else
            cut_few(w, s, from, i, false);
        if (i < end) cut_one(w, s, i++);
    }
}

/* ------------------------------------------------------------------ sub-intervals */

struct instant {
    double u, x, y, ex, ey;
};

/* A chunk's motion, looked up once. */
struct motion_chunk {
    const double *u, *du, *x, *y, *vx, *vy; /* x to vy: of a curved path */
    double top;
};

static struct motion_chunk motion_of(const struct path_cells *w, const struct board *b, long first)
{
    struct motion_chunk m = {.u = cells_values(b, ITEM_POSITION, first),
                             .du = cells_values(b, ITEM_VELOCITY, first),
                             .top = b->trajectory->top_speed};
    if (w->curved) {
        m.x = cells_values(b, ITEM_X, first);
        m.y = cells_values(b, ITEM_Y, first);
        m.vx = cells_values(b, ITEM_VX, first);
        m.vy = cells_values(b, ITEM_VY, first);
    }
    return m;
}

/* The instant's place; its direction is 0, 0 where the contact rests. */
static struct instant instant_at(const struct path_cells *w, const struct motion_chunk *m, int k)
{
    struct instant i = {.u = m->u[k]};
    if (!w->curved) return i;
    double vx = m->vx[k], vy = m->vy[k], v = sqrt(vx * vx + vy * vy);
    i.x = m->x[k];
    i.y = m->y[k];
    if (v > 1e-6 * m->top) {
        i.ex = vx / v;
        i.ey = vy / v;
    }
    return i;
}

static bool at_rest(struct instant i) { return i.ex == 0 && i.ey == 0; }

/* From a to b on a smooth curve. Where the contact rests at one end the direction is that of the other: a chord of a
   few last places of the coordinates points anywhere. */
static void cut_between(struct path_cells *w, struct instant a, struct instant b, double alpha, int interval)
{
    struct stretch s = {.u = a.u, .end = b.u, .alpha = alpha, .interval = interval};
    double dx = b.x - a.x, dy = b.y - a.y, chord = w->curved ? sqrt(dx * dx + dy * dy) : 0;
    if (a.u == b.u || (w->curved && chord == 0)) return;
    if (w->curved) {
        struct instant from = at_rest(a) ? b : a, to = at_rest(b) ? a : b;
        if (at_rest(from)) from.ex = to.ex = dx / chord, from.ey = to.ey = dy / chord;
        double h = fabs(b.u - a.u);
        if (chord < 0.9 * h) { /* the last places of x, y are coarser than those of u: straight on */
            b.x = a.x + h * from.ex, b.y = a.y + h * from.ey;
            to = from;
        }
        s.path = (struct hermite){
            .x = {a.x, b.x}, .y = {a.y, b.y}, .length = h, .ex = {from.ex, to.ex}, .ey = {from.ey, to.ey}};
    }
    cut_stretch(w, &s);
}

/* Sub-interval i of the chunk that begins with number `first`. Where the motion turns round on itself it is two
   stretches, each in its own side's direction. So it is on a curve where the turn is too slow or too small for its
   instant to be found: then that is half way. */
static void cut_interval(struct path_cells *w, const struct board *board, const struct motion_chunk *m, long first,
                         int i, double alpha, struct instant a, struct instant b)
{
    double dt = 1 / (board->rate * board->over), t0 = (double)(first + i) * dt, t1 = (double)(first + i + 1) * dt;
    bool turns = w->curved ? a.ex * b.ex + a.ey * b.ey < 0 : m->du[i] * m->du[i + 1] < 0;
    double turn = turns ? trajectory_turning(board->trajectory, t0, t1) : NAN;
    struct instant middle = {0};
    if (!turns || (!w->curved && isnan(turn))) {
        cut_between(w, a, b, alpha, i);
        return;
    }
    if (isnan(turn)) turn = 0.5 * (t0 + t1);
    trajectory_at(
        board->trajectory, 1, &turn,
        (struct trajectory_out){.u = &middle.u, .x = w->curved ? &middle.x : NULL, .y = w->curved ? &middle.y : NULL});
    cut_between(w, a, middle, alpha, i);
    cut_between(w, middle, b, alpha, i);
}

/* Of each of the n sub-intervals. */
static void alphas_of(const struct stage_run *r, long first, int n, double *alpha)
{
    const struct board *b = r->board;
    bool varies = board_has(b, ITEM_ALPHA);
    const double *given = varies ? cells_values(b, ITEM_ALPHA, first) : NULL;
    double fixed = varies ? NAN : limiter_constant(r->contact);
    for (int i = 0; i < n; i++)
        alpha[i] = varies ? 0.5 * (given[i] + given[i + 1]) : fixed;
}

void path_cells_run(struct path_cells *w, const struct stage_run *r, long first, int n)
{
    struct motion_chunk m = motion_of(w, r->board, first);
    struct straight_chunk s;
    struct instant ends[2] = {{0}, instant_at(w, &m, 0)};
    s.u = m.u;
    alphas_of(r, first, n, s.alpha);
    if (w->straight) look_ahead(w, &s, n);
    for (int i = 0; i < n; i++) {
        int end = i;
        while (w->straight && end < n && m.du[end] * m.du[end + 1] >= 0)
            end++;
        if (end > i) {
            cut_straight(w, &s, i, end);
            i = end - 1;
            continue;
        }
        ends[0] = w->straight ? instant_at(w, &m, i) : ends[1];
        ends[1] = instant_at(w, &m, i + 1);
        cut_interval(w, r->board, &m, first, i, s.alpha[i], ends[0], ends[1]);
    }
    cells_flush(w);
}

/* ------------------------------------------------------------------ making */

static bool knots_of(struct path_cells *w, const char *contact, struct err *e)
{
    for (const struct relief_part *p = w->relief->first; p; p = p->next)
        for (int axis = 0; axis < 2; axis++) {
            struct knot_lines g = {
                .axis = axis, .pitch = p->pitch[axis], .origin = p->origin[axis] + relief_shift(w->relief, axis)};
            bool known = g.pitch <= 0 || (axis == 1 && w->relief->along != ALONG_PLANE);
            for (int k = 0; k < w->n_knots; k++)
                known = known ||
                        (w->knots[k].axis == axis && w->knots[k].pitch == g.pitch && w->knots[k].origin == g.origin);
            if (known) continue;
            if (w->n_knots == CELLS_KNOTS)
                return err_set(e, ERR_SCENE,
                               "contact '%s': the surface is made of too many parts: leave out one of height_map, "
                               "roughness, ridges, grit",
                               contact);
            w->knots[w->n_knots++] = g;
        }
    return true;
}

static bool linear_between_knots(const struct relief *r)
{
    for (const struct relief_part *p = r->first; p; p = p->next)
        if (!p->linear) return false;
    return true;
}

bool path_cells_place(struct path_cells *w, const struct stage_run *r, struct err *e)
{
    const struct trajectory *tr = r->board->trajectory;
    int along = r->board->relief->along;
    w->relief = r->board->relief;
    w->field = along != ALONG_PATH;
    w->curved = w->field && !tr->straight;
    w->e[0] = w->field ? tr->e[0] : 1;
    w->e[1] = w->field ? tr->e[1] : 0;
    w->from[0] = w->field ? tr->from[0] : 0;
    w->from[1] = w->field ? tr->from[1] : 0;
    if (along == ALONG_X && fabs(w->e[0]) * tr->length < 1e-6 * relief_finest(w->relief) && tr->straight)
        w->e[0] =
            0; /* straight across the profile: what the decimals of the two ends leave in x is no motion along it */
    return knots_of(w, r->contact->name, e);
}

bool path_cells_make(struct path_cells *w, struct stage_run *r, enum cells_kind kind, double longest, struct err *e)
{
    const struct limiter *limiter = &r->contact->contact.limiter;
    int along = r->board->relief->along;
    if (!path_cells_place(w, r, e)) return false;
    w->kind = kind;
    w->channels = (kind == CELLS_ALONG && w->curved) || (kind == CELLS_AXES && along == ALONG_PLANE) ? 2 : 1;
    w->limiter = limiter->curve == LIMITER_TANH;
    w->ratio = kind == CELLS_AXES ? limiter->ratio_y : 1;
    w->halves = w->curved || along == ALONG_PLANE || !linear_between_knots(w->relief);
    w->longest = w->halves ? fmin(longest, relief_finest(w->relief) / 2) : longest;
    if (!load_varies(r->contact)) {
        double n = rules_load(r->contact);
        limiter_warn(r, n, n);
    }
    w->straight = !w->curved && w->channels == 1;
    for (int k = 0; w->straight && k < LIMITER_POINTS; k++) {
        w->cells.ex[k] = w->e[0];
        w->cells.ey[k] = w->e[1];
    }
    w->along = w->straight && kind == CELLS_ALONG && w->e[0] == 1 && w->e[1] == 0;
    return true;
}

unsigned path_cells_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    bool field = !rules_straight(&c->motion) && rules_along(c) != ALONG_PATH;
    return field ? ITEM_BIT(ITEM_X) | ITEM_BIT(ITEM_Y) | ITEM_BIT(ITEM_VX) | ITEM_BIT(ITEM_VY) : 0;
}

double path_cells_work(const struct contact *c, const struct scene *s)
{
    double rough = roughness_scale(c), finest = isnan(rough) ? height_map_pitch(c) : rough;
    bool halves = rules_along(c) == ALONG_PLANE;
    return (halves ? 2 : 1) * (s->accuracy.oversampling + rules_speed(&c->motion) / (s->output.sample_rate * finest));
}
