/* See glue.h. A hash table over boxes of 1e-5 of the size; a point near the side of its box is looked for in the next
 * box, too. */
#include "fem/glue.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static const double box = 1e-5;

void glue_open(struct glue *g, double size, double same, size_t most, struct arena *a)
{
    *g = (struct glue){.size = size, .same = same, .room = 1024};
    while (g->room < 2 * most)
        g->room *= 2;
    g->slot = ARENA_TAKE(a, struct glue_slot, g->room);
}

static size_t hash(const struct glue *g, const int64_t cell[3])
{
    uint64_t h = 0;
    for (int i = 0; i < 3; i++)
        h = (h ^ (uint64_t)cell[i]) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
    return (size_t)h & (g->room - 1);
}

static bool near(const struct glue *g, const double *p, const double *q)
{
    return fabs(p[0] - q[0]) <= g->same * g->size && fabs(p[1] - q[1]) <= g->same * g->size &&
           fabs(p[2] - q[2]) <= g->same * g->size;
}

/* The slot of a point near `at` among those of a box, or the free slot behind them. */
static struct glue_slot *find(const struct glue *g, const int64_t cell[3], const double at[3])
{
    size_t i = hash(g, cell);
    while (g->slot[i].used && !near(g, g->slot[i].at, at))
        i = (i + 1) & (g->room - 1);
    return &g->slot[i];
}

int *glue_at(struct glue *g, const double at[3])
{
    for (int q = 0; q < 8; q++) {
        int64_t cell[3];
        for (int c = 0; c < 3; c++)
            cell[c] = (int64_t)floor((at[c] / g->size + (q >> c & 1 ? g->same : -g->same)) / box);
        struct glue_slot *s = find(g, cell, at);
        if (s->used) return &s->number;
    }
    int64_t own[3];
    for (int c = 0; c < 3; c++)
        own[c] = (int64_t)floor(at[c] / g->size / box);
    struct glue_slot *s = find(g, own, at);
    *s = (struct glue_slot){.number = -1, .used = 1};
    memcpy(s->at, at, sizeof s->at);
    return &s->number;
}
