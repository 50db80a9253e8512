/* Lagrange's tetrahedra and triangles: nodes, one and zeros, polynomials read back, slopes by differences; what order 2
 * must agree with. */
#include "fem/solid_element.h"

#include "fem/boundary.h"
#include "unit.h"

static const double places[4][3] = {{0.1, 0.2, 0.3}, {0.7, 0.1, 0.15}, {-0.1, 0.6, 0.4}, {0.25, 0.25, 0.25}};

/* A polynomial with all terms of degree up to `order`. */
static double polynomial(int order, const double l[3])
{
    double sum = 1.0, x = 0.3 + l[0] - 2.0 * l[1] + 0.7 * l[2], y = l[0] + 0.5 * l[1] - l[2];
    for (int i = 1, k = 0; i <= order; i++)
        for (double p = 1.0; k <= i; k++)
            sum += (p = pow(x, i - k) * pow(y, k)) * (1.0 + 0.3 * k);
    return sum;
}

START_TEST(test_nodes)
{
    static const int nodes[5] = {0, 0, 10, 20, 35}, faces[5] = {0, 0, 6, 10, 15};
    for (int order = 2; order <= 4; order++) {
        struct solid_lattice t = solid_element_lattice(order);
        double value[SOLID_LATTICE_NODES], slope[SOLID_LATTICE_NODES][3], flat[SOLID_LATTICE_FACE];
        ck_assert(t.n == nodes[order] && t.on_face == faces[order]);
        for (int i = 0; i < t.n; i++) {
            ck_assert_int_eq(t.at[i][0] + t.at[i][1] + t.at[i][2] + t.at[i][3], order);
            solid_element_lattice_shapes(
                &t,
                (const double[]){(double)t.at[i][1] / order, (double)t.at[i][2] / order, (double)t.at[i][3] / order},
                value, slope);
            for (int k = 0; k < t.n; k++)
                ck_assert_double_eq_tol(value[k], i == k, 1e-14);
        }
        for (int i = 0; i < t.on_face; i++) {
            solid_element_lattice_face(&t, (double)t.face[i][1] / order, (double)t.face[i][2] / order, flat);
            for (int k = 0; k < t.on_face; k++)
                ck_assert_double_eq_tol(flat[k], i == k, 1e-14);
        }
    }
}
END_TEST

START_TEST(test_polynomials)
{
    for (int order = 2; order <= 4; order++) {
        struct solid_lattice t = solid_element_lattice(order);
        double value[SOLID_LATTICE_NODES], slope[SOLID_LATTICE_NODES][3], other[SOLID_LATTICE_NODES],
            none[SOLID_LATTICE_NODES][3];
        for (int p = 0; p < 4; p++) {
            double sum = 0.0, flat = 0.0;
            solid_element_lattice_shapes(&t, places[p], value, slope);
            for (int i = 0; i < t.n; i++)
                sum += value[i] *
                       polynomial(order, (const double[]){(double)t.at[i][1] / order, (double)t.at[i][2] / order,
                                                          (double)t.at[i][3] / order});
            ck_assert_double_eq_tol(sum, polynomial(order, places[p]), 1e-12);
            solid_element_lattice_face(&t, places[p][0], places[p][1], other);
            for (int i = 0; i < t.on_face; i++)
                flat += other[i] * polynomial(order, (const double[]){(double)t.face[i][1] / order,
                                                                      (double)t.face[i][2] / order, 0.0});
            ck_assert_double_eq_tol(flat, polynomial(order, (const double[]){places[p][0], places[p][1], 0.0}), 1e-12);
            for (int k = 0; k < 3; k++) {
                double near[3] = {places[p][0], places[p][1], places[p][2]};
                near[k] += 1e-6;
                solid_element_lattice_shapes(&t, near, other, none);
                for (int i = 0; i < t.n; i++)
                    ck_assert_double_eq_tol(slope[i][k], (other[i] - value[i]) / 1e-6, 1e-4);
            }
        }
    }
}
END_TEST

/* Order 2 has the nodes of file/mesh.h and fem/boundary.h, in their order. */
START_TEST(test_quadratic)
{
    struct solid_lattice t = solid_element_lattice(2);
    double value[10], slope[10][3], want[10], wanted[10][3], flat[6], six[6];
    for (int p = 0; p < 4; p++) {
        solid_element_lattice_shapes(&t, places[p], value, slope);
        solid_element_shapes(places[p], want, wanted);
        solid_element_lattice_face(&t, places[p][0], places[p][1], flat);
        boundary_weights(places[p][0], places[p][1], six);
        for (int i = 0; i < 10; i++)
            for (int k = 0; k < 3; k++)
                ck_assert(fabs(value[i] - want[i]) < 1e-15 && fabs(slope[i][k] - wanted[i][k]) < 1e-14);
        for (int i = 0; i < 6; i++)
            ck_assert_double_eq_tol(flat[i], six[i], 1e-15);
    }
}
END_TEST

UNIT("solid_lattice", test_nodes, test_polynomials, test_quadratic)
