/* Tetrahedral meshes of solids, read from files: Gmsh MSH 2.2 and 4.1 (ASCII and little-endian binary), TetGen .node
 * with .ele. */
#ifndef FILE_MESH_H
#define FILE_MESH_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct mesh_group { /* faces that the file names (Gmsh: a physical surface; TetGen: a boundary marker, its number as
                       text) */
    const char *name;
    int n;
    int (*corner)[3]; /* [n] indices of nodes, in any orientation */
};

/* Corners 0 to 3, then midsides of the edges 01 12 20 03 13 23. Corner 3 lies on the side of 0, 1, 2 from which they
   turn counterclockwise (positive volume). */
struct mesh {
    const char *name; /* file, or text of --shape, for messages */
    int nodes, elements, groups;
    double (*at)[3];          /* [nodes] m */
    int (*element)[10];       /* [elements]; of a linear mesh midsides are -1 until topology_elevate (fem/topology.h) */
    struct mesh_group *group; /* [groups] */
    bool linear;              /* elements have their four corners only */
    const char *note;         /* lines, warnings; NULL: none */
};

/* By its name: .msh, else .node or .ele (either stands for both; .face, if there, gives groups). unit: m per unit of
   the file, above 0. Nodes that no element uses are left out. Elements other than 4- and 10-node tetrahedra (and
   points, lines and triangles, which are skipped or are groups) are refused. Checks only what the format demands; what
   a solid demands: fem/mesh_check.h. ERR_INPUT; ERR_SCENE "file:line: what" (binary: "file: byte N: what"); no file,
   however broken or large its counts, makes it crash, hang or take more memory than some times its length. */
bool mesh_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e);

/* Appends a line to m->note. */
void mesh_note(struct mesh *m, struct arena *a, const char *text);

#endif
