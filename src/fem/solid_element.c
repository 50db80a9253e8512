/* Stiffness and consistent mass of a tetrahedron of order p (Zienkiewicz and Taylor, The Finite Element Method, 5th
   ed., vol. 1, sections 8.8, 9.10):

       K = integral B^T C B dV,   m = density integral N_a N_b dV,   x(L) = sum over the ten of N_a(L) x_a
   (isoparametric where p is 2).

   Straight edges, midsides in their middle: the Jacobian is constant, K's integrand of degree 2 p - 2 and the mass's of
   degree 2 p. Order 2 takes 4 and 14 points (degree 5), others p + 1 and p + 2 Gauss-Legendre points each way of
   collapsed coordinates (degree 2 n - 3): all exact. Curved: the Jacobian's determinant is of degree 3, the mass's
   integrand of degree 2 p + 3 (p + 3 points each way, exact); K's is not a polynomial, and as many points as for
   straight ones (order 2: 14) are exact for a constant strain. Rules: Hammer and Stroud 1956 (4 points); Walkington
   2000, Grundmann and Moeller's orbits (14 points, degree 5). */
#include "fem/solid_element.h"

#include <math.h>
#include <string.h>

#include "num/gauss.h"

enum { NODES = SOLID_LATTICE_NODES, ACROSS = SOLID_LATTICE_MOST + 3, POINTS_MOST = ACROSS * ACROSS * ACROSS };

struct rule {
    int n;
    double l[POINTS_MOST][3], weight[POINTS_MOST]; /* weights sum to 1/6, the volume of the unit corner */
};

static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

void solid_element_shapes(const double l[3], double value[10], double slope[10][3])
{
    static const double d[4][3] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double c[4] = {1.0 - l[0] - l[1] - l[2], l[0], l[1], l[2]};
    for (int a = 0; a < 4; a++) {
        value[a] = c[a] * (2.0 * c[a] - 1.0);
        for (int k = 0; k < 3; k++)
            slope[a][k] = (4.0 * c[a] - 1.0) * d[a][k];
    }
    for (int s = 0; s < 6; s++) {
        int i = ends[s][0], j = ends[s][1];
        value[4 + s] = 4.0 * c[i] * c[j];
        for (int k = 0; k < 3; k++)
            slope[4 + s][k] = 4.0 * (c[i] * d[j][k] + c[j] * d[i][k]);
    }
}

static void add(struct rule *r, const double c[4], double weight)
{
    memcpy(r->l[r->n], c + 1, 3 * sizeof *c);
    r->weight[r->n++] = weight / 6.0;
}

/* The four points (or one) whose coordinates are b but for one. */
static void add_four(struct rule *r, double b, double weight)
{
    for (int i = 0; i < 4; i++) {
        double c[4] = {b, b, b, b};
        c[i] = 1.0 - 3.0 * b;
        add(r, c, weight);
    }
}

static void rule_4(struct rule *r)
{
    r->n = 0;
    add_four(r, 0.13819660112501051518, 0.25); /* (5 - sqrt 5)/20 */
}

static void rule_14(struct rule *r)
{
    const double b = 0.045503704125649649492;
    r->n = 0;
    add_four(r, 0.31088591926330060980, 0.11268792571801585080);
    add_four(r, 0.092735250310891226402, 0.073493043116361949544);
    for (int s = 0; s < 6; s++) {
        double c[4] = {b, b, b, b};
        c[ends[s][0]] = c[ends[s][1]] = 0.5 - b;
        add(r, c, 0.042546020777081466438);
    }
}

/* L3 = z, L2 = y (1 - z), L1 = x (1 - y)(1 - z), each on (0, 1). */
static void rule_collapsed(int across, struct rule *r)
{
    double g[ACROSS], w[ACROSS];
    gauss_legendre(across, g, w);
    r->n = 0;
    for (int p = 0; p < across * across * across; p++) {
        int i = p % across, j = p / across % across, k = p / (across * across);
        double x = 0.5 + 0.5 * g[i], y = 0.5 + 0.5 * g[j], z = 0.5 + 0.5 * g[k];
        r->l[p][0] = x * (1.0 - y) * (1.0 - z);
        r->l[p][1] = y * (1.0 - z);
        r->l[p][2] = z;
        r->weight[r->n++] = 0.125 * w[i] * w[j] * w[k] * (1.0 - y) * (1.0 - z) * (1.0 - z);
    }
}

static bool straight(const double at[10][3])
{
    for (int s = 0; s < 6; s++) {
        double off = 0.0, length = 0.0;
        for (int k = 0; k < 3; k++) {
            double p = at[ends[s][0]][k], q = at[ends[s][1]][k], d = at[4 + s][k] - 0.5 * (p + q);
            off += d * d;
            length += (q - p) * (q - p);
        }
        if (!(off <= 1e-16 * length)) return false;
    }
    return true;
}

