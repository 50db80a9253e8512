#include "response/places_smooth.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "response/places.h"

/* The interpolating cubic spline (de Boor, A Practical Guide to Splines, 2001, ch. IV), by its slopes m_k at the knots
   x_k: with h_k = x_(k+1) - x_k and the chords' slopes d_k = (f_(k+1) - f_k)/h_k its second derivative goes on through
   a knot where

       h_k m_(k-1) + 2 (h_(k-1) + h_k) m_k + h_(k-1) m_(k+1) = 3 (h_k d_(k-1) + h_(k-1) d_k),

   and at both ends the third goes on through the knot next to the end ("not a knot": polynomials of degree 3 come out
   as they are),

       h_1 m_0 + (h_0 + h_1) m_1 = ((3 h_0 + 2 h_1) h_1 d_0 + h_0^2 d_1)/(h_0 + h_1).

   Three knots give their parabola. Slopes follow by elimination without pivots: after the first step every pivot is
   larger than what stands beside it.

   Growth: the largest sum of the cardinal splines' absolute values (Lebesgue's constant), at eighths of each interval.
   A cardinal spline falls at least by half from knot to knot, so those of knots 32 apart are computed as one. */

/* Row k of the equations: m[k - 1], m[k], m[k + 1], and of the right side d[k - 1], d[k] (at the ends the two chords
 * next to it). */
struct equation {
    double before, at, after, left, right;
};

static struct equation equation_of(int n, const double *h, int k)
{
    if (n == 3) { /* the parabola */
        double sum = h[0] + h[1];
        if (k == 1) return (struct equation){0, 1, 0, h[1] / sum, h[0] / sum};
        return k == 0 ? (struct equation){0, 1, 0, 1 + h[0] / sum, -h[0] / sum}
                      : (struct equation){0, 1, 0, -h[1] / sum, 1 + h[1] / sum};
    }
    if (k == 0)
        return (struct equation){0, h[1], h[0] + h[1], (3 * h[0] + 2 * h[1]) * h[1] / (h[0] + h[1]),
                                 h[0] * h[0] / (h[0] + h[1])};
    if (k == n - 1) {
        double last = h[n - 2], next = h[n - 3];
        return (struct equation){last + next, next, 0, last * last / (last + next),
                                 (3 * last + 2 * next) * next / (last + next)};
    }
    return (struct equation){h[k], 2 * (h[k - 1] + h[k]), h[k - 1], 3 * h[k], 3 * h[k - 1]};
}

/* The first_chord on whose left side row k's right side begins. */
static int first_chord(int n, int k) { return k == 0 ? 0 : k == n - 1 ? n - 3 : k - 1; }

struct places_spline places_smooth_spline_make(struct arena *a, int n, const double *at)
{
    struct places_spline s = {n, ARENA_TAKE(a, double, n - 1), ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n),
                              ARENA_TAKE(a, double, n)};
    for (int k = 0; k + 1 < n; k++)
        s.step[k] = at[k + 1] - at[k];
    for (int k = 0; k < n; k++) {
        struct equation r = equation_of(n, s.step, k);
        s.below[k] = k > 0 ? r.before / s.pivot[k - 1] : 0;
        s.pivot[k] = r.at - (k > 0 ? s.below[k] * s.above[k - 1] : 0);
        s.above[k] = r.after;
    }
    return s;
}

void places_smooth_spline_slopes(const struct places_spline *s, int count, const double *const *f, double *const *m)
{
    for (int k = 0; k < s->n; k++) {
        struct equation r = equation_of(s->n, s->step, k);
        int c = first_chord(s->n, k);
        double left = r.left / s->step[c], right = r.right / s->step[c + 1], below = s->below[k];
        const double *x = f[c], *y = f[c + 1], *z = f[c + 2], *before = k > 0 ? m[k - 1] : f[0];
        for (int i = 0; i < count; i++)
            m[k][i] = left * (y[i] - x[i]) + right * (z[i] - y[i]) - below * before[i];
    }
    for (int k = s->n - 1; k >= 0; k--) {
        const double *after = k + 1 < s->n ? m[k + 1] : m[k];
        double above = k + 1 < s->n ? s->above[k] : 0, pivot = s->pivot[k];
        for (int i = 0; i < count; i++)
            m[k][i] = (m[k][i] - above * after[i]) / pivot;
    }
}

