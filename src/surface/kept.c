/* See kept.h. Blocks lie in chains, one for each value of a hash, and in a ring from the newest to the oldest; number 0
 * is no block, and the ring's two ends. */
#include "surface/kept.h"

#include <stdint.h>

struct block {
    long column, row;
    double *numbers;
    size_t next; /* of the chain; 0: the last */
    size_t newer, older;
};

struct kept {
    struct arena *arena;
    size_t size, capacity, held, made, chains; /* chains: a power of two */
    struct block *blocks;                      /* [capacity + 1] */
    size_t *first;                             /* [chains] */
    kept_fill *fill;
    void *self;
};

static size_t chains_for(size_t capacity)
{
    size_t chains = 16;
    while (chains < capacity)
        chains *= 2;
    return chains;
}

struct kept *kept_make(struct arena *a, size_t size, size_t capacity, kept_fill *fill, void *self)
{
    struct kept *k = ARENA_TAKE(a, struct kept, 1);
    size_t chains = chains_for(capacity);
    *k = (struct kept){.arena = a,
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

size_t kept_bytes(size_t size, size_t capacity)
{
    return rounded(sizeof(struct kept)) + capacity * rounded(size * sizeof(double)) +
           rounded((capacity + 1) * sizeof(struct block)) + rounded(chains_for(capacity) * sizeof(size_t));
}

/* The multiplier is 2^64 over the golden ratio (Knuth, The Art of Computer Programming, 6.4). */
static size_t *chain_of(const struct kept *k, long column, long row)
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
static size_t block_free(struct kept *k)
{
    if (k->held < k->capacity) {
        k->blocks[++k->held].numbers = ARENA_TAKE(k->arena, double, k->size);
        return k->held;
    }
    size_t i = k->blocks[0].newer, *link = chain_of(k, k->blocks[i].column, k->blocks[i].row);
    while (*link != i)
        link = &k->blocks[*link].next;
    *link = k->blocks[i].next;
    block_leave(k->blocks, i);
    return i;
}

const double *kept_at(struct kept *k, long column, long row)
{
    size_t *chain = chain_of(k, column, row), i = *chain;
    struct block *b = k->blocks;
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
    k->fill(k->self, column, row, b[i].numbers);
    return b[i].numbers;
}

size_t kept_made(const struct kept *k) { return k->made; }
