/* A memory of blocks of numbers, made when they are asked for, on an endless lattice of blocks in the plane. */
#ifndef SURFACE_BLOCK_CACHE_H
#define SURFACE_BLOCK_CACHE_H
#include <stddef.h>

#include "base/arena.h"

struct block_cache;

/* Writes the `size` numbers of block (column, row); they must depend on nothing else. It may not read the same memory.
 */
typedef void block_cache_fill(void *self, long column, long row, double *out);

/* Blocks of `size` numbers each; beyond `capacity` of them (at least 1) a new one takes the place of that not asked for
 * the longest. Memory is taken as blocks are made. */
struct block_cache *block_cache_make(struct arena *a, size_t size, size_t capacity, block_cache_fill *fill, void *self);

/* The block's numbers, good until the next call. */
const double *block_cache_at(struct block_cache *k, long column, long row);

/* How often a block was made. */
size_t block_cache_made(const struct block_cache *k);

/* What such a memory takes when it is full, in bytes. */
size_t block_cache_bytes(size_t size, size_t capacity);

/* ------------------------------------------------------------------ an endless lattice of points, in such blocks */

struct lattice {
    struct block_cache *blocks; /* of side[0] x side[1] points, and what belongs to them */
    long side[2];
};

/* Points [from, from + size) of the lattice, in rows that begin `stride` numbers apart; of blocks that hold their
 * points alone. */
void block_cache_gather(const struct lattice *g, const long from[2], const long size[2], double *out, long stride);

/* The block in which point i lies, of blocks of n points. */
long block_cache_index(long i, long n);

#endif
