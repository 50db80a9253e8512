/* MSH 2.2. Counts stand as text in both kinds of file.

     $Nodes     count; per node: tag, x y z (binary: 4 bytes, three doubles)
     $Elements  count; per element: tag, type, number of tags, tags (the first: physical group, 0 none), nodes
                (binary: runs of one type: type, elements, number of tags; per element: tag, tags, nodes; 4 bytes each)
 */
#include <inttypes.h>

#include "file/mesh_formats.h"

/* A count in text, and what follows its line. */
static bool read_count(struct mesh_source *s, size_t least, size_t *n, const char *what)
{
    bool binary = s->binary;
    s->binary = false;
    bool ok = mesh_source_count(s, 4, least, n, what);
    if (ok && binary) mesh_source_next_line(s);
    s->binary = binary;
    return ok;
}

bool mesh_msh2_nodes(struct mesh_msh *g)
{
    struct mesh_source *s = &g->source;
    size_t n;
    if (!read_count(s, s->binary ? 28 : 8, &n, "the number of nodes")) return false;
    mesh_raw_expect(&g->raw, n);
    for (size_t i = 0; i < n; i++) {
        struct mesh_raw_node *to = &g->raw.node[g->raw.nodes++];
        if (!mesh_source_whole(s, 4, &to->tag, "the number of a node")) return false;
        for (int c = 0; c < 3; c++)
            if (!mesh_source_real(s, &to->at[c], "a coordinate of a node")) return false;
    }
    return true;
}

/* Tags and nodes of one element. */
static bool read_element(struct mesh_msh *g, int64_t type, int64_t tags)
{
    int64_t tag, physical = 0;
    int node[10] = {0};
    for (int64_t i = 0; i < tags; i++) {
        if (!mesh_source_whole(&g->source, 4, &tag, "a tag of an element")) return false;
        physical = i == 0 ? tag : physical;
    }
    if (!mesh_msh_nodes(g, type, 4, node)) return false;
    if (type == MESH_MSH_TETRAHEDRON || type == MESH_MSH_TETRAHEDRON_10)
        return mesh_raw_element(&g->raw, type == MESH_MSH_TETRAHEDRON ? 4 : 10, node, &g->source);
    if (type == MESH_MSH_TRIANGLE || type == MESH_MSH_TRIANGLE_6) {
        g->raw.triangles++;
        if (physical != 0) mesh_raw_face(&g->raw, physical, node);
    }
    return true;
}

static bool good_tags(const struct mesh_source *s, int64_t tags)
{
    return (tags >= 0 && tags <= 10000) || mesh_source_bad(s, "an element with %" PRId64 " tags", tags);
}

bool mesh_msh2_elements(struct mesh_msh *g)
{
    struct mesh_source *s = &g->source;
    size_t n;
    if (!read_count(s, s->binary ? 8 : 6, &n, "the number of elements")) return false;
    for (size_t i = 0; i < n;) {
        int64_t type, tag, tags, run = 1;
        if ((!s->binary && !mesh_source_whole(s, 4, &tag, "the number of an element")) ||
            !mesh_source_whole(s, 4, &type, "the type of an element") ||
            (s->binary && !mesh_source_whole(s, 4, &run, "the number of elements of a type")) ||
            !mesh_source_whole(s, 4, &tags, "the number of an element's tags"))
            return false;
        if (mesh_msh_size(g, type) == 0 || !good_tags(s, tags)) return false;
        if (run < 1 || (uint64_t)run > n - i)
            return mesh_source_bad(s, "%" PRId64 " elements of type %" PRId64 ", and %zu are left", run, type, n - i);
        for (int64_t k = 0; k < run; k++, i++)
            if ((s->binary && !mesh_source_whole(s, 4, &tag, "the number of an element")) ||
                !read_element(g, type, tags))
                return false;
    }
    return true;
}
