/* A mesh as a file says it: nodes by tags (any whole numbers), elements and faces in the order of the file. */
#ifndef FILE_MESH_RAW_H
#define FILE_MESH_RAW_H
#include "file/mesh.h"
#include "file/mesh_source.h"

struct mesh_raw {
    struct arena *arena;
    size_t nodes, elements, faces, triangles; /* faces: that belong to a group; triangles: all */
    size_t node_room, element_room, face_room;
    int corners; /* nodes of an element: 4 or 10; 0: there is none yet */
    struct mesh_raw_node {
        int64_t tag;
        double at[3];
    } * node;
    int (*element)[10]; /* [elements] indices of nodes, as struct mesh has them */
    struct mesh_raw_face {
        int64_t group;
        int corner[3];
    } * face;
};

/* Room for so many more nodes (known from a count that was checked). */
void mesh_raw_expect(struct mesh_raw *r, size_t nodes);

/* After the last node, before the first element: tags in order. Errors: none, a tag twice. */
bool mesh_raw_sort(struct mesh_raw *r, const struct mesh_source *s);

/* The index of the node of that tag; -1, and an error: there is none. */
int mesh_raw_find(const struct mesh_raw *r, int64_t tag, const struct mesh_source *s);

/* Error: 4 and 10 corners in one file. */
bool mesh_raw_element(struct mesh_raw *r, int corners, const int node[10], const struct mesh_source *s);

void mesh_raw_face(struct mesh_raw *r, int64_t group, const int corner[3]);

/* Nodes that are used, in metres; groups by rising number, called name(self, number), or its number where that is NULL.
 * Errors: no elements, coordinates that are not finite in metres. */
struct mesh_raw_names {
    const char *(*name)(const void *self, int64_t number);
    const void *self;
};
bool mesh_raw_finish(struct mesh_raw *r, const char *path, double unit, const struct mesh_raw_names *names,
                     struct mesh *m, struct err *e);

#endif
