/* Orders, and the front against its definition in another form. */
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
    convergence_front(N, cost, cost, error, 0, on);
    for (int i = 0; i < N; i++) {
        ck_assert_int_eq(on[i], error[i] < least);
        least = fmin(least, error[i]);
    }
}
END_TEST

/* Costs are intervals: where two overlap, neither is cheaper. */
START_TEST(front_of_equals)
{
    bool on[4];
    convergence_front(4, (const double[4]){1, 1.04, 1.2, 2}, (const double[4]){1.05, 1.1, 1.3, 2.1},
                      (const double[4]){-50, -50, -50.05, -50.2}, 0.1, on);
    ck_assert(on[0] && on[1]);  /* equal in both */
    ck_assert(!on[2] && on[3]); /* dearer for nothing; dearer for something */
    convergence_front(2, (const double[2]){1, 1.1}, (const double[2]){1.2, 1.3}, (const double[2]){-50, -60}, 0.1, on);
    ck_assert(!on[0] && on[1]); /* not seen to be cheaper, and worse */
    convergence_front(2, (const double[2]){NAN, 1}, (const double[2]){0, 1}, (const double[2]){-90, -50}, 0.1, on);
    ck_assert(!on[0] && on[1]); /* what was not timed is not on it, and puts none off it */
    convergence_front(3, (const double[3]){1, 2, 1}, (const double[3]){1, 2, 1}, (const double[3]){-50, -INFINITY, NAN},
                      0.1, on);
    ck_assert(on[0] && on[1] && !on[2]);
}
END_TEST

UNIT("convergence", slopes, front, front_of_equals)
