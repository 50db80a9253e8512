/* See mesh_check.h. */
#include "fem/mesh_check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fem/boundary.h"
#include "fem/solid_element.h"
#include "fem/topology.h"
#include "file/mesh.h"

/* Each element for itself. The Jacobian of a curved element is looked at in the 35 places of the lattice of quarters
   (nodes are among them) and in the four and five of the usual quadratures; of a straight one it is the same
   everywhere. A sliver's radius ratio, 3 inscribed / circumscribed, is 1 of a regular tetrahedron and 0 of a flat one.
 */

static const double flat = 1e-9;   /* of the longest edge cubed: volumes (six times) below are none */
static const double sliver = 0.01; /* radius ratio */

/* The middle of an element's corners, m. */
static void middle_of(const struct mesh *m, int element, double at[3])
{
    for (int c = 0; c < 3; c++) {
        at[c] = 0;
        for (int i = 0; i < 4; i++)
            at[c] += m->at[m->element[element][i]][c] / 4;
    }
}

static void edge(const struct mesh *m, const int *t, int i, int j, double d[3])
{
    for (int c = 0; c < 3; c++)
        d[c] = m->at[t[j]][c] - m->at[t[i]][c];
}

/* Six times the volume between the corners, over the longest edge cubed: 0.7 of a regular tetrahedron. */
static double shape_of(const struct mesh *m, const int *t)
{
    double longest = 0, d[3], p[3], q[3], r[3];
    for (int k = 0; k < 6; k++) {
        edge(m, t, topology_edge_nodes[k][0], topology_edge_nodes[k][1], d);
        longest = fmax(longest, sqrt(boundary_dot(d, d)));
    }
    edge(m, t, 0, 1, d);
    edge(m, t, 0, 2, p);
    edge(m, t, 0, 3, q);
    boundary_cross(d, p, r);
    return longest > 0 ? boundary_dot(r, q) / (longest * longest * longest) : 0;
}

/* 3 r/R: r = 3 V/S; R = sqrt(s) / (24 V), s of the products of opposite edges as Heron's formula. */
static double radius_ratio(const struct mesh *m, const int *t)
{
    static const int opposite[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}};
    double product[3], surface = 0, d[3], f[3], n[3];
    for (int k = 0; k < 3; k++) {
        edge(m, t, opposite[k][0], opposite[k][1], d);
        edge(m, t, opposite[k][2], opposite[k][3], f);
        product[k] = sqrt(boundary_dot(d, d) * boundary_dot(f, f));
    }
    for (int k = 0; k < 4; k++) {
        edge(m, t, topology_face_nodes[k][0], topology_face_nodes[k][1], d);
        edge(m, t, topology_face_nodes[k][0], topology_face_nodes[k][2], f);
        boundary_cross(d, f, n);
        surface += 0.5 * sqrt(boundary_dot(n, n));
    }
    edge(m, t, 0, 1, d);
    edge(m, t, 0, 2, f);
    boundary_cross(d, f, n);
    edge(m, t, 0, 3, d);
    double volume = fabs(boundary_dot(n, d)) / 6, x = product[0], y = product[1], z = product[2];
    double heron = (x + y + z) * (x + y - z) * (x - y + z) * (y + z - x);
    return heron > 0 ? 9 * volume / surface * 24 * volume / sqrt(heron) : 0;
}

/* The least Jacobian at the places looked at. */
static double least_jacobian(const double at[10][3])
{
    static const double rules[3] = {0.1381966011250105, 1. / 6,
                                    0.0919710780527230}; /* the other three coordinates of points on the medians */
    double least = INFINITY, cof[3][3];
    for (int i = 0; i <= 4; i++)
        for (int j = 0; i + j <= 4; j++)
            for (int k = 0; i + j + k <= 4; k++)
                least = fmin(least, solid_element_jacobian(at, (double[3]){i / 4., j / 4., k / 4.}, cof));
    for (int i = 0; i < 12; i++) {
        double l[3], r = rules[i / 4];
        for (int k = 0; k < 3; k++)
            l[k] = k + 1 == i % 4 ? 1 - 3 * r : r;
        least = fmin(least, solid_element_jacobian(at, l, cof));
    }
    return least;
}

