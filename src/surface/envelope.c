/* See envelope.h. The ball is the sphere itself, not the paraboloid that touches it: its cap is

     cap(d) = sqrt(R^2 - d^2) - R = -d^2 / (R + sqrt(R^2 - d^2))  <=  -d^2 / (2 R)

   Each square of heights is held with the largest of every 4 x 4, 16 x 16 and 64 x 64 of them, its nodes. A square of
   points keeps a list of nodes that may bear the ball somewhere in it: at first all of 64 x 64 within reach, then the
   parts of those of the list, for a part of the points. A node goes if, with the paraboloid's cap at its nearest
   corner, it is below what a height that is known bears at the farthest of the points. Points and nodes get smaller in
   turn, so that what is far away is left out for many points at once; at one point the heights that are left are tried
   with the sphere's cap.

   The result is the largest of the same numbers in any order: it does not depend on how the search went. What bounds is
   worked out by the same steps as what it bounds, which rounding keeps in order, and the paraboloid is loosened by
   1e-14; so rounding leaves nothing out. */
#include "surface/envelope.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "surface/block_cache.h"

enum { SIDE = ENVELOPE_HEIGHTS, ROW = 4, PARTS = ROW * ROW, LEVELS = 4, MOST = 1024, SQUARES_LEAST = 512 };

/* Of each level, heights first: samples of a node's side; where its nodes begin in a square's numbers, the parts of a
 * node side by side. */
static const double spans[LEVELS] = {1, 4, 16, 64};
static const int starts[LEVELS] = {0, SIDE *SIDE, SIDE *SIDE + 256, SIDE *SIDE + 272};
enum { NUMBERS = SIDE * SIDE + 273 };

/* Nodes of one level. */
struct list {
    _Alignas(64) double x[MOST], y[MOST], most[MOST]; /* the first height's place, in samples; the largest, m */
    const double *square[MOST];                       /* the numbers it lies in, and which of its level it is */
    int nth[MOST];
    long n;
};

struct envelope {
    double radius, square, unit, cap; /* R, R^2, pitch^2; what the paraboloid's cap takes at one sample's distance, m */
    long reach, finer, across;        /* across: squares of heights on a side */
    envelope_heights *heights;
    void *self;
    struct block_cache *squares; /* of NUMBERS */
    struct list lists[LEVELS];
    int nested[SIDE / ROW * SIDE / ROW]; /* of each 4 x 4 heights, row by row: which node of a square they are */
    int points[LEVELS];                  /* of a side of the squares for which a level's nodes are looked through */
    double *best;                        /* of the square's points: the highest so far */
    long (*places)[2];                   /* the height that reaches it */
    long first[2];                       /* the square's first point, in samples */
    double seed[3];                      /* the height that was touched last: its place, in samples, and itself, m */
};

/* Points of a part of the square: which they are, and where the first and last lie, in samples. */
struct part {
    int column, row, n;
    double low[2], high[2];
};

static struct part part_make(const struct envelope *e, int column, int row, int n)
{
    struct part p = {column, row, n, {0}, {0}};
    int at[2] = {column, row};
    for (int k = 0; k < 2; k++) {
        p.low[k] = (double)(e->first[k] + at[k] * e->finer);
        p.high[k] = (double)(e->first[k] + (at[k] + n - 1) * e->finer);
    }
    return p;
}

/* ------------------------------------------------------------------ squares of heights */

/* Where the node of 4 x 4 heights of row and column lies among those of a square: parts of one node side by side, of
 * these the same. */
static int nested(int row, int column)
{
    return (row / ROW * ROW + column / ROW) * PARTS + row % ROW * ROW + column % ROW;
}

/* The largest of each PARTS of n x PARTS heights. */
LANES_CLONES
static void most_put(const double *of, int n, double *out)
{
    for (int i = 0; i < n; i++, of += PARTS) {
        double most[LANES];
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            most[l] = lanes_select(of[l + LANES] > of[l], of[l + LANES], of[l]);
        for (int half = LANES / 2; half > 0; half /= 2)
            for (int l = 0; l < half; l++)
                most[l] = lanes_select(most[l + half] > most[l], most[l + half], most[l]);
        out[i] = most[0];
    }
}

