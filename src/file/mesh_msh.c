/* Gmsh's MSH, versions 2.2 and 4.1 (Gmsh reference manual, "File formats"), as text or little-endian binary:

     $MeshFormat     version, 0 or 1 (binary), bytes of a number; in binary a whole number 1
     $PhysicalNames  dimension, number, "name"; always text
     $Entities, $Nodes, $Elements   see below; other sections are passed over

   Its tetrahedra of ten nodes have the midsides of 01 12 20 03 23 13. */
#include "file/mesh_formats.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Which physical surfaces a Gmsh file names, and to which a surface of the geometry belongs. */
struct mesh_msh {
    struct mesh_raw raw;
    struct mesh_source source;
    size_t names, belongs;
    struct mesh_msh_name {
        int64_t number;
        const char *text;
    } * name;
    struct mesh_msh_belongs {
        int64_t surface, physical;
    } * to;            /* 4.1 */
    int64_t *physical; /* [belongs] of the same, in their order */
};

/* Elements by their number in Gmsh. */
enum { LINE = 1, TRIANGLE = 2, TETRAHEDRON = 4, LINE_3 = 8, TRIANGLE_6 = 9, TETRAHEDRON_10 = 11, POINT = 15 };

/* Nodes of such an element; 0, and an error: it is none that is read. */
static int element_size(const struct mesh_msh *g, int64_t type)
{
    static const int nodes[] = {[LINE] = 2,  [TRIANGLE] = 3,   [TETRAHEDRON] = 4,    [LINE_3] = 3,
                                [POINT] = 1, [TRIANGLE_6] = 6, [TETRAHEDRON_10] = 10};
    static const struct {
        const char *name;
        int type[3];
    } others[] = {{"quadrangle", {3, 10, 16}},
                  {"hexahedron", {5, 12, 17}},
                  {"prism", {6, 13, 18}},
                  {"pyramid", {7, 14, 19}},
                  {"triangle of third order", {20, 21}},
                  {"line of third order", {26}},
                  {"tetrahedron of third order", {29}}};
    if (type > 0 && type <= POINT && nodes[type] > 0) return nodes[type];
    for (size_t i = 0; type > 0 && i < 3 * sizeof others / sizeof others[0]; i++)
        if (others[i / 3].type[i % 3] == type)
            return (int)mesh_source_bad(
                &g->source,
                "a %s (type %d): only tetrahedra of 4 or 10 nodes are read; mesh without recombining, gmsh -3 -order 2",
                others[i / 3].name, others[i / 3].type[i % 3]);
    return (int)mesh_source_bad(
        &g->source, "an element of type %" PRId64 ": only tetrahedra of 4 or 10 nodes are read; gmsh -3 -order 2",
        type);
}

/* Reads the nodes of one element of the type; indices of nodes. bytes: 4 or 8, of a node's tag in binary. */
static bool element_nodes(struct mesh_msh *g, int64_t type, int bytes, int node[10])
{
    int n = element_size(g, type);
    for (int i = 0; i < n; i++) {
        int64_t tag;
        if (!mesh_source_whole(&g->source, bytes, &tag, "a node of an element") ||
            (node[i] = mesh_raw_find(&g->raw, tag, &g->source)) < 0)
            return false;
    }
    if (n == 10) {
        int t = node[8];
        node[8] = node[9];
        node[9] = t;
    }
    return n > 0;
}

/* MSH 2.2. Counts stand as text in both kinds of file.

     $Nodes     count; per node: tag, x y z (binary: 4 bytes, three doubles)
     $Elements  count; per element: tag, type, number of tags, tags (the first: physical group, 0 none), nodes
                (binary: runs of one type: type, elements, number of tags; per element: tag, tags, nodes; 4 bytes each)
                  */

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

static bool nodes_2(struct mesh_msh *g)
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

/* A tetrahedron, or a triangle of so many groups; others are passed over. */
static bool take_element(struct mesh_msh *g, int64_t type, const int node[10], const int64_t *groups, size_t n)
{
    if (type == TETRAHEDRON || type == TETRAHEDRON_10)
        return mesh_raw_element(&g->raw, type == TETRAHEDRON ? 4 : 10, node, &g->source);
    if (type != TRIANGLE && type != TRIANGLE_6) return true;
    g->raw.triangles++;
    for (size_t i = 0; i < n; i++)
        mesh_raw_face(&g->raw, groups[i], node);
    return true;
}

