/* modulation: planted sinusoids at irregular times are found, with their errors; where there is none, none is. */
#include "analysis/modulation.h"

#include "series.h"

enum { N = 1500 };
static double at[N], amplitude[N];

struct planted {
    double m, nu, phase, a1, b1, deviation;
};

/* Mean amplitude 0.4; intervals of 4 ms with a deviation of 1 ms, not below 0.1 ms. */
static void plant(struct planted p, unsigned long seed)
{
    gsl_rng *g = series_rng(seed);
    static double interval[N];
    series_draw(g, 0.4, p.deviation, p.a1, p.b1, amplitude, N);
    series_draw(g, 4e-3, 0.3e-3, -0.95, -0.1, interval, N);
    at[0] = 2.5;
    for (int i = 1; i < N; i++)
        at[i] = at[i - 1] + fmax(interval[i], 1e-4);
    for (int i = 0; i < N; i++)
        amplitude[i] = fmax(amplitude[i], 0.004) * (1 + p.m * sin(2 * M_PI * p.nu * at[i] + p.phase));
    gsl_rng_free(g);
}

static struct modulation find(void)
{
    struct arena *a = arena_open();
    struct modulation m;
    modulation_find(at, amplitude, N, a, &m);
    arena_close(a);
    return m;
}

START_TEST(test_found)
{
    const struct planted sets[] = {{0.3, 6, 1, -0.97, 0.07, 0.03},
                                   {0.3, 47.3, 5, -0.95, 0.2, 0.04},
                                   {0.1, 3, 0, 0, 0, 0.1},
                                   {0.8, 10, 2, -0.97, 0.07, 0.03}};
    enum { SEEDS = 6 };
    for (size_t k = 0; k < sizeof sets / sizeof sets[0]; k++) {
        double squares = 0;
        for (int seed = 1; seed <= SEEDS; seed++) {
            plant(sets[k], 100 * k + seed);
            struct modulation m = find();
            ck_assert_msg(m.found && m.probability < MODULATION_PROBABILITY, "set %zu, seed %d: probability %g", k,
                          seed, m.probability);
            double z = (m.depth - sets[k].m) / m.depth_error, r = (m.rate - sets[k].nu) / m.rate_error;
            ck_assert_msg(fabs(z) < 4 && fabs(r) < 4, "set %zu, seed %d: %g +- %g, %g +- %g Hz", k, seed, m.depth,
                          m.depth_error, m.rate, m.rate_error);
            double turns =
                (2 * M_PI * (m.rate - sets[k].nu) * 5.5 + m.phase - sets[k].phase) / (2 * M_PI); /* in the middle */
            ck_assert_msg(fabs(turns - rint(turns)) < 0.1, "set %zu, seed %d: %g turns off", k, seed, turns);
            squares += (z * z + r * r) / (2 * SEEDS);
        }
        ck_assert_msg(squares > 0.18 && squares < 2.75, "set %zu: mean square %g errors", k,
                      squares); /* chi-squared of 12 over 12: 0.18 to 2.75 but for 1 in 1000 */
    }
}
END_TEST

START_TEST(test_none)
{
    enum { SEEDS = 75 };
    const double sets[][2] = {{-0.97, 0.07}, {-0.93, 0.32}, {0, 0}};
    int found = 0, half = 0, low = 0;
    for (int seed = 0; seed < SEEDS; seed++) {
        plant((struct planted){0, 0, 0, sets[seed % 3][0], sets[seed % 3][1], 0.03}, 7000 + seed);
        struct modulation m = find();
        ck_assert(m.depth > 0 && m.rate >= 2 / (at[N - 1] - at[0]) * (1 - 1e-12) &&
                  m.rate <= 0.5 * N / (at[N - 1] - at[0]));
        found += m.found;
        low += m.probability < 0.05;
        half += m.probability < 0.5;
    }
    ck_assert_msg(found <= 1, "%d of 75 found", found);
    ck_assert_msg(low <= 11 && half >= 17 && half <= 53, "probability below 0.05: %d, below 0.5: %d, of 75", low,
                  half); /* an upper bound that is near: 3.5 deviations above, and not far below */
}
END_TEST

START_TEST(test_divided)
{
    double rest[N], variance[2] = {0};
    plant((struct planted){0.3, 6, 1, -0.5, 0, 0.02}, 5);
    struct modulation m = find();
    modulation_divide(&m, at, amplitude, N, rest);
    for (int i = 0; i < N; i++) {
        variance[0] += (rest[i] - 0.4) * (rest[i] - 0.4) / N;
        variance[1] += (amplitude[i] - 0.4) * (amplitude[i] - 0.4) / N;
    }
    double is = 0.02 * 0.02 / (1 - 0.25);
    ck_assert_msg(fabs(variance[0] / is - 1) < 0.2 && variance[1] > 10 * is, "%g %g, of %g", variance[0], variance[1],
                  is);
}
END_TEST

START_TEST(test_nothing_to_find)
{
    plant((struct planted){0.3, 6, 1, 0, 0, 0}, 5); /* of a constant: all of it is modulation */
    struct modulation m = find();
    ck_assert(m.found && fabs(m.depth - 0.3) < 1e-6 && fabs(m.rate - 6) < 1e-6);
    for (int i = 0; i < N; i++)
        amplitude[i] = 2;
    m = find();
    ck_assert(!m.found && m.depth == 0 && m.probability == 1);
    plant((struct planted){0.3, 6, 1, 0, 0, 1}, 6);
    for (int i = 0; i < N; i++)
        amplitude[i] *= (i & 1) ? 1 : -1; /* signed: no mean */
    m = find();
    ck_assert(!m.found && m.probability == 1);
    for (int i = 0; i < N; i++) { /* regular times, a share near 1, many times as often as half the impacts */
        at[i] = i * 1e-3;
        amplitude[i] = 1 + 0.999 * sin(2 * M_PI * 800 * at[i]) + 1e-3 * (i % 3);
    }
    m = find();
    ck_assert(isfinite(m.depth) && isfinite(m.rate));
}
END_TEST

UNIT("modulation", test_found, test_none, test_divided, test_nothing_to_find)
