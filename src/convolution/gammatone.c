/* Gammatones, by which Hermes (1998, in papers/002 section II-B) models the impacts of what rolls: "the sharp onset of
   a conventional impact model ... is replaced by a more gradual onset", s(t) = sum a_i t^(gamma-1) e^(-t/tau_i) sin(2
   pi f_i t), gamma = 2. Here gamma is a key of a response, and a mode that rings as Im(A e^(s t)), s = -1/tau + j 2 pi
   f, rings as

     h(t) = (t/t_p)^(gamma-1) e^((gamma-1) - t/tau) |A| sin(2 pi f t + arg A),   t_p = (gamma-1) tau
          = Im(A c t^(gamma-1) e^(s t)),                                         c = (e / ((gamma-1) tau))^(gamma-1)

   so that the envelope's greatest value, at t_p, is |A|: what gamma = 1 begins with. The paper's a_i is |A| c.

   It is a response, not a force, and it is the sound's: where output.quantity or a radiator turns what the modes hold
   into something else, A is what it is turned into, and then gets its envelope (the derivative of a gammatone, or what
   its radiator makes of it, would differ by a share of (gamma-1)/(2 pi f t)). It begins from nothing: there is no jump
   at t = 0, hence no direct term of an acceleration and no component of a monopole's own, which are there to make up
   for one. A mode of several slopes is one gammatone for each. An undamped mode has no t_p and is refused.

   How it is computed. Where poles move, t^(gamma-1) is common to all modes, and multiplies the computed responses.
   Where they stay, by a bank. With p = e^(s/rate) and z_k(n) = sum over m <= n of (n-m)^k p^(n-m) A(m) f(m) /
   rate^gamma,

       z_k(n) = p sum over j = 0 .. k of C(k, j) z_j(n-1)        + A(n) f(n) / rate^gamma for k = 0
       y(n)   = sum over modes of Im z_(gamma-1)(n)

   for (n-m)^k = ((n-1-m) + 1)^k: a chain of gamma equal poles, the binomial coefficients between them, exact to
   rounding (z_k grows by what it is made of, and nothing cancels). A goes in with the force, so that gains may change
   their sign and move as they like. There is no jump at n = m, hence no half of it, and no direct term.

   Ramps, silence and order of sums are those of resonators.c. */
#include "convolution/gammatone.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/scaled.h"

#define INLINE static inline __attribute__((always_inline))

#define EULER 2.71828182845904523536
#define NEPER 8.685889638065036554 /* dB */

void gammatone_gains(int gamma, int n, const double *decay, const struct modes_point *p)
{
    if (gamma <= 1) return;
    for (int i = 0; i < n; i++) {
        double c = EULER * decay[i] / (gamma - 1), all = c;
        for (int k = 2; k < gamma; k++)
            all *= c;
        p->re[i] *= all;
        p->im[i] *= all;
    }
}

void gammatone_sample(int gamma, double rate, struct ir_sampler *s, int quantity, const struct modes_point *p,
                      double *h, size_t length)
{
    ir_sample(s, quantity, p, h, length); /* h[0], where jump and direct term are, is multiplied by 0 */
    for (size_t i = 0; gamma > 1 && i < length; i++) {
        double t = (double)i / rate;
        for (int k = 1; k < gamma; k++)
            h[i] *= t;
    }
}

/* Of x = t/tau. */
static double fallen(int gamma, double x)
{
    double m = gamma - 1;
    return NEPER * (x - m - m * real_log(x / m));
}

double gammatone_fallen(int gamma, double decibel) { return gamma > 1 ? fallen(gamma, decibel / NEPER) : decibel; }

double gammatone_decibel(int gamma, double decibel)
{
    double m = gamma - 1, x = decibel / NEPER + m;
    if (gamma <= 1) return decibel;
    for (int i = 0; i < 100; i++) /* x = d + m + m log(x/m): a contraction above m, from below */
        x = decibel / NEPER + m + m * real_log(x / m);
    return NEPER * x;
}

double gammatone_cost(int gamma)
{
    static const double cost[GAMMATONE_MOST] = {1, 1.8, 2.5, 3.5}; /* tests/bench/gammatones.c */
    return cost[gamma <= 1 ? 0 : gamma - 1];
}

/* ------------------------------------------------------------------ the bank */

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

struct gammatone_bank {
    int n, gamma, groups, n_active;
    double scale; /* 1 / rate^gamma */
    struct group *group, **active;
    double (*sums)[LANES];
};

