/* Numbers on an endless lattice of points, kept in blocks and made when they are asked for. */
#ifndef SURFACE_GRID_H
#define SURFACE_GRID_H
#include "surface/kept.h"

struct grid {
    struct kept *blocks; /* of side[0] x side[1] points, and what belongs to them */
    long side[2];
};

/* Points [from, from + size) of the lattice, in rows that begin `stride` numbers apart; of blocks that hold their
 * points alone. */
void grid_gather(const struct grid *g, const long from[2], const long size[2], double *out, long stride);

/* The block in which point i lies, of blocks of n points. */
long grid_block(long i, long n);

#endif
