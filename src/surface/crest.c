/* See crest.h. Two sets of ground, one wholly on the left of the other, give two envelopes of which the left one is the
   upper one up to some x, and the right one from there on: of two arcs of one radius this is so, and an envelope is a
   maximum of arcs. So pieces taken from left to right make a stack: a new one hides the last while it is already above
   where that one rises from behind the one before. Each is put down once and taken away at most once.

   Switches. From a piece to the next, which goes on from it, the disc passes where it rests on their common end: closed
   form. Else by Newton's method on the difference of the two envelopes, whose slopes are known, from where arcs on the
   pieces' middles cross: of two whose centres lie D apart in x and H in height (the right one higher by H), q^2 = D^2 +
   H^2, at

     x = (x_i + x_j) / 2 - H sqrt(R^2/q^2 - 1/4)      for q^2 <= 2 R D

   For q^2 > 2 R D it is a cliff that one of them overtops: the switch is then where the right arc begins, x_j - R (H >
   0), or the left one ends, x_i + R.

   Sieve. Most pieces are never touched, and a first stack of those arcs leaves them out: an arc goes if, raised by what
   the disc may rest higher between its piece's ends (crest_piece_margin), it is still under those of two others. Of
   ground that is points alone this is, with nothing to raise by, the envelope itself.

   Errors. Those of the polynomials, of sixth order in the pitch d; switches and heights to rounding. Of points alone:
   the largest of their arcs to rounding, and what the disc meets between is missed: E is too low by at most d^2/8 (1/R
   + |z''|) at the places of contact. Of ground with kinks (straight lines, steps) they are among the points if their
   pitch is a whole multiple of d, and only 1/R is left of that bound; else a step is too narrow by up to d on either
   side, and a peak too low by up to d/2 times its slopes. */
#include "surface/crest.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "surface/crest_piece.h"

enum { STEPS_MOST = 80 };
enum {
    FROM,
    AT,
    HEIGHT,
    RAISED,
    SIEVED
}; /* of an arc: where it comes up, m from the first place on; its middle, in pitches; z, m; the same with its margin */

#define NEAR 1e-6 /* of half a piece, as in crest_piece.c */

struct crest {
    struct crest_disc disc;
    double pitch, reach; /* m: R and half a piece */
    struct crest_ground ground;
    long n, most;      /* stretches; places */
    double *arcs;      /* [most][SIEVED] */
    double *stretches; /* [most][CREST_NUMBERS]; while they are found, places are from the first one on */
};

struct crest *crest_make(struct arena *a, double radius, double pitch, long most)
{
    struct crest *c = ARENA_TAKE(a, struct crest, 1);
    *c = (struct crest){.disc = crest_piece_disc(radius, 0),
                        .pitch = pitch,
                        .most = most,
                        .arcs = ARENA_TAKE(a, double, most *SIEVED),
                        .stretches = ARENA_TAKE(a, double, most *CREST_NUMBERS)};
    return c;
}

/* ------------------------------------------------------------------ arcs */

/* Where the arc of middle i and height zi gives way to that of middle j > i and height zj, m from the first place on.
 */
static double arcs_cross(const struct crest *c, double i, double zi, double j, double zj)
{
    double r = c->disc.radius, d = (j - i) * c->pitch, h = zj - zi, q = d * d + h * h,
           middle = 0.5 * (i + j) * c->pitch;
    if (q <= 2 * r * d) return middle - h * sqrt(r * r / q - 0.25);
    if (d > 2 * r) return middle;
    return h > 0 ? j * c->pitch - r : i * c->pitch + r;
}

static struct crest_jet ground_jet(const struct crest_ground *g, long i)
{
    return (struct crest_jet){g->z[i], g->slope[i], g->bend[i]};
}

