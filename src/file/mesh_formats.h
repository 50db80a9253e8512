/* The formats of mesh.c. */
#ifndef FILE_MESH_FORMATS_H
#define FILE_MESH_FORMATS_H
#include "file/mesh_raw.h"

/* Which physical surfaces a Gmsh file names, and to which a surface of the geometry belongs. */
struct mesh_msh {
    struct mesh_raw raw;
    struct mesh_source source;
    size_t names, belongs, belongs_room;
    struct mesh_msh_name {
        int64_t number;
        const char *text;
    } * name;
    struct mesh_msh_belongs {
        int64_t surface, physical;
    } * to; /* 4.1 */
};

/* Elements by their number in Gmsh. */
enum {
    MESH_MSH_LINE = 1,
    MESH_MSH_TRIANGLE = 2,
    MESH_MSH_TETRAHEDRON = 4,
    MESH_MSH_LINE_3 = 8,
    MESH_MSH_TRIANGLE_6 = 9,
    MESH_MSH_TETRAHEDRON_10 = 11,
    MESH_MSH_POINT = 15
};

bool mesh_msh_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e);
bool mesh_tetgen_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e);

/* Nodes of such an element; 0, and an error: it is none that is read. */
int mesh_msh_size(const struct mesh_msh *g, int64_t type);

/* Reads the nodes of one element of the type; indices of nodes. bytes: 4 or 8, of a node's tag in binary. */
bool mesh_msh_nodes(struct mesh_msh *g, int64_t type, int bytes, int node[10]);

/* Sections of the two versions, behind their first line; the rest is found by name. */
bool mesh_msh2_nodes(struct mesh_msh *g);
bool mesh_msh2_elements(struct mesh_msh *g);
bool mesh_msh4_entities(struct mesh_msh *g);
bool mesh_msh4_nodes(struct mesh_msh *g);
bool mesh_msh4_elements(struct mesh_msh *g);

#endif
