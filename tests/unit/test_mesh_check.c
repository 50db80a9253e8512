/* What is no solid is refused in clear words, with a place and a cure; what is one passes. Meshes are broken by hand.
 */
#include "fem/boundary.h"
#include "fem/mesh_check.h"
#include "fem/topology.h"
#include "meshes.h"

/* Elements by hand, linear. */
static struct mesh by_hand(int nodes, double (*at)[3], int elements, int (*corner)[4])
{
    struct mesh m = {.name = "hand", .nodes = nodes, .at = at, .elements = elements, .linear = true};
    m.element = arena_take(meshes_arena(), (size_t)elements, sizeof *m.element);
    for (int i = 0; i < elements; i++)
        for (int k = 0; k < 10; k++)
            m.element[i][k] = k < 4 ? corner[i][k] : -1;
    return m;
}

/* A copy of the shape with corners only. */
static struct mesh linear(const char *text)
{
    struct mesh m = meshes_shape(text), n = {.name = m.name,
                                             .at = arena_take(meshes_arena(), (size_t)m.nodes, sizeof *n.at),
                                             .elements = m.elements,
                                             .linear = true};
    int *number = ARENA_TAKE(meshes_arena(), int, m.nodes);
    n.element = m.element;
    for (int i = 0; i < m.elements; i++)
        for (int k = 0; k < 10; k++) {
            int *t = &n.element[i][k];
            if (k < 4 && number[*t] == 0) {
                memcpy(n.at[n.nodes], m.at[*t], sizeof *n.at);
                number[*t] = ++n.nodes;
            }
            *t = k < 4 ? number[*t] - 1 : -1;
        }
    return n;
}

static void refused(struct mesh *m, const char *says)
{
    struct err e = {0};
    ck_assert(!mesh_check(m, meshes_arena(), &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, says), "%s", e.text);
}

static void passes(struct mesh *m)
{
    struct err e = {0};
    ck_assert_msg(mesh_check(m, meshes_arena(), &e), "%s", e.text);
}

#define CUBE "plate:length=2cm,width=2cm,thickness=2cm,fineness=1"
#define SPHERE "sphere:diameter=5cm,fineness=1"

START_TEST(test_good)
{
    struct mesh m = linear(CUBE), s = meshes_shape(SPHERE);
    passes(&m);
    passes(&s);
    ck_assert_ptr_null(m.note);
}
END_TEST

START_TEST(test_none)
{
    struct mesh m = {.name = "none"};
    refused(&m, "no tetrahedra");
}
END_TEST

static void swap(int *t, int i, int j)
{
    int k = t[i];
    t[i] = t[j];
    t[j] = k;
}

START_TEST(test_inverted)
{
    struct mesh m = linear(CUBE), q = meshes_shape(SPHERE);
    swap(m.element[7], 0, 3);
    refused(&m, "tetrahedron 8 ");
    swap(m.element[7], 0, 3);
    for (int i = 0; i < m.elements; i++)
        swap(m.element[i], 0, 3);
    passes(&m);
    ck_assert_ptr_nonnull(strstr(m.note, "turned back"));
    m.note = NULL;
    passes(&m);
    ck_assert_ptr_null(m.note);
    for (int i = 0; i < q.elements; i++) { /* with their midsides: 0 and 3, 01 and 13, 20 and 23 */
        swap(q.element[i], 0, 3);
        swap(q.element[i], 4, 8);
        swap(q.element[i], 6, 9);
    }
    passes(&q);
    ck_assert_ptr_nonnull(strstr(q.note, "turned back"));
}
END_TEST

START_TEST(test_flat_element)
{
    double at[5][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {0.05, 0.05, 0}};
    int corner[1][4] = {{0, 1, 2, 4}};
    struct mesh m = by_hand(5, at, 1, corner);
    refused(&m, "has no volume");
}
END_TEST

/* A midside pushed so far that the element folds: near a corner, beyond a quarter of its edge (the classical bound of
 * the quadratic edge). */
START_TEST(test_folded)
{
    double at[4][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    int corner[1][4] = {{0, 1, 2, 3}};
    for (int k = 0; k < 2; k++) {
        struct mesh m = by_hand(4, at, 1, corner);
        topology_elevate(&m, meshes_arena());
        m.note = NULL;
        m.at[m.element[0][4]][0] = k ? 0.1 * 0.24 : 0.1 * 0.26;
        if (k)
            refused(&m, "Jacobian");
        else
            passes(&m);
    }
}
END_TEST

/* Two tetrahedra that should share a face, each with its own nodes there. */
START_TEST(test_duplicate_nodes)
{
    double at[8][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0},     {0, 0, 0.1},
                       {0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 1e-11}, {0, 0, -0.1}};
    int corner[2][4] = {{0, 1, 2, 3}, {4, 6, 5, 7}};
    struct mesh m = by_hand(8, at, 2, corner);
    refused(&m, "3 nodes stand where another one stands");
    for (int i = 4; i < 7; i++)
        at[i][1] -= 1e-6; /* apart: two bodies */
    refused(&m, "2 bodies that share no face, of 1, 1 tetrahedra");
}
END_TEST

