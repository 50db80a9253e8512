/* In the plane across an edge inside which the solid's angle is w, displacement goes with r^s, where s is the least
   root above 1/2 of sin(s w) = s |sin w| (free sides; M. L. Williams, Stress singularities resulting from various
   boundary conditions in angular corners of plates in extension, J. Appl. Mech. 19, 1952; 270 degrees: s = 0.5445).
   Frequencies then converge with h^(2 s), whatever the order. Each layer takes all of that error but its share^(2 s)
   away (tests/unit/test_grade.c), and what is left is that of smooth modes. (sqrt 2 - 1)^2 = 0.17 is the best share in
   one dimension (W. Gui and I. Babuska, The h, p and h-p versions of the finite element method in 1 dimension, part II,
   Numer. Math. 49, 1986).

   A layer: every edge of the mesh with one end on a re-entrant edge is cut there at that share of its length. A cell is
   halved at its edges' cuts in an order that is the same for all cells, so that what two cells share is cut alike.
   Parts are exact parts of the curved cell: a quadratic map of a part is a quadratic map. */
#include "fem/grade.h"

#include <math.h>
#include <string.h>

#include "fem/topology.h"
#include "num/real.h"

static const double share = 0.2;
static const double least = 220.0; /* degrees inside the solid, there s is 0.70: facets of a round hole, and what is
                                      nearly flat, are no re-entrant edges */

struct grade {
    struct mesh *m;
    struct arena *a;
    struct topology_edges edge, middle, cut; /* re-entrant: value 1; midsides; nodes of this layer's cuts */
    bool *on;                                /* [old] lies on a re-entrant edge */
    int old;                                 /* nodes before this layer */
    bool chords;                             /* cut what joins two re-entrant edges, in its middle */
    int (*part)[10], parts;
};

static int add_node(struct grade *g, const double at[3])
{
    g->m->at = arena_more(g->a, g->m->at, g->m->nodes, sizeof *g->m->at);
    memcpy(g->m->at[g->m->nodes], at, sizeof *g->m->at);
    return g->m->nodes++;
}

/* How far from i the edge is cut; 0: it is not. */
static double cut_at(struct grade *g, int i, int j)
{
    if (i >= g->old || j >= g->old) return 0.0;
    if (g->chords) return g->on[i] && g->on[j] && *topology_edges_at(&g->edge, i, j) < 0 ? 0.5 : 0.0;
    return g->on[i] == g->on[j] ? 0.0 : g->on[i] ? share : 1.0 - share;
}

/* The first of n edges that is cut, by their nodes; -1: none. */
static int first_cut(struct grade *g, const int *node, const int (*ends)[2], int n)
{
    int best = -1, low = 0, high = 0;
    for (int k = 0; k < n; k++) {
        int i = node[ends[k][0]], j = node[ends[k][1]], p = i < j ? i : j, q = i < j ? j : i;
        if (cut_at(g, i, j) > 0.0 && (best < 0 || p < low || (p == low && q < high))) {
            best = k;
            low = p;
            high = q;
        }
    }
    return best;
}

/* A place within a cell, by the weights of its corners. */
static void place(const struct mesh *m, const int *cell, const double w[4], double at[3])
{
    for (int k = 0; k < 3; k++) {
        at[k] = 0.0;
        for (int i = 0; i < 4; i++)
            at[k] += w[i] * (2.0 * w[i] - 1.0) * m->at[cell[i]][k];
        for (int i = 0; i < 6; i++)
            at[k] += 4.0 * w[topology_edge_nodes[i][0]] * w[topology_edge_nodes[i][1]] * m->at[cell[4 + i]][k];
    }
}

/* The node there on the edge of those two, of a table; added if it is new. */
static int node_of(struct grade *g, struct topology_edges *t, int one, int other, const int *cell, const double w[4])
{
    int number = *topology_edges_at(t, one, other);
    if (number < 0) {
        double at[3];
        place(g->m, cell, w, at);
        number = add_node(g, at);
        *topology_edges_at(t, one, other) = number;
    }
    return number;
}

static void cut_cell(struct grade *g, const int *cell)
{
    int k = first_cut(g, cell, topology_edge_nodes, 6);
    if (k < 0) {
        g->part = arena_more(g->a, g->part, g->parts, sizeof *g->part);
        memcpy(g->part[g->parts++], cell, sizeof *g->part);
        return;
    }
    const int i = topology_edge_nodes[k][0], j = topology_edge_nodes[k][1];
    double w[4] = {0.0};
    w[j] = cut_at(g, cell[i], cell[j]);
    w[i] = 1.0 - w[j];
    int node = node_of(g, &g->cut, cell[i], cell[j], cell, w);
    for (int side = 0; side < 2; side++) { /* in place of i, of j */
        int part[10], gone = side ? j : i;
        memcpy(part, cell, sizeof part);
        part[gone] = node;
        for (int e = 0; e < 6; e++) {
            const int *ends = topology_edge_nodes[e];
            if (ends[0] != gone && ends[1] != gone) continue;
            int other = ends[0] == gone ? ends[1] : ends[0];
            double half[4];
            for (int c = 0; c < 4; c++)
                half[c] = 0.5 * (w[c] + (c == other));
            part[4 + e] = node_of(g, &g->middle, node, part[other], cell, half);
        }
        cut_cell(g, part);
    }
}

