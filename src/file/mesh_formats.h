/* What the readers of meshes share. */
#ifndef FILE_MESH_FORMATS_H
#define FILE_MESH_FORMATS_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/err.h"
#include "file/mesh.h"

/* What they read from: a file in memory, numbers as text or as little-endian binary. Nothing is read beyond its end. */
struct mesh_source {
    const char *path, *start, *at, *end; /* *end is 0 */
    int line;                            /* of `at`, from 1; counted in text only */
    bool binary, remarks;                /* remarks: '#' begins one that lasts to the line's end */
    struct err *e;
};

bool mesh_source_open(struct mesh_source *s, const char *path, struct arena *a, struct err *e);

/* ERR_SCENE, "file:line: text" or "file: byte N: text". */
bool mesh_source_bad(const struct mesh_source *s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The next number. bytes: 4 or 8, of a whole number in binary. What: for the message. A real one must be finite. */
bool mesh_source_whole(struct mesh_source *s, int bytes, int64_t *v, const char *what);

bool mesh_source_real(struct mesh_source *s, double *v, const char *what);

/* A count of things of which each takes at least so many bytes: refused when the file is too short for them. */
bool mesh_source_count(struct mesh_source *s, int bytes, size_t least, size_t *n, const char *what);

/* Text: is there another number on this line? */
bool mesh_source_on_line(struct mesh_source *s);

/* Goes behind "$name" on a line of its own, forwards; false: it is not there (no error is set). */
bool mesh_source_find(struct mesh_source *s, const char *name);

/* Goes behind the end of the line. */
void mesh_source_next_line(struct mesh_source *s);

/* A mesh as a file says it: nodes by tags (any whole numbers), elements and faces in the order of the file. */
struct mesh_raw {
    struct arena *arena;
    size_t nodes, elements, faces, triangles; /* faces: that belong to a group; triangles: all */
    size_t node_room;
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

/* Nodes that are used, in metres; groups by rising number, called name(self, number), or its number where that (or
 * names) is NULL. Errors: no elements, coordinates that are not finite in metres. */
struct mesh_raw_names {
    const char *(*name)(const void *self, int64_t number);
    const void *self;
};

bool mesh_raw_finish(struct mesh_raw *r, const char *path, double unit, const struct mesh_raw_names *names,
                     struct mesh *m, struct err *e);

/* The formats. */
bool mesh_msh_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e);

bool mesh_tetgen_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e);

#endif
