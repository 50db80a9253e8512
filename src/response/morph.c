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
#include <stdlib.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"

/* Pairing modes.

   Assignment: shortest augmenting paths with potentials u (rows), v (columns) (Kuhn's Hungarian method in the form of
   Jonker and Volgenant, Computing 38, 1987). One row after the other is brought in by the alternating path of least
   reduced cost c - u - v >= 0. A row without partner is paired with a spare column of cost 2 alone: that both of a pair
   stay alone costs alone + alone, and the columns' share of it is constant but for the pairs made.

   Cost of a pair: |log f - log f'| + small g d/(1 + d), d = |log decay - log decay'|, g = log(1 + gate), small = 1e-3:
   decay decides only between what frequency leaves equal to a thousandth of the gate. Alone costs g, so that two modes
   within the gate with no others near are always a pair, and a chain of pairs is given up for another only where that
   saves more than what becomes alone.

   Modes farther apart than the gate cannot be partners, so the sorted frequencies of both places fall into blocks, each
   a problem of its own.

   Sorting by frequency and pairing by rank, as is often done, pairs everything above a missing mode wrongly
   (tests/unit/test_pairing.c). */

/* ------------------------------------------------------------------ assignment */

struct problem {
    int rows, columns; /* columns: the real ones; then as many spare ones as rows */
    const double *cost;
    double dummy;
    double *u, *v, *least; /* potentials; least reduced cost to each column so far */
    int *row, *from;       /* of a column: its row (-1: free), the column before it on the path (-1: the new row) */
    char *done;
};

/* Looks from a row that a path of `column` (-1: none) has led to; returns the nearest column not done. */
static int look(struct problem *p, int row, int column)
{
    int nearest = -1;
    for (int j = 0; j < p->columns + p->rows; j++) {
        if (p->done[j]) continue;
        double cost = (j < p->columns ? p->cost[(size_t)row * p->columns + j] : p->dummy) - p->u[row] - p->v[j];
        if (cost < p->least[j]) {
            p->least[j] = cost;
            p->from[j] = column;
        }
        if (nearest < 0 || p->least[j] < p->least[nearest]) nearest = j;
    }
    return nearest;
}

/* All that is on the tree comes nearer by `step`. */
static void shift(struct problem *p, int first, double step)
{
    p->u[first] += step;
    for (int j = 0; j < p->columns + p->rows; j++)
        if (p->done[j]) {
            p->u[p->row[j]] += step;
            p->v[j] -= step;
        } else
            p->least[j] -= step;
}

static void bring_in(struct problem *p, int first)
{
    int column = -1, all = p->columns + p->rows;
    for (int j = 0; j < all; j++) {
        p->least[j] = HUGE_VAL;
        p->done[j] = 0;
    }
    do {
        if (column >= 0) p->done[column] = 1;
        column = look(p, column < 0 ? first : p->row[column], column);
        shift(p, first, p->least[column]);
    } while (p->row[column] >= 0);
    for (int before; column >= 0; column = before) {
        before = p->from[column];
        p->row[column] = before < 0 ? first : p->row[before];
    }
}

static void solve(struct arena *a, int rows, int columns, const double *cost, double alone, int *column)
{
    int all = rows + columns;
    struct problem p = {.rows = rows, .columns = columns, .cost = cost, .dummy = 2.0 * alone};
    p.u = ARENA_TAKE(a, double, rows);
    p.v = ARENA_TAKE(a, double, all);
    p.least = ARENA_TAKE(a, double, all);
    p.row = ARENA_TAKE(a, int, all);
    p.from = ARENA_TAKE(a, int, all);
    p.done = ARENA_TAKE(a, char, all);
    for (int j = 0; j < all; j++)
        p.row[j] = -1;
    for (int i = 0; i < rows; i++) {
        bring_in(&p, i);
        column[i] = -1;
    }
    for (int j = 0; j < columns; j++)
        if (p.row[j] >= 0) column[p.row[j]] = j;
}

void morph_assign(int rows, int columns, const double *cost, double alone, int *column)
{
    struct arena *a = arena_open();
    solve(a, rows, columns, cost, alone, column);
    arena_close(a);
}

/* ------------------------------------------------------------------ two places */

struct entry {
    double f, d; /* logarithms */
    int index;
};

