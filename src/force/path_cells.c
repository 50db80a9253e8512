/* Stretches. Between two force samples a curved path is the cubic Hermite curve through both places with both unit
   tangents, its parameter w from 0 to the arc length h travelled: within h^4 kappa''.. / 384 of the path, below 1e-16 m
   at 10 um. Along a profile, and on a straight path, places are exact straight lines in u.

   Knots. Those that a stretch meets are looked for along each family's coordinate, by Newton's method from where a
   straight line meets them. A knot missed by rounding, or one that a curve just touches between two places, leaves a
   kink inside a cell: the cell's mean is off by half the kink of its slope times what was missed (a part in 1e7 of a
   pitch by rounding, kappa h^2 / 8 of a line touched).

   A stretch that begins where the one before ended shares its point: of a circle a third fewer are read and limited. */
#include "force/path_cells.h"

#include <math.h>
#include <string.h>

#include "num/lanes.h"
#include "surface/height_map.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "surface/roughness.h"
#include "trajectory/load.h"
#include "trajectory/motion.h"
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
    for (int k = 0; axes && k < p->points; k++) {
        double x = p->ex[k], y = p->ey[k];
        p->slope[k] = x * zx[k] + y * zy[k];
        p->curvature[0][k] = w->xx[k];
        p->curvature[1][k] = w->yy[k];
        p->bend[k] = x * x * w->xx[k] + 2 * x * y * w->xy[k] + y * y * w->yy[k];
    }
    if (!axes && !w->along) values_along(w);
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

struct hermite {                             /* Hermite curve over one stretch */
    double x[2], y[2], ex[2], ey[2], length; /* ends, unit tangents in the direction of travel, m */
    bool bends;                              /* else it is a straight line */
};

struct stretch {
    double whole; /* m: how long it is */
    int heading;  /* 1: u grows; -1                        */
    double alpha; /* m, of channel 0                       */
    int interval;
    struct hermite path;
};

struct spot {
    double x, y, ex, ey; /* as the relief wants it; e in the direction of increasing u */
};

/* Where it begins (0) or ends (1). */
static struct spot stretch_end(const struct stretch *s, int k)
{
    const struct hermite *c = &s->path;
    return (struct spot){c->x[k], c->y[k], s->heading * c->ex[k], s->heading * c->ey[k]};
}

/* at[n] m into the stretch: Hermite basis at share q, and its derivatives over q. */
LANES_CLONES
static void stretch_at(const struct stretch *s, int n, const double *at, double *x, double *y, double *ex, double *ey)
{
    const struct hermite *c = &s->path;
    double h = c->length, per = 1 / h, heading = s->heading, x0 = c->x[0], x1 = c->x[1], y0 = c->y[0], y1 = c->y[1],
           ex0 = c->ex[0], ex1 = c->ex[1], ey0 = c->ey[0], ey1 = c->ey[1];
    int curved = c->bends ? n : 0;
    for (int i = curved; i < n; i++) {
        double q = at[i] * per;
        x[i] = x0 + q * (x1 - x0);
        y[i] = y0 + q * (y1 - y0);
        ex[i] = heading * ex0;
        ey[i] = heading * ey0;
    }
#pragma omp simd
    for (int i = 0; i < curved; i++) {
        double q = at[i] * per, p = 1 - q, away = q * p, a = p * p * (1 + 2 * q), b = q * q * (1 + 2 * p),
               from = p * away * h, to = -q * away * h;
        double da = -6 * away * per, ds = p * (p - 2 * q), dt = q * (q - 2 * p);
        double dx = da * (x0 - x1) + ds * ex0 + dt * ex1, dy = da * (y0 - y1) + ds * ey0 + dt * ey1,
               d = sqrt(dx * dx + dy * dy);
        double unit = heading / lanes_select(d > 0, d, 1);
        x[i] = a * x0 + b * x1 + from * ex0 + to * ex1;
        y[i] = a * y0 + b * y1 + from * ey0 + to * ey1;
        ex[i] = lanes_select(d > 0, dx * unit, heading * ex0);
        ey[i] = lanes_select(d > 0, dy * unit, heading * ey0);
    }
}

