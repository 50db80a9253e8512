/* Driven nodes. Component i's interval between nodes, u = 0 .. 1 of its hop, has `order` nodes, the oldest first:

       z_q <- p_q z_q + w_q(u) A_q f       sound: sum Im z_q

       order 1: w = 1
       order 2: w = 1 - u, u                                                              nodes at 0, 1
       order 4: w = -u (1-u)(2-u)/6, (1+u)(1-u)(2-u)/2, u (1+u)(2-u)/2, -u (1+u)(1-u)/6   nodes at -1, 0, 1, 2

   (cardinal.h's windows, each a polynomial between two nodes). Hops are powers of two and blocks divide them, so that u is exact and no
   window changes its polynomial inside a block. What the force itself adds, sum_q w_q t_q over all components, is then one cubic per
   block, found from its values at four instants.

   Eight components are the lanes of a group. Per component-sample, order 4: 58 multiplications and additions, which is what bounds it. */
#include "convolution/launch_driven.h"

#include <math.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

enum { MOST = 4, SPAN = 4 };

struct group {
    _Alignas(64) double zr[MOST][LANES];
    double zi[MOST][LANES], pr[MOST][LANES], pi[MOST][LANES], gr[MOST][LANES], gi[MOST][LANES];
    double through[MOST][LANES], largest[MOST][LANES];
    double u[LANES], per_hop[LANES]; /* of the block's first frame; one frame in hops */
    int awake;                       /* a state is not zero                           */
};

struct launch_driven {
    int n, order, groups;
    struct group *group;
};

struct launch_driven *launch_driven_make(struct arena *a, int n, int order, const int *hop)
{
    struct launch_driven *d = ARENA_TAKE(a, struct launch_driven, 1);
    *d = (struct launch_driven){.n = n, .order = order, .groups = (n + LANES - 1) / LANES};
    d->group = ARENA_TAKE(a, struct group, d->groups + 1);
    for (int i = 0; i < n; i++)
        d->group[i / LANES].per_hop[i % LANES] = 1.0 / hop[i];
    return d;
}

void launch_driven_set(struct launch_driven *d, int i, int which, const struct launch_node *node)
{
    struct group *g = &d->group[i / LANES];
    int l = i % LANES;
    g->pr[which][l] = node->pole_re;
    g->pi[which][l] = node->pole_im;
    g->gr[which][l] = node->gain_re;
    g->gi[which][l] = node->gain_im;
    g->through[which][l] = node->through;
}

static void move_on(double x[MOST][LANES], int order, int l)
{
    for (int q = 0; q + 1 < order; q++)
        x[q][l] = x[q + 1][l];
    x[order - 1][l] = 0;
}

struct launch_node launch_driven_next(struct launch_driven *d, int i)
{
    struct group *g = &d->group[i / LANES];
    int l = i % LANES;
    struct launch_node old = {.pole_re = g->pr[0][l], .pole_im = g->pi[0][l], .re = g->zr[0][l], .im = g->zi[0][l], .largest = g->largest[0][l]};
    double(*all[])[LANES] = {g->zr, g->zi, g->pr, g->pi, g->gr, g->gi, g->through, g->largest};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        move_on(all[k], d->order, l);
    g->u[l] = 0;
    return old;
}

/* ------------------------------------------------------------------ under force */

struct lane {
    double zr, zi, pr, pi, gr, gi;
};

INLINE double lane_step(struct lane *v, double f)
{
    double zr = v->pr * v->zr - (v->pi * v->zi - v->gr * f);
    v->zi = v->pr * v->zi + (v->pi * v->zr + v->gi * f);
    v->zr = zr;
    return v->zi;
}

INLINE struct lane lane_take(const struct group *g, int q, int l)
{
    return (struct lane){g->zr[q][l], g->zi[q][l], g->pr[q][l], g->pi[q][l], g->gr[q][l], g->gi[q][l]};
}

INLINE void lane_keep(struct group *g, int q, int l, const struct lane *v)
{
    g->zr[q][l] = v->zr;
    g->zi[q][l] = v->zi;
}

/* The component's nodes, q oldest first; those beyond the order do nothing. */
struct component {
    struct lane *q0, *q1, *q2, *q3;
    double u, step;
};

INLINE double component_step(struct component *v, double f, int order)
{
    double u = v->u, sum;
    v->u += v->step; /* exact */
    if (order == 1)
        return lane_step(v->q0, f);
    if (order == 2) {
        sum = lane_step(v->q0, (1.0 - u) * f);
        return sum + lane_step(v->q1, u * f);
    }
    double below = 1.0 - u, two = 2.0 - u, above = 1.0 + u, left = below * two, right = u * above;
    double half = 0.5 * f, sixth = f * (-1.0 / 6);
    sum = lane_step(v->q0, (u * left) * sixth) + lane_step(v->q1, (above * left) * half);
    return sum + (lane_step(v->q2, (two * right) * half) + lane_step(v->q3, (below * right) * sixth));
}

