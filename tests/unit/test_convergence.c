/* Orders, what is left at the finest, and the front: against errors C h^p made for it, and against the front's
 * definition in another form. */
#include "analysis/convergence.h"
#include "unit.h"

START_TEST(slopes)
{
    /* 4 times as many steps, errors 16 times smaller: order 2, in octaves of both */
    ck_assert_double_eq_tol(convergence_slope((const double[2]){2, 4}, (const double[2]){-3, -7}), 2, 1e-15);
    ck_assert_double_eq_tol(convergence_slope((const double[2]){40, 70}, (const double[2]){-41, -71}), 1, 1e-15);
    ck_assert_double_nan(convergence_slope((const double[2]){2, 2}, (const double[2]){-3, -7}));
    ck_assert_double_nan(convergence_slope((const double[2]){2, 4}, (const double[2]){-3, -INFINITY}));
    ck_assert_double_nan(convergence_slope((const double[2]){NAN, NAN}, (const double[2]){-3, -7}));
}
END_TEST

/* y(h) = C h^p exactly: the differences from the finest tell both, however near the finest is to the others. */
START_TEST(left_of_powers)
{
    static const double fine[][3] = {{0, 2, 3}, {2, 3, 5}, {-3, 1, 1.2}, {0, 1, 2}};
    for (int i = 0; i < 4; i++)
        for (double p = 0.5; p <= 6; p += 0.5) {
            const double *u = fine[i], c = 0.37;
            double y[3], order, left;
            for (int k = 0; k < 3; k++)
                y[k] = c * pow(2, -p * u[k]);
            left = convergence_left(u, (const double[2]){y[0] - y[2], y[1] - y[2]}, &order);
            ck_assert_double_eq_tol(order, p, 1e-6);
            ck_assert_double_eq_tol(left / y[2], 1, 1e-5);
        }
}
END_TEST

START_TEST(left_without_order)
{
    double order, u[3] = {0, 1, 2};
    ck_assert_double_eq(convergence_left(u, (const double[2]){0.1, 0.1}, &order), 0.1); /* does not fall */
    ck_assert_double_nan(order);
    ck_assert_double_eq(convergence_left(u, (const double[2]){0.19, 0.1}, &order), 0.1); /* slower than any power */
    ck_assert_double_eq(convergence_left(u, (const double[2]){INFINITY, 0.1}, &order), 0.1);
    ck_assert_double_eq(convergence_left(u, (const double[2]){0.1, 0}, &order), 0);
    ck_assert_double_eq(convergence_left((const double[3]){0, 1, 1}, (const double[2]){0.3, 0.1}, &order), 0.1);
}
END_TEST

/* Sorted by cost, each point of the front is the best so far. */
START_TEST(front)
{
    enum { N = 60 };
    double cost[N], error[N], least = HUGE_VAL;
    bool on[N];
    unsigned seed = 1;
    for (int i = 0; i < N; i++) {
        cost[i] = 1 + i;
        error[i] = -(double)((seed = seed * 1103515245u + 12345u) >> 16 & 1023);
    }
    convergence_front(N, cost, error, (struct convergence_equal){0, 0}, on);
    for (int i = 0; i < N; i++) {
        ck_assert_int_eq(on[i], error[i] < least);
        least = fmin(least, error[i]);
    }
}
END_TEST

START_TEST(front_of_equals)
{
    bool on[4];
    convergence_front(4, (const double[4]){1, 1.04, 1.2, 2}, (const double[4]){-50, -50, -50.05, -50.2},
                      (struct convergence_equal){0.05, 0.1}, on);
    ck_assert(on[0] && on[1]);  /* equal in both */
    ck_assert(!on[2] && on[3]); /* dearer for nothing; dearer for something */
    convergence_front(2, (const double[2]){NAN, 1}, (const double[2]){-90, -50}, (struct convergence_equal){0.05, 0.1},
                      on);
    ck_assert(!on[0] && on[1]); /* what was not timed is not on it, and puts none off it */
    convergence_front(3, (const double[3]){1, 2, 1}, (const double[3]){-50, -INFINITY, NAN},
                      (struct convergence_equal){0.05, 0.1}, on);
    ck_assert(on[0] && on[1] && !on[2]);
}
END_TEST

UNIT("convergence", slopes, left_of_powers, left_without_order, front, front_of_equals)
