/* ringing_esprit: 50 modes with five close pairs against the Cramer-Rao bound, at 60 and 40 dB. */
#include "ringing_fifty.h"

START_TEST(test_bound_60)
{
    double ratio[2];
    int tell, told;
    ck_assert_int_eq(fifty(60, 4, ratio, &tell, &told), SERIES_MODES);
    ck_assert(ratio[0] < 1.5 && ratio[1] < 1.5);
}
END_TEST

START_TEST(test_bound_40)
{
    double ratio[2];
    int tell, told;
    fifty(40, 4, ratio, &tell, &told);
    ck_assert_int_eq(told, tell);
    ck_assert(tell >= 47 && ratio[0] < 1.5 && ratio[1] < 1.5);
}
END_TEST

UNIT("ringing_esprit", test_bound_60, test_bound_40)
