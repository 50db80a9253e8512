/* Rectangular plates and membranes: published frequencies, orthonormal shapes, the sums against closed forms where both
 * exist, static deflections. */
#include "objects.h"
#include "response/object_kinds.h"

static void expect(struct arena *a, int edges, double nu, const double *want, double tolerance)
{
    struct object o = objects_of(OBJECT_PLATE, edges, nu, 20, a);
    for (int i = 0; want[i] > 0.0; i++)
        OBJECTS_NEAR(objects_w(&o, i), want[i], tolerance);
}

/* Square plates, w a^2 sqrt(rho h/D): free, converged Legendre sums (6 digits) of other code; clamped, Leissa 1973 (5
   digits, themselves upper bounds that later work confirmed) */
START_TEST(test_published)
{
    struct arena *a = arena_open();
    expect(
        a, EDGES_FREE, 0.3,
        (const double[]){13.4682, 19.5961, 24.2702, 34.8009, 34.8009, 61.0932, 61.0932, 63.6861, 69.2654, 77.1717, 0},
        5e-6);
    expect(a, EDGES_FREE, 0.33, (const double[]){13.1962, 19.2584, 24.4095, 34.2856, 34.2856, 0}, 5e-6);
    expect(a, EDGES_FREE, 0.2, (const double[]){14.3225, 20.6346, 23.7343, 36.3357, 36.3357, 0}, 5e-6);
    expect(a, EDGES_CLAMPED, 0.3, (const double[]){35.985, 73.394, 73.394, 108.22, 131.58, 132.20, 165.00, 165.00, 0},
           5e-5);
    expect(a, EDGES_CANTILEVER, 0.3, (const double[]){3.4710, 8.5066, 21.284, 27.199, 30.956, 0}, 5e-5);
    expect(a, EDGES_SUPPORTED, 0.3,
           (const double[]){2 * PI * PI, 5 * PI * PI, 5 * PI * PI, 8 * PI * PI, 10 * PI * PI, 10 * PI * PI, 0}, 1e-9);
    arena_close(a);
}
END_TEST

/* NAFEMS FV12: 10 m x 10 m x 0.05 m, E 200 GPa, nu 0.3, 8000 kg/m^3, free: its targets for the first three, the
 * converged ones above. */
START_TEST(test_nafems)
{
    struct arena *a = arena_open();
    const double want[] = {1.622, 2.360, 2.922, 4.190, 4.190, 7.356, 7.356};
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_FREE, 0.3);
    g.length = g.width = 10.0, g.thickness = 0.05, g.youngs_modulus = 200e9, g.density = 8000.0;
    struct object o = objects_make(&g, 7, 1e9, a);
    for (int i = 0; i < 7; i++)
        ck_assert_double_lt(fabs(o.frequency[i] - want[i]), 1e-3);
    arena_close(a);
}
END_TEST

/* The first 40 of 200 modes come from more functions than 40 of 40. */
START_TEST(test_converged)
{
    struct arena *a = arena_open();
    for (int edges = EDGES_FREE; edges <= EDGES_CANTILEVER; edges++) {
        struct object_given g = objects_given(OBJECT_PLATE, edges, 0.3);
        g.width = 0.4;
        g.youngs_modulus_across = 0.2 * g.youngs_modulus;
        struct object few = objects_make(&g, 40, 1e9, a),
                      many = objects_make(&g, edges == EDGES_CANTILEVER ? 100 : 200, 1e9, a);
        for (int i = 0; i < 40; i++)
            OBJECTS_NEAR(few.frequency[i], many.frequency[i], edges == EDGES_CANTILEVER ? 5e-6 : 1e-6);
    }
    arena_close(a);
}
END_TEST

/* Rayleigh and Ritz with supported edges, isotropic and like spruce, against the closed form. */
START_TEST(test_ritz_supported)
{
    struct arena *a = arena_open();
    for (int wood = 0; wood < 2; wood++) {
        struct object_given g = objects_given(OBJECT_PLATE, EDGES_SUPPORTED, 0.37);
        g.width = 0.35;
        double across = wood ? 0.06 * g.youngs_modulus : g.youngs_modulus,
               shear = wood ? 0.065 * g.youngs_modulus : g.youngs_modulus / 2.74;
        g.youngs_modulus_across = across, g.shear_modulus = shear;
        struct object closed = objects_make(&g, 100, 1e9, a);
        struct object_body b = {.given = &g,
                                .key = "x",
                                .youngs_modulus = g.youngs_modulus,
                                .across = across,
                                .shear = shear,
                                .poisson = 0.37,
                                .density = 1000.0};
        struct object_limit limit = {.w = 1e12, .most = 100};
        struct object_list l = {0};
        struct err e = {0};
        ck_assert(object_plate_ritz(&b, &limit, a, &l, &e));
        ck_assert_int_eq(l.n, 100);
        for (int i = 0; i < 100; i++)
            OBJECTS_NEAR(l.mode[i].w, objects_w(&closed, i), 1e-7);
    }
    arena_close(a);
}
END_TEST

/* Stretched by (Dx/D)^(1/4) along x and likewise along y, with D1 = nu sqrt(Dx Dy), Dk = (1 - nu)/2 sqrt(Dx Dy), an
   orthotropic plate has the energies of an isotropic one: free, 1 m x 0.5 m, Ey = Ex/16 is the square. */
START_TEST(test_orthotropic)
{
    struct arena *a = arena_open();
    const double want[] = {13.4682, 19.5961, 24.2702, 34.8009, 34.8009, 61.0932, 61.0932, 63.6861, 69.2654, 77.1717};
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_FREE, 0.3);
    g.width = 0.5;
    g.youngs_modulus_across = g.youngs_modulus / 16.0;
    g.poisson = 1.2;
    g.shear_modulus = 0.7 / 2.0 * 0.25 * 12e9;
    struct object o = objects_make(&g, 10, 1e9, a);
    for (int i = 0; i < 10; i++)
        OBJECTS_NEAR(objects_w(&o, i), want[i], 5e-6);
    arena_close(a);
}
END_TEST