START_TEST(test_touching)
{
    double at[7][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {-0.1, 0, 0}, {0, -0.1, 0}, {0, 0, -0.1}};
    int by_node[2][4] = {{0, 1, 2, 3}, {0, 5, 4, 6}};
    struct mesh m = by_hand(7, at, 2, by_node);
    refused(&m, "2 bodies");
    /* one body that comes back to itself: six of the eight octants, without two opposite ones that leave the origin's
     * fans apart */
    int octants[6][4] = {{0, 1, 2, 3}, {0, 2, 4, 3}, {0, 4, 5, 3}, {0, 4, 2, 6}, {0, 2, 1, 6}, {0, 1, 5, 6}};
    m = by_hand(7, at, 4, octants);
    passes(&m);
    m = by_hand(7, at, 6, octants); /* 3rd and 6th touch in the edge 0 5 */
    refused(&m, "touches itself in an edge");
}
END_TEST

/* Of the eight cells round a node in the middle of a cube only two opposite ones stay: what is left is one body, and
 * touches itself there. */
START_TEST(test_touching_node)
{
    struct mesh m = linear("plate:length=2cm,width=2cm,thickness=2cm");
    int kept = 0, n = (int)rint(cbrt(m.elements / 5.)); /* five to a cell */
    ck_assert_int_eq(5 * n * n * n, m.elements);
    ck_assert_int_ge(n, 4);
    for (int i = 0; i < m.elements; i++) {
        int cell[3], near = 0, upper = 0;
        for (int c = 0; c < 3; c++) {
            double mean = 0;
            for (int k = 0; k < 4; k++)
                mean += m.at[m.element[i][k]][c] / 4;
            cell[c] = (int)floor(mean / 0.02 * n) - n / 2; /* the node's are -1 and 0 */
            near += cell[c] == 0 || cell[c] == -1;
            upper += cell[c] == 0;
        }
        if (near < 3 || upper % 3 == 0) memcpy(m.element[kept++], m.element[i], sizeof *m.element);
    }
    ck_assert_int_eq(kept, m.elements - 30);
    m.elements = kept;
    refused(&m, "m the surface touches itself in a node");
}
END_TEST

START_TEST(test_hole)
{
    struct mesh m = linear("plate:length=2cm,width=2cm,thickness=2cm");
    int inner = -1;
    for (int i = 0; i < m.elements && inner < 0; i++) {
        bool inside = true;
        for (int k = 0; k < 4; k++)
            for (int c = 0; c < 3; c++)
                inside = inside && m.at[m.element[i][k]][c] > 1e-3 && m.at[m.element[i][k]][c] < 0.019;
        inner = inside ? i : -1;
    }
    ck_assert_int_ge(inner, 0);
    memcpy(m.element[inner], m.element[--m.elements], sizeof *m.element);
    refused(&m, "a hole of 4 faces inside");
}
END_TEST

/* A hollow ball is a solid; its cavity is told. */
START_TEST(test_cavity)
{
    struct mesh m = meshes_shape("sphere:diameter=5cm,wall=5mm,fineness=1");
    passes(&m);
    ck_assert_ptr_nonnull(strstr(m.note, "1 closed cavity"));
    ck_assert_ptr_nonnull(strstr(m.note, "reach from one side of the solid to the other"));
}
END_TEST

/* A large face against three small ones, which hang from a node in its middle: faces lie on one another and share no
 * nodes. */
