/* Every force sample launches the response of its own place, by resonators (papers/000 eq. 10 and 13, `launch` of
   rasp-scene(5)).

       y(n) = (1/rate) sum_{m <= n} h_{x(m)}((n-m)/rate) f(m),   half of h(0+) at m = n,   h_x(t) = sum_i Im A_i(x)
   e^(s_i(x) t)

   Nodes stand every H frames, and h is the cubic through the four nearest. So in the interval between nodes k and k +
   1, u = 0 .. 1 of it, the force drives the resonators of nodes k - 1 .. k + 2 with w_q(u) f,

       w = -u (1-u)(2-u)/6, (1+u)(1-u)(2-u)/2, u (1+u)(2-u)/2, -u (1+u)(1-u)/6

   and at its end those of node k - 1 are free and ring out. With poles that move evenly, white force, a mode's relative
   rms error is

       0.211 rho^4,   rho = |ds/dt| H / (rate |Re s|): half bandwidths by which the pole moves in a hop

   (the mean square of the cubic's node polynomial and int t^8 e^(2 Re s t) dt). What the force adds by itself, -Im A/(2
   rate) and the direct term of an acceleration (modes_direct), is interpolated by the same weights.

   Nodes that ring out take about as much as three resonators of a component however many they are (below). A node is
   dropped when it has fallen to `floor` times what it was when the force left it. Poles and gains are not asked for
   while there is no force.

   Nodes and blocks stand at fixed frames, and sums have one order: the sound does not depend on how it is cut into
   calls, nor on the instruction set.

   What rings out. Many damped sinusoids with nearly the same pole cost little more than one.

   Nodes k of a cluster ring freely with poles s_k = s + delta_k. In a block of B frames, frame j = 0 .. B-1, c = B/2,
   tau = (j - c)/c,

       sum_k Im z_k e^(s_k (j+1)/rate) = Im e^(s (j+1)/rate) sum_k x_k e^(d_k tau),   x_k = z_k e^(delta_k (c+1)/rate),
   d_k = delta_k c/rate

   z_k the state in the last frame before the block, and with |d_k| < 0.09, |tau| <= 1 seven terms of

       sum_k x_k e^(d_k tau) = sum_r tau^r M_r,   M_r = sum_k x_k d_k^r / r!

   leave 0.09^7/7! = 1e-11 of |x_k| (five terms below 0.0164; one where all poles are the cluster's own, exactly). From
   block to block each state goes on by its own e^(s_k B/rate), so that nothing adds up. Per frame a cluster costs 38
   operations however many nodes it has, and a node, per block, 56; a resonator each would take 7 per frame.

   In blocks of one frame c is taken as 1 in d_k, and tau = 0.

   A node freed from the force joins a cluster of its component whose pole s_c is near enough, |s - s_c| c/rate < 0.09
   (c half a block); when there is none it opens one. Poles move on mostly the way they came, so that the new pole s_c
   lies ahead of the node's: by half of what the component's poles will have moved while the node rings, but at most by
   0.8 of that reach. A node whose pole is that of the cluster's last is added to its state, which is exact.

   A node of size |z| is dropped after log(|z|/least)/decay seconds; that is looked at every SWEEP blocks, so that it
   may be SWEEP - 1 blocks late. What is dropped leaves its row to the lane's last one. Everything depends on frame
   numbers and states alone: the same order of sums however calls are cut. */
#include "convolution/launch.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/resonators.h"
#include "num/lanes.h"
#include "num/real.h"
#include "num/scaled.h"
#include "num/vecmath.h"

#define INLINE static inline __attribute__((always_inline))
#define REACH_5 0.0164 /* (5! 1e-11)^(1/5) */

enum { BLOCK = 64, NODES = 4, SWEEP = 8, SPAN = 4, TERMS = 7, ROWS = 4 }; /* BLOCK: most frames of a block */

