/* See mesh_check.h. */
#include "fem/mesh_check.h"

#include <math.h>

#include "fem/mesh_check_parts.h"

static const double smallest = 1e-3, largest = 10; /* m */

void mesh_check_note(struct mesh *m, struct arena *a, const char *text)
{
    m->note = m->note ? arena_format(a, "%s\n%s", m->note, text) : text;
}

void mesh_check_middle(const struct mesh *m, int element, double at[3])
{
    for (int c = 0; c < 3; c++) {
        at[c] = 0;
        for (int i = 0; i < 4; i++)
            at[c] += m->at[m->element[element][i]][c] / 4;
    }
}

static double extent(const struct mesh *m)
{
    double size = 0;
    for (int c = 0; c < 3; c++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < m->nodes; i++) {
            low = fmin(low, m->at[i][c]);
            high = fmax(high, m->at[i][c]);
        }
        size = fmax(size, high - low);
    }
    return size;
}

bool mesh_check_size(const char *name, double size, const char *cure, struct err *e)
{
    return (size >= smallest && size <= largest) ||
           err_set(e, ERR_SCENE, "%s: it is %g m large, too %s for an object; %s", name, size,
                   size > largest ? "large" : "small", cure);
}

static bool check_size(const struct mesh *m, double size, struct arena *a, struct err *e)
{
    const char *cure =
        size > largest
            ? arena_format(a, "the file may be in mm or cm: give --unit mm (then it is %g m) or --unit cm (%g m)",
                           size / 1000, size / 100)
            : arena_format(a,
                           "the file may be in a larger unit: give --unit m, cm or mm (1000 times as large it is %g m)",
                           1000 * size);
    return mesh_check_size(m->name, size, cure, e);
}

bool mesh_check(struct mesh *m, struct arena *a, struct err *e)
{
    if (m->elements == 0)
        return err_set(e, ERR_SCENE, "%s: no tetrahedra; fill the solid with elements (gmsh -3, tetgen -pq)", m->name);
    double size = extent(m);
    if (!check_size(m, size, a, e) || !mesh_check_elements(m, a, e)) return false;
    struct faces_face *f = faces_sorted(m, a);
    return mesh_check_joins(m, f, size, a, e) && mesh_check_surface(m, f, a, e);
}
