/* Disks, drums and spherical shells: published frequencies, orthonormal shapes, static deflections, both members of a
 * pair. */
#include "objects.h"

/* Distinct frequencies against a rising list; every other one than n = 0 comes twice. */
static void expect(struct arena *a, int shape, int edges, double nu, const double *want, double tolerance)
{
    struct object_given g = objects_given(shape, edges, nu);
    g.surface_tension = 1.0;
    struct object o = objects_make(&g, 40, 1e9, a);
    int i = 0;
    for (int k = 0; want[k] > 0.0; k++) {
        OBJECTS_NEAR(objects_w(&o, i), want[k], tolerance);
        int twice = fabs(objects_w(&o, i + 1) / objects_w(&o, i) - 1.0) < 1e-12;
        i += 1 + twice;
    }
}

/* Clamped, and free with nu = 0.33: Leissa, NASA SP-160, tables 2.1 and 2.5, whose free 5.253 is 0.2 % low; free with
   nu = 0.3 and supported: later tables of five digits. */
START_TEST(test_disk_published)
{
    struct arena *a = arena_open();
    expect(a, OBJECT_DISK, EDGES_CLAMPED, 0.3, (const double[]){10.2158, 21.26, 34.88, 39.771, 51.04, 60.82, 0}, 2e-4);
    expect(a, OBJECT_DISK, EDGES_FREE, 0.33, (const double[]){5.253, 9.084, 12.23, 20.52, 0}, 2e-3);
    expect(a, OBJECT_DISK, EDGES_FREE, 0.3,
           (const double[]){5.3583, 9.0031, 12.439, 20.475, 21.835, 33.495, 35.260, 38.443, 0}, 4e-5);
    expect(a, OBJECT_DISK, EDGES_SUPPORTED, 0.3, (const double[]){4.9351, 13.898, 25.613, 29.720, 0}, 3e-5);
    arena_close(a);
}
END_TEST

/* Zeros of J (DLMF 10.75): j01 j11 j21 j02 j31 j12 */
START_TEST(test_drum_published)
{
    struct arena *a = arena_open();
    expect(a, OBJECT_DRUM, EDGES_FREE, 0.3,
           (const double[]){2.404825558, 3.831705970, 5.135622302, 5.520078110, 6.380161896, 7.015586670, 0}, 2e-9);
    arena_close(a);
}
END_TEST

START_TEST(test_orthonormal)
{
    struct arena *a = arena_open();
    for (int edges = EDGES_FREE; edges <= EDGES_CLAMPED; edges++) {
        struct object o = objects_of(OBJECT_DISK, edges, 0.3, 80, a);
        ck_assert_double_lt(objects_mass_error(&o, 1.0, 64, true), 1e-10);
    }
    struct object_given g = objects_given(OBJECT_DRUM, EDGES_FREE, 0.3);
    g.surface_tension = 1.0;
    struct object o = objects_make(&g, 80, 1e9, a);
    ck_assert_double_lt(objects_mass_error(&o, 1.0, 64, true), 1e-10);
    arena_close(a);
}
END_TEST

/* Centre load: clamped P a^2/(16 pi D), supported (3 + nu)/(1 + nu) times that (Timoshenko and Woinowsky-Krieger,
   article 19); n modes leave out about A/(16 pi^2 n D). Off the centre, x = r a: clamped (1 - r^2)^2 times the first.
   Modes of other orders than 0 must all be there for that. */
START_TEST(test_disk_static)
{
    struct arena *a = arena_open();
    const double centre[2] = {0.0, 0.0}, left = PI / (16.0 * PI * PI * 3000.0);
    struct object_given g = objects_given(OBJECT_DISK, EDGES_CLAMPED, 0.3);
    struct object o = objects_make(&g, 3000, 1e9, a);
    ck_assert_int_eq(o.n, 3000);
    OBJECTS_NEAR(objects_compliance(&o, centre, centre) + left, 1.0 / (16.0 * PI), 3e-4);
    for (int k = 0; k < 5; k++) {
        const double x[2] = {0.6 * cos(k), 0.6 * sin(k)};
        OBJECTS_NEAR(objects_compliance(&o, x, x) + left, 0.64 * 0.64 / (16.0 * PI), 3e-3);
    }
    g.edges = EDGES_SUPPORTED;
    o = objects_make(&g, 3000, 1e9, a);
    OBJECTS_NEAR(objects_compliance(&o, centre, centre) + left, 3.3 / 1.3 / (16.0 * PI), 3e-4);
    arena_close(a);
}
END_TEST

/* A free disk's lowest pair: silent on its nodal diameters, louder elsewhere, sign kept across; together they do not
 * know where 0 is. */
START_TEST(test_pair)
{
    struct arena *a = arena_open();
    struct object o = objects_of(OBJECT_DISK, EDGES_FREE, 0.33, 30, a);
    double p[30], q[30], r = 0.8;
    ck_assert(o.frequency[0] == o.frequency[1]);
    o.shapes(&o, r * cos(PI / 4 - 0.1), r * sin(PI / 4 - 0.1), p);
    o.shapes(&o, r * cos(PI / 4 + 0.1), r * sin(PI / 4 + 0.1), q);
    ck_assert_double_lt(fabs(p[0] + q[0]), 1e-14);
    ck_assert_double_gt(fabs(p[0]), 0.01);
    o.shapes(&o, r * sqrt(0.5), r * sqrt(0.5), q);
    ck_assert_double_lt(fabs(q[0]), 1e-15);
    OBJECTS_NEAR(p[0] * p[0] + p[1] * p[1], q[0] * q[0] + q[1] * q[1], 1e-12);
    o.shapes(&o, 0.0, 0.0, p);
    ck_assert(fabs(p[0]) < 1e-15 && fabs(p[2]) > 0.1);
    OBJECTS_NEAR(o.shapes(&o, 3.0, 4.0, p), 4.0, 1e-14);
    arena_close(a);
}
END_TEST

