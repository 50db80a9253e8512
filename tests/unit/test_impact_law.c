/* impact_law: shares against hand values, prototypes against the printed numbers, parameters between them,
   distributions and their inverses against GSL and against plain bisection and quadrature, the walk, and what is
   refused. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>

#include "impacts.h"

/* ------------------------------------------------------------------ shares */

START_TEST(shares_by_hand)
{
    static const struct {
        double degrees, radius, share[3];
    } known[] = {
        {0, 1, {1, 0, 0}},
        {60, 1, {0.5, 0.5, 0}},
        {120, 1, {0, 1, 0}},
        {180, 1, {0, 0.5, 0.5}},
        {240, 1, {0, 0, 1}},
        {300, 1, {0.5, 0, 0.5}},
        {360, 1, {1, 0, 0}},
        {-120, 1, {0, 0, 1}},
        {960, 1, {0, 0, 1}},
        {30, 1, {0.75, 0.25, 0}},
        {77, 0, {1 / 3., 1 / 3., 1 / 3.}},
        {0, 0.5, {2 / 3., 1 / 6., 1 / 6.}},
        {60, -1, {0, 0, 1}},
        {0, -1, {0, 0.5, 0.5}},
        {180, -1, {1, 0, 0}},
        {0, -0.5, {1 / 6., 5 / 12., 5 / 12.}},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double share[3];
        impact_law_shares(known[i].degrees * (M_PI / 180), known[i].radius, share);
        for (int k = 0; k < 3; k++) {
            ck_assert_double_eq_tol(share[k], known[i].share[k], 1e-14);
            if (known[i].share[k] == 1) ck_assert_double_eq(share[k], 1); /* an anchor is one */
        }
    }
}
END_TEST

/* T as papers/004 prints it (equation 9), theta in [0, 2 pi). */
static double printed(double theta)
{
    theta -= 2 * M_PI * floor(theta / (2 * M_PI));
    return theta < 2 * M_PI / 3 ? 1 - 3 * theta / (2 * M_PI) : theta < 4 * M_PI / 3 ? 0 : 3 * theta / (2 * M_PI) - 2;
}

START_TEST(shares_are_those_of_the_printed_equations)
{
    for (int i = -3000; i < 3000; i++)
        for (int j = 0; j <= 4; j++) {
            double theta = 2 * M_PI * (i + 0.37) / 1000, r = j / 4.0, share[3], sum = 0;
            impact_law_shares(theta, r, share);
            for (int k = 0; k < 3; k++) {
                ck_assert_double_eq_tol(share[k], (1 - r) / 3 + r * printed(theta - k * 2 * M_PI / 3), 2e-14);
                sum += share[k];
            }
            ck_assert_double_eq_tol(sum, 1, 4e-16);
        }
}
END_TEST

/* No jump, round the rim and through the centre. Shares change by at most 3/(2 pi) per radian, and 1 per radius. */
START_TEST(shares_are_continuous)
{
    double last[3], share[3];
    impact_law_shares(-1e-3, 1, last);
    for (int i = 0; i < 14000; i++) {
        impact_law_shares(i * 1e-3, 1, share);
        for (int k = 0; k < 3; k++)
            ck_assert_double_le(fabs(share[k] - last[k]), 1e-3 * 3 / (2 * M_PI) + 1e-11);
        memcpy(last, share, sizeof last);
    }
    for (int i = -1000; i <= 1000; i++) {
        impact_law_shares(0.3, i / 1000.0, share);
        for (int k = 0; k < 3 && i > -1000; k++)
            ck_assert_double_le(fabs(share[k] - last[k]), 1e-3);
        memcpy(last, share, sizeof last);
    }
}
END_TEST

/* ------------------------------------------------------------------ prototypes */

