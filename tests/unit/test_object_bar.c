/* Bars, rods, strings: frequencies against published constants, shapes by quadrature, gains against static deflections.
 */
#include "objects.h"
#include "response/object_kinds.h"

/* Blevins, table 8-1: free and clamped, cantilever. */
START_TEST(test_roots)
{
    const double free_free[] = {4.730040745, 7.853204624, 10.995607838, 14.137165491, 17.278759657};
    const double cantilever[] = {1.875104069, 4.694091133, 7.854757438, 10.995540735};
    for (int i = 0; i < 5; i++)
        ck_assert_double_lt(fabs(object_kinds_beam_root(EDGES_FREE, i + 1) - free_free[i]), 1e-9);
    for (int i = 0; i < 4; i++)
        ck_assert_double_lt(fabs(object_kinds_beam_root(EDGES_CANTILEVER, i + 1) - cantilever[i]), 1e-9);
    for (int i = 1; i < 10;
         i++) { /* in a form of their own: cosh as libm has it; z to 1e-14, times the slope of cos cosh */
        double z = object_kinds_beam_root(EDGES_CLAMPED, i), y = object_kinds_beam_root(EDGES_CANTILEVER, i);
        ck_assert_double_lt(fabs(cos(z) - 1.0 / cosh(z)), 1e-14 * z);
        ck_assert_double_lt(fabs(cos(y) + 1.0 / cosh(y)), 1e-14 * y);
    }
    OBJECTS_NEAR(object_kinds_beam_root(EDGES_FREE, 1000), 1000.5 * PI, 1e-15);
}
END_TEST

/* Euler and Bernoulli: steel bar 0.3 x 0.02 x 0.01 m, E 200 GPa, 7850 kg/m^3: 576.5 Hz. */
START_TEST(test_steel_bar)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_FREE, 0.3);
    g.length = 0.3, g.width = 0.02, g.thickness = 0.01, g.youngs_modulus = 200e9, g.density = 7850.0;
    struct object o = objects_make(&g, 5, 1e9, a);
    OBJECTS_NEAR(o.frequency[0], 576.5, 1e-4);
    OBJECTS_NEAR(o.frequency[1] / o.frequency[0], 7.853204624 * 7.853204624 / (4.730040745 * 4.730040745), 1e-9);
    OBJECTS_NEAR(o.mass[0], 7850.0 * 0.3 * 0.02 * 0.01, 1e-14);
    OBJECTS_NEAR(o.radius, sqrt(2.0 * (0.3 * 0.02 + 0.3 * 0.01 + 0.02 * 0.01) / (4.0 * PI)), 1e-14);
    arena_close(a);
}
END_TEST

/* Tube: I = pi (D^4 - d^4)/64, A = pi (D^2 - d^2)/4; a wall of D/2 is a solid rod. */
START_TEST(test_rod_and_tube)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_ROD, EDGES_SUPPORTED, 0.3);
    g.diameter = 0.02, g.thickness = 0.002;
    double speed = sqrt(g.youngs_modulus / g.density), k = PI / g.length;
    struct object tube = objects_make(&g, 3, 1e9, a);
    OBJECTS_NEAR(objects_w(&tube, 0), k * k * speed * sqrt(0.02 * 0.02 + 0.016 * 0.016) / 4.0, 1e-9);
    OBJECTS_NEAR(tube.mass[0], 0.5 * 1000.0 * PI / 4.0 * (4e-4 - 2.56e-4), 1e-12);
    g.thickness = 0.01;
    struct object wall = objects_make(&g, 3, 1e9, a);
    g.thickness = NAN;
    struct object solid = objects_make(&g, 3, 1e9, a);
    OBJECTS_NEAR(objects_w(&solid, 2), 9.0 * k * k * speed * 0.02 / 4.0, 1e-9);
    ck_assert(wall.frequency[2] == solid.frequency[2] && wall.mass[1] == solid.mass[1]);
    arena_close(a);
}
END_TEST