static bool folds(const struct mesh *m, const int *t)
{
    double at[10][3];
    for (int i = 0; i < 10; i++)
        memcpy(at[i], m->at[t[i]], sizeof at[i]);
    return !solid_element_straight((const double(*)[3])at) && !(least_jacobian((const double(*)[3])at) > 0);
}

/* Corners 1 and 2 change places, and so do the midsides of 01 and 20, 13 and 23. */
static void turn(int *t)
{
    static const int pairs[3][2] = {{1, 2}, {4, 6}, {8, 9}};
    for (int i = 0; i < 3; i++) {
        int k = t[pairs[i][0]];
        t[pairs[i][0]] = t[pairs[i][1]];
        t[pairs[i][1]] = k;
    }
}

static bool bad_element(const struct mesh *m, int i, const char *what, struct err *e)
{
    double at[3];
    middle_of(m, i, at);
    return err_set(e, ERR_SCENE, "%s: tetrahedron %d (counted from 1), at (%.4g, %.4g, %.4g) m, %s", m->name, i + 1,
                   at[0], at[1], at[2], what);
}

/* All the one way round, or turned so; none flat. */
static bool orient(struct mesh *m, struct arena *a, struct err *e)
{
    int wrong = 0, first = -1;
    for (int i = 0; i < m->elements; i++) {
        double s = shape_of(m, m->element[i]);
        if (fabs(s) < flat)
            return bad_element(m, i, "has no volume: its corners lie in a plane; mesh again, or leave it out", e);
        if (s < 0 && wrong++ == 0) first = i;
    }
    if (wrong == 0) return true;
    if (wrong < m->elements) {
        char text[160];
        snprintf(text, sizeof text,
                 "is turned inside out, as are %d of %d; the mesh is broken there: mesh again, finer or with another "
                 "algorithm",
                 wrong, m->elements);
        return bad_element(m, first, text, e);
    }
    for (int i = 0; i < m->elements; i++)
        turn(m->element[i]);
    mesh_note(m, a, "all tetrahedra were turned the other way round, and have been turned back");
    return true;
}

/* Each element for itself: volume, orientation (turns all), Jacobians, slivers. */
static bool check_elements(struct mesh *m, struct arena *a, struct err *e)
{
    int slivers = 0, worst = 0;
    double ratio = INFINITY, at[3];
    if (!orient(m, a, e)) return false;
    for (int i = 0; i < m->elements; i++) {
        if (!m->linear && folds(m, m->element[i]))
            return bad_element(m, i,
                               "is so bent that it folds (its Jacobian is not above 0 everywhere); mesh finer there, "
                               "or optimise (gmsh -optimize_ho)",
                               e);
        double r = radius_ratio(m, m->element[i]);
        slivers += r < sliver;
        if (r < ratio) {
            ratio = r;
            worst = i;
        }
    }
    middle_of(m, worst, at);
    if (slivers > 0)
        mesh_note(
            m, a,
            arena_format(a,
                         "%d of %d tetrahedra are nearly flat (radius ratio below %g; the worst, %.2g, at (%.4g, %.4g, "
                         "%.4g) m): they are stiffer than the solid; optimise the mesh (gmsh -optimize_netgen)",
                         slivers, m->elements, sliver, ratio, at[0], at[1], at[2]));
    return true;
}

/* How elements are joined: neighbours share nodes, each face has at most two, and all hang together. */

static const double same = 1e-9; /* of the size: nodes nearer than that are at one place */

static bool check_nodes(const struct mesh *m, double size, struct arena *a, struct err *e)
{
    struct topology_merge g;
    int twice = 0, first = -1;
    topology_merge_open(&g, size, same, (size_t)m->nodes, a);
    for (int i = 0; i < m->nodes; i++) {
        double off[3]; /* however far from the origin the mesh lies */
        for (int c = 0; c < 3; c++)
            off[c] = m->at[i][c] - m->at[0][c];
        int *known = topology_merge_at(&g, off);
        if (*known >= 0 && twice++ == 0) first = i;
        *known = i;
    }
    if (twice == 0) return true;
    const double *p = m->at[first];
    return err_set(e, ERR_SCENE,
                   "%s: %d nodes stand where another one stands, the first at (%.4g, %.4g, %.4g) m: parts that touch "
                   "but are not joined, so that they would move apart; join them before meshing (gmsh: "
                   "BooleanFragments or Coherence) or merge the nodes (Coherence Mesh)",
                   m->name, twice, p[0], p[1], p[2]);
}

