/* Linear tetrahedra lock where something bends: midsides make them quadratic. */
#ifndef FEM_MESH_RAISE_H
#define FEM_MESH_RAISE_H
#include "file/mesh.h"

/* A node in the middle of each edge, shared by all elements with that edge; appends the warning to m->note: that faces
   stay flat, so what is round wants a finer mesh or a quadratic one (gmsh -order 2). m->linear becomes false. Nothing
   to do for a quadratic mesh. */
void mesh_raise(struct mesh *m, struct arena *a);

#endif
