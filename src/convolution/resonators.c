/* A bank of modes driven by a force whose place moves: the exact realisation of papers/000 eq. 10 and 13 when the object's poles do
   not depend on the place and every force sample is launched with the gain of its own place (`fixed` in rasp-scene(5)).

   Mode i rings as h_i(t) = Im(A_i e^(s_i t)), A_i = gain e^(j phase), s_i = -decay + j 2 pi f. With p_i = e^(s_i/rate),

       z_i <- p_i z_i + A_i(n) f(n) / rate
       y(n) = sum_i Im z_i - f(n) sum_i Im A_i(n) / (2 rate) + f(n) D(n)

   which is y(n) = (1/rate) sum_{m <= n} h_{x(m)}((n-m)/rate) f(m) with half of h(0+) at m = n (trapezium rule at the jump), to
   rounding. D = sum_i Im(A_i/s_i) is the direct term of a table in acceleration and 0 otherwise (modes_direct).

   symbol  meaning                               unit
   A       complex gain at the contact           table's quantity per N s
   f       force                                 N
   z       state of a mode                       table's quantity
   y       sound                                 table's quantity

   Gains. In a call of n frames, sample i (0 .. n-1) uses last + (i+1) (new - last)/n, summed up step by step; after the call the
   gain is `new` exactly. Against gains evaluated at every sample the error is of order n^2. A call whose gains do not change runs
   through the same arithmetic, so that then the output does not depend on how the frames are cut into calls.
   Stability: |z| never grows by more than |A f|/rate, whatever the gains do (|p| < 1; |p| = 1 for a mode without decay).
   Silence: after each call, states of less than 1e-200 in both parts become zero, and a group of eight modes that are zero and get
   no force costs nothing; nothing becomes subnormal on the way unless a mode falls by 1e-107 within one call.

   Speed: eight modes are the lanes of a group (6 multiplications and 7 additions per mode-sample, which is what bounds it), four
   samples are done before a group's state goes back to memory; tests/bench/resonators.c measures it. Sums run over the groups in
   order and then over the lanes in one fixed tree, so the bits are the same on every instruction set. */
#include "convolution/resonators.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"

enum { SPAN = 4, PIECE_MIN = 64, PIECE_MAX = 256 }; /* samples per visit to a group; frames whose lane sums are kept at a time */

struct group {
    _Alignas(64) double zr[LANES];
    double zi[LANES], pr[LANES], pi[LANES];
    double gr[LANES], gi[LANES]; /* gains / rate                          */
    double tr[LANES], ti[LANES]; /* their targets                         */
    double sr[LANES], si[LANES]; /* their steps per sample                */
    int awake;                   /* a state is not zero                   */
};

struct resonators {
    const struct modes *modes;
    int groups, n_active, piece;
    double per_rate;
    double through, through_target, through_step; /* y(n) gets through * f(n) */
    struct group *group, **active;
    double (*sums)[LANES];
};

struct resonators *resonators_make(struct arena *a, const struct modes *m, double rate, int ramp)
{
    struct resonators *r = ARENA_TAKE(a, struct resonators, 1);
    r->modes = m;
    r->groups = (m->n + LANES - 1) / LANES;
    r->per_rate = 1.0 / rate;
    r->group = ARENA_TAKE(a, struct group, r->groups + 1);
    r->active = ARENA_TAKE(a, struct group *, r->groups + 1);
    r->piece = ramp < PIECE_MIN ? PIECE_MIN : ramp < PIECE_MAX ? ramp : PIECE_MAX;
    r->sums = arena_take(a, (size_t)r->piece, sizeof *r->sums);
    for (int i = 0; i < m->n; i++) {
        struct group *g = &r->group[i / LANES];
        double size = real_exp(-m->decay[i] / rate), turn = 2.0 * m->frequency[i] / rate;
        g->pr[i % LANES] = size * real_cospi(turn);
        g->pi[i % LANES] = size * real_sinpi(turn);
    }
    return r;
}

