/* How elements are joined: neighbours share nodes, each face has at most two, and all hang together. */
#include "fem/edges.h"
#include "fem/glue.h"
#include "fem/mesh_check_parts.h"
#include "fem/roots.h"

static const double same = 1e-9; /* of the size: nodes nearer than that are at one place */

static bool check_nodes(const struct mesh *m, double size, struct arena *a, struct err *e)
{
    struct glue g;
    int twice = 0, first = -1;
    glue_open(&g, size, same, (size_t)m->nodes, a);
    for (int i = 0; i < m->nodes; i++) {
        double off[3]; /* however far from the origin the mesh lies */
        for (int c = 0; c < 3; c++)
            off[c] = m->at[i][c] - m->at[0][c];
        int *known = glue_at(&g, off);
        if (*known >= 0 && twice++ == 0) first = i;
        *known = i;
    }
    if (twice == 0) return true;
    const double *p = m->at[first];
    return err_set(e, ERR_SCENE,
                   "%s: %d nodes stand where another one stands, the first at (%.4g, %.4g, %.4g) m: parts that touch "
                   "but are not joined, so that they would move apart; join "
                   "them before meshing (gmsh: BooleanFragments or Coherence) or merge the nodes (Coherence Mesh)",
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
    struct edges t;
    bool *corner = ARENA_TAKE(a, bool, m->nodes);
    int *owner = ARENA_TAKE(a, int, m->nodes); /* 1 + the least node of the edge, 0: none */
    edges_open(&t, a);
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 4; k++)
            corner[m->element[i][k]] = true;
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 6; k++) {
            int p = m->element[i][edges_nodes[k][0]], q = m->element[i][edges_nodes[k][1]], mid = m->element[i][4 + k],
                low = p < q ? p : q;
            int *known = edges_at(&t, p, q);
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

static bool bad_face(const struct mesh *m, const struct faces_face *f, const char *what, struct err *e)
{
    return bad_place(m, f->corner[0], what, e);
}

/* Is the side's order of corners an even permutation of the rising one? */
static bool even(const struct mesh *m, const struct faces_face *f)
{
    const int *t = m->element[f->element], *n = faces_nodes[f->side];
    int first = 0;
    while (t[n[first]] != f->corner[0])
        first++;
    return t[n[(first + 1) % 3]] == f->corner[1];
}

/* Joins elements with a common face in root; errors of faces. */
static bool check_faces(const struct mesh *m, const struct faces_face *f, int *root, struct err *e)
{
    int n = 4 * m->elements;
    for (int i = 0, alike; i < n; i += alike) {
        alike = faces_alike(f + i, n - i);
        if (alike > 2)
            return bad_face(m, &f[i],
                            "a face belongs to more than two tetrahedra: some are there twice, or overlap; save the "
                            "mesh with each element once",
                            e);
        if (alike == 2 && even(m, &f[i]) == even(m, &f[i + 1]))
            return bad_face(m, &f[i],
                            "two tetrahedra lie on the same side of a face: one is there twice, or they overlap; save "
                            "the mesh with each element once",
                            e);
        if (alike == 2) roots_join(root, f[i].element, f[i + 1].element);
    }
    return true;
}

static bool check_bodies(const struct mesh *m, int *root, struct arena *a, struct err *e)
{
    int *size = ARENA_TAKE(a, int, m->elements), bodies = 0, said = 0;
    const char *sizes = "";
    for (int i = 0; i < m->elements; i++)
        bodies += size[roots_of(root, i)]++ == 0;
    for (int i = 0; i < m->elements && said < 5; i++)
        if (size[i] > 0) sizes = arena_format(a, "%s%s%d", sizes, said++ ? ", " : "", size[i]);
    return bodies == 1 || err_set(e, ERR_SCENE,
                                  "%s: %d bodies that share no face, of %s%s tetrahedra; an object is one body: save "
                                  "one of them alone (gmsh: a physical volume), "
                                  "or fuse them before meshing",
                                  m->name, bodies, sizes, bodies > said ? " ..." : "");
}

bool mesh_check_joins(const struct mesh *m, const struct faces_face *f, double size, struct arena *a, struct err *e)
{
    int *root = roots_open(m->elements, a);
    return check_nodes(m, size, a, e) && (m->linear || check_midsides(m, a, e)) && check_faces(m, f, root, e) &&
           check_bodies(m, root, a, e);
}
