/* Cells that shrink towards re-entrant edges, where stress has no bound and elements of any order converge slowly. */
#ifndef FEM_GRADE_H
#define FEM_GRADE_H
#include "fem/boundary.h"

enum { GRADE_DEFAULT = 2, GRADE_MOST = 6 };

/* Cuts the cells that touch a re-entrant edge, layer by layer: of each layer the next is a fifth as far from the edge.
   Along the edge cells stay as long as they are. The mesh is quadratic (topology_elevate), b is its boundary; the solid
   stays the same, curved faces too, and so do the groups' faces, in more parts. Returns how many edges of the mesh are
   re-entrant; 0 (or no layers): the mesh is left as it is, else b is no longer its boundary. */
int grade_edges(struct mesh *m, const struct boundary *b, int layers, struct arena *a);

#endif
