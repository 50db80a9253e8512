/* base/stopwatch.c: asleep, wall time passes and CPU time does not; at work, both do. 50 ms of sleep against a bound of
   a fifth of it leaves room for a loaded machine; the work goes on until the CPU clock says 20 ms. */
#include "unit.h"

#include <time.h>

#include "base/stopwatch.h"

START_TEST(test_asleep)
{
    double wall = stopwatch_wall(), cpu = stopwatch_cpu();
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    ck_assert_double_ge(stopwatch_wall() - wall, 0.05);
    ck_assert_double_le(stopwatch_cpu() - cpu, 0.01);
}
END_TEST

START_TEST(test_at_work)
{
    double wall = stopwatch_wall(), cpu = stopwatch_cpu();
    while (stopwatch_cpu() - cpu < 0.02)
        continue;
    ck_assert_double_ge(stopwatch_wall() - wall, 0.0199); /* the clocks' rates differ by less than 1 in 200 */
}
END_TEST

UNIT("stopwatch", test_asleep, test_at_work)
