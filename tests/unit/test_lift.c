/* lift: the share that presses, a force's parts over it against sums over many small steps, and the time that is
 * counted. */
#include "force/lift.h"

#include "unit.h"

START_TEST(the_share_that_presses)
{
    ck_assert(lift_pressed(1, 3) == 1 && lift_pressed(0, 0) == 1 && lift_pressed(-1, -3) == 0);
    ck_assert_double_eq_tol(lift_pressed(1, -3), 0.25, 1e-15);
    ck_assert_double_eq_tol(lift_pressed(-3, 1), 0.25, 1e-15);
}
END_TEST

/* A straight line is cut exactly: midpoint sums of 1e5 steps, of which one may lie across the cut, are off by 1e-5. */
START_TEST(parts_of_a_straight_line)
{
    static const double loads[][2] = {{1, -3}, {-3, 1}, {2, -1}, {-1, 1e-3}, {-1, -2}, {1, 2}};
    for (int k = 0; k < 6; k++) {
        double a = loads[k][0], b = loads[k][1], early = 0.5 * 3 - 7 / 6.0, late = 0.5 * 3 - 7 / 3.0, sums[2] = {0};
        for (int i = 0; i < 100000; i++) {
            double q = (i + 0.5) / 1e5, f = a + (b - a) * q > 0 ? 3 - 7 * q : 0;
            sums[0] += (1 - q) * f / 1e5;
            sums[1] += q * f / 1e5;
        }
        lift_cut(a, b, &early, &late);
        ck_assert_double_eq_tol(early, sums[0], 5e-5);
        ck_assert_double_eq_tol(late, sums[1], 5e-5);
    }
}
END_TEST

/* A force exp(sin t) under N = sin(t - 0.3), whose hats' parts are known: with half the step what is left of the
 * impulse about each zero falls by 2^2 at least, over 200 steps' places. */
START_TEST(of_second_order)
{
    double off[2] = {0};
    for (int k = 0; k < 2; k++)
        for (int place = 0; place < 200; place++) {
            double dt = 0.1 / (1 + k), from = 0.3 - dt * (place + 0.5) / 200, early = 0, late = 0, want = 0;
            for (int i = 0; i < 2000; i++) {
                double q = (i + 0.5) / 2000, t = from + q * dt, f = exp(sin(t));
                early += (1 - q) * f / 2000, late += q * f / 2000;
                want += t > 0.3 ? f / 2000 : 0;
            }
            lift_cut(sin(from - 0.3), sin(from + dt - 0.3), &early, &late);
            off[k] += fabs(early + late - want) * dt / 200;
        }
    printf("%g, %g\n", off[0], off[1]);
    ck_assert_double_gt(off[0] / off[1], 3);
}
END_TEST

UNIT("lift", the_share_that_presses, parts_of_a_straight_line, of_second_order)