/* Of the piece from place i on, or point i. */
static void sieve_arc(const struct crest *c, long i, double *arc)
{
    const struct crest_ground *g = &c->ground;
    double w = c->disc.half;
    arc[AT] = (double)i;
    arc[HEIGHT] = arc[RAISED] = g->z[i];
    if (w == 0) return;
    struct crest_jet a = ground_jet(g, i), b = ground_jet(g, i + 1);
    arc[AT] += 0.5;
    arc[HEIGHT] = 0.5 * (a.z + b.z) + w * (5 * (a.slope - b.slope) + w * (a.bend + b.bend)) / 16;
    arc[RAISED] = arc[HEIGHT] + crest_piece_margin(&c->disc, &a, &b);
}

/* How many arcs are left. */
static long sieve(struct crest *c, long n)
{
    double *top = c->arcs, arc[SIEVED];
    sieve_arc(c, 0, top);
    top[FROM] = -HUGE_VAL;
    for (long j = 1; j < n; j++) {
        sieve_arc(c, j, arc);
        while (arcs_cross(c, top[AT], top[RAISED], arc[AT], arc[HEIGHT]) <= top[FROM])
            top -= SIEVED;
        arc[FROM] = arcs_cross(c, top[AT], top[HEIGHT], arc[AT], arc[RAISED]);
        top += SIEVED;
        memcpy(top, arc, sizeof arc);
    }
    return (top - c->arcs) / SIEVED + 1;
}

/* ------------------------------------------------------------------ stretches */

/* Of the disc on a stretch's piece; out of reach: a height of -HUGE_VAL. */
static struct crest_jet stretch_rest(const struct crest *c, const double *s, double x)
{
    double y = x - s[CREST_AT];
    return fabs(y) <= c->reach ? crest_piece_rest(&c->disc, s + CREST_PIECE, y) : (struct crest_jet){-HUGE_VAL, 0, 0};
}

/* Where `left` gives way to `right`, between low, where it has not yet, and the end of its reach. */
static double stretches_cross(const struct crest *c, const double *left, const double *right, double x)
{
    double low = fmax(left[CREST_FROM], right[CREST_AT] - c->reach), high = left[CREST_AT] + c->reach;
    if (low >= high) return low;
    if (stretch_rest(c, right, low).z >= stretch_rest(c, left, low).z) return low;
    if (stretch_rest(c, right, high).z <= stretch_rest(c, left, high).z) return high;
    x = x > low && x < high ? x : 0.5 * (low + high);
    for (int i = 0; i < STEPS_MOST; i++) {
        struct crest_jet l = stretch_rest(c, left, x), r = stretch_rest(c, right, x);
        double before = x;
        low = r.z < l.z ? x : low;
        high = r.z < l.z ? high : x;
        x -= (r.z - l.z) / (r.slope - l.slope);
        x = x > low && x < high ? x : r.z == l.z ? before : 0.5 * (low + high);
        if (fabs(x - before) < NEAR * c->disc.half) break;
    }
    return x;
}

/* Does the piece on the right of place i go on from that on the left as the disc does? Then *x, from the first place
 * on, is where it rests on it. */
static bool stretch_goes_on(const struct crest *c, const double *left, const double *right, double *x)
{
    long i = lrint(right[CREST_AT] / c->pitch - 0.5);
    double slope = c->ground.slope[i];
    *x = (double)i * c->pitch + crest_piece_centre(&c->disc, slope);
    return right[CREST_AT] - left[CREST_AT] < 1.5 * c->pitch && crest_piece_open(&c->disc, slope, c->ground.bend[i]);
}

/* Where the next stretch rises from behind `top`; at most top[CREST_FROM] where it hides that. */
static double stretch_rises(const struct crest *c, const double *top, const double *next, const double *arc)
{
    double x, from = top[CREST_FROM];
    if (stretch_goes_on(c, top, next, &x)) return x;
    if (from > -HUGE_VAL && stretch_rest(c, next, from).z >= stretch_rest(c, top, from).z) return from;
    x = arcs_cross(c, top[CREST_AT] / c->pitch, top[CREST_PIECE], arc[AT], next[CREST_PIECE]);
    return stretches_cross(c, top, next, x);
}

