/* Modes between places (places.h).

   Complex gains, always with shared poles: the gain is a linear sum of the places' own, with its sign: a mode shape
   passes through zero at a nodal line, where log amplitudes have no value. On lines, grids and rings it is the spline
   through the places, in triangles linear: places_smooth_at, over the gains and, in `re` and `im` after them, their
   slopes. Separate poles go the same way in the logarithm; a place that lacks a mode has a gain of 0 and the modes' own
   poles.

   Logarithmic gains, of separate poles only (papers/000 section 2.4: "logarithmically interpolated ... in both
   frequency and amplitude"; decays likewise) at the mix x = sum w_k x_k of up to four places (places_at), over those
   that have the mode, W = sum of their w_k:

       log f = sum w_k log f_k / W,  log decay likewise,  |A| = W exp(sum w_k log|A_k| / W)

   so that a mode that a place lacks keeps the poles of those that have it and fades linearly towards that place. A gain
   below -120 dB of the mode's largest counts as that; a gain of 0 is no mode. Logarithms are stored less those of the
   modes' own frequency, decay and largest gain: poles that are the same at all places come out so to the last bit.
   Shares are linear here, on grids too, w_k >= 0: a spline through logarithms as far down as -120 dB, or beside a place
   that lacks the mode, would overshoot by tens of decibels.

   The phase, in units of pi in [0, 2), takes the shorter turn from place to place along the edges of the triangle or
   cell; of half a turn (a change of sign), which both ways are, that which does not pass 2 pi. Phases are unrolled
   round the corners that have the mode and mixed by their shares. Where the turns round all corners add up to a whole
   one, no phase is continuous over the cell and that on each edge: there must be a zero inside. Then the modes of the
   edges at the share that their two ends have of each other are mixed as complex numbers, the edge from k to l by w_k
   w_l: on each edge that is the edge's own. None of it depends on where the corners are counted from, nor on which way
   round.

   Modes that reach half the sample rate fade: from 0.45 to 0.5 of it by (1 + cos(pi u))/2, beyond they are silent. */
#include "response/morph.h"

#include <math.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"

static const double half_turn = 1.0 + 1e-7; /* of pi: what rounding makes of a change of sign is one */
static const double floor_gain = 1e-6;      /* -120 dB */

/* ------------------------------------------------------------------ complex gains */

/* to = by x, or to += by x. */
LANES_CLONES
static void add(int n, bool first, double by, const double *x, double *to)
{
    if (first) {
#pragma omp simd
        for (int i = 0; i < n; i++)
            to[i] = by * x[i];
        return;
    }
#pragma omp simd
    for (int i = 0; i < n; i++)
        to[i] += by * x[i];
}

LANES_CLONES
static void times(int n, const double *by, double *x)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] *= by[i];
}

static double fade_of(const struct morph *p, double frequency)
{
    double u = (frequency / p->rate - 0.45) / 0.05;
    return u <= 0.0 ? 1.0 : u >= 1.0 ? 0.0 : 0.5 * (1.0 + real_cospi(u));
}

/* Poles of the sum's shares of their logarithms. */
static void curve(const struct morph *p, const struct places_sum *sum, const double *rows, const double *own,
                  double *to)
{
    for (int k = 0; k < sum->n; k++)
        add(p->n, k == 0, sum->weight[k], rows + (size_t)sum->index[k] * p->n, to);
    vecmath_exp((size_t)p->n, to, to);
    times(p->n, own, to);
}

double morph_complex(const struct modes *m, const struct modes_where *where, const struct modes_point *to)
{
    const struct morph *p = m->self;
    struct places_sum sum;
    double off = places_smooth_at(p->places, where->x, where->y, &sum);
    for (int k = 0; k < sum.n; k++) {
        add(p->n, k == 0, sum.weight[k], p->re + (size_t)sum.index[k] * p->n, to->re);
        add(p->n, k == 0, sum.weight[k], p->im + (size_t)sum.index[k] * p->n, to->im);
    }
    if (!p->frequency) return off;
    curve(p, &sum, p->frequency, m->frequency, to->frequency);
    curve(p, &sum, p->decay, m->decay, to->decay);
    for (int k = 0; k < p->highs; k++) {
        double fade = fade_of(p, to->frequency[p->high[k]]);
        to->re[p->high[k]] *= fade;
        to->im[p->high[k]] *= fade;
    }
    return off;
}

/* ------------------------------------------------------------------ logarithmic gains */

enum { CORNERS = 4 };

struct rows { /* of the corners of a mix, in turn; of fewer than four the last again */
    const double *at[CORNERS];
};

