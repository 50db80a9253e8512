/* See patches.h, and surface/tiles.c for what a band is.

   Patches lie side by side, PATCH_CELLS apart, with an edge of PATCH_EDGE coefficients that the next ones hold too: so
   a cell's 16 coefficients, and the 8 x 8 of a coarser patch that one of a finer band is refined from, are in one
   patch: the finer patch (i, j) is a quarter of the coarser (floor(i/2), floor(j/2)), and with its edge is made of 8 x
   8 coefficients of it. */
#include "surface/patches.h"

#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "surface/block_cache.h"
#include "surface/tile.h"

enum {
    N = TILE_SIDE,
    HALF = N / 2,
    SIDE = PATCH_SIDE,
    UNDER = SIDE / 2 + 2,
    LAID = 8,
    OVER = 10,
    KEPT_MANY = 4096,
    KEPT_FEW = 256,
    KEPT_LEAST = 32
};

struct laid { /* how a block reads the tile */
    long bx, by;
    int at_x, at_y;
    double sign;
    bool known;
};

struct term {                    /* what a block adds to a patch */
    const double *across, *down; /* its windows */
    const double *tile;          /* its first column */
    long row;
    double sign;
};

struct band {
    const struct patches *whole;
    const double *tile; /* [N][TILE_ROW]: surface/tile.h */
    struct noise stream;
    struct laid laid[LAID * LAID];
    struct block_cache *patches; /* [SIDE][SIDE], of this band and all coarser ones */
    struct band *coarser;        /* NULL: none */
};

struct patches {
    double window[N + 2 * SIDE]; /* 0 beyond a block's ends */
    struct band bands[TILE_BANDS];
};

/* ------------------------------------------------------------------ a band's own coefficients */

static const struct laid *laid_at(struct band *b, long bx, long by)
{
    struct laid *k = &b->laid[(by & (LAID - 1)) * LAID + (bx & (LAID - 1))];
    if (!k->known || k->bx != bx || k->by != by) {
        uint64_t bits[2];
        noise_bits(b->stream, (uint64_t)by, (uint64_t)bx, bits);
        *k = (struct laid){.bx = bx,
                           .by = by,
                           .known = true,
                           .at_x = (int)(bits[0] % N),
                           .at_y = (int)(bits[0] / N % N),
                           .sign = bits[1] & 1 ? 1 : -1};
    }
    return k;
}

/* i / n rounded down; n: a power of two. */
static long floor_over(long i, long n) { return (i - (i & (n - 1))) / n; }

/* Of block (bx, by), for the patch whose first coefficient is (x0, y0). */
static struct term term_of(struct band *b, long bx, long by, long x0, long y0)
{
    const struct laid *k = laid_at(b, bx, by);
    long left = x0 - bx * HALF, below = y0 - by * HALF; /* the patch's corner, in the block */
    const double *window = b->whole->window + SIDE;
    return (struct term){window + left, window + below, b->tile + ((k->at_x + left) & (N - 1)), k->at_y + below,
                         k->sign};
}

/* Adds what two terms add; a product with a window's 0 changes no sum. */
LANES_CLONES
static void terms_two(const struct term *k, double *c)
{
    const double *w0 = k[0].across, *w1 = k[1].across;
    for (long y = 0; y < SIDE; y++, c += SIDE) {
        const double *t0 = k[0].tile + ((k[0].row + y) & (N - 1)) * TILE_ROW,
                     *t1 = k[1].tile + ((k[1].row + y) & (N - 1)) * TILE_ROW;
        double f0 = k[0].sign * k[0].down[y], f1 = k[1].sign * k[1].down[y];
#pragma omp simd
        for (long x = 0; x < SIDE; x++)
            c[x] = (c[x] + f0 * (w0[x] * t0[x])) + f1 * (w1[x] * t1[x]);
    }
}

LANES_CLONES
static void terms_four(const struct term *k, double *c)
{
    const double *w0 = k[0].across, *w1 = k[1].across, *w2 = k[2].across, *w3 = k[3].across;
    for (long y = 0; y < SIDE; y++, c += SIDE) {
        const double *t0 = k[0].tile + ((k[0].row + y) & (N - 1)) * TILE_ROW,
                     *t1 = k[1].tile + ((k[1].row + y) & (N - 1)) * TILE_ROW;
        const double *t2 = k[2].tile + ((k[2].row + y) & (N - 1)) * TILE_ROW,
                     *t3 = k[3].tile + ((k[3].row + y) & (N - 1)) * TILE_ROW;
        double f0 = k[0].sign * k[0].down[y], f1 = k[1].sign * k[1].down[y], f2 = k[2].sign * k[2].down[y],
               f3 = k[3].sign * k[3].down[y];
#pragma omp simd
        for (long x = 0; x < SIDE; x++)
            c[x] =
                (((c[x] + f0 * (w0[x] * t0[x])) + f1 * (w1[x] * t1[x])) + f2 * (w2[x] * t2[x])) + f3 * (w3[x] * t3[x]);
    }
}

