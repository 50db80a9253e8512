/* See crest_part.h. Blocks of the envelope lie on a lattice of their own, at least twice as long as the reach, and each
   is made from all the ground within reach of it, so that the ground is looked at twice on average, whatever the
   radius, and the result is a function of the place alone, to the last bit. */
#include "surface/crest_part.h"

#include <math.h>
#include <string.h>

#include "surface/crest_lanes.h"
#include "surface/crest_piece.h"
#include "surface/kept.h"

enum { LINE = 1024, READ = 64, KEPT_LEAST = 4, KEPT_MOST = 512, HEIGHTS_LEAST = 512, KINDS = 3 };

#define NUMBERS_KEPT (1L << 23)

struct bed {
    const struct relief *under;
    struct crest_plan plan;
    struct crest_disc disc;
    bool warned;
    double least, most;
    long reach, side;      /* places: as far as the disc looks; in a block of the envelope */
    int kinds;             /* of what is known of a place: its height; slope and bend      */
    double *window[KINDS]; /* work */
    struct crest *crest;
    struct kept *heights;  /* blocks of LINE places, of one kind after the other */
    struct kept *blocks;   /* of the envelope: how many stretches, and these */
    long column, hint;     /* of the block at hand; its stretch that was read last */
    const double *at_hand; /* NULL: none */
};

static void heights_watch(struct bed *g, const double *z)
{
    for (long i = 0; i < LINE; i++) {
        g->least = z[i] < g->least ? z[i] : g->least;
        g->most = z[i] > g->most ? z[i] : g->most;
    }
    if (!g->warned && g->most - g->least > g->plan.span) {
        g->warned = true;
        if (g->plan.exceeded) g->plan.exceeded(g->plan.self);
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
        struct relief_values v = {.z = out + i,
                                  .x = g->plan.points ? NULL : out + LINE + i,
                                  .xx = g->plan.points ? NULL : out + 2 * LINE + i};
        relief_at(g->under, &(struct relief_points){READ, x, NULL}, &v);
    }
    heights_watch(g, out);
}

static long floor_over(long i, long n) { return i >= 0 ? i / n : -((-i + n - 1) / n); }

static void heights_gather(struct bed *g, long first, long n)
{
    for (long b = floor_over(first, LINE); b * LINE < first + n; b++) {
        const double *z = kept_at(g->heights, b, 0);
        long from = b * LINE > first ? b * LINE : first, to = (b + 1) * LINE < first + n ? (b + 1) * LINE : first + n;
        for (int k = 0; k < g->kinds; k++)
            memcpy(g->window[k] + from - first, z + k * LINE + from - b * LINE, (size_t)(to - from) * sizeof *z);
    }
}

/* Of the window's stretches, those that come up inside the block and the one that is up where it begins. */
static void blocks_fill(void *self, long column, long row, double *out)
{
    struct bed *g = self;
    long first = column * g->side - g->reach, n = crest_part_window(&g->plan);
    double from = (double)(column * g->side) * g->plan.pitch, to = (double)((column + 1) * g->side) * g->plan.pitch;
    const double *found;
    (void)row;
    heights_gather(g, first, n);
    crest_set(g->crest, &(struct crest_ground){g->window[0], g->window[1], g->window[2]}, n, first);
    long stretches = crest_between(g->crest, from, to, &found);
    out[0] = (double)stretches;
    memcpy(out + 1, found, (size_t)(stretches * CREST_NUMBERS) * sizeof *out);
}

static const double *bed_stretch(struct bed *g, double x)
{
    long column = (long)floor(x / ((double)g->side * g->plan.pitch));
    if (!g->at_hand || column != g->column) {
        g->at_hand = kept_at(g->blocks, column, 0);
        g->column = column;
        g->hint = 0;
    }
    g->hint = crest_find(g->at_hand + 1, (long)g->at_hand[0], g->hint, x);
    return g->at_hand + 1 + g->hint * CREST_NUMBERS;
}

static void bed_put(const struct relief_values *v, size_t n, double z, double slope, double bend)
{
    if (v->z) v->z[n] += z;
    if (v->x) v->x[n] += slope;
    if (v->xx) v->xx[n] += bend;
}

static void bed_points(struct bed *g, const struct relief_points *p, const struct relief_values *v)
{
    for (size_t n = 0; n < p->n; n++) {
        const double *s = bed_stretch(g, p->x[n]);
        struct crest_jet j = crest_piece_rest(&g->disc, s + CREST_PIECE, p->x[n] - s[CREST_AT]);
        bed_put(v, n, j.z, j.slope, j.bend);
    }
}

/* The last group is filled up with the last place. */
static void bed_lanes(struct bed *g, const struct relief_points *p, const struct relief_values *v, size_t from)
{
    struct crest_lanes at;
    size_t n = p->n - from < LANES ? p->n - from : LANES;
    for (size_t l = 0; l < LANES; l++) {
        double x = p->x[l < n ? from + l : p->n - 1];
        const double *s = bed_stretch(g, x);
        for (int k = 0; k < CREST_TERMS; k++)
            at.terms[k][l] = s[CREST_PIECE + k];
        at.y[l] = x - s[CREST_AT];
    }
    crest_lanes_rest(&g->disc, &at);
    for (size_t l = 0; l < n; l++)
        bed_put(v, from + l, at.z[l], at.slope[l], at.bend[l]);
}

static void bed_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct bed *g = part->state;
    if (g->disc.half == 0 || p->n < LANES)
        bed_points(g, p, v);
    else
        for (size_t from = 0; from < p->n; from += LANES)
            bed_lanes(g, p, v, from);
}

static long plan_reach(const struct crest_plan *p) { return (long)ceil(p->reach / p->pitch); }

static long plan_side(const struct crest_plan *p) { return 2 * plan_reach(p) > LINE ? 2 * plan_reach(p) : LINE; }

long crest_part_window(const struct crest_plan *p) { return plan_side(p) + 2 * plan_reach(p) + 1; }

struct relief_part *crest_part(struct arena *a, const struct relief *under, const struct crest_plan *p)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct bed *g = ARENA_TAKE(a, struct bed, 1);
    long window = crest_part_window(p), size = 1 + window * CREST_NUMBERS, blocks = NUMBERS_KEPT / size,
         heights = 2 * (window / LINE + 2);
    *g = (struct bed){.under = under,
                      .plan = *p,
                      .disc = crest_piece_disc(p->radius, p->points ? 0 : 0.5 * p->pitch),
                      .least = HUGE_VAL,
                      .most = -HUGE_VAL,
                      .reach = plan_reach(p),
                      .side = plan_side(p),
                      .kinds = p->points ? 1 : KINDS,
                      .crest = crest_make(a, p->radius, p->pitch, window)};
    for (int k = 0; k < g->kinds; k++)
        g->window[k] = ARENA_TAKE(a, double, window);
    blocks = blocks < KEPT_LEAST ? KEPT_LEAST : blocks > KEPT_MOST ? KEPT_MOST : blocks;
    g->heights = kept_make(a, (size_t)(LINE * g->kinds), (size_t)(heights > HEIGHTS_LEAST ? heights : HEIGHTS_LEAST),
                           heights_fill, g);
    g->blocks = kept_make(a, (size_t)size, (size_t)blocks, blocks_fill, g);
    *part = (struct relief_part){.name = "crest",
                                 .finest = p->pitch,
                                 .from = {-HUGE_VAL, -HUGE_VAL},
                                 .to = {HUGE_VAL, HUGE_VAL},
                                 .add = bed_add,
                                 .state = g};
    return part;
}