/* One coordinate of the curve; *rate: its derivative. */
static double curve_along(const struct hermite *c, int axis, double w, double *rate)
{
    const double *x = axis ? c->y : c->x, *e = axis ? c->ey : c->ex;
    double h = c->length, q = w / h, p = 1 - q, b = q * q * (1 + 2 * p);
    *rate = 6 * q * p / h * (x[1] - x[0]) + p * (p - 2 * q) * e[0] + q * (q - 2 * p) * e[1];
    return x[0] + b * (x[1] - x[0]) + q * p * h * (p * e[0] - q * e[1]);
}

/* The knots of one family between a stretch's ends, one after the other. */
struct knot_walk {
    double next;              /* m into the stretch; HUGE_VAL: there is none */
    double from, at, end;     /* m, where the last one was met; the coordinate there and at the end, in pitches */
    double edge, step, count; /* the next knot's number, +1 or -1, how many are left */
};

/* To the next knot: from where a straight line meets it by Newton's method. */
static void walk_on(struct knot_walk *k, const struct knot_lines *g, const struct stretch *s)
{
    const struct hermite *c = &s->path;
    k->next = HUGE_VAL;
    if (k->count < 1) return;
    double w = k->from + (s->whole - k->from) * (k->edge - k->at) / (k->end - k->at), off = 1;
    for (int i = 0; c->bends && i < 8 && fabs(off) > 1e-9; i++) {
        double speed;
        off = k->edge - (curve_along(c, g->axis, w, &speed) - g->origin) * g->per;
        if (!(speed * k->step > 0)) break;
        w = fmax(k->from, fmin(w + off * g->pitch / speed, s->whole));
    }
    k->next = k->from = w;
    k->at = k->edge;
    k->edge += k->step;
    k->count--;
}

static void walk_start(struct knot_walk *k, const struct knot_lines *g, const struct stretch *s)
{
    const double *x = g->axis ? s->path.y : s->path.x;
    double at = (x[0] - g->origin) * g->per, end = (x[1] - g->origin) * g->per;
    double slack = 1e-7 * (1 + fabs(at) * 1e-6); /* a knot just reached is not the next one, and one at the end none */
    bool up = end > at;
    double edge = up ? lanes_floor(at + slack) + 1 : lanes_ceil(at - slack) - 1,
           last = up ? lanes_ceil(end - slack) - 1 : lanes_floor(end + slack) + 1, step = up ? 1 : -1;
    *k = (struct knot_walk){.at = at, .end = end, .edge = edge, .step = step, .count = (last - edge) * step + 1};
    walk_on(k, g, s);
}

INLINE void add_point(struct path_cells *w, double alpha, const struct spot *at)
{
    struct cells *p = &w->cells;
    int k = p->points++;
    p->x[k] = at->x;
    p->y[k] = at->y;
    p->ex[k] = at->ex;
    p->ey[k] = at->ey;
    p->alpha[0][k] = alpha;
    p->alpha[1][k] = alpha * w->ratio;
}

/* Is the last point this very one, and of the same alpha? */
INLINE bool last_point(const struct cells *p, double alpha, const struct spot *at)
{
    int k = p->points - 1;
    return k >= 0 && p->x[k] == at->x && p->y[k] == at->y && p->ex[k] == at->ex && p->ey[k] == at->ey &&
           p->alpha[0][k] == alpha;
}

/* It begins at the last point and ends at the next. */
INLINE void add_cell(struct cells *p, int interval, int heading, double length)
{
    int i = p->n++;
    p->at[i] = p->points - 1;
    p->interval[i] = interval;
    p->heading[i] = heading;
    p->length[i] = length;
}

enum { PIECES = 16 }; /* that are cut at once */

