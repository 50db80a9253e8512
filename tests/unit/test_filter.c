/* filter: the decimator's response evaluated from its taps in long double on a dense grid, and sines through it whose
   interval means are known in closed form; Gaussians against their definition and transform. */
#include "num/filter.h"

#include <stdbool.h>
#include <stdint.h>

#include "unit.h"

static const int overs[] = {1, 2, 3, 4, 8, 32};
enum { OVERS = sizeof overs / sizeof overs[0], GRID = 700 };
#define PASS_ERROR 2e-6 /* num/filter.h */
#define STOP_GAIN 1e-6
#define EDGE_MOVES 1e-5 /* found: 8.2e-6 at 2, 1.7e-6 at most from 3 on; with R in whole T up to 1.6e-3 */

/* Gain from the continuous signal at f (in fs) to the output: mean over T = 1/over, then taps at (j + 1/2) T; hats:
 * mean by a hat, taps at j T. */
static long double gain(const struct filter *k, int over, long double f)
{
    long double w = M_PIl * f / over, sum = 0;
    bool hats = k->taps % 2;
    for (int j = 0; j < k->taps; j++)
        sum += k->tap[j] * cosl(2 * w * (j - k->reach + (hats ? 0 : 0.5L)));
    long double droop = f > 0 ? sinl(w) / w : 1;
    return sum * droop * (hats ? droop : 1);
}

static double largest(const struct filter *k, int over, double from, double to, double wanted)
{
    double most = 0;
    for (int i = 0; i <= GRID; i++)
        most = fmax(most, (double)fabsl(gain(k, over, from + (to - from) * (long double)i / GRID) - wanted));
    return most;
}

/* The stop band's first lobes, which are narrow, have a grid of their own. */
static void passes_and_stops(const struct filter *k, int over, const char *what, int taps)
{
    double pass = largest(k, over, 0, 0.4535, 1), stop = 0;
    if (over > 1) stop = fmax(largest(k, over, 0.5465, 0.8, 0), largest(k, over, 0.8, over * 0.5, 0));
    printf("%sover = %2d: %4d taps, pass %.3g, stop %.3g\n", what, over, taps, pass, stop);
    ck_assert_double_le(pass, PASS_ERROR);
    ck_assert_double_le(stop, STOP_GAIN);
}

START_TEST(decimator_response)
{
    for (int i = 0; i < OVERS; i++) {
        struct arena *a = arena_open();
        struct filter k = filter_decimator(a, overs[i]);
        passes_and_stops(&k, overs[i], "", 2 * k.reach);
        arena_close(a);
    }
}
END_TEST

START_TEST(decimator_response_of_hats)
{
    for (int i = 0; i < OVERS; i++) {
        struct arena *a = arena_open();
        struct filter k = filter_decimator_bspline(a, overs[i]);
        if (overs[i] == 1) ck_assert_double_lt(largest(&k, 1, 0.4535, 0.5, 1), 0.05);
        passes_and_stops(&k, overs[i], "hats, ", k.taps);
        arena_close(a);
    }
}
END_TEST

/* An error by the number of sub-intervals is one of the force, not of the edge at fs/2: which is where it is, and as
   steep, for all from 2 on. */
START_TEST(decimator_edge_stays)
{
    struct arena *a = arena_open();
    for (int hats = 0; hats < 2; hats++) {
        struct filter (*make)(struct arena *, int) = hats ? filter_decimator_bspline : filter_decimator,
                                              finest = make(a, 64);
        for (int i = 1; i < OVERS; i++) {
            struct filter k = make(a, overs[i]);
            double most = 0;
            for (int m = 0; m <= GRID; m++) {
                long double f = 0.4535 + 0.093L * m / GRID;
                most = fmax(most, (double)fabsl(gain(&k, overs[i], f) - gain(&finest, 64, f)));
            }
            printf("%sover = %2d: the edge is %.3g from where it is for 64\n", hats ? "hats, " : "", overs[i], most);
            ck_assert_double_le(most, EDGE_MOVES);
        }
    }
    arena_close(a);
}
END_TEST

START_TEST(decimator_sum_and_symmetry)
{
    for (int over = 1; over <= 33; over++) {
        struct arena *a = arena_open();
        for (int hats = 0; hats < 2; hats++) {
            struct filter k = hats ? filter_decimator_bspline(a, over) : filter_decimator(a, over);
            long double sum = 0;
            ck_assert_int_eq(k.taps, 2 * k.reach + hats);
            for (int j = 0; j < k.taps; j++)
                sum += k.tap[j];
            ck_assert_double_le((double)fabsl(sum - 1), 1e-15); /* each of the taps' roundings is below 2^-54 tap */
            for (int j = 0; j < k.taps; j++)
                ck_assert_double_eq(k.tap[j], k.tap[k.taps - 1 - j]);
        }
        arena_close(a);
    }
}
END_TEST

/* Mean of sin(2 pi f t + phase) over [i, i+1) T, f in fs, T = 1/over. */
static double sine_mean(double f, double phase, int over, long i)
{
    long double w = 2 * M_PIl * f / over;
    return (double)((cosl(w * i + phase) - cosl(w * (i + 1) + phase)) / w);
}

static double decimated(const struct filter *k, int over, double f, double phase, int n)
{
    double sum = 0;
    for (int j = -k->reach; j < k->reach; j++)
        sum += k->tap[j + k->reach] * sine_mean(f, phase, over, (long)over * n + j);
    return sum;
}