/* Of the places: j's cofactors; returns its determinant, m^3. */
static double jacobian(const double at[10][3], const double l[3], double cof[3][3])
{
    double value[10], slope[10][3], j[3][3] = {{0}};
    solid_element_shapes(l, value, slope);
    for (int a = 0; a < 10; a++)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                j[i][k] += slope[a][i] * at[a][k];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            int a = (i + 1) % 3, b = (i + 2) % 3, c = (k + 1) % 3, d = (k + 2) % 3;
            cof[i][k] = j[a][c] * j[b][d] - j[a][d] * j[b][c];
        }
    return j[0][0] * cof[0][0] + j[0][1] * cof[0][1] + j[0][2] * cof[0][2];
}

/* Slopes along x, y, z (1/m) from those along L. */
static void turn(int n, const double cof[3][3], double det, double (*slope)[3])
{
    for (int a = 0; a < n; a++) {
        double s[3] = {slope[a][0], slope[a][1], slope[a][2]};
        for (int k = 0; k < 3; k++)
            slope[a][k] = (s[0] * cof[0][k] + s[1] * cof[1][k] + s[2] * cof[2][k]) / det;
    }
}

/* k += weight B^T C B; lower block triangle. */
static void add_stiffness(int n, double (*g)[3], const struct elastic *s, double weight, double k[3 * NODES][3 * NODES])
{
    for (int a = 0; a < n; a++) {
        double x = g[a][0] * weight, y = g[a][1] * weight, z = g[a][2] * weight, t[6][3];
        for (int i = 0; i < 6; i++) {
            t[i][0] = s->c[i][0] * x + s->c[i][4] * z + s->c[i][5] * y;
            t[i][1] = s->c[i][1] * y + s->c[i][3] * z + s->c[i][5] * x;
            t[i][2] = s->c[i][2] * z + s->c[i][3] * y + s->c[i][4] * x;
        }
        for (int b = a; b < n; b++)
            for (int j = 0; j < 3; j++) {
                k[3 * b][3 * a + j] += g[b][0] * t[0][j] + g[b][2] * t[4][j] + g[b][1] * t[5][j];
                k[3 * b + 1][3 * a + j] += g[b][1] * t[1][j] + g[b][2] * t[3][j] + g[b][0] * t[5][j];
                k[3 * b + 2][3 * a + j] += g[b][2] * t[2][j] + g[b][1] * t[3][j] + g[b][0] * t[4][j];
            }
    }
}

static void add_mass(int n, const double *value, double weight, double m[NODES][NODES])
{
    for (int a = 0; a < n; a++)
        for (int b = 0; b <= a; b++)
            m[a][b] += weight * value[a] * value[b];
}

struct shaped {
    const double (*at)[3];
    const struct solid_lattice *lattice;
};

/* One pass over a rule: stiffness where s is given, else mass (of density 1) and volume. */
static bool integrate(const struct shaped *e, const struct rule *r, const struct elastic *s, struct solid_element *x)
{
    int n = e->lattice->n;
    for (int p = 0; p < r->n; p++) {
        double value[NODES], slope[NODES][3], cof[3][3], det = jacobian(e->at, r->l[p], cof);
        if (!(det > 0.0) || !isfinite(det)) return false;
        solid_lattice_shapes(e->lattice, r->l[p], value, slope);
        if (s) {
            turn(n, (const double(*)[3])cof, det, slope);
            add_stiffness(n, slope, s, det * r->weight[p], x->k);
        } else {
            add_mass(n, value, det * r->weight[p], x->m);
            x->volume += det * r->weight[p];
        }
    }
    return true;
}

static void rules(int order, bool flat, struct rule *for_mass, struct rule *for_stiffness)
{
    if (order == 2 && flat)
        rule_14(for_mass);
    else
        rule_collapsed(order + (flat ? 2 : 3), for_mass);
    if (order == 2)
        (flat ? rule_4 : rule_14)(for_stiffness);
    else
        rule_collapsed(order + 1, for_stiffness);
}

bool solid_element_make(const double at[10][3], const struct solid_lattice *t, const struct elastic *s,
                        struct solid_element *x)
{
    struct rule for_mass, for_stiffness;
    struct shaped e = {at, t};
    rules(t->order, straight(at), &for_mass, &for_stiffness);
    memset(x, 0, sizeof *x);
    if (!integrate(&e, &for_mass, NULL, x) || !integrate(&e, &for_stiffness, s, x)) return false;
    for (int i = 0; i < t->n; i++)
        for (int j = 0; j <= i; j++)
            x->m[i][j] = x->m[j][i] = s->density * x->m[i][j];
    for (int i = 0; i < 3 * t->n; i++)
        for (int j = 0; j < i; j++)
            x->k[j][i] = x->k[i][j];
    return true;
}
