/* Periodic random tiles of B-spline coefficients with the power of a spectrum's octaves: what surface/tiles.c, which
 * see, is laid with. */
#ifndef SURFACE_TILE_H
#define SURFACE_TILE_H
#include "num/fft_plane.h"
#include "num/noise.h"
#include "surface/spectrum.h"

enum {
    TILE_SIDE = 128,            /* coefficients, four to the shortest wavelength                */
    TILE_LINES = TILE_SIDE / 4, /* lines of the spectrum in use, along each axis                */
    TILE_EXTRA = 12,            /* first columns again behind the last: a patch's                */
    TILE_ROW = TILE_SIDE + TILE_EXTRA,
    TILE_BANDS = 40
};

/* Power (m^2) of each ring of lines [r, r + 1) of each octave band, top first, power[TILE_BANDS]; how many bands. May
 * be negative. */
int tile_rings(const struct spectrum *s, double (*power)[TILE_LINES]);

/* Takes out what is negative and scales the rest to the same sum; the share of the whole that it was. */
double tile_mend(int bands, double (*power)[TILE_LINES]);

/* tile[TILE_SIDE][TILE_ROW] of that power, its phases from the stream; fft has TILE_SIDE. */
void tile_make(const double power[TILE_LINES], struct noise stream, struct fft_plane *fft, double *tile);

#endif
