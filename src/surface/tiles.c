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

   Each band keeps a patch of PATCH x PATCH coefficients about where it was read last, placed ahead in the direction of travel. A
   coefficient is the same sum in the same order whatever patch it is part of, so that places can be read in any order. */
#include "surface/tiles.h"

#include <limits.h>
#include <string.h>

#include "num/fft_plane.h"
#include "num/lanes.h"
#include "num/real.h"
#include "surface/tile.h"

enum { N = TILE_SIDE, HALF = N / 2, PATCH = TILE_EXTRA, KEPT = 8, CHUNK = 64 };

#define INLINE static inline __attribute__((always_inline))

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
    long x0, y0;            /* of the patch; x0 = LONG_MIN: none */
    double c[PATCH][PATCH];
};

struct tiles {
    double cos_d, sin_d, shrink; /* xi = shrink (cos_d x + sin_d y), eta = cos_d y - sin_d x */
    double window[N];
    int n_bands;
    struct band bands[TILE_BANDS];
};

/* ------------------------------------------------------------------ coefficients */

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

/* Adds a block's rows [y, y1) and columns [x, x1), counted in the patch. */
LANES_CLONES
static void block_add(struct band *b, const double *window, const struct block *k, const long box[4])
{
    long left = b->x0 - k->bx * HALF, below = b->y0 - k->by * HALF; /* the patch's corner, in the block */
    for (long y = box[2]; y < box[3]; y++) {
        long row = (k->at_y + below + y) & (N - 1), column = (k->at_x + left + box[0]) & (N - 1);
        const double *t = b->tile + row * TILE_ROW + column, *w = window + left + box[0];
        double factor = k->sign * window[below + y], *c = b->c[y] + box[0];
#pragma omp simd
        for (long x = 0; x < box[1] - box[0]; x++)
            c[x] += factor * (w[x] * t[x]);
    }
}

static long block_of(long i)
{
    return i >= 0 ? i / HALF : -((-i + HALF - 1) / HALF);
}

static long least(long a, long b)
{
    return a < b ? a : b;
}

static long most(long a, long b)
{
    return a > b ? a : b;
}

static void patch_fill(struct band *b, const double *window, long x0, long y0)
{
    b->x0 = x0;
    b->y0 = y0;
    memset(b->c, 0, sizeof b->c);
    for (long by = block_of(y0) - 1; by <= block_of(y0 + PATCH - 1); by++)
        for (long bx = block_of(x0) - 1; bx <= block_of(x0 + PATCH - 1); bx++) {
            long x = bx * HALF - x0, y = by * HALF - y0;
            long box[4] = {most(x, 0), least(x + N, PATCH), most(y, 0), least(y + N, PATCH)};
            block_add(b, window, block_at(b, bx, by), box);
        }
}

/* Where a patch begins so that cells i - 1 .. i + 2 lie in it, with room ahead when it left the old one at `from`. */
static long patch_start(long i, long from)
{
    if (i - 1 >= from && i + 2 < from + PATCH)
        return i - 1 - (PATCH - 4) / 2;
    return i - 1 < from ? i + 3 - PATCH : i - 1;
}

static void patch_hold(struct band *b, const double *window, long i, long j)
{
    if (b->x0 != LONG_MIN && i - 1 >= b->x0 && i + 2 < b->x0 + PATCH && j - 1 >= b->y0 && j + 2 < b->y0 + PATCH)
        return;
    bool none = b->x0 == LONG_MIN;
    patch_fill(b, window, patch_start(i, none ? i - 3 : b->x0), patch_start(j, none ? j - 3 : b->y0));
}

/* ------------------------------------------------------------------ values */

struct sums {              /* z and derivatives in xi and eta, of a chunk */
    double z[CHUNK], x[CHUNK], y[CHUNK], xx[CHUNK], xy[CHUNK], yy[CHUNK];
};

struct gathered {           /* a chunk's places in their cells, and the 4 x 4 coefficients about each */
    double f[CHUNK], g[CHUNK], c[16][CHUNK];
};

INLINE long cell_of(double p)
{
    long cell = (long)p;
    return cell - (p < (double)cell);
}

static void band_gather(struct band *b, const double *window, size_t n, const double *place[2], struct gathered *c)
{
    double u = 1 / b->pitch;
    for (size_t i = 0; i < n; i++) {
        double p = place[0][i] * u, q = place[1][i] * u;
        long column = cell_of(p), row = cell_of(q);
        patch_hold(b, window, column, row);
        const double *at = &b->c[row - 1 - b->y0][column - 1 - b->x0];
        c->f[i] = p - (double)column;
        c->g[i] = q - (double)row;
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 4; k++)
                c->c[4 * j + k][i] = at[j * PATCH + k];
    }
}

