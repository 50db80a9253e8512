/* Random fields in the plane.

     P(k)      one-sided density that a trace has                                      C2(kappa), W(kappa)   surface/spectrum.h
     xi, eta   place along and across the grain, in m: xi = (x cos d + y sin d)/ratio, eta = -x sin d + y cos d

   The spectrum is split into octave bands [top/2, top), top halving from 1/shortest down; the last band goes down to 0. Each has a tile of
   N x N B-spline coefficients at a pitch of 1/(4 top), periodic, the inverse FFT of random phases with moduli that give the ring [r, r + 1)
   of lines the power W(r dk) - W((r + 1) dk), dk = 1/(N pitch), shared evenly by its lines; so a tile's spectrum is right as it stands, not in
   the mean, and so is the sharp edge at 1/shortest, where C2 has an integrable pole. The moduli are divided by the response
   (2 + cos(2 pi i/N))/3 (2 + cos(2 pi j/N))/3 of reading a spline at its knots.

   The field of a band is a sum of blocks of N x N coefficients, one every N/2 in both directions, each the tile shifted by whole
   coefficients, with a sign, both from the counter (row, column) of the block, under the window w(i) w(j),
   w(i) = sin(pi/2 sin^2(pi (i + 1/2)/N)): the squares of all windows over a place add to 1, so that the mean square is the same everywhere, and
   nothing repeats but by chance, nowhere at a fixed distance. A tile being one period, the window's ends keep a place from being
   correlated with itself a period on: it has decayed to 1e-4 there.

   Departures from P. In the mean: the window blurs spectra by 0.7 lines (rms) of the 16 to 32 that a band spans: some b^2/2 (0.7/24)^2 of a
   power law k^b in the plane, b = exponent - 1: 0.5 % at -2.4, 3 % at -8, and rounds kinks. A spline has images: of k at 1/pitch - k, that is from 3 to 7
   times k, with at most 1/81 of the amplitude. Those of a lower octave land among the higher ones, where they add 3^(-8 - exponent) to the density in a fifth
   of each octave (0.2 % at -2.4, nothing to be heard above -6), and beyond 1/shortest, which is therefore not empty: measured between 1.1 and 2.8/shortest, the density is at most
   6e-5 of that at the edge at exponent 0, 1.2e-4 at -2.4, 1e-3 at -5 (a profile, surface/blocks.h, has nothing there). The window's own leak is less, but for
   4e-5 just above the edge; it would be four times that with a corner at its ends.

   Bands are read as one: a spline of pitch 2 h is one of pitch h too, with the coefficients

     c'(2 m) = (c(m - 1) + 6 c(m) + c(m + 1)) / 8,   c'(2 m + 1) = (c(m) + c(m + 1)) / 2   (in either direction; de Boor 1978, ch. XI)

   so that to the coefficients of each band those of all coarser ones are added, from the coarsest on, and only the finest lattice is read. Each band keeps a
   patch of PATCH x PATCH such sums about where it was read last, placed ahead in the direction of travel. A coefficient is the same sum in the same order
   whatever patch it is part of, so that places can be read in any order.

   Measured of 8 bands: a scrape along a line takes 2.3 times less than with every band read by itself, point by point. What is left is half the blocks'
   coefficients, which come from the tiles' memory. Patches of 12 or 16 are no quicker. */
#include "surface/tiles.h"

#include <limits.h>
#include <string.h>

#include "num/fft_plane.h"
#include "num/lanes.h"
#include "num/real.h"
#include "surface/bicubic.h"
#include "surface/tile.h"

enum { N = TILE_SIDE, HALF = N / 2, PATCH = TILE_EXTRA, UNDER = PATCH / 2 + 2, KEPT = 8, OVER = 9, CHUNK = BICUBIC_POINTS };

struct block {              /* how a block reads the tile */
    long bx, by;
    int at_x, at_y;
    double sign;
    bool known;
};

struct band {
    double pitch;           /* m */
    double *tile;           /* [N][TILE_ROW]: surface/tile.h */
    struct noise stream;
    struct block blocks[KEPT * KEPT];
    long x0, y0;            /* of the patch, both even; x0 = LONG_MIN: none */
    double c[PATCH][PATCH]; /* of this band and all coarser ones */
};

struct tiles {
    double cos_d, sin_d, shrink; /* xi = shrink (cos_d x + sin_d y), eta = cos_d y - sin_d x */
    double window[N];
    int n_bands;
    struct band bands[TILE_BANDS];
};

/* ------------------------------------------------------------------ a band's own coefficients */

static const struct block *block_at(struct band *b, long bx, long by)
{
    struct block *k = &b->blocks[(by & (KEPT - 1)) * KEPT + (bx & (KEPT - 1))];
    if (!k->known || k->bx != bx || k->by != by) {
        uint64_t bits[2];
        noise_bits(b->stream, (uint64_t)by, (uint64_t)bx, bits);
        *k = (struct block){.bx = bx, .by = by, .known = true, .at_x = (int)(bits[0] % N), .at_y = (int)(bits[0] / N % N),
                            .sign = bits[1] & 1 ? 1 : -1};
    }
    return k;
}