/* Membrane theory's quadratic (Baker 1961) as the wall gets thin; breathing 2 E/((1 - nu) rho R^2); l = 1: 3 (1 + nu).
 */
START_TEST(test_shell_frequencies)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_SHELL, EDGES_FREE, 0.3);
    g.thickness = 1e-6;
    struct object o = objects_make(&g, 6000, 1e9, a);
    double unit = sqrt(12e9 / 1000.0) / (1.0 - 0.5e-6), found[4] = {0};
    for (int l = 2; l < 4; l++) {
        double big = l * (l + 1.0), b = big + 1.0 + 3.0 * 0.3, c = 0.91 * (big - 2.0), root = sqrt(b * b - 4.0 * c);
        found[l - 2] = unit * sqrt((b - root) / 2.0);
        found[l] = unit * sqrt((b + root) / 2.0);
    }
    for (int k = 0; k < 2; k++)
        OBJECTS_NEAR(objects_w(&o, k), found[k], 1e-6);
    double rest[4] = {sqrt(2.0 * g.youngs_modulus / (0.7 * 1000.0)) / (1.0 - 0.5e-6), unit * sqrt(3.9), found[2],
                      found[3]};
    for (int k = 0; k < 4; k++) {
        double nearest = INFINITY;
        for (int i = 0; i < o.n; i++)
            nearest = fmin(nearest, fabs(objects_w(&o, i) / rest[k] - 1.0));
        ck_assert_msg(nearest < 1e-6, "%g rad/s is missing", rest[k]);
    }
    arena_close(a);
}
END_TEST

/* A thick wall, h/R = 0.4: every frequency is an eigenvalue of the energies' 2 x 2 forms (object_kinds.c), and the mass
 * has its vector's ratio. */
START_TEST(test_shell_energies)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_SHELL, EDGES_FREE, 0.3);
    g.thickness = 0.4, g.diameter = 2.4;
    struct object o = objects_make(&g, 40, 1e9, a);
    double k = 0.16 / 12.0, whole = 4.0 * PI * 1000.0 * 0.4;
    int met = 0;
    for (int i = 0; i < o.n; i++)
        for (int l = 1; l < 60; l++) {
            double big = l * (l + 1.0), turn = big * (big - 1.0 + 0.3), s = 2.6 + k * turn, c = 1.3 * big + k * turn,
                   t = turn * (1.0 + k);
            double w = objects_w(&o, i), eigen = w * w * 1000.0 / 12e9; /* rho R^2 (1 - nu^2)/E */
            double left = (s - eigen) * (t - big * eigen) - c * c, ratio = (s - eigen) / c;
            bool same = fabs(left) < 1e-9 * (s + eigen) * (t + big * eigen);
            met += same && fabs(o.mass[i] / (whole * (1.0 + big * ratio * ratio) / (2.0 * l + 1.0)) - 1.0) < 1e-6;
        }
    ck_assert_int_eq(met, 39); /* all but the breathing one */
    arena_close(a);
}
END_TEST

/* The breathing mode alone gives (1 - nu)/(8 pi E h); all together, at the place of a load P, Reissner's sqrt(3 (1 -
   nu^2)) P R/(4 E h^2) (E. Reissner, J. Math. Phys. 25, 1946, 279; Timoshenko and Woinowsky-Krieger), within terms h/R
   = 1/200 smaller times a few. */
START_TEST(test_shell_static)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_SHELL, EDGES_FREE, 0.3);
    g.thickness = 0.005, g.diameter = 2.005;
    struct object o = objects_make(&g, 1000, 1e9, a);
    const double pole[2] = {0.0, 0.0};
    OBJECTS_NEAR(objects_compliance(&o, pole, pole), sqrt(3.0 * 0.91) / (4.0 * g.youngs_modulus * 0.005 * 0.005), 0.02);
    double breathing = sqrt(2.0 * g.youngs_modulus / (0.7 * 1000.0));
    int k = 0;
    for (int i = 0; i < o.n; i++)
        if (fabs(objects_w(&o, i) - breathing) < fabs(objects_w(&o, k) - breathing)) k = i;
    OBJECTS_NEAR(1.0 / (o.mass[k] * objects_w(&o, k) * objects_w(&o, k)), 0.7 / (8.0 * PI * g.youngs_modulus * 0.005),
                 1e-9);
    arena_close(a);
}
END_TEST

/* P_2 and P_3 at 60 degrees: -1/8, -7/16; the lowest two modes of a thin shell are l = 2, 3. */
START_TEST(test_shell_shapes)
{
    struct arena *a = arena_open();
    struct object o = objects_of(OBJECT_SHELL, EDGES_FREE, 0.3, 30, a);
    double phi[30], along = PI / 3.0;
    ck_assert(o.shapes(&o, along * 0.6, -along * 0.8, phi) == 0.0);
    OBJECTS_NEAR(phi[0], -0.125, 1e-13);
    OBJECTS_NEAR(phi[1], -0.4375, 1e-13);
    OBJECTS_NEAR(o.shapes(&o, PI + 0.5, 0.0, phi), 0.5, 1e-12);
    OBJECTS_NEAR(phi[1], -1.0, 1e-13);
    arena_close(a);
}
END_TEST

UNIT("object_round", test_disk_published, test_drum_published, test_orthonormal, test_disk_static, test_pair,
     test_shell_frequencies, test_shell_energies, test_shell_static, test_shell_shapes)
