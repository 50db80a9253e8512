/* Cells graded towards re-entrant edges: the solid stays what it is, and frequencies converge as theory says. */
#include "fem/grade.h"

#include "fem/topology.h"
#include "meshes.h"
#include "solids.h"

/* An L of two arms as wide as they are long beyond the corner: a box of 2 x 2 cells without one. */
static struct solids corner(struct arena *a)
{
    struct solids s = solids_box((const int[]){2, 2, 1}, (const double[]){0.12, 0.1, 0.02}, a);
    int n = 0;
    for (int i = 0; i < s.mesh.elements; i++) {
        double middle[2] = {0.0, 0.0};
        for (int k = 0; k < 4; k++)
            for (int c = 0; c < 2; c++)
                middle[c] += 0.25 * s.mesh.at[s.mesh.element[i][k]][c];
        if (middle[0] < 0.06 || middle[1] < 0.05) memmove(s.mesh.element[n++], s.mesh.element[i], 10 * sizeof(int));
    }
    s.mesh.elements = n;
    boundary_make(&s.mesh, a, &s.boundary);
    return s;
}

/* What a layer lowers frequencies by is, beside the layer before, a fifth to the power 2 s, s = 0.5445 of a free edge of
   270 degrees (M. L. Williams 1952): 0.173; within a tenth, as the first layers change smooth parts of the modes, too.
   Frequencies at two layers lie within 0.25 % of those of `rasp modes compute` for the same body of 8 x 8 x 2 cells of
   order 4 with five layers, and above them: of 2 x 2 x 1 cells smooth modes are 0.2 % too high. */
START_TEST(test_convergence)
{
    enum { MODES = 5, LAYERS = 4 };
    static const double hz[MODES] = {5162.87, 6002.46, 7974.97, 9331.05, 11028.5};
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    double f[LAYERS + 1][MODES];
    for (int layers = 1; layers <= LAYERS; layers++) {
        struct solids s = corner(a);
        ck_assert_int_eq(grade_edges(&s.mesh, &s.boundary, layers, a), 1);
        boundary_make(&s.mesh, a, &s.boundary);
        struct solid_ask ask = {.material = &steel, .order = 4, .most = MODES, .top = 1e9};
        struct solid_modes m = solids_modes(&s, &ask, a);
        for (int j = 0; j < MODES; j++)
            f[layers][j] = solids_hz(&m, j);
    }
    for (int j = 0; j < MODES; j++) {
        SOLIDS_NEAR((f[3][j] - f[4][j]) / (f[2][j] - f[3][j]), pow(0.2, 2.0 * 0.5445), 0.1);
        SOLIDS_NEAR(f[2][j], hz[j], 2.5e-3);
        ck_assert_double_gt(f[2][j], hz[j]);
    }
    arena_close(a);
}
END_TEST

/* Every face of a cell has one neighbour or none, no cell is turned, and volume, surface and the groups' faces are those
   of the mesh before: volume to rounding, areas as far as they are sums over points of curved faces. */
static void compare(const char *shape, int edges)
{
    struct mesh m = meshes_shape(shape), before = m;
    struct arena *a = meshes_arena();
    struct boundary old, new;
    boundary_make(&m, a, &old);
    ck_assert_int_eq(grade_edges(&m, &old, 3, a) > 0, edges);
    boundary_make(&m, a, &new);
    ck_assert_double_eq_tol(new.volume / old.volume, 1.0, 1e-12);
    ck_assert_double_eq_tol(new.area / old.area, 1.0, 1e-5);
    struct topology_face *face = topology_faces(&m, a);
    for (int i = 0, n; i < 4 * m.elements; i += n) {
        n = topology_faces_alike(face + i, 4 * m.elements - i);
        ck_assert_int_le(n, 2);
    }
    ck_assert_int_eq(m.groups, before.groups);
    for (int g = 0; g < m.groups; g++) {
        ck_assert_int_ge(m.group[g].n, before.group[g].n);
        int found = 0;
        for (int k = 0; k < m.group[g].n; k++) {
            int want[3] = {m.group[g].corner[k][0], m.group[g].corner[k][1], m.group[g].corner[k][2]};
            topology_rise(want);
            for (int i = 0; i < new.n; i++) {
                int is[3] = {new.face[i][0], new.face[i][1], new.face[i][2]};
                topology_rise(is);
                found += !memcmp(is, want, sizeof is);
            }
        }
        ck_assert_int_eq(found, m.group[g].n);
    }
}

START_TEST(test_same_solid)
{
    compare("mug:diameter=9cm,height=10cm,wall=5mm", 1);
    compare("mug:diameter=9cm,height=10cm,wall=5mm,handle=0", 1);
}
END_TEST

/* What has no re-entrant edge stays as it is, and so does all with no layers. */
START_TEST(test_left_alone)
{
    static const char *const shapes[] = {"plate:length=20cm,width=15cm,thickness=4mm",
                                         "rod:length=20cm,diameter=1cm,wall=2mm",
                                         "ring:diameter=14cm,width=1cm,thickness=6mm",
                                         "bowl:diameter=20cm,height=8cm,thickness=4mm",
                                         "sphere:diameter=5cm,wall=2mm",
                                         "mug:diameter=9cm,height=10cm,wall=5mm"};
    for (int i = 0; i < 6; i++) {
        struct mesh m = meshes_shape(shapes[i]), before = m;
        struct boundary b;
        boundary_make(&m, meshes_arena(), &b);
        ck_assert_int_eq(grade_edges(&m, &b, i < 5 ? 3 : 0, meshes_arena()), 0);
        ck_assert(!memcmp(&m, &before, sizeof m));
    }
}
END_TEST

UNIT("grade", test_convergence, test_same_solid, test_left_alone)