/* ------------------------------------------------------------------ clusters: eight of them are the lanes */

/* How far (|d|) a node's pole may lie from its cluster's for an error of 1e-11 of the node's size. */
#define REACH 0.09

struct row {                       /* one node per lane; a state of zero: none */
    _Alignas(64) double xr[LANES]; /* state, e^(d) from the block's start      */
    double xi[LANES];
    double dr[LANES], di[LANES]; /* d = (s_node - s_cluster) times half a block */
    double ar[LANES], ai[LANES]; /* e^(s_node block)                            */
    double until[LANES];         /* frame from which it is dropped              */
};

struct clusters {
    _Alignas(64) double qr[LANES]; /* carrier's pole e^(s_cluster/rate) */
    double qi[LANES];
    double mr[TERMS][LANES], mi[TERMS][LANES];
    struct row *rows;
    int used, room; /* rows; multiples of ROWS */
    double reach;   /* largest |d| of its nodes               */
};

/* ------------------------------------------------------------------ moments */

struct term {
    double r, i, dr, di;
};

INLINE struct term term_take(const struct row *row, int l)
{
    return (struct term){row->xr[l], row->xi[l], row->dr[l], row->di[l]};
}

INLINE void term_turn(struct term *t)
{
    double r = fma(t->r, t->dr, -(t->i * t->di));
    t->i = fma(t->r, t->di, t->i * t->dr);
    t->r = r;
}

struct four {
    struct term *a, *b, *c, *d;
};

INLINE void four_add(const struct four *v, struct clusters *g, int r, int l)
{
    g->mr[r][l] += (v->a->r + v->b->r) + (v->c->r + v->d->r);
    g->mi[r][l] += (v->a->i + v->b->i) + (v->c->i + v->d->i);
}

INLINE void four_next(const struct four *v, struct clusters *g, int r, int l)
{
    term_turn(v->a);
    term_turn(v->b);
    term_turn(v->c);
    term_turn(v->d);
    four_add(v, g, r, l);
}

INLINE void row_advance(struct row *row, int l)
{
    double r = fma(row->xr[l], row->ar[l], -(row->xi[l] * row->ai[l]));
    row->xi[l] = fma(row->xr[l], row->ai[l], row->xi[l] * row->ar[l]);
    row->xr[l] = r;
}

/* Four rows; `terms` is a constant: 1, 5 or 7. */
INLINE void gather_four(struct clusters *restrict g, struct row *restrict rows, int terms)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        struct term a = term_take(rows, l), b = term_take(rows + 1, l), c = term_take(rows + 2, l),
                    d = term_take(rows + 3, l);
        const struct four v = {&a, &b, &c, &d};
        four_add(&v, g, 0, l);
        if (terms > 1) {
            four_next(&v, g, 1, l);
            four_next(&v, g, 2, l);
            four_next(&v, g, 3, l);
            four_next(&v, g, 4, l);
        }
        if (terms > 5) {
            four_next(&v, g, 5, l);
            four_next(&v, g, 6, l);
        }
        row_advance(rows, l);
        row_advance(rows + 1, l);
        row_advance(rows + 2, l);
        row_advance(rows + 3, l);
    }
}

INLINE void gather(struct clusters *restrict g, int terms)
{
    static const double inverse[TERMS] = {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720};
    for (int k = 0; k < g->used; k += ROWS)
        gather_four(g, g->rows + k, terms);
    for (int r = 2; r < terms; r++)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            g->mr[r][l] *= inverse[r];
            g->mi[r][l] *= inverse[r];
        }
}

/* ------------------------------------------------------------------ sound */

struct carrier {
    double r, i, qr, qi;
};

