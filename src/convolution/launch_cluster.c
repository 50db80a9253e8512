/* Many damped sinusoids with nearly the same pole cost little more than one.

   Nodes k of a cluster ring freely with poles s_k = s + delta_k. In a block of B frames, frame j = 0 .. B-1, c = B/2, tau = (j - c)/c,

       sum_k Im z_k e^(s_k (j+1)/rate) = Im e^(s (j+1)/rate) sum_k x_k e^(d_k tau),   x_k = z_k e^(delta_k (c+1)/rate),   d_k = delta_k c/rate

   z_k the state in the last frame before the block, and with |d_k| < 0.09, |tau| <= 1 seven terms of

       sum_k x_k e^(d_k tau) = sum_r tau^r M_r,   M_r = sum_k x_k d_k^r / r!

   leave 0.09^7/7! = 1e-11 of |x_k| (five terms below 0.0164; one where all poles are the cluster's own, exactly). From block to block each
   state goes on by its own e^(s_k B/rate), so that nothing adds up. Per frame a cluster costs 38 operations however many nodes it has, and a
   node, per block, 56; a resonator each would take 7 per frame.

   In blocks of one frame c is taken as 1 in d_k, and tau = 0. */
#include "convolution/launch_cluster.h"

#include <string.h>

#define INLINE static inline __attribute__((always_inline))
#define REACH_5 0.0164 /* (5! 1e-11)^(1/5) */

enum { SPAN = 4 };

/* ------------------------------------------------------------------ moments */

struct term {
    double r, i, dr, di;
};

INLINE struct term term_take(const struct launch_cluster_row *row, int l)
{
    return (struct term){row->xr[l], row->xi[l], row->dr[l], row->di[l]};
}

INLINE void term_turn(struct term *t)
{
    double r = t->r * t->dr - t->i * t->di;
    t->i = t->r * t->di + t->i * t->dr;
    t->r = r;
}

struct four {
    struct term *a, *b, *c, *d;
};

INLINE void four_add(const struct four *v, struct launch_cluster *g, int r, int l)
{
    g->mr[r][l] += (v->a->r + v->b->r) + (v->c->r + v->d->r);
    g->mi[r][l] += (v->a->i + v->b->i) + (v->c->i + v->d->i);
}

INLINE void four_next(const struct four *v, struct launch_cluster *g, int r, int l)
{
    term_turn(v->a);
    term_turn(v->b);
    term_turn(v->c);
    term_turn(v->d);
    four_add(v, g, r, l);
}

INLINE void row_advance(struct launch_cluster_row *row, int l)
{
    double r = row->xr[l] * row->ar[l] - row->xi[l] * row->ai[l];
    row->xi[l] = row->xr[l] * row->ai[l] + row->xi[l] * row->ar[l];
    row->xr[l] = r;
}

/* Four rows; `terms` is a constant: 1, 5 or 7. */
INLINE void gather_four(struct launch_cluster *restrict g, struct launch_cluster_row *restrict rows, int terms)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        struct term a = term_take(rows, l), b = term_take(rows + 1, l), c = term_take(rows + 2, l), d = term_take(rows + 3, l);
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

INLINE void gather(struct launch_cluster *restrict g, int terms)
{
    static const double inverse[LAUNCH_CLUSTER_TERMS] = {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720};
    for (int k = 0; k < g->used; k += LAUNCH_CLUSTER_ROWS)
        gather_four(g, g->rows + k, terms);
    for (int r = 2; r < terms; r++)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            g->mr[r][l] *= inverse[r];
            g->mi[r][l] *= inverse[r];
        }
}

LANES_CLONES
static void gather_1(struct launch_cluster *g)
{
    gather(g, 1);
}

LANES_CLONES
static void gather_5(struct launch_cluster *g)
{
    gather(g, 5);
}

LANES_CLONES
static void gather_7(struct launch_cluster *g)
{
    gather(g, 7);
}

static int terms_of(const struct launch_cluster *g)
{
    return g->reach == 0.0 ? 1 : g->reach < REACH_5 ? 5 : 7;
}

void launch_cluster_gather(struct launch_cluster *g)
{
    int terms = terms_of(g);
    memset(g->mr, 0, sizeof g->mr);
    memset(g->mi, 0, sizeof g->mi);
    (terms == 1 ? gather_1 : terms == 5 ? gather_5 : gather_7)(g);
}

/* ------------------------------------------------------------------ sound */

struct carrier {
    double r, i, qr, qi;
};

/* Im of the carrier times the polynomial, and the carrier one frame further. */
INLINE double frame(const struct launch_cluster *g, int l, struct carrier *c, double tau, int terms)
{
    double er = g->mr[0][l], ei = g->mi[0][l];
    if (terms == 5) {
        er += tau * (g->mr[1][l] + tau * (g->mr[2][l] + tau * (g->mr[3][l] + tau * g->mr[4][l])));
        ei += tau * (g->mi[1][l] + tau * (g->mi[2][l] + tau * (g->mi[3][l] + tau * g->mi[4][l])));
    }
    if (terms == 7) {
        double hr = g->mr[4][l] + tau * (g->mr[5][l] + tau * g->mr[6][l]), hi = g->mi[4][l] + tau * (g->mi[5][l] + tau * g->mi[6][l]);
        er += tau * (g->mr[1][l] + tau * (g->mr[2][l] + tau * (g->mr[3][l] + tau * hr)));
        ei += tau * (g->mi[1][l] + tau * (g->mi[2][l] + tau * (g->mi[3][l] + tau * hi)));
    }
    double y = c->r * ei + c->i * er, r = c->r * c->qr - c->i * c->qi;
    c->i = c->r * c->qi + c->i * c->qr;
    c->r = r;
    return y;
}

/* `frames` is a constant: 1 or SPAN. */
INLINE void sound_some(const struct launch_cluster *restrict g, double (*restrict carrier)[LANES], double (*restrict sums)[LANES],
                       const double *restrict tau, int frames, int terms)
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

INLINE void sound(const struct launch_cluster *restrict g, double (*restrict sums)[LANES], int block, int terms)
{
    _Alignas(64) double carrier[2][LANES];
    double centre = block / 2, per = block > 1 ? 1 / centre : 1; /* powers of two */
    memcpy(carrier[0], g->qr, sizeof carrier[0]);
    memcpy(carrier[1], g->qi, sizeof carrier[1]);
    int j = 0;
    for (; j + SPAN <= block; j += SPAN) {
        const double tau[SPAN] = {(j - centre) * per, (j + 1 - centre) * per, (j + 2 - centre) * per, (j + 3 - centre) * per};
        sound_some(g, carrier, sums + j, tau, SPAN, terms);
    }
    for (; j < block; j++)
        sound_some(g, carrier, sums + j, &(double){(j - centre) * per}, 1, terms);
}

LANES_CLONES
static void sound_1(const struct launch_cluster *g, double (*sums)[LANES], int block)
{
    sound(g, sums, block, 1);
}

LANES_CLONES
static void sound_5(const struct launch_cluster *g, double (*sums)[LANES], int block)
{
    sound(g, sums, block, 5);
}

LANES_CLONES
static void sound_7(const struct launch_cluster *g, double (*sums)[LANES], int block)
{
    sound(g, sums, block, 7);
}

void launch_cluster_sound(const struct launch_cluster *g, double (*sums)[LANES], int block)
{
    int terms = terms_of(g);
    (terms == 1 ? sound_1 : terms == 5 ? sound_5 : sound_7)(g, sums, block);
}
