/* Meshes from files: one mesh in all formats, cut off and changed at every byte, and what is wrong said with its place.
 */
#include "file/mesh.h"
#include "mesh_files.h"

/* Nodes by rising tag: 5 7 8 11 100. */
static void check_two(const struct mesh *m, double unit)
{
    static const double at[5][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 0}, {0, 0, 1}};
    static const int element[2][4] = {{3, 0, 1, 4}, {3, 1, 0, 2}};
    ck_assert_int_eq(m->nodes, 5);
    ck_assert_int_eq(m->elements, 2);
    ck_assert(m->linear);
    for (int i = 0; i < 15; i++)
        ck_assert_double_eq(m->at[i / 3][i % 3], unit * at[i / 3][i % 3]);
    for (int i = 0; i < 20; i++)
        ck_assert_int_eq(m->element[i / 10][i % 10], i % 10 < 4 ? element[i / 10][i % 10] : -1);
    ck_assert_int_eq(m->groups, 2);
    ck_assert_str_eq(m->group[1].name, "4");
    ck_assert_int_eq(m->group[1].n, 1);
    ck_assert_int_eq(m->group[1].corner[0][0] + m->group[1].corner[0][1] + m->group[1].corner[0][2], 0 + 1 + 2);
}

START_TEST(test_formats)
{
    struct arena *a = folder_make();
    for (int kind = 0; kind < FILES_KINDS; kind++) {
        struct mesh m;
        struct err e = {0};
        ck_assert_msg(mesh_read(files_msh(kind), 0.001, a, &m, &e), "%s", e.text);
        check_two(&m, 0.001);
        ck_assert_str_eq(m.group[0].name, "the top");
        ck_assert_int_eq(m.group[0].n, kind < 2 ? 1 : 2); /* the second surface of the 4.1 file is in both groups */
    }
    files_tetgen("tet");
    for (int i = 0; i < 2; i++) {
        struct mesh m;
        struct err e = {0};
        ck_assert_msg(mesh_read(folder_path(i ? "tet.ele" : "tet.node"), 1, a, &m, &e), "%s", e.text);
        check_two(&m, 1);
        ck_assert_str_eq(m.group[0].name, "3");
    }
    folder_remove();
}
END_TEST

/* Ten nodes, each midside at its place in the file's order. */
START_TEST(test_quadratic)
{
    struct arena *a = folder_make();
    static const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
                     gmsh[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}},
                     tetgen[6][2] = {{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}};
    for (int kind = 0; kind < 2; kind++) {
        const char *nodes = "", *name = kind ? "q.node" : "q.msh";
        for (int i = 0; i < 10; i++) {
            const int *d = (kind ? tetgen : gmsh)[i < 4 ? 0 : i - 4];
            double x[3];
            for (int c = 0; c < 3; c++)
                x[c] = i < 4 ? corner[i][c] : 0.5 * (corner[d[0]][c] + corner[d[1]][c]);
            nodes = arena_format(a, "%s%d %g %g %g\n", nodes, i + 1, x[0], x[1], x[2]);
        }
        if (kind) {
            folder_write("q.node", arena_format(a, "10 3 0 0\n%s", nodes));
            folder_write("q.ele", "1 10 0\n1 1 2 3 4 5 6 7 8 9 10\n");
            folder_write("q.face", "1 1\n1 1 2 3 7 8 10 12\n");
        } else
            folder_write("q.msh",
                         arena_format(a,
                                      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n%s$EndNodes\n$Elements\n1\n1 "
                                      "11 0 1 2 3 4 5 6 7 8 9 10\n$EndElements\n",
                                      nodes));
        struct mesh m;
        struct err e = {0};
        ck_assert_msg(mesh_read(folder_path(name), 1, a, &m, &e), "%s", e.text);
        ck_assert(!m.linear);
        ck_assert_int_eq(m.groups, kind);
        for (int i = 0; i < 6; i++)
            for (int c = 0; c < 3; c++)
                ck_assert_double_eq(m.at[m.element[0][4 + i]][c],
                                    0.5 * (corner[ends[i][0]][c] + corner[ends[i][1]][c]));
    }
    folder_remove();
}
END_TEST

static char *whole(const char *path, size_t *n)
{
    FILE *f = fopen(path, "rb");
    char *text = arena_take(folder_arena, 1 << 16, 1);
    *n = fread(text, 1, 1 << 16, f);
    fclose(f);
    return text;
}

