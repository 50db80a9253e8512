/* See kept.h. A hash table with open addressing, at most half full, so that a free slot ends every search. Forgetting is counting on:
   a slot holds a block if it was written in the present age. */
#include "surface/kept.h"

#include <stdint.h>

struct slot {
    long column, row;
    uint64_t age;
    double *numbers;
};

struct kept {
    struct arena *arena;
    size_t size, capacity, held, slots; /* slots: a power of two */
    uint64_t age;
    struct slot *table;
    double **numbers;                   /* [capacity]; NULL: not needed yet */
    kept_fill *fill;
    void *self;
};

struct kept *kept_make(struct arena *a, size_t size, size_t capacity, kept_fill *fill, void *self)
{
    struct kept *k = ARENA_TAKE(a, struct kept, 1);
    size_t slots = 16;
    while (slots < 2 * capacity)
        slots *= 2;
    *k = (struct kept){.arena = a, .size = size, .capacity = capacity, .slots = slots, .age = 1, .fill = fill, .self = self,
                       .table = ARENA_TAKE(a, struct slot, slots), .numbers = ARENA_TAKE(a, double *, capacity)};
    return k;
}

/* The multiplier is 2^64 over the golden ratio (Knuth, The Art of Computer Programming, 6.4). */
static size_t slot_of(const struct kept *k, long column, long row)
{
    uint64_t mixed = ((uint64_t)row * 0x9E3779B97F4A7C15u + (uint64_t)column) * 0x9E3779B97F4A7C15u;
    return (size_t)(mixed >> 32) & (k->slots - 1);
}

static struct slot *slot_find(struct kept *k, long column, long row)
{
    size_t i = slot_of(k, column, row);
    while (k->table[i].age == k->age && (k->table[i].column != column || k->table[i].row != row))
        i = (i + 1) & (k->slots - 1);
    return &k->table[i];
}

const double *kept_at(struct kept *k, long column, long row)
{
    struct slot *s = slot_find(k, column, row);
    if (s->age == k->age)
        return s->numbers;
    if (k->held == k->capacity) {
        k->held = 0;
        k->age++;
        s = slot_find(k, column, row);
    }
    if (!k->numbers[k->held])
        k->numbers[k->held] = ARENA_TAKE(k->arena, double, k->size);
    *s = (struct slot){column, row, k->age, k->numbers[k->held++]};
    k->fill(k->self, column, row, s->numbers);
    return s->numbers;
}
