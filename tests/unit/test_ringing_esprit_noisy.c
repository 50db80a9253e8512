/* ringing_esprit: 50 modes with five close pairs against the Cramer-Rao bound, at 20 dB. */
#include "ringing_fifty.h"

START_TEST(test_bound_20)
{
    double ratio[2];
    int tell, told;
    ck_assert_int_gt(fifty(20, 4, ratio, &tell, &told), 41);
    ck_assert(ratio[0] < 1.5 && ratio[1] < 1.5);
}
END_TEST

UNIT("ringing_esprit_noisy", test_bound_20)
