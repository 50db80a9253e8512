/* impact_duration: a law that holds exactly, with scatter (the error told against that of many repetitions), outliers
   that run into each other, what cannot be told; and a train of bounces, whose law is closed form. */
#include <gsl/gsl_randist.h>

#include "analysis/impact_find.h"
#include "contacts.h"
#include "force/strike.h"

enum { N = 200 };

static double amplitude[N], duration[N], times[N];
static bool alone[N];

static struct impact_events events(double zeta, double theta, double scatter, gsl_rng *r)
{
    for (int i = 0; i < N; i++) {
        amplitude[i] = (i % 2 ? -1 : 1) * exp(2 * gsl_rng_uniform(r));
        duration[i] = zeta * pow(fabs(amplitude[i]), -theta) * exp(scatter * gsl_ran_gaussian(r, 1));
        alone[i] = true;
        times[i] = i;
    }
    return (struct impact_events){N, times, amplitude, duration, alone, 0, {0}};
}

START_TEST(exact)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    struct impact_events v = events(7.88e-4, 0.29, 0, r);
    struct impact_duration d = {.theta = NAN};
    ck_assert(impact_find_duration_single(&v, true, &d));
    ck_assert_double_eq_tol(d.theta, 0.29, 1e-13);
    ck_assert_double_eq_tol(d.zeta_single / 7.88e-4, 1, 1e-13);
    ck_assert_double_eq_tol(d.r2_single, 1, 1e-12);
    ck_assert_double_eq_tol(d.r2_single_log, 1, 1e-12);
    ck_assert_int_eq(d.singles, N);
    ck_assert(impact_find_duration_series(&v, &d));
    ck_assert_double_eq_tol(d.zeta / 7.88e-4, 1, 1e-13);
    ck_assert_double_eq_tol(d.r2, 1, 1e-12);
    d.theta = 0; /* given: zeta is the geometric mean, and explains nothing of the logarithm */
    double sum = 0;
    for (int i = 0; i < N; i++)
        sum += log(duration[i]) / N;
    ck_assert(impact_find_duration_series(&v, &d));
    ck_assert_double_eq_tol(d.zeta / exp(sum), 1, 1e-13);
    ck_assert_double_eq_tol(d.r2_log, 0, 1e-12);
    gsl_rng_free(r);
}
END_TEST

/* The standard error is that of 400 repetitions: its own error is 1/sqrt 800 = 3.5 %, and 4 of them are allowed. */
START_TEST(scattered)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    double sum = 0, squares = 0, errors = 0, r2 = 0;
    for (int k = 0; k < 400; k++) {
        struct impact_events v = events(1e-3, 0.2, 0.1, r);
        struct impact_duration d = {.theta = NAN};
        ck_assert(impact_find_duration_single(&v, true, &d));
        sum += d.theta;
        squares += (d.theta - 0.2) * (d.theta - 0.2);
        errors += d.theta_error * d.theta_error;
        r2 += d.r2_single_log;
    }
    ck_assert_double_eq_tol(sum / 400, 0.2, 4 * sqrt(errors / 400 / 400));
    ck_assert_double_eq_tol(sqrt(squares / errors), 1, 0.14);
    /* variance of the law over all: theta^2 (2^2/12) against the scatter's */
    ck_assert_double_eq_tol(r2 / 400, 0.04 / 3 / (0.04 / 3 + 0.01), 0.02);
    gsl_rng_free(r);
}
END_TEST

