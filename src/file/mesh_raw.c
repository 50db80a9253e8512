/* See mesh_raw.h. */
#include "file/mesh_raw.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Room for one more of `size` bytes. */
static void *room(struct arena *a, void *old, size_t n, size_t *most, size_t size)
{
    if (n < *most) return old;
    *most = *most ? 2 * *most : 1024;
    void *more = arena_take(a, *most, size);
    if (n > 0) memcpy(more, old, n * size);
    return more;
}

void mesh_raw_expect(struct mesh_raw *r, size_t nodes)
{
    if (r->nodes + nodes < r->node_room) return;
    r->node_room = 2 * (r->nodes + nodes) + 1;
    struct mesh_raw_node *more = ARENA_TAKE(r->arena, struct mesh_raw_node, r->node_room);
    if (r->nodes > 0) memcpy(more, r->node, r->nodes * sizeof *more);
    r->node = more;
}

static int by_tag(const void *p, const void *q)
{
    const struct mesh_raw_node *a = p, *b = q;
    return (a->tag > b->tag) - (a->tag < b->tag);
}

bool mesh_raw_sort(struct mesh_raw *r, const struct mesh_source *s)
{
    if (r->nodes == 0) return mesh_source_bad(s, "there are no nodes before the elements");
    if (r->nodes > INT_MAX / 16)
        return mesh_source_bad(s, "%zu nodes are more than a mesh may have here; make it coarser", r->nodes);
    qsort(r->node, r->nodes, sizeof *r->node, by_tag);
    for (size_t i = 1; i < r->nodes; i++)
        if (r->node[i].tag == r->node[i - 1].tag)
            return mesh_source_bad(s, "node %" PRId64 " is defined twice", r->node[i].tag);
    return true;
}

int mesh_raw_find(const struct mesh_raw *r, int64_t tag, const struct mesh_source *s)
{
    size_t low = 0, high = r->nodes;
    int64_t first = r->node[0].tag, last = r->node[r->nodes - 1].tag;
    if (tag >= first && tag <= last && (uint64_t)last - (uint64_t)first == r->nodes - 1) return (int)(tag - first);
    while (low < high) {
        size_t mid = (low + high) / 2;
        if (r->node[mid].tag < tag)
            low = mid + 1;
        else
            high = mid;
    }
    if (low < r->nodes && r->node[low].tag == tag) return (int)low;
    mesh_source_bad(
        s, "an element has node %" PRId64 ", and no such node is defined (they go from %" PRId64 " to %" PRId64 ")",
        tag, first, last);
    return -1;
}

bool mesh_raw_element(struct mesh_raw *r, int corners, const int node[10], const struct mesh_source *s)
{
    if (r->corners != 0 && r->corners != corners)
        return mesh_source_bad(s, "tetrahedra of 4 and of 10 nodes in one file; make all of one order (gmsh -order 2)");
    if (r->elements >= INT_MAX / 16)
        return mesh_source_bad(s, "more elements than a mesh may have here; make it coarser");
    r->corners = corners;
    r->element = room(r->arena, r->element, r->elements, &r->element_room, sizeof *r->element);
    for (int i = 0; i < 10; i++)
        r->element[r->elements][i] = i < corners ? node[i] : -1;
    r->elements++;
    return true;
}

void mesh_raw_face(struct mesh_raw *r, int64_t group, const int corner[3])
{
    r->face = room(r->arena, r->face, r->faces, &r->face_room, sizeof *r->face);
    r->face[r->faces].group = group;
    memcpy(r->face[r->faces++].corner, corner, 3 * sizeof *corner);
}

/* Numbers of the nodes that are used, -1: not. */
static int *used_nodes(struct mesh_raw *r, struct mesh *m)
{
    int *number = ARENA_TAKE(r->arena, int, r->nodes);
    for (size_t i = 0; i < r->elements; i++)
        for (int k = 0; k < r->corners; k++)
            number[r->element[i][k]] = 1;
    for (size_t i = 0; i < r->nodes; i++)
        number[i] = number[i] ? m->nodes++ : -1;
    return number;
}

static int by_group(const void *p, const void *q)
{
    const struct mesh_raw_face *a = p, *b = q;
    if (a->group != b->group) return a->group < b->group ? -1 : 1;
    for (int i = 0; i < 3; i++)
        if (a->corner[i] != b->corner[i]) return a->corner[i] < b->corner[i] ? -1 : 1;
    return 0;
}

/* Faces of nodes that no element uses are left out with those. */
static void make_groups(struct mesh_raw *r, const int *number, const struct mesh_raw_names *names, struct mesh *m)
{
    size_t n = 0, groups = 0;
    for (size_t i = 0; i < r->faces; i++) {
        const int *c = r->face[i].corner;
        if (number[c[0]] >= 0 && number[c[1]] >= 0 && number[c[2]] >= 0) r->face[n++] = r->face[i];
    }
    if (n == 0) return;
    qsort(r->face, n, sizeof *r->face, by_group);
    for (size_t i = 0; i < n; i++)
        groups += i == 0 || r->face[i].group != r->face[i - 1].group;
    m->group = ARENA_TAKE(r->arena, struct mesh_group, groups);
    for (size_t i = 0, end; i < n; i = end) {
        struct mesh_group *g = &m->group[m->groups++];
        for (end = i; end < n && r->face[end].group == r->face[i].group;)
            end++;
        g->name = names->name(names->self, r->face[i].group);
        g->name = g->name ? g->name : arena_format(r->arena, "%" PRId64, r->face[i].group);
        g->corner = arena_take(r->arena, end - i, sizeof *g->corner);
        for (size_t k = i; k < end; k++, g->n++)
            for (int c = 0; c < 3; c++)
                g->corner[g->n][c] = number[r->face[k].corner[c]];
    }
}

bool mesh_raw_finish(struct mesh_raw *r, const char *path, double unit, const struct mesh_raw_names *names,
                     struct mesh *m, struct err *e)
{
    if (r->elements == 0 && r->triangles > 0)
        return err_set(e, ERR_SCENE,
                       "%s: no tetrahedra, only %zu triangles: this is a surface; fill the solid inside it with "
                       "elements (gmsh -3, tetgen -pq); where there is a Physical "
                       "Surface, gmsh saves no elements but those of physical groups: give a Physical Volume too",
                       path, r->triangles);
    if (r->elements == 0)
        return err_set(e, ERR_SCENE, "%s: no tetrahedra; fill the solid with elements (gmsh -3, tetgen -pq)", path);
    *m = (struct mesh){.name = arena_text(r->arena, path), .elements = (int)r->elements, .linear = r->corners == 4};
    int *number = used_nodes(r, m);
    m->at = arena_take(r->arena, (size_t)m->nodes, sizeof *m->at);
    for (size_t i = 0; i < r->nodes; i++)
        for (int c = 0; c < 3 && number[i] >= 0; c++) {
            double x = m->at[number[i]][c] = r->node[i].at[c] * unit;
            if (!isfinite(x))
                return err_set(e, ERR_SCENE, "%s: a coordinate of node %" PRId64 " is %g units of %g m, too large",
                               path, r->node[i].tag, r->node[i].at[c], unit);
        }
    for (size_t i = 0; i < r->elements; i++)
        for (int k = 0; k < r->corners; k++)
            r->element[i][k] = number[r->element[i][k]];
    m->element = r->element;
    make_groups(r, number, names, m);
    return true;
}
