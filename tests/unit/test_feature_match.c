/* Modes matched as points: closed forms of few features, drawn sets that match themselves, and what no set may do. */
#include "unit.h"

#include "analysis/feature_match.h"
#include "num/noise.h"
#include "num/real.h"

static struct arena *a;

static void near(double value, double expected, double error) { ck_assert_double_eq_tol(value, expected, error); }

static struct feature_match solve(const struct feature *f, int n, const struct feature *g, int m)
{
    struct feature_match match;
    if (!a) a = arena_open();
    feature_match(f, n, g, m, NULL, a, &match);
    return match;
}

/* The frequency that lies so many Bark above another: Traunmueller's formula the other way round. */
static double above(double frequency, double bark)
{
    double z = feature_match_bark(frequency) + bark;
    return 1960.0 * (z + 0.53) / (26.28 - z);
}

static void draw(int seed, int n, struct feature *f)
{
    struct noise s = noise_make((uint64_t)seed, "features");
    for (int i = 0; i < n; i++)
        f[i] = (struct feature){80.0 * real_exp(5.0 * noise_uniform(s, 0, (uint64_t)i)),
                                2.0 * real_exp(3.0 * noise_uniform(s, 1, (uint64_t)i)),
                                real_exp(12.0 * noise_uniform(s, 2, (uint64_t)i))};
}

/* Modes lie within a unit of each other again and again; each set stands for itself, in any order of its features. */
START_TEST(itself)
{
    enum { N = 200 };
    struct feature f[N], g[N];
    for (int seed = 0; seed < 8; seed++) {
        draw(seed, N, f);
        for (int i = 0; i < N; i++)
            g[i] = f[(i * 77 + 5) % N];
        struct feature_match match = solve(f, N, g, N);
        for (int i = 0; i < N; i++)
            ck_assert_msg(match.reference[i] == 1.0 && match.estimated[i] == 1.0, "feature %d: %g, %g", i,
                          match.reference[i], match.estimated[i]);
        near(match.score, 1, 1e-15);
    }
}
END_TEST

/* Frequency off by 0.03 Bark, decay by e^0.1: D = hypot(0.3, 0.4). */
START_TEST(distance)
{
    struct feature f = {1000, 20, 1}, g = {above(1000, 0.03), 20 * real_exp(0.1), 5};
    near(feature_match_bark(1000), 8.52743, 1e-5);
    struct feature_match match = solve(&f, 1, &g, 1);
    near(match.reference[0], 0.5, 1e-9);
    near(match.estimated[0], 0.5, 1e-9);
    g.frequency = above(1000, 0.11);
    ck_assert(solve(&f, 1, &g, 1).score == 0);
}
END_TEST

/* One estimated feature between two references goes to the nearer; two of them fill one reference up. */
START_TEST(shares)
{
    struct feature two[2] = {{1000, 20, 1}, {above(1000, 0.1), 20, 100}}, one = {above(1000, 0.04), 20, 1};
    struct feature_match match = solve(two, 2, &one, 1);
    near(match.reference[0], 0.6, 1e-9);
    ck_assert(match.reference[1] == 0);
    near(match.estimated[0], 1, 1e-9); /* it has two references, of which either would do in part */
    near(match.represented, 0.6 / 101, 1e-9);
    match = solve(&one, 1, two, 2);
    near(match.reference[0], 1, 1e-9);
}
END_TEST

/* The asymmetric mean rewards a set of thousands; the score does not. */
START_TEST(many)
{
    enum { N = 20, M = 4000 };
    struct feature f[N];
    static struct feature g[M];
    for (int seed = 0; seed < 4; seed++) {
        draw(seed, N, f);
        for (int j = 0; j < M; j++)
            g[j] = (struct feature){80.0 * real_exp(5.0 * (j % 400) / 400.0), 2.0 * real_exp(0.3 * (j / 400)), 1};
        struct feature_match match = solve(f, N, g, M);
        ck_assert(match.represented > 0.6);
        ck_assert(match.found < 0.05);
        ck_assert(match.score < 0.55);
    }
}
END_TEST

/* R is in [0, 1], and exchange of the sets exchanges the results. A wider unit of frequency brings a match nearer. */
START_TEST(bounds)
{
    enum { N = 60, M = 90 };
    struct feature f[N], g[M];
    for (int seed = 0; seed < 8; seed++) {
        draw(seed, N, f);
        draw(seed + 1000, M, g);
        for (int j = 0; j < N; j++)
            g[j].frequency = f[j].frequency * (1 + 0.002 * (j % 7)), g[j].decay = f[j].decay * (1 + 0.03 * (j % 5));
        struct feature_match match = solve(f, N, g, M), back = solve(g, M, f, N);
        double given = 0;
        for (int i = 0; i < N; i++) {
            ck_assert(match.reference[i] >= 0 && match.reference[i] <= 1);
            ck_assert(match.reference[i] == back.estimated[i]);
            given += match.reference[i];
        }
        ck_assert(given > 10 && given <= N);
        for (int j = 0; j < M; j++)
            ck_assert(match.estimated[j] == back.reference[j]);
        ck_assert(match.score == back.score);
        struct feature far = {above(f[0].frequency, 0.15), f[0].decay, 1};
        struct feature_match_scale wide = {.bark = 0.2, .decay = 0.5};
        feature_match(f, 1, &far, 1, &wide, a, &match);
        near(match.reference[0], 0.25, 1e-9);
    }
}
END_TEST

START_TEST(durations)
{
    struct feature f[2] = {{500, 10, 1}, {3000, 30, 1}}, g[2] = {{500, 11, 1}, {3000, 60, 1}};
    struct feature_match match;
    struct feature_match_scale linear = {.durations = true};
    a = arena_open();
    feature_match(f, 2, g, 2, &linear, a, &match);
    double unit = 0.25 * (1.0 / 10 + 1.0 / 30) / 2;
    near(match.reference[0], 1 - (1.0 / 10 - 1.0 / 11) / unit, 1e-12);
    near(match.reference[1], 0, 1e-12);
    near(solve(f, 2, g, 2).reference[0], 1 - real_log(1.1) / 0.25, 1e-12);
}
END_TEST

START_TEST(empty)
{
    struct feature f = {440, 3, 0};
    ck_assert(solve(&f, 1, NULL, 0).score == 0);
    ck_assert(solve(NULL, 0, &f, 1).score == 0);
    ck_assert(solve(NULL, 0, NULL, 0).score == 0);
    ck_assert(solve(&f, 1, &f, 1).score == 1);
}
END_TEST

UNIT("test_feature_match", itself, distance, shares, many, bounds, durations, empty)
