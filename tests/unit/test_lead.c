/* The folded lead against what it is to keep: the sum and the first moment of all of y, before 0 and after. */
#include "num/filter.h"
#include "unit.h"

enum { N = 40 };

/* Random leads that fall off: both moments to rounding of as many terms, weighted by their number. */
START_TEST(sum_and_first_moment)
{
    srand48(11);
    for (int trial = 0; trial < 200; trial++) {
        double lead[N], sum = 0, first = 0, size = 0, folded = 0, moved = 0;
        long apart = 1 + trial % 20;
        for (int m = 1; m <= N; m++) {
            lead[m - 1] = (drand48() - 0.5) / m;
            sum += lead[m - 1];
            first -= m * lead[m - 1];
            size += m * fabs(lead[m - 1]);
        }
        filter_fold_lead(lead, N, apart);
        for (int i = 0; i < N; i++) {
            folded += lead[i];
            moved += i * lead[i];
        }
        ck_assert_double_eq_tol(folded, sum, 1e-14 * size);
        ck_assert_double_eq_tol(moved, first, 1e-13 * size);
    }
}
END_TEST

/* Without the first moment: the mirror image, nothing else. */
START_TEST(reflected)
{
    double lead[3] = {5, -2, 1};
    filter_fold_lead(lead, 3, 0);
    ck_assert(lead[0] == 5 && lead[1] == -2 && lead[2] == 1);
}
END_TEST

/* Largest |Y / Y_0 - 1| at f (in units of the rate) of an impulse within one of the first `within` samples, Y_0 that of
   the impulse itself. */
static double worst(const struct filter *k, int over, int within, double f)
{
    double most = 0;
    for (int i = 0; i < within * over; i++) {
        double lead[200] = {0}, re = 0, im = 0, t = (i + 0.5) / over;
        long leads = k->reach / over + 2;
        for (int pass = 0; pass < 2; pass++)
            for (long n = pass ? 0 : -leads; pass ? n < leads + within : n < 0; n++) {
                long tap = i - over * n + k->reach;
                double y = tap >= 0 && tap < k->taps ? over * k->tap[tap] : 0;
                if (!pass) lead[-n - 1] = y;
                y += pass && n < leads ? lead[n] : 0;
                re += pass * y * cos(2 * M_PI * f * ((double)n - t));
                im -= pass * y * sin(2 * M_PI * f * ((double)n - t));
                if (n == -1) filter_fold_lead(lead, leads, 1);
            }
        most = fmax(most, hypot(re - 1, im));
    }
    return most;
}

/* The table in num/filter.h: what is left of the error of an impulse's spectrum. Without the fold it is 0.15 throughout.
 */
START_TEST(spectrum_of_an_early_impulse)
{
    static const double f[] = {0.001, 0.01, 0.1, 0.2, 0.3}, dB[] = {-112, -73, -33.5, -21.5, -13.5};
    struct arena *a = arena_open();
    for (int over = 2; over <= 32; over *= 2) {
        struct filter k = filter_decimator(a, over);
        for (int i = 0; i < 5; i++)
            ck_assert_double_lt(20 * log10(worst(&k, over, 3, f[i])), dB[i]);
    }
    arena_close(a);
}
END_TEST

UNIT("lead", sum_and_first_moment, reflected, spectrum_of_an_early_impulse)