START_TEST(test_orthonormal)
{
    struct arena *a = arena_open();
    for (int edges = EDGES_FREE; edges <= EDGES_CANTILEVER; edges++) {
        struct object_given g = objects_given(OBJECT_PLATE, edges, 0.3);
        g.width = 0.6;
        struct object o = objects_make(&g, 60, 1e9, a);
        ck_assert_int_eq(o.n, 60);
        ck_assert_double_lt(objects_mass_error(&o, 1.0, 48, false), 1e-10);
    }
    arena_close(a);
}
END_TEST

/* Centre load: supported square 0.01160 P a^2/D, clamped 0.00560 (Timoshenko and Woinowsky-Krieger, articles 34 and
   44), with one digit more 0.005612. n modes leave out about a^2/(16 pi^2 n D). */
START_TEST(test_static_centre)
{
    struct arena *a = arena_open();
    const double centre[2] = {0.5, 0.5};
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_SUPPORTED, 0.3);
    struct object o = objects_make(&g, 5000, 1e9, a);
    ck_assert_double_lt(fabs(objects_compliance(&o, centre, centre) + 1.0 / (16.0 * PI * PI * 5000) - 0.01160), 5e-6);
    g.edges = EDGES_CLAMPED;
    o = objects_make(&g, 300, 1e9, a);
    ck_assert_double_lt(fabs(objects_compliance(&o, centre, centre) + 1.0 / (16.0 * PI * PI * 300) - 0.005612), 3e-6);
    arena_close(a);
}
END_TEST

/* Forces P, -P, P, -P at the corners of a free plate twist it, w = P x y/(2 D (1 - nu)), so that their places give a
 * b/(2 D (1 - nu)) per P. */
START_TEST(test_static_twist)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_FREE, 0.3);
    g.width = 0.5;
    struct object o = objects_make(&g, 300, 1e9, a);
    const double corner[4][2] = {{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}};
    double sum = 0.0;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            sum += ((i + k) % 2 ? -1.0 : 1.0) * objects_compliance(&o, corner[i], corner[k]);
    OBJECTS_NEAR(sum, 0.5 / (2.0 * 0.7), 1e-2); /* corners converge slowly */
    arena_close(a);
}
END_TEST

/* Middle lines are nodal lines of odd modes; the sign changes across them. */
START_TEST(test_nodal_lines)
{
    struct arena *a = arena_open();
    for (int edges = EDGES_FREE; edges <= EDGES_CLAMPED; edges++) {
        struct object_given g = objects_given(OBJECT_PLATE, edges, 0.3);
        g.width = 0.6;
        struct object o = objects_make(&g, 30, 1e9, a);
        double on[30], left[30], right[30];
        int silent = 0;
        o.shapes(&o, 0.5, 0.17, on);
        o.shapes(&o, 0.5 - 0.07, 0.17, left);
        o.shapes(&o, 0.5 + 0.07, 0.17, right);
        for (int i = 0; i < 30; i++) {
            bool odd = fabs(left[i] + right[i]) < 1e-12;
            ck_assert(odd || fabs(left[i] - right[i]) < 1e-12);
            if (odd) ck_assert_double_lt(fabs(on[i]), 1e-13);
            silent += odd && fabs(left[i]) > 0.01;
        }
        ck_assert_int_ge(silent, 10);
    }
    arena_close(a);
}
END_TEST

/* f_mn = sqrt(S/(rho h)) sqrt((m/a)^2 + (n/b)^2)/2; the lowest 300, sorted by brute force. */
START_TEST(test_membrane)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_MEMBRANE, EDGES_FREE, 0.3);
    g.width = 0.7, g.surface_tension = 400.0;
    struct object o = objects_make(&g, 300, 1e9, a);
    double last = 0.0;
    for (int i = 0; i < 300; i++) { /* the next above the last: no two are alike for 1 : 0.7 but (m, n) = (10 k.., ..),
                                       which 1e-9 keeps apart */
        int same = 0;
        double next = INFINITY;
        for (int m = 1; m < 60; m++)
            for (int n = 1; n < 60; n++) {
                double f = 10.0 * sqrt(m * m + n * n / 0.49);
                same += fabs(f - last) < 1e-9 * f;
                if (f > last * (1.0 + 1e-9)) next = fmin(next, f);
            }
        if (i > 0 && same > 1 && fabs(o.frequency[i] - last) < 1e-9 * last) continue;
        OBJECTS_NEAR(o.frequency[i], next, 1e-9);
        last = next;
    }
    struct object few = objects_make(&g, 40, 1e9, a);
    ck_assert_double_lt(objects_mass_error(&few, 1.0, 48, false), 1e-10);
    arena_close(a);
}
END_TEST

/* Very long and narrow: sums become those of a bar with plate stiffness, first bending 4.73^2 within the 1/50's effect.
 */
START_TEST(test_narrow)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_FREE, 0.3);
    g.width = 0.02;
    struct object o = objects_make(&g, 20, 1e9, a);
    double z = 4.730040745;
    OBJECTS_NEAR(objects_w(&o, 0), z * z * sqrt(1.0 - 0.09), 1e-3); /* E h^3/12: its sides are free */
    arena_close(a);
}
END_TEST

UNIT("object_plate", test_published, test_nafems, test_converged, test_ritz_supported, test_orthotropic,
     test_orthonormal, test_static_centre, test_static_twist, test_nodal_lines, test_membrane, test_narrow)
