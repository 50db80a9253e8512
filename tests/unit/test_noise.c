/* noise: the known answers of Random123, and statistics against closed forms. Seeds are fixed, so each statistic is one
   number; its bound is where a fair generator would fail once in a million draws (4.9 standard deviations for sums; for
   the largest distance D of n values from their distribution function, Kolmogorov's 2 exp(-2 n D^2) = 1e-6 gives
   sqrt(n) D = 2.694; for the largest of k correlations, 1e-6/k of the two-sided normal tail). */
#include "num/noise.h"

#include "unit.h"

enum { COUNT = 1 << 18, LAGS = 50, STREAMS = 40, SHORT = 1 << 14 };
#define SIGMAS 4.9
#define KOLMOGOROV 2.694

/* kat_vectors of Random123 1.14, lines "philox 4 32 10": counter, key, result. */
START_TEST(known_answers)
{
    static const struct {
        uint64_t row, column, key, want[2];
    } known[] = {
        {0, 0, 0, {0xe169c58d6627e8d5, 0x9b00dbd8bc57ac4c}},
        {UINT64_MAX, UINT64_MAX, UINT64_MAX, {0x41c83b0e408f276d, 0x6d5451fda20bc7c6}},
        {0x85a308d3243f6a88, 0x0370734413198a2e, 0x299f31d0a4093822, {0x94fdccebd16cfe09, 0x24126ea15001e420}},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        uint64_t got[2];
        noise_bits((struct noise){known[i].key}, known[i].row, known[i].column, got);
        ck_assert_uint_eq(got[0], known[i].want[0]);
        ck_assert_uint_eq(got[1], known[i].want[1]);
    }
}
END_TEST

/* Keys worked out by hand from the published FNV-1a ("" is its offset, "a" is af63dc4c8601ec8c) and splitmix64 in
 * Python. */
START_TEST(keys_are_stable)
{
    ck_assert_uint_eq(noise_make(0, "").key, 0x5b21f68ffa77f14c);
    ck_assert_uint_eq(noise_make(7, "a").key, 0xb38ba4fec8c3ff89);
    ck_assert_uint_eq(noise_make(UINT64_MAX, "roughness/rod").key, 0xeb888933ea1b39c8);
}
END_TEST