static void stretch_make(const struct crest *c, const double *arc, double *s)
{
    long i = lrint(arc[AT] - 0.5);
    struct crest_jet a = ground_jet(&c->ground, i), b = ground_jet(&c->ground, i + 1);
    s[CREST_FROM] = -HUGE_VAL;
    s[CREST_AT] = arc[AT] * c->pitch;
    crest_piece_make(&c->disc, &a, &b, s + CREST_PIECE);
}

static void stretches_of_pieces(struct crest *c, long n)
{
    double *top = c->stretches, next[CREST_NUMBERS];
    stretch_make(c, c->arcs, top);
    for (const double *arc = c->arcs + SIEVED; arc < c->arcs + n * SIEVED; arc += SIEVED) {
        stretch_make(c, arc, next);
        while ((next[CREST_FROM] = stretch_rises(c, top, next, arc)) <= top[CREST_FROM])
            top -= CREST_NUMBERS;
        top += CREST_NUMBERS;
        memcpy(top, next, sizeof next);
    }
    c->n = (top - c->stretches) / CREST_NUMBERS + 1;
}

static void stretches_of_points(struct crest *c, long n)
{
    for (long i = 0; i < n; i++) {
        const double *arc = c->arcs + i * SIEVED;
        double *s = c->stretches + i * CREST_NUMBERS;
        s[CREST_FROM] = arc[FROM];
        s[CREST_AT] = arc[AT];
        s[CREST_PIECE] = arc[HEIGHT];
    }
    c->n = n;
}

void crest_set(struct crest *c, const struct crest_ground *g, long n, long first)
{
    c->ground = *g;
    c->disc = crest_piece_disc(c->disc.radius, g->slope ? 0.5 * c->pitch : 0);
    c->reach = c->disc.radius + c->disc.half;
    if (g->slope)
        stretches_of_pieces(c, sieve(c, n - 1));
    else
        stretches_of_points(c, sieve(c, n));
    for (double *s = c->stretches, *end = s + c->n * CREST_NUMBERS; s < end; s += CREST_NUMBERS) {
        s[CREST_FROM] += (double)first * c->pitch;
        s[CREST_AT] = g->slope ? (double)first * c->pitch + s[CREST_AT] : ((double)first + s[CREST_AT]) * c->pitch;
    }
}

/* ------------------------------------------------------------------ reading */

long crest_find(const double *stretches, long n, long hint, double x)
{
    long low = hint, high = hint + 1;
    if (stretches[hint * CREST_NUMBERS + CREST_FROM] > x) {
        low = 0;
        high = hint;
    }
    for (long step = 1; high < n && stretches[high * CREST_NUMBERS + CREST_FROM] <= x; step *= 2) {
        low = high;
        high += step;
    }
    high = high < n ? high : n;
    while (high - low > 1) {
        long middle = low + (high - low) / 2;
        if (stretches[middle * CREST_NUMBERS + CREST_FROM] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

long crest_between(const struct crest *c, double from, double to, const double **first)
{
    long at = crest_find(c->stretches, c->n, 0, from), end = crest_find(c->stretches, c->n, at, to) + 1;
    *first = c->stretches + at * CREST_NUMBERS;
    return end - at;
}

void crest_at(const struct crest *c, size_t m, const double *x, double *e, double *slope)
{
    long at = 0;
    for (size_t k = 0; k < m; k++) {
        at = crest_find(c->stretches, c->n, at, x[k]);
        const double *s = c->stretches + at * CREST_NUMBERS;
        struct crest_jet j = crest_piece_rest(&c->disc, s + CREST_PIECE, x[k] - s[CREST_AT]);
        e[k] = j.z;
        if (slope) slope[k] = j.slope;
    }
}