/* Adds the stretch's cells. */
static void cut_stretch(struct path_cells *w, const struct stretch *s)
{
    struct cells *p = &w->cells;
    struct knot_walk walk[CELLS_KNOTS];
    struct spot at = stretch_end(s, 0);
    double done = 0, stops[2 * PIECES], step = s->whole / fmax(ceil(s->whole / w->longest), 1);
    int each = w->halves ? 2 : 1;
    for (int k = 0; k < w->n_knots; k++)
        walk_start(&walk[k], &w->knots[k], s);
    while (done < s->whole) {
        int n = 0, from;
        if (p->n + 2 * PIECES > LIMITER_CELLS || p->points + 2 * PIECES + 1 > LIMITER_POINTS) cells_flush(w);
        if (!last_point(p, s->alpha, &at)) add_point(w, s->alpha, &at);
        from = p->points;
        for (double next; n < each * PIECES && done < s->whole; done = next) {
            next = done + step < (1 - 1e-9) * s->whole ? done + step : s->whole;
            for (int k = 0; k < w->n_knots; k++)
                next = walk[k].next < next ? walk[k].next : next;
            if (!(next > done)) /* two knots at one place, but for rounding */
                next = done + fmax(1e-12 * s->whole, 4e-16 * fabs(done));
            for (int k = 0; k < w->n_knots; k++)
                if (walk[k].next <= next) walk_on(&walk[k], &w->knots[k], s);
            double length = (next - done) / each;
            for (int k = 1; k <= each; k++) {
                add_cell(p, s->interval, s->heading, length);
                stops[n++] = k == each ? next : done + length;
                p->points++;
            }
        }
        stretch_at(s, n, stops, p->x + from, p->y + from, p->ex + from, p->ey + from);
        for (int k = from; k < p->points; k++) {
            p->alpha[0][k] = s->alpha;
            p->alpha[1][k] = s->alpha * w->ratio;
        }
        int last = p->points - 1;
        at = (struct spot){p->x[last], p->y[last], p->ex[last], p->ey[last]};
        if (done < s->whole) continue;
        at = stretch_end(s, 1);
        p->points--;
        add_point(w, s->alpha, &at);
    }
}

/* ------------------------------------------------------------------ sub-intervals */

/* Where the contact is at the ends of a chunk's sub-intervals: u, place, and the direction of travel, which is 0, 0
   where it rests. */
struct instants {
    double u[CELLS_CHUNK + 1], x[CELLS_CHUNK + 1], y[CELLS_CHUNK + 1], ex[CELLS_CHUNK + 1], ey[CELLS_CHUNK + 1];
};

struct instant {
    double u, x, y, ex, ey;
};

static struct instant instants_at(const struct instants *s, int k)
{
    return (struct instant){s->u[k], s->x[k], s->y[k], s->ex[k], s->ey[k]};
}

LANES_CLONES
static void instants_straight(const struct path_cells *w, const double *u, const double *du, int n, struct instants *to)
{
    double x = w->from[0], y = w->from[1], ex = w->e[0], ey = w->e[1];
#pragma omp simd
    for (int k = 0; k <= n; k++) {
        double way = lanes_select(du[k] > 0, 1, lanes_select(du[k] < 0, -1, 0));
        to->u[k] = u[k];
        to->x[k] = x + u[k] * ex;
        to->y[k] = y + u[k] * ey;
        to->ex[k] = way * ex;
        to->ey[k] = way * ey;
    }
}

LANES_CLONES
static void instants_curved(const struct board *b, long first, int n, struct instants *to)
{
    const double *u = cells_values(b, ITEM_POSITION, first), *x = cells_values(b, ITEM_X, first),
                 *y = cells_values(b, ITEM_Y, first), *vx = cells_values(b, ITEM_VX, first),
                 *vy = cells_values(b, ITEM_VY, first);
    double slow = 1e-6 * b->trajectory->top_speed;
#pragma omp simd
    for (int k = 0; k <= n; k++) {
        double v = sqrt(vx[k] * vx[k] + vy[k] * vy[k]),
               per = lanes_select(v > slow, 1, 0) / lanes_select(v > slow, v, 1);
        to->u[k] = u[k];
        to->x[k] = x[k];
        to->y[k] = y[k];
        to->ex[k] = vx[k] * per;
        to->ey[k] = vy[k] * per;
    }
}

static bool at_rest(const struct instant *i) { return i->ex == 0 && i->ey == 0; }

/* From a to b, a straight line or a smooth curve. Where the contact rests at one end of a curve the direction is that
   of the other: a chord of a few last places of the coordinates points anywhere. False: they are one place. */