/* `frames` is a constant: 1 or SPAN. */
INLINE void drive_some(struct group *restrict g, const double *restrict f, double (*restrict sums)[LANES], double from, int frames, int order)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        struct lane q0 = lane_take(g, 0, l), q1 = lane_take(g, 1, l), q2 = lane_take(g, 2, l), q3 = lane_take(g, 3, l);
        struct component v = {&q0, &q1, &q2, &q3, g->u[l] + from * g->per_hop[l], g->per_hop[l]};
        sums[0][l] += component_step(&v, f[0], order);
        if (frames == SPAN) {
            sums[1][l] += component_step(&v, f[1], order);
            sums[2][l] += component_step(&v, f[2], order);
            sums[3][l] += component_step(&v, f[3], order);
        }
        lane_keep(g, 0, l, &q0);
        if (order > 1)
            lane_keep(g, 1, l, &q1);
        if (order > 2) {
            lane_keep(g, 2, l, &q2);
            lane_keep(g, 3, l, &q3);
        }
    }
}

INLINE void drive(struct group *restrict g, const double *restrict f, double (*restrict sums)[LANES], int from, int n, int order)
{
    int i = 0;
    for (; i + SPAN <= n; i += SPAN)
        drive_some(g, f + i, sums + i, from + i, SPAN, order);
    for (; i < n; i++)
        drive_some(g, f + i, sums + i, from + i, 1, order);
}

LANES_CLONES
static void drive_1(struct group *g, const double *f, double (*sums)[LANES], int from, int n)
{
    drive(g, f, sums, from, n, 1);
}

LANES_CLONES
static void drive_2(struct group *g, const double *f, double (*sums)[LANES], int from, int n)
{
    drive(g, f, sums, from, n, 2);
}

LANES_CLONES
static void drive_4(struct group *g, const double *f, double (*sums)[LANES], int from, int n)
{
    drive(g, f, sums, from, n, 4);
}

void launch_driven_run(struct launch_driven *d, const double *f, double (*sums)[LANES], int from, int n)
{
    bool force = false;
    for (int i = 0; i < n; i++)
        force = force || f[i] != 0.0;
    for (int k = 0; k < d->groups; k++)
        if (force || d->group[k].awake) {
            (d->order == 1 ? drive_1 : d->order == 2 ? drive_2 : drive_4)(&d->group[k], f, sums, from, n);
            d->group[k].awake = 1;
        }
}

/* ------------------------------------------------------------------ once a block */

/* Flushes, and notes how large each state has been. Returns whether one is not zero. */
LANES_CLONES
static int flush(double *restrict zr, double *restrict zi, double *restrict largest, int n)
{
    const double least = 1e-200;
    double any = 0;
#pragma omp simd reduction(+ : any)
    for (int l = 0; l < n; l++) {
        double re = fabs(zr[l]), im = fabs(zi[l]), size = re + im;
        int none = (re < least) & (im < least);
        zr[l] = none ? 0.0 : zr[l];
        zi[l] = none ? 0.0 : zi[l];
        largest[l] = size > largest[l] ? size : largest[l];
        any += none ? 0.0 : 1.0;
    }
    return any > 0;
}

void launch_driven_settle(struct launch_driven *d, int block)
{
    for (int k = 0; k < d->groups; k++) {
        struct group *g = &d->group[k];
        for (int l = 0; l < LANES; l++)
            g->u[l] += block * g->per_hop[l];
        if (g->awake)
            g->awake = flush(g->zr[0], g->zi[0], g->largest[0], d->order * LANES);
    }
}

INLINE double weigh(const struct group *g, int l, double ahead, int order)
{
    double u = g->u[l] + ahead * g->per_hop[l], below = 1 - u, two = 2 - u, above = 1 + u;
    if (order == 1)
        return g->through[0][l];
    if (order == 2)
        return below * g->through[0][l] + u * g->through[1][l];
    return below * two * (above / 2 * g->through[1][l] - u / 6 * g->through[0][l]) +
           u * above * (two / 2 * g->through[2][l] - below / 6 * g->through[3][l]);
}

/* Adds sum_q w_q t_q of every lane at thirds of the block. */
LANES_CLONES
static void add_through(const struct group *restrict g, double block, int order, double v[restrict 4][LANES])
{
    for (int j = 0; j < 4; j++) {
        double ahead = block * (j / 3.0);
        if (order == 4)
#pragma omp simd
            for (int l = 0; l < LANES; l++)
                v[j][l] += weigh(g, l, ahead, 4);
        else
            for (int l = 0; l < LANES; l++)
                v[j][l] += weigh(g, l, ahead, order);
    }
}

void launch_driven_through(const struct launch_driven *d, int block, double p[4])
{
    double lanes[4][LANES] = {{0}}, v[4] = {0};
    for (int k = 0; k < d->groups; k++)
        add_through(&d->group[k], block, d->order, lanes);
    for (int j = 0; j < 4; j++)
        for (int l = 0; l < LANES; l++)
            v[j] += lanes[j][l];
    p[0] = v[0]; /* the cubic through the four */
    p[1] = (-11 * v[0] + 18 * v[1] - 9 * v[2] + 2 * v[3]) / 2;
    p[2] = (18 * v[0] - 45 * v[1] + 36 * v[2] - 9 * v[3]) / 2;
    p[3] = (-9 * v[0] + 27 * v[1] - 27 * v[2] + 9 * v[3]) / 2;
}

long launch_driven_active(const struct launch_driven *d)
{
    long count = 0;
    for (int k = 0; k < d->groups; k++)
        for (int q = 0; q < d->order; q++)
            for (int l = 0; l < LANES; l++)
                count += d->group[k].zr[q][l] != 0.0 || d->group[k].zi[q][l] != 0.0;
    return count;
}
