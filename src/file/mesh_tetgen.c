/* TetGen's files (TetGen manual 1.5, section 5.2); '#' begins a remark, nodes count from 0 or 1.

     NAME.node  nodes, dimension (3), attributes, markers (0, 1); per node: number, x y z, attributes, marker
     NAME.ele   elements, nodes of each (4, 10), attributes (0, 1); per element: number, nodes, attributes
     NAME.face  faces, markers (0, 1); per face: number, 3 nodes (of quadratic meshes 3 more), marker; 0: no group

   The ten nodes are the corners, then midsides of 23 03 01 12 13 02 (as tetgen 1.5 -o2 writes them). */
#include <inttypes.h>
#include <string.h>
#include <unistd.h>

#include "file/mesh_formats.h"

static bool open_part(struct mesh_source *s, const char *path, const char *ending, struct arena *a, struct err *e)
{
    size_t n = strlen(path), k = strlen(strrchr(path, '.'));
    if (!mesh_source_open(s, arena_format(a, "%.*s%s", (int)(n - k), path, ending), a, e))
        return err_at(e, "TetGen's .node and .ele belong together");
    s->remarks = true;
    return true;
}

/* The first line: a count, then up to three numbers that may be missing. */
static bool read_header(struct mesh_source *s, size_t least, const char *what, size_t *n, int64_t more[3])
{
    if (!mesh_source_count(s, 4, least, n, what)) return false;
    for (int i = 0; i < 3 && mesh_source_on_line(s); i++)
        if (!mesh_source_whole(s, 4, &more[i], "a number of the first line")) return false;
    return true;
}

static bool read_nodes(struct mesh_raw *r, struct mesh_source *s)
{
    size_t n;
    int64_t more[3] = {3, 0, 0};
    double skipped;
    if (!read_header(s, 8, "the number of nodes", &n, more)) return false;
    if (more[0] != 3 || more[1] < 0 || more[1] > 1000 || more[2] < 0 || more[2] > 1)
        return mesh_source_bad(s,
                               "nodes of dimension %" PRId64 " with %" PRId64 " attributes and %" PRId64
                               " markers; nodes have dimension 3, and 0 or 1 markers",
                               more[0], more[1], more[2]);
    mesh_raw_expect(r, n);
    for (size_t i = 0; i < n; i++) {
        struct mesh_raw_node *to = &r->node[r->nodes++];
        if (!mesh_source_whole(s, 4, &to->tag, "the number of a node")) return false;
        for (int c = 0; c < 3; c++)
            if (!mesh_source_real(s, &to->at[c], "a coordinate of a node")) return false;
        for (int64_t k = 0; k < more[1] + more[2]; k++)
            if (!mesh_source_real(s, &skipped, "an attribute of a node")) return false;
    }
    return mesh_raw_sort(r, s);
}

static bool read_element(struct mesh_raw *r, struct mesh_source *s, int corners, int64_t attributes)
{
    static const int place[10] = {0, 1, 2, 3, 9, 7, 4, 5, 8, 6};
    int64_t tag;
    int node[10] = {0};
    double skipped;
    if (!mesh_source_whole(s, 4, &tag, "the number of an element")) return false;
    for (int i = 0; i < corners; i++)
        if (!mesh_source_whole(s, 4, &tag, "a node of an element") || (node[place[i]] = mesh_raw_find(r, tag, s)) < 0)
            return false;
    for (int64_t i = 0; i < attributes; i++)
        if (!mesh_source_real(s, &skipped, "an attribute of an element")) return false;
    return mesh_raw_element(r, corners, node, s);
}

static bool read_elements(struct mesh_raw *r, struct mesh_source *s)
{
    size_t n;
    int64_t more[3] = {4, 0, 0};
    if (!read_header(s, 10, "the number of elements", &n, more)) return false;
    if ((more[0] != 4 && more[0] != 10) || more[1] < 0 || more[1] > 1000)
        return mesh_source_bad(
            s, "elements of %" PRId64 " nodes with %" PRId64 " attributes; tetrahedra have 4 or 10 nodes", more[0],
            more[1]);
    for (size_t i = 0; i < n; i++)
        if (!read_element(r, s, (int)more[0], more[1])) return false;
    return true;
}

/* One line: number, 3 or 6 nodes, marker. */
static bool read_face(struct mesh_raw *r, struct mesh_source *s, bool marked)
{
    int64_t v[8];
    int n = 0, corner[3];
    if (!mesh_source_whole(s, 4, &v[n++], "the number of a face")) return false;
    for (; n < 8 && mesh_source_on_line(s); n++)
        if (!mesh_source_whole(s, 4, &v[n], "a node of a face")) return false;
    if (n != 4 + marked && n != 7 + marked)
        return mesh_source_bad(s, "a face of %d numbers; they are its number, 3 or 6 nodes%s", n,
                               marked ? ", and a marker" : "");
    for (int i = 0; i < 3; i++)
        if ((corner[i] = mesh_raw_find(r, v[1 + i], s)) < 0) return false;
    if (marked && v[n - 1] != 0) mesh_raw_face(r, v[n - 1], corner);
    return true;
}

static bool read_faces(struct mesh_raw *r, struct mesh_source *s)
{
    size_t n;
    int64_t more[3] = {0, 0, 0};
    if (!read_header(s, 8, "the number of faces", &n, more)) return false;
    if (more[0] < 0 || more[0] > 1)
        return mesh_source_bad(s, "faces with %" PRId64 " markers; they have 0 or 1", more[0]);
    for (size_t i = 0; i < n; i++)
        if (!read_face(r, s, more[0] == 1)) return false;
    return true;
}

static const char *no_name(const void *self, int64_t number)
{
    (void)self, (void)number;
    return NULL;
}

bool mesh_tetgen_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e)
{
    struct mesh_raw r = {.arena = a};
    struct mesh_source nodes, elements, faces;
    size_t name = strlen(path) - strlen(strrchr(path, '.'));
    const char *face = arena_format(a, "%.*s.face", (int)name, path);
    if (!open_part(&nodes, path, ".node", a, e) || !open_part(&elements, path, ".ele", a, e) ||
        !read_nodes(&r, &nodes) || !read_elements(&r, &elements))
        return false;
    if (access(face, F_OK) == 0 && (!open_part(&faces, path, ".face", a, e) || !read_faces(&r, &faces))) return false;
    return mesh_raw_finish(&r, path, unit, &(struct mesh_raw_names){no_name, NULL}, m, e);
}