/* Im of the carrier times the polynomial, and the carrier one frame further. */
INLINE double frame(const struct clusters *g, int l, struct carrier *c, double tau, int terms)
{
    double er = g->mr[0][l], ei = g->mi[0][l];
    if (terms == 5) {
        er = fma(tau, fma(tau, fma(tau, fma(tau, g->mr[4][l], g->mr[3][l]), g->mr[2][l]), g->mr[1][l]), er);
        ei = fma(tau, fma(tau, fma(tau, fma(tau, g->mi[4][l], g->mi[3][l]), g->mi[2][l]), g->mi[1][l]), ei);
    }
    if (terms == 7) {
        double hr = fma(tau, fma(tau, g->mr[6][l], g->mr[5][l]), g->mr[4][l]),
               hi = fma(tau, fma(tau, g->mi[6][l], g->mi[5][l]), g->mi[4][l]);
        er = fma(tau, fma(tau, fma(tau, fma(tau, hr, g->mr[3][l]), g->mr[2][l]), g->mr[1][l]), er);
        ei = fma(tau, fma(tau, fma(tau, fma(tau, hi, g->mi[3][l]), g->mi[2][l]), g->mi[1][l]), ei);
    }
    double y = fma(c->r, ei, c->i * er), r = fma(c->r, c->qr, -(c->i * c->qi));
    c->i = fma(c->r, c->qi, c->i * c->qr);
    c->r = r;
    return y;
}

/* `frames` is a constant: 1 or SPAN. */
INLINE void sound_some(const struct clusters *restrict g, double (*restrict carrier)[LANES],
                       double (*restrict sums)[LANES], const double *restrict tau, int frames, int terms)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        struct carrier c = {carrier[0][l], carrier[1][l], g->qr[l], g->qi[l]};
        sums[0][l] += frame(g, l, &c, tau[0], terms);
        if (frames == SPAN) {
            sums[1][l] += frame(g, l, &c, tau[1], terms);
            sums[2][l] += frame(g, l, &c, tau[2], terms);
            sums[3][l] += frame(g, l, &c, tau[3], terms);
        }
        carrier[0][l] = c.r;
        carrier[1][l] = c.i;
    }
}

INLINE void sound(const struct clusters *restrict g, double (*restrict sums)[LANES], int block, int terms)
{
    _Alignas(64) double carrier[2][LANES];
    double centre = block / 2, per = block > 1 ? 1 / centre : 1;
    memcpy(carrier[0], g->qr, sizeof carrier[0]);
    memcpy(carrier[1], g->qi, sizeof carrier[1]);
    int j = 0;
    for (; j + SPAN <= block; j += SPAN) {
        const double tau[SPAN] = {(j - centre) * per, (j + 1 - centre) * per, (j + 2 - centre) * per,
                                  (j + 3 - centre) * per};
        sound_some(g, carrier, sums + j, tau, SPAN, terms);
    }
    for (; j < block; j++)
        sound_some(g, carrier, sums + j, &(double){(j - centre) * per}, 1, terms);
}

INLINE void ring_some(struct clusters *g, double (*sums)[LANES], int block, int terms)
{
    gather(g, terms);
    sound(g, sums, block, terms);
}

LANES_CLONES
static void ring_1(struct clusters *g, double (*sums)[LANES], int block) { ring_some(g, sums, block, 1); }

LANES_CLONES
static void ring_5(struct clusters *g, double (*sums)[LANES], int block) { ring_some(g, sums, block, 5); }

LANES_CLONES
static void ring_7(struct clusters *g, double (*sums)[LANES], int block) { ring_some(g, sums, block, 7); }

static void cluster_ring(struct clusters *g, double (*sums)[LANES], int block)
{
    memset(g->mr, 0, sizeof g->mr);
    memset(g->mi, 0, sizeof g->mi);
    (g->reach == 0.0 ? ring_1 : g->reach < REACH_5 ? ring_5 : ring_7)(g, sums, block);
}

/* ------------------------------------------------------------------ nodes that ring out */

