/* A memory of blocks of numbers, made when they are asked for, on an endless lattice of blocks in the plane. */
#ifndef SURFACE_KEPT_H
#define SURFACE_KEPT_H
#include <stddef.h>

#include "base/arena.h"

struct kept;

/* Writes the `size` numbers of block (column, row); they must depend on nothing else. It may not read the same memory.
 */
typedef void kept_fill(void *self, long column, long row, double *out);

/* Blocks of `size` numbers each; beyond `capacity` of them (at least 1) a new one takes the place of that not asked for
 * the longest. Memory is taken as blocks are made. */
struct kept *kept_make(struct arena *a, size_t size, size_t capacity, kept_fill *fill, void *self);

/* The block's numbers, good until the next call. */
const double *kept_at(struct kept *k, long column, long row);

/* How often a block was made. */
size_t kept_made(const struct kept *k);

/* What such a memory takes when it is full, in bytes. */
size_t kept_bytes(size_t size, size_t capacity);

#endif
