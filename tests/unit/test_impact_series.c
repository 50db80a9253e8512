/* impact_series: statistics of long series and of the first impacts of many seeds against closed forms of ARMA(1,1), of
   floors, of the log-normal and of stationary point processes. Seeds are fixed, so each statistic is one number; bounds
   are 4 standard errors, which account for the series' correlation. */
#include <gsl/gsl_cdf.h>

#include "impacts.h"

enum { LONG = 200000, SEEDS = 4000, LAGS = 20 };

static struct impact_series opened(const struct impact_law *l, uint64_t seed, struct arena *a)
{
    struct impact_series s;
    impact_series_open(l, seed, "ball", a, &s);
    return s;
}

static struct impact next(struct impact_series *s)
{
    struct impact i;
    impact_series_next(s, &i);
    return i;
}

/* Table I's filters and deviations at a roughness, with means so far above the floors that none is met. */
static struct contact unlimited(double roughness)
{
    double r = roughness;
    return impacts_custom(
        (struct impact_draws){10, 0.04, -0.97 + 0.04 * r, 0.07 + 0.25 * r, DISTRIBUTION_GAUSSIAN, NULL},
        (struct impact_draws){1, (0.19 + 0.66 * r) * 1e-3, -0.97 + 0.04 * r, -0.34 + 0.69 * r, DISTRIBUTION_GAUSSIAN,
                              NULL});
}

/* ------------------------------------------------------------------ ARMA */

/* Of ARMA(1,1), X = (1 + b z)/(1 + a z) E, by the recursion of its autocovariance: g0 = v (1 + b^2 - 2 a b)/(1 - a^2),
 * g1 = -a g0 + b v, g_k = -a g_(k-1). */
static double covariance(const struct impact_draws *d, int lag)
{
    double a = d->a1, b = d->b1, v = d->deviation * d->deviation, g = v * (1 + b * b - 2 * a * b) / (1 - a * a);
    lag = abs(lag);
    return lag == 0 ? g : (b * v - a * g) * pow(-a, lag - 1);
}

enum { FAR = 4000 };

/* Variances of the mean and of the sample variance of n Gaussian values: sums of g_k and 2 g_k^2 over n. */
static double variance_of_mean(const struct impact_draws *d, double n)
{
    double sum = 0;
    for (int k = -FAR; k <= FAR; k++)
        sum += covariance(d, k);
    return sum / n;
}

static double variance_of_variance(const struct impact_draws *d, double n)
{
    double sum = 0;
    for (int k = -FAR; k <= FAR; k++)
        sum += 2 * pow(covariance(d, k), 2);
    return sum / n;
}

/* Bartlett's, of the autocorrelation at a lag. */
static double variance_of_correlation(const struct impact_draws *d, int lag, double n)
{
    double sum = 0, g = covariance(d, 0), at = covariance(d, lag) / g;
    for (int k = 1; k <= FAR; k++)
        sum += pow((covariance(d, k + lag) + covariance(d, k - lag) - 2 * at * covariance(d, k)) / g, 2);
    return sum / n;
}

static void statistics(const double *x, long n, double *mean, double *variance)
{
    *mean = *variance = 0;
    for (long i = 0; i < n; i++)
        *mean += x[i] / (double)n;
    for (long i = 0; i < n; i++)
        *variance += (x[i] - *mean) * (x[i] - *mean) / (double)n;
}

static void near(const double *x, long n, const struct impact_draws *d, double about)
{
    double mean, variance;
    statistics(x, n, &mean, &variance);
    ck_assert_double_eq_tol(mean, about, 4 * sqrt(variance_of_mean(d, (double)n)));
    ck_assert_double_eq_tol(variance, covariance(d, 0),
                            4 * sqrt(variance_of_variance(d, (double)n)) + variance_of_mean(d, (double)n));
    for (int lag = 1; lag <= LAGS; lag++) {
        double sum = 0;
        for (long i = lag; i < n; i++)
            sum += (x[i] - mean) * (x[i - lag] - mean) / (double)n;
        ck_assert_double_eq_tol(sum / variance, covariance(d, lag) / covariance(d, 0),
                                4 * sqrt(variance_of_correlation(d, lag, (double)n)) + 2e-4);
    }
}

static double taken[2][LONG];

static long take(struct impact_series *s, unsigned *limited)
{
    long count = 0;
    for (long i = 0; i < LONG; i++) {
        struct impact one = next(s);
        taken[0][i] = one.amplitude;
        taken[1][i] = one.interval;
        count += limited && (one.limited & *limited);
    }
    return count;
}

