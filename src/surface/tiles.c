/* Random fields in the plane.

     P(k)      one-sided density that a trace has                                      C2(kappa), W(kappa)
               surface/spectrum.h
     xi, eta   place along and across the grain, in m: xi = (x cos d + y sin d)/ratio, eta = -x sin d + y cos d

   The spectrum is split into octave bands [top/2, top), top halving from 1/shortest down; the last band goes down to 0.
   Each has a tile of N x N B-spline coefficients at a pitch of 1/(4 top), periodic, the inverse FFT of random phases
   with moduli that give the ring [r, r + 1) of lines the power W(r dk) - W((r + 1) dk), dk = 1/(N pitch), shared evenly
   by its lines; so a tile's spectrum is right as it stands, not in the mean, and so is the sharp edge at 1/shortest,
   where C2 has an integrable pole. The moduli are divided by the response (2 + cos(2 pi i/N))/3 (2 + cos(2 pi j/N))/3
   of reading a spline at its knots.

   The field of a band is a sum of blocks of N x N coefficients, one every N/2 in both directions, each the tile shifted
   by whole coefficients, with a sign, both from the counter (row, column) of the block, under the window w(i) w(j),
   w(i) = sin(pi/2 sin^2(pi (i + 1/2)/N)): the squares of all windows over a place add to 1, so that the mean square is
   the same everywhere, and nothing repeats but by chance, nowhere at a fixed distance. A tile being one period, the
   window's ends keep a place from being correlated with itself a period on: it has decayed to 1e-4 there.

   Departures from P. In the mean: the window blurs spectra by 0.7 lines (rms) of the 16 to 32 that a band spans: some
   b^2/2 (0.7/24)^2 of a power law k^b in the plane, b = exponent - 1: 0.5 % at -2.4, 3 % at -8, and rounds kinks. A
   spline has images: of k at 1/pitch - k, that is from 3 to 7 times k, with at most 1/81 of the amplitude. Those of a
   lower octave land among the higher ones, where they add 3^(-8 - exponent) to the density in a fifth of each octave
   (0.2 % at -2.4, nothing to be heard above -6), and beyond 1/shortest, which is therefore not empty: measured between
   1.1 and 2.8/shortest, the density is at most 6e-5 of that at the edge at exponent 0, 1.2e-4 at -2.4, 1e-3 at -5 (a
   profile, surface/roughness.h, has nothing there). The window's own leak is less, but for 4e-5 just above the edge; it
   would be four times that with a corner at its ends.

   Bands are read as one: a spline of pitch 2 h is one of pitch h too, with the coefficients

     c'(2 m) = (c(m - 1) + 6 c(m) + c(m + 1)) / 8,   c'(2 m + 1) = (c(m) + c(m + 1)) / 2   (in either direction; de Boor
                                                     1978, ch. XI)

   so that to the coefficients of each band those of all coarser ones are added, from the coarsest on, and only the
   finest lattice is read, in patches that are kept (surface/tiles.c). A coefficient is the same sum in the same order
   whatever patch it is part of, so that places can be read in any order.

   Measured of a scrape to and fro in instructions a sample (callgrind, AVX2; evidence/profile.md): patches of 8 x 8
   about the place that was read last, made again each time, took 1250, and those of a ball under which squares of 8 x 8
   cells are read half of all its cycles, as each row of a square began again; kept, next to nothing. */
#include "surface/tiles.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "num/lanes.h"
#include "num/real.h"
#include "surface/bicubic.h"
#include "surface/block_cache.h"

/* ------------------------------------------------------------------ tiles */

enum {
    N = TILE_SIDE,
    HALF = N / 2,
    SIDE = PATCH_SIDE,
    UNDER = SIDE / 2 + 2,
    LAID = 8,
    OVER = 10,
    CACHED_MANY = 4096,
    CACHED_FEW = 256,
    CACHED_LEAST = 32
};

int tiles_rings(const struct spectrum *s, double (*power)[TILE_LINES])
{
    double top = spectrum_top(s), bottom = spectrum_bottom(s), base = fmax(bottom, s->k[0]);
    int bands = 0;
    for (bool last = false; !last && bands < TILE_BANDS; bands++, top /= 2) {
        double dk = top / TILE_LINES, above = 0;
        last = top / 2 < base;
        for (int r = TILE_LINES - 1; r >= (last && s->takeover <= 0 ? 0 : TILE_LINES / 2); r--) {
            double beyond = r * dk >= spectrum_top(s) ? 0 : spectrum_beyond(s, r * dk);
            above = r == TILE_LINES - 1 ? (bands ? spectrum_beyond(s, top) : 0) : above;
            power[bands][r] = (beyond - above) * spectrum_takeover(s, (r + 0.5) * dk);
            above = beyond;
        }
    }
    return bands;
}

