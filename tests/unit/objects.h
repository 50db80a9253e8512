/* Objects for tests: everything not given, quadrature over them, their static give. */
#ifndef OBJECTS_H
#define OBJECTS_H
#include "num/special.h"
#include "response/object.h"
#include "unit.h"

#define PI 3.14159265358979323846

/* E = 12 (1 - nu^2) GPa, h = 1 mm, 1000 kg/m^3: a plate has D = 1 N m and rho h = 1 kg/m^2, so that w is the textbooks'
 * lambda^2. */
static inline struct object_given objects_given(int shape, int edges, double nu)
{
    struct object_given g = {.given = true,
                             .shape = shape,
                             .edges = edges,
                             .length = 1.0,
                             .width = 1.0,
                             .thickness = 1e-3,
                             .diameter = 2.0,
                             .tension = NAN,
                             .surface_tension = NAN,
                             .youngs_modulus = 12e9 * (1.0 - nu * nu),
                             .youngs_modulus_across = NAN,
                             .shear_modulus = NAN,
                             .poisson = nu,
                             .density = 1000.0,
                             .alpha = NAN,
                             .beta = NAN,
                             .loss = 1e-6};
    return g;
}

static inline struct object objects_make(const struct object_given *g, int most, double top, struct arena *a)
{
    struct object_ask ask = {.key = "surface.object", .top = top, .most = most};
    struct object o;
    const char *note;
    struct err e = {0};
    if (!object_make(g, &ask, a, &o, &note, &e)) ck_abort_msg("%s", e.text);
    return o;
}

/* Of a shape with nothing out of the ordinary: its `most` lowest modes. */
static inline struct object objects_of(int shape, int edges, double nu, int most, struct arena *a)
{
    struct object_given g = objects_given(shape, edges, nu);
    return objects_make(&g, most, 1e9, a);
}

/* Any shape, free, with all that it needs: for tests that go through them all. */
static inline struct object_given objects_any(int shape)
{
    struct object_given g = objects_given(shape, EDGES_FREE, 0.3);
    g.tension = g.surface_tension = 100.0;
    if (shape == OBJECT_ROD) g.thickness = NAN;
    if (shape == OBJECT_ROD || shape == OBJECT_STRING) g.diameter = 1e-3;
    return g;
}

/* rad/s, undamped */
static inline double objects_w(const struct object *o, int i)
{
    double w = 2.0 * PI * o->frequency[i];
    return sqrt(w * w + o->decay[i] * o->decay[i]);
}

/* Sum of phi(x) phi(l)/(m w^2): displacement at l per newton at x, of all modes the object has. */
static inline double objects_compliance(const struct object *o, const double x[2], const double l[2])
{
    double *p = (double *)malloc(2 * sizeof *p * (size_t)o->n), *q = p + o->n, sum = 0.0;
    o->shapes(o, x[0], x[1], p);
    o->shapes(o, l[0], l[1], q);
    for (int i = o->n - 1; i >= 0; i--)
        sum += p[i] * q[i] / (o->mass[i] * objects_w(o, i) * objects_w(o, i));
    free(p);
    return sum;
}

/* Largest |integral of density phi_i phi_k - mass_i delta_ik| / mass over the box, by points x points Gauss nodes;
 * round: polar. */
static inline double objects_mass_error(const struct object *o, double density, int points, bool round)
{
    int n = o->n;
    double *node = (double *)malloc(2 * sizeof *node * (size_t)points), *weight = node + points;
    double *m = (double *)calloc((size_t)n * n + n, sizeof *m), *phi = m + (size_t)n * n, worst = 0.0;
    special_gauss_legendre(points, node, weight);
    double dx = o->high[0] - o->low[0], dy = o->high[1] - o->low[1];
    for (int i = 0; i < points; i++)
        for (int k = 0; k < points; k++) {
            double u = 0.5 * (1.0 + node[i]), x = o->low[0] + dx * u, y = o->low[1] + dy * 0.5 * (1.0 + node[k]);
            double w = density * 0.25 * weight[i] * weight[k] * dx * dy, turn = 2.0 * PI * k / points,
                   r = u * o->high[0];
            if (round) {
                x = r * cos(turn);
                y = r * sin(turn);
                w = density * 0.5 * weight[i] * o->high[0] * r * 2.0 * PI / points;
            }
            ck_assert(o->shapes(o, x, y, phi) < 1e-12);
            for (int p = 0; p < n; p++)
                for (int q = 0; q < n; q++)
                    m[p * n + q] += w * phi[p] * phi[q];
        }
    for (int p = 0; p < n; p++)
        for (int q = 0; q < n; q++)
            worst = fmax(worst, fabs(m[p * n + q] - (p == q) * o->mass[p]) / sqrt(o->mass[p] * o->mass[q]));
    free(node);
    free(m);
    return worst;
}

#define OBJECTS_NEAR(got, want, tolerance)                                                                             \
    do {                                                                                                               \
        double got_ = (got), want_ = (want);                                                                           \
        ck_assert_msg(fabs(got_ - want_) <= (tolerance)*fabs(want_), "%s = %.12g, not %.12g (%.2g)", #got, got_,       \
                      want_, got_ / want_ - 1);                                                                        \
    } while (0)

#endif
