/* Meshes of simple solids: neighbours share their faces, the surface is closed and of the right genus, volumes and
 * areas converge to the closed forms, elements are sound. */
#include "fem/boundary.h"
#include "fem/mesh_check.h"
#include "fem/solid_matrices.h"
#include "fem/topology.h"
#include "meshes.h"

static const double pi = 3.14159265358979323846;

#define PLATE "plate:length=40cm,width=20cm,thickness=5mm"
#define BAR "bar:length=30cm,width=3cm,thickness=1cm"
#define ROD "rod:length=30cm,diameter=2cm"
#define TUBE "rod:length=30cm,diameter=2cm,wall=2mm"
#define RING "ring:diameter=10cm,width=1cm,thickness=5mm"
#define BOWL "bowl:diameter=14cm,height=6cm,thickness=2mm"
#define BALL "sphere:diameter=5cm"
#define SHELL "sphere:diameter=5cm,wall=2mm"
#define MUG "mug:diameter=8cm,height=9.5cm,wall=4mm"
#define BEAKER "mug:diameter=8cm,height=9.5cm,wall=4mm,bottom=6mm,handle=0"

static const struct {
    const char *text;
    int euler;
} all[] = {{PLATE, 2}, {BAR, 2},  {ROD, 2},   {TUBE, 0}, {RING, 0},
           {BOWL, 2},  {BALL, 2}, {SHELL, 4}, {MUG, 0},  {BEAKER, 2}};
enum { ALL = sizeof all / sizeof all[0] };

static struct boundary of(const struct mesh *m)
{
    struct boundary b;
    boundary_make(m, meshes_arena(), &b);
    return b;
}

/* Corners - edges + faces; every edge has two. */
static int euler(const struct mesh *m, const struct boundary *b)
{
    bool *corner = ARENA_TAKE(meshes_arena(), bool, m->nodes);
    int n = 0;
    for (int i = 0; i < b->n; i++)
        for (int c = 0; c < 3; c++) {
            n += !corner[b->face[i][c]];
            corner[b->face[i][c]] = true;
        }
    return n - 3 * b->n / 2 + b->n;
}

START_TEST(test_conform)
{
    for (int fineness = 1; fineness <= 2; fineness++) {
        struct mesh m = meshes_fine(all[_i].text, fineness);
        struct topology_face *f = topology_faces(&m, meshes_arena());
        int n = 4 * m.elements, outer = 0;
        for (int i = 0, alike; i < n; i += alike) {
            alike = topology_faces_alike(f + i, n - i);
            ck_assert_int_le(alike, 2);
            outer += alike == 1;
        }
        struct boundary b = of(&m);
        ck_assert_int_eq(b.n, outer);
        ck_assert_int_eq(euler(&m, &b), all[_i].euler);
    }
}
END_TEST

/* Of a closed surface the area vectors sum to nothing: of flat faces between corners, whatever the midsides do. */
START_TEST(test_closed)
{
    struct mesh m = meshes_shape(all[_i].text);
    struct boundary b = of(&m);
    double sum[3] = {0};
    for (int i = 0; i < b.n; i++) {
        const double *p = m.at[b.face[i][0]], *q = m.at[b.face[i][1]], *r = m.at[b.face[i][2]];
        for (int c = 0; c < 3; c++) {
            int d = (c + 1) % 3, e = (c + 2) % 3;
            sum[c] += 0.5 * ((q[d] - p[d]) * (r[e] - p[e]) - (q[e] - p[e]) * (r[d] - p[d]));
        }
    }
    for (int c = 0; c < 3; c++)
        ck_assert_double_eq_tol(sum[c] / b.area, 0, 1e-13);
}
END_TEST

/* mesh_check looks at Jacobians and slivers, and at all else again in its own way. */
START_TEST(test_sound)
{
    for (int fineness = 1; fineness <= 3; fineness++) {
        struct mesh m = meshes_fine(all[_i].text, fineness);
        struct err e = {0};
        ck_assert_msg(mesh_check(&m, meshes_arena(), &e), "%s, fineness %d: %s", all[_i].text, fineness, e.text);
        ck_assert_msg(!m.note || !strstr(m.note, "flat"), "%s", m.note);
    }
}
END_TEST