START_TEST(long_series)
{
    struct arena *a = arena_open();
    for (int r = 0; r <= 2; r++) {
        struct contact c = unlimited(r / 2.0);
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_series s = opened(&l, 5, a);
        unsigned any = ~0u;
        ck_assert_int_eq(take(&s, &any), 0);
        near(taken[0], LONG, &impacts_in(&c)->amplitude, 10);
        near(taken[1], LONG, &impacts_in(&c)->interval, 1);
    }
    arena_close(a);
}
END_TEST

/* An exponential process, whose mean passes the filter: means and variances (fourth cumulant 6 of a white value, so
   that the variance of the sample variance is that of a Gaussian plus 6 g0^2 / n). */
START_TEST(exponential_draws)
{
    struct arena *a = arena_open();
    struct impact_draws d = {1, 0.5, -0.6, 0.3, DISTRIBUTION_EXPONENTIAL, NULL};
    struct contact c = impacts_custom(d, d);
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_series s = opened(&l, 6, a);
    double mean, variance, g = covariance(&d, 0);
    take(&s, NULL);
    for (int k = 0; k < 2; k++) {
        statistics(taken[k], LONG, &mean, &variance);
        ck_assert_double_eq_tol(mean, 1 + 0.5 * 1.3 / 0.4, 4 * sqrt(variance_of_mean(&d, LONG)));
        ck_assert_double_eq_tol(variance, g, 4 * sqrt(variance_of_variance(&d, LONG) + 6 * g * g / LONG));
    }
    arena_close(a);
}
END_TEST