enum { SPACING = 32, PARTS = 8 };

double places_smooth_spline_grows(const struct places_spline *s, struct arena *a)
{
    int count = s->n < SPACING ? s->n : SPACING;
    double *f = ARENA_TAKE(a, double, (size_t)s->n *(size_t)count),
           *m = ARENA_TAKE(a, double, (size_t)s->n *(size_t)count), most = 1;
    const double **from = ARENA_TAKE(a, const double *, s->n);
    double **to = ARENA_TAKE(a, double *, s->n);
    for (int k = 0; k < s->n; k++) {
        from[k] = f + (size_t)k * (size_t)count;
        to[k] = m + (size_t)k * (size_t)count;
        f[(size_t)k * (size_t)count + (size_t)(k % count)] = 1;
    }
    places_smooth_spline_slopes(s, count, from, to);
    for (int part = 1; part < PARTS; part++) {
        double u = (double)part / PARTS, v = 1 - u;
        for (int k = 0; k + 1 < s->n; k++) {
            double sum = 0;
            for (int i = 0; i < count; i++)
                sum += fabs(v * v * (v + 3 * u) * from[k][i] + u * u * (u + 3 * v) * from[k + 1][i] +
                            s->step[k] * u * v * (v * to[k][i] - u * to[k + 1][i]));
            most = fmax(most, sum);
        }
    }
    return most;
}

/* Interpolation on the crossings of lines, axis by axis; a line of places is a grid of one row.

   A coordinate lies in the interval [x_i, x_(i+1)] of its axis, h long, at the share u. Linear shares are 1 - u and u.
   Smooth ones are those of the cubic spline through the places (places_smooth.h), written with its slopes m at them:

       f = (1 - u)^2 (1 + 2 u) f_i + u^2 (3 - 2 u) f_(i+1) + h u (1 - u) ((1 - u) m_i - u m_(i+1)),

   so that at a place its own value comes out to the last bit, and along a line whose values are all zero the
   result is zero. In the plane it is the tensor product: values, slopes along x, slopes along y, and slopes along x of
   slopes along y at the four corners of the cell, 16 numbers. Two lines are linear and three a parabola. An axis whose
   distances are so uneven that an error of one value might come out 6 times as large stays linear
   (PLACES_SMOOTH_SPLINE_GROWS).

   Why a spline: between 33 x 23 places the gains of the 50 lowest modes of a supported plate, heard at another place,
   are off by -25 dB with linear shares, -43 with four-point Lagrange, -41 by Hermite's form with parabolas' slopes, -56
   with five-point slopes, -52 with the spline; of 100 modes -20, -32, -33, -41, -40 dB. Of a free plate -30, -52, -48,
   -59, -65, and -23, -40, -37, -47, -55 dB. An error of 1 becomes 2.2 with five-point slopes and 2.0 with the spline
   where places are even, and at worst 25 and 10 where distances go up and down by factors of 2.

   Kinks are the lines: of linear shares the slope jumps there, of the spline the third derivative. Beyond the outermost
   lines the nearest point counts. */

static const double touching = 1e-9; /* m */

struct axis {
    int n;
    double *at; /* [n] m, increasing                           */
    bool smooth;
    struct places_spline spline;
};

struct places_lattice {
    double base[2], along[2];
    int places;
    struct axis axis[2];
    int *place; /* [n of y][n of x] the caller's index         */
    int (*edge)[2], edges;
};

/* Coordinates along both axes. */
static void coordinates(const double base[2], const double along[2], const double *xy, double s[2])
{
    double dx = xy[0] - base[0], dy = xy[1] - base[1];
    s[0] = dx * along[0] + dy * along[1];
    s[1] = dy * along[0] - dx * along[1];
}