static bool elements_2(struct mesh_msh *g)
{
    struct mesh_source *s = &g->source;
    size_t n;
    if (!read_count(s, s->binary ? 8 : 6, &n, "the number of elements")) return false;
    for (size_t i = 0; i < n;) {
        int64_t type, tag, tags, run = 1;
        if ((!s->binary && !mesh_source_whole(s, 4, &tag, "the number of an element")) ||
            !mesh_source_whole(s, 4, &type, "the type of an element") ||
            (s->binary && !mesh_source_whole(s, 4, &run, "the number of elements of a type")) ||
            !mesh_source_whole(s, 4, &tags, "the number of an element's tags") || element_size(g, type) == 0)
            return false;
        if (tags < 0 || tags > 10000) return mesh_source_bad(s, "an element with %" PRId64 " tags", tags);
        if (run < 1 || (uint64_t)run > n - i)
            return mesh_source_bad(s, "%" PRId64 " elements of type %" PRId64 ", and %zu are left", run, type, n - i);
        for (int64_t k = 0; k < run; k++, i++) {
            int64_t physical = 0;
            int node[10] = {0};
            if (s->binary && !mesh_source_whole(s, 4, &tag, "the number of an element")) return false;
            for (int64_t j = 0; j < tags; j++) {
                if (!mesh_source_whole(s, 4, &tag, "a tag of an element")) return false;
                physical = j == 0 ? tag : physical;
            }
            if (!element_nodes(g, type, 4, node) || !take_element(g, type, node, &physical, physical != 0))
                return false;
        }
    }
    return true;
}

/* MSH 4.1; counts and tags of nodes and elements 8 bytes in binary, the rest 4 bytes, coordinates doubles.

     $Entities  points, curves, surfaces, volumes (counts); per point: tag, x y z, physical groups (count, numbers);
                per other: tag, box (6), physical groups (count, numbers), what bounds it (count, tags)
     $Nodes     blocks, nodes, least, greatest tag; per block: dimension, entity, parametric (0, 1), nodes; their tags;
                their x y z (and as many parameters as the dimension)
     $Elements  blocks, elements, least, greatest tag; per block: dimension, entity, type, elements; per element: tag,
       nodes */

enum { MOST_GROUPS = 64 }; /* of one entity: each of its faces is kept for each */

static int by_surface(const void *p, const void *q)
{
    const struct mesh_msh_belongs *a = p, *b = q;
    if (a->surface != b->surface) return a->surface < b->surface ? -1 : 1;
    return (a->physical > b->physical) - (a->physical < b->physical);
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
        if (dimension != 2) continue;
        g->to = arena_more(g->raw.arena, g->to, (int)g->belongs, sizeof *g->to);
        g->to[g->belongs++] = (struct mesh_msh_belongs){tag, number < 0 ? -number : number};
    }
    if (dimension == 0) return true;
    if (!mesh_source_count(s, 8, least, &n, "the number of what bounds an entity")) return false;
    for (size_t i = 0; i < n; i++)
        if (!mesh_source_whole(s, 4, &number, "what bounds an entity")) return false;
    return true;
}

static bool entities_4(struct mesh_msh *g)
{
    size_t n[4];
    for (int d = 0; d < 4; d++)
        if (!mesh_source_count(&g->source, 8, 4, &n[d], "the number of entities")) return false;
    for (int d = 0; d < 4; d++)
        for (size_t i = 0; i < n[d]; i++)
            if (!read_entity(g, d)) return false;
    if (g->belongs > 0) qsort(g->to, g->belongs, sizeof *g->to, by_surface);
    g->physical = ARENA_TAKE(g->raw.arena, int64_t, g->belongs + 1);
    for (size_t i = 0; i < g->belongs; i++)
        g->physical[i] = g->to[i].physical;
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

static bool nodes_4(struct mesh_msh *g)
{
    struct header h;
    if (!read_header(&g->source, g->source.binary ? 32 : 8, "the number of nodes", &h)) return false;
    mesh_raw_expect(&g->raw, h.all);
    for (size_t i = 0; i < h.blocks; i++)
        if (!read_node_block(g, &h)) return false;
    return g->raw.nodes == h.all ||
           mesh_source_bad(&g->source, "the blocks hold %zu nodes, and $Nodes said %zu", g->raw.nodes, h.all);
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
        element_size(g, type) == 0)
        return false;
    if (n > *left) return mesh_source_bad(s, "a block of %zu elements, and %zu are left", n, *left);
    *left -= n;
    size_t first = 0, end = g->belongs; /* of those of the surface */
    while (first < end) {
        size_t mid = (first + end) / 2;
        if (g->to[mid].surface < entity)
            first = mid + 1;
        else
            end = mid;
    }
    while (end < g->belongs && g->to[end].surface == entity)
        end++;
    for (size_t i = 0; i < n; i++)
        if (!mesh_source_whole(s, 8, &tag, "the number of an element") || !element_nodes(g, type, 8, node) ||
            !take_element(g, type, node, end > first ? g->physical + first : NULL, end - first))
            return false;
    return true;
}

static bool elements_4(struct mesh_msh *g)
{
    struct header h;
    if (!read_header(&g->source, g->source.binary ? 16 : 4, "the number of elements", &h)) return false;
    for (size_t i = 0; i < h.blocks; i++)
        if (!read_element_block(g, &h.all)) return false;
    return h.all == 0 || mesh_source_bad(&g->source, "%zu elements fewer than $Elements said", h.all);
}

