/* See crest.h. All arcs have one radius. Of two whose centres lie D apart in x and H in height (the right one higher by H),
   q^2 = D^2 + H^2, the left one is the upper one up to

     x = (x_i + x_j) / 2 - H sqrt(R^2/q^2 - 1/4)      for q^2 <= 2 R D

   and the right one from there on: the difference rises over all of the stretch that they share. For q^2 > 2 R D it is a cliff that one of
   them overtops: the switch is then where the right arc begins, x_j - R (H > 0), or the left one ends, x_i + R. So arcs taken from left to
   right make a stack: a new one hides the last while it crosses it no later than that one rises from behind the one before. Each height is
   put down once and taken away at most once.

   In windows. Blocks of the envelope lie on a lattice of their own, at least twice as long as the reach, and each is made from all heights
   within reach of it, so that heights are looked at twice on average, whatever the radius, and the result is a function of the place alone, to
   the last bit.

   Errors. To rounding it is the largest of the arcs: where two come within rounding of each other either may be taken. What the disc meets
   between heights d apart is missed: E is too low by at most d^2/8 (1/R + |z''|) at the places of contact. Of ground with kinks (straight
   lines, steps) they are part of the lattice if their pitch is a whole multiple of d, and only 1/R is left of that bound; else a step is too
   narrow by up to d on either side, and a peak too low by up to d/2 times its slopes. */
#include "surface/crest.h"

#include <math.h>

#include "surface/kept.h"

enum { ARC = 3, LINE = 1024, READ = 64, KEPT_LEAST = 4, KEPT_MOST = 512, HEIGHTS_LEAST = 512 };
enum { FROM, AT, HEIGHT };  /* of an arc: where it comes up, m; its middle, m; z, m */

#define NUMBERS_KEPT (1L << 22)

struct crest {
    double radius, pitch;
    long n;                 /* arcs of the envelope */
    double *arcs;           /* [most][ARC]; while they are found, middles in heights and places from the first height on */
};

struct crest *crest_make(struct arena *a, double radius, double pitch, long most)
{
    struct crest *c = ARENA_TAKE(a, struct crest, 1);
    *c = (struct crest){.radius = radius, .pitch = pitch, .arcs = ARENA_TAKE(a, double, most * ARC)};
    return c;
}

/* Where the arc of middle i gives way to that of middle j > i, m from the first height on. */
static double crossing(const struct crest *c, const double *left, double j, double z)
{
    double i = left[AT], d = (j - i) * c->pitch, h = z - left[HEIGHT], q = d * d + h * h, middle = 0.5 * (i + j) * c->pitch;
    if (q <= 2 * c->radius * d)
        return middle - h * sqrt(c->radius * c->radius / q - 0.25);
    if (d > 2 * c->radius)
        return middle;
    return h > 0 ? j * c->pitch - c->radius : i * c->pitch + c->radius;
}

void crest_set(struct crest *c, const double *z, long n, long first)
{
    double *top = c->arcs, origin = (double)first * c->pitch;
    top[FROM] = -HUGE_VAL;
    top[AT] = 0;
    top[HEIGHT] = z[0];
    for (long j = 1; j < n; j++) {
        double x = crossing(c, top, (double)j, z[j]);
        for (; x <= top[FROM]; x = crossing(c, top, (double)j, z[j]))
            top -= ARC;
        top += ARC;
        top[FROM] = x;
        top[AT] = (double)j;
        top[HEIGHT] = z[j];
    }
    c->n = (top - c->arcs) / ARC + 1;
    for (double *a = c->arcs; a <= top; a += ARC) {
        a[FROM] += origin;
        a[AT] = ((double)first + a[AT]) * c->pitch;
    }
}