/* E_n and its like are had back by inverting the filters: one process drives both, or two do. */
START_TEST(one_process_or_two)
{
    struct arena *a = arena_open();
    for (int two = 0; two <= 1; two++) {
        struct contact c = unlimited(0.5);
        impacts_in(&c)->processes = two ? PROCESSES_TWO : PROCESSES_ONE;
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_series s = opened(&l, 7, a);
        const struct impact_draws *d[2] = {&impacts_in(&c)->amplitude, &impacts_in(&c)->interval};
        double e[2] = {0}, sums[3] = {0};
        take(&s, NULL);
        for (long i = 1; i < LONG; i++) {
            for (int k = 0; k < 2; k++)
                e[k] = taken[k][i] - d[k]->mean + d[k]->a1 * (taken[k][i - 1] - d[k]->mean) - d[k]->b1 * e[k];
            if (i > 1000) /* the first E is not known, and is forgotten as b1^n */
                sums[0] += e[0] * e[1], sums[1] += e[0] * e[0], sums[2] += e[1] * e[1];
        }
        double correlation = sums[0] / sqrt(sums[1] * sums[2]);
        if (two)
            ck_assert_double_le(fabs(correlation), 4 / sqrt(LONG));
        else
            ck_assert_double_eq_tol(correlation, 1,
                                    1e-6); /* intervals of 1 s are differences of times: rounded to 1e-11 s of 0.5 ms */
    }
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ floors */

/* Share of LONG impacts that are limited, and its standard error by means of 100 batches. */
static double limited_share(struct impact_series *s, unsigned flag, double *error)
{
    double sum = 0, square = 0;
    for (int b = 0; b < 100; b++) {
        double share = 0;
        for (int i = 0; i < LONG / 100; i++)
            share += (next(s).limited & flag) ? 100.0 / LONG : 0;
        sum += share / 100;
        square += share * share / 100;
    }
    *error = sqrt((square - sum * sum) / 99);
    return sum;
}

/* Rolling: 0.72, 1.07, 2.85 % of the amplitudes fall below 0, a little more below their floor; 0, 0.23, 1.9 % of the
 * intervals below theirs. */
START_TEST(floors_are_met_as_often_as_a_gaussian_falls_below)
{
    static const double below_0[3] = {0.0072, 0.0107, 0.0285}, intervals[3] = {0, 0.0023, 0.019};
    struct arena *a = arena_open();
    for (int r = 0; r <= 2; r++) {
        struct contact c = impacts_contact(PROTOTYPE_ROLL);
        impacts_in(&c)->roughness = r / 2.0;
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_parameters p = impacts_at(&l, 0);
        for (int k = 0; k < 2; k++) {
            double deviation = k ? (0.19 + 0.33 * r) * 1e-3 : 0.04, a1 = p.a1[k], b1 = p.b1[k], error;
            double series = deviation * sqrt((1 + b1 * b1 - 2 * a1 * b1) / (1 - a1 * a1)),
                   least = k ? SAMPLE : 0.01 * p.mean[0];
            double expected = gsl_cdf_gaussian_P(least - p.mean[k], series);
            struct impact_series s = opened(&l, 8, a);
            double share = limited_share(&s, k ? IMPACT_LIMITED_INTERVAL : IMPACT_LIMITED_AMPLITUDE, &error);
            ck_assert_double_eq_tol(share, expected, 4 * error + 1e-6);
            ck_assert_double_eq_tol(gsl_cdf_gaussian_P(-p.mean[k] + (k ? SAMPLE : 0), series),
                                    k ? intervals[r] : below_0[r], 6e-5 + (k ? 4e-4 : 0));
        }
    }
    arena_close(a);
}
END_TEST

/* Nothing is below a floor, what is not limited is above it, and the filter goes on from what was drawn: with the same
   numbers and no floors the series is the same. */
START_TEST(floors_change_nothing_else)
{
    struct arena *a = arena_open();
    struct contact c = impacts_contact(PROTOTYPE_ROLL), free = c;
    impacts_in(&c)->depth = impacts_in(&free)->depth = 0;
    impacts_in(&c)->least_interval = 1e-3;
    impacts_in(&free)->prototype = PROTOTYPE_CUSTOM;
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_parameters p = impacts_at(&l, 0);
    impacts_in(&free)->amplitude =
        (struct impact_draws){p.mean[0], 0.04, p.a1[0], p.b1[0], DISTRIBUTION_GAUSSIAN, NULL};
    impacts_in(&free)->interval =
        (struct impact_draws){p.mean[1], 0.52e-3, p.a1[1], p.b1[1], DISTRIBUTION_GAUSSIAN, NULL};
    impacts_in(&free)->zeta = p.zeta;
    struct impact_law other = impacts_law(&free, 1, a);
    struct impact_series s = opened(&l, 3, a), t = s;
    long count[2] = {0};
    t.law = &other;
    for (int i = 0; i < 50000; i++) {
        struct impact one = next(&s), two = next(&t);
        ck_assert_double_eq(one.amplitude, fmax(two.amplitude, p.least_amplitude));
        ck_assert_double_eq_tol(one.interval, fmax(two.interval, 1e-3), 1e-18 + (two.limited ? 1 : 0));
        ck_assert_int_eq((one.limited & IMPACT_LIMITED_AMPLITUDE) != 0, two.amplitude < p.least_amplitude);
        ck_assert_int_eq((one.limited & IMPACT_LIMITED_INTERVAL) != 0, two.interval < 1e-3);
        count[0] += (one.limited & IMPACT_LIMITED_AMPLITUDE) != 0;
        count[1] += (one.limited & IMPACT_LIMITED_INTERVAL) != 0;
    }
    ck_assert(count[0] > 300 && count[1] > 300);
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ log-normal */

/* ln A is Gaussian, of the ARMA's own correlations: its mean and variance to 4 standard errors of such a series; those
 * of A are then 002's. */
START_TEST(log_normal)
{
    struct arena *a = arena_open();
    struct contact c = impacts_contact(PROTOTYPE_ROLL);
    impacts_in(&c)->roughness = 1;
    impacts_in(&c)->depth = 0;
    impacts_in(&c)->marginal = MARGINAL_LOGNORMAL;
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_parameters p = impacts_at(&l, 0);
    struct impact_series s = opened(&l, 9, a);
    unsigned any = ~0u;
    ck_assert_int_eq(take(&s, &any), 0);
    for (int k = 0; k < 2; k++) {
        struct impact_draws d = {p.mean[k], k ? 0.85e-3 : 0.04, p.a1[k], p.b1[k], DISTRIBUTION_GAUSSIAN, NULL};
        double variance = covariance(&d, 0), mean = p.mean[k], wide = log(1 + variance / (mean * mean)),
               middle = log(mean) - wide / 2, got[2], error[2];
        statistics(taken[k], LONG, &got[0], &got[1]); /* errors: those of ln A, carried over */
        error[0] = mean * sqrt(variance_of_mean(&d, LONG) * (exp(wide) - 1) / variance);
        error[1] = variance * 4 * sqrt(variance_of_variance(&d, LONG)) / variance;
        ck_assert_double_eq_tol(got[0], mean, 4 * error[0]);
        ck_assert_double_eq_tol(got[1], variance, 4 * error[1]);
        for (long i = 0; i < LONG; i++)
            taken[k][i] = log(taken[k][i]);
        d.deviation *= sqrt(wide / variance);
        near(taken[k], LONG, &d, middle);
    }
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ the start */

/* Of 4000 seeds, the very first impact: amplitudes that know nothing of the intervals have the stationary mean,
   variance and (with the second impact) lag-1 correlation at once. */
START_TEST(amplitudes_are_stationary_from_the_first_impact_on)
{
    struct arena *a = arena_open();
    struct contact c = unlimited(0);
    const struct impact_draws *d = &impacts_in(&c)->amplitude;
    impacts_in(&c)->processes = PROCESSES_TWO;
    struct impact_law l = impacts_law(&c, 1, a);
    double x[2][SEEDS], mean, variance, both = 0, g = covariance(d, 0), at = covariance(d, 1) / g;
    for (int i = 0; i < SEEDS; i++) {
        struct impact_series s = opened(&l, (uint64_t)i, a);
        for (int k = 0; k < 2; k++)
            x[k][i] = next(&s).amplitude;
    }
    for (int k = 0; k < 2; k++) {
        statistics(x[k], SEEDS, &mean, &variance);
        ck_assert_double_eq_tol(mean, 10, 4 * sqrt(g / SEEDS));
        ck_assert_double_eq_tol(variance, g, 4 * g * sqrt(2.0 / SEEDS));
    }
    for (int i = 0; i < SEEDS; i++)
        both += (x[0][i] - 10) * (x[1][i] - 10) / g / SEEDS;
    ck_assert_double_eq_tol(both, at, 4 * sqrt((1 + at * at) / SEEDS));
    arena_close(a);
}
END_TEST

/* The first amplitude is the sum over all of the past, X_n = E_n + (b1 - a1) (E_(n-1) - a1 E_(n-2) + a1^2 E_(n-3) -
   ...), of W_n, the numbers of the contact's stream: so long ago the series began. To the rounding of 10. */
START_TEST(nothing_is_left_of_the_beginning)
{
    struct arena *a = arena_open();
    struct noise noise = noise_make(21, "impacts/ball");
    for (int r = 0; r <= 1; r++) {
        struct contact c = unlimited(r);
        const struct impact_draws *d = &impacts_in(&c)->amplitude;
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_series s = opened(&l, 21, a);
        double sum = gsl_cdf_gaussian_Pinv(noise_uniform(noise, (uint64_t)s.number, 0), 0.04), factor = d->b1 - d->a1;
        for (int k = 1; k < 3000; k++, factor *= -d->a1)
            sum += factor * gsl_cdf_gaussian_Pinv(noise_uniform(noise, (uint64_t)(s.number - k), 0), 0.04);
        ck_assert_double_eq_tol(next(&s).amplitude, 10 + sum, 2e-14);
    }
    arena_close(a);
}
END_TEST

/* The time to the first impact after 0 of a stationary point process, of intervals of any kind and correlation: mean
   E[T^2] / (2 E[T]) and square E[T^3] / (3 E[T]), T the interval as a typical impact sees it. Durations are short, so
   that what is not over at 0 has its middle after -5 us. */
static void phases(const struct contact *c, double t1, double t2, double t3)
{
    struct arena *a = arena_open();
    struct impact_law l = impacts_law(c, 1, a);
    double sums[3] = {0}; /* of t, t^2, t^4 */
    for (int i = 0; i < SEEDS; i++) {
        struct impact_series s = opened(&l, (uint64_t)i, a);
        double time = next(&s).time;
        ck_assert_double_gt(time, -0.5 * l.longest);
        sums[0] += time / SEEDS;
        sums[1] += time * time / SEEDS;
        sums[2] += pow(time, 4) / SEEDS;
    }
    ck_assert_double_eq_tol(sums[0], t2 / (2 * t1), 4 * sqrt((sums[1] - sums[0] * sums[0]) / SEEDS) + SAMPLE / 2);
    ck_assert_double_eq_tol(sums[1], t3 / (3 * t1), 4 * sqrt((sums[2] - sums[1] * sums[1]) / SEEDS) + SAMPLE * t1);
    arena_close(a);
}

START_TEST(the_first_impact_comes_at_any_phase)
{
    struct contact c = impacts_contact(PROTOTYPE_SCRATCH);
    phases(&c, 0.01, 2e-4, 6e-6);
    double regular[] = {0, 1e-5, 2e-4, 1e-3, 3e-3};
    for (int i = 0; i < 5; i++) { /* T normal: E[T^2] = m^2 + v, E[T^3] = m^3 + 3 m v; floors, 3.3 deviations off at the
                                     most, change 1e-4 */
        double v = regular[i] * regular[i];
        c = impacts_custom((struct impact_draws){1, 0.1, 0, 0, DISTRIBUTION_GAUSSIAN, NULL},
                           (struct impact_draws){0.01, regular[i], 0, 0, DISTRIBUTION_GAUSSIAN, NULL});
        phases(&c, 0.01, 1e-4 + v, 1e-6 + 0.03 * v);
    }
    c = impacts_contact(PROTOTYPE_ROLL);
    struct impact_draws d = {0, 0.19e-3, -0.97, -0.34, DISTRIBUTION_GAUSSIAN, NULL};
    double m = 3.1e-3, v = covariance(&d, 0);
    impacts_in(&c)->roughness = 0;
    impacts_in(&c)->zeta = 1e-7;
    phases(&c, m, m * m + v, m * m * m + 3 * m * v);
}
END_TEST

/* Impacts that last long: the series begins with one that began before 0, and the one before it was over. */
START_TEST(what_is_not_over_at_the_start)
{
    struct arena *a = arena_open();
    struct contact c = impacts_contact(PROTOTYPE_SCRATCH);
    impacts_in(&c)->scratch.interval = 1e-4;
    impacts_in(&c)->scratch.duration = 0.05;
    struct impact_law l = impacts_law(&c, 1, a);
    double first = 0, count = 0;
    for (int i = 0; i < 1000; i++) {
        struct impact_series s = opened(&l, (uint64_t)i, a);
        struct impact one = next(&s);
        ck_assert_double_gt(one.time, -0.025);
        first += (one.time + 0.025) / 1000;
        for (; one.time <= 0; one = next(&s))
            count += 1 / 1000.0;
    }
    double least = SAMPLE / 1e-4, mean = 1e-4 * (least + exp(-least)),
           square = 1e-8 * (least * least + 2 * exp(-least) * (1 + least)); /* of max(T, floor) */
    ck_assert_double_eq_tol(first, square / (2 * mean), 4 * 1e-4 / sqrt(1000));
    ck_assert_double_eq_tol(count, 0.025 / mean, 4 * sqrt(250 / 1000.0)); /* Poisson's error, a little too much */
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ modulation and durations */

START_TEST(modulation_and_durations)
{
    struct arena *a = arena_open();
    struct contact c = impacts_contact(PROTOTYPE_ROLL);
    struct impacts *m = impacts_in(&c);
    m->amplitude.deviation = 0;
    m->depth = 0.7, m->rate = 6.3, m->size = 0.4, m->unit_force = 5;
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_series s = opened(&l, 11, a);
    double mean = 0.35, low = HUGE_VAL, high = 0;
    for (int i = 0; i < 5000; i++) {
        struct impact one = next(&s);
        double amplitude = mean * (1 + 0.7 * sin(2 * M_PI * 6.3 * one.time));
        ck_assert_double_eq_tol(one.amplitude, 5 * amplitude, 1e-11);
        ck_assert_double_eq_tol(one.duration, 7.88e-4 * 0.4 * pow(amplitude, -0.29), 1e-12);
        low = fmin(low, amplitude), high = fmax(high, amplitude);
    }
    ck_assert(low < 0.31 * mean && high > 1.69 * mean);
    arena_close(a);
}
END_TEST

/* Signs stay where there is no floor, and durations follow |A| down to the least that counts. */
START_TEST(signs_stay)
{
    struct arena *a = arena_open();
    struct contact c = impacts_custom((struct impact_draws){0, 1, -0.5, 0, DISTRIBUTION_GAUSSIAN, NULL},
                                      (struct impact_draws){0.01, 0.001, 0, 0, DISTRIBUTION_GAUSSIAN, NULL});
    impacts_in(&c)->theta = 0.5;
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_series s = opened(&l, 12, a);
    double shortest = 0.01 * sqrt(4 / 3.0);
    int negative = 0, counted = 0;
    for (int i = 0; i < 10000; i++) {
        struct impact one = next(&s);
        ck_assert_double_eq_tol(one.duration, 1e-5 / sqrt(fmax(fabs(one.amplitude), shortest)), 1e-15);
        ck_assert(!one.limited && one.duration <= l.longest);
        negative += one.amplitude < 0;
        counted += fabs(one.amplitude) < shortest;
    }
    ck_assert(abs(negative - 5000) < 4 * 50 * 2 &&
              counted > 40); /* correlated: standard error up to sqrt(3) times 50 */
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ seeds, walks */

START_TEST(seeds_and_names)
{
    struct arena *a = arena_open();
    struct contact c = impacts_contact(PROTOTYPE_ROLL);
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_series s[4];
    impact_series_open(&l, 1, "ball", a, &s[0]);
    impact_series_open(&l, 1, "ball", a, &s[1]);
    impact_series_open(&l, 2, "ball", a, &s[2]);
    impact_series_open(&l, 1, "marble", a, &s[3]);
    for (int i = 0; i < 1000; i++) {
        struct impact one[4];
        for (int k = 0; k < 4; k++)
            impact_series_next(&s[k], &one[k]);
        ck_assert(one[1].time == one[0].time && one[1].amplitude == one[0].amplitude &&
                  one[1].interval == one[0].interval && one[1].duration == one[0].duration);
        ck_assert(one[2].time != one[0].time && one[2].amplitude != one[0].amplitude && one[3].time != one[0].time &&
                  one[3].amplitude != one[0].amplitude);
    }
    arena_close(a);
}
END_TEST

struct seen {
    long count, signs[2], near[3];
    double most;
};

/* 3 s of it: finite, never longer than told, times that rise; the modulation's phase, a sum over all intervals, is 3 Hz
 * times the time. */
static void walked(const struct impact_law *l, uint64_t seed, struct seen *seen, struct arena *a)
{
    struct impact_series s = opened(l, seed, a);
    struct impact one = {0}, before = {.time = -1};
    double phase = s.phase - 3 * s.time;
    for (; one.time < 3; before = one, seen->count++) {
        struct impact_parameters p = impacts_at(l, s.time);
        one = next(&s);
        ck_assert(isfinite(one.amplitude) && isfinite(one.interval) && isfinite(one.duration) && one.duration > 0 &&
                  one.duration <= l->longest);
        ck_assert(one.interval >= SAMPLE && one.time > before.time);
        ck_assert_double_eq_tol(remainder(s.phase - 3 * s.time - phase, 1), 0, 1e-11);
        for (int k = 0; k < 3; k++)
            seen->near[k] += p.share[k] > 0.9;
        seen->signs[one.amplitude < 0]++;
        seen->most = fmax(seen->most, fabs(one.amplitude));
    }
}

/* Back and forth between all anchors and the centre, every few milliseconds. Of 10^4 normal amplitudes of deviation
   0.18 at the most (roll's series; 0.15 of the others) none is beyond 0.43 + 5 deviations. */
START_TEST(a_fast_walk)
{
    char path[32], text[20000];
    struct arena *a = arena_open();
    struct seen seen = {0};
    size_t used = (size_t)snprintf(text, sizeof text, "time_s,angle_deg,radius\n");
    for (int i = 0; i < 600; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%g,%d,%g\n", i * 0.005, 120 * (i * 7 % 11) - 360,
                                 (i % 5 - 2) / 2.0);
    impacts_file(path, text);
    struct contact c = impacts_contact(PROTOTYPE_SPACE);
    impacts_in(&c)->walk = path;
    impacts_in(&c)->rub.duration = 1e-3;
    struct impact_law l = impacts_law(&c, 3, a);
    unlink(path);
    for (uint64_t seed = 0; seed < 20; seed++)
        walked(&l, seed, &seen, a);
    ck_assert(seen.count > 8000 && seen.signs[0] > 1000 && seen.signs[1] > 1000 && seen.near[0] > 20 &&
              seen.near[1] > 20 && seen.near[2] > 20);
    ck_assert_double_lt(seen.most, 1.35);
    arena_close(a);
}
END_TEST

UNIT("impact_series", long_series, exponential_draws, one_process_or_two,
     floors_are_met_as_often_as_a_gaussian_falls_below, floors_change_nothing_else, log_normal,
     amplitudes_are_stationary_from_the_first_impact_on, nothing_is_left_of_the_beginning,
     the_first_impact_comes_at_any_phase, what_is_not_over_at_the_start, modulation_and_durations, signs_stay,
     seeds_and_names, a_fast_walk)