/* A node that the force leaves. */
struct freed {
    int component;
    long frame;              /* first without force                             */
    double frequency, decay; /* Hz, 1/s                                         */
    double re, im;           /* state in the last frame before the coming block */
    double least;            /* size at which it is dropped                     */
};

struct lane {
    int component, count; /* nodes; none: free for another cluster */
    int next;             /* lane of the same component, or of the free ones; -1: no other */
    double s[2];          /* the cluster's pole: -decay, 2 f                               */
    double soonest;       /* frame in which the first node is to be dropped                */
    double reach;
};

struct before { /* the node a component freed last */
    double s[2];
    long frame;
    bool any;
};

struct ringing {
    struct arena *arena;
    int groups, room;  /* groups of clusters: in use, allocated */
    int block, centre; /* frames; c, 1 of a block of one */
    double rate;
    long now; /* first frame of the coming block */
    struct clusters *group;
    struct lane *lane; /* [room LANES] */
    int *first;        /* [n] a component's newest cluster, -1: none */
    int free;          /* a lane, -1: none                           */
    struct before *before;
    int *place; /* [n] and the following: of the nodes being added */
    double *size, *turn, *rise, *life;
    double *dr, *di, *ar, *ai;
};

static struct ringing *ringing_make(struct arena *a, int n, double rate, int block)
{
    struct ringing *r = ARENA_TAKE(a, struct ringing, 1);
    *r = (struct ringing){.arena = a, .rate = rate, .free = -1, .block = block, .centre = block > 1 ? block / 2 : 1};
    r->first = ARENA_TAKE(a, int, n + 1);
    r->place = ARENA_TAKE(a, int, n + 1);
    r->before = ARENA_TAKE(a, struct before, n + 1);
    double **rooms[] = {&r->size, &r->turn, &r->rise, &r->life, &r->dr, &r->di, &r->ar, &r->ai};
    for (size_t k = 0; k < sizeof rooms / sizeof rooms[0]; k++)
        *rooms[k] = ARENA_TAKE(a, double, n + 1);
    for (int i = 0; i < n; i++)
        r->first[i] = -1;
    return r;
}

/* ------------------------------------------------------------------ lanes and rows */

static void grow_groups(struct ringing *r)
{
    int room = r->room ? 2 * r->room : 8;
    struct clusters *group = ARENA_TAKE(r->arena, struct clusters, room);
    struct lane *lane = ARENA_TAKE(r->arena, struct lane, room * LANES);
    for (int k = 0; k < r->groups; k++)
        group[k] = r->group[k];
    for (int l = 0; l < r->groups * LANES; l++)
        lane[l] = r->lane[l];
    r->group = group;
    r->lane = lane;
    r->room = room;
}

static int free_lane(struct ringing *r)
{
    if (r->free < 0) {
        if (r->groups == r->room) grow_groups(r);
        int at = r->groups++ * LANES;
        for (int l = LANES - 1; l >= 0; l--) { /* the lowest is taken first */
            r->lane[at + l].next = r->free;
            r->free = at + l;
        }
    }
    int l = r->free;
    r->free = r->lane[l].next;
    return l;
}

static void grow_rows(struct clusters *g, struct arena *a)
{
    int room = g->room ? 2 * g->room : 2 * ROWS;
    struct row *rows = ARENA_TAKE(a, struct row, room);
    for (int k = 0; k < g->used; k++)
        rows[k] = g->rows[k];
    g->rows = rows;
    g->room = room;
}

/* How many rows the group's lanes need, and the reach of those that ring. */
static void measure(struct ringing *r, int k)
{
    int most = 0;
    r->group[k].reach = 0;
    for (int l = k * LANES; l < (k + 1) * LANES; l++)
        if (r->lane[l].count) {
            most = r->lane[l].count > most ? r->lane[l].count : most;
            r->group[k].reach = fmax(r->group[k].reach, r->lane[l].reach);
        }
    r->group[k].used = (most + ROWS - 1) / ROWS * ROWS;
}

