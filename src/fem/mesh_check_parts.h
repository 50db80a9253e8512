/* The parts of mesh_check, in the order in which they are asked. */
#ifndef FEM_MESH_CHECK_PARTS_H
#define FEM_MESH_CHECK_PARTS_H
#include "fem/faces.h"
#include "file/mesh.h"

/* Appends a line to m->note. */
void mesh_check_note(struct mesh *m, struct arena *a, const char *text);

/* The middle of an element's corners, m. */
void mesh_check_middle(const struct mesh *m, int element, double at[3]);

/* Each element for itself: volume, orientation (turns all), Jacobians, slivers. */
bool mesh_check_elements(struct mesh *m, struct arena *a, struct err *e);

/* How they are joined: nodes, midsides, faces, bodies. */
bool mesh_check_joins(const struct mesh *m, const struct faces_face *f, double size, struct arena *a, struct err *e);

/* The surface: closed, touching itself nowhere; cavities; how many elements lie across. */
bool mesh_check_surface(struct mesh *m, const struct faces_face *f, struct arena *a, struct err *e);

#endif
