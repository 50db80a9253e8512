/* See shapes.h. The cells' size is found so that at fineness 2 the lattice of the shape's own order has about its
 * number of nodes (three freedoms each); fineness N makes cells 2/N as long. */
#include "fem/shapes.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/text.h"
#include "fem/shapes_kinds.h"
#include "fem/topology.h"
#include "scene/units.h"

/* Cells into tetrahedra: the diagonal of every face of a cell starts at the corner of lowest rank, so that two cells
   agree on the face they share (Dompierre, Labbe, Vallet, Camarero: How to subdivide pyramids, prisms and hexahedra
   into tetrahedra, 1999). From the cell's lowest corner V the three faces that V is not on, each two triangles, are
   seen: six tetrahedra. Where all their three diagonals avoid the corner O opposite to V, the three tetrahedra round
   V-O become two: the middle one and O's, so five. Rank: lattice points of even i + j + k first, so that the diagonals
   of a regular lattice are those of a union jack and the mesh has the symmetry of the solid; then the order in which
   they are met. */

struct shapes_maker {
    const struct shapes_blocks *s;
    struct mesh *m;
    struct topology_merge points;
    struct topology_edges edges;
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

/* Points of the lattices with each cell cut into `order` along each side, those that blocks share counted for each: at
 * least as many as nodes of elements of that order. */
static double blocks_nodes(const struct shapes_blocks *s, int order)
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
    int *node = topology_merge_at(&k->points, at);
    if (*node < 0) {
        *node = node_at(k, at);
        k->odd[*node] = (c[0] + c[1] + c[2]) % 2 != 0;
    }
    return *node;
}

