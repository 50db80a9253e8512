/* Each element for itself. The Jacobian of a curved element is looked at in the 35 places of the lattice of quarters
   (nodes are among them) and in the four and five of the usual quadratures; of a straight one it is the same
   everywhere. A sliver's radius ratio, 3 inscribed / circumscribed, is 1 of a regular tetrahedron and 0 of a flat one.
 */
#include <math.h>
#include <stdio.h>

#include "fem/edges.h"
#include "fem/mesh_check_parts.h"

static const double flat = 1e-9;   /* of the longest edge cubed: volumes (six times) below are none */
static const double sliver = 0.01; /* radius ratio */

static double dot(const double *p, const double *q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

static void cross(const double *p, const double *q, double *r)
{
    for (int c = 0; c < 3; c++)
        r[c] = p[(c + 1) % 3] * q[(c + 2) % 3] - p[(c + 2) % 3] * q[(c + 1) % 3];
}

static void edge(const struct mesh *m, const int *t, int i, int j, double d[3])
{
    for (int c = 0; c < 3; c++)
        d[c] = m->at[t[j]][c] - m->at[t[i]][c];
}

/* Six times the volume between the corners, over the longest edge cubed: 0.7 of a regular tetrahedron. */
static double shape_of(const struct mesh *m, const int *t)
{
    double longest = 0, d[3], p[3], q[3], r[3];
    for (int k = 0; k < 6; k++) {
        edge(m, t, edges_nodes[k][0], edges_nodes[k][1], d);
        longest = fmax(longest, sqrt(dot(d, d)));
    }
    edge(m, t, 0, 1, d);
    edge(m, t, 0, 2, p);
    edge(m, t, 0, 3, q);
    cross(d, p, r);
    return longest > 0 ? dot(r, q) / (longest * longest * longest) : 0;
}

/* 3 r/R: r = 3 V/S; R = sqrt(s) / (24 V), s of the products of opposite edges as Heron's formula. */
static double radius_ratio(const struct mesh *m, const int *t)
{
    static const int opposite[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}};
    double product[3], surface = 0, d[3], f[3], n[3];
    for (int k = 0; k < 3; k++) {
        edge(m, t, opposite[k][0], opposite[k][1], d);
        edge(m, t, opposite[k][2], opposite[k][3], f);
        product[k] = sqrt(dot(d, d) * dot(f, f));
    }
    for (int k = 0; k < 4; k++) {
        edge(m, t, faces_nodes[k][0], faces_nodes[k][1], d);
        edge(m, t, faces_nodes[k][0], faces_nodes[k][2], f);
        cross(d, f, n);
        surface += 0.5 * sqrt(dot(n, n));
    }
    edge(m, t, 0, 1, d);
    edge(m, t, 0, 2, f);
    cross(d, f, n);
    edge(m, t, 0, 3, d);
    double volume = fabs(dot(n, d)) / 6, x = product[0], y = product[1], z = product[2];
    double heron = (x + y + z) * (x + y - z) * (x - y + z) * (y + z - x);
    return heron > 0 ? 9 * volume / surface * 24 * volume / sqrt(heron) : 0;
}

/* det dx/d(xi) at barycentric coordinates, m^3. */
static double jacobian(const struct mesh *m, const int *t, const double l[4])
{
    double j[3][3] = {{0}}, n[3]; /* j[k]: derivative to l[k + 1] at l[0] = 1 - the others */
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++)
                j[k][c] += (4 * l[i] - 1) * ((i == k + 1) - (i == 0)) * m->at[t[i]][c];
    for (int i = 0; i < 6; i++) {
        int p = edges_nodes[i][0], q = edges_nodes[i][1];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++)
                j[k][c] +=
                    4 * (l[p] * ((q == k + 1) - (q == 0)) + l[q] * ((p == k + 1) - (p == 0))) * m->at[t[4 + i]][c];
    }
    cross(j[0], j[1], n);
    return dot(n, j[2]);
}

