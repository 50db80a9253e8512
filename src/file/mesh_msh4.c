/* MSH 4.1; counts and tags of nodes and elements 8 bytes in binary, the rest 4 bytes, coordinates doubles.

     $Entities  points, curves, surfaces, volumes (counts); per point: tag, x y z, physical groups (count, numbers);
                per other: tag, box (6), physical groups (count, numbers), what bounds it (count, tags)
     $Nodes     blocks, nodes, least, greatest tag; per block: dimension, entity, parametric (0, 1), nodes; their tags;
   their x y z (and as many parameters as the dimension) $Elements  blocks, elements, least, greatest tag; per block:
   dimension, entity, type, elements; per element: tag, nodes */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "file/mesh_formats.h"

enum { MOST_GROUPS = 64 }; /* of one entity: each of its faces is kept for each */

static void belongs(struct mesh_msh *g, int64_t surface, int64_t physical)
{
    if (g->belongs == g->belongs_room) {
        g->belongs_room = g->belongs_room ? 2 * g->belongs_room : 64;
        struct mesh_msh_belongs *more = ARENA_TAKE(g->raw.arena, struct mesh_msh_belongs, g->belongs_room);
        if (g->belongs > 0) memcpy(more, g->to, g->belongs * sizeof *more);
        g->to = more;
    }
    g->to[g->belongs++] = (struct mesh_msh_belongs){surface, physical};
}

static int by_surface(const void *p, const void *q)
{
    const struct mesh_msh_belongs *a = p, *b = q;
    if (a->surface != b->surface) return a->surface < b->surface ? -1 : 1;
    return (a->physical > b->physical) - (a->physical < b->physical);
}

/* The first of those of a surface. */
static size_t first_of(const struct mesh_msh *g, int64_t surface)
{
    size_t low = 0, high = g->belongs;
    while (low < high) {
        size_t mid = (low + high) / 2;
        if (g->to[mid].surface < surface)
            low = mid + 1;
        else
            high = mid;
    }
    return low;
}

static bool skip_reals(struct mesh_source *s, int n, const char *what)
{
    double x;
    for (int i = 0; i < n; i++)
        if (!mesh_source_real(s, &x, what)) return false;
    return true;
}

static bool read_entity(struct mesh_msh *g, int dimension)
{
    struct mesh_source *s = &g->source;
    int64_t tag, number;
    size_t n, least = s->binary ? 4 : 2;
    if (!mesh_source_whole(s, 4, &tag, "the tag of an entity") ||
        !skip_reals(s, dimension == 0 ? 3 : 6, "a coordinate of an entity") ||
        !mesh_source_count(s, 8, least, &n, "the number of an entity's physical groups"))
        return false;
    if (n > MOST_GROUPS)
        return mesh_source_bad(s, "an entity in %zu physical groups; at most %d are read", n, MOST_GROUPS);
    for (size_t i = 0; i < n; i++) {
        if (!mesh_source_whole(s, 4, &number, "a physical group")) return false;
        if (dimension == 2) belongs(g, tag, number < 0 ? -number : number);
    }
    if (dimension == 0) return true;
    if (!mesh_source_count(s, 8, least, &n, "the number of what bounds an entity")) return false;
    for (size_t i = 0; i < n; i++)
        if (!mesh_source_whole(s, 4, &number, "what bounds an entity")) return false;
    return true;
}

bool mesh_msh4_entities(struct mesh_msh *g)
{
    size_t n[4];
    for (int d = 0; d < 4; d++)
        if (!mesh_source_count(&g->source, 8, 4, &n[d], "the number of entities")) return false;
    for (int d = 0; d < 4; d++)
        for (size_t i = 0; i < n[d]; i++)
            if (!read_entity(g, d)) return false;
    if (g->belongs > 0) qsort(g->to, g->belongs, sizeof *g->to, by_surface);
    for (size_t i = MOST_GROUPS; i < g->belongs; i++)
        if (g->to[i].surface == g->to[i - MOST_GROUPS].surface)
            return mesh_source_bad(&g->source, "surface %" PRId64 " is in more than %d physical groups",
                                   g->to[i].surface, MOST_GROUPS);
    return true;
}

struct header { /* of a section */
    size_t blocks, all;
};

