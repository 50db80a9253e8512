#include "surface/rolling_envelope.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/stopwatch.h"
#include "surface/block_cache.h"

#define INLINE static inline __attribute__((always_inline))

enum { REST_STEPS = 60 };

/* ------------------------------------------------------------------ a disc on one piece */

/* Ground between two places where height, slope and bend are known is the polynomial of fifth degree
   that has them: off by (2 half)^6 / 46080 of the sixth derivative; of a cubic spline whose knots are among the places,
   exact.

   A disc of radius R whose centre is at y rests on the place t where z(t) + sqrt(R^2 - (y - t)^2) is largest. There its
   slope is the ground's, p:

     y = t - R p / sqrt(1 + p^2)

   which rises with t where the bend z'' < (1 + p^2)^1.5 / R: elsewhere the ground is too hollow for the disc, which
   touches at a piece's end if at all. The equation is solved by Newton's method between an end and the middle,
   whichever side it points to. */

#define REST_NEAR                                                                                                      \
    1e-7 /* of half a piece: the step after which Newton's method is at its end, the next being its square */

struct disc rolling_envelope_disc(double radius, double half)
{
    double over = half > 0 ? 1 / half : 0;
    return (struct disc){radius, half, over, radius * over};
}

void rolling_envelope_terms(const struct disc *d, const struct height_jet *a, const struct height_jet *b,
                            double terms[ENVELOPE_TERMS])
{
    double w = d->half, even = 0.5 * (a->z + b->z), odd = 0.5 * (b->z - a->z);
    double even_1 = 0.5 * w * (b->slope - a->slope), odd_1 = 0.5 * w * (a->slope + b->slope);
    double even_2 = 0.5 * w * w * (a->bend + b->bend), odd_2 = 0.5 * w * w * (b->bend - a->bend);
    terms[4] = (even_2 - even_1) / 8;
    terms[2] = (even_1 - 4 * terms[4]) / 2;
    terms[0] = even - terms[2] - terms[4];
    terms[5] = (odd_2 - 3 * (odd_1 - odd)) / 8;
    terms[3] = (odd_1 - odd - 4 * terms[5]) / 2;
    terms[1] = odd - terms[3] - terms[5];
}

static double disc_centre(const struct disc *d, double slope) { return -d->radius * slope / sqrt(1 + slope * slope); }

static int disc_open(const struct disc *d, double slope, double bend)
{
    double square = 1 + slope * slope;
    return d->radius * bend < square * sqrt(square);
}

static double disc_margin(const struct disc *d, const struct height_jet *a, const struct height_jet *b)
{
    double steep = fmax(a->slope * a->slope, b->slope * b->slope), bend = -1.5 * fmin(fmin(a->bend, b->bend), 0);
    return 0.5 * d->half * d->half * (bend + 1.5 * (1 + steep) * sqrt(1 + steep) / d->radius);
}

/* ------------------------------------------------------------------ one disc, or eight at a time */

/* With selections in place of branches: a disc that has found its place stays there while others still look. Newton's
   method is a chain of roots and divisions, 370 cycles a place one at a time; eight at a time it is 110 a place
   (AVX-512). n, of discs, is 1 or LANES. */

struct search {
    _Alignas(64) double q[LANES], off[LANES], falls[LANES], low[LANES], high[LANES];
    double y[LANES];    /* in half pieces */
    double open[LANES]; /* 1: still looking; 0: q is found */
};

INLINE double slope_at(const struct rest_lanes *at, int l, double q)
{
    return at->terms[1][l] +
           q * (2 * at->terms[2][l] + q * (3 * at->terms[3][l] + q * (4 * at->terms[4][l] + q * 5 * at->terms[5][l])));
}

INLINE double bend_at(const struct rest_lanes *at, int l, double q)
{
    return 2 * at->terms[2][l] + q * (6 * at->terms[3][l] + q * (12 * at->terms[4][l] + q * 20 * at->terms[5][l]));
}

INLINE double off_at(const struct disc *d, const struct rest_lanes *at, int l, double y, double q, double *falls)
{
    double p = slope_at(at, l, q) * d->over, one = 1 / sqrt(1 + p * p), far = d->tall * one;
    *falls = 1 - far * one * one * bend_at(at, l, q) * d->over;
    return y - q + far * p;
}

