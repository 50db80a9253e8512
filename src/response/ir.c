/* Impulse responses as samples (papers/000 eq. 10: 0 <= tau < t0).

   Scale: y[n] = (1/rate) sum_{m <= n} h((n-m)/rate) f[m] with half of h(0+) at m = n, the trapezium rule at the jump. Here 1/rate and
   the half are inside h[].

   Sampling modes, h(t) = Im sum_i A_i e^(s_i t): a phasor per mode turns by p = e^(s/rate) from sample to sample; every SEGMENT samples
   it starts afresh from a second phasor that turns by P = e^(s SEGMENT/rate), whose angle is reduced exactly (fmod of SEGMENT f by
   rate; SEGMENT is a power of 2) before it is rounded. So rounding grows with SEGMENT + length/SEGMENT, not with length. Eight modes
   are the lanes of a group; sums run over groups in order and then over lanes in a fixed tree: same bits on every CPU. */
#include "response/ir.h"

#include <math.h>
#include <string.h>

#include "file/wav.h"
#include "num/lanes.h"
#include "num/real.h"

enum { SEGMENT = 256, SPAN = 4 }; /* samples between fresh starts; samples per visit to a group */

size_t ir_length(double rate, double t0)
{
    double n = t0 * rate, whole = rint(n);
    n = fabs(n - whole) < 1e-9 * whole ? whole : ceil(n); /* 0.1 s at 44.1 kHz is 4410 samples however the product rounds */
    return n < 1.0 ? 1 : (size_t)n;
}

/* ------------------------------------------------------------------ from a WAV */

static bool refuse(const char *path, const struct wav *w, double rate, struct err *e)
{
    if (w->channels != 1)
        return err_set(e, ERR_SCENE, "%s: has %d channels; an impulse response is mono: extract one channel", path, w->channels);
    if (w->rate != rate)
        return err_set(e, ERR_SCENE, "%s: its sample rate is %g Hz, the scene's %g Hz: resample it, or set output.sample_rate: %g Hz", path,
                       w->rate, rate, w->rate);
    return true;
}

bool ir_read(const char *path, double rate, double t0, struct arena *a, struct ir *ir, struct err *e)
{
    struct wav w;
    bool silent = true;
    if (!wav_read(path, a, &w, e) || !refuse(path, &w, rate, e))
        return false;
    size_t cut = isnan(t0) ? w.frames : ir_length(rate, t0);
    ir->length = cut < w.frames ? cut : w.frames;
    ir->h = ARENA_TAKE(a, double, ir->length);
    for (size_t n = 0; n < ir->length; n++) {
        ir->h[n] = w.x[n] / rate;
        silent = silent && w.x[n] == 0.0;
    }
    ir->h[0] *= 0.5;
    if (silent)
        return err_set(e, ERR_SCENE, "%s: the impulse response is silent%s; give one that rings, or leave the response out", path,
                       ir->length < w.frames ? " before response_length" : "");
    return true;
}

/* ------------------------------------------------------------------ from modes */

struct group {
    _Alignas(64) double pr[LANES];
    double pi[LANES];            /* p: one sample              */
    double Pr[LANES], Pi[LANES]; /* P: one segment             */
    double Zr[LANES], Zi[LANES]; /* phasors where it started   */
    double zr[LANES], zi[LANES]; /* phasors now                */
};

struct ir_sampler {
    const struct modes *modes;
    double rate;
    int groups;
    struct group *group;
    double sums[SEGMENT][LANES];
};

/* e^(s n/rate), n a power of 2. */
static void phasor(const struct modes *m, int i, double rate, double n, double *re, double *im)
{
    double turn = fmod(n * m->frequency[i], rate) / rate, size = real_exp(-m->decay[i] * n / rate);
    *re = size * real_cospi(2.0 * turn);
    *im = size * real_sinpi(2.0 * turn);
}

struct ir_sampler *ir_sampler_make(struct arena *a, const struct modes *m, double rate)
{
    struct ir_sampler *s = ARENA_TAKE(a, struct ir_sampler, 1);
    s->modes = m;
    s->rate = rate;
    s->groups = (m->n + LANES - 1) / LANES;
    s->group = ARENA_TAKE(a, struct group, s->groups + 1);
    for (int i = 0; i < m->n; i++) {
        struct group *g = &s->group[i / LANES];
        phasor(m, i, rate, 1.0, &g->pr[i % LANES], &g->pi[i % LANES]);
        phasor(m, i, rate, SEGMENT, &g->Pr[i % LANES], &g->Pi[i % LANES]);
    }
    return s;
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

static void start(struct ir_sampler *s, const double *gain_re, const double *gain_im)
{
    for (int i = 0; i < s->modes->n; i++) {
        struct group *g = &s->group[i / LANES];
        g->zr[i % LANES] = g->Zr[i % LANES] = gain_re[i] / s->rate;
        g->zi[i % LANES] = g->Zi[i % LANES] = gain_im[i] / s->rate;
    }
    memset(s->sums, 0, sizeof s->sums);
}

void ir_sample(struct ir_sampler *s, const double *gain_re, const double *gain_im, double *h, size_t length)
{
    start(s, gain_re, gain_im);
    for (size_t at = 0; at < length; at += SEGMENT) {
        size_t n = length - at < SEGMENT ? length - at : SEGMENT;
        ring(s->group, s->groups, s->sums, (n + SPAN - 1) / SPAN * SPAN);
        for (size_t i = 0; i < n; i++) {
            const double *v = s->sums[i];
            h[at + i] = ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
        }
        restart(s);
    }
    h[0] = 0.5 * h[0] + modes_direct(s->modes, gain_re, gain_im);
}
