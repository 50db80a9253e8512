/* See edges.h. A hash table with linear probing, at most half full. */
#include "fem/edges.h"

#include <stdint.h>

const int edges_nodes[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

void edges_open(struct edges *t, struct arena *a)
{
    *t = (struct edges){.arena = a, .room = 1024, .slot = ARENA_TAKE(a, struct edges_edge, 1024)};
}

static struct edges_edge *find(const struct edges *t, int low, int high)
{
    uint64_t key = ((uint64_t)low << 32 | (uint32_t)high) * 0x9E3779B97F4A7C15u;
    size_t at = key >> 32 & (uint64_t)(t->room - 1);
    while (t->slot[at].high != 0 && (t->slot[at].low != low || t->slot[at].high != high))
        at = (at + 1) & (size_t)(t->room - 1);
    return &t->slot[at];
}

static void grow(struct edges *t)
{
    struct edges old = *t;
    t->room *= 2;
    t->slot = ARENA_TAKE(t->arena, struct edges_edge, t->room);
    for (int i = 0; i < old.room; i++)
        if (old.slot[i].high != 0) *find(t, old.slot[i].low, old.slot[i].high) = old.slot[i];
}

int *edges_at(struct edges *t, int one, int other)
{
    if (2 * t->n >= t->room) grow(t);
    int low = one < other ? one : other, high = one < other ? other : one;
    struct edges_edge *s = find(t, low, high);
    if (s->high == 0) {
        *s = (struct edges_edge){low, high, -1};
        t->n++;
    }
    return &s->value;
}