static void square_fill(void *self, long column, long row, double *out)
{
    const struct envelope *e = self;
    double z[SIDE * SIDE];
    e->heights(e->self, column, row, z);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i += ROW)
            memcpy(out + e->nested[j / ROW * (SIDE / ROW) + i / ROW] * PARTS + j % ROW * ROW, z + j * SIDE + i,
                   ROW * sizeof *z);
    for (int level = 1; level < LEVELS; level++)
        most_put(out + starts[level - 1], (level + 1 < LEVELS ? starts[level + 1] : NUMBERS) - starts[level],
                 out + starts[level]);
}

long envelope_side(long reach, long finer) { return (ENVELOPE_POINTS - 1) * finer + 1 + 2 * reach; }

/* Squares held: all that a square of points looks at, and as much again. */
struct envelope *envelope_make(struct arena *a, double radius, double pitch, long reach, long finer,
                               envelope_heights *heights, void *self)
{
    struct envelope *e = ARENA_TAKE(a, struct envelope, 1);
    *e = (struct envelope){.radius = radius,
                           .square = radius * radius,
                           .unit = pitch * pitch,
                           .cap = (1 - 1e-14) * pitch * pitch / (2 * radius),
                           .reach = reach,
                           .finer = finer,
                           .across = envelope_side(reach, finer) / SIDE + 2,
                           .heights = heights,
                           .self = self};
    for (int k = 0; k < SIDE / ROW * SIDE / ROW; k++)
        e->nested[k] = nested(k / (SIDE / ROW), k % (SIDE / ROW));
    e->points[0] = e->points[1] = 1;
    for (int level = 2; level < LEVELS; level++) {
        e->points[level] = ENVELOPE_POINTS;
        while (e->points[level] > 1 && (double)(e->points[level] * finer) > spans[level] / 2)
            e->points[level] /= 2;
    }
    size_t needed = 2 * (size_t)(e->across * e->across);
    e->squares = block_cache_make(a, NUMBERS, needed > SQUARES_LEAST ? needed : SQUARES_LEAST, square_fill, e);
    return e;
}

/* ------------------------------------------------------------------ what a node bears */

/* How far `at` to `at` + span, in samples, is from low to high, at the nearest. */
static inline __attribute__((always_inline)) double apart(double at, double last, double low, double high)
{
    double after = at - high, before = low - (at + last);
    return lanes_select(after > 0, after, lanes_select(before > 0, before, 0));
}

/* Of each LANES of n nodes those that may bear at least so much somewhere in the part, as bits. The last group must be
 * filled up with what bears nothing (list_end). */
LANES_CLONES
static void nodes_bear(const struct envelope *e, const struct part *p, double last, long n, const double *x,
                       const double *y, const double *most, double least, unsigned char *marks)
{
    static const double bits[LANES] = {1, 2, 4, 8, 16, 32, 64, 128};
    double left = p->low[0], right = p->high[0], below = p->low[1], above = p->high[1], cap = e->cap, found[LANES];
    for (long i = 0; i < n; i += LANES) {
#pragma omp simd
        for (long l = 0; l < LANES; l++) {
            double dx = apart(x[i + l], last, left, right), dy = apart(y[i + l], last, below, above);
            found[l] = lanes_select(most[i + l] - (dx * dx + dy * dy) * cap >= least, bits[l], 0);
        }
        marks[i / LANES] = (unsigned char)lanes_total(found);
    }
}

/* The same of the ROW x ROW parts of one node, `span` wide each. */
LANES_CLONES
static unsigned parts_bear(const struct envelope *e, const struct part *p, double x, double y, double span,
                           const double *most, double least)
{
    static const double nth[ROW] = {0, 1, 2, 3},
                        bits[PARTS] = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
    double dx[ROW], dy[ROW], found[ROW] = {0}, cap = e->cap;
    double left = p->low[0], right = p->high[0], below = p->low[1], above = p->high[1];
#pragma omp simd
    for (int k = 0; k < ROW; k++) {
        double h = apart(x + nth[k] * span, span - 1, left, right),
               v = apart(y + nth[k] * span, span - 1, below, above);
        dx[k] = h * h;
        dy[k] = v * v;
    }
    for (int j = 0; j < ROW; j++) {
#pragma omp simd
        for (int i = 0; i < ROW; i++)
            found[i] += lanes_select(most[j * ROW + i] - (dx[i] + dy[j]) * cap >= least, bits[j * ROW + i], 0);
    }
    return (unsigned)((found[0] + found[1]) + (found[2] + found[3]));
}

