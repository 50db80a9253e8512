/* See mesh_raise.h. */
#include "fem/mesh_raise.h"

#include <string.h>

#include "fem/edges.h"

static const char warning[] = "linear elements were raised to quadratic ones with straight edges: their faces stay "
                              "flat, so what is round wants a finer mesh "
                              "or a quadratic one (gmsh -order 2, tetgen -o2)";

void mesh_raise(struct mesh *m, struct arena *a)
{
    if (!m->linear) return;
    struct edges t;
    edges_open(&t, a);
    int n = m->nodes;
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 6; k++) {
            int *number = edges_at(&t, m->element[i][edges_nodes[k][0]], m->element[i][edges_nodes[k][1]]);
            if (*number < 0) *number = n++;
            m->element[i][4 + k] = *number;
        }
    double(*at)[3] = arena_take(a, (size_t)n, sizeof *at);
    memcpy(at, m->at, (size_t)m->nodes * sizeof *at);
    for (int i = 0; i < m->elements; i++)
        for (int k = 0; k < 6; k++)
            for (int c = 0; c < 3; c++)
                at[m->element[i][4 + k]][c] =
                    0.5 * at[m->element[i][edges_nodes[k][0]]][c] + 0.5 * at[m->element[i][edges_nodes[k][1]]][c];
    m->at = at;
    m->nodes = n;
    m->linear = false;
    m->note = m->note ? arena_format(a, "%s\n%s", m->note, warning) : warning;
}