/* ------------------------------------------------------------------ dropping */

static void lane_free(struct ringing *r, int l)
{
    int *link = &r->first[r->lane[l].component];
    while (*link != l)
        link = &r->lane[*link].next;
    *link = r->lane[l].next;
    r->lane[l].next = r->free;
    r->free = l;
}

static void lane_sweep(struct ringing *r, int l)
{
    struct lane *v = &r->lane[l];
    struct row *rows = r->group[l / LANES].rows;
    v->soonest = HUGE_VAL;
    for (int k = 0; k < v->count;)
        if (rows[k].until[l % LANES] <= (double)r->now) {
            struct row *to = &rows[k], *from = &rows[--v->count];
            int i = l % LANES;
            to->xr[i] = from->xr[i], to->xi[i] = from->xi[i];
            to->dr[i] = from->dr[i], to->di[i] = from->di[i];
            to->ar[i] = from->ar[i], to->ai[i] = from->ai[i];
            to->until[i] = from->until[i];
            from->xr[i] = from->xi[i] = 0;
        } else {
            v->soonest = fmin(v->soonest, rows[k].until[l % LANES]);
            k++;
        }
    if (v->count == 0) lane_free(r, l);
}

static void sweep(struct ringing *r)
{
    for (int k = 0; k < r->groups; k++) {
        bool dropped = false;
        for (int l = k * LANES; l < (k + 1) * LANES; l++)
            if (r->lane[l].count && r->lane[l].soonest <= (double)r->now) {
                lane_sweep(r, l);
                dropped = true;
            }
        if (dropped) measure(r, k);
    }
}

/* ------------------------------------------------------------------ adding */

/* d, the distance of two poles: in [0] and [1], and its size. */
static double distance(const struct ringing *r, const double *s, const double *from, double d[2])
{
    double per = r->centre / r->rate;
    d[0] = (s[0] - from[0]) * per;
    d[1] = (s[1] - from[1]) * REAL_PI * per;
    return sqrt(d[0] * d[0] + d[1] * d[1]);
}

/* A pole ahead of s, see above; `life` in frames. */
static void ahead(const struct ringing *r, const struct freed *node, const double *s, double life, double pole[2])
{
    const struct before *b = &r->before[node->component];
    double d[2], step = b->any ? distance(r, s, b->s, d) : 0, share = 0;
    if (step > 0) {
        double most = 0.8 * REACH / step;
        share = fmin(0.5 * fmax(life, 0) / (double)(node->frame - b->frame), most);
    }
    for (int k = 0; k < 2; k++)
        pole[k] = step > 0 ? s[k] + share * (s[k] - b->s[k]) : s[k];
}

static int cluster_open(struct ringing *r, const struct freed *node, const double *s, double life)
{
    int l = free_lane(r);
    struct lane *v = &r->lane[l];
    struct clusters *g = &r->group[l / LANES];
    *v = (struct lane){.component = node->component, .next = r->first[node->component], .soonest = HUGE_VAL};
    r->first[node->component] = l;
    ahead(r, node, s, life, v->s);
    double size = real_exp(v->s[0] / r->rate), turn = v->s[1] / r->rate;
    g->qr[l % LANES] = size * real_cospi(turn);
    g->qi[l % LANES] = size * real_sinpi(turn);
    return l;
}

static int cluster_for(struct ringing *r, const struct freed *node, const double *s, double life)
{
    double d[2];
    for (int l = r->first[node->component]; l >= 0; l = r->lane[l].next)
        if (distance(r, s, r->lane[l].s, d) < REACH) return l;
    return cluster_open(r, node, s, life);
}

