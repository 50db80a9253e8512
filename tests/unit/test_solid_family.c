/* The modes of a solid for every Poisson's ratio against those of a solid of that ratio. */
#include "fem/solid_family.h"

#include <stdlib.h>

#include "solids.h"

enum { MODES = 30 };

/* Branches by rising frequency, as solid_modes has them. */
static int rising(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* At ratios between the nodes, and beyond the three that were solved, frequencies are those of a solid of that ratio;
   slopes are those of the cubic, and agree with differences of solutions. */
static void compare(struct solids s, double tolerance, struct arena *a)
{
    const double nus[] = {0.012, 0.1357, 0.31, 0.3999, 0.448};
    struct boundary_point at;
    double log_ratio[MODES], slope[MODES], other[MODES], unused[MODES];
    boundary_nearest(&s.mesh, &s.boundary, (const double[3]){0.01, 0.007, 0.1}, &at);
    struct solid_family_ask ask = {
        .mesh = &s.mesh, .boundary = &s.boundary, .order = 2, .most = MODES, .point = &at, .points = 1};
    struct solid_family f;
    struct err e = {0};
    ck_assert_msg(solid_family_make(&ask, a, &f, &e), "%s", e.text);
    ck_assert_int_eq(f.n, MODES);
    for (size_t i = 0; i < sizeof nus / sizeof *nus; i++) {
        struct elastic material;
        ck_assert(solid_element_isotropic(3e10, nus[i], 2500.0, &material, &e));
        struct solid_ask one = {.material = &material, .order = 2, .most = MODES, .top = 1e9};
        struct solid_modes m = solids_modes(&s, &one, a);
        solid_family_at(&f, nus[i], log_ratio, slope);
        solid_family_at(&f, nus[i] + 1e-7, other, unused);
        for (int j = 0; j < MODES; j++)
            ck_assert_double_eq_tol((other[j] - log_ratio[j]) / 1e-7, slope[j], 1e-3);
        qsort(log_ratio, MODES, sizeof *log_ratio, rising);
        int off = 0; /* where branches all but cross, one cubic cannot follow both */
        for (int j = 0; j < MODES - 4; j++) {
            double share = fabs(sqrt(exp(log_ratio[j]) * 3e10 / 2500.0 / m.lambda[j]) - 1.0);
            ck_assert_msg(share < 1e-3, "nu %g mode %d: off by %g", nus[i], j, share);
            off += share > tolerance;
        }
        ck_assert_msg(off <= 2, "nu %g: %d modes off by more than %g", nus[i], off, tolerance);
    }
    /* shapes: at the middle node those of a solid of that ratio, times the root of the density, up to the sign */
    const int middle = 20;
    struct elastic material;
    double phi[MODES];
    ck_assert(solid_element_isotropic(3e10, f.nu[middle], 2500.0, &material, &e));
    struct solid_ask one = {.material = &material, .order = 2, .most = MODES, .top = 1e9};
    struct solid_modes m = solids_modes(&s, &one, a);
    ck_assert_double_eq_tol(f.nu[middle], 0.25, 1e-12);
    solid_participation(&m, &at, phi);
    for (int j = 0; j < MODES - 4; j++)
        ck_assert_double_eq_tol(fabs(f.phi[middle * f.n + j]), sqrt(2500.0) * fabs(phi[j]), 1e-4 / sqrt(f.volume));
}

START_TEST(test_plate)
{
    struct arena *a = arena_open();
    compare(solids_box((const int[]){9, 7, 1}, (const double[]){0.24, 0.17, 0.006}, a), 3e-4, a);
    arena_close(a);
}
END_TEST

START_TEST(test_block)
{
    struct arena *a = arena_open();
    compare(solids_box((const int[]){5, 4, 3}, (const double[]){0.11, 0.083, 0.06}, a), 1e-4, a);
    arena_close(a);
}
END_TEST

/* Moduli that keep their ratios: frequencies go with the root of the modulus that is named. */
START_TEST(test_given)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solids s = solids_box((const int[]){6, 4, 1}, (const double[]){0.2, 0.1, 0.01}, a);
    struct solid_ask one = {.material = &steel, .order = 2, .most = 10, .top = 1e9};
    struct solid_modes m = solids_modes(&s, &one, a);
    struct solid_family_ask ask = {
        .mesh = &s.mesh, .boundary = &s.boundary, .order = 2, .most = 10, .material = &steel, .youngs_modulus = 200e9};
    struct solid_family f;
    struct err e = {0};
    double log_ratio[10], slope[10];
    ck_assert(solid_family_make(&ask, a, &f, &e));
    ck_assert_int_eq(f.nodes, 1);
    solid_family_at(&f, 0.1, log_ratio, slope);
    for (int j = 0; j < 10; j++) {
        ck_assert_double_eq_tol(exp(log_ratio[j]) * 200e9 / 7850.0 / m.lambda[j], 1.0, 1e-9);
        ck_assert_double_eq(slope[j], 0.0);
    }
    arena_close(a);
}
END_TEST

UNIT("solid_family", test_plate, test_block, test_given)