/* 002's table I as printed, and its middle. Durations of equation 16, modulation of equation 17. */
START_TEST(roll_is_table_1)
{
    static const double printed_table[2][8] = {{0.04, -0.97, 0.07, 0.43, 0.19e-3, -0.97, -0.34, 3.1e-3},
                                               {0.04, -0.93, 0.32, 0.27, 0.85e-3, -0.93, 0.35, 6.4e-3}};
    struct arena *a = arena_open();
    for (int i = 0; i <= 2; i++) {
        struct contact c = impacts_contact(PROTOTYPE_ROLL);
        impacts_in(&c)->roughness = i / 2.0;
        impacts_in(&c)->size = 0.8;
        impacts_in(&c)->velocity = 0.3;
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_parameters p = impacts_at(&l, 0.3);
        for (int s = 0; s < 2; s++) {
            double want[4], mean, variance;
            for (int k = 0; k < 4; k++)
                want[k] = i == 1 ? (printed_table[0][4 * s + k] + printed_table[1][4 * s + k]) / 2
                                 : printed_table[i / 2][4 * s + k];
            double tolerance = i == 1 ? 1e-15 : 0;
            impact_law_moments(&l, s, &p, &mean, &variance);
            ck_assert_double_eq(mean, 0);
            ck_assert_double_eq_tol(sqrt(variance), want[0], 1e-16);
            ck_assert_double_le(fabs(p.a1[s] - want[1]), tolerance);
            ck_assert_double_le(fabs(p.b1[s] - want[2]), tolerance);
            ck_assert_double_le(fabs(p.mean[s] - want[3]), tolerance);
            ck_assert_double_eq_tol(impact_law_draw(&l, s, &p, 0.2), gsl_cdf_gaussian_Pinv(0.2, want[0]), 1e-15);
        }
        ck_assert_double_eq(p.zeta, 7.88e-4 * 0.8);
        ck_assert(p.theta == 0.29 && p.depth == 0.3);
        ck_assert_double_eq_tol(p.rate, 3 * 0.3 / 0.8, 1e-15);
        ck_assert_double_eq(p.least_amplitude, 0.01 * p.mean[IMPACT_AMPLITUDE]);
        ck_assert_double_eq(p.shortest, p.least_amplitude * 0.7);
        ck_assert_double_eq_tol(l.longest, 7.88e-4 * 0.8 * pow(0.007 * p.mean[IMPACT_AMPLITUDE], -0.29),
                                1e-9 * l.longest);
        ck_assert(l.alone == IMPACT_ROLL && p.share[IMPACT_ROLL] == 1 && !l.walk);
    }
    arena_close(a);
}
END_TEST

START_TEST(what_is_given_takes_the_place_of_rolls)
{
    struct arena *a = arena_open();
    struct contact c = impacts_contact(PROTOTYPE_ROLL);
    struct impacts *m = impacts_in(&c);
    m->amplitude = (struct impact_draws){2, 0.5, -0.5, 0.25, DISTRIBUTION_EXPONENTIAL, NULL};
    m->interval = (struct impact_draws){.mean = 0.02, .deviation = NAN, .a1 = NAN, .b1 = 0};
    m->zeta = 1e-3, m->theta = 0.1, m->depth = 0.6, m->rate = 7, m->least_amplitude = 0.05;
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_parameters p = impacts_at(&l, 0);
    double mean, variance;
    ck_assert(p.mean[0] == 2 && p.a1[0] == -0.5 && p.b1[0] == 0.25 && p.mean[1] == 0.02 && p.b1[1] == 0);
    ck_assert_double_eq_tol(p.a1[1], -0.95, 1e-15);
    ck_assert(p.zeta == 1e-3 && p.theta == 0.1 && p.depth == 0.6 && p.rate == 7);
    impact_law_stationary(&l, IMPACT_AMPLITUDE, &p, &mean,
                          &variance); /* 2 + 0.5 1.25/0.5; 0.25 (1 + 1/16 + 1/4)/0.75 */
    ck_assert_double_eq_tol(mean, 3.25, 1e-15);
    ck_assert_double_eq_tol(variance, 0.4375, 1e-15);
    ck_assert_double_eq_tol(p.least_amplitude, 0.05 * 3.25, 1e-15);
    ck_assert_double_eq_tol(p.shortest, 0.01 * sqrt(3.25 * 3.25 + 0.4375), 1e-15);
    ck_assert_double_eq_tol(impact_law_draw(&l, IMPACT_AMPLITUDE, &p, 0.3), -0.5 * log(0.7), 1e-15);
    arena_close(a);
}
END_TEST

