/* Modes between places, at the mix x = sum w_k x_k of up to three of them (places.h).

   Shared poles: the complex gain is linear, A = sum w_k A_k, with its sign: a mode shape passes through zero at a nodal line, where log amplitudes have no
   value.

   Separate poles (papers/000 section 2.4: "logarithmically interpolated ... in both frequency and amplitude"; decays likewise), over the places that
   have the mode, W = sum of their w_k:
       log f = sum w_k log f_k / W,  log decay likewise,  |A| = W exp(sum w_k log|A_k| / W)
   so that a mode that a place lacks keeps the poles of those that have it and fades linearly towards that place. A gain below -120 dB of the mode's largest
   counts as that; a gain of 0 is no mode. Logarithms are stored less those of the modes' own frequency, decay and largest gain: poles that are the
   same at all places come out so to the last bit.

   The phase, in units of pi in [0, 2), takes the shorter turn from place to place; of half a turn (a change of sign), which both ways are, that which does
   not pass 2 pi. Where the turns around three places add up to a whole one, no phase is linear over the triangle and that on each edge: there must be a
   zero inside. Then the modes of the edges at the points behind which their opposite corners lie are mixed as complex numbers, the edge from k to l by
   w_k w_l: on each edge that is the edge's own.

   Modes that reach half the sample rate fade: from 0.45 to 0.5 of it by (1 + cos(pi u))/2, beyond they are silent. */
#include "response/morph.h"

#include <math.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"

static const double half_turn = 1.0 + 1e-7; /* of pi: what rounding makes of a change of sign is one */
static const double floor_gain = 1e-6;      /* -120 dB */

/* ------------------------------------------------------------------ shared */

LANES_CLONES
static void blend(int n, const double *a, const double *b, const double *c, const double w[2], double *to)
{
    double v = w[0], u = w[1];
#pragma omp simd
    for (int i = 0; i < n; i++)
        to[i] = a[i] + v * (b[i] - a[i]) + u * (c[i] - a[i]);
}

/* Of a mix of fewer places the others count 0. */
static const double *row_of(const struct morph *p, const double *rows, const struct places_mix *mix, int k)
{
    return rows + (size_t)mix->index[k] * p->n;
}

double morph_shared(const struct modes *m, const struct modes_where *where, const struct modes_point *to)
{
    const struct morph *p = m->self;
    struct places_mix mix;
    double off = places_at(p->places, where->x, where->y, &mix);
    blend(p->n, row_of(p, p->re, &mix, 0), row_of(p, p->re, &mix, 1), row_of(p, p->re, &mix, 2), mix.weight + 1, to->re);
    blend(p->n, row_of(p, p->im, &mix, 0), row_of(p, p->im, &mix, 1), row_of(p, p->im, &mix, 2), mix.weight + 1, to->im);
    return off;
}

/* ------------------------------------------------------------------ separate */

struct rows { /* of the up to three places of a mix */
    const double *a, *b, *c;
};

static struct rows rows_of(const struct morph *p, const double *rows, const struct places_mix *mix)
{
    return (struct rows){row_of(p, rows, mix, 0), row_of(p, rows, mix, 1), row_of(p, rows, mix, 2)};
}

LANES_CLONES
static void add_up(int n, struct rows r, const double w[3], double *to)
{
    const double *a = r.a, *b = r.b, *c = r.c;
    double u = w[0], v = w[1], x = w[2];
#pragma omp simd
    for (int i = 0; i < n; i++)
        to[i] = u * a[i] + v * b[i] + x * c[i];
}

LANES_CLONES
static void divide(int n, const double *share, double *x)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] = share[i] > 0.0 ? x[i] / share[i] : 0.0;
}

LANES_CLONES
static void times(int n, const double *by, double *x)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] *= by[i];
}

static inline __attribute__((always_inline)) double shorter(double turn)
{
    return turn > half_turn ? turn - 2.0 : turn < -half_turn ? turn + 2.0 : turn;
}

/* Phases, and torn[i]: whether the three turns add up to a whole one. `there` as rows: a place that lacks the mode has no say. */
LANES_CLONES
static void turn_to(int n, const struct rows *phase, const struct rows *there, const double w[3], const struct morph *p, double *to)
{
    const double *qa = phase->a, *qb = phase->b, *qc = phase->c, *ta = there->a, *tb = there->b, *tc = there->c;
    double *torn = p->torn, u = w[0], v = w[1], x = w[2];
    const double *share = p->share;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double from = ta[i] > 0.0 ? qa[i] : tb[i] > 0.0 ? qb[i] : qc[i];
        double a = shorter(qa[i] - from), b = shorter(qb[i] - from), c = shorter(qc[i] - from), bc = shorter(qc[i] - qb[i]);
        double sum = u * ta[i] * a + v * tb[i] * b + x * tc[i] * c;
        to[i] = from + (share[i] > 0.0 ? sum / share[i] : 0.0);
        torn[i] = fabs(c - b - bc) > 0.5 ? ta[i] * tb[i] * tc[i] : 0.0;
    }
}

static double fade_of(const struct morph *p, double frequency)
{
    double u = (frequency / p->rate - 0.45) / 0.05;
    return u <= 0.0 ? 1.0 : u >= 1.0 ? 0.0 : 0.5 * (1.0 + real_cospi(u));
}