static void midside(struct shapes_maker *k, const struct cell *c, int p, int q, int *node)
{
    int *known = topology_edges_at(&k->edges, c->corner[p], c->corner[q]);
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
        midside(k, c, t[topology_edge_nodes[i][0]], t[topology_edge_nodes[i][1]], &e[4 + i]);
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

/* Cells are split into tetrahedra so that neighbours agree; a midside lies where its edge's middle in the lattice lies,
 * so on the true surface. */
static void blocks_mesh(const struct shapes_blocks *s, struct arena *a, struct mesh *m)
{
    struct shapes_maker k = {.s = s, .m = m};
    size_t nodes = (size_t)blocks_nodes(s, 2), cells = 0, faces = 0;
    for (int i = 0; i < s->n; i++) {
        const int *n = s->block[i].n;
        cells += (size_t)n[0] * (size_t)n[1] * (size_t)n[2];
        faces += 4 * ((size_t)n[0] * (size_t)n[1] + (size_t)n[1] * (size_t)n[2] + (size_t)n[2] * (size_t)n[0]);
    }
    m->at = arena_take(a, nodes, sizeof *m->at);
    m->element = arena_take(a, 6 * cells, sizeof *m->element);
    k.face = arena_take(a, faces, sizeof *k.face);
    k.odd = ARENA_TAKE(a, bool, nodes);
    topology_merge_open(&k.points, s->size, 1e-8, nodes, a);
    topology_edges_open(&k.edges, a);
    for (int i = 0; i < s->n; i++)
        make_block(&k, &s->block[i], a);
    make_groups(&k, a);
}

static const double thinnest = 1e-4; /* of the largest length: thinner ones are wrong units rather than objects */

static const char *list(const char *const *names, struct arena *a)
{
    const char *all = names[0];
    for (int i = 1; names[i]; i++)
        all = arena_format(a, "%s, %s", all, names[i]);
    return all;
}

/* Index of the word; -1, and an error that begins with `none` and may end with `all` and the names: it is not there. */
static int index_of(const char *word, const char *const *names, const char *none, const char *all, struct arena *a,
                    struct err *e)
{
    for (int i = 0; names[i]; i++)
        if (!strcmp(word, names[i])) return i;
    const char *near = text_nearest(word, names);
    if (near)
        err_set(e, ERR_USAGE, "%s '%s'; did you mean '%s'?", none, word, near);
    else
        err_set(e, ERR_USAGE, "%s '%s'; %s %s", none, word, all, list(names, a));
    return -1;
}

/* The shape's keys; its fineness, if it is asked for, is the last. */
static const char *const *keys_of(const struct shapes_kind *k, struct arena *a)
{
    const char **names = ARENA_TAKE(a, const char *, SHAPES_LENGTHS + 2);
    int n = 0;
    for (; k->key[n]; n++)
        names[n] = k->key[n];
    names[n] = "fineness";
    return names;
}

static bool read_value(const struct shapes_kind *k, int key, const char *text, struct shapes_ask *q, struct arena *a,
                       struct err *e)
{
    struct units_fault fault = {0};
    if (!k->key[key])
        return text_int(text, 1, 6, &q->fineness) ||
               err_set(e, ERR_USAGE,
                       "fineness is '%s', and must be a whole number from 1 (coarse) to 6; 2 is the default", text);
    double *x = &q->length[key];
    if (!isnan(*x)) return err_set(e, ERR_USAGE, "%s: %s is given twice", k->name, k->key[key]);
    if (!units_read(text, KEY_LENGTH, x, a, &fault))
        return err_set(e, ERR_USAGE, "%s: %s %s%s%s", k->name, k->key[key], fault.text, fault.cure ? "; " : "",
                       fault.cure ? fault.cure : "");
    bool none = *x == 0 && !strcmp(k->key[key], "handle");
    return none || *x > 0 || err_set(e, ERR_USAGE, "%s: %s is '%s', and must be above 0", k->name, k->key[key], text);
}

static bool read_pairs(const struct shapes_kind *k, char *text, struct shapes_ask *q, struct arena *a, struct err *e)
{
    while (text) {
        char *next = strchr(text, ','), *equals;
        if (next) *next++ = '\0';
        equals = strchr(text, '=');
        if (!equals)
            return err_set(e, ERR_USAGE, "%s: '%s' is not of the form KEY=LENGTH, such as %s=10cm", k->name, text,
                           k->key[0]);
        *equals = '\0';
        int key = index_of(text, keys_of(k, a), arena_format(a, "%s has no", k->name), "it has", a, e);
        if (key < 0 || !read_value(k, key, equals + 1, q, a, e)) return false;
        text = next;
    }
    for (int i = 0; i < k->needed; i++)
        if (isnan(q->length[i]))
            return err_set(e, ERR_USAGE, "%s needs %s= (it has %s)", k->name, k->key[i], list(keys_of(k, a), a));
    return true;
}

/* No length is lost against another. */
static bool check_proportions(const struct shapes_kind *k, const struct shapes_ask *q, struct err *e)
{
    int low = 0, high = 0;
    for (int i = 1; k->key[i]; i++) {
        if (q->length[i] > 0 && q->length[i] < q->length[low]) low = i;
        if (q->length[i] > q->length[high]) high = i;
    }
    return q->length[low] >= thinnest * q->length[high] ||
           err_set(e, ERR_USAGE,
                   "%s: %s is %g m and %s %g m, more than %g times as much: no mesh of reasonable elements fits; are "
                   "the units right?",
                   k->name, k->key[low], q->length[low], k->key[high], q->length[high], 1 / thinnest);
}

/* The largest cells that give the points wanted at fineness 2, by bisection of their logarithm. */
static void find_cell(const struct shapes_kind *k, struct shapes_ask *q, double longer, struct arena *a,
                      struct shapes_blocks *s)
{
    struct shapes_ask t = *q;
    double low = INFINITY, high = 0;
    for (int i = 0; k->key[i]; i++) {
        low = q->length[i] > 0 ? fmin(low, q->length[i]) : low;
        high = q->length[i] > 0 ? fmax(high, q->length[i]) : high;
    }
    low /= 100;
    t.fineness = 2;
    for (int i = 0; i < 40; i++) {
        t.cell = sqrt(low * high);
        k->blocks(&t, a, s);
        if (blocks_nodes(s, k->order) > q->nodes)
            low = t.cell;
        else
            high = t.cell;
    }
    q->cell = high * 2 / q->fineness * longer;
    k->blocks(q, a, s);
}

bool shapes_mesh_coarser(const char *text, double longer, struct arena *a, struct mesh *m, struct err *e)
{
    struct shapes_ask q = {.fineness = 2};
    char *copy = arena_text(a, text), *colon = strchr(copy, ':');
    struct shapes_blocks s;
    for (int i = 0; i < SHAPES_LENGTHS; i++)
        q.length[i] = NAN;
    if (colon) *colon = '\0';
    const char *names[SHAPES_KINDS + 1] = {0};
    for (int i = 0; i < SHAPES_KINDS; i++)
        names[i] = shapes_kinds[i]->name;
    int kind = index_of(copy, names, "no shape", "shapes are", a, e);
    if (kind < 0) return false;
    const struct shapes_kind *k = shapes_kinds[kind];
    if (!colon)
        return err_set(e, ERR_USAGE, "%s needs its lengths, such as %s:%s=10cm,...: it has %s", copy, copy, k->key[0],
                       list(keys_of(k, a), a));
    q.nodes = k->nodes;
    if (!read_pairs(k, colon + 1, &q, a, e) || !check_proportions(k, &q, e) || (k->check && !k->check(&q, e)) ||
        !check_proportions(k, &q, e))
        return false;
    *m = (struct mesh){.name = arena_text(a, text)};
    find_cell(k, &q, longer, a, &s);
    blocks_mesh(&s, a, m);
    return true;
}

bool shapes_mesh(const char *text, struct arena *a, struct mesh *m, struct err *e)
{
    return shapes_mesh_coarser(text, 1, a, m, e);
}

int shapes_order(const char *text)
{
    size_t n = strcspn(text, ":");
    for (int i = 0; i < SHAPES_KINDS; i++)
        if (n == strlen(shapes_kinds[i]->name) && !memcmp(text, shapes_kinds[i]->name, n))
            return shapes_kinds[i]->order;
    return 3;
}

const char *shapes_help(void)
{
    return "plate:length=,width=,thickness=       x in [0, length], y in [0, width], z in [0, thickness]; groups x0 x1 "
           "y0 y1 z0 z1\n"
           "bar:length=,width=,thickness=         the same solid, meshed for what is slender\n"
           "rod:length=,diameter=[,wall=]         x in [0, length], axis y = z = 0; wall: a tube; groups x0 x1\n"
           "ring:diameter=,width=,thickness=      round the z axis: outer diameter, radial width, z in [0, thickness]; "
           "groups z0 z1\n"
           "bowl:diameter=,height=,thickness=[,foot=]\n"
           "                                      a cap of a sphere, open upwards, rim at z = height, on a flat foot "
           "(default: a third); groups foot rim\n"
           "sphere:diameter=[,wall=]              round the origin; wall: hollow\n"
           "mug:diameter=,height=,wall=[,bottom=][,handle=]\n"
           "                                      round the z axis, bottom at z = 0, as thick as the wall; handle: its "
           "thickness (default: a tenth of the\n"
           "                                      diameter), in the x-z plane at +x; handle=0: none; groups bottom rim "
           "handle\n"
           "any: fineness=N                       1 coarse, 2 default, ... 6";
}