/* ------------------------------------------------------------------ making */

/* The lines at which the coordinates s[n] (sorted here) are: those nearer than `same` to the one before are of its
 * line, which lies in the middle of them. */
static struct axis lines_of(struct arena *a, int n, double *s, double same)
{
    struct axis x = {.at = ARENA_TAKE(a, double, n)};
    gsl_sort(s, 1, (size_t)n);
    for (int i = 0, first = 0; i < n; i++) {
        if (i > 0 && s[i] - s[i - 1] > same) first = i;
        x.n += first == i;
        x.at[x.n - 1] = 0.5 * (s[first] + s[i]);
    }
    return x;
}

/* Index k of the interval [at[k], at[k + 1]] that holds s, n >= 2. */
static int interval(const struct axis *x, double s)
{
    int low = 0, high = x->n - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        *(x->at[middle] <= s ? &low : &high) = middle;
    }
    return low;
}

static int nearest_line(const struct axis *x, double s)
{
    if (x->n == 1) return 0;
    int k = interval(x, s);
    return k + (s - x->at[k] > x->at[k + 1] - s);
}

/* Each crossing is one place. */
static bool fill_crossings(struct arena *a, struct places_lattice *l, const struct places_lattice_ask *ask)
{
    l->place = ARENA_TAKE(a, int, ask->n);
    for (int i = 0; i < ask->n; i++)
        l->place[i] = -1;
    for (int i = 0; i < ask->n; i++) {
        double s[2];
        coordinates(l->base, l->along, ask->xy + 2 * i, s);
        int *at = &l->place[nearest_line(&l->axis[1], s[1]) * l->axis[0].n + nearest_line(&l->axis[0], s[0])];
        if (*at >= 0) return false;
        *at = ask->order[i];
    }
    return true;
}

static void make_smooth(struct arena *a, struct axis *x)
{
    if (x->n < 3) return;
    struct arena *work = arena_open();
    x->spline = places_smooth_spline_make(a, x->n, x->at);
    x->smooth = places_smooth_spline_grows(&x->spline, work) <= PLACES_SMOOTH_SPLINE_GROWS;
    arena_close(work);
}

struct places_lattice *places_smooth_lattice_make(struct arena *a, const struct places_lattice_ask *ask)
{
    struct places_lattice *l = ARENA_TAKE(a, struct places_lattice, 1);
    struct arena *work = arena_open();
    double *s[2] = {ARENA_TAKE(work, double, ask->n), ARENA_TAKE(work, double, ask->n)}, at[2];
    *l = (struct places_lattice){
        .base = {ask->base[0], ask->base[1]}, .along = {ask->axis[0], ask->axis[1]}, .places = ask->n};
    for (int i = 0; i < ask->n; i++) {
        coordinates(l->base, l->along, ask->xy + 2 * i, at);
        s[0][i] = at[0];
        s[1][i] = ask->one_row ? 0 : at[1];
    }
    for (int c = 0; c < 2; c++)
        l->axis[c] = lines_of(a, ask->n, s[c], ask->one_row ? 0 : ask->same);
    arena_close(work);
    if ((long)l->axis[0].n * l->axis[1].n != ask->n || (!ask->one_row && (l->axis[0].n < 2 || l->axis[1].n < 2)) ||
        !fill_crossings(a, l, ask))
        return NULL;
    for (int c = 0; c < 2; c++)
        make_smooth(a, &l->axis[c]);
    int nx = l->axis[0].n, ny = l->axis[1].n;
    l->edge = arena_take(a, 2 * (size_t)l->places, sizeof *l->edge);
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++) {
            const int *k = l->place + j * nx + i;
            if (i + 1 < nx) l->edge[l->edges][0] = k[0], l->edge[l->edges++][1] = k[1];
            if (j + 1 < ny) l->edge[l->edges][0] = k[0], l->edge[l->edges++][1] = k[nx];
        }
    return l;
}

/* ------------------------------------------------------------------ reading */

