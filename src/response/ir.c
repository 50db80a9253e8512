/* Impulse responses as samples (papers/000 eq. 10: 0 <= tau < t0).

   Scale: y[n] = (1/rate) sum_{m <= n} h((n-m)/rate) f[m] with half of h(0+) at m = n, the trapezium rule at the jump.
   Here 1/rate and the half are inside h[].

   Sampling modes, h(t) = Im sum_i A_i e^(s_i t): a phasor per mode turns by p = e^(s/rate) from sample to sample; every
   SEGMENT samples it starts afresh from a second phasor that turns by P = e^(s SEGMENT/rate), whose angle is reduced
   exactly (SEGMENT f modulo the rate; SEGMENT is a power of 2) before it is rounded. So rounding grows with SEGMENT +
   length/SEGMENT, not with length. Eight modes are the lanes of a group; sums run over groups in order and then over
   lanes in a fixed tree: same bits on every CPU. */
#include "response/ir.h"

#include <math.h>
#include <string.h>

#include "num/lanes.h"
#include "num/vecmath.h"

enum { SEGMENT = 256, SPAN = 4 }; /* samples between fresh starts; samples per visit to a group */

size_t ir_length(double rate, double t0)
{
    double n = t0 * rate, whole = rint(n);
    n = fabs(n - whole) < 1e-9 * whole ? whole
                                       : ceil(n); /* 0.1 s at 44.1 kHz is 4410 samples however the product rounds */
    return n < 1.0 ? 1 : (size_t)n;
}

struct group {
    _Alignas(64) double pr[LANES];
    double pi[LANES];            /* p: one sample              */
    double Pr[LANES], Pi[LANES]; /* P: one segment             */
    double Zr[LANES], Zi[LANES]; /* phasors where it started   */
    double zr[LANES], zi[LANES]; /* phasors now                */
};

struct ir_sampler {
    int n, groups;
    double rate;
    double *frequency, *decay; /* [groups][LANES] those of the phasors */
    struct group *group;
    double sums[SEGMENT][LANES];
};

/* e^(s n/rate) of a group, n a power of 2. The angle is reduced first, exactly: n f and whole multiples of the rate (a
 * whole number) are. */
static void phasors(const struct ir_sampler *s, int k, double n, double *re, double *im)
{
    double size[LANES], turn[LANES];
    for (int l = 0; l < LANES; l++) {
        double x = n * s->frequency[LANES * k + l];
        turn[l] = 2.0 * ((x - s->rate * floor(x / s->rate)) / s->rate);
        size[l] = -s->decay[LANES * k + l] * n / s->rate;
    }
    vecmath_exp(LANES, size, size);
    vecmath_sincospi(LANES, turn, im, re);
    for (int l = 0; l < LANES; l++) {
        re[l] *= size[l];
        im[l] *= size[l];
    }
}

struct ir_sampler *ir_sampler_make(struct arena *a, int n, double rate)
{
    struct ir_sampler *s = ARENA_TAKE(a, struct ir_sampler, 1);
    s->n = n;
    s->rate = rate;
    s->groups = (n + LANES - 1) / LANES;
    s->group = ARENA_TAKE(a, struct group, s->groups + 1);
    s->frequency = ARENA_TAKE(a, double, LANES *(size_t)s->groups);
    s->decay = ARENA_TAKE(a, double, LANES *(size_t)s->groups);
    for (int i = 0; i < n; i++)
        s->frequency[i] = NAN; /* no pole yet */
    return s;
}

static void set_poles(struct ir_sampler *s, const struct modes_point *p)
{
    for (int k = 0; k < s->groups; k++) {
        int from = LANES * k, n = s->n - from < LANES ? s->n - from : LANES;
        size_t bytes = (size_t)n * sizeof(double);
        bool same = memcmp(s->frequency + from, p->frequency + from, bytes) == 0 &&
                    memcmp(s->decay + from, p->decay + from, bytes) == 0;
        if (same) continue;
        memcpy(s->frequency + from, p->frequency + from, bytes);
        memcpy(s->decay + from, p->decay + from, bytes);
        phasors(s, k, 1.0, s->group[k].pr, s->group[k].pi);
        phasors(s, k, SEGMENT, s->group[k].Pr, s->group[k].Pi);
    }
}

/* Im z now; then z turns on by p. */
static inline __attribute__((always_inline)) double turn_on(double pr, double pi, double *zr, double *zi)
{
    double now = *zi, re = pr * *zr - pi * now;
    *zi = pr * now + pi * *zr;
    *zr = re;
    return now;
}

/* Adds Im z of n samples to sums[n][LANES]; n a multiple of SPAN. */
LANES_CLONES
static void ring(struct group *restrict group, int groups, double (*restrict sums)[LANES], size_t n)
{
    for (size_t i = 0; i < n; i += SPAN)
        for (int k = 0; k < groups; k++) {
            struct group *restrict g = &group[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                double pr = g->pr[l], pi = g->pi[l], zr = g->zr[l], zi = g->zi[l];
                sums[i][l] += turn_on(pr, pi, &zr, &zi);
                sums[i + 1][l] += turn_on(pr, pi, &zr, &zi);
                sums[i + 2][l] += turn_on(pr, pi, &zr, &zi);
                sums[i + 3][l] += turn_on(pr, pi, &zr, &zi);
                g->zr[l] = zr;
                g->zi[l] = zi;
            }
        }
}

/* The next segment's fresh start. */
static void restart(struct ir_sampler *s)
{
    for (int k = 0; k < s->groups; k++) {
        struct group *g = &s->group[k];
        for (int l = 0; l < LANES; l++)
            turn_on(g->Pr[l], g->Pi[l], &g->Zr[l], &g->Zi[l]);
        memcpy(g->zr, g->Zr, sizeof g->zr);
        memcpy(g->zi, g->Zi, sizeof g->zi);
    }
    memset(s->sums, 0, sizeof s->sums);
}

static void start(struct ir_sampler *s, const struct modes_point *p)
{
    for (int i = 0; i < s->n; i++) {
        struct group *g = &s->group[i / LANES];
        g->zr[i % LANES] = g->Zr[i % LANES] = p->re[i] / s->rate;
        g->zi[i % LANES] = g->Zi[i % LANES] = p->im[i] / s->rate;
    }
    memset(s->sums, 0, sizeof s->sums);
}

void ir_sample(struct ir_sampler *s, int quantity, const struct modes_point *p, double *h, size_t length)
{
    set_poles(s, p);
    start(s, p);
    for (size_t at = 0; at < length; at += SEGMENT) {
        size_t n = length - at < SEGMENT ? length - at : SEGMENT;
        ring(s->group, s->groups, s->sums, (n + SPAN - 1) / SPAN * SPAN);
        for (size_t i = 0; i < n; i++) {
            const double *v = s->sums[i];
            h[at + i] = ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
        }
        restart(s);
    }
    h[0] = 0.5 * h[0] + modes_direct(quantity, s->n, s->frequency, s->decay, p);
}
