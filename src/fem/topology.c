/* See topology.h. Edges and points are found in hash tables with linear probing, at most half full. */
#include "fem/topology.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

const int topology_edge_nodes[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

void topology_edges_open(struct topology_edges *t, struct arena *a)
{
    *t = (struct topology_edges){.arena = a, .room = 1024, .slot = ARENA_TAKE(a, struct topology_edge, 1024)};
}

static struct topology_edge *edge_find(const struct topology_edges *t, int low, int high)
{
    uint64_t key = ((uint64_t)low << 32 | (uint32_t)high) * 0x9E3779B97F4A7C15u;
    size_t at = key >> 32 & (uint64_t)(t->room - 1);
    while (t->slot[at].high != 0 && (t->slot[at].low != low || t->slot[at].high != high))
        at = (at + 1) & (size_t)(t->room - 1);
    return &t->slot[at];
}

static void grow(struct topology_edges *t)
{
    struct topology_edges old = *t;
    t->room *= 2;
    t->slot = ARENA_TAKE(t->arena, struct topology_edge, t->room);
    for (int i = 0; i < old.room; i++)
        if (old.slot[i].high != 0) *edge_find(t, old.slot[i].low, old.slot[i].high) = old.slot[i];
}

int *topology_edges_at(struct topology_edges *t, int one, int other)
{
    if (2 * t->n >= t->room) grow(t);
    int low = one < other ? one : other, high = one < other ? other : one;
    struct topology_edge *s = edge_find(t, low, high);
    if (s->high == 0) {
        *s = (struct topology_edge){low, high, -1};
        t->n++;
    }
    return &s->value;
}

const int topology_face_nodes[4][6] = {{1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}, {0, 1, 3, 4, 8, 7}, {0, 2, 1, 6, 5, 4}};

static int by_corners(const void *p, const void *q)
{
    const struct topology_face *f = p, *g = q;
    for (int i = 0; i < 3; i++)
        if (f->corner[i] != g->corner[i]) return f->corner[i] < g->corner[i] ? -1 : 1;
    if (f->element != g->element) return f->element < g->element ? -1 : 1;
    return (f->side > g->side) - (f->side < g->side);
}

void topology_rise(int c[3])
{
    for (int i = 0; i < 3; i++) {
        int *p = &c[i % 2], low = p[0] < p[1] ? p[0] : p[1];
        p[1] = p[0] < p[1] ? p[1] : p[0];
        p[0] = low;
    }
}

struct topology_face *topology_faces(const struct mesh *m, struct arena *a)
{
    size_t n = 4 * (size_t)m->elements;
    struct topology_face *f = ARENA_TAKE(a, struct topology_face, n);
    for (size_t i = 0; i < n; i++) {
        f[i].element = (int)(i / 4);
        f[i].side = (int)(i % 4);
        for (int c = 0; c < 3; c++)
            f[i].corner[c] = m->element[i / 4][topology_face_nodes[i % 4][c]];
        topology_rise(f[i].corner);
    }
    qsort(f, n, sizeof *f, by_corners);
    return f;
}

int topology_faces_alike(const struct topology_face *f, int left)
{
    int n = 1;
    while (n < left && !memcmp(f[n].corner, f[0].corner, sizeof f->corner))
        n++;
    return n;
}

/* A hash table over boxes of 1e-5 of the size; a point near the side of its box is looked for in the next
 * box, too. */

static const double box = 1e-5;

void topology_merge_open(struct topology_merge *g, double size, double same, size_t most, struct arena *a)
{
    *g = (struct topology_merge){.size = size, .same = same, .room = 1024};
    while (g->room < 2 * most)
        g->room *= 2;
    g->slot = ARENA_TAKE(a, struct topology_merge_slot, g->room);
}

static size_t hash(const struct topology_merge *g, const int64_t cell[3])
{
    uint64_t h = 0;
    for (int i = 0; i < 3; i++)
        h = (h ^ (uint64_t)cell[i]) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
    return (size_t)h & (g->room - 1);
}

static bool near(const struct topology_merge *g, const double *p, const double *q)
{
    return fabs(p[0] - q[0]) <= g->same * g->size && fabs(p[1] - q[1]) <= g->same * g->size &&
           fabs(p[2] - q[2]) <= g->same * g->size;
}

/* The slot of a point near `at` among those of a box, or the free slot behind them. */
static struct topology_merge_slot *merge_find(const struct topology_merge *g, const int64_t cell[3], const double at[3])
{
    size_t i = hash(g, cell);
    while (g->slot[i].used && !near(g, g->slot[i].at, at))
        i = (i + 1) & (g->room - 1);
    return &g->slot[i];
}

int *topology_merge_at(struct topology_merge *g, const double at[3])
{
    for (int q = 0; q < 8; q++) {
        int64_t cell[3];
        for (int c = 0; c < 3; c++)
            cell[c] = (int64_t)floor((at[c] / g->size + (q >> c & 1 ? g->same : -g->same)) / box);
        struct topology_merge_slot *s = merge_find(g, cell, at);
        if (s->used) return &s->number;
    }
    int64_t own[3];
    for (int c = 0; c < 3; c++)
        own[c] = (int64_t)floor(at[c] / g->size / box);
    struct topology_merge_slot *s = merge_find(g, own, at);
    *s = (struct topology_merge_slot){.number = -1, .used = 1};
    memcpy(s->at, at, sizeof s->at);
    return &s->number;
}

static const char warning[] =
    "linear elements were raised to quadratic ones with straight edges: their faces stay flat, so what is round wants "
    "a finer mesh or a quadratic one (gmsh -order 2, tetgen -o2)";

void topology_elevate(struct mesh *m, struct arena *a)
{
    if (!m->linear) return;
    struct topology_edges t;
    topology_edges_open(&t, a);
    int n = m->nodes;
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 6; k++) {
            int *number = topology_edges_at(&t, m->element[i][topology_edge_nodes[k][0]],
                                            m->element[i][topology_edge_nodes[k][1]]);
            if (*number < 0) *number = n++;
            m->element[i][4 + k] = *number;
        }
    double(*at)[3] = arena_take(a, (size_t)n, sizeof *at);
    memcpy(at, m->at, (size_t)m->nodes * sizeof *at);
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 6; k++)
            for (int c = 0; c < 3; c++)
                at[m->element[i][4 + k]][c] = 0.5 * at[m->element[i][topology_edge_nodes[k][0]]][c] +
                                              0.5 * at[m->element[i][topology_edge_nodes[k][1]]][c];
    m->at = at;
    m->nodes = n;
    m->linear = false;
    mesh_note(m, a, warning);
}
