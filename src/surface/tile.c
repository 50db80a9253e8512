/* See tile.h, and surface/tiles.c for the whole. */
#include "surface/tile.h"

#include <math.h>
#include <string.h>

#include "num/real.h"

enum { N = TILE_SIDE, HALF = N / 2 };

int tile_rings(const struct spectrum *s, double (*power)[TILE_LINES])
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

double tile_mend(int bands, double (*power)[TILE_LINES])
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

/* Column 0 holds each line and its conjugate. */
static void conjugate(double *re, double *im)
{
    for (int j = 1; j < HALF; j++) {
        re[(N - j) * (HALF + 1)] = re[j * (HALF + 1)];
        im[(N - j) * (HALF + 1)] = -im[j * (HALF + 1)];
    }
    im[0] = 0;
}

void tile_make(const double power[TILE_LINES], struct noise stream, struct fft_plane *fft, double *tile)
{
    double *re = fft_plane_re(fft), *im = fft_plane_im(fft), modulus[TILE_LINES], spline[TILE_LINES];
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
    conjugate(re, im);
    const double *x = fft_plane_inverse(fft);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < TILE_ROW; i++)
            tile[j * TILE_ROW + i] = x[j * N + i % N];
}