/* 60 modes: the integral of rho A phi_i phi_k is the mass or 0, to 1e-10; Gauss nodes beyond pi per wave. */
START_TEST(test_orthonormal)
{
    struct arena *a = arena_open();
    for (int waves = WAVES_BENDING; waves <= WAVES_LONGITUDINAL; waves++)
        for (int edges = EDGES_FREE; edges <= EDGES_CANTILEVER; edges++) {
            struct object_given g = objects_given(OBJECT_BAR, edges, 0.3);
            g.waves = waves, g.width = 0.05;
            struct object o = objects_make(&g, 60, 1e9, a);
            ck_assert_int_eq(o.n, 60);
            ck_assert_double_lt(objects_mass_error(&o, g.density * g.thickness, 160, false), 1e-10);
        }
    arena_close(a);
}
END_TEST

/* The first and third mode by cosh and sinh, which still serve there; the ends of high modes: +-2 free, 0 held. */
START_TEST(test_shapes)
{
    struct arena *a = arena_open();
    for (int edges = EDGES_FREE; edges <= EDGES_CANTILEVER; edges++) {
        if (edges == EDGES_SUPPORTED) continue;
        struct object o = objects_of(OBJECT_BAR, edges, 0.3, 2000, a);
        double *phi = ARENA_TAKE(a, double, o.n), sign = edges == EDGES_FREE ? 1.0 : -1.0;
        for (double x = 0.0; x <= 1.0; x += 0.125) {
            o.shapes(&o, x, 0.5, phi);
            for (int i = 0; i < 3; i += 2) {
                double z = object_kinds_beam_root(edges, i + 1), c = cosh(z) - cos(z), s = sinh(z) - sin(z);
                double ratio = edges == EDGES_CANTILEVER ? s / (cosh(z) + cos(z)) : c / s;
                double want = cosh(z * x) + sign * cos(z * x) - ratio * (sinh(z * x) + sign * sin(z * x));
                ck_assert_double_lt(fabs(phi[i] - want), 1e-10);
            }
        }
        o.shapes(&o, 1.0, 0.0, phi);
        for (int i = 0; i < o.n; i++)
            ck_assert_double_lt(fabs(fabs(phi[i]) - (edges == EDGES_CLAMPED ? 0.0 : 2.0)), 1e-11);
        o.shapes(&o, 0.0, 0.0, phi);
        for (int i = 0; i < o.n; i++)
            ck_assert_double_lt(fabs(fabs(phi[i]) - (edges == EDGES_FREE ? 2.0 : 0.0)), 1e-11);
    }
    arena_close(a);
}
END_TEST

/* Beam tables: centre load, between supports L^3/(48 EI), clamped L^3/(192 EI), tip of a cantilever L^3/(3 EI); a free
   bar's centre against its two ends is the first of these. 200 modes leave out 1/n^4: below 1e-6. */
START_TEST(test_static_bending)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_SUPPORTED, 0.3);
    const double middle[2] = {0.5, 0.0}, tip[2] = {1.0, 0.0}, start[2] = {0.0, 0.0};
    double stiffness = g.youngs_modulus * 1e-9 / 12.0;
    struct object o = objects_make(&g, 200, 1e9, a);
    OBJECTS_NEAR(objects_compliance(&o, middle, middle), 1.0 / (48.0 * stiffness), 1e-6);
    g.edges = EDGES_CLAMPED;
    o = objects_make(&g, 200, 1e9, a);
    OBJECTS_NEAR(objects_compliance(&o, middle, middle), 1.0 / (192.0 * stiffness), 1e-6);
    g.edges = EDGES_CANTILEVER;
    o = objects_make(&g, 200, 1e9, a);
    OBJECTS_NEAR(objects_compliance(&o, tip, tip), 1.0 / (3.0 * stiffness), 1e-6);
    OBJECTS_NEAR(objects_compliance(&o, middle, tip), 5.0 / (48.0 * stiffness), 1e-6);
    g.edges = EDGES_FREE;
    o = objects_make(&g, 200, 1e9, a);
    const double *at[3] = {middle, start, tip}, force[3] = {1.0, -0.5, -0.5};
    double sum = 0.0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            sum += force[i] * force[k] * objects_compliance(&o, at[i], at[k]);
    OBJECTS_NEAR(sum, 1.0 / (48.0 * stiffness), 1e-6);
    arena_close(a);
}
END_TEST