/* Four numbers by name: in arrays, gcc would not vectorise the loop below. */
struct four {
    double a, b, c, d;
};

INLINE double dot(struct four u, struct four v)
{
    return (u.a * v.a + u.b * v.b) + (u.c * v.c + u.d * v.d);
}

/* The four B-splines over a cell, their first and second derivatives, at f in [0, 1), g = 1 - f. */
INLINE struct four basis(double f, double g)
{
    return (struct four){g * g * g / 6, 2.0 / 3 - f * f + 0.5 * f * f * f, 2.0 / 3 - g * g + 0.5 * g * g * g, f * f * f / 6};
}

INLINE struct four basis_slope(double f, double g)
{
    return (struct four){-0.5 * g * g, -2 * f + 1.5 * f * f, 2 * g - 1.5 * g * g, 0.5 * f * f};
}

INLINE struct four basis_bend(double f, double g)
{
    return (struct four){g, -2 + 3 * f, -2 + 3 * g, f};
}

INLINE struct four columns(struct four by, const double c[16][CHUNK], size_t i)
{
    return (struct four){dot(by, (struct four){c[0][i], c[4][i], c[8][i], c[12][i]}), dot(by, (struct four){c[1][i], c[5][i], c[9][i], c[13][i]}),
                         dot(by, (struct four){c[2][i], c[6][i], c[10][i], c[14][i]}),
                         dot(by, (struct four){c[3][i], c[7][i], c[11][i], c[15][i]})};
}

/* Adds sum of c[j][k] B(f - k) B(g - j) and its derivatives; u = 1/pitch. n points, a multiple of LANES. */
LANES_CLONES
static void band_sum(size_t n, const struct gathered *c, double u, struct sums *s)
{
    double uu = u * u;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double f = c->f[i], g = c->g[i];
        struct four b = basis(f, 1 - f), slope = basis_slope(f, 1 - f), bend = basis_bend(f, 1 - f);
        struct four flat = columns(basis(g, 1 - g), c->c, i), rise = columns(basis_slope(g, 1 - g), c->c, i);
        s->z[i] += dot(flat, b);
        s->x[i] += u * dot(flat, slope);
        s->xx[i] += uu * dot(flat, bend);
        s->y[i] += u * dot(rise, b);
        s->xy[i] += uu * dot(rise, slope);
        s->yy[i] += uu * dot(columns(basis_bend(g, 1 - g), c->c, i), b);
    }
}

/* Derivatives in xi and eta turned into those in x and y, and added: xi = a x + b y, eta = c x + d y. */
static void chain_add(const struct tiles *t, size_t n, const struct sums *s, const struct relief_values *v, size_t at)
{
    double a = t->shrink * t->cos_d, b = t->shrink * t->sin_d, c = -t->sin_d, d = t->cos_d;
    for (size_t i = 0; i < n; i++) {
        if (v->z)
            v->z[at + i] += s->z[i];
        if (v->x)
            v->x[at + i] += a * s->x[i] + c * s->y[i];
        if (v->y)
            v->y[at + i] += b * s->x[i] + d * s->y[i];
        if (v->xx)
            v->xx[at + i] += a * a * s->xx[i] + 2 * a * c * s->xy[i] + c * c * s->yy[i];
        if (v->xy)
            v->xy[at + i] += a * b * s->xx[i] + (a * d + b * c) * s->xy[i] + c * d * s->yy[i];
        if (v->yy)
            v->yy[at + i] += b * b * s->xx[i] + 2 * b * d * s->xy[i] + d * d * s->yy[i];
    }
}

static void tiles_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct tiles *t = part->state;
    double xi[CHUNK], eta[CHUNK];
    struct gathered c = {{0}, {0}, {{0}}};
    for (size_t at = 0; at < p->n; at += CHUNK) {
        size_t n = p->n - at < CHUNK ? p->n - at : CHUNK;
        struct sums s = {{0}, {0}, {0}, {0}, {0}, {0}};
        for (size_t i = 0; i < n; i++) {
            double x = p->x[at + i], y = p->y ? p->y[at + i] : 0;
            xi[i] = t->shrink * (t->cos_d * x + t->sin_d * y);
            eta[i] = t->cos_d * y - t->sin_d * x;
        }
        for (int b = 0; b < t->n_bands; b++) {
            band_gather(&t->bands[b], t->window, n, (const double *[2]){xi, eta}, &c);
            band_sum((n + LANES - 1) / LANES * LANES, &c, 1 / t->bands[b].pitch, &s);
        }
        chain_add(t, n, &s, v, at);
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
