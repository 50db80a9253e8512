/* Is the mesh a solid? */
#ifndef FEM_MESH_CHECK_H
#define FEM_MESH_CHECK_H
#include "file/mesh.h"

/* ERR_SCENE, with the cure, and with which element and where (m): no elements; an element of no volume, or whose
   Jacobian is not above 0 everywhere in it (curved ones: at the quadrature points and nodes); elements all turned the
   other way are turned, with a note; some: refused; a node that stands twice at one place (within 1e-9 of the size), as
   in a mesh of parts that are not joined (holes between elements: faces that should be shared and are not); a face of
   more than two elements; two bodies or more (how many, elements of each); a surface that touches itself in an edge or
   node; a size that is no object's (largest extent below 1 mm or above 10 m: says that the file may be in mm, and which
   --unit it needs). Notes (appended to m->note): slivers (worst radius ratio below 0.01), thin parts with fewer than
   two quadratic elements across. */
bool mesh_check(struct mesh *m, struct arena *a, struct err *e);

/* The last question alone: largest extent in m, from 1 mm to 10 m; `cure` ends the message. ERR_SCENE */
bool mesh_check_size(const char *name, double size, const char *cure, struct err *e);

#endif