/* Longitudinal: c/2L and its multiples, odd c/4L when one end is held; a tip pulled gives L/(EA): 1/n^2, so 1e-4 of
 * 4000 modes. */
START_TEST(test_longitudinal)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_FREE, 0.3);
    g.waves = WAVES_LONGITUDINAL;
    double speed = sqrt(g.youngs_modulus / g.density);
    struct object o = objects_make(&g, 3, 1e9, a), held;
    for (int i = 0; i < 3; i++)
        OBJECTS_NEAR(o.frequency[i], (i + 1) * speed / 2.0, 1e-9);
    double phi[3];
    o.shapes(&o, 0.5, 0.0, phi);
    ck_assert(phi[0] == 0.0 && phi[1] == -1.0);
    g.edges = EDGES_CLAMPED;
    o = objects_make(&g, 3, 1e9, a);
    g.edges = EDGES_SUPPORTED;
    held = objects_make(&g, 3, 1e9, a);
    o.shapes(&o, 0.5, 0.0, phi);
    ck_assert(phi[0] == 1.0 && phi[1] == 0.0 && held.frequency[1] == o.frequency[1]);
    g.edges = EDGES_CANTILEVER;
    o = objects_make(&g, 4000, 1e9, a);
    OBJECTS_NEAR(o.frequency[1], 3.0 * speed / 4.0, 1e-9);
    const double tip[2] = {1.0, 0.0};
    OBJECTS_NEAR(objects_compliance(&o, tip, tip), 1.0 / (g.youngs_modulus * 1e-3), 2e-4);
    arena_close(a);
}
END_TEST

/* A piano-like string: Fletcher's formula with B worked out by hand; a soft one gives x (L - x)/(T L) to 1/n^2. */
START_TEST(test_string)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_STRING, EDGES_FREE, 0.3);
    g.length = 0.6, g.diameter = 1e-3, g.tension = 700.0, g.youngs_modulus = 200e9, g.density = 7850.0;
    struct object o = objects_make(&g, 20, 1e9, a);
    double b = PI * PI * PI * 200e9 * 1e-12 / (64.0 * 700.0 * 0.36), f0 = sqrt(700.0 / (7850.0 * PI * 0.25e-6)) / 1.2;
    for (int n = 1; n <= 20; n++)
        OBJECTS_NEAR(o.frequency[n - 1], n * f0 * sqrt(1.0 + b * n * n), 1e-9);
    ck_assert_double_lt(objects_mass_error(&o, 7850.0 * PI * 0.25e-6 / 1e-3, 60, false), 1e-10);
    g.youngs_modulus = 1e4;
    o = objects_make(&g, 3000, 1e9, a);
    const double x[2] = {0.2, 0.0}, l[2] = {0.5, 0.0};
    OBJECTS_NEAR(objects_compliance(&o, x, x), 0.2 * 0.4 / (700.0 * 0.6), 1e-3);
    OBJECTS_NEAR(objects_compliance(&o, x, l), 0.2 * 0.1 / (700.0 * 0.6), 1e-3);
    arena_close(a);
}
END_TEST

/* Off the object the nearest place counts, and how far it is is said; sines beyond their table (513 orders) are the
 * same sines. */
START_TEST(test_off_and_many)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_SUPPORTED, 0.3);
    g.width = 0.1;
    struct object few = objects_make(&g, 500, 1e9, a), many = objects_make(&g, 600, 1e9, a);
    double p[600], q[600];
    OBJECTS_NEAR(few.shapes(&few, 1.3, 0.5, p), 0.5, 1e-15);
    few.shapes(&few, 1.0, 0.1, q);
    ck_assert_mem_eq(p, q, 500 * sizeof *p);
    ck_assert(few.shapes(&few, 0.3, 0.02, p) == 0.0);
    many.shapes(&many, 0.3, 0.02, q);
    ck_assert_mem_eq(p, q, 500 * sizeof *p);
    arena_close(a);
}
END_TEST

UNIT("object_bar", test_roots, test_steel_bar, test_rod_and_tube, test_orthonormal, test_shapes, test_static_bending,
     test_longitudinal, test_string, test_off_and_many)