static bool bad_place(const struct mesh *m, int node, const char *what, struct err *e)
{
    const double *p = m->at[node];
    return err_set(e, ERR_SCENE, "%s: at (%.4g, %.4g, %.4g) m %s", m->name, p[0], p[1], p[2], what);
}

/* Each edge has one midside, and no midside is a corner, or another edge's. */
static bool check_midsides(const struct mesh *m, struct arena *a, struct err *e)
{
    struct topology_edges t;
    bool *corner = ARENA_TAKE(a, bool, m->nodes);
    int *owner = ARENA_TAKE(a, int, m->nodes); /* 1 + the least node of the edge, 0: none */
    topology_edges_open(&t, a);
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 4; k++)
            corner[m->element[i][k]] = true;
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 6; k++) {
            int p = m->element[i][topology_edge_nodes[k][0]], q = m->element[i][topology_edge_nodes[k][1]],
                mid = m->element[i][4 + k], low = p < q ? p : q;
            int *known = topology_edges_at(&t, p, q);
            if (*known >= 0 && *known != mid)
                return bad_place(m, mid,
                                 "an edge has two midside nodes: elements on both sides of it are not joined; mesh "
                                 "again as one solid",
                                 e);
            if (corner[mid] || (*known < 0 && owner[mid] != 0) || (owner[mid] != 0 && owner[mid] != 1 + low))
                return bad_place(m, mid,
                                 "a midside node is also a corner, or on another edge: elements do not fit together "
                                 "there; mesh again as one solid",
                                 e);
            *known = mid;
            owner[mid] = 1 + low;
        }
    return true;
}

/* Is the side's order of corners an even permutation of the rising one? */
static bool even(const struct mesh *m, const struct topology_face *f)
{
    const int *t = m->element[f->element], *n = topology_face_nodes[f->side];
    int first = 0;
    while (t[n[first]] != f->corner[0])
        first++;
    return t[n[(first + 1) % 3]] == f->corner[1];
}

/* Joins elements with a common face in root; errors of faces. */
static bool check_faces(const struct mesh *m, const struct topology_face *f, int *root, struct err *e)
{
    int n = 4 * m->elements;
    for (int i = 0, alike; i < n; i += alike) {
        alike = topology_faces_alike(f + i, n - i);
        if (alike > 2)
            return bad_place(m, f[i].corner[0],
                             "a face belongs to more than two tetrahedra: some are there twice, or overlap; save the "
                             "mesh with each element once",
                             e);
        if (alike == 2 && even(m, &f[i]) == even(m, &f[i + 1]))
            return bad_place(m, f[i].corner[0],
                             "two tetrahedra lie on the same side of a face: one is there twice, or they overlap; save "
                             "the mesh with each element once",
                             e);
        if (alike == 2) topology_join(root, f[i].element, f[i + 1].element);
    }
    return true;
}

static bool check_bodies(const struct mesh *m, int *root, struct arena *a, struct err *e)
{
    int *size = ARENA_TAKE(a, int, m->elements), bodies = 0, shown = 0;
    const char *sizes = "";
    for (int i = 0; i < m->elements; i++)
        bodies += size[topology_root_of(root, i)]++ == 0;
    for (int i = 0; i < m->elements && shown < 5; i++)
        if (size[i] > 0) sizes = arena_format(a, "%s%s%d", sizes, shown++ ? ", " : "", size[i]);
    return bodies == 1 || err_set(e, ERR_SCENE,
                                  "%s: %d bodies that share no face, of %s%s tetrahedra; an object is one body: save "
                                  "one of them alone (gmsh: a physical volume), or fuse them before meshing",
                                  m->name, bodies, sizes, bodies > shown ? " ..." : "");
}

/* The surface of a solid is one or more closed skins: two faces at every edge, one fan of faces at every node. A skin
   of negative volume bounds a cavity; one of next to none is a gap between faces that should be shared; one of six
   faces or fewer is where one or two elements are missing. */

