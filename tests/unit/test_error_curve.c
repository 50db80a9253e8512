/* Orders and budgets of accuracy.error, against errors that are powers. */
#include "pipeline/error_curve.h"

#include <math.h>

#include "unit.h"

/* Differences of neighbours of e = c v^-p, as rehearsals of signals whose errors are alike in shape have them. */
static struct error_curve of_power(double c, double p, int n)
{
    struct error_curve o = {.order = 3, .low = 1, .end = 64, .n = n};
    for (int i = 0; i < n; i++)
        o.distance[i] = c * (pow(2, -p * i) - pow(2, -p * (i + 1)));
    return o;
}

/* The power itself comes back, between the rehearsals and beyond them: to rounding. */
START_TEST(power)
{
    struct error_curve o = of_power(1e-2, 2, 3);
    for (double v = 1; v <= 32; v++)
        ck_assert_double_eq_tol(error_curve_error(&o, v) / (1e-2 * pow(v, -2)), 1, 1e-9);
}
END_TEST

/* What seems to fall faster than its order is not believed to, beyond what was seen: and what falls more slowly is. */
START_TEST(order)
{
    struct error_curve fast = of_power(1e-2, 5, 3), slow = of_power(1e-2, 1, 3);
    double seen = error_curve_error(&fast, 4);
    ck_assert_double_eq_tol(error_curve_error(&fast, 16) / seen, pow(4, -3), 1e-9);
    ck_assert_double_eq_tol(error_curve_error(&slow, 16) / 1e-2, 1.0 / 16, 1e-9);
}
END_TEST

/* The least value that keeps an error, and none that does not. */
START_TEST(least)
{
    struct error_curve o = of_power(1e-2, 2, 3), down = of_power(1e-2, 2, 3);
    ck_assert_double_eq(error_curve_least(&o, 1.001e-2 / 49), 7);
    ck_assert_double_eq(error_curve_least(&o, 0.999e-2 / 49), 8);
    ck_assert_double_eq(error_curve_least(&o, 1), 1);
    ck_assert(isnan(error_curve_least(&o, 1e-2 / 65 / 65)));
    down.down = true;
    down.low = 64;
    down.end = 1;
    ck_assert_double_eq(error_curve_least(&down, 1.001e-2 / 16), 16);
}
END_TEST

/* Nothing is promised below the floor but what is the same to the bit. */
START_TEST(lowest)
{
    struct error_curve o = of_power(1e-7, 3, 3), none = {.order = 3, .low = 1, .end = 64, .n = 1};
    ck_assert_double_eq(error_curve_error(&o, 64), ERROR_BUDGET_FLOOR);
    ck_assert_double_eq(error_curve_error(&none, 1), 0);
    ck_assert_double_eq(error_curve_least(&none, 1e-12), 1);
}
END_TEST

/* Rehearsals end as soon as the answer is known; that there is none, when all is. */
START_TEST(enough)
{
    for (int n = 0; n < 5; n++) {
        struct error_curve o = of_power(1e-2, 2, n);
        ck_assert_int_eq(error_curve_enough(&o, 1e-3), n >= 2); /* 4 does: e(4) = 6e-4, from what 1, 2 and 4 show */
        ck_assert_int_eq(error_curve_enough(&o, 1e-8), 0);      /* 64 has 2.4e-6, but who knows                   */
        ck_assert_int_eq(error_curve_enough(&o, 2e-2), n >= 1);
    }
}
END_TEST

/* A curve that begins flat is settled at its end, or far out where its slope is its last; its best is what the rest
 * says, and is asked for with success. */
START_TEST(settled)
{
    for (int n = 1; n <= 11; n++) {
        struct error_curve o = of_power(1e-2, 2, n), longer = o;
        for (int i = 0; i < 2 && i < n; i++)
            longer.distance[i] = o.distance[i] =
                6e-4 - 1e-4 * i; /* falls by 1.6 dB, then by 0.6 to o.distance[2] = 4.7e-4, then by 12 */
        longer.end = 100000;
        ck_assert_int_eq(error_curve_converged(&o), n >= 6);
        ck_assert_int_eq(error_curve_converged(&longer), n >= 6);
        ck_assert_int_eq(error_curve_enough(&longer, 1e-12), n >= 6);
        if (n != 6) continue;
        ck_assert_double_eq(error_curve_best(&o), 64);
        ck_assert_double_eq_tol(error_curve_error(&o, 64), 1e-2 / 64 / 64, 1e-15);
    }
    struct error_curve rising = of_power(1e-2, 2, 6); /* what seems finer is not better */
    rising.distance[5] = 1;
    ck_assert_double_eq(error_curve_best(&rising), 16);
}
END_TEST

/* A last doubling that would go beyond the end is not run: a difference over less than a doubling is none of a power.
 */
START_TEST(doublings)
{
    struct error_curve o = of_power(1e-2, 2, 3);
    o.end = 15;
    ck_assert(error_curve_converged(&o));
    o.end = 16;
    ck_assert(!error_curve_converged(&o));
}
END_TEST

UNIT("promise_curve", settled, doublings, power, order, least, lowest, enough)