static double worst_sine(int over, double f, double amplitude)
{
    struct arena *a = arena_open();
    struct filter k = filter_decimator(a, over);
    double most = 0;
    for (int n = -6; n <= 6; n++) {
        double t = n, phase = 0.3;
        most = fmax(most, fabs(decimated(&k, over, f, phase, n) - amplitude * (double)sinl(2 * M_PIl * f * t + phase)));
    }
    arena_close(a);
    return most;
}

START_TEST(decimated_sines)
{
    for (int i = 0; i < OVERS; i++) {
        ck_assert_double_le(worst_sine(overs[i], 0.45, 1), PASS_ERROR);
        ck_assert_double_le(worst_sine(overs[i], 0.01, 1), PASS_ERROR);
        if (overs[i] >= 4) {
            ck_assert_double_le(worst_sine(overs[i], 0.6, 0), STOP_GAIN);
            ck_assert_double_le(worst_sine(overs[i], 1, 0), STOP_GAIN);
            ck_assert_double_le(worst_sine(overs[i], 1.7, 0), STOP_GAIN);
        }
    }
}
END_TEST

START_TEST(gaussian_taps)
{
    static const double sigmas[] = {0.8, 0.9, 1, 2.4, 5, 19.2};
    for (int i = 0; i < 6; i++) {
        struct arena *a = arena_open();
        double sigma = sigmas[i];
        struct filter k = filter_gaussian(a, sigma);
        ck_assert_int_eq(k.reach, (int)ceil(6.5 * sigma));
        long double total = 0, sum = 0;
        for (int j = -k.reach; j <= k.reach; j++)
            total += expl(-0.5L * j * j / ((long double)sigma * sigma));
        for (int j = -k.reach; j <= k.reach; j++) {
            long double want = expl(-0.5L * j * j / ((long double)sigma * sigma)) / total, got = k.tap[j + k.reach];
            double half_square = 0.5 * j * j / (sigma * sigma); /* three roundings of it, four of the rest */
            ck_assert_double_le((double)fabsl(got - want), (double)((3 * half_square + 4) * 0x1p-53 * want));
            ck_assert_double_eq(k.tap[k.reach - j], k.tap[k.reach + j]);
            sum += got;
        }
        ck_assert_double_le((double)fabsl(sum - 1), 5e-16);
        arena_close(a);
    }
}
END_TEST

/* exp(-2 (pi sigma f)^2); what is cut off beyond 6.5 sigma is 8e-11, and images add exp(-2 (pi sigma (1 - f))^2) < 2e-8
 * here. */
START_TEST(gaussian_response)
{
    struct arena *a = arena_open();
    for (double sigma = 2; sigma < 12; sigma *= 1.3) {
        struct filter k = filter_gaussian(a, sigma);
        for (double f = 0; f <= 0.5; f += 0.01) {
            double sum = 0, want = exp(-2 * M_PI * M_PI * sigma * sigma * f * f);
            for (int j = -k.reach; j <= k.reach; j++)
                sum += k.tap[j + k.reach] * cos(2 * M_PI * f * j);
            ck_assert_double_le(fabs(sum - want), 2e-10 + exp(-2 * M_PI * M_PI * sigma * sigma * (1 - f) * (1 - f)));
        }
    }
    arena_close(a);
}
END_TEST

/* As num/filter.h has it; sampled, a Gaussian of 0.3 samples would pass 0.97 at omega = 1 in place of 0.956. */
START_TEST(gaussian_narrower_than_samples)
{
    struct arena *a = arena_open();
    for (double sigma = 0.01; sigma < FILTER_NARROW; sigma += 0.03) {
        struct filter k = filter_gaussian(a, sigma);
        ck_assert_int_eq(k.reach, 4);
        for (double omega = 0; omega <= 2; omega += 0.05) {
            double sum = 0;
            for (int j = -k.reach; j <= k.reach; j++)
                sum += k.tap[j + k.reach] * cos(omega * j);
            ck_assert_double_le(fabs(sum - exp(-0.5 * sigma * sigma * omega * omega)), omega > 1 ? 6e-3 : 1e-5);
        }
    }
    arena_close(a);
}
END_TEST

START_TEST(gaussian_of_no_width)
{
    struct arena *a = arena_open();
    struct filter k = filter_gaussian(a, 0), tiny = filter_gaussian(a, 1e-200);
    ck_assert_int_eq(k.reach, 0);
    ck_assert_double_eq(k.tap[0], 1);
    ck_assert_double_eq(tiny.tap[tiny.reach], 1);
    ck_assert_double_eq(tiny.tap[0], 0);
    arena_close(a);
}
END_TEST

/* The deviation of the sampled kernel, as num/filter.h promises it. */
START_TEST(gaussian_deviation)
{
    struct arena *a = arena_open();
    for (double sigma = 1; sigma < 30; sigma *= 1.17) {
        struct filter k = filter_gaussian(a, sigma);
        double second = 0;
        for (int j = 1; j <= k.reach; j++)
            second += 2 * k.tap[j + k.reach] * j * j;
        ck_assert_double_le(fabs(sqrt(second) / sigma - 1), 1e-6);
    }
    arena_close(a);
}
END_TEST

UNIT("filter", UNIT_LONG(decimator_response), decimator_response_of_hats, decimator_edge_stays,
     decimator_sum_and_symmetry, decimated_sines, gaussian_taps, gaussian_response, gaussian_narrower_than_samples,
     gaussian_of_no_width, gaussian_deviation)