/* Poles, and amplitudes without W. */
static void logarithms(const struct morph *p, const struct modes *m, const struct places_mix *mix, const struct modes_point *to)
{
    const double *rows[3] = {p->frequency, p->decay, p->gain}, *by[3] = {m->frequency, m->decay, p->largest};
    double *out[3] = {to->frequency, to->decay, p->amplitude};
    for (int c = 0; c < 3; c++) {
        add_up(p->n, rows_of(p, rows[c], mix), mix->weight, out[c]);
        if (p->gaps)
            divide(p->n, p->share, out[c]);
        vecmath_exp((size_t)p->n, out[c], out[c]);
        times(p->n, by[c], out[c]);
    }
}

/* The weight of l on the edge from k to l. */
static double on_edge(const double *w, int k, int l)
{
    return w[k] + w[l] > 0.0 ? w[l] / (w[k] + w[l]) : 0.5;
}

/* The gains of the components that are torn: those of the three edges at the weights with the third left out, three after each other. */
static void mend(const struct morph *p, const struct places_mix *mix, const struct modes_point *to)
{
    struct rows gain = rows_of(p, p->gain, mix), phase = rows_of(p, p->phase, mix);
    const double *w = mix->weight, sum = w[0] * w[1] + w[1] * w[2] + w[2] * w[0];
    const double share[3] = {w[0] * w[1] / sum, w[1] * w[2] / sum, w[2] * w[0] / sum};
    int n = 0;
    for (int i = 0; i < p->n; i++) {
        const double g[3] = {gain.a[i], gain.b[i], gain.c[i]}, q[3] = {phase.a[i], phase.b[i], phase.c[i]};
        for (int k = 0, l = 1; k < 3 && p->torn[i] > 0.0; k++, l = (k + 1) % 3, n++) {
            double on = on_edge(w, k, l);
            p->size[n] = g[k] + on * (g[l] - g[k]);
            p->sine[n] = q[k] + on * shorter(q[l] - q[k]);
        }
    }
    vecmath_exp((size_t)n, p->size, p->size);
    vecmath_sincospi((size_t)n, p->sine, p->sine, p->cosine);
    n = 0;
    for (int i = 0; i < p->n; i++)
        if (p->torn[i] > 0.0) {
            double re = 0.0, im = 0.0, by = p->largest[i] * fade_of(p, to->frequency[i]);
            for (int k = 0; k < 3; k++, n++) {
                re += share[k] * p->size[n] * p->cosine[n];
                im += share[k] * p->size[n] * p->sine[n];
            }
            to->re[i] = by * re;
            to->im[i] = by * im;
        }
}

double morph_separate(const struct modes *m, const struct modes_where *where, const struct modes_point *to)
{
    const struct morph *p = m->self;
    struct places_mix mix;
    double off = places_at(p->places, where->x, where->y, &mix);
    struct rows phase = rows_of(p, p->phase, &mix), there = rows_of(p, p->there, &mix);
    add_up(p->n, there, mix.weight, p->share);
    logarithms(p, m, &mix, to);
    turn_to(p->n, &phase, &there, mix.weight, p, to->im);
    vecmath_sincospi((size_t)p->n, to->im, to->im, to->re);
    if (p->gaps)
        times(p->n, p->share, p->amplitude);
    for (int k = 0; k < p->highs; k++)
        p->amplitude[p->high[k]] *= fade_of(p, to->frequency[p->high[k]]);
    times(p->n, p->amplitude, to->re);
    times(p->n, p->amplitude, to->im);
    if (mix.n == 3 && mix.weight[0] < 1.0 && mix.weight[1] < 1.0 && mix.weight[2] < 1.0)
        mend(p, &mix, to);
    return off;
}

/* ------------------------------------------------------------------ making */

void morph_put(struct morph *p, const struct modes *m, int row, int i, const double value[4])
{
    size_t at = (size_t)row * p->n + i;
    double size = fabs(value[2]), q = value[3] / REAL_PI + (value[2] < 0.0);
    if (size == 0.0)
        return;
    q -= 2.0 * floor(0.5 * q);
    p->there[at] = 1.0;
    p->frequency[at] = value[0] == m->frequency[i] ? 0.0 : real_log(value[0] / m->frequency[i]);
    p->decay[at] = value[1] == m->decay[i] ? 0.0 : real_log(value[1] / m->decay[i]);
    p->gain[at] = real_log(fmax(size / p->largest[i], floor_gain));
    p->phase[at] = q < 2.0 ? q : 0.0;
}

void morph_settle(struct morph *p)
{
    p->gaps = false;
    p->highs = 0;
    for (size_t k = 0; k < (size_t)p->rows * p->n; k++)
        p->gaps = p->gaps || p->there[k] == 0.0;
    for (int i = 0; i < p->n; i++)
        if (p->highest[i] > 0.45 * p->rate)
            p->high[p->highs++] = i;
}

/* Rows are packed towards the front: nothing is overwritten before it is read. */
static void pack(double *v, int rows, int n, const bool *keep)
{
    size_t to = 0;
    for (int r = 0; v && r < rows; r++)
        for (int i = 0; i < n; i++)
            if (keep[i])
                v[to++] = v[(size_t)r * n + i];
}

int morph_keep(struct morph *p, struct modes *m, const bool *keep)
{
    double *rows[] = {p->re, p->im, p->frequency, p->decay, p->gain, p->phase, p->there};
    double *single[] = {p->largest, p->lowest, p->highest, m->frequency, m->decay, m->slowest};
    int n = p->n, kept = 0;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        pack(rows[k], p->rows, n, keep);
    for (size_t k = 0; k < sizeof single / sizeof *single; k++)
        pack(single[k], 1, n, keep);
    for (int i = 0; i < n; i++)
        kept += keep[i];
    m->n = p->n = kept;
    if (!m->shared)
        morph_settle(p);
    return n - kept;
}
