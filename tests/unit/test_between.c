/* between: sinusoids of any frequency and phase, between their samples. */
#include "num/filter.h"
#include "unit.h"

enum { N = 400 };

static double worst_error(const struct filter_between *b, double frequency)
{
    double x[N], worst = 0;
    for (int i = 0; i < N; i++)
        x[i] = sin(2 * M_PI * frequency * i + 0.7);
    for (long k = BETWEEN_REACH * BETWEEN_PHASES; k < (N - BETWEEN_REACH) * BETWEEN_PHASES; k++)
        worst = fmax(
            worst, fabs(filter_between_at(b, x, N, k) - sin(2 * M_PI * frequency * (double)k / BETWEEN_PHASES + 0.7)));
    return worst;
}

START_TEST(sinusoids)
{
    struct arena *a = arena_open();
    struct filter_between b = filter_between_make(a);
    for (double f = 0; f <= 0.4001; f += 0.02)
        ck_assert_double_le(worst_error(&b, f), 4e-5);
    ck_assert_double_le(worst_error(&b, 0.44), 1e-4);
    ck_assert_double_ge(worst_error(&b, 0.49), 1e-2); /* no kernel of this length has that: the test sees errors */
    arena_close(a);
}
END_TEST

START_TEST(samples_and_ends)
{
    double x[5] = {3, -1, 4, 1, -5};
    struct arena *a = arena_open();
    struct filter_between b = filter_between_make(a);
    for (long i = -3; i < 9; i++)
        ck_assert_double_eq(filter_between_at(&b, x, 5, i * BETWEEN_PHASES), i >= 0 && i < 5 ? x[i] : 0);
    for (long k = 1; k < 4 * BETWEEN_PHASES; k++) { /* the signal backwards is its mirror image */
        double y[5] = {-5, 1, 4, -1, 3};
        ck_assert_double_eq_tol(filter_between_at(&b, x, 5, k), filter_between_at(&b, y, 5, 4 * BETWEEN_PHASES - k),
                                1e-13);
    }
    ck_assert_double_eq(filter_between_at(&b, x, 5, -40 * BETWEEN_PHASES + 5), 0);
    ck_assert_double_ne(filter_between_at(&b, x, 5, -5), 0); /* it rings before its first sample */
    arena_close(a);
}
END_TEST

UNIT("between", sinusoids, samples_and_ends)
