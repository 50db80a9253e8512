/* A bank of modes driven by a force whose place moves: one exact recursion per mode (modified convolution,
   papers/000 eq. 10, eq. 13).

   Mode i rings as h_i(t) = Im(A_i e^(s_i t)), A_i = gain e^(j phase), s_i = -decay + j 2 pi f. With p_i = e^(s_i/rate),

       z_i(n) = p_i(n) z_i(n-1) + A_i(n) f(n) / rate
       y(n) = sum_i Im z_i(n) - f(n) sum_i Im A_i(n) / (2 rate) + f(n) D(n)

   Poles that do not move (`fixed` of rasp-scene(5)): y(n) = (1/rate) sum_{m <= n} h_{x(m)}((n-m)/rate) f(m) with half
   of h(0+) at m = n (trapezium rule at the jump), to rounding. Poles that do (`glide`): the recursion is the
   definition, with p and A of the place x(n). D = sum_i Im(A_i/s_i) is the direct term of a table in acceleration and 0
   otherwise (modes_direct).

   symbol  meaning                               unit
   A       complex gain at the contact           table's quantity per N s
   f       force                                 N
   z       state of a mode                       table's quantity
   y       sound                                 table's quantity

   Between evaluations. In a call of n frames, sample i (0 .. n-1) uses last + (i+1) (new - last)/n, for gains and for
   discrete poles, summed up step by step; after the call both are `new` exactly. Against gains and poles of every
   sample the error is of order n^2. A chord of the unit circle lies inside it: a pole whose angle changes by dtheta
   within a call is damped by dtheta^2 (1 - 1/n^2)/12 nepers per sample more, and by nothing when poles are given for
   every sample (n = 1). A call in which nothing changes runs through the same arithmetic, so that then the output does
   not depend on how the frames are cut into calls. Stability: |z| never grows by more than |A f|/rate, whatever gains
   and poles do, for a chord of the unit disk stays in it (|p| < 1; |p| = 1 for a mode without decay). A direct-form
   biquad under the same modulation blows up (tests/unit/test_glide.c). Silence: after 256 frames without force, states
   become zero that have fallen in both parts below 1e-22 (-440 dB) of the loudest state there was, which is below the
   rounding of any sound that has not itself fallen by as much; after a call with force those below 1e-200. A group of
   eight modes that are zero and get no force costs nothing. Nothing becomes subnormal on the way unless a mode falls
   by 1e-107 within one call.

   Speed: eight modes are the lanes of a group (6 multiplications and 7 additions per mode-sample, which is what bounds
   it; poles that move take 2 additions more, gains that stand still 2 less), four samples are done before a group's
   state goes back to memory; tests/bench/resonators.c measures it. Sums run over the groups in order and then over the
   lanes in one fixed tree, so the bits are the same on every instruction set. */
#include "convolution/resonators.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/scaled.h"
#include "num/vecmath.h"

enum {
    PIECE_MIN = 64,
    PIECE_MAX = 256,
    WATCH = 256
}; /* frames whose lane sums are kept at a time; from one look at what has died away to the next */

struct resonators {
    int n, quantity, groups, n_active, piece;
    int watched;                                  /* frames since the last look at what has died away */
    bool glides, steady, forced;                  /* steady: no gain changes in this call; forced: since that look */
    bool posed, bends;                            /* poles have been given; they change in this call */
    double rate, per_rate, loudest;               /* loudest: greatest part of a state at any look */
    double through, through_target, through_step; /* y(n) gets through * f(n) */
    const double *frequency, *decay;              /* [n] of the start         */
    double *last_frequency, *last_decay;          /* [n] of the poles that were given last */
    double *size, *turn, *rise;                   /* [n] room for the evaluation of poles */
    struct resonator_group *group, **active;
    double (*sums)[LANES]; /* [piece] */
};

static const double *copy(struct arena *a, const double *x, int n)
{
    double *own = ARENA_TAKE(a, double, n + 1);
    for (int i = 0; i < n; i++)
        own[i] = x[i];
    return own;
}

