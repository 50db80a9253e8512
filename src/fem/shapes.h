/* Meshes of simple solids: "plate:length=30cm,width=20cm,thickness=5mm". */
#ifndef FEM_SHAPES_H
#define FEM_SHAPES_H
#include "file/mesh.h"

/* WORD:KEY=LENGTH,... of quadratic tetrahedra whose midsides lie on the true surface. Shapes, keys (all lengths with
   units), and where they lie (m):
     plate   length, width, thickness             x in [0, length], y in [0, width], z in [0, thickness]
     bar     length, width, thickness             the same solid, meshed for what is slender
     rod     length, diameter [, wall]            x in [0, length], axis y = z = 0; wall: a tube
     ring    diameter, width, thickness           round the z axis: outer diameter, radial width, z in [0, thickness]
     bowl    diameter, height, thickness [, foot] a cap of a sphere, open upwards, rim at z = height, of uniform
             thickness, on a flat foot of that diameter (default a third)
     sphere  diameter [, wall]                    round the origin; wall: hollow
     mug     diameter, height, wall [, bottom] [, handle]   round the z axis, bottom at z = 0; handle: its thickness, a
                                                            bow in the x-z plane on the side of +x; handle=0: none
   and the number of elements: fineness=N (1 coarse, 2 default: some 25 to 50 thousand freedoms of order 3; ... 6), at
   least one across what is thinnest. Groups: x0 x1 y0 y1 z0 z1 of plate and bar; x0 x1 of a rod; z0 z1 of a ring; foot,
   rim of a bowl; bottom, rim, handle of a mug. ERR_USAGE with the list of shapes or keys, "did you mean", or which
   length does not fit which. */
bool shapes_mesh(const char *text, struct arena *a, struct mesh *m, struct err *e);

/* The same of cells `longer` (above 1) times as long, as far as the shape's least numbers of cells allow. */
bool shapes_mesh_coarser(const char *text, double longer, struct arena *a, struct mesh *m, struct err *e);

/* The order of displacements that costs least for this shape: 3, of what is thin and curved 4. */
int shapes_order(const char *text);

/* Help: one line per shape. */
const char *shapes_help(void);

#endif
