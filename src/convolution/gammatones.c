/* A bank of gammatones driven by a force whose place moves: with p = e^(s/rate) and z_k(n) = sum over m <= n of (n-m)^k p^(n-m) A(m) f(m) / rate^gamma,

       z_k(n) = p sum over j = 0 .. k of C(k, j) z_j(n-1)        + A(n) f(n) / rate^gamma for k = 0
       y(n)   = sum over modes of Im z_(gamma-1)(n)

   for (n-m)^k = ((n-1-m) + 1)^k: a chain of gamma equal poles, the binomial coefficients between them, exact to rounding (z_k grows by what it is made
   of, and nothing cancels). A goes in with the force, so that gains may change their sign and move as they like. There is no jump at n = m, hence no half
   of it, and no direct term.

   Ramps, silence and order of sums are those of resonators.c. */
#include "convolution/gammatones.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/gammatone.h"
#include "convolution/product.h"
#include "num/lanes.h"
#include "num/real.h"

#define INLINE static inline __attribute__((always_inline))

enum { SPAN = 4, PIECE = 128 }; /* samples per visit to a group; frames whose lane sums are kept at a time */

struct group {
    _Alignas(64) double zr[GAMMATONE_MOST][LANES];
    double zi[GAMMATONE_MOST][LANES];
    double pr[LANES], pi[LANES];
    double gr[LANES], gi[LANES]; /* gains / rate^gamma     */
    double sr[LANES], si[LANES]; /* their steps per sample */
    double tr[LANES], ti[LANES]; /* their targets          */
    int awake;                   /* a state is not zero    */
};

struct gammatones {
    int n, gamma, groups, n_active;
    double scale;                /* 1 / rate^gamma */
    struct group *group, **active;
    double (*sums)[LANES];
};

struct gammatones *gammatones_make(struct arena *a, const struct gammatones_ask *ask)
{
    struct gammatones *g = ARENA_TAKE(a, struct gammatones, 1);
    *g = (struct gammatones){.n = ask->n, .gamma = ask->gamma, .groups = (ask->n + LANES - 1) / LANES, .scale = 1};
    for (int k = 0; k < ask->gamma; k++)
        g->scale /= ask->rate;
    g->group = ARENA_TAKE(a, struct group, g->groups + 1);
    g->active = ARENA_TAKE(a, struct group *, g->groups + 1);
    g->sums = arena_take(a, PIECE, sizeof *g->sums);
    for (int i = 0; i < g->n; i++) {
        struct group *to = &g->group[i / LANES];
        double size = real_exp(-ask->decay[i] / ask->rate), turn = 2.0 * ask->frequency[i] / ask->rate;
        to->pr[i % LANES] = size * real_cospi(turn);
        to->pi[i % LANES] = size * real_sinpi(turn);
    }
    return g;
}

static void set_targets(struct gammatones *g, const struct modes_point *to)
{
    for (int i = 0; i < g->n; i++) {
        g->group[i / LANES].tr[i % LANES] = to->re[i] * g->scale;
        g->group[i / LANES].ti[i % LANES] = to->im[i] * g->scale;
    }
}

static void set_steps(struct gammatones *g, int frames)
{
    double share = 1.0 / frames;
    for (int k = 0; k < g->groups; k++) {
        struct group *v = &g->group[k];
        for (int l = 0; l < LANES; l++) {
            v->sr[l] = (v->tr[l] - v->gr[l]) * share;
            v->si[l] = (v->ti[l] - v->gi[l]) * share;
        }
    }
}

static void arrive(struct gammatones *g)
{
    for (int k = 0; k < g->groups; k++) {
        memcpy(g->group[k].gr, g->group[k].tr, sizeof g->group[k].gr);
        memcpy(g->group[k].gi, g->group[k].ti, sizeof g->group[k].gi);
    }
}

void gammatones_set(struct gammatones *g, const struct modes_point *at)
{
    set_targets(g, at);
    arrive(g);
}

/* What changes of one mode in a sample, and how; z_0 to z_3 are called a to d. */
struct lane {
    double ar, ai, br, bi, cr, ci, dr, di, gr, gi, sr, si, pr, pi;
};

/* From the last link of the chain to the first, each from what the others were. */
INLINE double lane_step(struct lane *v, double f, int gamma)
{
    v->gr += v->sr;
    v->gi += v->si;
    if (gamma > 3) {
        double re = v->dr + 3 * (v->cr + v->br) + v->ar, im = v->di + 3 * (v->ci + v->bi) + v->ai;
        v->dr = v->pr * re - v->pi * im;
        v->di = v->pr * im + v->pi * re;
    }
    if (gamma > 2) {
        double re = v->cr + 2 * v->br + v->ar, im = v->ci + 2 * v->bi + v->ai;
        v->cr = v->pr * re - v->pi * im;
        v->ci = v->pr * im + v->pi * re;
    }
    double br = v->br + v->ar, bi = v->bi + v->ai, ar = v->ar;
    v->br = v->pr * br - v->pi * bi;
    v->bi = v->pr * bi + v->pi * br;
    v->ar = v->pr * ar - (v->pi * v->ai - v->gr * f);
    v->ai = v->pr * v->ai + (v->pi * ar + v->gi * f);
    return gamma > 3 ? v->di : gamma > 2 ? v->ci : v->bi;
}

