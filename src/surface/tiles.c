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
   profile, surface/blocks.h, has nothing there). The window's own leak is less, but for 4e-5 just above the edge; it
   would be four times that with a corner at its ends.

   Bands are read as one: a spline of pitch 2 h is one of pitch h too, with the coefficients

     c'(2 m) = (c(m - 1) + 6 c(m) + c(m + 1)) / 8,   c'(2 m + 1) = (c(m) + c(m + 1)) / 2   (in either direction; de Boor
                                                     1978, ch. XI)

   so that to the coefficients of each band those of all coarser ones are added, from the coarsest on, and only the
   finest lattice is read, in patches that are kept (surface/patches.c). A coefficient is the same sum in the same order
   whatever patch it is part of, so that places can be read in any order.

   Measured of a scrape to and fro in instructions a sample (callgrind, AVX2; evidence/profile.md): patches of 8 x 8
   about the place that was read last, made again each time, took 1250, and those of a ball under which squares of 8 x 8
   cells are read half of all its cycles, as each row of a square began again; kept, next to nothing. */
#include "surface/tiles.h"

#include "num/fft_plane.h"
#include "num/lanes.h"
#include "num/real.h"
#include "surface/bicubic.h"
#include "surface/patches.h"
#include "surface/tile.h"

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
        t->at_hand = patches_at(t->patches, column, row);
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
        tile_make(power[b], streams[b], fft, tiles[b]);
    }
    fft_plane_close(fft);
    return patches_make(a, &(struct patches_plan){bands, (const double *const *)tiles, streams, once});
}

struct relief_part *tiles_part(struct arena *a, const struct spectrum *s, const struct tiles_grain *g,
                               struct noise stream, double *lost, struct err *e)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct tiles *t = ARENA_TAKE(a, struct tiles, 1);
    double(*power)[TILE_LINES] = (double(*)[TILE_LINES])ARENA_TAKE(a, double, TILE_BANDS *TILE_LINES);
    t->round = g->ratio == 1;
    t->shrink = 1 / g->ratio;
    t->cos_d = t->round ? 1 : real_cos(g->direction);
    t->sin_d = t->round ? 0 : real_sin(g->direction);
    int bands = tile_rings(s, power);
    double moved = tile_mend(bands, power);
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
    *part = (struct relief_part){.name = "tiles",
                                 .finest = h,
                                 .add = tiles_add,
                                 .state = t,
                                 .pitch = {t->sin_d == 0 ? h * g->ratio : 0, t->sin_d == 0 ? h : 0},
                                 .from = {-HUGE_VAL, -HUGE_VAL},
                                 .to = {HUGE_VAL, HUGE_VAL}};
    return part;
}