struct resonators *resonators_make(struct arena *a, const struct resonators_ask *ask)
{
    struct resonators *r = ARENA_TAKE(a, struct resonators, 1);
    *r = (struct resonators){
        .n = ask->n, .quantity = ask->quantity, .glides = ask->glides, .rate = ask->rate, .per_rate = 1.0 / ask->rate};
    r->groups = (r->n + LANES - 1) / LANES;
    r->group = ARENA_TAKE(a, struct resonator_group, r->groups + 1);
    r->active = ARENA_TAKE(a, struct resonator_group *, r->groups + 1);
    r->piece = ask->ramp < PIECE_MIN ? PIECE_MIN : ask->ramp < PIECE_MAX ? ask->ramp : PIECE_MAX;
    r->sums = arena_take(a, (size_t)r->piece, sizeof *r->sums);
    r->frequency = copy(a, ask->frequency, r->n);
    r->decay = copy(a, ask->decay, r->n);
    r->last_frequency = ARENA_TAKE(a, double, r->n + 1);
    r->last_decay = ARENA_TAKE(a, double, r->n + 1);
    r->size = ARENA_TAKE(a, double, r->n + 1);
    r->turn = ARENA_TAKE(a, double, r->n + 1);
    r->rise = ARENA_TAKE(a, double, r->n + 1);
    for (int i = 0; i < r->n; i++) {
        struct resonator_group *g = &r->group[i / LANES];
        double size = real_exp(-ask->decay[i] / ask->rate), turn = 2.0 * ask->frequency[i] / ask->rate;
        g->pr[i % LANES] = size * real_cospi(turn);
        g->pi[i % LANES] = size * real_sinpi(turn);
    }
    return r;
}

/* Targets of poles that move: e^(-decay/rate) e^(j 2 pi f/rate). Those that are where they were need not be found
 * again, and the call is one of gains alone: its bits are the same. */
static void set_poles(struct resonators *r, const struct modes_point *to)
{
    size_t n = (size_t)r->n, bytes = n * sizeof *to->frequency;
    r->bends = n > 0 && !(r->posed && !memcmp(r->last_frequency, to->frequency, bytes) &&
                          !memcmp(r->last_decay, to->decay, bytes));
    if (!r->bends) return;
    memcpy(r->last_frequency, to->frequency, bytes);
    memcpy(r->last_decay, to->decay, bytes);
    r->posed = true;
    for (size_t i = 0; i < n; i++) {
        r->size[i] = -to->decay[i] / r->rate;
        r->turn[i] = 2.0 * to->frequency[i] / r->rate;
    }
    vecmath_exp(n, r->size, r->size);
    vecmath_sincospi(n, r->turn, r->rise, r->turn);
    for (size_t i = 0; i < n; i++) {
        struct resonator_group *g = &r->group[i / LANES];
        g->ptr[i % LANES] = r->size[i] * r->turn[i];
        g->pti[i % LANES] = r->size[i] * r->rise[i];
    }
}

static void set_targets(struct resonators *r, const struct modes_point *to)
{
    double half[LANES] = {0};
    for (int k = 0; k < r->groups; k++) {
        struct resonator_group *g = &r->group[k];
        int used = r->n - k * LANES < LANES ? r->n - k * LANES : LANES;
        for (int l = 0; l < used; l++) {
            g->tr[l] = to->re[k * LANES + l] * r->per_rate;
            g->ti[l] = to->im[k * LANES + l] * r->per_rate;
            half[l] += 0.5 * g->ti[l];
        }
    }
    if (r->glides) set_poles(r, to);
    r->through_target = -lanes_total(half);
    if (r->n)
        r->through_target += modes_direct(r->quantity, r->n, r->glides ? to->frequency : r->frequency,
                                          r->glides ? to->decay : r->decay, to);
}

static void set_steps(struct resonators *r, int frames)
{
    double share = 1.0 / frames;
    r->steady = true;
    for (int k = 0; k < r->groups; k++) {
        struct resonator_group *g = &r->group[k];
        r->steady = r->steady && !memcmp(g->gr, g->tr, sizeof g->gr) && !memcmp(g->gi, g->ti, sizeof g->gi);
        for (int l = 0; l < LANES; l++) {
            g->sr[l] = (g->tr[l] - g->gr[l]) * share;
            g->si[l] = (g->ti[l] - g->gi[l]) * share;
        }
        for (int l = 0; l < LANES && r->bends; l++) {
            g->psr[l] = (g->ptr[l] - g->pr[l]) * share;
            g->psi[l] = (g->pti[l] - g->pi[l]) * share;
        }
    }
    r->through_step = (r->through_target - r->through) * share;
}

