/* Gmsh's MSH, versions 2.2 and 4.1 (Gmsh reference manual, "File formats"), as text or little-endian binary:

     $MeshFormat     version, 0 or 1 (binary), bytes of a number; in binary a whole number 1
     $PhysicalNames  dimension, number, "name"; always text
     $Entities, $Nodes, $Elements   see mesh_msh2.c and mesh_msh4.c; other sections are passed over

   Its tetrahedra of ten nodes have the midsides of 01 12 20 03 23 13. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "file/mesh_formats.h"

int mesh_msh_size(const struct mesh_msh *g, int64_t type)
{
    static const struct {
        int type;
        const char *name;
    } others[] = {{3, "quadrangle"},
                  {5, "hexahedron"},
                  {6, "prism"},
                  {7, "pyramid"},
                  {10, "quadrangle"},
                  {12, "hexahedron"},
                  {13, "prism"},
                  {14, "pyramid"},
                  {16, "quadrangle"},
                  {17, "hexahedron"},
                  {18, "prism"},
                  {19, "pyramid"},
                  {20, "triangle of third order"},
                  {21, "triangle of third order"},
                  {26, "line of third order"},
                  {29, "tetrahedron of third order"}};
    switch (type) {
    case MESH_MSH_POINT:
        return 1;
    case MESH_MSH_LINE:
        return 2;
    case MESH_MSH_TRIANGLE:
    case MESH_MSH_LINE_3:
        return 3;
    case MESH_MSH_TETRAHEDRON:
        return 4;
    case MESH_MSH_TRIANGLE_6:
        return 6;
    case MESH_MSH_TETRAHEDRON_10:
        return 10;
    default:
        break;
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (others[i].type == type)
            return (int)mesh_source_bad(
                &g->source,
                "a %s (type %d): only tetrahedra of 4 or 10 nodes are read; mesh without recombining, gmsh -3 -order 2",
                others[i].name, others[i].type);
    return (int)mesh_source_bad(
        &g->source, "an element of type %" PRId64 ": only tetrahedra of 4 or 10 nodes are read; gmsh -3 -order 2",
        type);
}

bool mesh_msh_nodes(struct mesh_msh *g, int64_t type, int bytes, int node[10])
{
    int n = mesh_msh_size(g, type);
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

/* The text between two quotes. */
static bool read_name(struct mesh_source *s, struct arena *a, const char **name)
{
    mesh_source_on_line(s);
    const char *stop = s->at < s->end && *s->at == '"' ? memchr(s->at + 1, '"', (size_t)(s->end - s->at - 1)) : NULL;
    if (!stop || memchr(s->at, '\n', (size_t)(stop - s->at)) || memchr(s->at, '\0', (size_t)(stop - s->at)))
        return mesh_source_bad(s, "the name of a physical group should stand here in double quotes");
    *name = arena_format(a, "%.*s", (int)(stop - s->at - 1), s->at + 1);
    s->at = stop + 1;
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
             mesh_source_whole(s, 4, &to->number, "the number of a physical group") &&
             read_name(s, g->raw.arena, &to->text);
        g->names += ok && dimension == 2;
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
        if (!mesh_msh4_entities(g)) return false;
    }
    if (!mesh_source_find(s, "Nodes")) return mesh_source_bad(s, "no $Nodes: the file has no mesh, or was cut off");
    mesh_source_next_line(s);
    if (!(two ? mesh_msh2_nodes(g) : mesh_msh4_nodes(g)) || !mesh_raw_sort(&g->raw, s)) return false;
    if (!mesh_source_find(s, "Elements"))
        return mesh_source_bad(s, "no $Elements after $Nodes: the file has no mesh, or was cut off");
    mesh_source_next_line(s);
    if (!(two ? mesh_msh2_elements(g) : mesh_msh4_elements(g))) return false;
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
