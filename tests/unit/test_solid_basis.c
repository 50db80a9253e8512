/* Modes of equal frequency: the same shapes whatever the numbers of nodes and elements, and whatever basis the solver
 * gave; signs. */
#include "fem/solid_eigen.h"

#include "num/noise.h"
#include "solids.h"

/* The same solid, nodes and elements in another order; where[i]: what node i is called there. */
static struct solids shuffled(const struct solids *s, int *where, struct arena *a)
{
    struct noise noise = noise_make(3, "order");
    struct solids t = *s;
    t.mesh.at = arena_take(a, (size_t)s->mesh.nodes, sizeof *t.mesh.at);
    t.mesh.element = arena_take(a, (size_t)s->mesh.elements, sizeof *t.mesh.element);
    for (int i = 0; i < s->mesh.nodes; i++)
        where[i] = i;
    for (int i = s->mesh.nodes - 1; i > 0; i--) {
        int j = (int)(noise_uniform(noise, 0, (uint64_t)i) * (i + 1)), swap = where[i];
        where[i] = where[j], where[j] = swap;
    }
    for (int i = 0; i < s->mesh.nodes; i++)
        memcpy(t.mesh.at[where[i]], s->mesh.at[i], sizeof *t.mesh.at);
    for (int i = 0; i < s->mesh.elements; i++)
        for (int k = 0; k < 10; k++)
            t.mesh.element[s->mesh.elements - 1 - i][k] = where[s->mesh.element[i][k]];
    solids_boundary(&t, a);
    solids_measure(&t);
    return t;
}

/* 3e-7 of the largest component, sign aside: a symmetric shape has as many largest components of either sign, and the
 * first of another order is another. */
static void expect_same(const struct solid_modes *x, const struct solid_modes *y, const int *where)
{
    ck_assert_int_eq(x->n, y->n);
    for (int i = 0; i < x->n; i++) {
        double same = 0.0, other = 0.0, most = 0.0;
        const double *u = x->shape + (size_t)i * 3 * x->nodes, *v = y->shape + (size_t)i * 3 * x->nodes;
        SOLIDS_NEAR(y->lambda[i], x->lambda[i], 1e-9);
        for (long k = 0; k < 3 * x->nodes; k++) {
            double a = u[k], b = v[3 * where[k / 3] + k % 3];
            same = fmax(same, fabs(a - b)), other = fmax(other, fabs(a + b)), most = fmax(most, fabs(a));
        }
        ck_assert_msg(fmin(same, other) < 3e-7 * most, "mode %d (%.9g) differs by %g of %g", i, x->lambda[i],
                      fmin(same, other), most);
    }
}

START_TEST(test_order)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_ask ask = {.material = &steel, .most = 30, .top = 1e6};
    struct solids s[3] = {solids_box((const int[]){6, 6, 2}, (const double[]){0.1, 0.1, 0.01}, a),
                          solids_ball(4, 0.05, a),
                          solids_box((const int[]){12, 2, 2}, (const double[]){0.2, 0.01, 0.01},
                                     a)}; /* it bends two ways that move the same places */
    for (int i = 0; i < 3; i++) {
        int *where = ARENA_TAKE(a, int, s[i].mesh.nodes), pairs = 0;
        struct solids t = shuffled(&s[i], where, a);
        struct solid_modes x = solids_modes(&s[i], &ask, a), y = solids_modes(&t, &ask, a);
        for (int k = 1; k < x.n; k++)
            pairs += x.lambda[k] == x.lambda[k - 1];
        ck_assert_int_gt(pairs, 3); /* equal frequencies did occur */
        expect_same(&x, &y, where);
    }
    arena_close(a);
}
END_TEST

START_TEST(test_sign)
{
    double u[4] = {0.5, -1.0, 1.0 - 1e-8, 0.0}, v[4] = {0.5, -1.0, 1.0 + 1e-5, 0.0}, zero[2] = {0.0, 0.0},
           w[2] = {-3.0, 2.0};
    solid_eigen_sign(u, 4);
    ck_assert(u[0] == -0.5 && u[1] == 1.0 && u[2] < 0.0);
    solid_eigen_sign(v, 4);
    ck_assert(v[0] == 0.5 && v[1] == -1.0);
    solid_eigen_sign(zero, 2);
    ck_assert(zero[0] == 0.0 && zero[1] == 0.0);
    solid_eigen_sign(w, 2);
    ck_assert(w[0] == 3.0 && w[1] == -2.0);
}
END_TEST

UNIT("solid_basis", test_order, test_sign)