static void put(const char *path, const char *text, size_t n)
{
    FILE *f = fopen(path, "wb");
    fwrite(text, 1, n, f);
    fclose(f);
}

/* Every shorter file is refused (but for the last line's end), and every file with one byte changed is read or refused,
 * never more. */
START_TEST(test_damaged)
{
    folder_make();
    for (int kind = 0; kind < FILES_KINDS; kind++) {
        size_t n;
        const char *path = files_msh(kind);
        char *text = whole(path, &n);
        for (size_t i = 0; i < 2 * n; i++) {
            struct arena *a = arena_open();
            struct mesh m;
            struct err e = {0};
            char kept = text[i % n];
            text[i % n] = (char)(i < n ? kept : ~kept);
            put(path, text, i < n ? i : n);
            text[i % n] = kept;
            bool ok = mesh_read(path, 1, a, &m, &e);
            ck_assert_msg(!(i < n - 1 && ok), "%s of %zu bytes was read", path, i);
            ck_assert_int_eq(ok, e.kind == ERR_NONE);
            ck_assert(ok || strstr(e.text, path));
            arena_close(a);
        }
    }
    folder_remove();
}
END_TEST

#define HEAD "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define NODES "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
#define HEAD4 "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
static const struct {
    const char *text, *says;
} wrong[] = {
    {"", "no $MeshFormat"},
    {"$NOD\n1\n", "version 1 is not read"},
    {"$MeshFormat\n4 0 8\n$EndMeshFormat\n", ":2: MSH version 4; 2.2 and 4.1 are read"},
    {"$MeshFormat\n2.2 0 4\n$EndMeshFormat\n", "numbers of 4 bytes"},
    {"$MeshFormat\n2.2 1 8\n\0\0\0\1", "byte"},
    {HEAD, "no $Nodes"},
    {HEAD "$Nodes\n1000000000000000000\n1 0 0 0\n$EndNodes\n",
     ":5: the number of nodes is 1000000000000000000, and the 19 bytes that follow cannot hold so many"},
    {HEAD "$Nodes\n-1\n", "the number of nodes is -1"},
    {HEAD "$Nodes\n1e3\n", "'1e3', not a whole number"},
    {HEAD "$Nodes\n99999999999999999999\n", "not a whole number below 2^63"},
    {HEAD "$Nodes\n2\n1 0 0 0\n2 nan 0 0\n$EndNodes\n", ":7: a coordinate of a node is 'nan', not a finite number"},
    {HEAD "$Nodes\n2\n1 0 0 0\n2 1e999 0 0\n$EndNodes\n", ":7: a coordinate of a node is '1e999'"},
    {HEAD "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", "node 1 is defined twice"},
    {HEAD "$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n", "there are no nodes"},
    {HEAD NODES, "no $Elements"},
    {HEAD NODES "$Elements\n1\n1 4 0 1 2 3 5\n$EndElements\n",
     ":13: an element has node 5, and no such node is defined (they go from 1 to 4)"},
    {HEAD NODES "$Elements\n1\n1 4 0 1 2 3 -4\n$EndElements\n", "node -4"},
    {HEAD NODES "$Elements\n1\n1 5 0 1 2 3 4 1 2 3 4\n$EndElements\n", "a hexahedron (type 5): only tetrahedra"},
    {HEAD NODES "$Elements\n1\n1 77 0 1 2 3 4\n$EndElements\n", "type 77"},
    {HEAD NODES "$Elements\n1\n1 2 0 1 2 3\n$EndElements\n", "no tetrahedra, only 1 triangles: this is a surface"},
    {HEAD NODES "$Elements\n0\n$EndElements\n", "no tetrahedra; fill"},
    {HEAD NODES "$Elements\n1\n1 4 -2 1 2 3 4\n$EndElements\n", "-2 tags"},
    {HEAD NODES "$Elements\n2\n1 4 0 1 2 3 4\n2 11 0 1 2 3 4 1 2 3 4 1 2\n$EndElements\n",
     "tetrahedra of 4 and of 10 nodes"},
    {HEAD NODES "$Elements\n1\n1 4 0 1 2 3 4\n", "no $EndElements"},
    {HEAD "$PhysicalNames\n2\n2 1 \"a\"\n2 1 \"b\"\n$EndPhysicalNames\n" NODES, "physical surface 1 has two names"},
    {HEAD "$PhysicalNames\n1\n2 1 top\n$EndPhysicalNames\n" NODES, ":6: the name of a physical group"},
    {HEAD4 "$Nodes\n1 1000000000000000000 1 1\n", "the number of nodes is 1000000000000000000"},
    {HEAD4 "$Nodes\n1 1 1 1\n3 1 0 9\n1\n0 0 0\n0\n0 0 0\n$EndNodes\n", "cannot hold"},
    {HEAD4 "$Nodes\n1 2 1 2\n3 1 0 1\n1\n0 0 0\n$EndNodes\n", "the blocks hold 1 nodes, and $Nodes said 2"},
    {HEAD4 "$Nodes\n1 1 1 1\n5 1 0 1\n1\n0 0 0\n$EndNodes\n", "dimension 5"},
};
START_TEST(test_wrong)
{
    struct arena *a = folder_make();
    struct mesh m;
    struct err e = {0};
    folder_write("bad.msh", wrong[_i].text);
    ck_assert(!mesh_read(folder_path("bad.msh"), 1, a, &m, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, wrong[_i].says), "%s", e.text);
    folder_remove();
}
END_TEST

