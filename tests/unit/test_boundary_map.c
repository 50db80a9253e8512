/* Places of the plane on a solid, and its shapes there. */
#include "fem/boundary.h"

#include "fem/shapes.h"
#include "fem/solid.h"
#include "num/real.h"
#include "unit.h"

static struct arena *arena;
static struct mesh mesh;
static struct boundary boundary;

static void solid(const char *shape)
{
    struct err e = {0};
    arena = arena_open();
    ck_assert_msg(shapes_mesh(shape, arena, &mesh, &e), "%s", e.text);
    boundary_make(&mesh, arena, &boundary);
}

static void found(int face, double x, double y, const double at[3], const double normal[3])
{
    struct boundary_map c;
    struct boundary_point p;
    boundary_map_make(&mesh, &boundary, face, &c);
    ck_assert_msg(boundary_map_point(&c, x, y, &p), "%s %g %g", boundary_map_sides[face], x, y);
    for (int i = 0; i < 3; i++) {
        ck_assert_double_eq_tol(p.at[i], at[i], 1e-12);
        ck_assert_double_eq_tol(p.normal[i], normal[i], 1e-12);
    }
}

/* Each side of a box shows its own face, with the other two axes as places. */
START_TEST(sides_of_a_box)
{
    solid("plate:length=30cm,width=20cm,thickness=1cm");
    found(BOUNDARY_TOP, 0.11, 0.07, (double[]){0.11, 0.07, 0.01}, (double[]){0, 0, 1});
    found(BOUNDARY_BOTTOM, 0.11, 0.07, (double[]){0.11, 0.07, 0}, (double[]){0, 0, -1});
    found(BOUNDARY_RIGHT, 0.07, 0.004, (double[]){0.3, 0.07, 0.004}, (double[]){1, 0, 0});
    found(BOUNDARY_LEFT, 0.07, 0.004, (double[]){0, 0.07, 0.004}, (double[]){-1, 0, 0});
    found(BOUNDARY_BACK, 0.07, 0.004, (double[]){0.07, 0.2, 0.004}, (double[]){0, 1, 0});
    found(BOUNDARY_FRONT, 0.07, 0.004, (double[]){0.07, 0, 0.004}, (double[]){0, -1, 0});
    arena_close(arena);
}
END_TEST

/* Edges and corners of the box belong to it, what lies beside does not. */
START_TEST(ends_of_a_box)
{
    struct boundary_map c;
    struct boundary_point p;
    solid("plate:length=30cm,width=20cm,thickness=1cm");
    boundary_map_make(&mesh, &boundary, BOUNDARY_TOP, &c);
    for (int i = 0; i <= 4; i++)
        for (int j = 0; j <= 4; j++)
            ck_assert_msg(boundary_map_point(&c, 0.3 * i / 4, 0.2 * j / 4, &p), "%d %d", i, j);
    ck_assert(!boundary_map_point(&c, -1e-6, 0.1, &p));
    ck_assert(!boundary_map_point(&c, 0.1, 0.2 + 1e-6, &p));
    arena_close(arena);
}
END_TEST

/* Round a ring: arc and height on its outer and its inner wall. Faces are curved to second order: 20 um off the true
 * circle at most. */
START_TEST(walls_of_a_ring)
{
    struct boundary_map c;
    struct boundary_point p;
    solid("ring:diameter=20cm,width=2cm,thickness=3cm");
    for (int face = BOUNDARY_AROUND; face <= BOUNDARY_INSIDE; face++) {
        double radius = face == BOUNDARY_AROUND ? 0.1 : 0.08, out = face == BOUNDARY_AROUND ? 1 : -1;
        boundary_map_make(&mesh, &boundary, face, &c);
        ck_assert_double_eq_tol(c.radius, 0.1, 2e-5);
        for (int i = 0; i < 12; i++) {
            double angle = 2 * M_PI * i / 12 + 0.1;
            ck_assert(boundary_map_point(&c, angle * c.radius, 0.013, &p));
            ck_assert_double_eq_tol(p.at[0], radius * cos(angle), 2e-5);
            ck_assert_double_eq_tol(p.at[1], radius * sin(angle), 2e-5);
            ck_assert_double_eq_tol(p.at[2], 0.013, 1e-12);
            ck_assert_double_eq_tol(p.normal[0] * cos(angle) + p.normal[1] * sin(angle), out, 1e-3);
        }
    }
    boundary_map_make(&mesh, &boundary, BOUNDARY_TOP, &c);
    ck_assert(!boundary_map_point(&c, 0, 0, &p)); /* the hole */
    arena_close(arena);
}
END_TEST

/* A displacement field that is a polynomial of second degree is read back exactly: minus its normal part. */
START_TEST(shapes_along_the_inward_normal)
{
    struct boundary_map c;
    struct boundary_point p;
    solid("plate:length=30cm,width=20cm,thickness=1cm");
    double *shape = ARENA_TAKE(arena, double, 6L * mesh.nodes), phi[2];
    for (int i = 0; i < mesh.nodes; i++) {
        double x = mesh.at[i][0], y = mesh.at[i][1], *u = shape + 3 * (mesh.nodes + i);
        shape[3 * i + 2] = 1;
        u[0] = 5 + y;
        u[2] = 2 - 3 * x + 40 * x * y - 7 * y * y;
    }
    struct solid_modes s = {
        .n = 2, .nodes = mesh.nodes, .shape = shape, .lattice = solid_element_lattice(2), .face = boundary.face[0]};
    boundary_map_make(&mesh, &boundary, BOUNDARY_TOP, &c);
    for (int i = 0; i < 20; i++) {
        double x = 0.3 * (i + 0.37) / 20, y = 0.2 * (19.3 - i) / 20;
        ck_assert(boundary_map_point(&c, x, y, &p));
        solid_participation(&s, &p, phi);
        ck_assert_double_eq_tol(phi[0], -1, 1e-12);
        ck_assert_double_eq_tol(phi[1], -(2 - 3 * x + 40 * x * y - 7 * y * y), 1e-11);
    }
    boundary_map_make(&mesh, &boundary, BOUNDARY_LEFT, &c);
    ck_assert(boundary_map_point(&c, 0.15, 0.005, &p));
    solid_participation(&s, &p, phi);
    ck_assert_double_eq_tol(phi[1], 5.15, 1e-11);
    arena_close(arena);
}
END_TEST

UNIT("chart", sides_of_a_box, ends_of_a_box, walls_of_a_ring, shapes_along_the_inward_normal)
