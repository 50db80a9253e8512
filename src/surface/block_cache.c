/* Blocks lie in chains, one for each value of a hash, and in a ring from the newest to the oldest; number 0
 * is no block, and the ring's two ends. */
#include "surface/block_cache.h"

#include <stdint.h>
#include <string.h>

#include "base/stopwatch.h"

#define NUMBER 6.0 /* predicted cycles of one that is made, beside what is read for it */

struct block {
    long column, row;
    double *numbers;
    size_t next; /* of the chain; 0: the last */
    size_t newer, older;
};

struct block_cache {
    struct arena *arena;
    size_t size, capacity, filled, made, chains; /* chains: a power of two */
    struct block *blocks;                        /* [capacity + 1] */
    size_t *first;                               /* [chains] */
    block_cache_fill *fill;
    void *self;
};

static size_t chains_for(size_t capacity)
{
    size_t chains = 16;
    while (chains < capacity)
        chains *= 2;
    return chains;
}

struct block_cache *block_cache_make(struct arena *a, size_t size, size_t capacity, block_cache_fill *fill, void *self)
{
    struct block_cache *k = ARENA_TAKE(a, struct block_cache, 1);
    size_t chains = chains_for(capacity);
    *k = (struct block_cache){.arena = a,
                              .size = size,
                              .capacity = capacity,
                              .chains = chains,
                              .fill = fill,
                              .self = self,
                              .blocks = ARENA_TAKE(a, struct block, capacity + 1),
                              .first = ARENA_TAKE(a, size_t, chains)};
    return k;
}

/* As the arena rounds it. */
static size_t rounded(size_t bytes) { return (bytes + 63) / 64 * 64; }

size_t block_cache_bytes(size_t size, size_t capacity)
{
    return rounded(sizeof(struct block_cache)) + capacity * rounded(size * sizeof(double)) +
           rounded((capacity + 1) * sizeof(struct block)) + rounded(chains_for(capacity) * sizeof(size_t));
}

/* The multiplier is 2^64 over the golden ratio (Knuth, The Art of Computer Programming, 6.4). */
static size_t *chain_of(const struct block_cache *k, long column, long row)
{
    uint64_t mixed = ((uint64_t)row * 0x9E3779B97F4A7C15u + (uint64_t)column) * 0x9E3779B97F4A7C15u;
    return &k->first[(size_t)(mixed >> 32) & (k->chains - 1)];
}

static void block_leave(struct block *blocks, size_t i)
{
    blocks[blocks[i].newer].older = blocks[i].older;
    blocks[blocks[i].older].newer = blocks[i].newer;
}

static void block_lead(struct block *blocks, size_t i)
{
    blocks[i].newer = 0;
    blocks[i].older = blocks[0].older;
    blocks[blocks[i].older].newer = i;
    blocks[0].older = i;
}

/* A number that is free, or that of the block not asked for the longest, which is forgotten. */
static size_t block_free(struct block_cache *k)
{
    if (k->filled < k->capacity) {
        k->blocks[++k->filled].numbers = ARENA_TAKE(k->arena, double, k->size);
        return k->filled;
    }
    size_t i = k->blocks[0].newer, *link = chain_of(k, k->blocks[i].column, k->blocks[i].row);
    while (*link != i)
        link = &k->blocks[*link].next;
    *link = k->blocks[i].next;
    block_leave(k->blocks, i);
    return i;
}

const double *block_cache_at(struct block_cache *k, long column, long row)
{
    struct block *b = k->blocks;
    size_t last = b[0].older;
    if (last && b[last].column == column && b[last].row == row) return b[last].numbers;
    size_t *chain = chain_of(k, column, row), i = *chain;
    while (i && (b[i].column != column || b[i].row != row))
        i = b[i].next;
    if (i) {
        block_leave(b, i);
        block_lead(b, i);
        return b[i].numbers;
    }
    i = block_free(k);
    b[i].column = column;
    b[i].row = row;
    b[i].next = *chain;
    *chain = i;
    block_lead(b, i);
    k->made++;
    stopwatch_spend(NUMBER * (double)k->size);
    k->fill(k->self, column, row, b[i].numbers);
    return b[i].numbers;
}

size_t block_cache_made(const struct block_cache *k) { return k->made; }

long block_cache_index(long i, long n) { return i >= 0 ? i / n : -((-i + n - 1) / n); }

void block_cache_gather(const struct lattice *g, const long from[2], const long size[2], double *out, long stride)
{
    for (long by = block_cache_index(from[1], g->side[1]); by * g->side[1] < from[1] + size[1]; by++)
        for (long bx = block_cache_index(from[0], g->side[0]); bx * g->side[0] < from[0] + size[0]; bx++) {
            const double *b = block_cache_at(g->blocks, bx, by);
            long x = bx * g->side[0] - from[0], y = by * g->side[1] - from[1];
            long x0 = x > 0 ? x : 0, x1 = x + g->side[0] < size[0] ? x + g->side[0] : size[0];
            for (long j = y > 0 ? y : 0; j < y + g->side[1] && j < size[1]; j++)
                memcpy(out + j * stride + x0, b + (j - y) * g->side[0] + (x0 - x), (size_t)(x1 - x0) * sizeof *out);
        }
}