static void arrive(struct resonators *r)
{
    for (int k = 0; k < r->groups; k++) {
        struct resonator_group *g = &r->group[k];
        memcpy(g->gr, g->tr, sizeof g->gr);
        memcpy(g->gi, g->ti, sizeof g->gi);
        if (r->bends) {
            memcpy(g->pr, g->ptr, sizeof g->pr);
            memcpy(g->pi, g->pti, sizeof g->pi);
        }
    }
    r->through = r->through_target;
}

void resonators_set(struct resonators *r, const struct modes_point *at)
{
    set_targets(r, at);
    arrive(r);
}

/* The lanes of each sample as by lanes_total, and what goes through directly; halves and quarters of all samples in
   turn, which keeps registers full. */
LANES_CLONES
static void fold(const struct resonators *r, const double *restrict f, double *restrict y, int n)
{
    double halves[PIECE_MAX][4], quarters[PIECE_MAX][2];
    double through = r->through, step = r->through_step;
    for (int i = 0; i < n; i++)
#pragma omp simd
        for (int l = 0; l < 4; l++)
            halves[i][l] = r->sums[i][l] + r->sums[i][l + 4];
    for (int i = 0; i < n; i++)
#pragma omp simd
        for (int l = 0; l < 2; l++)
            quarters[i][l] = halves[i][l] + halves[i][l + 2];
#pragma omp simd
    for (int i = 0; i < n; i++)
        y[i] += (quarters[i][0] + quarters[i][1]) + (through + (i + 1) * step) * f[i];
}

/* A group takes part when it rings, or when there is force and a gain to launch it. */
static void find_active(struct resonators *r, bool force)
{
    r->n_active = 0;
    for (int k = 0; k < r->groups; k++) {
        struct resonator_group *g = &r->group[k];
        bool deaf = scaled_is_zero(g->gr, LANES) && scaled_is_zero(g->gi, LANES) && scaled_is_zero(g->tr, LANES) &&
                    scaled_is_zero(g->ti, LANES);
        if (g->awake || (force && !deaf)) r->active[r->n_active++] = g;
    }
}

LANES_CLONES
static double loudest(const struct resonators *r)
{
    double part[LANES] = {0}, most = r->loudest;
    for (int k = 0; k < r->n_active; k++) {
        const struct resonator_group *g = r->active[k];
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double re = fabs(g->zr[l]), im = fabs(g->zi[l]);
            im = lanes_select(im > re, im, re);
            part[l] = lanes_select(im > part[l], im, part[l]);
        }
    }
    for (int l = 0; l < LANES; l++)
        most = part[l] > most ? part[l] : most;
    return most;
}

/* Measured on a plate of glass, 2 to 4 s after a motion: the recursion took 218 instructions a sample at 1e-200 for
 * all, and takes 140. */
static void flush(struct resonators *r, bool force)
{
    r->loudest = loudest(r);
    double quiet = 1e-22 * r->loudest, least = !force && quiet > 1e-200 ? quiet : 1e-200;
    for (int k = 0; k < r->n_active; k++) {
        struct resonator_group *g = r->active[k];
        g->awake = 0;
        for (int l = 0; l < LANES; l++)
            if (fabs(g->zr[l]) < least && fabs(g->zi[l]) < least)
                g->zr[l] = g->zi[l] = 0.0;
            else
                g->awake = 1;
    }
}

/* At every WATCH-th frame of all, so that it does not depend on how they are cut into calls. force: there is some in
 * this call. */
static void watch(struct resonators *r, const double *f, int n, bool force)
{
    bool forced = force && !scaled_is_zero(f, n);
    for (int k = 0; forced && k < r->n_active; k++)
        r->active[k]->awake = 1;
    r->forced = r->forced || forced;
    r->watched += n;
    if (r->watched < WATCH) return;
    flush(r, r->forced);
    r->watched = 0;
    r->forced = false;
    if (!force) find_active(r, force);
}

void resonators_run(struct resonators *r, const double *f, double *y, int frames, const struct modes_point *to)
{
    if (frames < 1) return;
    set_targets(r, to);
    set_steps(r, frames);
    enum resonator_change change = r->bends ? RESONATOR_GLIDES : r->steady ? RESONATOR_STEADY : RESONATOR_RAMPS;
    bool force = !scaled_is_zero(f, frames);
    find_active(r, force);
    for (int done = 0; done < frames;) {
        int left = frames - done, n = left < r->piece ? left : r->piece;
        n = n < WATCH - r->watched ? n : WATCH - r->watched;
        if (r->n_active) {
            memset(r->sums, 0, (size_t)n * sizeof *r->sums);
            resonators_ring(r->active, r->n_active, f + done, r->sums, n, change);
            fold(r, f + done, y + done, n);
            r->through += n * r->through_step;
        }
        watch(r, f + done, n, force);
        done += n;
    }
    arrive(r);
}