static bool stretch_between(const struct path_cells *w, const struct instant *a, const struct instant *b,
                            struct stretch *s)
{
    struct hermite *c = &s->path;
    double h = fabs(b->u - a->u);
    s->whole = c->length = h;
    s->heading = b->u > a->u ? 1 : -1;
    c->bends = w->curved;
    c->x[0] = a->x, c->x[1] = b->x, c->y[0] = a->y, c->y[1] = b->y;
    if (!w->curved) {
        c->ex[0] = c->ex[1] = s->heading * w->e[0], c->ey[0] = c->ey[1] = s->heading * w->e[1];
        return h > 0;
    }
    double dx = b->x - a->x, dy = b->y - a->y, chord = sqrt(dx * dx + dy * dy);
    const struct instant *from = at_rest(a) ? b : a, *to = at_rest(b) ? a : b;
    if (!(h > 0 && chord > 0)) return false;
    c->ex[0] = from->ex, c->ex[1] = to->ex, c->ey[0] = from->ey, c->ey[1] = to->ey;
    if (at_rest(from)) c->ex[0] = c->ex[1] = dx / chord, c->ey[0] = c->ey[1] = dy / chord;
    if (chord < 0.9 * h) { /* the last places of x, y are coarser than those of u: straight on */
        c->x[1] = a->x + h * c->ex[0], c->y[1] = a->y + h * c->ey[0];
        c->ex[1] = c->ex[0], c->ey[1] = c->ey[0];
    }
    return true;
}

static void cut_between(struct path_cells *w, const struct instant *a, const struct instant *b, double alpha,
                        int interval)
{
    struct stretch s = {.alpha = alpha, .interval = interval};
    if (stretch_between(w, a, b, &s)) cut_stretch(w, &s);
}

/* A sub-interval from t0 to t1, s, in which the motion turns round on itself: two stretches, each in its own side's
   direction. So it is on a curve where the turn is too slow or too small for its instant to be found: then that is half
   way. */
static void cut_turning(struct path_cells *w, const struct trajectory *tr, const double t[2],
                        const struct instant ends[2], double alpha, int interval)
{
    double turn = trajectory_turning(tr, t[0], t[1]);
    struct instant middle = {0};
    if (isnan(turn) && !w->curved) {
        cut_between(w, ends, ends + 1, alpha, interval);
        return;
    }
    if (isnan(turn)) turn = 0.5 * (t[0] + t[1]);
    trajectory_at(
        tr, 1, &turn,
        (struct trajectory_out){.u = &middle.u, .x = w->curved ? &middle.x : NULL, .y = w->curved ? &middle.y : NULL});
    if (!w->curved) middle.x = w->from[0] + middle.u * w->e[0], middle.y = w->from[1] + middle.u * w->e[1];
    cut_between(w, ends, &middle, alpha, interval);
    cut_between(w, &middle, ends + 1, alpha, interval);
}

/* ------------------------------------------------------------------ sub-intervals without a knot */

/* clear[i]: is sub-interval i one cell, or one pair: does the contact move from place to place without a turn, not
   farther than the longest cell, and with no knot between? A knot that is an end, but for rounding, is none between. */
LANES_CLONES
static void clear_of(const struct path_cells *w, const struct instants *at, int n, int *clear)
{
    const double *u = at->u, *x = at->x, *y = at->y, *ex = at->ex, *ey = at->ey;
    double longest = w->longest;
    int straight = !w->curved;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], h = fabs(u[i + 1] - u[i]);
        double facing = ex[i] * ex[i + 1] + ey[i] * ey[i + 1];
        int moves = straight | ((facing > 0) & (dx * dx + dy * dy >= 0.81 * h * h));
        clear[i] = (h > 0) & (h <= longest) & (facing >= 0) & moves;
    }
    for (int k = 0; k < w->n_knots; k++) {
        const double *c = w->knots[k].axis ? y : x;
        double origin = w->knots[k].origin, per = w->knots[k].per;
#pragma omp simd
        for (int i = 0; i < n; i++) {
            double a = (c[i] - origin) * per, b = (c[i + 1] - origin) * per, low = lanes_select(a < b, a, b),
                   high = lanes_select(a < b, b, a), slack = 1e-7 * (1 + fabs(low) * 1e-6);
            clear[i] &= lanes_floor(low + slack) + 1 > lanes_ceil(high - slack) - 1;
        }
    }
}