/* Where each node goes, its d, and the arguments of e^(delta (c+1)/rate) and e^(s block/rate). */
static void place(struct ringing *r, const struct freed *freed, int count)
{
    double wait = (r->block / 2 + 1) / r->rate, span = r->block / r->rate;
    for (int k = 0; k < count; k++)
        r->life[k] = (fabs(freed[k].re) + fabs(freed[k].im)) / freed[k].least;
    vecmath_log((size_t)count, r->life, r->life);
    for (int k = 0; k < count; k++) {
        double s[2] = {-freed[k].decay, 2 * freed[k].frequency};
        r->life[k] = freed[k].decay > 0 ? r->life[k] * r->rate / freed[k].decay : HUGE_VAL;
        r->place[k] = cluster_for(r, &freed[k], s, r->life[k]);
        struct lane *v = &r->lane[r->place[k]];
        double d[2];
        v->reach = fmax(v->reach, distance(r, s, v->s, d));
        r->dr[k] = d[0], r->di[k] = d[1];
        r->size[k] = (s[0] - v->s[0]) * wait, r->turn[k] = (s[1] - v->s[1]) * wait;
        r->ar[k] = s[0] * span, r->ai[k] = s[1] * span;
        r->before[freed[k].component] = (struct before){.s = {s[0], s[1]}, .frame = freed[k].frame, .any = true};
    }
}

/* Row for the k-th of the nodes: that of the lane's last one if it has the same pole. */
static void insert(struct ringing *r, int k, double re, double im)
{
    struct lane *v = &r->lane[r->place[k]];
    struct clusters *g = &r->group[r->place[k] / LANES];
    int l = r->place[k] % LANES, last = v->count - 1;
    double until = (double)r->now + r->life[k];
    if (last >= 0 && g->rows[last].dr[l] == r->dr[k] && g->rows[last].di[l] == r->di[k]) {
        g->rows[last].xr[l] += re;
        g->rows[last].xi[l] += im;
        g->rows[last].until[l] = fmax(g->rows[last].until[l], until);
        return;
    }
    if (v->count == g->room) grow_rows(g, r->arena);
    struct row *row = &g->rows[v->count++];
    row->xr[l] = re, row->xi[l] = im;
    row->dr[l] = r->dr[k], row->di[l] = r->di[k];
    row->ar[l] = r->ar[k], row->ai[l] = r->ai[k];
    row->until[l] = until;
    v->soonest = fmin(v->soonest, until);
    measure(r, r->place[k] / LANES);
}

static void ringing_add(struct ringing *r, const struct freed *freed, int count)
{
    size_t n = (size_t)count;
    place(r, freed, count);
    vecmath_exp(n, r->size, r->size);
    vecmath_sincospi(n, r->turn, r->rise, r->turn);
    for (int k = 0; k < count; k++) {
        double re = r->size[k] * r->turn[k], im = r->size[k] * r->rise[k];
        r->turn[k] = freed[k].re * re - freed[k].im * im;
        r->rise[k] = freed[k].re * im + freed[k].im * re;
    }
    vecmath_exp(n, r->ar, r->ar);
    vecmath_sincospi(n, r->ai, r->size, r->ai);
    for (int k = 0; k < count; k++) {
        double size = r->ar[k];
        r->ar[k] = size * r->ai[k];
        r->ai[k] = size * r->size[k];
        insert(r, k, r->turn[k], r->rise[k]);
    }
}

static void ringing_run(struct ringing *r, double (*sums)[LANES])
{
    if ((r->now / r->block) % SWEEP == 0) sweep(r);
    for (int k = 0; k < r->groups; k++)
        if (r->group[k].used) cluster_ring(&r->group[k], sums, r->block);
    r->now += r->block;
}

/* ------------------------------------------------------------------ nodes under force */

/* The resonators of one node under force. */
struct node {
    struct resonator_group *group;
    double *frequency, *decay; /* [n] */
    double through;            /* what the force adds by itself, per N */
    bool known, awake;         /* poles and gains are there; a state is not zero */
};