static long block_of(long i)
{
    return i >= 0 ? i / HALF : -((-i + HALF - 1) / HALF);
}

static inline long least(long a, long b)
{
    return a < b ? a : b;
}

static inline long most(long a, long b)
{
    return a > b ? a : b;
}

/* The sum of the blocks over the patch. */
LANES_CLONES
static void blocks_sum(struct band *b, const double *window, int n, const struct block *const *blocks)
{
    memset(b->c, 0, sizeof b->c);
    for (int i = 0; i < n; i++) {
        const struct block *k = blocks[i];
        long left = b->x0 - k->bx * HALF, below = b->y0 - k->by * HALF; /* the patch's corner, in the block */
        long x0 = most(-left, 0), y0 = most(-below, 0), x1 = least(N - left, PATCH), y1 = least(N - below, PATCH);
        long column = (k->at_x + left + x0) & (N - 1);
        const double *w = window + left + x0;
        for (long y = y0; y < y1; y++) {
            const double *t = b->tile + ((k->at_y + below + y) & (N - 1)) * TILE_ROW + column;
            double factor = k->sign * window[below + y], *c = b->c[y] + x0;
#pragma omp simd
            for (long x = 0; x < x1 - x0; x++)
                c[x] += factor * (w[x] * t[x]);
        }
    }
}

static void patch_fill(struct band *b, const double *window)
{
    const struct block *blocks[OVER];
    int n = 0;
    for (long by = block_of(b->y0) - 1; by <= block_of(b->y0 + PATCH - 1); by++)
        for (long bx = block_of(b->x0) - 1; bx <= block_of(b->x0 + PATCH - 1); bx++)
            blocks[n++] = block_at(b, bx, by);
    blocks_sum(b, window, n, blocks);
}

/* ------------------------------------------------------------------ and those of all coarser bands */

/* Adds the coarser band's patch to that of b, which it holds. */
LANES_CLONES
static void patch_refine(const struct band *coarse, struct band *b)
{
    double fine[PATCH][PATCH];
    long left = b->x0 / 2 - 1 - coarse->x0, below = b->y0 / 2 - 1 - coarse->y0;
    for (int m = 0; m < PATCH / 2; m++) {
        const double *p = coarse->c[below + m], *q = p + PATCH, *r = q + PATCH;
#pragma omp simd
        for (int x = 0; x < PATCH; x++) {
            fine[2 * m][x] = 0.125 * (p[x] + r[x]) + 0.75 * q[x];
            fine[2 * m + 1][x] = 0.5 * (q[x] + r[x]);
        }
    }
    for (int y = 0; y < PATCH; y++) {
        const double *p = fine[y] + left;
#pragma omp simd
        for (int m = 0; m < PATCH / 2; m++) {
            b->c[y][2 * m] += 0.125 * (p[m] + p[m + 2]) + 0.75 * p[m + 1];
            b->c[y][2 * m + 1] += 0.5 * (p[m + 1] + p[m + 2]);
        }
    }
}

/* Where a patch begins, an even number, so that coefficients i .. i + wide - 1 lie in it, with room ahead when they left the old one at `from`. */
static long patch_start(long i, long wide, long from, bool none)
{
    if (none || (i >= from && i + wide <= from + PATCH))
        return (i - (PATCH - wide) / 2 + 1) & ~1L;
    return i < from ? (i + wide - PATCH + 1) & ~1L : i & ~1L;
}

/* Makes band k hold coefficients from (i, j) on, `wide` in both directions. */
static void patch_hold(struct tiles *t, int k, long i, long j, long wide)
{
    struct band *b = &t->bands[k];
    bool none = b->x0 == LONG_MIN;
    if (!none && i >= b->x0 && i + wide <= b->x0 + PATCH && j >= b->y0 && j + wide <= b->y0 + PATCH)
        return;
    b->x0 = patch_start(i, wide, b->x0, none);
    b->y0 = patch_start(j, wide, b->y0, none);
    patch_fill(b, t->window);
    if (k + 1 == t->n_bands)
        return;
    patch_hold(t, k + 1, b->x0 / 2 - 1, b->y0 / 2 - 1, UNDER);
    patch_refine(&t->bands[k + 1], b);
}

/* ------------------------------------------------------------------ values */

