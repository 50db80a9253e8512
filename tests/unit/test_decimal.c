/* decimal_9g against printf("%.9g"), character by character. */
#include "num/decimal.h"

#include <float.h>
#include <stdint.h>

#include "unit.h"

static uint64_t next(uint64_t *state) /* splitmix64 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

static void same(double x)
{
    char ours[DECIMAL_ROOM + 1], theirs[64];
    size_t n = decimal_9g(x, ours);
    ck_assert_uint_le(n, DECIMAL_ROOM);
    ours[n] = '\0';
    snprintf(theirs, sizeof theirs, "%.9g", x);
    ck_assert_msg(strcmp(ours, theirs) == 0, "%a: '%s', printf '%s'", x, ours, theirs);
}

START_TEST(any_bits)
{
    uint64_t seed = 1;
    for (int i = 0; i < 500000; i++) {
        uint64_t bits = next(&seed);
        double x;
        memcpy(&x, &bits, sizeof x);
        if (!isnan(x)) same(x);
    }
}
END_TEST

/* What tables hold: times on a grid, numbers of a few decimal places, whole ones. */
START_TEST(common_numbers)
{
    uint64_t seed = 2;
    for (int i = 0; i < 100000; i++) {
        same(i * 0.001);
        same(i / 44100.0);
        same((double)(int64_t)(next(&seed) >> 40) / 1000);
        same(-ldexp((double)(next(&seed) >> 11), -(int)(next(&seed) % 90)));
        same((double)(next(&seed) % 100000000000));
    }
}
END_TEST

/* Exact ties go to the even digit; decimals with a 5 after the ninth digit lie a rounding to either side. */
START_TEST(ties)
{
    uint64_t seed = 3;
    for (int i = 0; i < 100000; i++) {
        char text[64];
        same((double)(next(&seed) % 1000000000) + 0.5);
        same(10 * (double)(next(&seed) % 1000000000) + 5);
        snprintf(text, sizeof text, "%u5e%d", (unsigned)(next(&seed) % 1000000000), (int)(next(&seed) % 600) - 308);
        same(strtod(text, NULL));
    }
}
END_TEST

/* Where the number of digits, the form or the power of two changes, and their neighbours. */
START_TEST(edges)
{
    const double some[] = {0,   -0.0,      1e-5,    9.999999995e-5, 99999.99995,  999999999.4, 999999999.5, 999999999.6,
                           1e9, 0.1 + 0.2, DBL_MAX, DBL_MIN,        DBL_TRUE_MIN, INFINITY,    -INFINITY};
    for (size_t i = 0; i < sizeof some / sizeof some[0]; i++)
        same(some[i]);
    for (int e = -330; e < 309; e++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", e);
        double x = strtod(text, NULL);
        same(x);
        same(nextafter(x, 0));
        same(-nextafter(x, INFINITY));
    }
    for (int e = -1074; e < 1024; e++) {
        same(ldexp(1, e));
        same(nextafter(ldexp(1, e), 0));
    }
}
END_TEST

START_TEST(not_a_number_has_no_sign)
{
    char text[DECIMAL_ROOM];
    ck_assert_uint_eq(decimal_9g(NAN, text), 3);
    ck_assert_mem_eq(text, "nan", 3);
    ck_assert_uint_eq(decimal_9g(-NAN, text), 3);
    ck_assert_mem_eq(text, "nan", 3);
}
END_TEST

UNIT("decimal", any_bits, common_numbers, ties, edges, not_a_number_has_no_sign)
