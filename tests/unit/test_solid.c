/* Free vibration against closed forms and other methods: bar, plates, ball, cantilever; held faces; what is refused. */
#include "fem/solid.h"

#include "solids.h"

/* Free steel bar 0.3 m x 0.02 x 0.01. Euler and Bernoulli's lowest is 576.5 Hz; shear and rotary inertia lower it, by
   Timoshenko's theory to 574.3. One quadratic element across is 0.2 % stiff for it, 1 % for the second mode of the same
   plane. Six rigid motions, and mass 0.471 kg. */
START_TEST(test_bar)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_ask ask = {.material = &steel, .most = 8, .top = 20000.0};
    struct solids s = solids_box((const int[]){15, 1, 1}, (const double[]){0.3, 0.02, 0.01}, a);
    struct solid_modes m = solids_modes(&s, &ask, a);
    ck_assert_int_eq(m.rigid, 6);
    ck_assert_int_eq(m.n, 8);
    ck_assert(!m.all && m.residual < 1e-7 && m.freedoms == 837);
    SOLIDS_NEAR(m.mass, 0.471, 1e-12);
    SOLIDS_NEAR(solids_hz(&m, 0), 574.3, 3e-3);
    SOLIDS_NEAR(solids_hz(&m, 2), 576.5 * 2.75653, 1.5e-2); /* (7.8532/4.7300)^2 */
    ask.top = 4000.0;
    m = solids_modes(&s, &ask, a);
    ck_assert(m.n == 5 && m.all && solids_hz(&m, 4) < 4000.0);
    arena_close(a);
}
END_TEST

/* Free square steel plate, a/h = 50: w a^2 sqrt(rho h/D) of thin plates (converged Legendre sums); these elements
 * within 1 %, the fourth and fifth equal. */
START_TEST(test_plate)
{
    const double want[10] = {13.4682, 19.5961, 24.2702, 34.8009, 34.8009, 61.0932, 61.0932, 63.6861, 69.2654, 77.1717};
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_ask ask = {.material = &steel, .most = 10, .top = 20000.0};
    struct solids s = solids_box((const int[]){16, 16, 1}, (const double[]){1.0, 1.0, 0.02}, a);
    struct solid_modes m = solids_modes(&s, &ask, a);
    double unit = sqrt(200e9 * 0.02 * 0.02 / (12.0 * 0.91 * 7850.0)) / (2.0 * SOLIDS_PI);
    ck_assert_int_eq(m.rigid, 6);
    for (int i = 0; i < 10; i++)
        SOLIDS_NEAR(solids_hz(&m, i), want[i] * unit, 1e-2);
    SOLIDS_NEAR(m.lambda[4], m.lambda[3], 1e-12);
    arena_close(a);
}
END_TEST

/* Free ball, w R/c_s of Lamb's two classes, with multiplicities 2 l + 1 (nu = 0.3): torsional l = 2, spheroidal 2, 1,
 * torsional 3, spheroidal 3. */
START_TEST(test_ball)
{
    const struct {
        double value;
        int times;
    } want[] = {{2.50113, 5}, {2.646217, 5}, {3.529987, 3}, {3.86470, 7}, {3.937401, 7}};
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_ask ask = {.material = &steel, .most = 27, .top = 1e6};
    struct solids s = solids_ball(6, 0.05, a);
    struct solid_modes m = solids_modes(&s, &ask, a);
    double unit = sqrt(200e9 / 2.6 / 7850.0) / 0.05 / (2.0 * SOLIDS_PI);
    ck_assert_int_eq(m.rigid, 6);
    SOLIDS_NEAR(m.mass, 7850.0 * 4.0 / 3.0 * SOLIDS_PI * 0.05 * 0.05 * 0.05, 1e-3);
    for (int i = 0, k = 0; i < 5; i++)
        for (int end = k + want[i].times; k < end; k++)
            SOLIDS_NEAR(solids_hz(&m, k), want[i].value * unit, 5e-3);
    arena_close(a);
}
END_TEST

/* Clamped at one end: bending in both planes, (1.875104/l)^2 sqrt(E I/rho A), and stretching, sqrt(E/rho)/(4 l).
   Elements twice as long as the bar is thick are 1 % stiff (half of it is the clamp, which keeps the end from growing
   narrower). */
