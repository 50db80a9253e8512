/* The labels of the picture of rasp accuracy. */
#include <math.h>
#include <stdlib.h>

#include "cmd/accuracy.h"
#include "unit.h"

/* Of any range that the picture may have, from a factor of 2.25 on (one setting alone) to nine decades: three numbers or
 * more, within it, rising, and not too many to be read. */
START_TEST(three_numbers_at_least)
{
    unsigned short state[3] = {1, 2, 3};
    for (int i = 0; i < 20000; i++) {
        double tics[ACCURACY_REPORT_TICS], low = pow(10, 9 * erand48(state) - 4),
                                           high = low * (i % 3 ? 2.25 + 1e-9 : 2.25 * pow(10, 9 * erand48(state)));
        int n = accuracy_report_tics(low, high, tics);
        ck_assert_msg(n >= 3 && n <= 20, "%d labels from %g to %g", n, low, high);
        for (int k = 0; k < n; k++)
            ck_assert(tics[k] >= low && tics[k] <= high && (k == 0 || tics[k] > tics[k - 1]));
    }
}
END_TEST

/* Powers of ten where there are three; else 2 and 5. */
START_TEST(round_numbers)
{
    double tics[ACCURACY_REPORT_TICS];
    ck_assert_int_eq(accuracy_report_tics(3, 3000, tics), 3);
    ck_assert(fabs(tics[0] - 10) < 1e-9 && fabs(tics[2] - 1000) < 1e-9);
    ck_assert_int_eq(accuracy_report_tics(11, 170, tics), 3);
    ck_assert(fabs(tics[0] - 20) < 1e-9 && fabs(tics[1] - 50) < 1e-9);
    ck_assert_int_eq(accuracy_report_tics(21, 49, tics), 5);
    ck_assert(fabs(tics[0] - 25) < 1e-9 && fabs(tics[4] - 45) < 1e-9);
}
END_TEST

UNIT("accuracy_plot", three_numbers_at_least, round_numbers)