START_TEST(test_freedoms)
{
    struct mesh m = meshes_shape(all[_i].text);
    struct boundary b = of(&m);
    struct solid_net net;
    solid_matrices_net(&m, &b, shapes_order(all[_i].text), meshes_arena(), &net); /* as `rasp modes compute` does */
    ck_assert_int_ge(3 * net.nodes, 15000);
    ck_assert_int_le(3 * net.nodes, 80000);
}
END_TEST

static double cut(double radius, double centre, double low, double high) /* volume of a ball between two heights */
{
    double p = low - centre, q = high - centre;
    return pi * (radius * radius * (q - p) - (q * q * q - p * p * p) / 3);
}

static double bowl_volume(double diameter, double height, double t)
{
    double d = diameter / 2, f = d / 3, centre = (d * d + height * height - f * f) / (2 * height),
           radius = sqrt(f * f + centre * centre);
    return cut(radius, centre, 0, height) - cut(radius - t, centre, t, height);
}

/* The bow's Jacobian, way - g(y) cos^2(angle), integrated in closed form; g = sqrt(R^2 - y^2) - R. */
static double handle_volume(double R, double height, double h)
{
    double g = R * R * asin(h / 2 / R) + h / 2 * sqrt(R * R - h * h / 4) - R * h;
    return h * h * pi * height / 4 - pi * h / 2 * g;
}

static double exact_volume(int which)
{
    double R = 0.04, H = 0.095;
    switch (which) {
    case 0:
        return 0.4 * 0.2 * 0.005;
    case 1:
        return 0.3 * 0.03 * 0.01;
    case 2:
        return 0.3 * pi * 1e-4;
    case 3:
        return 0.3 * pi * (1e-4 - 0.64e-4);
    case 4:
        return 0.005 * pi * (0.05 * 0.05 - 0.04 * 0.04);
    case 5:
        return bowl_volume(0.14, 0.06, 0.002);
    case 6:
        return pi / 6 * 0.05 * 0.05 * 0.05;
    case 7:
        return pi / 6 * (0.05 * 0.05 * 0.05 - 0.046 * 0.046 * 0.046);
    case 8:
        return pi * (R * R * H - 0.036 * 0.036 * (H - 0.004)) + handle_volume(R, H, 0.008);
    default:
        return pi * (R * R * H - 0.036 * 0.036 * (H - 0.006));
    }
}

/* Quadratic faces with midsides on a surface: its volume to the fourth power of their size, so 16 times better when
   cells are half as long; counts are whole, and from three to five cells it is 7.7 times. Second order would be four
   times at most. */
START_TEST(test_volume)
{
    double exact = exact_volume(_i), off[2];
    for (int k = 0; k < 2; k++) {
        struct mesh m = meshes_fine(all[_i].text, 2 + 2 * k);
        off[k] = fabs(of(&m).volume / exact - 1);
    }
    ck_assert_double_le(off[0], 1e-3);
    ck_assert_double_le(off[1], fmax(off[0] / 6, 1e-11));
}
END_TEST

START_TEST(test_area)
{
    double off[2];
    for (int k = 0; k < 2; k++) {
        struct mesh m = meshes_fine(BALL, 2 + 2 * k);
        off[k] = fabs(of(&m).area / (pi * 0.0025) - 1);
    }
    ck_assert_double_le(off[0], 1e-3);
    ck_assert_double_le(off[1], off[0] / 10);
}
END_TEST