enum { MISSING = 6 };
static const double no_gap = 1e-9; /* volume over area^1.5 */

struct side_edge {                        /* one edge of one outer face */
    int low, high, face, at_low, at_high; /* slots 3 face + corner */
};

struct surface {
    struct mesh *m;
    int n;
    int (*corner)[3];
    struct side_edge *edge; /* [3 n] sorted */
};

static int by_edge(const void *p, const void *q)
{
    const struct side_edge *a = p, *b = q;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return (a->face > b->face) - (a->face < b->face);
}

static void collect(struct surface *s, const struct topology_face *f, struct arena *a)
{
    int n = 4 * s->m->elements;
    s->corner = arena_take(a, (size_t)n, sizeof *s->corner);
    for (int i = 0, alike; i < n; i += alike) {
        alike = topology_faces_alike(f + i, n - i);
        for (int c = 0; alike == 1 && c < 3; c++)
            s->corner[s->n][c] = s->m->element[f[i].element][topology_face_nodes[f[i].side][c]];
        s->n += alike == 1;
    }
    s->edge = ARENA_TAKE(a, struct side_edge, 3 * (size_t)s->n);
    for (int i = 0; i < 3 * s->n; i++) {
        int p = i, q = i - i % 3 + (i + 1) % 3, *c = s->corner[0];
        bool up = c[p] < c[q];
        s->edge[i] = (struct side_edge){up ? c[p] : c[q], up ? c[q] : c[p], i / 3, up ? p : q, up ? q : p};
    }
    qsort(s->edge, 3 * (size_t)s->n, sizeof *s->edge, by_edge);
}

static bool touching(const struct surface *s, int node, const char *what, struct err *e)
{
    const double *p = s->m->at[node];
    return err_set(e, ERR_SCENE,
                   "%s: at (%.4g, %.4g, %.4g) m the surface touches itself in %s: the solid hangs together by nothing "
                   "there; join its parts by faces, or leave a gap",
                   s->m->name, p[0], p[1], p[2], what);
}

/* Joins faces in skin, and the corners of faces round a node in fan. */
static bool join(const struct surface *s, int *skin, int *fan, struct err *e)
{
    for (int i = 0, n; i < 3 * s->n; i += n) {
        const struct side_edge *d = &s->edge[i];
        for (n = 1; i + n < 3 * s->n && d[n].low == d->low && d[n].high == d->high;)
            n++;
        if (n != 2) return touching(s, d->low, "an edge", e);
        topology_join(skin, d[0].face, d[1].face);
        topology_join(fan, d[0].at_low, d[1].at_low);
        topology_join(fan, d[0].at_high, d[1].at_high);
    }
    return true;
}

static bool check_fans(const struct surface *s, int *fan, struct arena *a, struct err *e)
{
    int *root = ARENA_TAKE(a, int, s->m->nodes); /* 1 + the fan's; 0: none yet */
    for (int i = 0; i < 3 * s->n; i++) {
        int *known = &root[s->corner[i / 3][i % 3]], r = 1 + topology_root_of(fan, i);
        if (*known != 0 && *known != r) return touching(s, s->corner[i / 3][i % 3], "a node", e);
        *known = r;
    }
    return true;
}