static int by_value(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

START_TEST(keys_differ)
{
    enum { SEEDS = 300, NAMES = 300 };
    static uint64_t keys[SEEDS * NAMES];
    for (int i = 0; i < SEEDS; i++)
        for (int j = 0; j < NAMES; j++) {
            char name[20];
            snprintf(name, sizeof name, "stage%d", j);
            keys[i * NAMES + j] = noise_make((uint64_t)i, name).key;
        }
    qsort(keys, SEEDS * NAMES, sizeof keys[0], by_value);
    for (int i = 1; i < SEEDS * NAMES; i++)
        ck_assert(keys[i] != keys[i - 1]);
}
END_TEST

static double *uniforms(struct noise s, size_t n)
{
    double *y = malloc(n * sizeof *y);
    for (size_t i = 0; i < n; i++)
        y[i] = noise_uniform(s, 3, i);
    return y;
}

static double *normals(struct noise s, size_t n)
{
    double *y = malloc(n * sizeof *y);
    noise_normal(s, 3, n, y);
    return y;
}

static double power_mean(const double *y, size_t n, double about, int power)
{
    long double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += powl(y[i] - about, power);
    return (double)(sum / n);
}

static double correlation(const double *x, const double *y, size_t n)
{
    long double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += x[i] * y[i];
    return (double)(sum / n);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Largest distance between the distribution function and that of the sorted values. */
static double distance(double *y, size_t n, double (*probability)(double))
{
    double most = 0;
    qsort(y, n, sizeof *y, ascending);
    for (size_t i = 0; i < n; i++) {
        double p = probability(y[i]);
        most = fmax(most, fmax(p - (double)i / (double)n, (double)(i + 1) / (double)n - p));
    }
    return most;
}

static double uniform_probability(double x) { return x; }

static double normal_probability(double x) { return 0.5 * erfc(-x * M_SQRT1_2); }

/* value is the mean of n terms of that standard deviation and expectation 0. */
static void within(const char *what, double value, double deviation, size_t n)
{
    double sigmas = value * sqrt((double)n) / deviation;
    printf("%-26s %+.2f sigma\n", what, sigmas);
    ck_assert_msg(fabs(sigmas) < SIGMAS, "%s is %.2f standard deviations off", what, sigmas);
}

/* Moments of (0, 1): 1/2, 1/12; of x^2: variance 1/180. Of the normal: 0, 1, 0, 3; variances 1, 2, 15, 96. */
START_TEST(uniform_moments)
{
    double *y = uniforms(noise_make(1, "uniform"), COUNT);
    within("uniform mean", power_mean(y, COUNT, 0.5, 1), sqrt(1.0 / 12), COUNT);
    within("uniform variance", power_mean(y, COUNT, 0.5, 2) - 1.0 / 12, sqrt(1.0 / 180), COUNT);
    for (int i = 0; i < COUNT; i++)
        ck_assert(y[i] > 0 && y[i] < 1);
    double d = distance(y, COUNT, uniform_probability) * sqrt(COUNT);
    printf("uniform distance           %.3f\n", d);
    ck_assert_double_lt(d, KOLMOGOROV);
    free(y);
}
END_TEST

START_TEST(normal_moments)
{
    double *y = normals(noise_make(1, "normal"), COUNT);
    within("normal mean", power_mean(y, COUNT, 0, 1), 1, COUNT);
    within("normal variance", power_mean(y, COUNT, 0, 2) - 1, sqrt(2), COUNT);
    within("normal third moment", power_mean(y, COUNT, 0, 3), sqrt(15), COUNT);
    within("normal fourth moment", power_mean(y, COUNT, 0, 4) - 3, sqrt(96), COUNT);
    double d = distance(y, COUNT, normal_probability) * sqrt(COUNT);
    printf("normal distance            %.3f\n", d);
    ck_assert_double_lt(d, KOLMOGOROV);
    free(y);
}
END_TEST

/* The least distance is bounded as well: values spread too evenly are not random (P(sqrt(n) D < 0.275) = 8e-7; the
   theta series sqrt(2 pi)/x exp(-pi^2/(8 x^2))). */
START_TEST(not_too_even)
{
    double *y = uniforms(noise_make(2, "even"), COUNT);
    ck_assert_double_gt(distance(y, COUNT, uniform_probability) * sqrt(COUNT), 0.275);
    free(y);
}
END_TEST

/* Products of independent normals have mean 0 and standard deviation 1; 50 of them: 5.6 for 2e-8 each. */
static void lags_uncorrelated(const double *y, const char *what)
{
    double most = 0;
    for (int lag = 1; lag <= LAGS; lag++)
        most = fmax(most, fabs(correlation(y, y + lag, COUNT - LAGS)) * sqrt(COUNT - LAGS));
    printf("%-26s %.2f sigma at most\n", what, most);
    ck_assert_double_lt(most, 5.6);
}

START_TEST(lags)
{
    struct noise s = noise_make(3, "lags");
    double *y = normals(s, COUNT), *u = uniforms(s, COUNT);
    for (int i = 0; i < COUNT; i++)
        u[i] = (u[i] - 0.5) * sqrt(12);
    lags_uncorrelated(y, "normal lags");
    lags_uncorrelated(u, "uniform lags");
    free(y);
    free(u);
}
END_TEST

/* Streams of one seed and different names, of one name and different seeds, and rows of one stream: 780 pairs each, 6.1
   for 1e-6/780. */
START_TEST(streams)
{
    static double y[3][STREAMS][SHORT];
    for (int i = 0; i < STREAMS; i++) {
        char name[20];
        snprintf(name, sizeof name, "contact%d", i);
        noise_normal(noise_make(5, name), 0, SHORT, y[0][i]);
        noise_normal(noise_make((uint64_t)i, "contact"), 0, SHORT, y[1][i]);
        noise_normal(noise_make(5, "rows"), (uint64_t)i, SHORT, y[2][i]);
    }
    for (int k = 0; k < 3; k++) {
        double most = 0;
        for (int i = 0; i < STREAMS; i++)
            for (int j = 0; j < i; j++)
                most = fmax(most, fabs(correlation(y[k][i], y[k][j], SHORT)) * sqrt(SHORT));
        printf("streams %d                  %.2f sigma at most\n", k, most);
        ck_assert_double_lt(most, 6.1);
    }
}
END_TEST

START_TEST(any_length_same_numbers)
{
    struct noise s = noise_make(9, "length");
    double whole[101], part[101];
    noise_normal(s, 12, 101, whole);
    for (size_t n = 1; n <= 101; n++) {
        memset(part, 0, sizeof part);
        noise_normal(s, 12, n, part);
        ck_assert_mem_eq(part, whole, n * sizeof part[0]);
        ck_assert(n == 101 || part[n] == 0);
    }
}
END_TEST

/* The first words of the known answers as doubles; 0xe169c58d6627e8d5 >> 11 is odd, 0x41c83b0e408f276d >> 11 is even.
 */
START_TEST(uniform_of_known_bits)
{
    ck_assert_double_eq(noise_uniform((struct noise){0}, 0, 0), (double)(0xe169c58d6627e8d5 >> 11) / 0x1p53);
    ck_assert_double_eq(noise_uniform((struct noise){UINT64_MAX}, UINT64_MAX, UINT64_MAX),
                        (double)((0x41c83b0e408f276d >> 11) + 1) / 0x1p53);
    uint64_t bits[2];
    double y[2];
    noise_bits((struct noise){0}, 0, 0, bits);
    noise_normal((struct noise){0}, 0, 2, y);
    long double u = (bits[0] >> 11 | 1) / 0x1p53L, v = (bits[1] >> 11 | 1) / 0x1p53L, radius = sqrtl(-2 * logl(u));
    ck_assert_double_eq_tol(y[0], (double)(radius * cosl(2 * M_PIl * v)), 2e-15); /* a few ulp of |y| < 8.6 */
    ck_assert_double_eq_tol(y[1], (double)(radius * sinl(2 * M_PIl * v)), 2e-15);
}
END_TEST

UNIT("noise", known_answers, keys_are_stable, keys_differ, uniform_moments, normal_moments, not_too_even, lags, streams,
     any_length_same_numbers, uniform_of_known_bits)