START_TEST(outliers)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    struct impact_events v = events(1e-3, 0.25, 0, r);
    struct impact_duration d = {.theta = NAN};
    for (int i = 0; i < N; i += 4) { /* weak ones seem to last long */
        alone[i] = false;
        duration[i] *= fabs(amplitude[i]) < 2 ? 5 : 1;
    }
    duration[3] = NAN;
    ck_assert(impact_find_duration_single(&v, true, &d));
    ck_assert_int_eq(d.singles, N - N / 4 - 1);
    ck_assert_double_eq_tol(d.theta, 0.25, 1e-12);
    ck_assert(impact_find_duration_series(&v, &d));
    ck_assert_int_eq(d.n, N - 1);
    ck_assert_double_lt(d.r2, 0.9);
    ck_assert(impact_find_duration_single(&v, false, &d));
    ck_assert_double_gt(d.theta, 0.3); /* both at once: spoilt */
    gsl_rng_free(r);
}
END_TEST

START_TEST(untold)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    struct impact_events v = events(1e-3, 0.25, 0, r);
    struct impact_duration d = {.theta = NAN};
    v.n = IMPACT_DURATION_LEAST - 1;
    ck_assert(!impact_find_duration_single(&v, true, &d));
    v.n = N;
    for (int i = 0; i < N; i++)
        amplitude[i] = 2 + 1e-3 * i / N;
    ck_assert(!impact_find_duration_single(&v, true, &d));
    ck_assert_int_eq(d.singles, N);
    for (int i = 0; i < N; i++)
        duration[i] = NAN;
    d.theta = 0.2;
    ck_assert(!impact_find_duration_series(&v, &d));
    struct arena *a = arena_open();
    ck_assert(!impact_find_duration_constant(&v, a, &d));
    for (int i = 0; i < 5; i++)
        duration[7 * i] = (const double[]){3, 1, 9, 2, 100}[i];
    ck_assert(impact_find_duration_constant(&v, a, &d));
    ck_assert_int_eq(d.n, 5);
    ck_assert_double_eq(d.zeta, 3); /* the median, whatever the outlier */
    ck_assert_double_eq(d.theta, 0);
    arena_close(a);
    gsl_rng_free(r);
}
END_TEST

/* An elastic impact of Hertz's lasts 2.943 x/v, x its greatest approach, and m v^2/2 = 2/5 k x^2.5, A = k x^1.5: t0
   = 2.943 sqrt(5 m/(4 k)) (A/k)^(-1/6). rasp scales its force by (1 + e)/2, e the restitution, for the momentum.
   Contact times are measured at 48 kHz from 20 samples on, at 192 kHz from 66. */
START_TEST(bounces)
{
    for (int k = 0; k < 2; k++) {
        double rate = k ? 192000 : 48000, stiffness = k ? 1e8 : 5e7;
        struct contact c = shot_contact(CONTACT_STRIKE, 2);
        struct shot s;
        struct err e = {0};
        struct impact_found f;
        struct impact_duration d = {.theta = NAN};
        shot_strike(&c)->restitution = 0.8;
        shot_strike(&c)->speed = 3;
        shot_strike(&c)->stiffness = stiffness;
        shot_strike(&c)->first = 0.01;
        ck_assert_msg(shot_open(&s, &strike_stage, &c, rate, 4), "%s", s.e.text);
        long n = (long)(1.9 * rate);
        struct impact_signal signal = {shot_decimated(&s, n), n, rate, 0};
        ck_assert(impact_find(&signal, &impact_find_options, s.arena, &f, &e));
        ck_assert(impact_find_duration_single(&f.events, true, &d));
        double zeta = 2.9432751843247045 * sqrt(1.25 * c.scraper.mass / stiffness) * pow(0.9 * stiffness, 1.0 / 6);
        double greatest = f.events.amplitude[0], law = d.zeta_single * pow(greatest, -d.theta);
        ck_assert_double_eq_tol(d.theta, 1.0 / 6, k ? 5e-4 : 3e-3);
        ck_assert_double_eq_tol(law / (zeta * pow(greatest, -1.0 / 6)), 1, 0.01);
        ck_assert_double_ge(d.r2_single, 0.999);
        arena_close(s.arena);
    }
}
END_TEST

UNIT("impact_duration", exact, scattered, outliers, untold, bounces)