struct cell {         /* along one axis */
    int at, lines;    /* 1 or 2 */
    double share[2];  /* linear, of the lines    */
    double step, off; /* m; m beyond the lines   */
};

static struct cell cell_at(const struct axis *x, double s)
{
    double on = fmin(fmax(s, x->at[0]), x->at[x->n - 1]);
    if (x->n == 1) return (struct cell){0, 1, {1, 0}, 0, s - on};
    int k = interval(x, on);
    double h = x->at[k + 1] - x->at[k];
    return (struct cell){k, 2, {(x->at[k + 1] - on) / h, (on - x->at[k]) / h}, h, s - on};
}

static double cells_at(const struct places_lattice *l, double x, double y, struct cell c[2])
{
    double s[2];
    coordinates(l->base, l->along, (const double[2]){x, y}, s);
    for (int k = 0; k < 2; k++)
        c[k] = cell_at(&l->axis[k], s[k]);
    double off = sqrt(c[0].off * c[0].off + c[1].off * c[1].off);
    return off > touching ? off : 0.0;
}

double places_smooth_lattice_at(const struct places_lattice *l, double x, double y, struct places_mix *mix)
{
    static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    struct cell c[2];
    double off = cells_at(l, x, y, c);
    *mix = (struct places_mix){0};
    for (int k = 0; k < 4; k++) {
        int i = corner[k][0], j = corner[k][1];
        if (i >= c[0].lines || j >= c[1].lines) continue;
        mix->index[mix->n] = l->place[(c[1].at + j) * l->axis[0].n + c[0].at + i];
        mix->weight[mix->n++] = c[0].share[i] * c[1].share[j];
    }
    return off;
}

/* Shares of values and of slopes, [slope][line]. */
static void shares_of(const struct axis *x, const struct cell *c, double share[2][2])
{
    double v = c->share[0], u = c->share[1];
    share[0][0] = x->smooth ? v * v * (v + 3 * u) : v;
    share[0][1] = x->smooth ? u * u * (u + 3 * v) : u;
    share[1][0] = x->smooth ? c->step * u * v * v : 0;
    share[1][1] = x->smooth ? -c->step * u * u * v : 0;
}

int places_smooth_lattice_rows(const struct places_lattice *l)
{
    return l->places * (l->axis[0].smooth ? 2 : 1) * (l->axis[1].smooth ? 2 : 1);
}

/* Of slopes along x (i) and y (j): which of the terms. */
static int term(const struct places_lattice *l, int i, int j) { return i + j * (l->axis[0].smooth ? 2 : 1); }

double places_smooth_lattice_smooth_at(const struct places_lattice *l, double x, double y, struct places_sum *sum)
{
    struct cell c[2];
    double off = cells_at(l, x, y, c), share[2][2][2];
    for (int k = 0; k < 2; k++)
        shares_of(&l->axis[k], &c[k], share[k]);
    sum->n = 0;
    for (int slope = 0; slope < 4; slope++)
        for (int corner = 0; corner < 4; corner++) {
            int p = slope & 1, q = slope >> 1, i = corner & 1, j = corner >> 1;
            double w = share[0][p][i] * share[1][q][j];
            if (w == 0) continue;
            sum->index[sum->n] = term(l, p, q) * l->places + l->place[(c[1].at + j) * l->axis[0].n + c[0].at + i];
            sum->weight[sum->n++] = w;
        }
    return off;
}

/* Slopes along axis c of the rows of term `from`, as those of term `to`. */
static void fill_slopes(const struct places_lattice *l, int c, int from, int to, int n, double *rows)
{
    struct arena *a = arena_open();
    int lines = l->axis[c].n, across = l->axis[1 - c].n, nx = l->axis[0].n;
    const double **f = ARENA_TAKE(a, const double *, lines);
    double **m = ARENA_TAKE(a, double *, lines);
    for (int j = 0; j < across; j++) {
        for (int k = 0; k < lines; k++) {
            size_t place = (size_t)l->place[c == 0 ? j * nx + k : k * nx + j], all = (size_t)l->places;
            f[k] = rows + ((size_t)from * all + place) * (size_t)n;
            m[k] = rows + ((size_t)to * all + place) * (size_t)n;
        }
        places_smooth_spline_slopes(&l->axis[c].spline, n, f, m);
    }
    arena_close(a);
}

