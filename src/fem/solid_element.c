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

#include "fem/topology.h"
#include "num/special.h"

/* Hooke's law, stress = C strain, in the order xx yy zz yz zx xy with engineering shear (twice the tensor's).

   Isotropic (E: Young's modulus, nu: Poisson's ratio):  C_ii = L + 2 G, C_ij = L (i, j < 3), C_kk = G (k > 2),
   L = E nu/((1 + nu)(1 - 2 nu)), G = E/(2 (1 + nu)).

   Orthotropic: its inverse, the compliance, is what moduli are measured as: S_ii = 1/E_i, S_ij = -nu_ij/E_i = S_ji,
   S_kk = 1/G_k (Ting, Anisotropic Elasticity, 1996, section 2.3). Energy is positive for every strain if and only if
   all leading minors of S are. */

bool solid_element_isotropic(double youngs_modulus, double poisson, double density, struct elastic *s, struct err *e)
{
    if (!(youngs_modulus > 0.0) || !isfinite(youngs_modulus) || !(density > 0.0) || !isfinite(density))
        return err_set(e, ERR_USAGE, "a material of Young's modulus %g Pa and density %g kg/m^3: both must be above 0",
                       youngs_modulus, density);
    if (!(poisson > -1.0 && poisson < 0.5))
        return err_set(e, ERR_USAGE,
                       "Poisson's ratio %g: it must be above -1 and below 0.5 (metals 0.3, glass 0.2, rubber 0.49)",
                       poisson);
    memset(s, 0, sizeof *s);
    double lame = youngs_modulus * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
           shear = 0.5 * youngs_modulus / (1.0 + poisson);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            s->c[i][j] = i == j ? lame + 2.0 * shear : lame;
        s->c[i + 3][i + 3] = shear;
    }
    s->density = density;
    return true;
}

/* Cofactor of a 3 x 3 matrix, its sign included. */
static double cofactor(const double m[3][3], int i, int j)
{
    int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
}

static bool positive(const struct elastic_wood *w)
{
    for (int i = 0; i < 3; i++)
        if (!(w->e[i] > 0.0) || !isfinite(w->e[i]) || !(w->g[i] > 0.0) || !isfinite(w->g[i]) || !isfinite(w->nu[i]))
            return false;
    return w->density > 0.0 && isfinite(w->density);
}

bool solid_element_orthotropic(const struct elastic_wood *w, struct elastic *s, struct err *e)
{
    if (!positive(w))
        return err_set(
            e, ERR_USAGE,
            "an orthotropic material of E %g %g %g Pa, G %g %g %g Pa and density %g kg/m^3: all must be above 0",
            w->e[0], w->e[1], w->e[2], w->g[0], w->g[1], w->g[2], w->density);
    double yz = -w->nu[0] / w->e[1], xz = -w->nu[1] / w->e[0], xy = -w->nu[2] / w->e[0];
    const double compliance[3][3] = {{1.0 / w->e[0], xy, xz}, {xy, 1.0 / w->e[1], yz}, {xz, yz, 1.0 / w->e[2]}};
    double minor = cofactor(compliance, 2, 2), whole = 0.0;
    for (int j = 0; j < 3; j++)
        whole += compliance[0][j] * cofactor(compliance, 0, j);
    if (!(minor > 0.0 && whole > 0.0))
        return err_set(e, ERR_USAGE,
                       "no material has Poisson's ratios yz %g, xz %g, xy %g beside E %g %g %g Pa (some pull would "
                       "give energy out): nu_ij^2 must be well below E_i/E_j",
                       w->nu[0], w->nu[1], w->nu[2], w->e[0], w->e[1], w->e[2]);
    memset(s, 0, sizeof *s);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            s->c[i][j] = cofactor(compliance, i, j) / whole;
        s->c[i + 3][i + 3] = w->g[i];
    }
    s->density = w->density;
    return true;
}

/* Lagrange's polynomials on the lattice of a simplex (Silvester 1969): the node of barycentric coordinates a/p, the
   whole numbers a summing to p, has

       N = product over corners i of R_a_i(L_i),   R_a(L) = product over t = 0 ... a - 1 of (p L - t)/(t + 1).  */

/* The nodes with all of `corners` of the four (or three) at 1 or more and none of the others, in the order of counting.
 */