/* Half way of n sub-intervals from number `first` on: stretch_at for q = 1/2. */
LANES_CLONES
static void clear_middles(const struct instants *at, int first, int n, struct instants *to)
{
    const double *u = at->u + first, *x = at->x + first, *y = at->y + first, *ex = at->ex + first, *ey = at->ey + first;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double h = fabs(u[i + 1] - u[i]), dx = 1.5 / h * (x[i + 1] - x[i]) - 0.25 * (ex[i] + ex[i + 1]),
               dy = 1.5 / h * (y[i + 1] - y[i]) - 0.25 * (ey[i] + ey[i + 1]), d = sqrt(dx * dx + dy * dy),
               per = 1 / lanes_select(d > 0, d, 1);
        to->x[i] = 0.5 * (x[i] + x[i + 1]) + h / 8 * (ex[i] - ex[i + 1]);
        to->y[i] = 0.5 * (y[i] + y[i + 1]) + h / 8 * (ey[i] - ey[i + 1]);
        to->ex[i] = dx * per;
        to->ey[i] = dy * per;
    }
}

/* The points after the first of n cells, or of n pairs, which have points between. */
INLINE void clear_lay(double *restrict to, double factor, const double *between, const double *ends, int n)
{
    if (between)
#pragma omp simd
        for (int i = 0; i < n; i++) {
            to[2 * i] = factor * between[i];
            to[2 * i + 1] = factor * ends[i];
        }
    else
#pragma omp simd
        for (int i = 0; i < n; i++)
            to[i] = factor * ends[i];
}

/* n sub-intervals from number `first` on, which begin at the last point. */
LANES_CLONES
static void clear_fill(struct path_cells *w, const struct instants *at, const struct instants *middle, double alpha,
                       int first, int n)
{
    struct cells *p = &w->cells;
    int pair = w->halves ? 1 : 0, cells = n << pair, from = p->points, cell = p->n;
    const double *u = at->u + first;
    double share = pair ? 0.5 : 1, heading = u[1] > u[0] ? 1 : -1;
    clear_lay(p->x + from, 1, pair ? middle->x : NULL, at->x + first + 1, n);
    clear_lay(p->y + from, 1, pair ? middle->y : NULL, at->y + first + 1, n);
    if (w->curved) {
        clear_lay(p->ex + from, heading, pair ? middle->ex : NULL, at->ex + first + 1, n);
        clear_lay(p->ey + from, heading, pair ? middle->ey : NULL, at->ey + first + 1, n);
    }
    for (int i = from; i < from + (w->curved ? 0 : cells); i++) {
        p->ex[i] = w->e[0];
        p->ey[i] = w->e[1];
    }
    for (int i = from; i < from + cells; i++) {
        p->alpha[0][i] = alpha;
        p->alpha[1][i] = alpha * w->ratio;
    }
#pragma omp simd
    for (int i = 0; i < cells; i++) {
        int k = i >> pair;
        p->at[cell + i] = from - 1 + i;
        p->interval[cell + i] = first + k;
        p->heading[cell + i] = u[k + 1] > u[k] ? 1 : -1;
        p->length[cell + i] = share * fabs(u[k + 1] - u[k]);
    }
    p->points += cells;
    p->n += cells;
}

/* Cuts those of n sub-intervals, from number `first` on, that are clear, alpha being the same; how many these are. */
static int cut_clear(struct path_cells *w, const struct instants *at, const int *clear, double alpha, int first, int n)
{
    struct cells *p = &w->cells;
    struct instants middle;
    int m = 0, each = w->halves ? 2 : 1, heading = at->u[first + 1] > at->u[first] ? 1 : -1;
    while (m < n && clear[first + m])
        m++;
    if (m == 0) return 0;
    if (p->n + each * m > LIMITER_CELLS || p->points + each * m + 1 > LIMITER_POINTS) cells_flush(w);
    struct spot start = {at->x[first], at->y[first], w->e[0], w->e[1]};
    if (w->curved) start.ex = heading * at->ex[first], start.ey = heading * at->ey[first];
    if (!last_point(p, alpha, &start)) add_point(w, alpha, &start);
    if (w->halves) clear_middles(at, first, m, &middle);
    clear_fill(w, at, &middle, alpha, first, m);
    return m;
}