/* Adds a face's part to area and volume. */
static void add_face(const struct surface *s, int face, double *area, double *volume)
{
    const double *p = s->m->at[s->corner[face][0]], *q = s->m->at[s->corner[face][1]],
                 *r = s->m->at[s->corner[face][2]], *o = s->m->at[0];
    double n[3];
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, f = (c + 2) % 3;
        n[c] = (q[d] - p[d]) * (r[f] - p[f]) - (q[f] - p[f]) * (r[d] - p[d]);
        *volume += n[c] * (p[c] - o[c]) / 6;
    }
    *area += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static bool check_skins(const struct surface *s, int *skin, struct arena *a, struct err *e)
{
    int *faces = ARENA_TAKE(a, int, s->n), cavities = 0;
    double *area = ARENA_TAKE(a, double, s->n), *volume = ARENA_TAKE(a, double, s->n), hollow = 0;
    for (int i = 0; i < s->n; i++) {
        int r = topology_root_of(skin, i);
        add_face(s, i, &area[r], &volume[r]);
        faces[r]++;
    }
    for (int i = 0; i < s->n; i++) {
        const double *p = s->m->at[s->corner[i][0]];
        if (faces[i] == 0) continue;
        if (fabs(volume[i]) < no_gap * area[i] * sqrt(area[i]))
            return err_set(e, ERR_SCENE,
                           "%s: at (%.4g, %.4g, %.4g) m %d faces that should be shared are not: neighbours there do "
                           "not have the same nodes; mesh again as one solid",
                           s->m->name, p[0], p[1], p[2], faces[i]);
        if (volume[i] < 0 && faces[i] <= MISSING)
            return err_set(
                e, ERR_SCENE,
                "%s: at (%.4g, %.4g, %.4g) m there is a hole of %d faces inside: elements are missing; mesh again",
                s->m->name, p[0], p[1], p[2], faces[i]);
        cavities += volume[i] < 0;
        hollow += volume[i] < 0 ? -volume[i] : 0;
    }
    if (cavities > 0)
        mesh_note(s->m, a,
                  arena_format(a, "the solid has %d closed cavit%s inside, %.3g m^3", cavities,
                               cavities == 1 ? "y" : "ies", hollow));
    return true;
}

/* Elements whose corners all lie on the surface reach across; at edges of a thick solid there are few. */
static void note_thin(const struct surface *s, struct arena *a)
{
    bool *outer = ARENA_TAKE(a, bool, s->m->nodes);
    int across = 0;
    for (int i = 0; i < 3 * s->n; i++)
        outer[s->corner[i / 3][i % 3]] = true;
    for (int i = 0; i < s->m->elements; i++) {
        const int *t = s->m->element[i];
        across += outer[t[0]] && outer[t[1]] && outer[t[2]] && outer[t[3]];
    }
    if (2 * across > s->m->elements)
        mesh_note(
            s->m, a,
            arena_format(
                a,
                "%.0f %% of the elements reach from one side of the solid to the other: one element across bends right "
                "only while it is not much longer than thick; see whether a finer mesh changes the frequencies",
                100. * across / s->m->elements));
}

static const double smallest = 1e-3, largest = 10; /* m */

static double extent(const struct mesh *m)
{
    double size = 0;
    for (int c = 0; c < 3; c++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < m->nodes; i++) {
            low = fmin(low, m->at[i][c]);
            high = fmax(high, m->at[i][c]);
        }
        size = fmax(size, high - low);
    }
    return size;
}

bool mesh_check_size(const char *name, double size, const char *cure, struct err *e)
{
    return (size >= smallest && size <= largest) ||
           err_set(e, ERR_SCENE, "%s: it is %g m large, too %s for an object; %s", name, size,
                   size > largest ? "large" : "small", cure);
}

static bool check_size(const struct mesh *m, double size, struct arena *a, struct err *e)
{
    const char *cure =
        size > largest
            ? arena_format(a, "the file may be in mm or cm: give --unit mm (then it is %g m) or --unit cm (%g m)",
                           size / 1000, size / 100)
            : arena_format(a,
                           "the file may be in a larger unit: give --unit m, cm or mm (1000 times as large it is %g m)",
                           1000 * size);
    return mesh_check_size(m->name, size, cure, e);
}

bool mesh_check(struct mesh *m, struct arena *a, struct err *e)
{
    if (m->elements == 0)
        return err_set(e, ERR_SCENE, "%s: no tetrahedra; fill the solid with elements (gmsh -3, tetgen -pq)", m->name);
    double size = extent(m);
    if (!check_size(m, size, a, e) || !check_elements(m, a, e)) return false;
    struct topology_face *f = topology_faces(m, a);
    int *root = topology_roots(m->elements, a);
    if (!check_nodes(m, size, a, e) || (!m->linear && !check_midsides(m, a, e)) || !check_faces(m, f, root, e) ||
        !check_bodies(m, root, a, e))
        return false;
    struct surface s = {.m = m};
    collect(&s, f, a);
    int *skin = topology_roots(s.n, a), *fan = topology_roots(3 * s.n, a);
    if (!join(&s, skin, fan, e) || !check_fans(&s, fan, a, e) || !check_skins(&s, skin, a, e)) return false;
    note_thin(&s, a);
    return true;
}