/* The last of n arcs that comes up at x or before, looked for from `hint` on. */
static long arc_find(const double *arcs, long n, long hint, double x)
{
    long low = hint, high = hint + 1;
    if (arcs[hint * ARC + FROM] > x) {
        low = 0;
        high = hint;
    }
    for (long step = 1; high < n && arcs[high * ARC + FROM] <= x; step *= 2) {
        low = high;
        high += step;
    }
    high = high < n ? high : n;
    while (high - low > 1) {
        long middle = low + (high - low) / 2;
        if (arcs[middle * ARC + FROM] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Height over the lowest point of the arc's circle: sqrt(R^2 - d^2). At a cliff rounding may put x beyond the arc's end by that much. */
static double arc_upright(double radius, double d)
{
    double square = (radius - d) * (radius + d);
    return square > 0 ? sqrt(square) : 0;
}

void crest_at(const struct crest *c, size_t m, const double *x, double *e, double *slope)
{
    long at = 0;
    for (size_t k = 0; k < m; k++) {
        at = arc_find(c->arcs, c->n, at, x[k]);
        const double *a = c->arcs + at * ARC;
        double d = x[k] - a[AT], s = arc_upright(c->radius, d);
        e[k] = a[HEIGHT] - d * d / (c->radius + s);
        if (slope)
            slope[k] = -d / s;
    }
}

/* ------------------------------------------------------------------ as a part of a relief */

struct bed {
    const struct relief *under;
    struct crest_plan plan;
    bool warned;
    double least, most;
    long reach, side;       /* heights: as far as the disc looks; in a block of the envelope */
    double *window;         /* work */
    struct crest *crest;
    struct kept *heights;   /* blocks of LINE heights */
    struct kept *blocks;    /* of the envelope: how many arcs, and the arcs */
    long column, hint;      /* of the block at hand; its arc that was read last */
    const double *at_hand;  /* NULL: none */
};

static void heights_watch(struct bed *g, const double *z)
{
    for (long i = 0; i < LINE; i++) {
        g->least = z[i] < g->least ? z[i] : g->least;
        g->most = z[i] > g->most ? z[i] : g->most;
    }
    if (!g->warned && g->most - g->least > g->plan.span) {
        g->warned = true;
        if (g->plan.exceeded)
            g->plan.exceeded(g->plan.self);
    }
}

static void heights_fill(void *self, long column, long row, double *out)
{
    struct bed *g = self;
    double x[READ];
    (void)row;
    for (long i = 0; i < LINE; i += READ) {
        for (long k = 0; k < READ; k++)
            x[k] = (double)(column * LINE + i + k) * g->plan.pitch;
        relief_at(g->under, &(struct relief_points){READ, x, NULL}, &(struct relief_values){.z = out + i});
    }
    heights_watch(g, out);
}

static long floor_over(long i, long n)
{
    return i >= 0 ? i / n : -((-i + n - 1) / n);
}

static void heights_gather(struct bed *g, long first, long n)
{
    for (long b = floor_over(first, LINE); b * LINE < first + n; b++) {
        const double *z = kept_at(g->heights, b, 0);
        long from = b * LINE > first ? b * LINE : first, to = (b + 1) * LINE < first + n ? (b + 1) * LINE : first + n;
        for (long i = from; i < to; i++)
            g->window[i - first] = z[i - b * LINE];
    }
}

/* Of the window's arcs, those that come up inside the block and the one that is up where it begins. */
static void blocks_fill(void *self, long column, long row, double *out)
{
    struct bed *g = self;
    long first = column * g->side - g->reach, n = crest_window(&g->plan);
    double from = (double)(column * g->side) * g->plan.pitch, to = (double)((column + 1) * g->side) * g->plan.pitch;
    (void)row;
    heights_gather(g, first, n);
    crest_set(g->crest, g->window, n, first);
    const struct crest *c = g->crest;
    long at = arc_find(c->arcs, c->n, 0, from), end = arc_find(c->arcs, c->n, at, to) + 1;
    out[0] = (double)(end - at);
    for (long k = 0; k < (end - at) * ARC; k++)
        out[1 + k] = c->arcs[at * ARC + k];
}

static const double *bed_arc(struct bed *g, double x)
{
    long column = (long)floor(x / ((double)g->side * g->plan.pitch));
    if (!g->at_hand || column != g->column) {
        g->at_hand = kept_at(g->blocks, column, 0);
        g->column = column;
        g->hint = 0;
    }
    g->hint = arc_find(g->at_hand + 1, (long)g->at_hand[0], g->hint, x);
    return g->at_hand + 1 + g->hint * ARC;
}

static void bed_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct bed *g = part->state;
    double r = g->plan.radius;
    for (size_t n = 0; n < p->n; n++) {
        const double *a = bed_arc(g, p->x[n]);
        double d = p->x[n] - a[AT], s = arc_upright(r, d);
        if (v->z)
            v->z[n] += a[HEIGHT] - d * d / (r + s);
        if (v->x)
            v->x[n] -= d / s;
        if (v->xx)
            v->xx[n] -= r * r / (s * s * s);
    }
}

static long plan_reach(const struct crest_plan *p)
{
    return (long)ceil(p->reach / p->pitch);
}

static long plan_side(const struct crest_plan *p)
{
    return 2 * plan_reach(p) > LINE ? 2 * plan_reach(p) : LINE;
}

long crest_window(const struct crest_plan *p)
{
    return plan_side(p) + 2 * plan_reach(p) + 1;
}

struct relief_part *crest_part(struct arena *a, const struct relief *under, const struct crest_plan *p)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct bed *g = ARENA_TAKE(a, struct bed, 1);
    long window = crest_window(p), size = 1 + window * ARC, blocks = NUMBERS_KEPT / size, heights = 2 * (window / LINE + 2);
    *g = (struct bed){.under = under, .plan = *p, .least = HUGE_VAL, .most = -HUGE_VAL, .reach = plan_reach(p), .side = plan_side(p),
                         .window = ARENA_TAKE(a, double, window), .crest = crest_make(a, p->radius, p->pitch, window)};
    blocks = blocks < KEPT_LEAST ? KEPT_LEAST : blocks > KEPT_MOST ? KEPT_MOST : blocks;
    g->heights = kept_make(a, LINE, (size_t)(heights > HEIGHTS_LEAST ? heights : HEIGHTS_LEAST), heights_fill, g);
    g->blocks = kept_make(a, (size_t)size, (size_t)blocks, blocks_fill, g);
    *part = (struct relief_part){.name = "crest", .finest = p->pitch, .from = {-HUGE_VAL, -HUGE_VAL}, .to = {HUGE_VAL, HUGE_VAL}, .add = bed_add,
                                 .state = g};
    return part;
}
