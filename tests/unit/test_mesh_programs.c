/* Meshes as Gmsh and TetGen themselves write them: read, sound, and of the right volume, surface and groups. */
#include "fem/boundary.h"
#include "fem/mesh_check.h"
#include "fem/topology.h"
#include "file/mesh.h"
#include "folder.h"

static const double pi = 3.14159265358979323846;

static const char gmsh[] = "command -v gmsh > /dev/null 2>&1", tetgen[] = "command -v tetgen > /dev/null 2>&1";

static struct mesh read_sound(const char *path, struct boundary *b)
{
    struct mesh m;
    struct err e = {0};
    ck_assert_msg(mesh_read(path, 0.01, folder_arena, &m, &e), "%s", e.text);
    ck_assert_msg(mesh_check(&m, folder_arena, &e), "%s", e.text);
    ck_assert_msg(!m.note || !strstr(m.note, "turned back"), "%s", m.note);
    topology_elevate(&m, folder_arena);
    ck_assert_msg(mesh_check(&m, folder_arena, &e), "%s", e.text);
    boundary_make(&m, folder_arena, b);
    return m;
}

/* A cylinder of radius 2 cm and height 5 cm. Linear: the volume of what is inscribed, some per cent less; quadratic: to
 * the fourth power of the elements' angle. */
START_TEST(test_gmsh)
{
    if (system(gmsh) != 0) return;
    folder_make();
    folder_write("c.geo", "SetFactory(\"OpenCASCADE\");\nCylinder(1) = {0,0,0, 0,0,5, 2};\nPhysical Volume(\"solid\", "
                          "7) = {1};\nPhysical Surface(\"the top\", 3) = {2};\n"
                          "Physical Surface(5) = {1, 3};\n");
    for (int k = 0; k < 8; k++) {
        struct boundary b;
        const char *path = folder_path("c.msh");
        ck_assert_int_eq(
            system(arena_format(folder_arena, "gmsh -v 0 -3 -order %d -format %s %s -clmax 1.2 -o %s %s > %s/log 2>&1",
                                1 + k % 2, k & 2 ? "msh22" : "msh41", k & 4 ? "-bin" : "", path, folder_path("c.geo"),
                                folder_name)),
            0);
        struct mesh m = read_sound(path, &b);
        double volume = pi * 4e-4 * 0.05, least = k % 2 ? 0.998 : 0.9, top = 0;
        ck_assert_double_le(b.volume, volume * 1.002);
        ck_assert_double_ge(b.volume, volume * least);
        ck_assert_int_eq(m.groups, 2);
        ck_assert_str_eq(m.group[0].name, "the top");
        ck_assert_str_eq(m.group[1].name, "5");
        ck_assert_int_eq(m.group[0].n + m.group[1].n, b.n);
        for (int i = 0; i < m.group[0].n; i++)
            for (int c = 0; c < 3; c++)
                top += m.at[m.group[0].corner[i][c]][2];
        ck_assert_double_eq_tol(top, 3 * 0.05 * m.group[0].n, 1e-9);
    }
    folder_remove();
}
END_TEST

/* A box 2 x 1 x 1 cm, two of its sides marked. */
START_TEST(test_tetgen)
{
    if (system(tetgen) != 0) return;
    folder_make();
    folder_write("c.poly", "8 3 0 0\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 0 0 1\n6 2 0 1\n7 2 1 1\n8 0 1 1\n6 1\n1 0 "
                           "11\n4 1 2 3 4\n1 0 12\n4 5 6 7 8\n1 0 0\n4 1 2 6 5\n1 0 0\n4 2 3 7 6\n"
                           "1 0 0\n4 3 4 8 7\n1 0 0\n4 4 1 5 8\n0\n0\n");
    for (int k = 0; k < 4; k++) {
        struct boundary b;
        ck_assert_int_eq(system(arena_format(folder_arena, "cd %s && tetgen -Q -pqa0.05%s%s c.poly > log 2>&1",
                                             folder_name, k & 1 ? "o2" : "", k & 2 ? "z" : "")),
                         0);
        struct mesh m = read_sound(folder_path("c.1.ele"), &b);
        ck_assert_double_eq_tol(b.volume, 2e-6, 1e-15);
        ck_assert_double_eq_tol(b.area, 10e-4, 1e-12);
        ck_assert_int_ge(m.groups, 2);
        ck_assert_str_eq(m.group[0].name, "11");
        ck_assert_str_eq(m.group[1].name, "12");
        for (int g = 0; g < 2; g++)
            for (int i = 0; i < m.group[g].n; i++)
                for (int c = 0; c < 3; c++)
                    ck_assert_double_eq_tol(m.at[m.group[g].corner[i][c]][2], g * 0.01, 1e-12);
    }
    folder_remove();
}
END_TEST

int main(void)
{
    if (system(gmsh) != 0 && system(tetgen) != 0) {
        puts("neither gmsh nor tetgen is installed");
        return 77;
    }
    const TTest *const tests[] = {test_gmsh, test_tetgen};
    return unit_run("mesh_programs", tests, 2);
}