/* The order of every sum over lanes. */
static double lanes_sum(const double *s)
{
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

static void set_targets(struct resonators *r, const double *gain_re, const double *gain_im)
{
    double half[LANES] = {0};
    int n = r->modes->n;
    for (int k = 0; k < r->groups; k++) {
        struct group *g = &r->group[k];
        int used = n - k * LANES < LANES ? n - k * LANES : LANES;
        for (int l = 0; l < used; l++) {
            g->tr[l] = gain_re[k * LANES + l] * r->per_rate;
            g->ti[l] = gain_im[k * LANES + l] * r->per_rate;
            half[l] += 0.5 * g->ti[l];
        }
    }
    r->through_target = modes_direct(r->modes, gain_re, gain_im) - lanes_sum(half);
}

static void set_steps(struct resonators *r, int frames)
{
    double share = 1.0 / frames;
    for (int k = 0; k < r->groups; k++) {
        struct group *g = &r->group[k];
        for (int l = 0; l < LANES; l++) {
            g->sr[l] = (g->tr[l] - g->gr[l]) * share;
            g->si[l] = (g->ti[l] - g->gi[l]) * share;
        }
    }
    r->through_step = (r->through_target - r->through) * share;
}

static void arrive(struct resonators *r)
{
    for (int k = 0; k < r->groups; k++) {
        struct group *g = &r->group[k];
        memcpy(g->gr, g->tr, sizeof g->gr);
        memcpy(g->gi, g->ti, sizeof g->gi);
    }
    r->through = r->through_target;
}

void resonators_set_gains(struct resonators *r, const double *gain_re, const double *gain_im)
{
    set_targets(r, gain_re, gain_im);
    arrive(r);
}

/* One sample of one mode, state in v: zr zi gr gi. */
struct lane {
    double zr, zi, gr, gi, pr, pi, sr, si;
};

static inline __attribute__((always_inline)) double lane_step(struct lane *v, double f)
{
    v->gr += v->sr;
    v->gi += v->si;
    double zr = v->pr * v->zr - (v->pi * v->zi - v->gr * f);
    v->zi = v->pr * v->zi + (v->pi * v->zr + v->gi * f);
    v->zr = zr;
    return v->zi;
}

static inline __attribute__((always_inline)) struct lane lane_take(const struct group *g, int l)
{
    return (struct lane){g->zr[l], g->zi[l], g->gr[l], g->gi[l], g->pr[l], g->pi[l], g->sr[l], g->si[l]};
}

static inline __attribute__((always_inline)) void lane_keep(struct group *g, int l, const struct lane *v)
{
    g->zr[l] = v->zr;
    g->zi[l] = v->zi;
    g->gr[l] = v->gr;
    g->gi[l] = v->gi;
}

/* Adds the lanes' Im z of `n` samples to sums[n][LANES]. */
LANES_CLONES
static void ring(struct group *const *active, int n_active, const double *restrict f, double (*restrict sums)[LANES], int n)
{
    int i = 0;
    for (; i + SPAN <= n; i += SPAN)
        for (int k = 0; k < n_active; k++) {
            struct group *restrict g = active[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                struct lane v = lane_take(g, l);
                sums[i][l] += lane_step(&v, f[i]);
                sums[i + 1][l] += lane_step(&v, f[i + 1]);
                sums[i + 2][l] += lane_step(&v, f[i + 2]);
                sums[i + 3][l] += lane_step(&v, f[i + 3]);
                lane_keep(g, l, &v);
            }
        }
    for (; i < n; i++)
        for (int k = 0; k < n_active; k++) {
            struct group *restrict g = active[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                struct lane v = lane_take(g, l);
                sums[i][l] += lane_step(&v, f[i]);
                lane_keep(g, l, &v);
            }
        }
}

static bool all_zero(const double *x, int n)
{
    for (int i = 0; i < n; i++)
        if (x[i] != 0.0)
            return false;
    return true;
}

/* A group takes part when it rings, or when there is force and a gain to launch it. */
static void find_active(struct resonators *r, bool force)
{
    r->n_active = 0;
    for (int k = 0; k < r->groups; k++) {
        struct group *g = &r->group[k];
        bool deaf = all_zero(g->gr, LANES) && all_zero(g->gi, LANES) && all_zero(g->tr, LANES) && all_zero(g->ti, LANES);
        if (g->awake || (force && !deaf))
            r->active[r->n_active++] = g;
    }
}

static void flush(struct resonators *r)
{
    const double least = 1e-200;
    for (int k = 0; k < r->n_active; k++) {
        struct group *g = r->active[k];
        g->awake = 0;
        for (int l = 0; l < LANES; l++)
            if (fabs(g->zr[l]) < least && fabs(g->zi[l]) < least)
                g->zr[l] = g->zi[l] = 0.0;
            else
                g->awake = 1;
    }
}

void resonators_run(struct resonators *r, const double *f, double *y, int frames, const double *gain_re, const double *gain_im)
{
    if (frames < 1)
        return;
    set_targets(r, gain_re, gain_im);
    set_steps(r, frames);
    find_active(r, !all_zero(f, frames));
    for (int done = 0; done < frames && r->n_active;) {
        int n = frames - done < r->piece ? frames - done : r->piece;
        memset(r->sums, 0, (size_t)n * sizeof *r->sums);
        ring(r->active, r->n_active, f + done, r->sums, n);
        for (int i = 0; i < n; i++) {
            r->through += r->through_step;
            y[done + i] += lanes_sum(r->sums[i]) + r->through * f[done + i];
        }
        done += n;
    }
    arrive(r);
    flush(r);
}

int resonators_silent(const struct resonators *r)
{
    for (int k = 0; k < r->groups; k++)
        if (r->group[k].awake)
            return 0;
    return 1;
}
