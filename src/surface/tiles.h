/* An endless, aperiodic, C2 random field in the plane with a given spectrum, computed where it is read. */
#ifndef SURFACE_TILES_H
#define SURFACE_TILES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "num/fft.h"
#include "num/lanes.h"
#include "num/noise.h"
#include "surface/relief.h"
#include "surface/spectrum.h"

/* Features are `ratio` times longer along `direction` (rad, 0 = +x) than across; ratio 1: isotropic. */
struct tiles_grain {
    double ratio, direction;
    bool once; /* it is read on a way that does not come back: made again where it does, for less memory */
};

/* A part whose traces across the grain (along any line if isotropic) have the spectrum. A density that no surface has
   (spectrum_beyond) is an error, ERR_SCENE; unless `lost` is given: then what is negative is left out, the rest scaled
   to the same rms, and *lost is the share of the power so moved. Gaussian, but for an excess kurtosis within 0.1. Close
   it with its own close(). */
struct relief_part *tiles_part(struct arena *a, const struct spectrum *s, const struct tiles_grain *g,
                               struct noise stream, double *lost, struct err *e);

/* ------------------------------------------------------------------ tiles */

/* Periodic random tiles of B-spline coefficients with the power of a spectrum's octaves: what surface/tiles.c, which
 * see, is laid with. */
enum {
    TILE_SIDE = 128,            /* coefficients, four to the shortest wavelength                */
    TILE_LINES = TILE_SIDE / 4, /* lines of the spectrum in use, along each axis                */
    TILE_EXTRA = 12,            /* first columns again behind the last: a patch's                */
    TILE_ROW = TILE_SIDE + TILE_EXTRA,
    TILE_BANDS = 40
};

/* Power (m^2) of each ring of lines [r, r + 1) of each octave band, top first, power[TILE_BANDS]; how many bands. May
 * be negative. */
int tiles_rings(const struct spectrum *s, double (*power)[TILE_LINES]);

/* Takes out what is negative and scales the rest to the same sum; the share of the whole that it was. */
double tiles_mend(int bands, double (*power)[TILE_LINES]);

/* tile[TILE_SIDE][TILE_ROW] of that power, its phases from the stream; fft has TILE_SIDE. */
void tiles_tile(const double power[TILE_LINES], struct noise stream, struct fft_plane *fft, double *tile);

/* ------------------------------------------------------------------ patches */

/* The lattice of spline coefficients of a random field in the plane (surface/tiles.c, which see), the sum of its bands,
   in patches that are made where they are read and kept. */
enum {
    PATCH_CELLS = 8, /* along a side */
    PATCH_EDGE = 2,  /* coefficients beyond the cells' own, on each side */
    PATCH_SIDE = PATCH_CELLS + 2 * PATCH_EDGE,
    PATCH_NUMBERS = PATCH_SIDE * PATCH_SIDE + LANES /* vectors are read beyond the last */
};

struct patches;

struct patches_plan {
    int bands;                   /* the finest first, each of twice the pitch of that before */
    const double *const *tiles;  /* of each band: surface/tiles.h; they stay with the caller */
    const struct noise *streams; /* that lay them */
    bool once;                   /* places are not come back to: little is kept */
};

/* The plan itself is not kept. */
struct patches *tiles_patches(struct arena *a, const struct patches_plan *p);

/* Coefficients [PATCH_SIDE][PATCH_SIDE] of the finest lattice, the first being number (PATCH_CELLS column - PATCH_EDGE,
   PATCH_CELLS row - PATCH_EDGE) along x and y. Good until the next call. */
const double *tiles_patch(struct patches *p, long column, long row);

/* How often a patch was made, of any band. */
size_t tiles_patches_made(const struct patches *p);

/* What they take at most, in bytes. */
size_t tiles_bytes(int bands, bool once);

#endif