static int by_frequency(const void *a, const void *b)
{
    const struct entry *p = a, *q = b;
    if (p->f != q->f) return p->f < q->f ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static struct entry *sorted(struct arena *a, const struct morph_list *l)
{
    struct entry *s = ARENA_TAKE(a, struct entry, l->n);
    for (int i = 0; i < l->n; i++)
        s[i] = (struct entry){real_log(l->frequency[i]), real_log(l->decay[i]), i};
    qsort(s, (size_t)l->n, sizeof *s, by_frequency);
    return s;
}

static double pair_cost(const struct entry *p, const struct entry *q, double g)
{
    double f = fabs(p->f - q->f), d = fabs(p->d - q->d);
    return f > g + 1e-12 ? HUGE_VAL : f + 1e-3 * g * d / (1.0 + d);
}

static void block(const struct entry *p, int rows, const struct entry *q, int columns, double g, int *column)
{
    struct arena *a = arena_open();
    double *cost = ARENA_TAKE(a, double, (size_t)rows *columns);
    int *partner = ARENA_TAKE(a, int, rows);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            cost[(size_t)i * columns + j] = pair_cost(&p[i], &q[j], g);
    solve(a, rows, columns, cost, g + 1e-9, partner);
    for (int i = 0; i < rows; i++)
        column[p[i].index] = partner[i] < 0 ? -1 : q[partner[i]].index;
    arena_close(a);
}

void morph_pair(const struct morph_list *row, const struct morph_list *other, double gate, int *column)
{
    struct arena *a = arena_open();
    const struct entry *p = sorted(a, row), *q = sorted(a, other);
    double g = real_log1p(gate), last = -HUGE_VAL;
    int i = 0, j = 0, i0 = 0, j0 = 0;
    while (i < row->n || j < other->n) {
        bool left = j == other->n || (i < row->n && p[i].f <= q[j].f);
        double f = left ? p[i].f : q[j].f;
        if (f - last > g + 1e-12) {
            block(p + i0, i - i0, q + j0, j - j0, g, column);
            i0 = i, j0 = j;
        }
        last = f;
        i += left;
        j += !left;
    }
    block(p + i0, i - i0, q + j0, j - j0, g, column);
    arena_close(a);
}

/* ------------------------------------------------------------------ from place to place */

struct follow {
    int places, n; /* n tracks so far */
    const double *xy;
    const struct morph_list *list;
    int *const *track;
    bool *met;                 /* [places] */
    double *frequency, *decay; /* [all modes] what a track is on its way to the next place */
    double *nearest;           /* [all modes] m, from where */
    int *column;               /* [all modes] */
};

static double distance_between(const struct follow *f, int p, int q)
{
    double x = f->xy[2 * p] - f->xy[2 * q], y = f->xy[2 * p + 1] - f->xy[2 * q + 1];
    return sqrt(x * x + y * y);
}

/* Each track as it is at the place nearest to `place` that has it. */
static void gather(struct follow *f, int place)
{
    for (int t = 0; t < f->n; t++)
        f->nearest[t] = HUGE_VAL;
    for (int p = 0; p < f->places; p++) {
        double distance = distance_between(f, p, place);
        for (int i = 0; f->met[p] && i < f->list[p].n; i++) {
            int t = f->track[p][i];
            if (distance < f->nearest[t]) {
                f->nearest[t] = distance;
                f->frequency[t] = f->list[p].frequency[i];
                f->decay[t] = f->list[p].decay[i];
            }
        }
    }
}

static void meet(struct follow *f, int place, double gate)
{
    const struct morph_list *here = &f->list[place];
    gather(f, place);
    morph_pair(here, &(struct morph_list){f->n, f->frequency, f->decay}, gate, f->column);
    for (int i = 0; i < here->n; i++)
        f->track[place][i] = f->column[i] < 0 ? f->n++ : f->column[i];
    f->met[place] = true;
}

/* The place not met that a shortest edge joins to one that is; -1: none is left. */
static int next(const struct follow *f, int edges, const int (*edge)[2])
{
    int best = -1;
    double least = HUGE_VAL;
    for (int k = 0; k < edges; k++) {
        int p = edge[k][0], q = edge[k][1];
        if (f->met[p] == f->met[q] || distance_between(f, p, q) >= least) continue;
        least = distance_between(f, p, q);
        best = f->met[p] ? q : p;
    }
    return best;
}

int morph_tracks(const struct places *p, int places, const double *xy, const struct morph_list *list, double gate,
                 int *const *track)
{
    struct arena *a = arena_open();
    const int(*edge)[2];
    int edges = places_edges(p, &edge), all = 0, place = 0;
    struct follow f = {.places = places, .xy = xy, .list = list, .track = track};
    for (int k = 0; k < places; k++) {
        all += list[k].n;
        place = list[k].n > list[place].n ? k : place;
    }
    f.met = ARENA_TAKE(a, bool, places);
    f.frequency = ARENA_TAKE(a, double, all);
    f.decay = ARENA_TAKE(a, double, all);
    f.nearest = ARENA_TAKE(a, double, all);
    f.column = ARENA_TAKE(a, int, all);
    for (; place >= 0; place = next(&f, edges, edge))
        meet(&f, place, gate);
    arena_close(a);
    return f.n;
}

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
        to[i] = fma(by, x[i], to[i]);
}

