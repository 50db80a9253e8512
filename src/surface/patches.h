/* The lattice of spline coefficients of a random field in the plane (surface/tiles.c, which see), the sum of its bands,
   in patches that are made where they are read and kept. */
#ifndef SURFACE_PATCHES_H
#define SURFACE_PATCHES_H
#include <stdbool.h>

#include "base/arena.h"
#include "num/lanes.h"
#include "num/noise.h"

enum {
    PATCH_CELLS = 8, /* along a side */
    PATCH_EDGE = 2,  /* coefficients beyond the cells' own, on each side */
    PATCH_SIDE = PATCH_CELLS + 2 * PATCH_EDGE,
    PATCH_NUMBERS = PATCH_SIDE * PATCH_SIDE + LANES /* vectors are read beyond the last */
};

struct patches;

struct patches_plan {
    int bands;                   /* the finest first, each of twice the pitch of that before */
    const double *const *tiles;  /* of each band: surface/tile.h; they stay with the caller */
    const struct noise *streams; /* that lay them */
    bool once;                   /* places are not come back to: little is kept */
};

/* The plan itself is not kept. */
struct patches *patches_make(struct arena *a, const struct patches_plan *p);

/* Coefficients [PATCH_SIDE][PATCH_SIDE] of the finest lattice, the first being number (PATCH_CELLS column - PATCH_EDGE,
   PATCH_CELLS row - PATCH_EDGE) along x and y. Good until the next call. */
const double *patches_at(struct patches *p, long column, long row);

/* How often a patch was made, of any band. */
size_t patches_made(const struct patches *p);

/* What they take at most, in bytes. */
size_t patches_bytes(int bands, bool once);

#endif