START_TEST(rub_and_scratch)
{
    struct arena *a = arena_open();
    for (int k = IMPACT_RUB; k <= IMPACT_SCRATCH; k++) {
        struct contact c = impacts_contact(k == IMPACT_RUB ? PROTOTYPE_RUB : PROTOTYPE_SCRATCH);
        impacts_in(&c)->rub.duration = impacts_in(&c)->scratch.duration = 1e-4;
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_parameters p = impacts_at(&l, 0);
        ck_assert(l.alone == k && p.share[k] == 1 && p.zeta == 1e-4 && p.theta == 0 && p.depth == 0 &&
                  l.longest >= 1e-4 && l.longest < 1.001e-4);
        for (int s = 0; s < 2; s++)
            ck_assert(p.mean[s] == 0 && p.a1[s] == 0 && p.b1[s] == 0);
        ck_assert(isinf(p.least_amplitude) && p.least_amplitude < 0);
        for (int i = 1; i < 100; i++) {
            double w = i / 100.0, interval = impact_law_draw(&l, IMPACT_INTERVAL, &p, w);
            ck_assert_double_eq_tol(impact_law_draw(&l, IMPACT_AMPLITUDE, &p, w), gsl_cdf_gaussian_Pinv(w, 0.15),
                                    1e-15);
            ck_assert_double_eq_tol(interval, k == IMPACT_RUB ? SAMPLE : gsl_cdf_exponential_Pinv(w, 0.01), 1e-16);
        }
    }
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ on the disk */

static struct contact disk(double degrees, double radius)
{
    struct contact c = impacts_contact(PROTOTYPE_SPACE);
    impacts_in(&c)->angle = degrees * (M_PI / 180);
    impacts_in(&c)->radius = radius;
    impacts_in(&c)->scratch.deviation = 0.3;
    impacts_in(&c)->scratch.duration = 1e-3;
    return c;
}

/* At 280 degrees and radius 0.7: hand-made shares, every parameter their sum. */
START_TEST(parameters_between)
{
    struct arena *a = arena_open();
    struct contact c = disk(280, 0.7), rolling = impacts_contact(PROTOTYPE_ROLL);
    struct impact_law l = impacts_law(&c, 1, a), alone = impacts_law(&rolling, 1, a);
    struct impact_parameters p = impacts_at(&l, 0.5), q = impacts_at(&alone, 0);
    double share[3] = {0.1 + 0.7 / 3, 0.1, 0.1 + 0.7 * 2 / 3}, mean, variance, rms = 0;
    ck_assert_double_eq_tol(p.zeta, share[0] * SAMPLE + share[1] * 1e-3 + share[2] * q.zeta, 1e-18);
    ck_assert_double_eq_tol(p.theta, share[2] * 0.29, 1e-15);
    ck_assert_double_eq_tol(p.depth, share[2] * 0.3, 1e-15);
    ck_assert_double_eq(p.rate, q.rate);
    for (int s = 0; s < 2; s++) {
        ck_assert_double_eq_tol(p.mean[s], share[2] * q.mean[s], 1e-15);
        ck_assert_double_eq_tol(p.a1[s], share[2] * q.a1[s], 1e-15);
        ck_assert_double_eq_tol(p.b1[s], share[2] * q.b1[s], 1e-15);
        impact_law_moments(&l, s, &p, &mean, &variance);
        double m = s ? share[0] * SAMPLE + share[1] * 0.01 : 0,
               roll = s ? 0.52e-3 : 0.04; /* E[X^2] of a mixture is the sum of its parts' */
        double square = share[2] * roll * roll +
                        (s ? share[0] * SAMPLE * SAMPLE + share[1] * 2e-4 : share[0] * 0.0225 + share[1] * 0.09);
        ck_assert_double_eq_tol(mean, m, 1e-17);
        ck_assert_double_eq_tol(variance, square - m * m, 1e-15 * square);
        impact_law_stationary(&l, s, &p, &mean, &variance);
        ck_assert_double_eq_tol(mean, p.mean[s] + m * (1 + p.b1[s]) / (1 + p.a1[s]), 1e-16);
        ck_assert_double_eq_tol(
            variance, (square - m * m) * (1 + p.b1[s] * p.b1[s] - 2 * p.a1[s] * p.b1[s]) / (1 - p.a1[s] * p.a1[s]),
            1e-15 * variance);
        rms = s ? rms : sqrt(mean * mean + variance);
    }
    ck_assert(isinf(p.least_amplitude) && p.least_amplitude < 0);
    ck_assert_double_eq_tol(p.shortest, 0.01 * rms, 1e-15);
    arena_close(a);
}
END_TEST

START_TEST(anchors_of_the_disk_are_the_prototypes)
{
    static const int prototype[3] = {PROTOTYPE_RUB, PROTOTYPE_SCRATCH, PROTOTYPE_ROLL};
    struct arena *a = arena_open();
    for (int k = 0; k < 3; k++) {
        struct contact c = disk(120 * k, 1), one = disk(0, 1);
        impacts_in(&one)->prototype = prototype[k];
        struct impact_law l = impacts_law(&c, 1, a), alone = impacts_law(&one, 1, a);
        struct impact_parameters p = impacts_at(&l, 0), q = impacts_at(&alone, 0);
        q.rate = p.rate; /* whose phase goes on */
        ck_assert_mem_eq(&p, &q, sizeof p);
        ck_assert_double_eq(l.longest, alone.longest);
        for (int i = 1; i < 50; i++)
            for (int s = 0; s < 2; s++)
                ck_assert_double_eq(impact_law_draw(&l, s, &p, i / 50.0), impact_law_draw(&alone, s, &q, i / 50.0));
    }
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ mixtures */

struct mixture {
    double share[3], deviation[3]; /* interval: deviation[0] the constant, deviation[1] the mean of the exponential */
    bool interval;
};

/* P(X <= x), or P(X > x). */
static double probability(const struct mixture *m, double x, bool beyond)
{
    double (*g)(double, double) = beyond ? gsl_cdf_gaussian_Q : gsl_cdf_gaussian_P,
                        sum = m->share[2] * g(x, m->deviation[2]);
    if (!m->interval) return sum + m->share[0] * g(x, m->deviation[0]) + m->share[1] * g(x, m->deviation[1]);
    double exponential = x < 0    ? beyond
                         : beyond ? gsl_cdf_exponential_Q(x, m->deviation[1])
                                  : gsl_cdf_exponential_P(x, m->deviation[1]);
    return sum + m->share[0] * ((x >= m->deviation[0]) != beyond) + m->share[1] * exponential;
}

/* The least x with P(X <= x) >= w, by bisection to the last bit. */
static double slow(const struct mixture *m, double w)
{
    double low = -20, high = 20;
    for (int i = 0; i < 2000 && high - low > 0; i++) {
        double x = 0.5 * (low + high);
        if (x == low || x == high) break;
        if (w > 0.5 ? probability(m, x, true) <= 1 - w : probability(m, x, false) >= w)
            high = x;
        else
            low = x;
    }
    return high;
}

/* All over the disk, near its anchors, and far out in the tails: 1e-12 of the standard deviation (GSL's own rounding,
   1e-16 of F over the density, is granted where F is flat). */
START_TEST(inverses_of_mixtures)
{
    static const double degrees[] = {1e-7, 10, 60, 119.99999, 130, 180, 239, 240.001, 300, 359.9},
                        radius[] = {1, 0.999999, 0.5, 0};
    static const double tail[] = {0x1p-53, 1e-12, 1e-7, 1e-3, 0.02};
    struct arena *a = arena_open();
    double worst = 0;
    for (int i = 0; i < 40; i++) {
        struct contact c = disk(degrees[i % 10], radius[i / 10]);
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_parameters p = impacts_at(&l, 0);
        for (int s = 0; s < 2; s++) {
            struct mixture m = {{p.share[0], p.share[1], p.share[2]},
                                {s ? SAMPLE : 0.15, s ? 0.01 : 0.3, s ? 0.52e-3 : 0.04},
                                s == IMPACT_INTERVAL};
            double mean, variance;
            impact_law_moments(&l, s, &p, &mean, &variance);
            for (int j = 0; j < 110; j++) {
                double w = j < 100 ? (j + 0.5) / 100
                           : j % 2 ? tail[(j - 100) / 2]
                                   : 1 - tail[(j - 100) / 2],
                       x = impact_law_draw(&l, s, &p, w), want = slow(&m, w);
                double d = s ? 1e-9 : 1e-6,
                       flat = (probability(&m, want + d, w < 0.5) - probability(&m, want - d, w < 0.5)) / (2 * d);
                worst =
                    fmax(worst, (fabs(x - want) - 1e-15 * fmin(w, 1 - w) / fmax(fabs(flat), 1e-300)) / sqrt(variance));
            }
        }
    }
    ck_assert_double_le(worst, 1e-12);
    arena_close(a);
}
END_TEST

static double weighted(double x, void *self)
{
    const struct mixture *m = self;
    double d = m->share[2] * gsl_ran_gaussian_pdf(x, m->deviation[2]);
    d += m->interval ? m->share[1] * gsl_ran_exponential_pdf(x, m->deviation[1])
                     : m->share[0] * gsl_ran_gaussian_pdf(x, m->deviation[0]) +
                           m->share[1] * gsl_ran_gaussian_pdf(x, m->deviation[1]);
    return x * x * d;
}

/* E[X^2] by quadrature over the densities, and mean and E[X^2] of what is drawn at evenly spaced w (whose tails miss
 * 1e-3 of it). */
START_TEST(moments_of_mixtures)
{
    struct arena *a = arena_open();
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(1000);
    for (int i = 0; i < 12; i++) {
        struct contact c = disk(30 * i + 15, 0.8);
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_parameters p = impacts_at(&l, 0);
        for (int s = 0; s < 2; s++) {
            struct mixture m = {{p.share[0], p.share[1], p.share[2]},
                                {s ? SAMPLE : 0.15, s ? 0.01 : 0.3, s ? 0.52e-3 : 0.04},
                                s == IMPACT_INTERVAL};
            gsl_function f = {weighted, &m};
            double square[2], error, mean, variance, sums[2] = {0}, far = s ? 0.5 : 4;
            gsl_integration_qag(&f, -far, 0, 0, 1e-10, 1000, GSL_INTEG_GAUSS61, room, &square[0], &error);
            gsl_integration_qag(&f, 0, far, 0, 1e-10, 1000, GSL_INTEG_GAUSS61, room, &square[1], &error);
            impact_law_moments(&l, s, &p, &mean, &variance);
            double whole = square[0] + square[1] + (s ? p.share[0] * SAMPLE * SAMPLE : 0);
            ck_assert_double_eq_tol(variance + mean * mean, whole, 1e-9 * whole);
            for (int j = 0; j < 20000; j++) {
                double x = impact_law_draw(&l, s, &p, (j + 0.5) / 20000);
                sums[0] += x / 20000;
                sums[1] += x * x / 20000;
            }
            ck_assert_double_eq_tol(sums[0], mean, 3e-4 * sqrt(whole));
            ck_assert_double_eq_tol(sums[1], whole, 4e-3 * whole);
        }
    }
    gsl_integration_workspace_free(room);
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ tables */

static struct contact with_table(const char *path)
{
    struct contact c = impacts_contact(PROTOTYPE_ROLL);
    impacts_in(&c)->amplitude = (struct impact_draws){1, NAN, 0, 0, DISTRIBUTION_TABLE, path};
    return c;
}

/* A triangle on 0 .. 2 with its top at 1, of area 1/2 as it stands: P = x^2/2 up to 1, 1 - (2 - x)^2/2 beyond; mean 1,
 * variance 1/6. */
START_TEST(a_triangle)
{
    char path[32];
    struct arena *a = arena_open();
    impacts_file(path, "value,density\n0,0\n1,0.5\n2,0\n");
    struct contact c = with_table(path);
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_parameters p = impacts_at(&l, 0);
    double mean, variance;
    unlink(path);
    impact_law_moments(&l, IMPACT_AMPLITUDE, &p, &mean, &variance);
    ck_assert_double_eq_tol(mean, 1, 1e-15);
    ck_assert_double_eq_tol(variance, 1 / 6.0, 1e-15);
    for (int i = 1; i < 1000; i++) {
        double w = i / 1000.0, want = w <= 0.5 ? sqrt(2 * w) : 2 - sqrt(2 * (1 - w));
        ck_assert_double_eq_tol(impact_law_draw(&l, IMPACT_AMPLITUDE, &p, w), want, 2e-15);
    }
    ck_assert_double_eq_tol(impact_law_draw(&l, IMPACT_AMPLITUDE, &p, 0x1p-53), 0x1p-26, 1e-20);
    ck_assert_double_eq_tol(impact_law_draw(&l, IMPACT_AMPLITUDE, &p, 1 - 0x1p-53), 2 - 0x1p-26, 4e-16);
    arena_close(a);
}
END_TEST

/* A density with a hole, a step at its left end and slopes of either sign: drawn values w back from the integral of the
 * density by quadrature. */
static const double bumps[][2] = {{-1, 2}, {0, 1}, {0.5, 0}, {1.5, 0}, {2, 3}, {2.25, 3}, {4, 0}};

static double bumpy(double x)
{
    for (int i = 0; i < 6; i++)
        if (x >= bumps[i][0] && x <= bumps[i + 1][0])
            return bumps[i][1] + (bumps[i + 1][1] - bumps[i][1]) * (x - bumps[i][0]) / (bumps[i + 1][0] - bumps[i][0]);
    return 0;
}

static double bumpy_part(double x, int power)
{
    double sum = 0;
    for (int i = 0; i < 6 && bumps[i][0] < x; i++) { /* Gauss-Legendre of 3 nodes, exact for degree 5 */
        double low = bumps[i][0], high = fmin(x, bumps[i + 1][0]), half = 0.5 * (high - low),
               g[3] = {-sqrt(0.6), 0, sqrt(0.6)};
        for (int k = 0; k < 3; k++) {
            double y = low + half * (1 + g[k]);
            sum += half * (k == 1 ? 8 : 5) / 9.0 * bumpy(y) * pow(y, power);
        }
    }
    return sum;
}

START_TEST(a_table_with_a_hole)
{
    char path[32];
    struct arena *a = arena_open();
    impacts_file(path, "# made by hand\nvalue,density,note\n-1,2,a\n0,1,b\n0.5,0,c\n1.5,0,d\n2,3,e\n2.25,3,f\n4,0,g\n");
    struct contact c = with_table(path);
    struct impact_law l = impacts_law(&c, 1, a);
    struct impact_parameters p = impacts_at(&l, 0);
    double mean, variance, area = bumpy_part(4, 0), first = bumpy_part(4, 1) / area;
    unlink(path);
    impact_law_moments(&l, IMPACT_AMPLITUDE, &p, &mean, &variance);
    ck_assert_double_eq_tol(mean, first, 1e-14);
    ck_assert_double_eq_tol(variance, bumpy_part(4, 2) / area - first * first, 1e-14);
    for (int i = 1; i < 2000; i++) {
        double x = impact_law_draw(&l, IMPACT_AMPLITUDE, &p, i / 2000.0);
        ck_assert_double_eq_tol(bumpy_part(x, 0) / area, i / 2000.0, 2e-15);
        ck_assert(x <= 0.5 || x >= 1.5);
    }
    arena_close(a);
}
END_TEST

/* Within a mixture: half-way between rub (a constant, inside the hole or inside a slope) and a rolling of that table.
 */
START_TEST(a_table_in_a_mixture)
{
    static const double constant[] = {0.75, 3};
    char path[32];
    struct arena *a = arena_open();
    impacts_file(path, "value,density\n-1,2\n0,1\n0.5,0\n1.5,0\n2,3\n2.25,3\n4,0\n");
    for (int k = 0; k < 2; k++) {
        struct contact c = disk(300, 1);
        impacts_in(&c)->interval = (struct impact_draws){1, NAN, 0, 0, DISTRIBUTION_TABLE, path};
        impacts_in(&c)->rub.interval = constant[k];
        struct impact_law l = impacts_law(&c, 1, a);
        struct impact_parameters p = impacts_at(&l, 0);
        double area = bumpy_part(4, 0), jump = 0.5 * bumpy_part(constant[k], 0) / area;
        for (int i = 1; i < 2000; i++) {
            double w = i / 2000.0, x = impact_law_draw(&l, IMPACT_INTERVAL, &p, w);
            if (w > jump && w <= jump + 0.5)
                ck_assert_double_eq(x, constant[k]);
            else
                ck_assert_double_eq_tol(0.5 * bumpy_part(x, 0) / area + (x > constant[k] ? 0.5 : 0), w, 2e-13);
        }
    }
    unlink(path);
    arena_close(a);
}
END_TEST

static void refused(const struct contact *c, enum err_kind kind, const char *text)
{
    struct arena *a = arena_open();
    struct impact_law l;
    struct err e = {0};
    ck_assert(!impact_law_make(c, 1, a, &l, &e));
    ck_assert_msg(e.kind == kind && strstr(e.text, text), "%d: %s", e.kind, e.text);
    arena_close(a);
}

START_TEST(tables_that_are_refused)
{
    static const char *const bad[][2] = {{"value,density\n0,1\n1,-1\n", ":3: column 'density': -1 is below 0"},
                                         {"value,density\n0,1\n1,1\n1,1\n", ":4: column 'value': 1 comes after 1"},
                                         {"value,density\n0,1\n", "1 row"},
                                         {"value,height\n0,1\n1,1\n", "no column 'density'"},
                                         {"value,density\n0,0\n1,0\n", "area"},
                                         {"value,density\n0,one\n1,0\n", ":2: column 'density'"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char path[32], text[100];
        impacts_file(path, bad[i][0]);
        snprintf(text, sizeof text, "%s", bad[i][1]);
        struct contact c = with_table(path);
        refused(&c, ERR_SCENE, text);
        refused(&c, ERR_SCENE, path);
        unlink(path);
        refused(&c, ERR_INPUT, path);
    }
}
END_TEST

START_TEST(scenes_that_are_refused)
{
    struct contact c = impacts_contact(PROTOTYPE_ROLL);
    impacts_in(&c)->amplitude.mean = -1;
    refused(&c, ERR_SCENE, "floor.amplitude");
}
END_TEST

/* ------------------------------------------------------------------ the walk */

static void near_shares(const struct impact_law *l, double t, double degrees, double radius)
{
    double share[3];
    struct impact_parameters p = impacts_at(l, t);
    impact_law_shares(degrees * (M_PI / 180), radius, share);
    for (int k = 0; k < 3; k++)
        ck_assert_double_eq_tol(p.share[k], share[k], 1e-14);
}

START_TEST(a_way_over_the_disk)
{
    char path[32];
    struct arena *a = arena_open();
    impacts_file(path, "time_s,angle_deg,radius\n0.5,0,1\n1.5,240,1\n2.5,240,-1\n3,360,0.5\n");
    struct contact c = disk(0, 1);
    impacts_in(&c)->walk = path;
    struct impact_law l = impacts_law(&c, 3, a);
    unlink(path);
    ck_assert_int_eq(l.steps, 4);
    near_shares(&l, -1, 0, 1);
    near_shares(&l, 0.3, 0, 1);
    near_shares(&l, 1, 120, 1);
    near_shares(&l, 1.25, 180, 1);
    near_shares(&l, 1.5, 240, 1);
    near_shares(&l, 1.55, 240, 0.9);
    near_shares(&l, 2, 0, 0);
    near_shares(&l, 2.25, 60, 0.5);
    near_shares(&l, 2.55, 252, -0.85);
    near_shares(&l, 2.75, 300, -0.25);
    near_shares(&l, 9, 0, 0.5);
    impacts_file(path, "time_s,angle_deg,radius\n-1,0,1\n1,120,1\n"); /* rows before the start: before 0 as at 0 */
    l = impacts_law(&c, 3, a);
    unlink(path);
    near_shares(&l, 0, 60, 1);
    near_shares(&l, -0.5, 60, 1);
    arena_close(a);
}
END_TEST

START_TEST(from_one_place_to_another)
{
    struct arena *a = arena_open();
    struct contact c = disk(-30, 0.2);
    struct impact_law l = impacts_law(&c, 2, a);
    near_shares(&l, 1, -30, 0.2);
    impacts_in(&c)->angle_to = M_PI / 2;
    l = impacts_law(&c, 2, a);
    near_shares(&l, -5, -30, 0.2);
    near_shares(&l, 1, 30, 0.2);
    near_shares(&l, 2, 90, 0.2);
    impacts_in(&c)->radius_to = -1;
    l = impacts_law(&c, 2, a);
    near_shares(&l, 1, 30, -0.4);
    near_shares(&l, 5, 90, -1);
    impacts_in(&c)->angle_to = NAN;
    l = impacts_law(&c, 2, a);
    near_shares(&l, 0.5, -30, -0.1);
    arena_close(a);
}
END_TEST

START_TEST(walks_that_are_refused)
{
    static const char *const bad[][2] = {
        {"time_s,angle_deg,radius\n0,0,1\n1,0,1.01\n", ":3: column 'radius': 1.01 lies outside the disk"},
        {"time_s,angle_deg,radius\n0,0,1\n0,0,1\n", ":3: column 'time_s'"},
        {"time_s,angle,radius\n0,0,1\n1,0,1\n", "no column 'angle_deg'"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char path[32];
        struct contact c = disk(0, 1);
        impacts_file(path, bad[i][0]);
        impacts_in(&c)->walk = path;
        refused(&c, ERR_SCENE, bad[i][1]);
        unlink(path);
        refused(&c, ERR_INPUT, path);
    }
}
END_TEST

UNIT("impact_law", shares_by_hand, shares_are_those_of_the_printed_equations, shares_are_continuous, roll_is_table_1,
     what_is_given_takes_the_place_of_rolls, rub_and_scratch, parameters_between,
     anchors_of_the_disk_are_the_prototypes, inverses_of_mixtures, moments_of_mixtures, a_triangle, a_table_with_a_hole,
     a_table_in_a_mixture, tables_that_are_refused, scenes_that_are_refused, a_way_over_the_disk,
     from_one_place_to_another, walks_that_are_refused)