void places_smooth_lattice_fill(const struct places_lattice *l, int n, double *rows)
{
    bool x = l->axis[0].smooth, y = l->axis[1].smooth;
    if (y) fill_slopes(l, 1, 0, term(l, 0, 1), n, rows);
    if (x) fill_slopes(l, 0, 0, term(l, 1, 0), n, rows);
    if (x && y) fill_slopes(l, 0, term(l, 0, 1), term(l, 1, 1), n, rows);
}

/* ------------------------------------------------------------------ edges */

int places_smooth_lattice_edges(const struct places_lattice *l, const int (**edge)[2])
{
    *edge = (const int(*)[2])l->edge;
    return l->edges;
}

/* Smooth interpolation between rings of places round a centre, each at equal angles of its own number.

   Round a ring, values and radial slopes are periodic cubic splines of the angle. From ring to ring they are joined by
   Hermite's cubic in the radius r,

       f = (1 - u)^2 (1 + 2 u) f_j + u^2 (3 - 2 u) f_(j+1) + h u (1 - u) ((1 - u) m_j - u m_(j+1)),

   with f_j, m_j the splines of ring j at the point's own angle, so that value and gradient go on through a ring even
   where the next one has other angles. The radial slopes at a place are those of the cubic spline (places_smooth.h)
   along the whole diameter through it, if there is a place in the middle, and otherwise along its radius; a knot where
   a ring has no place takes the ring's periodic spline.

   The middle: its slope along the angle t is g_x cos t + g_y sin t, the first harmonic of the slopes of the diameters
   through the places of the innermost ring. Where no place is in the middle, the innermost ring's mean stands there,
   and towards it values go linearly. Beyond the outermost ring the nearest point counts.

   Periodic spline: with the step of the angle as unit, m_(k-1) + 4 m_k + m_(k+1) = 3 (f_(k+1) - f_(k-1)). Its symbol is
   x + 4 + 1/x = -(1 - z x)(1 - z/x)/z, z = sqrt(3) - 2: one pass in each direction (Unser, Aldroubi and Eden, IEEE
   Trans. Signal Processing 41, 1993, 821, there for other boundaries; round a ring each pass begins with the sum of
   all places, the farther ones at powers of z). */

static const double pole = -0.26794919243112270647; /* z */

enum { VALUE, TURN, OUT, OUT_TURN, TERMS }; /* rows of a place: slopes per step of the angle, per metre outwards */

struct ring {
    double radius, first; /* m; rad, of its place number 0 */
    int n, at;            /* places; where they begin in `place` */
};

struct places_rings {
    double centre[2];
    int places, rings, middle; /* middle: the caller's index; -1: none */
    struct ring *ring;         /* [rings], outwards */
    int *place;                /* [places] the caller's index, ring by ring, anticlockwise */
    int knots;                 /* of a diameter, or a radius */
    double *slope; /* [rings + 1][knots] of the middle and each ring, from values at the knots; NULL: linear */
};

/* ------------------------------------------------------------------ making */

struct polar {
    double radius, angle, key; /* key: by which they are sorted */
    int index;
};

static int rings_up(const void *a, const void *b)
{
    const struct polar *p = a, *q = b;
    return p->key != q->key ? (p->key < q->key ? -1 : 1) : (p->index > q->index) - (p->index < q->index);
}