static bool straight(const struct mesh *m, const int *t)
{
    for (int k = 0; k < 6; k++) {
        double d[3], off[3];
        edge(m, t, edges_nodes[k][0], edges_nodes[k][1], d);
        edge(m, t, edges_nodes[k][0], 4 + k, off);
        for (int c = 0; c < 3; c++)
            off[c] -= 0.5 * d[c];
        if (dot(off, off) > 1e-18 * dot(d, d)) return false;
    }
    return true;
}

/* The least Jacobian at the places looked at. */
static double least_jacobian(const struct mesh *m, const int *t)
{
    static const double rules[3] = {0.1381966011250105, 1. / 6,
                                    0.0919710780527230}; /* the other three coordinates of points on the medians */
    double least = INFINITY;
    for (int i = 0; i <= 4; i++)
        for (int j = 0; i + j <= 4; j++)
            for (int k = 0; i + j + k <= 4; k++)
                least = fmin(least, jacobian(m, t, (double[4]){i / 4., j / 4., k / 4., (4 - i - j - k) / 4.}));
    for (int i = 0; i < 12; i++) {
        double l[4], r = rules[i / 4];
        for (int k = 0; k < 4; k++)
            l[k] = k == i % 4 ? 1 - 3 * r : r;
        least = fmin(least, jacobian(m, t, l));
    }
    return least;
}

/* Corners 1 and 2 change places, and so do the midsides of 01 and 20, 13 and 23. */
static void turn(int *t)
{
    static const int pairs[3][2] = {{1, 2}, {4, 6}, {8, 9}};
    for (int i = 0; i < 3; i++) {
        int k = t[pairs[i][0]];
        t[pairs[i][0]] = t[pairs[i][1]];
        t[pairs[i][1]] = k;
    }
}

static bool bad_element(const struct mesh *m, int i, const char *what, struct err *e)
{
    double at[3];
    mesh_check_middle(m, i, at);
    return err_set(e, ERR_SCENE, "%s: tetrahedron %d (counted from 1), at (%.4g, %.4g, %.4g) m, %s", m->name, i + 1,
                   at[0], at[1], at[2], what);
}

/* All the one way round, or turned so; none flat. */
static bool orient(struct mesh *m, struct arena *a, struct err *e)
{
    int wrong = 0, first = -1;
    for (int i = 0; i < m->elements; i++) {
        double s = shape_of(m, m->element[i]);
        if (fabs(s) < flat)
            return bad_element(m, i, "has no volume: its corners lie in a plane; mesh again, or leave it out", e);
        if (s < 0 && wrong++ == 0) first = i;
    }
    if (wrong == 0) return true;
    if (wrong < m->elements) {
        char text[160];
        snprintf(text, sizeof text,
                 "is turned inside out, as are %d of %d; the mesh is broken there: mesh again, finer or with another "
                 "algorithm",
                 wrong, m->elements);
        return bad_element(m, first, text, e);
    }
    for (int i = 0; i < m->elements; i++)
        turn(m->element[i]);
    mesh_check_note(m, a, "all tetrahedra were turned the other way round, and have been turned back");
    return true;
}

bool mesh_check_elements(struct mesh *m, struct arena *a, struct err *e)
{
    int slivers = 0, worst = 0;
    double ratio = INFINITY, at[3];
    if (!orient(m, a, e)) return false;
    for (int i = 0; i < m->elements; i++) {
        if (!m->linear && !straight(m, m->element[i]) && !(least_jacobian(m, m->element[i]) > 0))
            return bad_element(m, i,
                               "is so bent that it folds (its Jacobian is not above 0 everywhere); mesh finer there, "
                               "or optimise (gmsh -optimize_ho)",
                               e);
        double r = radius_ratio(m, m->element[i]);
        slivers += r < sliver;
        if (r < ratio) {
            ratio = r;
            worst = i;
        }
    }
    mesh_check_middle(m, worst, at);
    if (slivers > 0)
        mesh_check_note(m, a,
                        arena_format(a,
                                     "%d of %d tetrahedra are nearly flat (radius ratio below %g; the worst, %.2g, at "
                                     "(%.4g, %.4g, %.4g) m): they are stiffer than the solid; "
                                     "optimise the mesh (gmsh -optimize_netgen)",
                                     slivers, m->elements, sliver, ratio, at[0], at[1], at[2]));
    return true;
}
