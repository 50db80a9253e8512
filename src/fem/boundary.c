/* See boundary.h. Area and volume by Radon's seven points on the triangle, exact to degree 5: the volume, one third of
 * the integral of x . n, is of degree 4 and so exact. */
#include "fem/boundary.h"

#include <math.h>
#include <string.h>

#include "fem/boundary_face.h"
#include "fem/faces.h"
#include "fem/roots.h"

void boundary_weights(double u, double v, double w[6])
{
    double t = 1 - u - v;
    w[0] = t * (2 * t - 1);
    w[1] = u * (2 * u - 1);
    w[2] = v * (2 * v - 1);
    w[3] = 4 * t * u;
    w[4] = 4 * u * v;
    w[5] = 4 * v * t;
}

static void outer_faces(const struct mesh *m, struct arena *a, struct boundary *b)
{
    struct faces_face *f = faces_sorted(m, a);
    bool *outer = ARENA_TAKE(a, bool, 4 * (size_t)m->elements);
    int n = 4 * m->elements;
    for (int i = 0, alike; i < n; i += alike) {
        alike = faces_alike(f + i, n - i);
        outer[4 * f[i].element + f[i].side] = alike == 1;
        b->n += alike == 1;
    }
    b->face = arena_take(a, (size_t)b->n, sizeof *b->face);
    for (int i = 0, k = 0; i < n; i++)
        if (outer[i]) {
            for (int c = 0; c < 6; c++)
                b->face[k][c] = m->element[i / 4][faces_nodes[i % 4][c]];
            k++;
        }
}

static void measure_face(const struct mesh *m, const int face[6], double *area, double *volume)
{
    const double root = sqrt(15), p = (6 - root) / 21, q = (6 + root) / 21, wp = (155 - root) / 2400,
                 wq = (155 + root) / 2400;
    const double rule[7][3] = {{1. / 3, 1. / 3, 9. / 80}, {p, p, wp}, {p, 1 - 2 * p, wp},
                               {1 - 2 * p, p, wp},        {q, q, wq}, {q, 1 - 2 * q, wq},
                               {1 - 2 * q, q, wq}};
    for (int k = 0; k < 7; k++) {
        struct boundary_face_at x;
        boundary_face_at(m, face, rule[k], &x);
        *area += rule[k][2] * sqrt(boundary_face_dot(x.across, x.across));
        *volume += rule[k][2] * boundary_face_dot(x.at, x.across) / 3;
    }
}

/* Faces that share nodes are of one skin; that of a cavity, seen from the solid, has a negative volume. */
static void measure(const struct mesh *m, struct arena *a, struct boundary *b)
{
    int *skin = roots_open(m->nodes, a);
    double *area = ARENA_TAKE(a, double, m->nodes), *volume = ARENA_TAKE(a, double, m->nodes);
    for (int i = 0; i < b->n; i++)
        for (int c = 1; c < 6; c++)
            roots_join(skin, b->face[i][0], b->face[i][c]);
    for (int i = 0; i < b->n; i++) {
        int of = roots_of(skin, b->face[i][0]);
        measure_face(m, b->face[i], &b->area, &b->volume);
        measure_face(m, b->face[i], &area[of], &volume[of]);
    }
    for (int i = 0; i < m->nodes; i++)
        b->outer += volume[i] > 0 ? area[i] : 0;
}

void boundary_make(const struct mesh *m, struct arena *a, struct boundary *b)
{
    *b = (struct boundary){.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < m->nodes; i++)
        for (int c = 0; c < 3; c++) {
            b->low[c] = fmin(b->low[c], m->at[i][c]);
            b->high[c] = fmax(b->high[c], m->at[i][c]);
        }
    outer_faces(m, a, b);
    measure(m, a, b);
}