static struct rows rows_of(const struct morph *p, const double *rows, const struct places_mix *mix)
{
    struct rows r;
    for (int k = 0; k < CORNERS; k++)
        r.at[k] = rows + (size_t)mix->index[k < mix->n ? k : mix->n - 1] * p->n;
    return r;
}

static void add_up(int n, const struct places_mix *mix, const struct rows *r, double *to)
{
    for (int k = 0; k < mix->n; k++)
        add(n, k == 0, mix->weight[k], r->at[k], to);
}

LANES_CLONES
static void divide(int n, const double *share, double *x)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] = share[i] > 0.0 ? x[i] / share[i] : 0.0;
}

static inline __attribute__((always_inline)) double shorter(double turn)
{
    return turn > half_turn ? turn - 2.0 : turn < -half_turn ? turn + 2.0 : turn;
}

/* Phases where every corner has the mode, and torn[i]: whether the turns round them add up to a whole one. */
LANES_CLONES
static void turn_all(int n, const struct rows *phase, const double w[CORNERS], double *torn, double *to)
{
    const double *qa = phase->at[0], *qb = phase->at[1], *qc = phase->at[2], *qd = phase->at[3];
    double v = w[1], x = w[2], y = w[3];
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double b = shorter(qb[i] - qa[i]), c = b + shorter(qc[i] - qb[i]), d = c + shorter(qd[i] - qc[i]);
        to[i] = qa[i] + (v * b + x * c + y * d);
        torn[i] = fabs(d + shorter(qa[i] - qd[i])) > 1.0 ? 1.0 : 0.0;
    }
}

/* The same of mode i where some corner may lack it: phases are unrolled from the corner behind one that does. */
static void turn_some(const struct morph *p, const struct places_mix *mix, const struct rows *phase,
                      const struct rows *there, int i, double *to)
{
    double last = 0, sum = 0, turned = 0, first = 0;
    int corners = mix->n, from = 0, have = 0;
    for (int k = 0; k < corners; k++)
        if (there->at[k][i] > 0 && !(there->at[(k + corners - 1) % corners][i] > 0)) from = k;
    for (int j = 0; j < corners; j++) {
        int k = (from + j) % corners;
        if (!(there->at[k][i] > 0)) continue;
        first = have++ == 0 ? phase->at[k][i] : first;
        turned = have > 1 ? turned + shorter(phase->at[k][i] - last) : 0;
        last = phase->at[k][i];
        sum += mix->weight[k] * turned;
    }
    to[i] = first + (p->share[i] > 0.0 ? sum / p->share[i] : 0.0);
    p->torn[i] = have == corners && fabs(turned + shorter(first - last)) > 1.0 ? 1.0 : 0.0;
}

static void turn_to(const struct morph *p, const struct places_mix *mix, double *to)
{
    struct rows phase = rows_of(p, p->phase, mix), there = rows_of(p, p->there, mix);
    double w[CORNERS] = {0};
    for (int k = 0; k < mix->n; k++)
        w[k] = mix->weight[k];
    if (!p->gaps) turn_all(p->n, &phase, w, p->torn, to);
    for (int i = 0; p->gaps && i < p->n; i++)
        turn_some(p, mix, &phase, &there, i, to);
}

/* Poles, and amplitudes without W. */
static void logarithms(const struct morph *p, const struct modes *m, const struct places_mix *mix,
                       const struct modes_point *to)
{
    const double *rows[3] = {p->frequency, p->decay, p->gain}, *by[3] = {m->frequency, m->decay, p->largest};
    double *out[3] = {to->frequency, to->decay, p->amplitude};
    for (int c = 0; c < 3; c++) {
        struct rows r = rows_of(p, rows[c], mix);
        add_up(p->n, mix, &r, out[c]);
        if (p->gaps) divide(p->n, p->share, out[c]);
        vecmath_exp((size_t)p->n, out[c], out[c]);
        times(p->n, by[c], out[c]);
    }
}

/* The weight of l on the edge from k to l. */
static double on_edge(const double *w, int k, int l) { return w[k] + w[l] > 0.0 ? w[l] / (w[k] + w[l]) : 0.5; }

/* Shares of the edges from corner k to the next; false: the point is a corner. */
static bool share_edges(const struct places_mix *mix, double share[CORNERS])
{
    double sum = 0.0;
    for (int k = 0; k < mix->n; k++)
        sum += share[k] = mix->weight[k] * mix->weight[(k + 1) % mix->n];
    for (int k = 0; k < mix->n && sum > 0.0; k++)
        share[k] /= sum;
    return sum > 0.0;
}