START_TEST(test_cantilever)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = solids_box((const int[]){20, 2, 1}, (const double[]){0.3, 0.02, 0.01}, a);
    struct solid_fixed end = solids_hold(&s, SOLID_CLAMPED, 0, 0.0, a);
    struct solid_ask ask = {.material = &steel, .fixed = &end, .n_fixed = 1, .most = 12, .top = 20000.0};
    struct solid_modes m = solids_modes(&s, &ask, a);
    double c = sqrt(200e9 / 7850.0), k = 1.8751041 / 0.3, found = 0.0;
    ck_assert_int_eq(m.rigid, 0);
    ck_assert_int_eq(end.n, 4);
    SOLIDS_NEAR(solids_hz(&m, 0), k * k * c * 0.01 / sqrt(12.0) / (2.0 * SOLIDS_PI), 1e-2);
    SOLIDS_NEAR(solids_hz(&m, 1), k * k * c * 0.02 / sqrt(12.0) / (2.0 * SOLIDS_PI), 1e-2);
    for (int i = 0; i < m.n; i++)
        if (fabs(solids_hz(&m, i) * 4.0 * 0.3 / c - 1.0) < 5e-3) found += 1.0;
    ck_assert(found > 0.0);
    for (int i = 0; i < s.mesh.nodes; i++)
        for (int k2 = 0; k2 < 3 && s.mesh.at[i][0] < 1e-9; k2++)
            ck_assert(m.shape[3 * i + k2] == 0.0);
    arena_close(a);
}
END_TEST

static struct solids supported(int n, struct solid_fixed fixed[4], struct arena *a)
{
    struct solids s = solids_box((const int[]){n, n, 1}, (const double[]){0.5, 0.4, 0.02}, a);
    for (int i = 0; i < 4; i++)
        fixed[i] = solids_hold(&s, SOLID_SUPPORTED, i / 2, i % 2 ? i / 2 ? 0.4 : 0.5 : 0.0, a);
    return s;
}

/* Hard simple supports: u along the sides' faces is 0, which is Navier's solution of Mindlin's plate:
   w0^2 = (D/rho h) q^4 / (1 + q^2 (h^2/12 + D/(kappa G h))) to first order, q^2 = (m pi/a)^2 + (n pi/b)^2, kappa = 5/6.
   In-plane modes of such a plate: shear with (m, 0): w = (m pi/a) c_s, from 3100 Hz up, above those tested. With 14
   elements along a side 0.5 to 1.9 % stiff, with 28 a third of that. */
START_TEST(test_supported)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_fixed fixed[4];
    struct solids s = supported(14, fixed, a);
    struct solid_ask ask = {.material = &steel, .fixed = fixed, .n_fixed = 4, .most = 6, .top = 20000.0};
    struct solid_modes m = solids_modes(&s, &ask, a);
    const int order[5][2] = {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 1}};
    double h = 0.02, d = 200e9 * h * h * h / (12.0 * 0.91), g = 200e9 / 2.6;
    ck_assert_int_eq(m.rigid, 0);
    for (int i = 0; i < 5; i++) {
        double x = order[i][0] * SOLIDS_PI / 0.5, y = order[i][1] * SOLIDS_PI / 0.4, q2 = x * x + y * y;
        double w2 = d / (7850.0 * h) * q2 * q2 / (1.0 + q2 * (h * h / 12.0 + d / (5.0 / 6.0 * g * h)));
        SOLIDS_NEAR(solids_hz(&m, i), sqrt(w2) / (2.0 * SOLIDS_PI), i < 3 ? 1e-2 : 2e-2);
    }
    arena_close(a);
}
END_TEST

/* Turned in space, faces get frames of their own; frequencies stay, shapes turn along. */
START_TEST(test_turned)
{
    const double r[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_fixed fixed[4];
    struct solids s = supported(6, fixed, a);
    struct solid_ask ask = {.material = &steel, .fixed = fixed, .n_fixed = 4, .most = 6, .top = 20000.0};
    struct solid_modes m = solids_modes(&s, &ask, a), t;
    for (int i = 0; i < s.mesh.nodes; i++) {
        double p[3];
        memcpy(p, s.mesh.at[i], sizeof p);
        for (int k = 0; k < 3; k++)
            s.mesh.at[i][k] = r[k][0] * p[0] + r[k][1] * p[1] + r[k][2] * p[2];
    }
    solids_measure(&s);
    t = solids_modes(&s, &ask, a);
    ck_assert(t.rigid == 0 && t.freedoms == m.freedoms);
    for (int i = 0; i < 6; i++) {
        const double *u = m.shape + (size_t)i * 3 * m.nodes, *v = t.shape + (size_t)i * 3 * m.nodes;
        double same = 0.0, other = 0.0, most = 0.0;
        SOLIDS_NEAR(t.lambda[i], m.lambda[i], 1e-9);
        for (long k = 0; k < 3 * m.nodes; k++) {
            double want = r[k % 3][0] * u[k / 3 * 3] + r[k % 3][1] * u[k / 3 * 3 + 1] + r[k % 3][2] * u[k / 3 * 3 + 2];
            same = fmax(same, fabs(v[k] - want)), other = fmax(other, fabs(v[k] + want)), most = fmax(most, fabs(want));
        }
        ck_assert_msg(fmin(same, other) < 1e-6 * most, "mode %d differs by %g of %g", i, fmin(same, other), most);
    }
    arena_close(a);
}
END_TEST

/* Rigid motions that supports leave: a face in the plane z = 0 leaves moving along z and tilting about x and y; that
   and a side x = 0, turning about their common edge; two opposite sides, moving along x. */
START_TEST(test_rigid)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = solids_box((const int[]){3, 2, 2}, (const double[]){0.3, 0.2, 0.25}, a);
    struct solid_fixed fixed[3] = {solids_hold(&s, SOLID_SUPPORTED, 2, 0.0, a),
                                   solids_hold(&s, SOLID_SUPPORTED, 0, 0.0, a),
                                   solids_hold(&s, SOLID_SUPPORTED, 0, 0.3, a)};
    struct solid_ask ask = {.material = &steel, .fixed = fixed, .n_fixed = 1, .most = 5, .top = 1e6};
    ck_assert_int_eq(solids_modes(&s, &ask, a).rigid, 3);
    ask.n_fixed = 2; /* 7 x 5 x 5 nodes; the edge's 5 lose all, the others of the faces two */
    struct solid_modes m = solids_modes(&s, &ask, a);
    ck_assert(m.rigid == 1 && m.freedoms == 525 - 2 * 30 - 2 * 20 - 3 * 5);
    ask.fixed = fixed + 1;
    ck_assert_int_eq(solids_modes(&s, &ask, a).rigid, 1);
    ask.n_fixed = 0;
    ck_assert_int_eq(solids_modes(&s, &ask, a).rigid, 6);
    arena_close(a);
}
END_TEST

