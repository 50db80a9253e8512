/* Cells into tetrahedra: the diagonal of every face of a cell starts at the corner of lowest rank, so that two cells
   agree on the face they share (Dompierre, Labbe, Vallet, Camarero: How to subdivide pyramids, prisms and hexahedra
   into tetrahedra, 1999). From the cell's lowest corner V the three faces that V is not on, each two triangles, are
   seen: six tetrahedra. Where all their three diagonals avoid the corner O opposite to V, the three tetrahedra round
   V-O become two: the middle one and O's, so five. Rank: lattice points of even i + j + k first, so that the diagonals
   of a regular lattice are those of a union jack and the mesh has the symmetry of the solid; then the order in which
   they are met. */
#include "fem/shapes_blocks.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "fem/edges.h"
#include "fem/glue.h"

struct shapes_maker {
    const struct shapes_blocks *s;
    struct mesh *m;
    struct glue glue;
    struct edges edges;
    bool *odd; /* [nodes] */
    struct {
        const char *group;
        int corner[3];
    } * face;
    int faces;
};

struct cell {
    const struct shapes_block *block;
    int at[3], corner[8]; /* lattice place; nodes: bit 0, 1, 2 of the index is the direction */
};

struct shapes_block *shapes_blocks_add(struct shapes_blocks *s, int which, int n0, int n1, int n2)
{
    s->block[s->n] = (struct shapes_block){.n = {n0, n1, n2}, .which = which};
    return &s->block[s->n++];
}

double shapes_blocks_nodes(const struct shapes_blocks *s, int order)
{
    double n = 0;
    for (int i = 0; i < s->n; i++)
        n += ((double)order * s->block[i].n[0] + 1) * ((double)order * s->block[i].n[1] + 1) *
             ((double)order * s->block[i].n[2] + 1);
    return n;
}

static int node_at(struct shapes_maker *k, const double at[3])
{
    memcpy(k->m->at[k->m->nodes], at, 3 * sizeof *at);
    return k->m->nodes++;
}

/* The node of a lattice point, made if no other block has one there. */
static int corner_at(struct shapes_maker *k, const struct shapes_block *b, const int c[3])
{
    double at[3];
    k->s->place(k->s->shape, b->which, (double[3]){c[0], c[1], c[2]}, at);
    int *node = glue_at(&k->glue, at);
    if (*node < 0) {
        *node = node_at(k, at);
        k->odd[*node] = (c[0] + c[1] + c[2]) % 2 != 0;
    }
    return *node;
}

static void midside(struct shapes_maker *k, const struct cell *c, int p, int q, int *node)
{
    int *known = edges_at(&k->edges, c->corner[p], c->corner[q]);
    if (*known < 0) {
        double mid[3], at[3];
        for (int d = 0; d < 3; d++)
            mid[d] = c->at[d] + 0.5 * ((p >> d & 1) + (q >> d & 1));
        k->s->place(k->s->shape, c->block->which, mid, at);
        *known = node_at(k, at);
    }
    *node = *known;
}

/* Six times the volume of the tetrahedron of straight edges. */
static double turning(const struct mesh *m, const struct cell *c, const int t[4])
{
    double e[3][3];
    for (int i = 0; i < 3; i++)
        for (int d = 0; d < 3; d++)
            e[i][d] = m->at[c->corner[t[i + 1]]][d] - m->at[c->corner[t[0]]][d];
    return e[2][0] * (e[0][1] * e[1][2] - e[0][2] * e[1][1]) + e[2][1] * (e[0][2] * e[1][0] - e[0][0] * e[1][2]) +
           e[2][2] * (e[0][0] * e[1][1] - e[0][1] * e[1][0]);
}

/* Of four corners of the cell, in any orientation. */
static void tetrahedron(struct shapes_maker *k, const struct cell *c, int p, int q, int r, int s)
{
    int t[4] = {p, q, r, s}, *e = k->m->element[k->m->elements++];
    if (turning(k->m, c, t) < 0) {
        t[1] = r;
        t[2] = q;
    }
    for (int i = 0; i < 4; i++)
        e[i] = c->corner[t[i]];
    for (int i = 0; i < 6; i++)
        midside(k, c, t[edges_nodes[i][0]], t[edges_nodes[i][1]], &e[4 + i]);
}

static bool before(const struct shapes_maker *k, int a, int b) { return k->odd[a] != k->odd[b] ? k->odd[b] : a < b; }

/* Index of the one of lowest rank among n corners. */
static int lowest(const struct shapes_maker *k, const struct cell *c, const int *corner, int n)
{
    int best = 0;
    for (int i = 1; i < n; i++)
        if (before(k, c->corner[corner[i]], c->corner[corner[best]])) best = i;
    return best;
}

/* Corners round the face that lies at corner `at` across direction d, beginning there. */
static void face_of(int at, int d, int corner[4])
{
    int e = 1 << (d + 1) % 3, f = 1 << (d + 2) % 3;
    corner[0] = at;
    corner[1] = at ^ e;
    corner[2] = at ^ e ^ f;
    corner[3] = at ^ f;
}