/* The gains of the components that are torn: those of the edges at the shares of their ends, one after the other. */
static void mend(const struct morph *p, const struct places_mix *mix, const struct modes_point *to)
{
    struct rows gain = rows_of(p, p->gain, mix), phase = rows_of(p, p->phase, mix);
    double share[CORNERS];
    int n = 0, edges = mix->n;
    if (edges < 3 || !share_edges(mix, share)) return;
    for (int i = 0; i < p->n; i++)
        for (int k = 0, l = 1; k < edges && p->torn[i] > 0.0; k++, l = (k + 1) % edges, n++) {
            double on = on_edge(mix->weight, k, l), from = gain.at[k][i], q = phase.at[k][i];
            p->size[n] = from + on * (gain.at[l][i] - from);
            p->sine[n] = q + on * shorter(phase.at[l][i] - q);
        }
    vecmath_exp((size_t)n, p->size, p->size);
    vecmath_sincospi((size_t)n, p->sine, p->sine, p->cosine);
    n = 0;
    for (int i = 0; i < p->n; i++)
        if (p->torn[i] > 0.0) {
            double re = 0.0, im = 0.0, by = p->largest[i] * fade_of(p, to->frequency[i]);
            for (int k = 0; k < edges; k++, n++) {
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
    struct rows there = rows_of(p, p->there, &mix);
    add_up(p->n, &mix, &there, p->share);
    logarithms(p, m, &mix, to);
    turn_to(p, &mix, to->im);
    vecmath_sincospi((size_t)p->n, to->im, to->im, to->re);
    if (p->gaps) times(p->n, p->share, p->amplitude);
    for (int k = 0; k < p->highs; k++)
        p->amplitude[p->high[k]] *= fade_of(p, to->frequency[p->high[k]]);
    times(p->n, p->amplitude, to->re);
    times(p->n, p->amplitude, to->im);
    mend(p, &mix, to);
    return off;
}

/* ------------------------------------------------------------------ making */

void morph_put(struct morph *p, const struct modes *m, int row, int i, const double value[4])
{
    size_t at = (size_t)row * p->n + i;
    double size = fabs(value[2]), q = value[3] / REAL_PI + (value[2] < 0.0);
    if (size == 0.0) return;
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
    for (size_t k = 0; p->there && k < (size_t)p->rows * p->n; k++)
        p->gaps = p->gaps || p->there[k] == 0.0;
    for (int i = 0; i < p->n; i++)
        if (p->highest[i] > 0.45 * p->rate) p->high[p->highs++] = i;
}

void morph_begin(struct morph *p, bool shared, struct arena *a)
{
    double **rows[] = {&p->re, &p->im, &p->frequency, &p->decay};
    for (int c = 0; c < (shared ? 2 : 4); c++)
        *rows[c] = ARENA_TAKE(a, double, (size_t)places_rows(p->places) * (size_t)p->n);
    p->high = ARENA_TAKE(a, int, p->n);
}

void morph_set(struct morph *p, const struct modes *m, int row, int i, const struct morph_pole *at)
{
    size_t k = (size_t)row * p->n + i;
    p->re[k] = at->re;
    p->im[k] = at->im;
    if (!p->frequency) return;
    p->frequency[k] = at->frequency == m->frequency[i] ? 0.0 : real_log(at->frequency / m->frequency[i]);
    p->decay[k] = at->decay == m->decay[i] ? 0.0 : real_log(at->decay / m->decay[i]);
}

void morph_slopes(struct morph *p)
{
    double *rows[] = {p->re, p->im, p->frequency, p->decay};
    for (int c = 0; c < 4 && rows[c]; c++)
        places_fill(p->places, p->n, rows[c]);
    if (p->frequency) morph_settle(p);
}

/* Rows are packed towards the front: nothing is overwritten before it is read. */
static void pack(double *v, int rows, int n, const bool *keep)
{
    size_t to = 0;
    for (int r = 0; v && r < rows; r++)
        for (int i = 0; i < n; i++)
            if (keep[i]) v[to++] = v[(size_t)r * n + i];
}

int morph_keep(struct morph *p, struct modes *m, const bool *keep)
{
    double *rows[] = {p->re, p->im, p->frequency, p->decay, p->gain, p->phase, p->there};
    double *single[] = {p->largest, p->lowest, p->highest, m->frequency, m->decay, m->slowest};
    int n = p->n, kept = 0;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        pack(rows[k], p->re ? places_rows(p->places) : p->rows, n, keep);
    for (size_t k = 0; k < sizeof single / sizeof *single; k++)
        pack(single[k], 1, n, keep);
    for (int i = 0; i < n; i++)
        kept += keep[i];
    m->n = p->n = kept;
    if (!m->shared) morph_settle(p);
    return n - kept;
}
