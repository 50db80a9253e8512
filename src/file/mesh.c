/* See mesh.h. */
#include "file/mesh.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "file/mesh_formats.h"

void mesh_note(struct mesh *m, struct arena *a, const char *text)
{
    m->note = m->note ? arena_format(a, "%s\n%s", m->note, text) : text;
}

bool mesh_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e)
{
    if (!(unit > 0) || !isfinite(unit))
        return err_set(e, ERR_USAGE, "%s: its unit is %g m, and must be above 0", path, unit);
    if (text_ends(path, ".msh")) return mesh_msh_read(path, unit, a, m, e);
    if (text_ends(path, ".node") || text_ends(path, ".ele")) return mesh_tetgen_read(path, unit, a, m, e);
    return err_set(e, ERR_SCENE,
                   "%s: not a mesh by its name; .msh (Gmsh 2.2 or 4.1) and .node with .ele (TetGen) are read", path);
}
