/* Lagrange's polynomials on the lattice of a simplex (Silvester 1969): the node of barycentric coordinates a/p, the
   whole numbers a summing to p, has

       N = product over corners i of R_a_i(L_i),   R_a(L) = product over t = 0 ... a - 1 of (p L - t)/(t + 1).  */
#include "fem/solid_lattice.h"

#include <string.h>

static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/* The nodes with all of `corners` of the four (or three) at 1 or more and none of the others, in the order of counting.
 */
static int add(int order, const int *corner, int corners, int (*at)[4], int n)
{
    int a[4] = {1, 1, 1, 1};
    for (int code = 0; code < order * order * order * order; code++) {
        int sum = 0;
        for (int i = corners - 1, rest = code; i >= 0; i--, rest /= order)
            sum += a[i] = rest % order + 1;
        int used = order;
        for (int i = 1; i < corners; i++)
            used *= order;
        if (code >= used) break;
        if (sum != order) continue;
        memset(at[n], 0, sizeof at[n]);
        for (int i = 0; i < corners; i++)
            at[n][corner[i]] = a[i];
        n++;
    }
    return n;
}

static int add_edge(int order, const int *end, int (*at)[4], int n)
{
    for (int t = 1; t < order; t++, n++) {
        memset(at[n], 0, sizeof at[n]);
        at[n][end[0]] = order - t;
        at[n][end[1]] = t;
    }
    return n;
}

struct solid_lattice solid_lattice_make(int order)
{
    static const int faces[4][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}, all[4] = {0, 1, 2, 3};
    struct solid_lattice t = {.order = order};
    int plane[SOLID_LATTICE_FACE][4];
    for (int i = 0; i < 4; i++)
        t.at[t.n++][i] = order;
    for (int i = 0; i < 6; i++)
        t.n = add_edge(order, ends[i], t.at, t.n);
    for (int i = 0; i < 4; i++)
        t.n = add(order, faces[i], 3, t.at, t.n);
    t.n = add(order, all, 4, t.at, t.n);
    memset(plane, 0, sizeof plane);
    for (int i = 0; i < 3; i++)
        plane[t.on_face++][i] = order;
    for (int i = 0; i < 3; i++)
        t.on_face = add_edge(order, ends[i], plane, t.on_face);
    t.on_face = add(order, all, 3, plane, t.on_face);
    for (int i = 0; i < t.on_face; i++)
        memcpy(t.face[i], plane[i], sizeof t.face[i]);
    return t;
}

/* R_0 ... R_p at L, and their slopes. */
static void ladder(int order, double l, double r[SOLID_LATTICE_MOST + 1], double slope[SOLID_LATTICE_MOST + 1])
{
    r[0] = 1.0;
    slope[0] = 0.0;
    for (int a = 1; a <= order; a++) {
        double step = (order * l - (a - 1)) / a;
        r[a] = r[a - 1] * step;
        slope[a] = slope[a - 1] * step + r[a - 1] * order / a;
    }
}

void solid_lattice_shapes(const struct solid_lattice *t, const double l[3], double *value, double (*slope)[3])
{
    const double c[4] = {1.0 - l[0] - l[1] - l[2], l[0], l[1], l[2]};
    double r[4][SOLID_LATTICE_MOST + 1], d[4][SOLID_LATTICE_MOST + 1];
    for (int i = 0; i < 4; i++)
        ladder(t->order, c[i], r[i], d[i]);
    for (int n = 0; n < t->n; n++) {
        const int *a = t->at[n];
        double p = r[0][a[0]], q = r[1][a[1]], s = r[2][a[2]], u = r[3][a[3]], first = d[0][a[0]] * q * s * u;
        value[n] = p * q * s * u;
        slope[n][0] = p * d[1][a[1]] * s * u - first;
        slope[n][1] = p * q * d[2][a[2]] * u - first;
        slope[n][2] = p * q * s * d[3][a[3]] - first;
    }
}

void solid_lattice_face(const struct solid_lattice *t, double u, double v, double *value)
{
    const double c[3] = {1.0 - u - v, u, v};
    double r[3][SOLID_LATTICE_MOST + 1], d[SOLID_LATTICE_MOST + 1];
    for (int i = 0; i < 3; i++)
        ladder(t->order, c[i], r[i], d);
    for (int n = 0; n < t->on_face; n++)
        value[n] = r[0][t->face[n][0]] * r[1][t->face[n][1]] * r[2][t->face[n][2]];
}