/* The n places at p, of like radius: a ring if they are at equal angles. */
static bool take_ring(struct places_rings *r, struct polar *p, int n, const int *order, double same)
{
    struct ring *g = &r->ring[r->rings++];
    double step = 2 * REAL_PI / n;
    if (n < PLACES_RINGS_LEAST) return false;
    for (int k = 0; k < n; k++)
        p[k].key = p[k].angle;
    qsort(p, (size_t)n, sizeof *p, rings_up);
    *g = (struct ring){p[0].radius, p[0].angle, n, r->places};
    for (int k = 0; k < n; k++) {
        if (fabs(p[k].angle - g->first - k * step) * g->radius > same) return false;
        r->place[r->places++] = order[p[k].index];
    }
    return true;
}

static bool take_rings(struct places_rings *r, int n, struct polar *p, const int *order, double same)
{
    int from = 0;
    if (n > 1 && p[0].radius <= same && p[1].radius > same) r->middle = order[p[from++].index];
    while (from < n) {
        int to = from + 1;
        while (to < n && p[to].radius - p[to - 1].radius <= same)
            to++;
        if (p[from].radius <= same || !take_ring(r, p + from, to - from, order, same)) return false;
        from = to;
    }
    if (r->middle >= 0) r->place[r->places++] = r->middle;
    return true;
}

/* Slopes of the spline along a diameter or radius, at the middle and each ring, of a value of 1 at each knot. */
static void make_slopes(struct arena *a, struct places_rings *r)
{
    int R = r->rings, n = r->middle >= 0 ? 2 * R + 1 : R, first = r->middle >= 0 ? R : -1;
    struct arena *work = arena_open();
    double *at = ARENA_TAKE(work, double, n), *f = ARENA_TAKE(work, double, (size_t)n *n);
    const double **from = ARENA_TAKE(work, const double *, n);
    double **to = ARENA_TAKE(work, double *, n), *m = ARENA_TAKE(work, double, (size_t)n *n);
    r->knots = n;
    for (int j = 0; j < R; j++) {
        at[first + 1 + j] = r->ring[j].radius;
        if (r->middle >= 0) at[R - 1 - j] = -r->ring[j].radius;
    }
    for (int k = 0; k < n; k++) {
        f[(size_t)k * n + k] = 1;
        from[k] = f + (size_t)k * n;
        to[k] = m + (size_t)k * n;
    }
    struct places_spline s = places_smooth_spline_make(work, n, at);
    if (places_smooth_spline_grows(&s, work) <= PLACES_SMOOTH_SPLINE_GROWS) {
        places_smooth_spline_slopes(&s, n, from, to);
        r->slope = ARENA_TAKE(a, double, ((size_t)R + 1) * n);
        for (int j = first < 0; j <= R; j++) {
            double most = 0;
            for (int k = 0; k < n; k++)
                most = fmax(most, fabs(to[first + j][k]));
            for (int k = 0; k < n; k++) /* what is so far away that it counts for nothing is left out */
                r->slope[(size_t)j * n + k] = fabs(to[first + j][k]) > 1e-17 * most ? to[first + j][k] : 0;
        }
    }
    arena_close(work);
}

struct places_rings *places_smooth_rings_make(struct arena *a, int n, const double *xy, const int *order, double same)
{
    struct arena *work = arena_open();
    struct polar *p = ARENA_TAKE(work, struct polar, n);
    struct places_rings *r = ARENA_TAKE(a, struct places_rings, 1);
    r->middle = -1;
    r->ring = ARENA_TAKE(a, struct ring, n);
    r->place = ARENA_TAKE(a, int, n);
    for (int i = 0; i < 2 * n; i++)
        r->centre[i % 2] += (xy[i] - xy[i % 2]) / n;
    for (int i = 0; i < n; i++) {
        double x = xy[2 * i] - xy[0] - r->centre[0], y = xy[2 * i + 1] - xy[1] - r->centre[1],
               radius = sqrt(x * x + y * y);
        p[i] = (struct polar){radius, real_atan2(y, x), radius, i};
    }
    for (int c = 0; c < 2; c++)
        r->centre[c] += xy[c];
    qsort(p, (size_t)n, sizeof *p, rings_up);
    bool round = take_rings(r, n, p, order, same);
    arena_close(work);
    if (!round) return NULL;
    if (r->middle >= 0 || r->rings >= 3) make_slopes(a, r);
    return r;
}