/* The sum of the blocks over the patch, always from the lowest row and the left on: 4 blocks, or 6 or 9 where one
 * begins or ends in it. */
static void own_sum(struct band *b, long x0, long y0, double *c)
{
    struct term terms[OVER];
    int n = 0, at = 0;
    for (long by = floor_over(y0, HALF) - 1; by <= floor_over(y0 + SIDE - 1, HALF); by++)
        for (long bx = floor_over(x0, HALF) - 1; bx <= floor_over(x0 + SIDE - 1, HALF); bx++)
            terms[n++] = term_of(b, bx, by, x0, y0);
    if (n % 2) {
        terms[n] = terms[n - 1];
        terms[n++].sign = 0;
    }
    memset(c, 0, SIDE * SIDE * sizeof *c);
    for (; n - at >= 4; at += 4)
        terms_four(terms + at, c);
    if (at < n) terms_two(terms + at, c);
}

/* ------------------------------------------------------------------ and those of all coarser bands */

/* Adds the coarser patch, of which `from` is the first coefficient that is needed. */
LANES_CLONES
static void refine(const double *from, double *c)
{
    double fine[SIDE][UNDER];
    for (int m = 0; m < SIDE / 2; m++) {
        const double *p = from + m * SIDE, *q = p + SIDE, *r = q + SIDE;
#pragma omp simd
        for (int x = 0; x < UNDER; x++) {
            fine[2 * m][x] = 0.125 * (p[x] + r[x]) + 0.75 * q[x];
            fine[2 * m + 1][x] = 0.5 * (q[x] + r[x]);
        }
    }
    for (int y = 0; y < SIDE; y++, c += SIDE) {
        const double *p = fine[y];
#pragma omp simd
        for (int m = 0; m < SIDE / 2; m++) {
            c[2 * m] += 0.125 * (p[m] + p[m + 2]) + 0.75 * p[m + 1];
            c[2 * m + 1] += 0.5 * (p[m + 1] + p[m + 2]);
        }
    }
}

static void patch_fill(void *self, long column, long row, double *c)
{
    struct band *b = self;
    own_sum(b, column * PATCH_CELLS - PATCH_EDGE, row * PATCH_CELLS - PATCH_EDGE, c);
    if (!b->coarser) return;
    const double *coarse = block_cache_at(b->coarser->patches, floor_over(column, 2), floor_over(row, 2));
    refine(coarse + (row & 1) * (PATCH_CELLS / 2 * SIDE) + (column & 1) * (PATCH_CELLS / 2), c);
}

const double *patches_at(struct patches *p, long column, long row)
{
    return block_cache_at(p->bands[0].patches, column, row);
}

/* ------------------------------------------------------------------ making */

size_t patches_made(const struct patches *p)
{
    size_t all = 0;
    for (const struct band *b = p->bands; b; b = b->coarser)
        all += block_cache_made(b->patches);
    return all;
}

/* A path goes over half as many patches of each coarser band. */
static size_t capacity_of(int band, bool once)
{
    size_t half = (once ? KEPT_FEW : KEPT_MANY) >> (band < 16 ? band : 16);
    return half > KEPT_LEAST ? half : KEPT_LEAST;
}

size_t patches_bytes(int bands, bool once)
{
    size_t all = sizeof(struct patches) + 64;
    for (int b = 0; b < bands; b++)
        all += block_cache_bytes(PATCH_NUMBERS, capacity_of(b, once));
    return all;
}

struct patches *patches_make(struct arena *a, const struct patches_plan *plan)
{
    struct patches *p = ARENA_TAKE(a, struct patches, 1);
    for (int i = 0; i < N; i++) {
        double across = real_sinpi((i + 0.5) / N);
        p->window[SIDE + i] = real_sinpi(across * across / 2);
    }
    for (int k = 0; k < plan->bands; k++) {
        struct band *b = &p->bands[k];
        *b = (struct band){.whole = p,
                           .tile = plan->tiles[k],
                           .stream = plan->streams[k],
                           .coarser = k + 1 < plan->bands ? b + 1 : NULL};
        b->patches = block_cache_make(a, PATCH_NUMBERS, capacity_of(k, plan->once), patch_fill, b);
    }
    return p;
}