double tiles_mend(int bands, double (*power)[TILE_LINES])
{
    double all = 0, lost = 0;
    for (int b = 0; b < bands; b++)
        for (int r = 0; r < TILE_LINES; r++) {
            all += power[b][r];
            lost += fmin(power[b][r], 0);
            power[b][r] = fmax(power[b][r], 0);
        }
    for (int b = 0; b < bands; b++)
        for (int r = 0; r < TILE_LINES; r++)
            power[b][r] *= all / (all - lost);
    return -lost / (all - lost);
}

static int ring_of(int i, int j)
{
    return (int)sqrt(
        (double)(i * i + j * j)); /* exact: the root of a whole number below 2^52 is not rounded up to one */
}

static int folded(int j) { return j < HALF ? j : N - j; }

/* Modulus of a line of each ring, before the spline's response. */
static void moduli(const double power[TILE_LINES], double modulus[TILE_LINES])
{
    int count[TILE_LINES] = {0};
    for (int j = -TILE_LINES; j <= TILE_LINES; j++)
        for (int i = -TILE_LINES; i <= TILE_LINES; i++)
            if (ring_of(i, j) < TILE_LINES) count[ring_of(i, j)]++;
    for (int r = 0; r < TILE_LINES; r++)
        modulus[r] = sqrt(power[r] / count[r]);
}

void tiles_tile(const double power[TILE_LINES], struct noise stream, struct fft_plane *fft, double *tile)
{
    double *re = fft->re, *im = fft->im, modulus[TILE_LINES], spline[TILE_LINES];
    memset(re, 0, N * (HALF + 1) * sizeof *re);
    memset(im, 0, N * (HALF + 1) * sizeof *im);
    moduli(power, modulus);
    for (int i = 0; i < TILE_LINES; i++) {
        double sinc = i ? real_sinpi((double)i / N) / (REAL_PI * i / N) : 1;
        spline[i] = 1 / (sinc * sinc * sinc * sinc);
    }
    for (int j = 0; j < N; j++)
        for (int i = 0; i < TILE_LINES; i++) {
            int r = ring_of(i, folded(j)), at = j * (HALF + 1) + i;
            if (r >= TILE_LINES || modulus[r] <= 0) continue;
            double turns = 2 * noise_uniform(stream, (uint64_t)at, UINT64_MAX / 2),
                   size = modulus[r] * spline[i] * spline[folded(j)];
            re[at] = size * (i || j ? real_cospi(turns) : turns < 1 ? 1 : -1);
            im[at] = size * real_sinpi(turns);
        }
    for (int j = 1; j < HALF; j++) {
        re[(N - j) * (HALF + 1)] = re[j * (HALF + 1)];
        im[(N - j) * (HALF + 1)] = -im[j * (HALF + 1)];
    }
    stopwatch_spend(40.0 * N * N);
    im[0] = 0;
    const double *x = fft->x;
    fft_plane_inverse(fft);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < TILE_ROW; i++)
            tile[j * TILE_ROW + i] = x[j * N + i % N];
}

/* ------------------------------------------------------------------ patches */

/* Patches lie side by side, PATCH_CELLS apart, with an edge of PATCH_EDGE coefficients that the next ones hold too: so
   a cell's 16 coefficients, and the 8 x 8 of a coarser patch that one of a finer band is refined from, are in one
   patch: the finer patch (i, j) is a quarter of the coarser (floor(i/2), floor(j/2)), and with its edge is made of 8 x
   8 coefficients of it. */

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
    const double *tile; /* [N][TILE_ROW]: surface/tiles.h */
    struct noise stream;
    struct laid laid[LAID * LAID];
    struct block_cache *patches; /* [SIDE][SIDE], of this band and all coarser ones */
    struct band *coarser;        /* NULL: none */
};