INLINE struct lane lane_take(const struct group *g, int l, int gamma)
{
    struct lane v = {.ar = g->zr[0][l], .ai = g->zi[0][l], .br = g->zr[1][l], .bi = g->zi[1][l], .gr = g->gr[l], .gi = g->gi[l], .sr = g->sr[l], .si = g->si[l],
                     .pr = g->pr[l], .pi = g->pi[l]};
    if (gamma > 2)
        v.cr = g->zr[2][l], v.ci = g->zi[2][l];
    if (gamma > 3)
        v.dr = g->zr[3][l], v.di = g->zi[3][l];
    return v;
}

INLINE void lane_keep(struct group *g, int l, const struct lane *v, int gamma)
{
    g->zr[0][l] = v->ar, g->zi[0][l] = v->ai;
    g->zr[1][l] = v->br, g->zi[1][l] = v->bi;
    if (gamma > 2)
        g->zr[2][l] = v->cr, g->zi[2][l] = v->ci;
    if (gamma > 3)
        g->zr[3][l] = v->dr, g->zi[3][l] = v->di;
    g->gr[l] = v->gr, g->gi[l] = v->gi;
}

/* Adds the lanes' Im z of `n` samples to sums[n][LANES]. */
INLINE void ring_group(struct group *restrict g, const double *restrict f, double (*restrict sums)[LANES], int n, int gamma)
{
    int i = 0;
    for (; i + SPAN <= n; i += SPAN) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            struct lane v = lane_take(g, l, gamma);
            sums[i][l] += lane_step(&v, f[i], gamma);
            sums[i + 1][l] += lane_step(&v, f[i + 1], gamma);
            sums[i + 2][l] += lane_step(&v, f[i + 2], gamma);
            sums[i + 3][l] += lane_step(&v, f[i + 3], gamma);
            lane_keep(g, l, &v, gamma);
        }
    }
    for (; i < n; i++) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            struct lane v = lane_take(g, l, gamma);
            sums[i][l] += lane_step(&v, f[i], gamma);
            lane_keep(g, l, &v, gamma);
        }
    }
}

LANES_CLONES
static void ring_2(struct group *g, const double *f, double (*sums)[LANES], int n)
{
    ring_group(g, f, sums, n, 2);
}

LANES_CLONES
static void ring_3(struct group *g, const double *f, double (*sums)[LANES], int n)
{
    ring_group(g, f, sums, n, 3);
}

LANES_CLONES
static void ring_4(struct group *g, const double *f, double (*sums)[LANES], int n)
{
    ring_group(g, f, sums, n, 4);
}

/* A group takes part when it rings, or when there is force and a gain to launch it. */
static void find_active(struct gammatones *g, bool force)
{
    g->n_active = 0;
    for (int k = 0; k < g->groups; k++) {
        struct group *v = &g->group[k];
        bool deaf = product_nothing(v->gr, LANES) && product_nothing(v->gi, LANES) && product_nothing(v->tr, LANES) && product_nothing(v->ti, LANES);
        if (v->awake || (force && !deaf))
            g->active[g->n_active++] = v;
    }
}

static void flush(struct gammatones *g)
{
    for (int k = 0; k < g->n_active; k++) {
        struct group *v = g->active[k];
        v->awake = 0;
        for (int l = 0; l < LANES; l++) {
            double most = 0;
            for (int j = 0; j < g->gamma; j++)
                most = fmax(most, fmax(fabs(v->zr[j][l]), fabs(v->zi[j][l])));
            for (int j = 0; j < g->gamma && most < 1e-200; j++)
                v->zr[j][l] = v->zi[j][l] = 0;
            v->awake |= most >= 1e-200;
        }
    }
}

void gammatones_run(struct gammatones *g, const double *f, double *y, int frames, const struct modes_point *to)
{
    static void (*const ring[GAMMATONE_MOST + 1])(struct group *, const double *, double (*)[LANES], int) = {NULL, NULL, ring_2, ring_3, ring_4};
    if (frames < 1)
        return;
    set_targets(g, to);
    set_steps(g, frames);
    find_active(g, !product_nothing(f, frames));
    for (int done = 0; done < frames && g->n_active;) {
        int n = frames - done < PIECE ? frames - done : PIECE;
        memset(g->sums, 0, (size_t)n * sizeof *g->sums);
        for (int k = 0; k < g->n_active; k++)
            ring[g->gamma](g->active[k], f + done, g->sums, n);
        for (int i = 0; i < n; i++) {
            const double *s = g->sums[i];
            y[done + i] += ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
        }
        done += n;
    }
    arrive(g);
    flush(g);
}

int gammatones_silent(const struct gammatones *g)
{
    for (int k = 0; k < g->groups; k++)
        if (g->group[k].awake)
            return 0;
    return 1;
}