static bool read_header(struct mesh_source *s, size_t least, const char *what, struct header *h)
{
    int64_t skipped;
    return mesh_source_count(s, 8, s->binary ? 20 : 8, &h->blocks, "the number of blocks") &&
           mesh_source_count(s, 8, least, &h->all, what) && mesh_source_whole(s, 8, &skipped, "the least tag") &&
           mesh_source_whole(s, 8, &skipped, "the greatest tag");
}

static bool read_node_block(struct mesh_msh *g, const struct header *h)
{
    struct mesh_source *s = &g->source;
    int64_t dimension, entity, parametric;
    size_t n;
    if (!mesh_source_whole(s, 4, &dimension, "a dimension") ||
        !mesh_source_whole(s, 4, &entity, "the tag of an entity") ||
        !mesh_source_whole(s, 4, &parametric, "whether nodes have parameters") ||
        !mesh_source_count(s, 8, s->binary ? 32 : 8, &n, "the number of nodes of a block"))
        return false;
    if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > 1 || n > h->all - g->raw.nodes)
        return mesh_source_bad(
            s, "a block of %zu nodes of dimension %" PRId64 ", parametric %" PRId64 ", where %zu nodes are left", n,
            dimension, parametric, h->all - g->raw.nodes);
    struct mesh_raw_node *to = g->raw.node + g->raw.nodes;
    for (size_t i = 0; i < n; i++)
        if (!mesh_source_whole(s, 8, &to[i].tag, "the number of a node")) return false;
    for (size_t i = 0; i < n; i++) {
        for (int c = 0; c < 3; c++)
            if (!mesh_source_real(s, &to[i].at[c], "a coordinate of a node")) return false;
        if (!skip_reals(s, parametric ? (int)dimension : 0, "a parameter of a node")) return false;
    }
    g->raw.nodes += n;
    return true;
}

bool mesh_msh4_nodes(struct mesh_msh *g)
{
    struct header h;
    if (!read_header(&g->source, g->source.binary ? 32 : 8, "the number of nodes", &h)) return false;
    mesh_raw_expect(&g->raw, h.all);
    for (size_t i = 0; i < h.blocks; i++)
        if (!read_node_block(g, &h)) return false;
    return g->raw.nodes == h.all ||
           mesh_source_bad(&g->source, "the blocks hold %zu nodes, and $Nodes said %zu", g->raw.nodes, h.all);
}

static bool take_element(struct mesh_msh *g, int64_t type, int64_t entity, const int node[10])
{
    if (type == MESH_MSH_TETRAHEDRON || type == MESH_MSH_TETRAHEDRON_10)
        return mesh_raw_element(&g->raw, type == MESH_MSH_TETRAHEDRON ? 4 : 10, node, &g->source);
    if (type == MESH_MSH_TRIANGLE || type == MESH_MSH_TRIANGLE_6) {
        g->raw.triangles++;
        for (size_t i = first_of(g, entity); i < g->belongs && g->to[i].surface == entity; i++)
            mesh_raw_face(&g->raw, g->to[i].physical, node);
    }
    return true;
}

static bool read_element_block(struct mesh_msh *g, size_t *left)
{
    struct mesh_source *s = &g->source;
    int64_t dimension, entity, type, tag;
    size_t n;
    int node[10] = {0};
    if (!mesh_source_whole(s, 4, &dimension, "a dimension") ||
        !mesh_source_whole(s, 4, &entity, "the tag of an entity") ||
        !mesh_source_whole(s, 4, &type, "the type of an element") ||
        !mesh_source_count(s, 8, s->binary ? 16 : 4, &n, "the number of elements of a block") ||
        mesh_msh_size(g, type) == 0)
        return false;
    if (n > *left) return mesh_source_bad(s, "a block of %zu elements, and %zu are left", n, *left);
    *left -= n;
    for (size_t i = 0; i < n; i++)
        if (!mesh_source_whole(s, 8, &tag, "the number of an element") || !mesh_msh_nodes(g, type, 8, node) ||
            !take_element(g, type, entity, node))
            return false;
    return true;
}

bool mesh_msh4_elements(struct mesh_msh *g)
{
    struct header h;
    if (!read_header(&g->source, g->source.binary ? 16 : 4, "the number of elements", &h)) return false;
    for (size_t i = 0; i < h.blocks; i++)
        if (!read_element_block(g, &h.all)) return false;
    return h.all == 0 || mesh_source_bad(&g->source, "%zu elements fewer than $Elements said", h.all);
}