struct patches {
    double window[N + 2 * SIDE]; /* 0 beyond a block's ends */
    struct band bands[TILE_BANDS];
};

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
static long block_over(long i, long n) { return (i - (i & (n - 1))) / n; }

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
    for (long by = block_over(y0, HALF) - 1; by <= block_over(y0 + SIDE - 1, HALF); by++)
        for (long bx = block_over(x0, HALF) - 1; bx <= block_over(x0 + SIDE - 1, HALF); bx++)
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
    const double *coarse = block_cache_at(b->coarser->patches, block_over(column, 2), block_over(row, 2));
    refine(coarse + (row & 1) * (PATCH_CELLS / 2 * SIDE) + (column & 1) * (PATCH_CELLS / 2), c);
}

const double *tiles_patch(struct patches *p, long column, long row)
{
    return block_cache_at(p->bands[0].patches, column, row);
}

size_t tiles_patches_made(const struct patches *p)
{
    size_t all = 0;
    for (const struct band *b = p->bands; b; b = b->coarser)
        all += block_cache_made(b->patches);
    return all;
}

/* A path goes over half as many patches of each coarser band. */
static size_t capacity_of(int band, bool once)
{
    size_t half = (once ? CACHED_FEW : CACHED_MANY) >> (band < 16 ? band : 16);
    return half > CACHED_LEAST ? half : CACHED_LEAST;
}

size_t tiles_bytes(int bands, bool once)
{
    size_t all = sizeof(struct patches) + 64;
    for (int b = 0; b < bands; b++)
        all += block_cache_bytes(PATCH_NUMBERS, capacity_of(b, once));
    return all;
}

struct patches *tiles_patches(struct arena *a, const struct patches_plan *plan)
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

enum { CHUNK = BICUBIC_POINTS };

struct tiles {
    bool round;                  /* xi = x, eta = y */
    double cos_d, sin_d, shrink; /* xi = shrink (cos_d x + sin_d y), eta = cos_d y - sin_d x */
    double pitch;                /* m, of the finest band */
    struct patches *patches;
    long column, row;      /* of the patch at hand */
    const double *at_hand; /* NULL: none */
};

/* ------------------------------------------------------------------ values */

static inline __attribute__((always_inline)) void added(int n, const double *from, double *to, size_t at)
{
    if (!to) return;
    to += at;
#pragma omp simd
    for (int i = 0; i < n; i++)
        to[i] += from[i];
}

/* What chain_add does where xi = x and eta = y. */
LANES_CLONES
static void plain_add(int n, const struct bicubic *s, const struct relief_values *v, size_t at)
{
    added(n, s->z, v->z, at);
    added(n, s->x, v->x, at);
    added(n, s->y, v->y, at);
    added(n, s->xx, v->xx, at);
    added(n, s->xy, v->xy, at);
    added(n, s->yy, v->yy, at);
}

/* Derivatives in xi and eta turned into those in x and y, and added: xi = a x + b y, eta = c x + d y. */
LANES_CLONES
static void chain_add(const struct tiles *t, struct bicubic *s, const struct relief_values *v, size_t at)
{
    double a = t->shrink * t->cos_d, b = t->shrink * t->sin_d, c = -t->sin_d, d = t->cos_d;
    int slopes = v->x || v->y ? s->n : 0, bends = v->xx || v->xy || v->yy ? s->n : 0;
#pragma omp simd
    for (int i = 0; i < slopes; i++) {
        double x = s->x[i], y = s->y[i];
        s->x[i] = a * x + c * y;
        s->y[i] = b * x + d * y;
    }
#pragma omp simd
    for (int i = 0; i < bends; i++) {
        double xx = s->xx[i], xy = s->xy[i], yy = s->yy[i];
        s->xx[i] = a * a * xx + 2 * a * c * xy + c * c * yy;
        s->xy[i] = a * b * xx + (a * d + b * c) * xy + c * d * yy;
        s->yy[i] = b * b * xx + 2 * b * d * xy + d * d * yy;
    }
    plain_add(s->n, s, v, at);
}

/* Places along and across the grain, in pitches of the finest band. */
LANES_CLONES
static void places(const struct tiles *t, int n, const double *x, const double *y, double *p[2])
{
    double u = 1 / t->pitch, a = t->cos_d, b = t->sin_d, shrink = t->shrink, *xi = p[0], *eta = p[1];
#pragma omp simd
    for (int i = 0; i < n; i++) {
        xi[i] = shrink * (a * x[i] + b * y[i]) * u;
        eta[i] = (a * y[i] - b * x[i]) * u;
    }
}