LANES_CLONES
static void times(int n, const double *by, double *x)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] *= by[i];
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
        double fade = modes_fade(to->frequency[p->high[k]], p->rate);
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

static inline __attribute__((always_inline)) double shorter(double turn)
{
    return turn > half_turn ? turn - 2.0 : turn < -half_turn ? turn + 2.0 : turn;
}

/* The phase of mode i, and torn: whether the turns round the corners add up to a whole one. Where a corner lacks the
   mode, phases are unrolled from the corner behind it. */
static void turn_one(const struct morph *p, const struct places_mix *mix, const struct rows *phase,
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
    to[i] = first + (!p->gaps ? sum : p->share[i] > 0.0 ? sum / p->share[i] : 0.0);
    p->torn[i] = have == corners && fabs(turned + shorter(first - last)) > 1.0 ? 1.0 : 0.0;
}

static void turn_to(const struct morph *p, const struct places_mix *mix, double *to)
{
    struct rows phase = rows_of(p, p->phase, mix), there = rows_of(p, p->there, mix);
    for (int i = 0; i < p->n; i++)
        turn_one(p, mix, &phase, &there, i, to);
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
        for (int i = 0; p->gaps && i < p->n; i++)
            out[c][i] = p->share[i] > 0.0 ? out[c][i] / p->share[i] : 0.0;
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
            double re = 0.0, im = 0.0, by = p->largest[i] * modes_fade(to->frequency[i], p->rate);
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
        p->amplitude[p->high[k]] *= modes_fade(to->frequency[p->high[k]], p->rate);
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

void morph_finish(struct morph *p)
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
    if (p->frequency) morph_finish(p);
}

/* Rows are packed towards the front: nothing is overwritten before it is read. */
static void pack(double *v, int rows, int n, const bool *chosen)
{
    size_t to = 0;
    for (int r = 0; v && r < rows; r++)
        for (int i = 0; i < n; i++)
            if (chosen[i]) v[to++] = v[(size_t)r * n + i];
}

int morph_select(struct morph *p, struct modes *m, const bool *chosen)
{
    double *rows[] = {p->re, p->im, p->frequency, p->decay, p->gain, p->phase, p->there};
    double *single[] = {p->largest, p->lowest, p->highest, m->frequency, m->decay, m->slowest};
    int n = p->n, left = 0;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        pack(rows[k], p->re ? places_rows(p->places) : p->rows, n, chosen);
    for (size_t k = 0; k < sizeof single / sizeof *single; k++)
        pack(single[k], 1, n, chosen);
    for (int i = 0; i < n; i++)
        left += chosen[i];
    m->n = p->n = left;
    if (!m->shared) morph_finish(p);
    return n - left;
}

#define NO_RATE 1e12 /* Hz */

/* Separate poles: the modes' own are those of the first place. */
static void fill(const struct morph_points_ask *ask, struct arena *a, struct modes *m, struct morph *p)
{
    double **single[] = {&p->lowest, &p->highest};
    for (int c = 0; c < 2; c++)
        *single[c] = ARENA_TAKE(a, double, p->n); /* 0: nothing fades */
    morph_begin(p, ask->shared, a);
    for (int i = 0; i < p->n && !ask->shared; i++) {
        m->frequency[i] = ask->at[0].frequency[i];
        m->decay[i] = ask->at[0].decay[i];
    }
    for (int row = 0; row < p->rows; row++)
        for (int i = 0; i < p->n; i++) {
            const struct modes_point *at = &ask->at[row];
            morph_set(p, m, row, i, &(struct morph_pole){at->frequency[i], at->decay[i], at->re[i], at->im[i]});
        }
    morph_slopes(p);
}

bool morph_points(const struct morph_points_ask *ask, struct arena *a, struct modes *m, struct err *e)
{
    struct morph *p = ARENA_TAKE(a, struct morph, 1);
    int bad;
    *p = (struct morph){.n = ask->n, .rows = ask->places, .rate = NO_RATE};
    *m = (struct modes){.n = ask->n,
                        .shared = ask->shared,
                        .moves = ask->places > 1,
                        .frequency = ARENA_TAKE(a, double, ask->n),
                        .decay = ARENA_TAKE(a, double, ask->n),
                        .self = p,
                        .at = morph_complex};
    if (!places_make(a, ask->places, &ask->xy[0][0], &p->places, &bad, e)) return false;
    m->places = p->places;
    fill(ask, a, m, p);
    return true;
}