void path_cells_run(struct path_cells *w, const struct stage_run *r, long first, int n)
{
    const struct board *b = r->board;
    const double *u = cells_values(b, ITEM_POSITION, first), *du = cells_values(b, ITEM_VELOCITY, first),
                 *varies = board_has(b, ITEM_ALPHA) ? cells_values(b, ITEM_ALPHA, first) : NULL;
    double dt = 1 / (b->rate * b->over), fixed = varies ? NAN : limiter_constant(r->contact);
    struct instants at;
    int clear[CELLS_CHUNK];
    if (w->curved)
        instants_curved(b, first, n, &at);
    else
        instants_straight(w, u, du, n, &at);
    clear_of(w, &at, n, clear);
    for (int i = 0, m; i < n; i += m) {
        double alpha = varies ? 0.5 * (varies[i] + varies[i + 1]) : fixed;
        m = cut_clear(w, &at, clear, alpha, i, varies ? 1 : n - i);
        if (m > 0) continue;
        m = 1;
        struct instant ends[2] = {instants_at(&at, i), instants_at(&at, i + 1)};
        if (ends[0].ex * ends[1].ex + ends[0].ey * ends[1].ey < 0)
            cut_turning(w, b->trajectory, (double[]){(double)(first + i) * dt, (double)(first + i + 1) * dt}, ends,
                        alpha, i);
        else
            cut_between(w, ends, ends + 1, alpha, i);
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
            g.per = 1 / g.pitch;
            if (w->n_knots == CELLS_KNOTS)
                return err_set(e, ERR_SCENE,
                               "contact '%s': the surface is made of too many parts: leave out one of height_map, "
                               "roughness, ridges, grit",
                               contact);
            w->knots[w->n_knots++] = g;
        }
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
    const struct limiter *limiter = limiter_of(r->contact);
    int along = r->board->relief->along;
    if (!path_cells_place(w, r, e)) return false;
    w->kind = kind;
    w->channels = (kind == CELLS_ALONG && w->curved) || (kind == CELLS_AXES && along == ALONG_PLANE) ? 2 : 1;
    w->limiter = limiter->curve == LIMITER_TANH;
    w->ratio = kind == CELLS_AXES ? limiter->ratio_y : 1;
    w->halves = w->curved || along == ALONG_PLANE;
    for (const struct relief_part *p = w->relief->first; p; p = p->next)
        w->halves = w->halves || !p->linear;
    /* A pair of cells takes the curvature for a parabola, and sub-intervals a force for straight lines: of fast ways
       over cells of one length the error would stay at theirs, whatever the oversampling. Shorter ones at that rate
       leave an error of order 3 to 4: scenes/scribble -46, -64, -80, -98 dB at 1, 2, 4, 8 sub-intervals. */
    w->longest = w->halves ? fmin(longest, relief_finest(w->relief) / r->board->over) : longest;
    if (!load_varies(r->contact)) {
        double n = load_constant(r->contact);
        limiter_warn(r, n, n);
    }
    w->along = !w->curved && w->channels == 1 && kind == CELLS_ALONG && w->e[0] == 1 && w->e[1] == 0;
    return true;
}

unsigned path_cells_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    bool field = !motion_straight(&c->motion) && relief_along(c) != ALONG_PATH;
    return field ? ITEM_BIT(ITEM_X) | ITEM_BIT(ITEM_Y) | ITEM_BIT(ITEM_VX) | ITEM_BIT(ITEM_VY) : 0;
}

double path_cells_knots(const struct contact *c, const struct scene *s)
{
    double rough = roughness_scale(c), finest = c->surface.finest > 0 ? c->surface.finest
                                                : isnan(rough)        ? height_map_pitch(c)
                                                                      : rough;
    return motion_speed(&c->motion) / (s->output.sample_rate * finest);
}

double path_cells_work(const struct contact *c, const struct scene *s)
{
    double over = s->accuracy.oversampling, knots = path_cells_knots(c, s);
    return relief_along(c) == ALONG_PLANE ? 2 * (over * fmax(knots, 1) + knots) : over + knots;
}