/* The same of a group's face, whose cuts are there already. */
static void cut_face(struct grade *g, const int *face, struct mesh_group *s)
{
    static const int ends[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    int k = first_cut(g, face, ends, 3);
    if (k < 0) {
        s->corner = arena_more(g->a, s->corner, s->n, sizeof *s->corner);
        memcpy(s->corner[s->n++], face, sizeof *s->corner);
        return;
    }
    for (int side = 0; side < 2; side++) {
        int part[3] = {face[0], face[1], face[2]};
        part[ends[k][side]] = *topology_edges_at(&g->cut, face[ends[k][0]], face[ends[k][1]]);
        cut_face(g, part, s);
    }
}

static void layer(struct grade *g, bool chords)
{
    struct mesh *m = g->m;
    g->old = m->nodes;
    g->chords = chords;
    g->part = NULL;
    g->parts = 0;
    topology_edges_open(&g->cut, g->a);
    for (int i = 0; i < m->elements; i++)
        cut_cell(g, m->element[i]);
    m->element = g->part;
    m->elements = g->parts;
    for (int i = 0; i < m->groups; i++) {
        struct mesh_group whole = m->group[i];
        m->group[i].corner = NULL;
        m->group[i].n = 0;
        for (int k = 0; k < whole.n; k++)
            cut_face(g, whole.corner[k], &m->group[i]);
    }
    bool *on = ARENA_TAKE(g->a, bool, m->nodes);
    memcpy(on, g->on, (size_t)g->old * sizeof *on);
    g->on = on;
}

/* Outward, in the middle of side k of a face. */
static void normal(const struct mesh *m, const int face[6], int k, double n[3])
{
    static const double middle[3][2] = {{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}};
    struct boundary_face_at x;
    boundary_face_at(m, face, middle[k], &x);
    double size = sqrt(boundary_dot(x.across, x.across));
    for (int c = 0; c < 3; c++)
        n[c] = x.across[c] / size;
}

/* Edges of the surface whose two faces lean towards each other: their normals' angle, about the edge as the first face
   goes along it, is then negative. */
static int find_edges(struct grade *g, const struct boundary *b)
{
    struct topology_edges first;
    int n = 0;
    topology_edges_open(&first, g->a);
    for (int f = 0; f < b->n; f++)
        for (int k = 0; k < 3; k++) {
            const int *face = b->face[f], i = face[k], j = face[(k + 1) % 3];
            int *other = topology_edges_at(&first, i, j);
            if (*other < 0) {
                *other = 3 * f + k;
                continue;
            }
            double one[3], two[3], across[3], along[3], size;
            normal(g->m, face, k, one);
            normal(g->m, b->face[*other / 3], *other % 3, two);
            for (int c = 0; c < 3; c++)
                along[c] = g->m->at[j][c] - g->m->at[i][c];
            size = sqrt(boundary_dot(along, along));
            boundary_cross(one, two, across);
            double turn = real_atan2(boundary_dot(across, along) / size, boundary_dot(one, two));
            if (180.0 - turn * 180.0 / REAL_PI < least) continue;
            *topology_edges_at(&g->edge, i, j) = 1;
            g->on[i] = g->on[j] = true;
            n++;
        }
    return n;
}

/* Leaves out nodes that no cell has any more. */
static void close_up(struct mesh *m, struct arena *a)
{
    int *now = ARENA_TAKE(a, int, m->nodes), n = 0;
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 10; k++)
            now[m->element[i][k]] = 1;
    for (int i = 0; i < m->nodes; i++)
        if (now[i]) {
            memmove(m->at[n], m->at[i], sizeof *m->at);
            now[i] = n++;
        }
    m->nodes = n;
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 10; k++)
            m->element[i][k] = now[m->element[i][k]];
    for (int i = 0; i < m->groups; i++)
        for (int k = 0; k < m->group[i].n; k++)
            for (int c = 0; c < 3; c++)
                m->group[i].corner[k][c] = now[m->group[i].corner[k][c]];
}

int grade_edges(struct mesh *m, const struct boundary *b, int layers, struct arena *a)
{
    struct grade g = {.m = m, .a = a, .on = ARENA_TAKE(a, bool, m->nodes)};
    topology_edges_open(&g.edge, a);
    topology_edges_open(&g.middle, a);
    int n = layers > 0 ? find_edges(&g, b) : 0;
    if (n == 0) return 0;
    double(*at)[3] = NULL; /* a list that can grow */
    for (int i = 0; i < m->nodes; i++) {
        at = arena_more(a, at, i, sizeof *at);
        memcpy(at[i], m->at[i], sizeof *at);
    }
    m->at = at;
    struct mesh_group *group = ARENA_TAKE(a, struct mesh_group, m->groups);
    if (m->groups) memcpy(group, m->group, (size_t)m->groups * sizeof *group);
    m->group = group;
    layer(&g, true);
    for (int i = 0; i < layers; i++)
        layer(&g, false);
    close_up(m, a);
    return n;
}