/* Of the flat triangles of a group, each of which must be a face of the surface. */
static double group_area(const struct mesh *m, const char *name)
{
    const struct mesh_group *g = meshes_group(m, name);
    struct boundary b = of(m);
    double area = 0;
    for (int i = 0; i < g->n; i++) {
        int found = -1;
        for (int k = 0; k < b.n && found < 0; k++) {
            int same = 0;
            for (int c = 0; c < 9; c++)
                same += b.face[k][c / 3] == g->corner[i][c % 3];
            found = same == 3 ? k : -1;
        }
        ck_assert_int_ge(found, 0);
        double cross[3];
        const double *p = m->at[g->corner[i][0]], *q = m->at[g->corner[i][1]], *r = m->at[g->corner[i][2]];
        for (int c = 0; c < 3; c++) {
            int d = (c + 1) % 3, e = (c + 2) % 3;
            cross[c] = (q[d] - p[d]) * (r[e] - p[e]) - (q[e] - p[e]) * (r[d] - p[d]);
        }
        area += 0.5 * sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    }
    return area;
}

/* Flat triangles, so that what is round is some per cent small. */
START_TEST(test_groups)
{
    static const struct {
        const char *text, *group;
        double area, tolerance;
    } groups[] = {{PLATE, "x0", 0.2 * 0.005, 1e-12}, {PLATE, "x1", 0.2 * 0.005, 1e-12},
                  {PLATE, "y0", 0.4 * 0.005, 1e-12}, {PLATE, "y1", 0.4 * 0.005, 1e-12},
                  {PLATE, "z0", 0.4 * 0.2, 1e-12},   {BAR, "z1", 0.3 * 0.03, 1e-12},
                  {ROD, "x0", 3.14159e-4, 0.11},     {TUBE, "x1", 1.131e-4, 0.11},
                  {RING, "z0", 2.8274e-3, 0.01},     {RING, "z1", 2.8274e-3, 0.01},
                  {BOWL, "foot", 1.7104e-3, 0.05},   {MUG, "bottom", 5.02655e-3, 0.03},
                  {MUG, "rim", 9.5504e-4, 0.03},     {MUG, "handle", 4 * 0.008 * 3.14159 * 0.02375, 0.03},
                  {BEAKER, "rim", 9.5504e-4, 0.03}};
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++) {
        struct mesh m = meshes_shape(groups[i].text);
        double area = group_area(&m, groups[i].group) / groups[i].area;
        ck_assert_msg(fabs(area - 1) <= groups[i].tolerance, "%s %s: %g", groups[i].text, groups[i].group, area);
    }
    struct mesh m = meshes_shape(PLATE);
    for (int i = 0; i < meshes_group(&m, "x1")->n; i++)
        ck_assert_double_eq_tol(m.at[meshes_group(&m, "x1")->corner[i][0]][0], 0.4, 1e-15);
    m = meshes_shape(BEAKER);
    ck_assert_int_eq(m.groups, 2);
}
END_TEST

/* Cells 1.5 times as long: of the same solid, some 1.5^2 to 1.5^3 times fewer elements (of what is slender 1.5 times;
 * whole numbers of cells: 1.4 to 4.6). */
START_TEST(test_coarser)
{
    struct mesh m = meshes_shape(all[_i].text), n;
    struct err e = {0};
    ck_assert(shapes_mesh_coarser(all[_i].text, 1.5, meshes_arena(), &n, &e));
    double fewer = (double)m.elements / n.elements;
    ck_assert_msg(fewer > 1.4 && fewer < 4.6, "%s: %g", all[_i].text, fewer);
    ck_assert_double_eq_tol(of(&n).volume / of(&m).volume, 1, 5e-3);
}
END_TEST

START_TEST(test_handle_fits)
{
    struct mesh m = meshes_shape("mug:diameter=8cm,height=9.5cm,wall=3mm,handle=12mm");
    struct boundary b = of(&m);
    ck_assert_int_eq(euler(&m, &b), 0);
    ck_assert_double_eq_tol(b.high[0], 0.04 + 0.095 / 4 + 0.006, 1e-12);
    ck_assert_double_eq_tol(b.low[0], -0.04, 1e-4); /* no node lies quite there */
    ck_assert_double_eq_tol(b.high[2], 0.095, 1e-15);
}
END_TEST