START_TEST(test_tetgen_wrong)
{
    static const struct {
        const char *node, *ele, *face, *says;
    } bad[] = {
        {"1 2 0 0\n1 0 0\n", "", NULL, "dimension 2"},
        {"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "1 4 0\n0 0 1 2 4\n", NULL, ".ele:2: an element has node 4"},
        {"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "1 8 0\n0 0 1 2 3\n", NULL, "elements of 8 nodes"},
        {"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 inf\n", "", NULL, ".node:5: a coordinate"},
        {"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "1 4 0\n0 0 1 2 3\n", "1 1\n0 0 1 5\n",
         "a face of 4 numbers"},
        {"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "5000000000000 4 0\n0 0 1 2 3\n", NULL,
         "cannot hold so many"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct arena *a = folder_make();
        struct mesh m;
        struct err e = {0};
        folder_write("b.node", bad[i].node);
        folder_write("b.ele", bad[i].ele);
        if (bad[i].face) folder_write("b.face", bad[i].face);
        ck_assert(!mesh_read(folder_path("b.ele"), 1, a, &m, &e));
        ck_assert_msg(strstr(e.text, bad[i].says), "%s", e.text);
        folder_remove();
    }
}
END_TEST

START_TEST(test_missing)
{
    struct arena *a = folder_make();
    struct mesh m;
    static const struct {
        const char *name, *says;
        enum err_kind kind;
    } missing[] = {{"none.msh", "No such file", ERR_INPUT},
                   {"half.ele", "belong together", ERR_INPUT},
                   {"mesh.stl", "not a mesh by its name", ERR_SCENE}};
    folder_write("half.ele", "0 4 0\n");
    for (int i = 0; i < 3; i++) {
        struct err e = {0};
        ck_assert(!mesh_read(folder_path(missing[i].name), 1, a, &m, &e));
        ck_assert_int_eq(e.kind, missing[i].kind);
        ck_assert_msg(strstr(e.text, missing[i].says), "%s", e.text);
    }
    struct err e = {0};
    ck_assert(!mesh_read(files_msh(0), 0, a, &m, &e));
    ck_assert_int_eq(e.kind, ERR_USAGE);
    e = (struct err){0};
    folder_write(
        "far.msh", HEAD
        "$Nodes\n4\n1 0 0 0\n2 1e10 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 0 1 2 3 4\n$EndElements\n");
    ck_assert(!mesh_read(folder_path("far.msh"), 1e300, a, &m, &e));
    ck_assert_msg(strstr(e.text, "too large"), "%s", e.text);
    folder_remove();
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("mesh");
    TCase *all = tcase_create("all"), *errors = tcase_create("errors");
    tcase_add_test(all, test_formats);
    tcase_add_test(all, test_quadratic);
    tcase_add_test(all, test_damaged);
    tcase_add_test(all, test_tetgen_wrong);
    tcase_add_test(all, test_missing);
    tcase_add_loop_test(errors, test_wrong, 0, sizeof wrong / sizeof wrong[0]);
    tcase_set_timeout(all, 120);
    suite_add_tcase(suite, all);
    suite_add_tcase(suite, errors);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner), run = srunner_ntests_run(runner);
    srunner_free(runner);
    printf("mesh: %d passed, %d failed\n", run - failed, failed);
    return failed != 0;
}
