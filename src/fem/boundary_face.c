/* See boundary_face.h. */
#include "fem/boundary_face.h"

#include <math.h>
#include <string.h>

void boundary_face_at(const struct mesh *m, const int face[6], const double uv[2], struct boundary_face_at *x)
{
    double u = uv[0], v = uv[1], t = 1 - u - v, w[6];
    boundary_weights(u, v, w);
    const double wu[6] = {1 - 4 * t, 4 * u - 1, 0, 4 * (t - u), 4 * v, -4 * v},
                 wv[6] = {1 - 4 * t, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (t - v)};
    memset(x, 0, sizeof *x);
    for (int i = 0; i < 6; i++)
        for (int c = 0; c < 3; c++) {
            x->at[c] += w[i] * m->at[face[i]][c];
            x->du[c] += wu[i] * m->at[face[i]][c];
            x->dv[c] += wv[i] * m->at[face[i]][c];
        }
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        x->across[c] = x->du[d] * x->dv[e] - x->du[e] * x->dv[d];
    }
}

void boundary_face_bend(const struct mesh *m, const int face[6], double bend[3][3])
{
    static const double second[3][6] = {{4, 4, 0, -8, 0, 0}, {4, 0, 0, -4, 4, -4}, {4, 0, 4, 0, 0, -8}};
    memset(bend, 0, 9 * sizeof(double));
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 6; i++)
            for (int c = 0; c < 3; c++)
                bend[k][c] += second[k][i] * m->at[face[i]][c];
}

void boundary_face_box(const struct mesh *m, const int face[6], double low[3], double high[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = INFINITY;
        high[c] = -INFINITY;
        for (int i = 0; i < 3; i++) {
            double p = m->at[face[i]][c], q = 2 * m->at[face[3 + i]][c] - 0.5 * (p + m->at[face[(i + 1) % 3]][c]);
            low[c] = fmin(low[c], fmin(p, q));
            high[c] = fmax(high[c], fmax(p, q));
        }
    }
}

void boundary_face_point(const struct mesh *m, const struct boundary *b, struct boundary_point *p)
{
    struct boundary_face_at x;
    boundary_face_at(m, b->face[p->face], (double[2]){p->u, p->v}, &x);
    double length = sqrt(boundary_face_dot(x.across, x.across));
    for (int c = 0; c < 3; c++) {
        p->at[c] = x.at[c];
        p->normal[c] = x.across[c] / length;
    }
}

double boundary_face_size(const struct boundary *b)
{
    return fmax(fmax(b->high[0] - b->low[0], b->high[1] - b->low[1]), b->high[2] - b->low[2]);
}