/* n tetrahedra that do not touch. */
static struct solids corners(int n, struct arena *a)
{
    static const double at[10][3] = {{0, 0, 0},   {1, 0, 0},  {0, 1, 0},  {0, 0, 1},   {.5, 0, 0},
                                     {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {.5, 0, .5}, {0, .5, .5}};
    struct solids s = {.mesh = {.name = "corners", .nodes = 10 * n, .elements = n}};
    s.mesh.element = arena_take(a, (size_t)n, sizeof *s.mesh.element);
    s.mesh.at = arena_take(a, 10 * (size_t)n, sizeof *s.mesh.at);
    for (int i = 0; i < 10 * n; i++) {
        s.mesh.element[i / 10][i % 10] = i;
        for (int k = 0; k < 3; k++)
            s.mesh.at[i][k] = at[i % 10][k] + 3.0 * (i / 10);
    }
    solids_boundary(&s, a);
    solids_measure(&s);
    return s;
}

/* A ball whose surface can only breathe: its faces meet smoothly, each node keeps its normal, and shapes there are
 * along it. */
START_TEST(test_smooth)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = solids_ball(4, 0.05, a);
    struct solid_fixed all = {SOLID_SUPPORTED, s.boundary.n, arena_take(a, (size_t)s.boundary.n, sizeof *all.corner)};
    for (int i = 0; i < s.boundary.n; i++)
        memcpy(all.corner[i], s.boundary.face[i], sizeof *all.corner);
    struct solid_ask ask = {.material = &steel, .fixed = &all, .n_fixed = 1, .most = 8, .top = 1e6};
    struct solid_modes m = solids_modes(&s, &ask, a);
    int outside = 0;
    ck_assert_int_eq(m.rigid, 0);
    for (int i = 0; i < s.mesh.nodes; i++) {
        const double *p = s.mesh.at[i], *u = m.shape + 3 * i;
        if (sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) < 0.05 * (1.0 - 1e-9)) continue;
        outside++;
        for (int k = 0; k < 3; k++) /* faces of 8 x 8 to a side are no sphere: their normals are off by some degrees */
            ck_assert(fabs(u[(k + 1) % 3] * p[(k + 2) % 3] - u[(k + 2) % 3] * p[(k + 1) % 3]) <=
                      0.1 * 0.05 * sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]));
    }
    ck_assert_int_eq(outside, 9 * 9 * 9 - 7 * 7 * 7);
    ck_assert_int_eq(m.freedoms, 3 * s.mesh.nodes - 2 * outside);
    arena_close(a);
}
END_TEST

static void refuse(const struct solids *s, const struct solid_ask *ask, enum err_kind kind, const char *says)
{
    struct arena *a = arena_open();
    struct solid_modes m;
    struct err e = {0};
    ck_assert(!solid_modes(&s->mesh, &s->boundary, ask, a, &m, &e));
    ck_assert_msg(e.kind == kind && strstr(e.text, says), "%s", e.text);
    arena_close(a);
}