struct gammatone_bank *gammatone_bank_make(struct arena *a, const struct gammatone_bank_ask *ask)
{
    struct gammatone_bank *g = ARENA_TAKE(a, struct gammatone_bank, 1);
    *g = (struct gammatone_bank){.n = ask->n, .gamma = ask->gamma, .groups = (ask->n + LANES - 1) / LANES, .scale = 1};
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

static void set_targets(struct gammatone_bank *g, const struct modes_point *to)
{
    for (int i = 0; i < g->n; i++) {
        g->group[i / LANES].tr[i % LANES] = to->re[i] * g->scale;
        g->group[i / LANES].ti[i % LANES] = to->im[i] * g->scale;
    }
}

static void set_steps(struct gammatone_bank *g, int frames)
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

static void arrive(struct gammatone_bank *g)
{
    for (int k = 0; k < g->groups; k++) {
        memcpy(g->group[k].gr, g->group[k].tr, sizeof g->group[k].gr);
        memcpy(g->group[k].gi, g->group[k].ti, sizeof g->group[k].gi);
    }
}

void gammatone_bank_set(struct gammatone_bank *g, const struct modes_point *at)
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
        double re = fma(3, v->cr + v->br, v->dr + v->ar), im = fma(3, v->ci + v->bi, v->di + v->ai);
        v->dr = fma(v->pr, re, -(v->pi * im));
        v->di = fma(v->pr, im, v->pi * re);
    }
    if (gamma > 2) {
        double re = fma(2, v->br, v->cr + v->ar), im = fma(2, v->bi, v->ci + v->ai);
        v->cr = fma(v->pr, re, -(v->pi * im));
        v->ci = fma(v->pr, im, v->pi * re);
    }
    double br = v->br + v->ar, bi = v->bi + v->ai, ar = v->ar;
    v->br = fma(v->pr, br, -(v->pi * bi));
    v->bi = fma(v->pr, bi, v->pi * br);
    v->ar = fma(v->pr, ar, fma(-v->pi, v->ai, v->gr * f));
    v->ai = fma(v->pr, v->ai, fma(v->pi, ar, v->gi * f));
    return gamma > 3 ? v->di : gamma > 2 ? v->ci : v->bi;
}

INLINE struct lane lane_take(const struct group *g, int l, int gamma)
{
    struct lane v = {.ar = g->zr[0][l],
                     .ai = g->zi[0][l],
                     .br = g->zr[1][l],
                     .bi = g->zi[1][l],
                     .gr = g->gr[l],
                     .gi = g->gi[l],
                     .sr = g->sr[l],
                     .si = g->si[l],
                     .pr = g->pr[l],
                     .pi = g->pi[l]};
    if (gamma > 2) v.cr = g->zr[2][l], v.ci = g->zi[2][l];
    if (gamma > 3) v.dr = g->zr[3][l], v.di = g->zi[3][l];
    return v;
}

INLINE void lane_store(struct group *g, int l, const struct lane *v, int gamma)
{
    g->zr[0][l] = v->ar, g->zi[0][l] = v->ai;
    g->zr[1][l] = v->br, g->zi[1][l] = v->bi;
    if (gamma > 2) g->zr[2][l] = v->cr, g->zi[2][l] = v->ci;
    if (gamma > 3) g->zr[3][l] = v->dr, g->zi[3][l] = v->di;
    g->gr[l] = v->gr, g->gi[l] = v->gi;
}

/* Adds the lanes' Im z of `n` samples to sums[n][LANES]. */
INLINE void ring_group(struct group *restrict g, const double *restrict f, double (*restrict sums)[LANES], int n,
                       int gamma)
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
            lane_store(g, l, &v, gamma);
        }
    }
    for (; i < n; i++) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            struct lane v = lane_take(g, l, gamma);
            sums[i][l] += lane_step(&v, f[i], gamma);
            lane_store(g, l, &v, gamma);
        }
    }
}

LANES_CLONES
static void ring_2(struct group *g, const double *f, double (*sums)[LANES], int n) { ring_group(g, f, sums, n, 2); }

LANES_CLONES
static void ring_3(struct group *g, const double *f, double (*sums)[LANES], int n) { ring_group(g, f, sums, n, 3); }

LANES_CLONES
static void ring_4(struct group *g, const double *f, double (*sums)[LANES], int n) { ring_group(g, f, sums, n, 4); }

/* A group takes part when it rings, or when there is force and a gain to launch it. */
static void find_active(struct gammatone_bank *g, bool force)
{
    g->n_active = 0;
    for (int k = 0; k < g->groups; k++) {
        struct group *v = &g->group[k];
        bool deaf = scaled_is_zero(v->gr, LANES) && scaled_is_zero(v->gi, LANES) && scaled_is_zero(v->tr, LANES) &&
                    scaled_is_zero(v->ti, LANES);
        if (v->awake || (force && !deaf)) g->active[g->n_active++] = v;
    }
}

static void flush(struct gammatone_bank *g)
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

void gammatone_bank_run(struct gammatone_bank *g, const double *f, double *y, int frames, const struct modes_point *to)
{
    static void (*const ring[GAMMATONE_MOST + 1])(struct group *, const double *, double(*)[LANES],
                                                  int) = {NULL, NULL, ring_2, ring_3, ring_4};
    if (frames < 1) return;
    set_targets(g, to);
    set_steps(g, frames);
    find_active(g, !scaled_is_zero(f, frames));
    for (int done = 0; done < frames && g->n_active;) {
        int n = frames - done < PIECE ? frames - done : PIECE;
        memset(g->sums, 0, (size_t)n * sizeof *g->sums);
        for (int k = 0; k < g->n_active; k++)
            ring[g->gamma](g->active[k], f + done, g->sums, n);
        for (int i = 0; i < n; i++) {
            const double *s = g->sums[i];
            y[done + i] += lanes_total(s);
        }
        done += n;
    }
    arrive(g);
    flush(g);
}

int gammatone_bank_silent(const struct gammatone_bank *g)
{
    for (int k = 0; k < g->groups; k++)
        if (g->group[k].awake) return 0;
    return 1;
}