/* What each of n heights bears at a point, and the most of these; the last group is filled up in the same way. */
LANES_CLONES
static double heights_bear(const struct envelope *e, const struct part *p, long n, const double *x, const double *y,
                           const double *z, double *reached)
{
    double column = p->low[0], row = p->low[1], most[LANES], all = -HUGE_VAL;
    for (int l = 0; l < LANES; l++)
        most[l] = -HUGE_VAL;
    for (long i = 0; i < n; i += LANES) {
#pragma omp simd
        for (long l = 0; l < LANES; l++) {
            double dx = x[i + l] - column, dy = y[i + l] - row, square = (dx * dx + dy * dy) * e->unit;
            int within = square <= e->square;
            double s = sqrt(lanes_select(within, e->square - square, 0)),
                   bears = lanes_select(within, z[i + l] - square / (e->radius + s), -HUGE_VAL);
            reached[i + l] = bears;
            most[l] = lanes_select(bears > most[l], bears, most[l]);
        }
    }
    for (int l = 0; l < LANES; l++)
        all = most[l] > all ? most[l] : all;
    return all;
}

/* What a height bears at the farthest of the part's points; -HUGE_VAL: some of them are out of its radius. */
static double bears(const struct envelope *e, const struct part *p, double x, double y, double z)
{
    double dx = fmax(fabs(x - p->low[0]), fabs(x - p->high[0])), dy = fmax(fabs(y - p->low[1]), fabs(y - p->high[1])),
           square = (dx * dx + dy * dy) * e->unit;
    return square <= e->square ? z - square / (e->radius + sqrt(e->square - square)) : -HUGE_VAL;
}

/* What each of a node's PARTS, `span` wide, bears at a point at most, were all of it as high as its highest place. */
LANES_CLONES
static int best_part(const struct envelope *e, double dx, double dy, double span, const double *most)
{
    static const double nth[PARTS] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3},
                        row[PARTS] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    double bears[PARTS], cap = e->cap;
#pragma omp simd
    for (int k = 0; k < PARTS; k++) {
        double x = dx + nth[k] * span, y = dy + row[k] * span;
        bears[k] = most[k] - (x * x + y * y) * cap;
    }
    int best = 0;
    for (int k = 1; k < PARTS; k++)
        best = bears[k] > bears[best] ? k : best;
    return best;
}

/* A height that may bear much in the middle of the part: in one of the nodes that are marked, which are of a list's
   level, the best one's best part, and so on. It is the seed then, if it does bear more there than that. */
static void seed(struct envelope *e, const struct part *p, const struct list *l, int level, const unsigned char *marks)
{
    double middle[2] = {0.5 * (p->low[0] + p->high[0]), 0.5 * (p->low[1] + p->high[1])},
           half = 0.5 * (spans[level] - 1);
    double high = -HUGE_VAL;
    long best = -1;
    for (long first = 0; first < l->n; first += LANES)
        for (unsigned some = marks[first / LANES]; some; some &= some - 1) {
            long i = first + __builtin_ctz(some);
            double dx = l->x[i] + half - middle[0], dy = l->y[i] + half - middle[1],
                   b = l->most[i] - (dx * dx + dy * dy) * e->cap;
            if (b > high) high = b, best = i;
        }
    if (best < 0) return;
    double x = l->x[best], y = l->y[best], z = l->most[best];
    for (int nth = l->nth[best]; level > 0; level--) {
        double span = spans[level - 1];
        half = 0.5 * (span - 1);
        const double *most = l->square[best] + starts[level - 1] + nth * PARTS;
        int k = best_part(e, x + half - middle[0], y + half - middle[1], span, most);
        x += k % ROW * span;
        y += (double)(k / ROW) * span;
        z = most[k];
        nth = nth * PARTS + k;
    }
    if (bears(e, p, x, y, z) > bears(e, p, e->seed[0], e->seed[1], e->seed[2]))
        e->seed[0] = x, e->seed[1] = y, e->seed[2] = z;
}

/* ------------------------------------------------------------------ the search */

/* Of two that reach alike the first row's and column's counts: where the ball touches depends on nothing else. */
static void point_try(struct envelope *e, const struct part *p, const struct list *l)
{
    double reached[MOST];
    long at = p->row * ENVELOPE_POINTS + p->column, *place = e->places[at];
    double most = heights_bear(e, p, l->n, l->x, l->y, l->most, reached);
    if (most < e->best[at]) return;
    for (long i = 0; i < l->n; i++) {
        if (reached[i] != most) continue;
        long x = (long)l->x[i], y = (long)l->y[i];
        if (most > e->best[at] || y < place[1] || (y == place[1] && x < place[0])) {
            e->best[at] = most;
            place[0] = x;
            place[1] = y;
            e->seed[0] = l->x[i];
            e->seed[1] = l->y[i];
            e->seed[2] = l->most[i];
        }
    }
}