/* ------------------------------------------------------------------ slopes */

/* The mean of the innermost ring follows the terms of all places. */
int places_smooth_rings_rows(const struct places_rings *r) { return TERMS * r->places + (r->middle < 0); }

struct rows { /* [..][n] */
    int n;
    double *at;
};

/* Term t of the place numbered k of a ring, round and round. */
static int row_of(const struct places_rings *r, const struct ring *g, int k, int t)
{
    return t * r->places + r->place[g->at + (k % g->n + g->n) % g->n];
}

static double *row_at(const struct rows *f, int row) { return f->at + (size_t)row * (size_t)f->n; }

/* to += by x */
LANES_CLONES
static void add(int n, double by, const double *x, double *to)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        to[i] = fma(by, x[i], to[i]);
}

/* m = by m + 3 (y - x) */
LANES_CLONES
static void chord(int n, double by, const double *x, const double *y, double *m)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        m[i] = by * m[i] + 3 * (y[i] - x[i]);
}

LANES_CLONES
static void scale(int n, double by, double *x)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] *= by;
}

/* Slopes round a ring of its rows of term `from`, as term `to`. carry [n]: work. */
static void turn_slopes(const struct places_rings *r, const struct ring *g, int from, int to, const struct rows *f,
                        double *carry)
{
    int N = g->n, n = f->n;
    double closed = 1 / (1 - real_pow(-pole, N) * (N % 2 ? -1 : 1));
    memset(carry, 0, (size_t)n * sizeof *carry);
    for (int k = 1; k <= N; k++) /* the pass as it stands after many rounds, at place 0 */
        chord(n, pole, row_at(f, row_of(r, g, k - 1, from)), row_at(f, row_of(r, g, k + 1, from)), carry);
    scale(n, closed, carry);
    for (int k = 1; k <= N; k++) {
        chord(n, pole, row_at(f, row_of(r, g, k - 1, from)), row_at(f, row_of(r, g, k + 1, from)), carry);
        memcpy(row_at(f, row_of(r, g, k, to)), carry, (size_t)n * sizeof *carry);
    }
    memset(carry, 0, (size_t)n * sizeof *carry);
    for (int pass = 0; pass < 2; pass++) { /* as it stands after many rounds, then the pass itself */
        for (int k = N; k > 0; k--) {
            double *m = row_at(f, row_of(r, g, k, to));
            scale(n, pole, carry);
            add(n, 1, m, carry);
            for (int i = 0; i < n && pass; i++)
                m[i] = -pole * carry[i];
        }
        scale(n, closed, carry);
    }
}

/* ------------------------------------------------------------------ reading */

static void put(struct places_sum *s, int row, double weight)
{
    if (weight == 0) return;
    s->index[s->n] = row;
    s->weight[s->n++] = weight;
}

/* Shares `value` of what a ring has at the angle and `out` of its slope outwards. */
static void put_ring(const struct places_rings *r, const struct ring *g, double angle, double value, double out,
                     struct places_sum *s)
{
    double steps = (angle - g->first) * g->n / (2 * REAL_PI), k = floor(steps), u = steps - k, v = 1 - u;
    double share[2][2] = {{v * v * (v + 3 * u), u * u * (u + 3 * v)}, {u * v * v, -u * u * v}};
    for (int t = 0; t < 2; t++)
        for (int i = 0; i < 2; i++) {
            put(s, row_of(r, g, (int)k + i, VALUE + t), value * share[t][i]);
            put(s, row_of(r, g, (int)k + i, OUT + t), out * share[t][i]);
        }
}

static void put_middle(const struct places_rings *r, double angle, double value, double out, struct places_sum *s)
{
    if (r->middle < 0) {
        put(s, TERMS * r->places, value);
        return;
    }
    put(s, r->middle, value);
    put(s, TURN * r->places + r->middle, out * real_cos(angle)); /* g_x, g_y */
    put(s, OUT * r->places + r->middle, out * real_sin(angle));
}