static int lattice_add(int order, const int *corner, int corners, int (*at)[4], int n)
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

struct solid_lattice solid_element_lattice(int order)
{
    static const int faces[4][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}, all[4] = {0, 1, 2, 3};
    struct solid_lattice t = {.order = order};
    int plane[SOLID_LATTICE_FACE][4];
    for (int i = 0; i < 4; i++)
        t.at[t.n++][i] = order;
    for (int i = 0; i < 6; i++)
        t.n = add_edge(order, topology_edge_nodes[i], t.at, t.n);
    for (int i = 0; i < 4; i++)
        t.n = lattice_add(order, faces[i], 3, t.at, t.n);
    t.n = lattice_add(order, all, 4, t.at, t.n);
    memset(plane, 0, sizeof plane);
    for (int i = 0; i < 3; i++)
        plane[t.on_face++][i] = order;
    for (int i = 0; i < 3; i++)
        t.on_face = add_edge(order, topology_edge_nodes[i], plane, t.on_face);
    t.on_face = lattice_add(order, all, 3, plane, t.on_face);
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

void solid_element_lattice_shapes(const struct solid_lattice *t, const double l[3], double *value, double (*slope)[3])
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

void solid_element_lattice_face(const struct solid_lattice *t, double u, double v, double *value)
{
    const double c[3] = {1.0 - u - v, u, v};
    double r[3][SOLID_LATTICE_MOST + 1], d[SOLID_LATTICE_MOST + 1];
    for (int i = 0; i < 3; i++)
        ladder(t->order, c[i], r[i], d);
    for (int n = 0; n < t->on_face; n++)
        value[n] = r[0][t->face[n][0]] * r[1][t->face[n][1]] * r[2][t->face[n][2]];
}

enum { NODES = SOLID_LATTICE_NODES, ACROSS = SOLID_LATTICE_MOST + 3, POINTS_MOST = ACROSS * ACROSS * ACROSS };

struct rule {
    int n;
    double l[POINTS_MOST][3], weight[POINTS_MOST]; /* weights sum to 1/6, the volume of the unit corner */
};

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
        int i = topology_edge_nodes[s][0], j = topology_edge_nodes[s][1];
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
        c[topology_edge_nodes[s][0]] = c[topology_edge_nodes[s][1]] = 0.5 - b;
        add(r, c, 0.042546020777081466438);
    }
}

/* L3 = z, L2 = y (1 - z), L1 = x (1 - y)(1 - z), each on (0, 1). */
static void rule_collapsed(int across, struct rule *r)
{
    double g[ACROSS], w[ACROSS];
    special_gauss_legendre(across, g, w);
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

bool solid_element_straight(const double at[10][3])
{
    for (int s = 0; s < 6; s++) {
        double off = 0.0, length = 0.0;
        for (int k = 0; k < 3; k++) {
            double p = at[topology_edge_nodes[s][0]][k], q = at[topology_edge_nodes[s][1]][k],
                   d = at[4 + s][k] - 0.5 * (p + q);
            off += d * d;
            length += (q - p) * (q - p);
        }
        if (!(off <= 1e-16 * length)) return false;
    }
    return true;
}

double solid_element_jacobian(const double at[10][3], const double l[3], double cof[3][3])
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

struct shaped {
    const double (*at)[3];
    const struct solid_lattice *lattice;
};

/* One pass over a rule: stiffness where s is given, else mass (of density 1) and volume. */
static bool integrate(const struct shaped *e, const struct rule *r, const struct elastic *s, struct solid_element *x)
{
    int n = e->lattice->n;
    for (int p = 0; p < r->n; p++) {
        double value[NODES], slope[NODES][3], cof[3][3], det = solid_element_jacobian(e->at, r->l[p], cof);
        if (!(det > 0.0) || !isfinite(det)) return false;
        solid_element_lattice_shapes(e->lattice, r->l[p], value, slope);
        if (s) {
            turn(n, (const double(*)[3])cof, det, slope);
            add_stiffness(n, slope, s, det * r->weight[p], x->k);
        } else {
            for (int a = 0; a < n; a++)
                for (int b = 0; b <= a; b++)
                    x->m[a][b] += det * r->weight[p] * value[a] * value[b];
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
    rules(t->order, solid_element_straight(at), &for_mass, &for_stiffness);
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