/* A number on the first line of $MeshFormat, which is text. */
static bool read_format(struct mesh_msh *g, double *version)
{
    struct mesh_source *s = &g->source;
    int64_t binary, bytes, one;
    if (!mesh_source_find(s, "MeshFormat"))
        return mesh_source_bad(
            s, memchr(s->at, '$', (size_t)(s->end - s->at))
                   ? "no $MeshFormat: not Gmsh's MSH 2.2 or 4.1 (version 1 is not read: gmsh -save -format msh41)"
                   : "no $MeshFormat: not Gmsh's MSH");
    if (!mesh_source_real(s, version, "the version") || !mesh_source_whole(s, 4, &binary, "the kind of file") ||
        !mesh_source_whole(s, 4, &bytes, "the size of a number"))
        return false;
    bool two = *version >= 2 && *version < 3;
    if (!two && *version != 4.1)
        return mesh_source_bad(s, "MSH version %g; 2.2 and 4.1 are read: gmsh FILE -save -format msh41 -o NEW.msh",
                               *version);
    if (bytes != 8 || (binary != 0 && binary != 1))
        return mesh_source_bad(
            s, "MSH kind %" PRId64 " with numbers of %" PRId64 " bytes; 0 (text) and 1 (binary) with 8 are read",
            binary, bytes);
    if (binary == 1) {
        mesh_source_next_line(s);
        s->binary = true;
        if (!mesh_source_whole(s, 4, &one, "the number 1") ||
            (one != 1 &&
             !mesh_source_bad(s, "the number 1 of a binary file reads as %" PRId64 ": not little-endian", one)))
            return false;
    }
    return true;
}

static int by_number(const void *p, const void *q)
{
    const struct mesh_msh_name *a = p, *b = q;
    return (a->number > b->number) - (a->number < b->number);
}

static bool read_names(struct mesh_msh *g)
{
    struct mesh_source *s = &g->source;
    size_t n;
    bool ok = mesh_source_count(s, 4, 7, &n, "the number of physical names");
    g->name = ARENA_TAKE(g->raw.arena, struct mesh_msh_name, ok ? n : 0);
    for (size_t i = 0; ok && i < n; i++) {
        int64_t dimension;
        struct mesh_msh_name *to = &g->name[g->names];
        ok = mesh_source_whole(s, 4, &dimension, "the dimension of a physical group") &&
             mesh_source_whole(s, 4, &to->number, "the number of a physical group");
        if (!ok) break;
        mesh_source_on_line(s); /* the text between two quotes */
        const char *from = s->at + 1,
                   *stop = s->at < s->end && *s->at == '"' ? memchr(from, '"', (size_t)(s->end - from)) : NULL;
        if (!stop || memchr(from, '\n', (size_t)(stop - from)) || memchr(from, '\0', (size_t)(stop - from)))
            return mesh_source_bad(s, "the name of a physical group should stand here in double quotes");
        to->text = arena_format(g->raw.arena, "%.*s", (int)(stop - from), from);
        s->at = stop + 1;
        g->names += dimension == 2;
    }
    if (!ok) return false;
    qsort(g->name, g->names, sizeof *g->name, by_number);
    for (size_t i = 1; i < g->names; i++)
        if (g->name[i].number == g->name[i - 1].number)
            return mesh_source_bad(s, "physical surface %" PRId64 " has two names, '%s' and '%s'", g->name[i].number,
                                   g->name[i - 1].text, g->name[i].text);
    return true;
}

static const char *name_of(const void *self, int64_t number)
{
    const struct mesh_msh *g = self;
    const struct mesh_msh_name wanted = {.number = number},
                               *n = g->names > 0 ? bsearch(&wanted, g->name, g->names, sizeof wanted, by_number) : NULL;
    return n ? n->text : NULL;
}

/* One section after the other, each at its place: $Nodes before $Elements. */
static bool read_sections(struct mesh_msh *g, bool two)
{
    struct mesh_source *s = &g->source;
    bool binary = s->binary;
    struct mesh_source here = *s;
    s->binary = false; /* to pass over lines, and what is always text */
    if (mesh_source_find(s, "PhysicalNames") && !read_names(g)) return false;
    if (g->names == 0) *s = here;
    s->binary = binary;
    if (!two && mesh_source_find(s, "Entities")) {
        mesh_source_next_line(s);
        if (!entities_4(g)) return false;
    }
    if (!mesh_source_find(s, "Nodes")) return mesh_source_bad(s, "no $Nodes: the file has no mesh, or was cut off");
    mesh_source_next_line(s);
    if (!(two ? nodes_2(g) : nodes_4(g)) || !mesh_raw_sort(&g->raw, s)) return false;
    if (!mesh_source_find(s, "Elements"))
        return mesh_source_bad(s, "no $Elements after $Nodes: the file has no mesh, or was cut off");
    mesh_source_next_line(s);
    if (!(two ? elements_2(g) : elements_4(g))) return false;
    return mesh_source_find(s, "EndElements") || mesh_source_bad(s, "no $EndElements: the file was cut off");
}

bool mesh_msh_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e)
{
    struct mesh_msh *g = ARENA_TAKE(a, struct mesh_msh, 1);
    double version;
    g->raw.arena = a;
    if (!mesh_source_open(&g->source, path, a, e) || !read_format(g, &version) || !read_sections(g, version < 3))
        return false;
    return mesh_raw_finish(&g->raw, path, unit, &(struct mesh_raw_names){name_of, g}, m, e);
}