double places_smooth_rings_smooth_at(const struct places_rings *r, double x, double y, struct places_sum *s)
{
    double dx = x - r->centre[0], dy = y - r->centre[1], radius = sqrt(dx * dx + dy * dy);
    double angle = radius > 0 ? real_atan2(dy, dx) : 0, most = r->ring[r->rings - 1].radius, on = fmin(radius, most);
    int j = 0;
    while (j + 1 < r->rings && r->ring[j].radius <= on)
        j++;
    double inner = j > 0 ? r->ring[j - 1].radius : 0, h = r->ring[j].radius - inner, u = (on - inner) / h, v = 1 - u;
    bool smooth = r->slope && (j > 0 || r->middle >= 0);
    double near = smooth ? v * v * (v + 3 * u) : v, far = smooth ? u * u * (u + 3 * v) : u;
    double near_out = smooth ? h * u * v * v : 0, far_out = smooth ? -h * u * u * v : 0;
    s->n = 0;
    if (j > 0)
        put_ring(r, &r->ring[j - 1], angle, near, near_out, s);
    else
        put_middle(r, angle, near, near_out, s);
    put_ring(r, &r->ring[j], angle, far, far_out, s);
    return radius - most > touching ? radius - most : 0;
}

/* to += the slope that the diameter (radius) at the angle has at the middle (j = 0) or at ring j, counted from 1. */
static void add_out(const struct places_rings *r, int j, double angle, const struct rows *f, double *to)
{
    const double *slope = r->slope + (size_t)j * r->knots;
    int zero = r->middle >= 0 ? r->rings : -1;
    for (int k = 0; k < r->knots; k++) {
        int which = k - zero;
        struct places_sum s = {.n = 0};
        if (which == 0)
            put(&s, r->middle, slope[k]);
        else
            put_ring(r, &r->ring[abs(which) - 1], which > 0 ? angle : angle + REAL_PI, slope[k], 0, &s);
        for (int i = 0; i < s.n; i++)
            add(f->n, s.weight[i], row_at(f, s.index[i]), to);
    }
}

/* g_x and g_y, or the innermost ring's mean. */
static void fill_middle(const struct places_rings *r, const struct rows *f, double *work)
{
    const struct ring *g = &r->ring[0];
    if (r->middle < 0) {
        double *mean = row_at(f, TERMS * r->places);
        memset(mean, 0, (size_t)f->n * sizeof *mean);
        for (int k = 0; k < g->n; k++)
            add(f->n, 1.0 / g->n, row_at(f, row_of(r, g, k, VALUE)), mean);
        return;
    }
    for (int k = 0; k < g->n && r->slope; k++) {
        double angle = g->first + 2 * REAL_PI * k / g->n;
        memset(work, 0, (size_t)f->n * sizeof *work);
        add_out(r, 0, angle, f, work);
        add(f->n, 2 * real_cos(angle) / g->n, work, row_at(f, TURN * r->places + r->middle));
        add(f->n, 2 * real_sin(angle) / g->n, work, row_at(f, OUT * r->places + r->middle));
    }
}

void places_smooth_rings_fill(const struct places_rings *r, int n, double *rows)
{
    struct arena *a = arena_open();
    struct rows f = {n, rows};
    double *work = ARENA_TAKE(a, double, n);
    memset(row_at(&f, r->places), 0, (size_t)(TERMS - 1) * (size_t)r->places * (size_t)n * sizeof *rows);
    for (int j = 0; j < r->rings; j++)
        turn_slopes(r, &r->ring[j], VALUE, TURN, &f, work);
    for (int j = 0; j < r->rings && r->slope; j++) {
        const struct ring *g = &r->ring[j];
        for (int k = 0; k < g->n; k++)
            add_out(r, j + 1, g->first + 2 * REAL_PI * k / g->n, &f, row_at(&f, row_of(r, g, k, OUT)));
        turn_slopes(r, g, OUT, OUT_TURN, &f, work);
    }
    fill_middle(r, &f, work);
    arena_close(a);
}