/* The same text gives the same mesh, and units are what they say. */
START_TEST(test_same)
{
    struct mesh m = meshes_shape("bar:length=30cm,width=3cm,thickness=1cm"),
                n = meshes_shape("bar:thickness=10mm,length=0.3,width=30 mm,fineness=2");
    ck_assert_int_eq(m.nodes, n.nodes);
    ck_assert_mem_eq(m.at, n.at, (size_t)m.nodes * sizeof *m.at);
    ck_assert_mem_eq(m.element, n.element, (size_t)m.elements * sizeof *m.element);
    ck_assert_ptr_nonnull(strstr(shapes_help(), "sphere:"));
}
END_TEST

static const struct {
    const char *text, *says;
} wrong[] = {
    {"plat:length=1cm", "did you mean 'plate'"},
    {"cube:length=1cm", "shapes are plate, bar, rod, ring, bowl, sphere, mug"},
    {"plate", "needs its lengths"},
    {"plate:length=1cm,width=1cm", "needs thickness="},
    {"plate:length=1cm,width=1cm,thicknes=1mm", "did you mean 'thickness'"},
    {"plate:length=1cm,width=1cm,colour=1mm", "it has length, width, thickness, fineness"},
    {"plate:length=1cm,length=1cm", "given twice"},
    {"plate:length", "KEY=LENGTH"},
    {"plate:", "KEY=LENGTH"},
    {"plate:length=1kg,width=1cm,thickness=1mm", "unit of mass"},
    {"plate:length=-1cm,width=1cm,thickness=1mm", "above 0"},
    {"plate:length=0,width=1cm,thickness=1mm", "above 0"},
    {"plate:length=1m,width=1m,thickness=1um", "are the units right"},
    {"plate:length=1cm,width=1cm,thickness=1mm,fineness=7", "from 1 (coarse) to 6"},
    {"rod:length=10cm,diameter=1cm,wall=6mm", "makes a tube"},
    {"ring:diameter=10cm,width=5cm,thickness=1cm", "leaves a hole"},
    {"bowl:diameter=10cm,height=5cm,thickness=1mm,foot=10cm", "foot"},
    {"bowl:diameter=5cm,height=15cm,thickness=1cm", "too much for a bowl"},
    {"bowl:diameter=10cm,height=3cm,thickness=2cm", "too much for a bowl"},
    {"sphere:diameter=10cm,wall=5cm", "hollow sphere"},
    {"mug:diameter=8cm,height=9cm,wall=3cm", "a quarter"},
    {"mug:diameter=8cm,height=9cm,wall=3mm,bottom=5cm", "half the height"},
    {"mug:diameter=8cm,height=2cm,wall=3mm", "handle=0 for none"},
};
START_TEST(test_wrong)
{
    struct mesh m;
    struct err e = {0};
    ck_assert(!shapes_mesh(wrong[_i].text, meshes_arena(), &m, &e));
    ck_assert_int_eq(e.kind, ERR_USAGE);
    ck_assert_msg(strstr(e.text, wrong[_i].says), "%s: %s", wrong[_i].text, e.text);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("shapes_mesh");
    TCase *each = tcase_create("each shape"), *errors = tcase_create("errors"), *others = tcase_create("others");
    const TTest *const loops[] = {test_conform, test_closed, test_sound, test_freedoms, test_volume, test_coarser};
    for (int i = 0; i < 6; i++)
        tcase_add_loop_test(each, loops[i], 0, ALL);
    tcase_add_loop_test(errors, test_wrong, 0, sizeof wrong / sizeof wrong[0]);
    tcase_add_test(others, test_area);
    tcase_add_test(others, test_groups);
    tcase_add_test(others, test_handle_fits);
    tcase_add_test(others, test_same);
    tcase_set_timeout(each, 120);
    tcase_set_timeout(others, 120);
    suite_add_tcase(suite, each);
    suite_add_tcase(suite, errors);
    suite_add_tcase(suite, others);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner), run = srunner_ntests_run(runner);
    srunner_free(runner);
    printf("shapes_mesh: %d passed, %d failed\n", run - failed, failed);
    return failed != 0;
}
