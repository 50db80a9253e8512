/* See crest_lanes.h: crest_piece.c's formulas, operation by operation, with selections for its branches; a disc that
   has found its place stays there while others still look. Newton's method is a chain of roots and divisions, 370
   cycles a place one at a time; eight at a time it is 110 a place (AVX-512). */
#include "surface/crest_lanes.h"

#include <math.h>

#define INLINE static inline __attribute__((always_inline))

enum { STEPS_MOST = 60 };

#define NEAR 1e-7 /* as in crest_piece.c */

struct search {
    _Alignas(64) double q[LANES], off[LANES], falls[LANES], low[LANES], high[LANES];
    double y[LANES];    /* in half pieces */
    double open[LANES]; /* 1: still looking; 0: q is found */
};

INLINE double slope_at(const struct crest_lanes *at, int l, double q)
{
    return at->terms[1][l] +
           q * (2 * at->terms[2][l] + q * (3 * at->terms[3][l] + q * (4 * at->terms[4][l] + q * 5 * at->terms[5][l])));
}

INLINE double bend_at(const struct crest_lanes *at, int l, double q)
{
    return 2 * at->terms[2][l] + q * (6 * at->terms[3][l] + q * (12 * at->terms[4][l] + q * 20 * at->terms[5][l]));
}

INLINE double off_at(const struct crest_disc *d, const struct crest_lanes *at, int l, double y, double q, double *falls)
{
    double p = slope_at(at, l, q) * d->over, one = 1 / sqrt(1 + p * p), far = d->tall * one;
    *falls = 1 - far * one * one * bend_at(at, l, q) * d->over;
    return y - q + far * p;
}

/* Where the search begins: at an end it is over at once. */
LANES_CLONES
static void begin(const struct crest_disc *d, const struct crest_lanes *at, struct search *s)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double y = at->y[l] * d->over, falls, away, off = off_at(d, at, l, y, 0, &falls);
        double end = lanes_select(off > 0, 1, -1), beyond = off_at(d, at, l, y, end, &away);
        double low = lanes_select(off > 0, 0, -1), high = lanes_select(off > 0, 1, 0);
        double range = beyond - off, t = -off / range, chord = end / range, a = -1 / falls - chord,
               b = chord + 1 / away;
        double guess = t * (end + (1 - t) * range * ((1 - t) * a + t * b));
        guess = lanes_select(guess > low, guess, low);
        guess = lanes_select(guess < high, guess, high);
        double q = lanes_select((falls > 0) & (away > 0), guess, 0);
        int over = beyond * end >= 0;
        s->y[l] = y;
        s->q[l] = lanes_select(over, end, q);
        s->low[l] = low;
        s->high[l] = high;
        s->open[l] = lanes_select(over, 0, 1);
        s->off[l] = off_at(d, at, l, y, q, &falls);
        s->falls[l] = falls;
    }
}

/* Newton's step from q, or half of what is left; how many still look after it. */
LANES_CLONES
static double move(struct search *s)
{
    double looking = 0;
#pragma omp simd reduction(+ : looking)
    for (int l = 0; l < LANES; l++) {
        double off = s->off[l], before = s->q[l], falls = s->falls[l], next = before + off / falls;
        double low = lanes_select(off > 0, before, s->low[l]), high = lanes_select(off > 0, s->high[l], before);
        double q = lanes_select((falls > 0) & (next >= low) & (next <= high), next, 0.5 * (low + high));
        double open = s->open[l];
        q = lanes_select(open > 0, q, before);
        open = lanes_select(fabs(q - before) < NEAR, 0, open);
        s->q[l] = q;
        s->low[l] = low;
        s->high[l] = high;
        s->open[l] = open;
        looking += open;
    }
    return looking;
}

LANES_CLONES
static void look(const struct crest_disc *d, const struct crest_lanes *at, struct search *s)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double falls;
        s->off[l] = off_at(d, at, l, s->y[l], s->q[l], &falls);
        s->falls[l] = falls;
    }
}

LANES_CLONES
static void rest(const struct crest_disc *d, struct crest_lanes *at, const struct search *s)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double q = s->q[l], u = at->y[l] - q * d->half, square = (d->radius - u) * (d->radius + u);
        double side = sqrt(lanes_select(square > 0, square, 0)), arc = d->radius * d->radius / (side * side * side);
        double z = at->terms[0][l] +
                   q * (at->terms[1][l] +
                        q * (at->terms[2][l] + q * (at->terms[3][l] + q * (at->terms[4][l] + q * at->terms[5][l]))));
        int inside = fabs(q) < 1;
        double bend = lanes_select(inside, bend_at(at, l, q) * d->over * d->over, 0);
        at->z[l] = z - u * u / (d->radius + side);
        at->slope[l] = -u / side;
        at->bend[l] = lanes_select(inside, arc * bend / (arc - bend), -arc);
    }
}

void crest_lanes_rest(const struct crest_disc *d, struct crest_lanes *at)
{
    struct search s;
    begin(d, at, &s);
    for (int i = 0; i < STEPS_MOST && move(&s) > 0; i++)
        look(d, at, &s);
    rest(d, at, &s);
}
