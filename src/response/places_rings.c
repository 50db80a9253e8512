/* Smooth interpolation between rings of places round a centre, each at equal angles of its own number.

   Round a ring, values and radial slopes are periodic cubic splines of the angle. From ring to ring they are joined by
   Hermite's cubic in the radius r,

       f = (1 - u)^2 (1 + 2 u) f_j + u^2 (3 - 2 u) f_(j+1) + h u (1 - u) ((1 - u) m_j - u m_(j+1)),

   with f_j, m_j the splines of ring j at the point's own angle, so that value and gradient go on through a ring even
   where the next one has other angles. The radial slopes at a place are those of the cubic spline (places_spline.h)
   along the whole diameter through it, if there is a place in the middle, and otherwise along its radius; a knot where
   a ring has no place takes the ring's periodic spline.

   The middle: its slope along the angle t is g_x cos t + g_y sin t, the first harmonic of the slopes of the diameters
   through the places of the innermost ring. Where no place is in the middle, the innermost ring's mean stands there,
   and towards it values go linearly. Beyond the outermost ring the nearest point counts.

   Periodic spline: with the step of the angle as unit, m_(k-1) + 4 m_k + m_(k+1) = 3 (f_(k+1) - f_(k-1)). Its symbol is
   x + 4 + 1/x = -(1 - z x)(1 - z/x)/z, z = sqrt(3) - 2: one pass in each direction (Unser, Aldroubi and Eden, IEEE
   Trans. Signal Processing 41, 1993, 821, there for other boundaries; round a ring each pass begins with the sum of
   all places, the farther ones at powers of z). */
#include "response/places_rings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "response/places_plane.h"
#include "response/places_spline.h"

static const double touching = 1e-9;                /* m */
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

static int up(const void *a, const void *b)
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
    qsort(p, (size_t)n, sizeof *p, up);
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
    struct places_spline s = places_spline_make(work, n, at);
    if (places_spline_grows(&s, work) <= PLACES_SPLINE_GROWS) {
        places_spline_slopes(&s, n, from, to);
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

struct places_rings *places_rings_make(struct arena *a, int n, const double *xy, const int *order, double same)
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
    qsort(p, (size_t)n, sizeof *p, up);
    bool round = take_rings(r, n, p, order, same);
    arena_close(work);
    if (!round) return NULL;
    if (r->middle >= 0 || r->rings >= 3) make_slopes(a, r);
    return r;
}

/* ------------------------------------------------------------------ slopes */

/* The mean of the innermost ring follows the terms of all places. */
int places_rings_rows(const struct places_rings *r) { return TERMS * r->places + (r->middle < 0); }

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
        to[i] += by * x[i];
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

double places_rings_smooth_at(const struct places_rings *r, double x, double y, struct places_sum *s)
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

void places_rings_fill(const struct places_rings *r, int n, double *rows)
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