static void split(struct shapes_maker *k, const struct cell *c)
{
    static const int all[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    int v = lowest(k, c, all, 8), o = v ^ 7, avoid = 0, q[3][4], first[3];
    for (int d = 0; d < 3; d++) {
        face_of(o, d, q[d]);
        first[d] = lowest(k, c, q[d], 4);
        avoid += first[d] % 2;
    }
    for (int d = 0; d < 3; d++)
        for (int half = 0; half < 2; half++) {
            int i = q[d][first[d]], j = q[d][(first[d] + 1 + half) % 4], l = q[d][(first[d] + 2 + half) % 4];
            if (avoid < 3 || (i != o && j != o && l != o)) tetrahedron(k, c, v, i, j, l);
        }
    if (avoid == 3) {
        tetrahedron(k, c, v, o ^ 1, o ^ 2, o ^ 4);
        tetrahedron(k, c, o, o ^ 1, o ^ 2, o ^ 4);
    }
}

/* The cell's faces at a side of the block that has a name. */
static void name_faces(struct shapes_maker *k, const struct cell *c)
{
    for (int d = 0; d < 3; d++)
        for (int end = 0; end < 2; end++) {
            if (!c->block->side[d][end] || c->at[d] != (end ? c->block->n[d] - 1 : 0)) continue;
            int q[4];
            face_of(end << d, d, q);
            int i = lowest(k, c, q, 4);
            for (int half = 0; half < 2; half++, k->faces++) {
                k->face[k->faces].group = c->block->side[d][end];
                for (int j = 0; j < 3; j++)
                    k->face[k->faces].corner[j] = c->corner[q[(i + (j ? j + half : 0)) % 4]];
            }
        }
}

static void make_block(struct shapes_maker *k, const struct shapes_block *b, struct arena *a)
{
    size_t row = (size_t)b->n[0] + 1, plane = row * ((size_t)b->n[1] + 1);
    int *node = ARENA_TAKE(a, int, plane *((size_t)b->n[2] + 1)), i[3];
    for (i[2] = 0; i[2] <= b->n[2]; i[2]++)
        for (i[1] = 0; i[1] <= b->n[1]; i[1]++)
            for (i[0] = 0; i[0] <= b->n[0]; i[0]++)
                node[(size_t)i[2] * plane + (size_t)i[1] * row + (size_t)i[0]] = corner_at(k, b, i);
    for (i[2] = 0; i[2] < b->n[2]; i[2]++)
        for (i[1] = 0; i[1] < b->n[1]; i[1]++)
            for (i[0] = 0; i[0] < b->n[0]; i[0]++) {
                struct cell c = {.block = b, .at = {i[0], i[1], i[2]}};
                for (int q = 0; q < 8; q++)
                    c.corner[q] = node[((size_t)i[2] + (size_t)(q >> 2)) * plane +
                                       ((size_t)i[1] + (size_t)(q >> 1 & 1)) * row + (size_t)i[0] + (size_t)(q & 1)];
                split(k, &c);
                name_faces(k, &c);
            }
}

static struct mesh_group *group_of(struct mesh *m, const char *name)
{
    for (int i = 0; i < m->groups; i++)
        if (!strcmp(m->group[i].name, name)) return &m->group[i];
    m->group[m->groups].name = name;
    return &m->group[m->groups++];
}

static void make_groups(const struct shapes_maker *k, struct arena *a)
{
    k->m->group = ARENA_TAKE(a, struct mesh_group, SHAPES_BLOCKS_MOST * 6);
    for (int i = 0; i < k->faces; i++)
        group_of(k->m, k->face[i].group)->n++;
    for (int i = 0; i < k->m->groups; i++) {
        k->m->group[i].corner = arena_take(a, (size_t)k->m->group[i].n, sizeof *k->m->group[i].corner);
        k->m->group[i].n = 0;
    }
    for (int i = 0; i < k->faces; i++) {
        struct mesh_group *g = group_of(k->m, k->face[i].group);
        memcpy(g->corner[g->n++], k->face[i].corner, sizeof k->face[i].corner);
    }
}

void shapes_blocks_mesh(const struct shapes_blocks *s, struct arena *a, struct mesh *m)
{
    struct shapes_maker k = {.s = s, .m = m};
    size_t nodes = (size_t)shapes_blocks_nodes(s, 2), cells = 0, faces = 0;
    for (int i = 0; i < s->n; i++) {
        const int *n = s->block[i].n;
        cells += (size_t)n[0] * (size_t)n[1] * (size_t)n[2];
        faces += 4 * ((size_t)n[0] * (size_t)n[1] + (size_t)n[1] * (size_t)n[2] + (size_t)n[2] * (size_t)n[0]);
    }
    m->at = arena_take(a, nodes, sizeof *m->at);
    m->element = arena_take(a, 6 * cells, sizeof *m->element);
    k.face = arena_take(a, faces, sizeof *k.face);
    k.odd = ARENA_TAKE(a, bool, nodes);
    glue_open(&k.glue, s->size, 1e-8, nodes, a);
    edges_open(&k.edges, a);
    for (int i = 0; i < s->n; i++)
        make_block(&k, &s->block[i], a);
    make_groups(&k, a);
}