/* Where the search begins: at an end it is over at once. */
INLINE void begin(const struct disc *d, const struct rest_lanes *at, struct search *s, int n)
{
#pragma omp simd
    for (int l = 0; l < n; l++) {
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
INLINE double move(struct search *s, int n)
{
    double looking = 0;
#pragma omp simd reduction(+ : looking)
    for (int l = 0; l < n; l++) {
        double off = s->off[l], before = s->q[l], falls = s->falls[l], next = before + off / falls;
        double low = lanes_select(off > 0, before, s->low[l]), high = lanes_select(off > 0, s->high[l], before);
        double q = lanes_select((falls > 0) & (next >= low) & (next <= high), next, 0.5 * (low + high));
        double open = s->open[l];
        q = lanes_select(open > 0, q, before);
        open = lanes_select(fabs(q - before) < REST_NEAR, 0, open);
        s->q[l] = q;
        s->low[l] = low;
        s->high[l] = high;
        s->open[l] = open;
        looking += open;
    }
    return looking;
}

INLINE void look(const struct disc *d, const struct rest_lanes *at, struct search *s, int n)
{
#pragma omp simd
    for (int l = 0; l < n; l++) {
        double falls;
        s->off[l] = off_at(d, at, l, s->y[l], s->q[l], &falls);
        s->falls[l] = falls;
    }
}

/* The second derivative is R^2/s^3 z'' / (R^2/s^3 - z''), and that of the circle where the disc turns about an end. */
INLINE void rest(const struct disc *d, struct rest_lanes *at, const struct search *s, int n)
{
#pragma omp simd
    for (int l = 0; l < n; l++) {
        double q = s->q[l], u = at->y[l] - q * d->half, square = (d->radius - u) * (d->radius + u);
        int off = square > 0, inside = fabs(q) < 1; /* off the rim, where the slope is infinite */
        double side = sqrt(lanes_select(off, square, 1)), arc = d->radius * d->radius / (side * side * side);
        double z = at->terms[0][l] +
                   q * (at->terms[1][l] +
                        q * (at->terms[2][l] + q * (at->terms[3][l] + q * (at->terms[4][l] + q * at->terms[5][l]))));
        double bend = lanes_select(inside, bend_at(at, l, q) * d->over * d->over, 0);
        at->z[l] = z - u * u / (d->radius + lanes_select(off, side, 0));
        at->slope[l] = lanes_select(off, -u / side, lanes_select(u > 0, -HUGE_VAL, HUGE_VAL));
        at->bend[l] = lanes_select(off, lanes_select(inside, arc * bend / (arc - bend), -arc), -HUGE_VAL);
    }
}

INLINE void rest_some(const struct disc *d, struct rest_lanes *at, int n)
{
    struct search s;
    begin(d, at, &s, n);
    for (int i = 0; i < REST_STEPS && move(&s, n) > 0; i++)
        look(d, at, &s, n);
    rest(d, at, &s, n);
}

LANES_CLONES
void rolling_envelope_rest_lanes(const struct disc *d, struct rest_lanes *at) { rest_some(d, at, LANES); }

struct height_jet rolling_envelope_rest(const struct disc *d, const double terms[ENVELOPE_TERMS], double y)
{
    struct rest_lanes at;
    if (d->half == 0) { /* the disc turns about a point */
        double square = (d->radius - y) * (d->radius + y), s = square > 0 ? sqrt(square) : 0;
        return (struct height_jet){terms[0] - y * y / (d->radius + s), -y / s, -(d->radius * d->radius / (s * s * s))};
    }
    for (int k = 0; k < ENVELOPE_TERMS; k++)
        at.terms[k][0] = terms[k];
    at.y[0] = y;
    rest_some(d, &at, 1);
    return (struct height_jet){at.z[0], at.slope[0], at.bend[0]};
}

/* ------------------------------------------------------------------ the envelope */

/* Two sets of ground, one wholly on the left of the other, give two envelopes of which the left one is the
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
   the disc may rest higher between its piece's ends (disc_margin), it is still under those of two others. Of
   ground that is points alone this is, with nothing to raise by, the envelope itself.

   Errors. Those of the polynomials, of sixth order in the pitch d; switches and heights to rounding. Of points alone:
   the largest of their arcs to rounding, and what the disc meets between is missed: E is too low by at most d^2/8 (1/R
   + |z''|) at the places of contact. Of ground with kinks (straight lines, steps) they are among the points if their
   pitch is a whole multiple of d, and only 1/R is left of that bound; else a step is too narrow by up to d on either
   side, and a peak too low by up to d/2 times its slopes. */

enum { SWITCH_STEPS = 80 };
enum {
    FROM,
    AT,
    HEIGHT,
    RAISED,
    SIEVED
}; /* of an arc: where it comes up, m from the first place on; its middle, in pitches; z, m; the same with its margin */

#define SWITCH_NEAR 1e-6 /* of half a piece, as REST_NEAR */

struct rolling_envelope {
    struct disc disc;
    double pitch, reach; /* m: R and half a piece */
    struct envelope_ground ground;
    long n, most;      /* stretches; places */
    double *arcs;      /* [most][SIEVED] */
    double *stretches; /* [most][STRETCH_NUMBERS]; while they are found, places are from the first one on */
};

struct rolling_envelope *rolling_envelope_make(struct arena *a, double radius, double pitch, long most)
{
    struct rolling_envelope *c = ARENA_TAKE(a, struct rolling_envelope, 1);
    *c = (struct rolling_envelope){.disc = rolling_envelope_disc(radius, 0),
                                   .pitch = pitch,
                                   .most = most,
                                   .arcs = ARENA_TAKE(a, double, most *SIEVED),
                                   .stretches = ARENA_TAKE(a, double, most *STRETCH_NUMBERS)};
    return c;
}

/* ------------------------------------------------------------------ arcs */

/* Where the arc of middle i and height zi gives way to that of middle j > i and height zj, m from the first place on.
 */
static double arcs_cross(const struct rolling_envelope *c, double i, double zi, double j, double zj)
{
    double r = c->disc.radius, d = (j - i) * c->pitch, h = zj - zi, q = d * d + h * h,
           middle = 0.5 * (i + j) * c->pitch;
    if (q <= 2 * r * d) return middle - h * sqrt(r * r / q - 0.25);
    if (d > 2 * r) return middle;
    return h > 0 ? j * c->pitch - r : i * c->pitch + r;
}

static struct height_jet ground_jet(const struct envelope_ground *g, long i)
{
    return (struct height_jet){g->z[i], g->slope[i], g->bend[i]};
}

/* Of the piece from place i on, or point i. */
static void sieve_arc(const struct rolling_envelope *c, long i, double *arc)
{
    const struct envelope_ground *g = &c->ground;
    double w = c->disc.half;
    arc[AT] = (double)i;
    arc[HEIGHT] = arc[RAISED] = g->z[i];
    if (w == 0) return;
    struct height_jet a = ground_jet(g, i), b = ground_jet(g, i + 1);
    arc[AT] += 0.5;
    arc[HEIGHT] = 0.5 * (a.z + b.z) + w * (5 * (a.slope - b.slope) + w * (a.bend + b.bend)) / 16;
    arc[RAISED] = arc[HEIGHT] + disc_margin(&c->disc, &a, &b);
}

/* How many arcs are left. */
static long sieve(struct rolling_envelope *c, long n)
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

/* Predicted cycles: of the disc at rest at a place, which takes Newton's method, and of a piece of ground. */
#define REST 620.0
#define PIECE 60.0

/* Of the disc on a stretch's piece; out of reach: a height of -HUGE_VAL. */
static struct height_jet stretch_rest(const struct rolling_envelope *c, const double *s, double x)
{
    double y = x - s[STRETCH_AT];
    stopwatch_spend(REST);
    return fabs(y) <= c->reach ? rolling_envelope_rest(&c->disc, s + STRETCH_TERMS, y)
                               : (struct height_jet){-HUGE_VAL, 0, 0};
}

/* Where `left` gives way to `right`, between low, where it has not yet, and the end of its reach. */
static double stretches_cross(const struct rolling_envelope *c, const double *left, const double *right, double x)
{
    double low = fmax(left[STRETCH_FROM], right[STRETCH_AT] - c->reach), high = left[STRETCH_AT] + c->reach;
    if (low >= high) return low;
    if (stretch_rest(c, right, low).z >= stretch_rest(c, left, low).z) return low;
    if (stretch_rest(c, right, high).z <= stretch_rest(c, left, high).z) return high;
    x = x > low && x < high ? x : 0.5 * (low + high);
    for (int i = 0; i < SWITCH_STEPS; i++) {
        struct height_jet l = stretch_rest(c, left, x), r = stretch_rest(c, right, x);
        double before = x;
        low = r.z < l.z ? x : low;
        high = r.z < l.z ? high : x;
        x -= (r.z - l.z) / (r.slope - l.slope);
        x = x > low && x < high ? x : r.z == l.z ? before : 0.5 * (low + high);
        if (fabs(x - before) < SWITCH_NEAR * c->disc.half) break;
    }
    return x;
}

/* Does the piece on the right of place i go on from that on the left as the disc does? Then *x, from the first place
 * on, is where it rests on it. */
static bool stretch_goes_on(const struct rolling_envelope *c, const double *left, const double *right, double *x)
{
    long i = lrint(right[STRETCH_AT] / c->pitch - 0.5);
    double slope = c->ground.slope[i];
    *x = (double)i * c->pitch + disc_centre(&c->disc, slope);
    return right[STRETCH_AT] - left[STRETCH_AT] < 1.5 * c->pitch && disc_open(&c->disc, slope, c->ground.bend[i]);
}

/* Where the next stretch rises from behind `top`; at most top[STRETCH_FROM] where it hides that. */
static double stretch_rises(const struct rolling_envelope *c, const double *top, const double *next, const double *arc)
{
    double x, from = top[STRETCH_FROM];
    if (stretch_goes_on(c, top, next, &x)) return x;
    if (from > -HUGE_VAL && stretch_rest(c, next, from).z >= stretch_rest(c, top, from).z) return from;
    x = arcs_cross(c, top[STRETCH_AT] / c->pitch, top[STRETCH_TERMS], arc[AT], next[STRETCH_TERMS]);
    return stretches_cross(c, top, next, x);
}

static void stretch_make(const struct rolling_envelope *c, const double *arc, double *s)
{
    long i = lrint(arc[AT] - 0.5);
    struct height_jet a = ground_jet(&c->ground, i), b = ground_jet(&c->ground, i + 1);
    s[STRETCH_FROM] = -HUGE_VAL;
    s[STRETCH_AT] = arc[AT] * c->pitch;
    rolling_envelope_terms(&c->disc, &a, &b, s + STRETCH_TERMS);
}

static void stretches_of_pieces(struct rolling_envelope *c, long n)
{
    double *top = c->stretches, next[STRETCH_NUMBERS];
    stretch_make(c, c->arcs, top);
    for (const double *arc = c->arcs + SIEVED; arc < c->arcs + n * SIEVED; arc += SIEVED) {
        stretch_make(c, arc, next);
        while ((next[STRETCH_FROM] = stretch_rises(c, top, next, arc)) <= top[STRETCH_FROM])
            top -= STRETCH_NUMBERS;
        top += STRETCH_NUMBERS;
        memcpy(top, next, sizeof next);
    }
    c->n = (top - c->stretches) / STRETCH_NUMBERS + 1;
}

static void stretches_of_points(struct rolling_envelope *c, long n)
{
    for (long i = 0; i < n; i++) {
        const double *arc = c->arcs + i * SIEVED;
        double *s = c->stretches + i * STRETCH_NUMBERS;
        s[STRETCH_FROM] = arc[FROM];
        s[STRETCH_AT] = arc[AT];
        s[STRETCH_TERMS] = arc[HEIGHT];
    }
    c->n = n;
}

void rolling_envelope_set(struct rolling_envelope *c, const struct envelope_ground *g, long n, long first)
{
    c->ground = *g;
    c->disc = rolling_envelope_disc(c->disc.radius, g->slope ? 0.5 * c->pitch : 0);
    c->reach = c->disc.radius + c->disc.half;
    if (g->slope)
        stretches_of_pieces(c, sieve(c, n - 1));
    else
        stretches_of_points(c, sieve(c, n));
    for (double *s = c->stretches, *end = s + c->n * STRETCH_NUMBERS; s < end; s += STRETCH_NUMBERS) {
        s[STRETCH_FROM] += (double)first * c->pitch;
        s[STRETCH_AT] =
            g->slope ? (double)first * c->pitch + s[STRETCH_AT] : ((double)first + s[STRETCH_AT]) * c->pitch;
    }
}

/* ------------------------------------------------------------------ reading */

static long stretch_find(const double *stretches, long n, long hint, double x)
{
    long low = hint, high = hint + 1;
    if (stretches[hint * STRETCH_NUMBERS + STRETCH_FROM] > x) {
        low = 0;
        high = hint;
    }
    for (long step = 1; high < n && stretches[high * STRETCH_NUMBERS + STRETCH_FROM] <= x; step *= 2) {
        low = high;
        high += step;
    }
    high = high < n ? high : n;
    while (high - low > 1) {
        long middle = low + (high - low) / 2;
        if (stretches[middle * STRETCH_NUMBERS + STRETCH_FROM] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

long rolling_envelope_between(const struct rolling_envelope *c, double from, double to, const double **first)
{
    long at = stretch_find(c->stretches, c->n, 0, from), end = stretch_find(c->stretches, c->n, at, to) + 1;
    *first = c->stretches + at * STRETCH_NUMBERS;
    return end - at;
}

void rolling_envelope_at(const struct rolling_envelope *c, size_t m, const double *x, double *e, double *slope)
{
    long at = 0;
    for (size_t k = 0; k < m; k++) {
        at = stretch_find(c->stretches, c->n, at, x[k]);
        const double *s = c->stretches + at * STRETCH_NUMBERS;
        struct height_jet j = rolling_envelope_rest(&c->disc, s + STRETCH_TERMS, x[k] - s[STRETCH_AT]);
        e[k] = j.z;
        if (slope) slope[k] = j.slope;
    }
}

/* ------------------------------------------------------------------ a part of a relief */

/* Blocks of the envelope lie on a lattice of their own, at least twice as long as the reach, and each
   is made from all the ground within reach of it, so that the ground is looked at twice on average, whatever the
   radius, and the result is a function of the place alone, to the last bit. */

enum { LINE = 1024, READ = 64, BLOCKS_LEAST = 4, BLOCKS_MOST = 512, HEIGHTS_LEAST = 512, KINDS = 3 };

#define NUMBERS_CACHED (1L << 23)

struct underlying {
    const struct relief *under;
    struct rolling_plan plan;
    struct disc disc;
    long reach, side; /* places: as far as the disc looks; in a block of the envelope */
    int kinds;        /* of what is known of a place: its height; slope and bend      */
    double *window;   /* [kinds][places of the window] work */
    struct rolling_envelope *envelope;
    struct block_cache *heights; /* blocks of LINE places, of one kind after the other */
    struct block_cache *blocks;  /* of the envelope: how many stretches, and these */
    long column, hint;           /* the block that was read last, and its stretch */
};

/* n: whole LANES. */
LANES_CLONES
static void span_put(const double *z, long n, double span[2])
{
    double least[LANES], most[LANES];
    memcpy(least, z, sizeof least);
    memcpy(most, z, sizeof most);
    for (long i = LANES; i < n; i += LANES) {
#pragma omp simd
        for (long l = 0; l < LANES; l++) {
            least[l] = lanes_select(z[i + l] < least[l], z[i + l], least[l]);
            most[l] = lanes_select(z[i + l] > most[l], z[i + l], most[l]);
        }
    }
    for (int l = 0; l < LANES; l++) {
        span[0] = fmin(span[0], least[l]);
        span[1] = fmax(span[1], most[l]);
    }
}

void rolling_envelope_watch(struct rolling_plan *p, const double *z, long n)
{
    if (!p->begun) p->read[0] = p->read[1] = z[0];
    p->begun = true;
    span_put(z, n, p->read);
    if (p->warned || !(p->read[1] - p->read[0] > p->span)) return;
    p->warned = true;
    if (p->exceeded) p->exceeded(p->self);
}

static void heights_fill(void *self, long column, long row, double *out)
{
    struct underlying *g = self;
    double x[READ];
    (void)row;
    for (long i = 0; i < LINE; i += READ) {
        for (long k = 0; k < READ; k++)
            x[k] = (double)(column * LINE + i + k) * g->plan.pitch;
        struct relief_values v = {.z = out + i,
                                  .x = g->plan.points ? NULL : out + LINE + i,
                                  .xx = g->plan.points ? NULL : out + 2 * LINE + i};
        relief_at(g->under, &(struct relief_points){READ, x, NULL}, &v);
    }
    rolling_envelope_watch(&g->plan, out, LINE);
}

/* Of the window's stretches, those that come up inside the block and the one that is up where it begins. */
static void blocks_fill(void *self, long column, long row, double *out)
{
    struct underlying *g = self;
    long first = column * g->side - g->reach, n = rolling_envelope_window(&g->plan);
    double from = (double)(column * g->side) * g->plan.pitch, to = (double)((column + 1) * g->side) * g->plan.pitch;
    double *z = g->window;
    const double *found;
    (void)row;
    block_cache_gather(&(struct lattice){g->heights, {LINE, g->kinds}}, (long[]){first, 0}, (long[]){n, g->kinds}, z,
                       n);
    bool points = g->plan.points;
    rolling_envelope_set(g->envelope, &(struct envelope_ground){z, points ? NULL : z + n, points ? NULL : z + 2 * n}, n,
                         first);
    stopwatch_spend(PIECE * (double)n);
    long stretches = rolling_envelope_between(g->envelope, from, to, &found);
    out[0] = (double)stretches;
    memcpy(out + 1, found, (size_t)(stretches * STRETCH_NUMBERS) * sizeof *out);
}

static const double *underlying_stretch(struct underlying *g, double x)
{
    long column = (long)floor(x / ((double)g->side * g->plan.pitch));
    const double *found = block_cache_at(g->blocks, column, 0);
    g->hint = stretch_find(found + 1, (long)found[0], column == g->column ? g->hint : 0, x);
    g->column = column;
    return found + 1 + g->hint * STRETCH_NUMBERS;
}

static void underlying_put(const struct relief_values *v, size_t n, double z, double slope, double bend)
{
    if (v->z) v->z[n] += z;
    if (v->x) v->x[n] += slope;
    if (v->xx) v->xx[n] += bend;
}

/* The last group is filled up with the last place. */
static void underlying_lanes(struct underlying *g, const struct relief_points *p, const struct relief_values *v,
                             size_t from)
{
    struct rest_lanes at;
    size_t n = p->n - from < LANES ? p->n - from : LANES;
    for (size_t l = 0; l < LANES; l++) {
        double x = p->x[l < n ? from + l : p->n - 1];
        const double *s = underlying_stretch(g, x);
        for (int k = 0; k < ENVELOPE_TERMS; k++)
            at.terms[k][l] = s[STRETCH_TERMS + k];
        at.y[l] = x - s[STRETCH_AT];
    }
    rolling_envelope_rest_lanes(&g->disc, &at);
    for (size_t l = 0; l < n; l++)
        underlying_put(v, from + l, at.z[l], at.slope[l], at.bend[l]);
}

static void underlying_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct underlying *g = part->state;
    if (g->disc.half == 0 || p->n < LANES)
        for (size_t n = 0; n < p->n; n++) {
            const double *s = underlying_stretch(g, p->x[n]);
            struct height_jet j = rolling_envelope_rest(&g->disc, s + STRETCH_TERMS, p->x[n] - s[STRETCH_AT]);
            underlying_put(v, n, j.z, j.slope, j.bend);
        }
    else
        for (size_t from = 0; from < p->n; from += LANES)
            underlying_lanes(g, p, v, from);
}

static long plan_reach(const struct rolling_plan *p) { return (long)ceil(p->reach / p->pitch); }

static long plan_side(const struct rolling_plan *p) { return 2 * plan_reach(p) > LINE ? 2 * plan_reach(p) : LINE; }

long rolling_envelope_window(const struct rolling_plan *p) { return plan_side(p) + 2 * plan_reach(p) + 1; }

struct relief_part *rolling_envelope_part(struct arena *a, const struct relief *under, const struct rolling_plan *p)
{
    struct underlying *g = ARENA_TAKE(a, struct underlying, 1);
    long window = rolling_envelope_window(p), size = 1 + window * STRETCH_NUMBERS, blocks = NUMBERS_CACHED / size,
         heights = 2 * (window / LINE + 2);
    *g = (struct underlying){.under = under,
                             .plan = *p,
                             .disc = rolling_envelope_disc(p->radius, p->points ? 0 : 0.5 * p->pitch),
                             .reach = plan_reach(p),
                             .side = plan_side(p),
                             .kinds = p->points ? 1 : KINDS,
                             .envelope = rolling_envelope_make(a, p->radius, p->pitch, window)};
    g->window = ARENA_TAKE(a, double, g->kinds *window);
    blocks = blocks < BLOCKS_LEAST ? BLOCKS_LEAST : blocks > BLOCKS_MOST ? BLOCKS_MOST : blocks;
    g->heights = block_cache_make(a, (size_t)(LINE * g->kinds),
                                  (size_t)(heights > HEIGHTS_LEAST ? heights : HEIGHTS_LEAST), heights_fill, g);
    g->blocks = block_cache_make(a, (size_t)size, (size_t)blocks, blocks_fill, g);
    struct relief_part *part = relief_endless(a, "crest", p->pitch, underlying_add, g);
    part->reading = 150;
    return part;
}