START_TEST(test_refused)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = solids_box((const int[]){1, 1, 1}, (const double[]){0.1, 0.1, 0.1}, a);
    struct solid_fixed inside = {SOLID_CLAMPED, 1,
                                 (int[1][3]){{s.mesh.element[0][0], s.mesh.element[0][2], s.mesh.element[0][3]}}};
    struct solid_ask ask = {.material = &steel, .most = 5, .top = 100.0};
    refuse(&s, &ask, ERR_SCENE, "no mode below 100 Hz");
    ask.fixed = &inside, ask.n_fixed = 1;
    refuse(&s, &ask, ERR_SCENE, "not on the surface");
    ask.n_fixed = 0, ask.top = 1e6;
    int swap = s.mesh.element[3][0];
    s.mesh.element[3][0] = s.mesh.element[3][1], s.mesh.element[3][1] = swap;
    refuse(&s, &ask, ERR_SCENE, "element 4");
    s = corners(2, a);
    refuse(&s, &ask, ERR_NUMBERS, "6 motions of the solid as a whole should cost no energy");
    s = corners(1, a);
    struct solid_fixed sides[3];
    for (int i = 0; i < 3; i++)
        sides[i] = solids_hold(&s, SOLID_CLAMPED, i, 0.0, a);
    ask.fixed = sides, ask.n_fixed = 3;
    refuse(&s, &ask, ERR_SCENE, "every node of the solid is held");
    arena_close(a);
}
END_TEST

/* A single element has 24 modes that are not rigid, whatever more is asked for; every one of a cube held but for its
 * middle node, 3. */
START_TEST(test_few)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = corners(1, a);
    SOLIDS_NEAR(s.boundary.volume, 1.0 / 6.0, 1e-12);
    struct solid_ask ask = {.material = &steel, .most = 100, .top = 1e9};
    struct solid_modes m = solids_modes(&s, &ask, a);
    ck_assert(m.n == 24 && m.rigid == 6 && m.all);
    s = solids_box((const int[]){1, 1, 1}, (const double[]){0.1, 0.1, 0.1}, a);
    struct solid_fixed all[6];
    for (int i = 0; i < 6; i++)
        all[i] = solids_hold(&s, SOLID_CLAMPED, i / 2, i % 2 ? 0.1 : 0.0, a);
    ask.fixed = all, ask.n_fixed = 6;
    m = solids_modes(&s, &ask, a);
    ck_assert(m.n == 3 && m.rigid == 0 && m.all && m.freedoms == 3);
    arena_close(a);
}
END_TEST

/* The first mode of a bar of three cells: 574.3 Hz, what Timoshenko's theory and fine meshes of order 2 agree on
 * (test_bar). Every order is far better than the one below. */
START_TEST(test_orders)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = solids_box((const int[]){3, 1, 1}, (const double[]){0.3, 0.02, 0.01}, a);
    double off[5];
    for (int order = 2; order <= 4; order++) {
        struct solid_ask ask = {.material = &steel, .order = order, .most = 6, .top = 20000.0};
        struct solid_modes m = solids_modes(&s, &ask, a);
        ck_assert_int_eq(m.rigid, 6);
        off[order] = solids_hz(&m, 0) / 574.3 - 1.0;
    }
    ck_assert_msg(off[2] > 0.03 && off[3] < 0.1 * off[2] && off[4] < 0.3 * off[3] + 2e-4 && off[4] > -2e-4, "%g %g %g",
                  off[2], off[3], off[4]);
    arena_close(a);
}
END_TEST

/* A plate on four edges of order 3: held nodes are those of the net; pi^2 (D/(rho h))^(1/2) (m^2 + n^2)/a^2 less the
 * shear of h/a = 1/50, which is 1 % in the fourth. */
START_TEST(test_order_held)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = solids_box((const int[]){5, 5, 1}, (const double[]){0.5, 0.5, 0.01}, a);
    struct solid_fixed fixed[4];
    for (int i = 0; i < 4; i++)
        fixed[i] = solids_hold(&s, SOLID_SUPPORTED, i / 2, i % 2 ? 0.5 : 0.0, a);
    struct solid_ask ask = {.material = &steel, .fixed = fixed, .n_fixed = 4, .order = 3, .most = 3, .top = 20000.0};
    struct solid_modes m = solids_modes(&s, &ask, a);
    double unit = SOLIDS_PI / 2.0 * sqrt(200e9 * 1e-4 / (12.0 * 0.91 * 7850.0)) / 0.25;
    const double want[3] = {2, 5, 5};
    ck_assert_int_eq(m.rigid, 0);
    for (int i = 0; i < 3; i++)
        SOLIDS_NEAR(solids_hz(&m, i), want[i] * unit, 0.006);
    arena_close(a);
}
END_TEST

UNIT("solid", test_orders, test_order_held, test_bar, test_plate, test_ball, test_cantilever, test_supported,
     test_turned, test_rigid, test_smooth, test_refused, test_few)