/* The coefficients of points from i on, of one cell, or each of the next one in a row of the patch at hand; the end of
 * these. */
static int tiles_put(struct tiles *t, struct bicubic *c, int i)
{
    long cell_x = (long)c->column[i], cell_y = (long)c->row[i], x = cell_x & (PATCH_CELLS - 1),
         y = cell_y & (PATCH_CELLS - 1);
    long column = (cell_x - x) / PATCH_CELLS, row = (cell_y - y) / PATCH_CELLS;
    if (!t->at_hand || column != t->column || row != t->row) {
        t->at_hand = tiles_patch(t->patches, column, row);
        t->column = column;
        t->row = row;
    }
    const double *from = t->at_hand + (y + PATCH_EDGE - 1) * PATCH_SIDE + x + PATCH_EDGE - 1;
    int end = bicubic_row(c, i), most = i + PATCH_CELLS - (int)x;
    if (end > i + 1) {
        bicubic_put_row(c, i, from, PATCH_SIDE);
        return end < most ? end : most;
    }
    end = bicubic_run(c, i);
    bicubic_put(c, i, end, from, PATCH_SIDE);
    return end;
}

static void tiles_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    static const double zeros[CHUNK] = {0};
    struct tiles *t = part->state;
    struct bicubic c;
    double xi[CHUNK], eta[CHUNK], u = 1 / t->pitch;
    for (size_t at = 0; at < p->n; at += CHUNK) {
        int n = p->n - at < CHUNK ? (int)(p->n - at) : CHUNK;
        places(t, n, p->x + at, p->y ? p->y + at : zeros, (double *[2]){xi, eta});
        bicubic_cells(&c, n, xi, eta);
        for (int i = 0; i < n;)
            i = tiles_put(t, &c, i);
        bicubic_sum(&c, u, u, v);
        if (t->round)
            plain_add(n, &c, v, at);
        else
            chain_add(t, &c, v, at);
    }
}

/* ------------------------------------------------------------------ opening */

static struct patches *bands_make(struct arena *a, int bands, double (*power)[TILE_LINES], struct noise stream,
                                  bool once)
{
    struct fft_plane *fft = fft_plane_open(TILE_SIDE);
    double *tiles[TILE_BANDS];
    struct noise streams[TILE_BANDS];
    for (int b = 0; b < bands; b++) {
        uint64_t key[2];
        noise_bits(stream, (uint64_t)b, UINT64_MAX, key);
        streams[b] = (struct noise){key[0]};
        tiles[b] = ARENA_TAKE(a, double, TILE_SIDE *TILE_ROW);
        tiles_tile(power[b], streams[b], fft, tiles[b]);
    }
    fft_plane_close(fft);
    return tiles_patches(a, &(struct patches_plan){bands, (const double *const *)tiles, streams, once});
}

struct relief_part *tiles_part(struct arena *a, const struct spectrum *s, const struct tiles_grain *g,
                               struct noise stream, double *lost, struct err *e)
{
    struct tiles *t = ARENA_TAKE(a, struct tiles, 1);
    double(*power)[TILE_LINES] = (double(*)[TILE_LINES])ARENA_TAKE(a, double, TILE_BANDS *TILE_LINES);
    t->round = g->ratio == 1;
    t->shrink = 1 / g->ratio;
    t->cos_d = t->round ? 1 : real_cos(g->direction);
    t->sin_d = t->round ? 0 : real_sin(g->direction);
    int bands = tiles_rings(s, power);
    double moved = tiles_mend(bands, power);
    if (lost)
        *lost = moved;
    else if (moved > 1e-6) {
        err_set(e, ERR_SCENE,
                "no surface in the plane has this spectrum along every line: where a spectrum rises with spatial "
                "frequency, that "
                "of the plane would be negative; lower the exponent (0 always works), or use a surface along the path");
        return NULL;
    }
    t->patches = bands_make(a, bands, power, stream, g->once);
    double h = t->pitch = 0.25 / spectrum_top(s);
    struct relief_part *part = relief_endless(a, "tiles", h, tiles_add, t);
    part->reading = 60;
    part->pitch[0] = t->sin_d == 0 ? h * g->ratio : 0;
    part->pitch[1] = t->sin_d == 0 ? h : 0;
    return part;
}