/* Derivatives in xi and eta turned into those in x and y, and added: xi = a x + b y, eta = c x + d y. */
LANES_CLONES
static void chain_add(const struct tiles *t, int n, const struct bicubic *s, const struct relief_values *v, size_t at)
{
    double a = t->shrink * t->cos_d, b = t->shrink * t->sin_d, c = -t->sin_d, d = t->cos_d;
    for (int i = 0; v->z && i < n; i++)
        v->z[at + i] += s->z[i];
    for (int i = 0; v->x && i < n; i++)
        v->x[at + i] += a * s->x[i] + c * s->y[i];
    for (int i = 0; v->y && i < n; i++)
        v->y[at + i] += b * s->x[i] + d * s->y[i];
    for (int i = 0; v->xx && i < n; i++)
        v->xx[at + i] += a * a * s->xx[i] + 2 * a * c * s->xy[i] + c * c * s->yy[i];
    for (int i = 0; v->xy && i < n; i++)
        v->xy[at + i] += a * b * s->xx[i] + (a * d + b * c) * s->xy[i] + c * d * s->yy[i];
    for (int i = 0; v->yy && i < n; i++)
        v->yy[at + i] += b * b * s->xx[i] + 2 * b * d * s->xy[i] + d * d * s->yy[i];
}

/* Places along and across the grain, in pitches of the finest band. */
LANES_CLONES
static void places(const struct tiles *t, int n, const double *x, const double *y, double *p[2])
{
    double u = 1 / t->bands[0].pitch, a = t->cos_d, b = t->sin_d, shrink = t->shrink, *xi = p[0], *eta = p[1];
    for (int i = 0; i < n; i++) {
        xi[i] = shrink * (a * x[i] + b * y[i]) * u;
        eta[i] = (a * y[i] - b * x[i]) * u;
    }
}

static void tiles_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    static const double zeros[CHUNK] = {0};
    struct tiles *t = part->state;
    struct bicubic c;
    double xi[CHUNK], eta[CHUNK], u = 1 / t->bands[0].pitch;
    for (size_t at = 0; at < p->n; at += CHUNK) {
        int n = p->n - at < CHUNK ? (int)(p->n - at) : CHUNK;
        places(t, n, p->x + at, p->y ? p->y + at : zeros, (double *[2]){xi, eta});
        bicubic_cells(&c, n, xi, eta);
        for (int i = 0, end; i < n; i = end) {
            long column = (long)c.column[i] - 1, row = (long)c.row[i] - 1;
            end = bicubic_run(&c, i);
            patch_hold(t, 0, column, row, 4);
            bicubic_put(&c, i, end, &t->bands[0].c[row - t->bands[0].y0][column - t->bands[0].x0], PATCH);
        }
        bicubic_sum(&c, u, u, v);
        chain_add(t, n, &c, v, at);
    }
}

/* ------------------------------------------------------------------ opening */

static void bands_make(struct tiles *t, double top, double (*power)[TILE_LINES], struct noise stream, struct arena *a)
{
    struct fft_plane *fft = fft_plane_open(N);
    for (int b = 0; b < t->n_bands; b++, top /= 2) {
        uint64_t key[2];
        noise_bits(stream, (uint64_t)b, UINT64_MAX, key);
        t->bands[b] = (struct band){.pitch = 0.25 / top, .tile = ARENA_TAKE(a, double, N * TILE_ROW), .stream = {key[0]}, .x0 = LONG_MIN};
        tile_make(power[b], t->bands[b].stream, fft, t->bands[b].tile);
    }
    fft_plane_close(fft);
}

struct relief_part *tiles_part(struct arena *a, const struct spectrum *s, const struct tiles_grain *g, struct noise stream, double *lost,
                               struct err *e)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct tiles *t = ARENA_TAKE(a, struct tiles, 1);
    double (*power)[TILE_LINES] = (double (*)[TILE_LINES])ARENA_TAKE(a, double, TILE_BANDS * TILE_LINES);
    bool round = g->ratio == 1;
    t->shrink = 1 / g->ratio;
    t->cos_d = round ? 1 : real_cos(g->direction);
    t->sin_d = round ? 0 : real_sin(g->direction);
    for (int i = 0; i < N; i++) {
        double across = real_sinpi((i + 0.5) / N);
        t->window[i] = real_sinpi(across * across / 2);
    }
    t->n_bands = tile_rings(s, power);
    double moved = tile_mend(t->n_bands, power);
    if (lost)
        *lost = moved;
    else if (moved > 1e-6) {
        err_set(e, ERR_SCENE, "no surface in the plane has this spectrum along every line: where a spectrum rises with spatial frequency, that "
                              "of the plane would be negative; lower the exponent (0 always works), or use a surface along the path");
        return NULL;
    }
    bands_make(t, spectrum_top(s), power, stream, a);
    double h = t->bands[0].pitch;
    *part = (struct relief_part){.name = "tiles", .finest = h, .add = tiles_add, .state = t,
                                 .pitch = {t->sin_d == 0 ? h * g->ratio : 0, t->sin_d == 0 ? h : 0},
                                 .from = {-HUGE_VAL, -HUGE_VAL}, .to = {HUGE_VAL, HUGE_VAL}};
    return part;
}