static void node_put(struct list *l, double x, double y, double most, const double *square, int nth)
{
    l->x[l->n] = x;
    l->y[l->n] = y;
    l->most[l->n] = most;
    l->square[l->n] = square;
    l->nth[l->n++] = nth;
}

/* The last group is filled up with what has no height. */
static void list_end(struct list *l)
{
    for (long i = l->n; i % LANES; i++)
        l->x[i] = l->y[i] = 0, l->most[i] = -HUGE_VAL;
}

static void search(struct envelope *e, const struct part *p, int level, double least);

/* The points part by part, with the nodes of a level that are left for all of them. */
static void search_parts(struct envelope *e, const struct part *p, int level, double least)
{
    if (e->lists[level].n == 0) return;
    list_end(&e->lists[level]);
    for (int row = 0; row < p->n; row += e->points[level])
        for (int column = 0; column < p->n; column += e->points[level]) {
            struct part q = part_make(e, p->column + column, p->row + row, e->points[level]);
            search(e, &q, level, least);
        }
}

/* `least`: what is known to be borne at every point of the part. */
static void search(struct envelope *e, const struct part *p, int level, double least)
{
    const struct list *l = &e->lists[level];
    unsigned char marks[MOST / LANES];
    if (level == 0) {
        point_try(e, p, l);
        return;
    }
    bool fewer =
        level == LEVELS - 1 || e->points[level] < e->points[level + 1]; /* points than the nodes were left for */
    if (fewer) least = fmax(least, bears(e, p, e->seed[0], e->seed[1], e->seed[2]));
    nodes_bear(e, p, spans[level] - 1, l->n, l->x, l->y, l->most, least, marks);
    if (fewer) {
        seed(e, p, l, level, marks);
        least = fmax(least, bears(e, p, e->seed[0], e->seed[1], e->seed[2]));
    }
    struct list *next = &e->lists[level - 1];
    double span = spans[level - 1];
    next->n = 0;
    for (long first = 0; first < l->n; first += LANES)
        for (unsigned some = marks[first / LANES]; some; some &= some - 1) {
            long i = first + __builtin_ctz(some);
            if (next->n > MOST - PARTS) {
                search_parts(e, p, level - 1, least);
                next->n = 0;
            }
            const double *most = l->square[i] + starts[level - 1] + l->nth[i] * PARTS;
            for (unsigned left = parts_bear(e, p, l->x[i], l->y[i], span, most, least); left; left &= left - 1) {
                int k = __builtin_ctz(left);
                node_put(next, l->x[i] + k % ROW * span, l->y[i] + (double)(k / ROW) * span, most[k], l->square[i],
                         l->nth[i] * PARTS + k);
            }
        }
    search_parts(e, p, level - 1, least);
}

void envelope_square(struct envelope *e, long column, long row, double *reached, long (*places)[2])
{
    long first[2] = {column * ENVELOPE_POINTS * e->finer, row * ENVELOPE_POINTS * e->finer}, from[2], to[2];
    struct list *l = &e->lists[LEVELS - 1];
    e->best = reached;
    e->places = places;
    for (int i = 0; i < ENVELOPE_POINTS * ENVELOPE_POINTS; i++)
        reached[i] = -HUGE_VAL;
    for (int k = 0; k < 2; k++) {
        e->first[k] = first[k];
        from[k] = block_cache_index(first[k] - e->reach, SIDE);
        to[k] = block_cache_index(first[k] + (ENVELOPE_POINTS - 1) * e->finer + e->reach, SIDE);
    }
    struct part whole = part_make(e, 0, 0, ENVELOPE_POINTS);
    e->seed[2] = -HUGE_VAL;
    l->n = 0;
    for (long j = from[1]; j <= to[1]; j++)
        for (long i = from[0]; i <= to[0]; i++) {
            const double *square = block_cache_at(e->squares, i, j);
            if (l->n == MOST) {
                search_parts(e, &whole, LEVELS - 1, -DBL_MAX);
                l->n = 0;
            }
            node_put(l, (double)(i * SIDE), (double)(j * SIDE), square[starts[LEVELS - 1]], square, 0);
        }
    search_parts(e, &whole, LEVELS - 1, -DBL_MAX);
}