struct launch {
    struct arena *arena;
    struct launch_ask ask;
    launch_point *point;
    void *self;
    int groups, block; /* block: frames, a part of the hop, at most BLOCK */
    long now;
    struct node node[NODES];         /* oldest first */
    struct resonator_group **active; /* [groups] */
    struct modes_point at;           /* [n] the place asked for last */
    double *size, *turn, *rise;      /* [n] of its poles */
    struct freed *freed;             /* [n] */
    struct ringing *ringing;
    double sums[BLOCK][LANES]; /* of the present block */
};

/* ------------------------------------------------------------------ open and close */

struct launch *launch_open(const struct launch_ask *ask, launch_point *point, void *self)
{
    struct arena *a = arena_open();
    struct launch *l = ARENA_TAKE(a, struct launch, 1);
    *l = (struct launch){.arena = a,
                         .ask = *ask,
                         .point = point,
                         .self = self,
                         .groups = (ask->n + LANES - 1) / LANES,
                         .at = modes_point_make(a, ask->n + 1)};
    for (int parts = (ask->hop + BLOCK - 1) / BLOCK; l->block == 0; parts++)
        l->block = ask->hop % parts == 0 ? ask->hop / parts : 0;
    for (int q = 0; q < NODES; q++) {
        l->node[q].group = ARENA_TAKE(a, struct resonator_group, l->groups + 1);
        l->node[q].frequency = ARENA_TAKE(a, double, ask->n + 1);
        l->node[q].decay = ARENA_TAKE(a, double, ask->n + 1);
    }
    l->active = ARENA_TAKE(a, struct resonator_group *, l->groups + 1);
    l->size = ARENA_TAKE(a, double, ask->n + 1);
    l->turn = ARENA_TAKE(a, double, ask->n + 1);
    l->rise = ARENA_TAKE(a, double, ask->n + 1);
    l->freed = ARENA_TAKE(a, struct freed, ask->n + 1);
    l->ringing = ringing_make(a, ask->n, ask->rate, l->block);
    return l;
}

void launch_close(struct launch *l) { arena_close(l->arena); }

/* ------------------------------------------------------------------ nodes */

/* Poles and gains of the node at that frame. */
static void set_node(struct launch *l, struct node *v, double frame)
{
    size_t n = (size_t)l->ask.n;
    double per = 1.0 / l->ask.rate;
    l->point(l->self, frame, &l->at);
    memcpy(v->frequency, l->at.frequency, n * sizeof *v->frequency);
    memcpy(v->decay, l->at.decay, n * sizeof *v->decay);
    for (size_t i = 0; i < n; i++) {
        l->size[i] = -l->at.decay[i] / l->ask.rate;
        l->turn[i] = 2.0 * l->at.frequency[i] / l->ask.rate;
    }
    vecmath_exp(n, l->size, l->size);
    vecmath_sincospi(n, l->turn, l->rise, l->turn);
    v->through = modes_direct(l->ask.quantity, l->ask.n, l->at.frequency, l->at.decay, &l->at);
    for (size_t i = 0; i < n; i++) {
        struct resonator_group *g = &v->group[i / LANES];
        g->pr[i % LANES] = l->size[i] * l->turn[i];
        g->pi[i % LANES] = l->size[i] * l->rise[i];
        g->gr[i % LANES] = l->at.re[i] * per;
        g->gi[i % LANES] = l->at.im[i] * per;
        v->through -= 0.5 * g->gi[i % LANES];
    }
    v->known = true;
}

