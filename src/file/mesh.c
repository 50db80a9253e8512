/* See mesh.h. */
#include "file/mesh.h"

#include <math.h>
#include <string.h>

#include "file/mesh_formats.h"

static bool ends(const char *path, const char *ending)
{
    size_t n = strlen(path), k = strlen(ending);
    return n > k && !strcmp(path + n - k, ending);
}

bool mesh_read(const char *path, double unit, struct arena *a, struct mesh *m, struct err *e)
{
    if (!(unit > 0) || !isfinite(unit))
        return err_set(e, ERR_USAGE, "%s: its unit is %g m, and must be above 0", path, unit);
    if (ends(path, ".msh"))
        return mesh_msh_read(path, unit, a, m, e);
    if (ends(path, ".node") || ends(path, ".ele"))
        return mesh_tetgen_read(path, unit, a, m, e);
    return err_set(e, ERR_SCENE, "%s: not a mesh by its name; .msh (Gmsh 2.2 or 4.1) and .node with .ele (TetGen) are read", path);
}