START_TEST(test_hanging)
{
    double at[6][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {0.03, 0.03, 0}, {0, 0, -0.1}};
    int corner[4][4] = {{0, 1, 2, 3}, {0, 4, 1, 5}, {1, 4, 2, 5}, {2, 4, 0, 5}};
    struct mesh m = by_hand(6, at, 4, corner);
    refused(&m, "2 bodies");
    /* joined elsewhere, inside a larger solid, it is a gap: the lower three are part of a body that surrounds the face
     */
    double more[9][3] = {{0, 0, 0},    {0.1, 0, 0},      {0, 0.1, 0},       {0, 0, 0.1},      {0.03, 0.03, 0},
                         {0, 0, -0.1}, {0.2, 0.2, 0.05}, {-0.2, 0.1, 0.05}, {0.1, -0.2, 0.05}};
    int round[10][4] = {{0, 1, 2, 3}, {0, 4, 1, 5}, {1, 4, 2, 5}, {2, 4, 0, 5}, {1, 2, 3, 6},
                        {1, 5, 2, 6}, {2, 0, 3, 7}, {2, 5, 0, 7}, {0, 1, 3, 8}, {0, 5, 1, 8}};
    for (int i = 0; i < 10; i++) { /* all positive */
        double d[3][3];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++)
                d[k][c] = more[round[i][k + 1]][c] - more[round[i][0]][c];
        double det = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                     d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                     d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
        if (det < 0) swap(round[i], 0, 1);
    }
    m = by_hand(9, more, 10, round);
    struct err e = {0};
    ck_assert(!mesh_check(&m, meshes_arena(), &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
}
END_TEST

START_TEST(test_twice)
{
    struct mesh m = linear(CUBE);
    int(*more)[10] = arena_take(meshes_arena(), (size_t)m.elements + 1, sizeof *more);
    memcpy(more, m.element, (size_t)m.elements * sizeof *more);
    memcpy(more[m.elements], more[0], sizeof *more);
    m.element = more;
    m.elements++;
    refused(&m, "a face belongs to more than two");
    int two[2][4] = {{0, 1, 2, 3}, {0, 1, 2, 3}};
    double at[4][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    m = by_hand(4, at, 2, two);
    refused(&m, "same side of a face");
}
END_TEST

START_TEST(test_midsides)
{
    double at[5][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {0, 0, -0.1}};
    int corner[2][4] = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    struct mesh m = by_hand(5, at, 2, corner);
    topology_elevate(&m, meshes_arena());
    m.note = NULL;
    passes(&m);
    double(*more)[3] = arena_take(meshes_arena(), (size_t)m.nodes + 1, sizeof *more);
    memcpy(more, m.at, (size_t)m.nodes * sizeof *more);
    memcpy(more[m.nodes], more[m.element[1][4]], sizeof *more);
    more[m.nodes][2] += 1e-4;
    m.at = more;
    m.element[1][4] = m.nodes++;
    refused(&m, "two midside nodes");
}
END_TEST

START_TEST(test_units)
{
    struct mesh m = linear(CUBE);
    for (int i = 0; i < m.nodes; i++)
        for (int c = 0; c < 3; c++)
            m.at[i][c] *= 4000;
    refused(&m, "80 m large, too large for an object; the file may be in mm or cm: give --unit mm (then it is 0.08 m) "
                "or --unit cm (0.8 m)");
    for (int i = 0; i < m.nodes; i++)
        for (int c = 0; c < 3; c++)
            m.at[i][c] *= 1e-5;
    refused(&m, "too small");
}
END_TEST

START_TEST(test_sliver)
{
    double at[5][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.05, 0.051, 1e-4}, {0.02, 0.02, 0.1}};
    int corner[1][4] = {{0, 1, 2, 3}};
    struct mesh m = by_hand(4, at, 1, corner);
    passes(&m);
    ck_assert_ptr_nonnull(strstr(m.note, "1 of 1 tetrahedra are nearly flat"));
}
END_TEST

/* Midsides in the middle, shared, and counted by Euler's formula: edges = nodes + faces - elements - 1 of a ball. */
START_TEST(test_raise)
{
    struct mesh m = linear(CUBE);
    struct boundary b;
    int corners = m.nodes;
    topology_elevate(&m, meshes_arena());
    ck_assert(!m.linear);
    ck_assert_ptr_nonnull(strstr(m.note, "gmsh -order 2"));
    boundary_make(&m, meshes_arena(), &b);
    int faces = (4 * m.elements + b.n) / 2;
    ck_assert_int_eq(m.nodes - corners, corners + faces - m.elements - 1);
    ck_assert_double_eq_tol(b.volume, 8e-6, 1e-18);
    passes(&m);
    int nodes = m.nodes;
    topology_elevate(&m, meshes_arena());
    ck_assert_int_eq(m.nodes, nodes);
}
END_TEST

UNIT("mesh_check", test_good, test_none, test_inverted, test_flat_element, test_folded, test_duplicate_nodes,
     test_touching, test_touching_node, test_hole, test_cavity, test_hanging, test_twice, test_midsides, test_units,
     test_sliver, test_raise)
