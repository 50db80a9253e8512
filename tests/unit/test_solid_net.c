/* Nodes of higher order: as many as Euler's count of corners, edges, faces and elements says, where their barycentric
 * coordinates say, and shared. */
#include "fem/solid_matrices.h"

#include "fem/topology.h"
#include "meshes.h"

static struct mesh m;
static struct boundary b;
static struct solid_net net;

static void make(const char *text, int order)
{
    m = meshes_shape(text);
    boundary_make(&m, meshes_arena(), &b);
    solid_matrices_net(&m, &b, order, meshes_arena(), &net);
}

/* Corners and edges of the mesh are its nodes; order p has p - 1 nodes on an edge, (p - 1)(p - 2)/2 on a face, (p -
 * 1)(p - 2)(p - 3)/6 inside. */
START_TEST(test_count)
{
    static const char *const texts[] = {"plate:length=20cm,width=10cm,thickness=1cm,fineness=1",
                                        "ring:diameter=10cm,width=1cm,thickness=1cm,fineness=1",
                                        "sphere:diameter=5cm,fineness=1"};
    for (int i = 0; i < 3; i++)
        for (int p = 2; p <= 4; p++) {
            make(texts[i], p);
            bool *corner = ARENA_TAKE(meshes_arena(), bool, m.nodes);
            int corners = 0, faces = (4 * m.elements + b.n) / 2;
            for (int e = 0; e < 4 * m.elements; e++) {
                corners += !corner[m.element[e / 4][e % 4]];
                corner[m.element[e / 4][e % 4]] = true;
            }
            ck_assert_int_eq(net.nodes, corners + (m.nodes - corners) * (p - 1) + faces * (p - 1) * (p - 2) / 2 +
                                            m.elements * (p - 1) * (p - 2) * (p - 3) / 6);
        }
}
END_TEST

/* Places by the element's own corners and midsides, of every element that has the node; a face's nodes lie on the face.
 */
START_TEST(test_places)
{
    for (int p = 3; p <= 4; p++) {
        make("sphere:diameter=5cm,fineness=1", p);
        for (int e = 0; e < m.elements; e++)
            for (int i = 0; i < net.lattice.n; i++) {
                const int *a = net.lattice.at[i];
                double at[3] = {0}, c[4] = {(double)a[0] / p, (double)a[1] / p, (double)a[2] / p, (double)a[3] / p};
                static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
                for (int k = 0; k < 10; k++)
                    for (int d = 0; d < 3; d++)
                        at[d] += (k < 4 ? c[k] * (2 * c[k] - 1) : 4 * c[ends[k - 4][0]] * c[ends[k - 4][1]]) *
                                 m.at[m.element[e][k]][d];
                for (int d = 0; d < 3; d++)
                    ck_assert_double_eq_tol(at[d], net.at[net.element[e * net.lattice.n + i]][d], 1e-15);
            }
        for (int f = 0; f < b.n; f++)
            for (int i = 0; i < net.lattice.on_face; i++) {
                const int *a = net.lattice.face[i];
                double w[6], at[3] = {0};
                boundary_weights((double)a[1] / p, (double)a[2] / p, w);
                for (int k = 0; k < 6; k++)
                    for (int d = 0; d < 3; d++)
                        at[d] += w[k] * m.at[b.face[f][k]][d];
                for (int d = 0; d < 3; d++)
                    ck_assert_double_eq_tol(at[d], net.at[net.face[f * net.lattice.on_face + i]][d], 1e-15);
            }
    }
}
END_TEST

START_TEST(test_two)
{
    make("sphere:diameter=5cm,fineness=1", 2);
    ck_assert(net.nodes == m.nodes && net.element == m.element[0] && net.face == b.face[0] && net.at == m.at);
}
END_TEST

UNIT("solid_net", test_count, test_places, test_two)