/* The oldest node is free: its resonators ring on, and serve the node that comes next. */
static void next_node(struct launch *l)
{
    struct node old = l->node[0];
    int count = 0;
    for (int i = 0; old.awake && i < l->ask.n; i++) {
        const struct resonator_group *g = &old.group[i / LANES];
        int lane = i % LANES;
        double size = fabs(g->zr[lane]) + fabs(g->zi[lane]);
        if (size > 1e-200)
            l->freed[count++] = (struct freed){
                i, l->now, old.frequency[i], old.decay[i], g->zr[lane], g->zi[lane], fmax(l->ask.floor * size, 1e-200)};
    }
    ringing_add(l->ringing, l->freed, count);
    for (int k = 0; old.awake && k < l->groups; k++)
        memset(old.group[k].zr, 0, sizeof old.group[k].zr), memset(old.group[k].zi, 0, sizeof old.group[k].zi);
    memmove(l->node, l->node + 1, (NODES - 1) * sizeof *l->node);
    old.known = old.awake = false;
    l->node[NODES - 1] = old;
}

/* ------------------------------------------------------------------ blocks */

/* After a block: a node whose states have all fallen below 1e-200 is at rest. */
static void rest(struct launch *l)
{
    for (int q = 0; q < NODES; q++) {
        struct node *v = &l->node[q];
        double most = 0;
        for (int k = 0; v->awake && k < l->groups; k++)
            for (int lane = 0; lane < LANES; lane++)
                most = fmax(most, fmax(fabs(v->group[k].zr[lane]), fabs(v->group[k].zi[lane])));
        for (int k = 0; v->awake && most < 1e-200 && k < l->groups; k++)
            memset(v->group[k].zr, 0, sizeof v->group[k].zr), memset(v->group[k].zi, 0, sizeof v->group[k].zi);
        v->awake = v->awake && most >= 1e-200;
    }
}

/* n frames inside one block. */
static void run_some(struct launch *l, const double *f, double *y, int n)
{
    static const double by[NODES] = {-1.0 / 6, 0.5, 0.5, -1.0 / 6};
    long at = l->now % l->ask.hop;
    int from = (int)(l->now % l->block);
    double share[NODES][BLOCK];
    bool force = !scaled_is_zero(f, n);
    for (int j = 0; j < n; j++) {
        double u = (double)(at + j) / l->ask.hop, v = 1 - u, around = (1 + u) * (2 - u);
        const double w[NODES] = {u * v * (2 - u), around * v, around * u, u * v * (1 + u)};
        for (int q = 0; q < NODES; q++)
            share[q][j] = by[q] * w[q] * f[j];
    }
    for (int q = 0; q < NODES; q++) {
        struct node *v = &l->node[q];
        if (force && !v->known) set_node(l, v, (double)(l->now - at + (q - 1) * (long)l->ask.hop));
        v->awake = v->awake || force;
        for (int k = 0; k < l->groups; k++)
            l->active[k] = &v->group[k];
        if (v->awake) resonators_ring(l->active, l->groups, share[q], l->sums + from, n, RESONATOR_STEADY);
    }
    for (int j = 0; j < n; j++) {
        double sum = lanes_total(l->sums[from + j]);
        for (int q = 0; force && q < NODES; q++)
            sum += l->node[q].through * share[q][j];
        y[j] += sum;
    }
    l->now += n;
    if (l->now % l->block == 0) rest(l);
}

void launch_run(struct launch *l, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames && l->ask.n > 0;) {
        long left = l->block - l->now % l->block, n = frames - done < left ? frames - done : left;
        if (l->now % l->block == 0) {
            if (l->now > 0 && l->now % l->ask.hop == 0) next_node(l);
            memset(l->sums, 0, sizeof l->sums);
            ringing_run(l->ringing, l->sums);
        }
        run_some(l, f + done, y + done, (int)n);
        done += n;
    }
}

long launch_active(const struct launch *l)
{
    long count = 0;
    for (int k = 0; k < l->ringing->groups * LANES; k++)
        count += l->ringing->lane[k].count;
    for (int q = 0; q < NODES; q++)
        for (int i = 0; i < l->ask.n; i++)
            count +=
                l->node[q].group[i / LANES].zr[i % LANES] != 0.0 || l->node[q].group[i / LANES].zi[i % LANES] != 0.0;
    return count;
}