int resonators_awake(const struct resonators *r)
{
    int awake = 0;
    for (int k = 0; k < r->groups; k++)
        awake += r->group[k].awake;
    return awake;
}

int resonators_silent(const struct resonators *r) { return !resonators_awake(r); }

#define INLINE static inline __attribute__((always_inline))

enum { SPAN = 4 }; /* samples per visit to a group */

/* What changes of one mode in a sample, and how. */
struct lane {
    double zr, zi, gr, gi, pr, pi, sr, si, psr, psi;
};

INLINE double lane_step(struct lane *v, double f, enum resonator_change change)
{
    if (change != RESONATOR_STEADY) {
        v->gr += v->sr;
        v->gi += v->si;
    }
    if (change == RESONATOR_GLIDES) {
        v->pr += v->psr;
        v->pi += v->psi;
    }
    double zr = fma(v->pr, v->zr, fma(-v->pi, v->zi, v->gr * f));
    v->zi = fma(v->pr, v->zi, fma(v->pi, v->zr, v->gi * f));
    v->zr = zr;
    return v->zi;
}

INLINE struct lane lane_take(const struct resonator_group *g, int l, enum resonator_change change)
{
    struct lane v = {g->zr[l], g->zi[l], g->gr[l], g->gi[l], g->pr[l], g->pi[l], g->sr[l], g->si[l], 0, 0};
    if (change == RESONATOR_GLIDES) {
        v.psr = g->psr[l];
        v.psi = g->psi[l];
    }
    return v;
}

INLINE void lane_store(struct resonator_group *g, int l, const struct lane *v, enum resonator_change change)
{
    g->zr[l] = v->zr;
    g->zi[l] = v->zi;
    if (change != RESONATOR_STEADY) {
        g->gr[l] = v->gr;
        g->gi[l] = v->gi;
    }
    if (change == RESONATOR_GLIDES) {
        g->pr[l] = v->pr;
        g->pi[l] = v->pi;
    }
}

/* Adds the lanes' Im z of `n` samples to sums[n][LANES]. */
INLINE void ring_all(struct resonator_group *const *active, int n_active, const double *restrict f,
                     double (*restrict sums)[LANES], int n, enum resonator_change change)
{
    int i = 0;
    for (; i + SPAN <= n; i += SPAN) {
        for (int k = 0; k < n_active; k++) {
            struct resonator_group *restrict g = active[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                struct lane v = lane_take(g, l, change);
                sums[i][l] += lane_step(&v, f[i], change);
                sums[i + 1][l] += lane_step(&v, f[i + 1], change);
                sums[i + 2][l] += lane_step(&v, f[i + 2], change);
                sums[i + 3][l] += lane_step(&v, f[i + 3], change);
                lane_store(g, l, &v, change);
            }
        }
    }
    for (; i < n; i++) {
        for (int k = 0; k < n_active; k++) {
            struct resonator_group *restrict g = active[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                struct lane v = lane_take(g, l, change);
                sums[i][l] += lane_step(&v, f[i], change);
                lane_store(g, l, &v, change);
            }
        }
    }
}

LANES_CLONES
static void ring_steady(struct resonator_group *const *active, int n_active, const double *restrict f,
                        double (*restrict sums)[LANES], int n)
{
    ring_all(active, n_active, f, sums, n, RESONATOR_STEADY);
}

LANES_CLONES
static void ring(struct resonator_group *const *active, int n_active, const double *restrict f,
                 double (*restrict sums)[LANES], int n)
{
    ring_all(active, n_active, f, sums, n, RESONATOR_RAMPS);
}

LANES_CLONES
static void ring_gliding(struct resonator_group *const *active, int n_active, const double *restrict f,
                         double (*restrict sums)[LANES], int n)
{
    ring_all(active, n_active, f, sums, n, RESONATOR_GLIDES);
}

void resonators_ring(struct resonator_group *const *active, int n_active, const double *f, double (*sums)[LANES], int n,
                     enum resonator_change change)
{
    (change == RESONATOR_GLIDES   ? ring_gliding
     : change == RESONATOR_STEADY ? ring_steady
                                  : ring)(active, n_active, f, sums, n);
}
