/* roughness: an ensemble (long readings of a fixed seed) against the density that the header promises, integrated by
   GSL.

   Statistical bounds. The mean of z^2 over a length L of a stationary Gaussian profile of one-sided density P has the
   relative variance integral of P^2 dk / (L (integral of P dk)^2), and so has the power of a band of it, with the
   integrals over the band. Bounds are 5 standard deviations, which a right profile passes 999 999 times in a million;
   with the seed fixed, always. */
#include "surface/roughness.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_fft_real.h>
#include <gsl/gsl_integration.h>

#include "parts.h"
#include "pipeline/stages.h"
#include "scene/params.h"
#include "stage.h"

#define SIGMAS 5

static const struct roughness usual = {
    .given = true, .exponent = -2.4, .rms = 4e-6, .longest = 2e-3, .shortest = 20e-6};

static struct roughness with_exponent(double exponent)
{
    struct roughness r = usual;
    r.exponent = exponent;
    return r;
}

/* The Gaussian profile of a recipe's own figures. */
static struct profile *roughness_make(struct arena *a, const struct roughness *r, struct noise stream)
{
    struct spectrum s = spectrum_power_law(a, r->exponent, r->longest, r->shortest, r->rms);
    return roughness_blocks(a, &s, stream);
}

/* One-sided power spectral density (m^2 per cycle/m) that the profile has at k cycles/m, in the ensemble mean. */
static double roughness_density(const struct roughness *r, double k)
{
    double nodes[2] = {1 / r->longest, 1 / r->shortest}, p[2] = {1, pow(r->longest / r->shortest, r->exponent)};
    struct spectrum s = {.n = 2, .k = nodes, .p = p, .flat = true};
    spectrum_scale(&s, r->rms);
    return spectrum_at(&s, k);
}

struct density {
    const struct roughness *r;
    int power;
};

static double density_power(double k, void *data)
{
    const struct density *d = data;
    return pow(roughness_density(d->r, k), d->power);
}

/* Integral of P^power from k0 to k1, broken at the kink. */
static double integral(const struct roughness *r, int power, double k0, double k1)
{
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    struct density d = {r, power};
    gsl_function f = {density_power, &d};
    double kink = 1 / r->longest, sum = 0, part, error, ends[] = {k0, fmin(fmax(kink, k0), k1), k1};
    k1 = fmin(k1, 1 / r->shortest);
    for (int i = 0; i < 2; i++)
        if (ends[i + 1] > ends[i]) {
            ck_assert_int_eq(gsl_integration_qags(&f, ends[i], ends[i + 1], 0, 1e-11, 1000, space, &part, &error),
                             GSL_SUCCESS);
            sum += part;
        }
    gsl_integration_workspace_free(space);
    return sum;
}

/* Relative standard deviation of the power between k0 and k1 of a reading of that length. */
static double spread_of(const struct roughness *r, double k0, double k1, double length)
{
    return sqrt(integral(r, 2, k0, k1) / length) / integral(r, 1, k0, k1);
}

static void heights(struct profile *p, long first, long n, double *z)
{
    static double work[(1 << 20) + 2];
    ck_assert_int_le(n, 1 << 20);
    p->read(p, first - 1, n + 2, work);
    for (long i = 0; i < n; i++)
        z[i] = (work[i] + 4 * work[i + 1] + work[i + 2]) / 6;
}

/* ------------------------------------------------------------------ the density itself */

static const double exponents[] = {-2.4, -1, 0, 2, -4, -8};
enum { EXPONENTS = 6 };

START_TEST(density_integrates_to_the_square)
{
    static const double more[] = {-7.3,       -1.5,      -1 - 1e-6, -1 - 1e-8, -1 - 1e-10,
                                  -1 + 1e-10, -1 + 1e-8, -1 + 1e-6, -0.5,      1};
    for (int i = 0; i < 10 + EXPONENTS; i++) {
        struct roughness r = with_exponent(i < EXPONENTS ? exponents[i] : more[i - EXPONENTS]);
        ck_assert_double_eq_tol(integral(&r, 1, 0, 1 / r.shortest) / (r.rms * r.rms), 1,
                                1e-8); /* 1e-16 / |exponent + 1| near -1 */
    }
}
END_TEST

START_TEST(density_is_a_power_law)
{
    struct roughness r = usual;
    double flat = roughness_density(&r, 0), k0 = 1 / r.longest, k1 = 1 / r.shortest;
    ck_assert_double_gt(flat, 0);
    for (double k = 0; k <= k0; k += k0 / 64)
        ck_assert_double_eq(roughness_density(&r, k), flat);
    for (double k = k0; k < k1; k *= 1.1)
        ck_assert_double_eq_tol(roughness_density(&r, k) / flat, pow(k / k0, -2.4), 1e-14);
    ck_assert_double_eq(roughness_density(&r, k1), 0);
    ck_assert_double_eq(roughness_density(&r, 10 * k1), 0);
}
END_TEST

/* ------------------------------------------------------------------ the profile: moments */

/* A block's samples and half of them, as the header of roughness.c has it for these recipes. */
enum { BLOCK = 4096, HALF = BLOCK / 2, PHASES = 16 };

struct moments {
    double count, sum[5], phase[PHASES]; /* sums of z^k; of z^2 by the place in a half block */
};

static struct moments measure(const struct roughness *r, const char *name, long first, long halves)
{
    static double z[HALF];
    struct arena *a = arena_open();
    struct profile *p = roughness_make(a, r, noise_make(7, name));
    struct moments m = {0};
    for (long b = 0; b < halves; b++) {
        heights(p, first + b * HALF, HALF, z);
        for (int i = 0; i < HALF; i++) {
            double v = z[i] / r->rms, term = 1;
            for (int k = 0; k < 5; k++, term *= v)
                m.sum[k] += term;
            m.phase[i * PHASES / HALF] += v * v;
        }
    }
    m.count = (double)(halves * HALF);
    p->close(p);
    arena_close(a);
    return m;
}

/* Without the line at k = 0, or with lines that do not stand for their share of P, the mean square is up to 5 % off (at
   exponent -8, which 42 m tell). */
START_TEST(mean_square_is_rms)
{
    for (int i = 0; i < EXPONENTS; i++) {
        struct roughness r = with_exponent(exponents[i]);
        long halves = i == EXPONENTS - 1 ? 4096 : 512;
        struct moments m = measure(&r, "mean square", -1000, halves);
        double sigma = spread_of(&r, 0, 1 / r.shortest, m.count * r.shortest / 4);
        ck_assert_msg(fabs(m.sum[2] / m.count - 1) < SIGMAS * sigma, "exponent %g: mean square %g, sigma %g",
                      r.exponent, m.sum[2] / m.count, sigma);
        /* the same everywhere in a block: a sixteenth of a half block is about 1.5 correlation lengths, so that parts
         * count as independent */
        for (int k = 0; k < PHASES; k++)
            ck_assert_double_eq_tol(m.phase[k] * PHASES / m.count, 1, SIGMAS * sigma * sqrt(2 * PHASES));
    }
}
END_TEST

/* Skewness and kurtosis of n numbers, each correlated with `reach` others: variances 6 reach / n and 24 reach / n at
 * most. */
START_TEST(heights_are_gaussian)
{
    struct roughness r = usual;
    struct moments m = measure(&r, "gauss", 0, 2048);
    double sigma = spread_of(&r, 0, 1 / r.shortest, m.count * r.shortest / 4), independent = 2 / (sigma * sigma);
    double mean = m.sum[1] / m.count, var = m.sum[2] / m.count - mean * mean;
    double third = m.sum[3] / m.count - 3 * mean * m.sum[2] / m.count + 2 * mean * mean * mean;
    double fourth =
        m.sum[4] / m.count - 4 * mean * m.sum[3] / m.count + 6 * mean * mean * m.sum[2] / m.count - 3 * pow(mean, 4);
    double zero = sqrt(roughness_density(&r, 0) / 2 / (m.count * r.shortest / 4)) /
                  r.rms; /* of the mean: the two-sided density at 0 */
    ck_assert_double_eq_tol(mean, 0, SIGMAS * zero);
    ck_assert_double_eq_tol(third / pow(var, 1.5), 0, SIGMAS * sqrt(6 / independent));
    ck_assert_double_eq_tol(fourth / (var * var), 3, SIGMAS * sqrt(24 / independent));
}
END_TEST

/* ------------------------------------------------------------------ the profile: spectrum */

enum { SEGMENT = 16384, SEGMENTS = 256 };

/* One-sided density at multiples of 1/(SEGMENT pitch), mean over half-overlapping Hann segments (Welch); power[0] is
 * that at 0. */
static void welch(const struct roughness *r, const char *name, double *power)
{
    static double read[SEGMENT], z[SEGMENT], hann[SEGMENT];
    double pitch = r->shortest / 4;
    struct arena *a = arena_open();
    struct profile *p = roughness_make(a, r, noise_make(7, name));
    ck_assert_double_eq(p->pitch, pitch);
    for (int i = 0; i < SEGMENT; i++)
        hann[i] = 0.5 - 0.5 * cos(2 * M_PI * (i + 0.5) / SEGMENT);
    memset(power, 0, (SEGMENT / 2) * sizeof *power);
    heights(p, 0, SEGMENT / 2, read + SEGMENT / 2);
    for (long s = 0; s < SEGMENTS; s++) {
        memcpy(read, read + SEGMENT / 2, sizeof read / 2);
        heights(p, (s + 1) * SEGMENT / 2, SEGMENT / 2, read + SEGMENT / 2);
        for (int i = 0; i < SEGMENT; i++)
            z[i] = read[i] * hann[i];
        gsl_fft_real_radix2_transform(z, 1, SEGMENT);
        for (int k = 0; k < SEGMENT / 2; k++)
            power[k] +=
                (z[k] * z[k] + (k ? z[SEGMENT - k] * z[SEGMENT - k] : 0)) * 2 * pitch / (SEGMENT * 0.375) / SEGMENTS;
    }
    p->close(p);
    arena_close(a);
}

/* Mean of the measured density over the lines in [lo, hi), relative to the mean of the promised one over the same
 * lines. */
static double band(const struct roughness *r, const double *power, double lo, double hi)
{
    double dk = 1 / (SEGMENT * r->shortest / 4), got = 0, want = 0;
    for (int k = 0; k < SEGMENT / 2; k++)
        if (k * dk >= lo && k * dk < hi) {
            double share = k ? 1 : 0.5; /* the line at 0 has half a width, and one number instead of two */
            got += share * power[k];
            want += share * roughness_density(r, k * dk);
        }
    return got / want;
}

/* Octaves down from the cut-off, far into the flat part, and what lies below them down to 0. Beside statistics (Welch's
   estimate with half overlap has 1.06 times the variance of the length's own) the block's window, 1.4 lines of 49
   cycles/m, rounds the kink at 500: 5 % of the octave beside it at exponent -8, less in proportion to exponent^2. At -8
   the last octave holds 1e-15 of the first: a window that leaks shows there. */
START_TEST(spectrum_by_octaves)
{
    static double power[SEGMENT / 2];
    for (int i = 0; i < EXPONENTS; i++) {
        struct roughness r = with_exponent(exponents[i]);
        double length = (SEGMENTS + 1) * SEGMENT / 2 * r.shortest / 4, k0 = 1 / r.longest, k1 = 1 / r.shortest;
        welch(&r, "spectrum", power);
        for (double hi = k1 * 0.98; hi > k0 / 20; hi /= 2) {
            double lo = hi < k0 / 10 ? 0 : hi / 2, got = band(&r, power, lo, hi);
            double bound =
                SIGMAS * 1.03 * spread_of(&r, lo, hi, length) + 0.05 * fmin(1, r.exponent * r.exponent / 64) + 0.002;
            ck_assert_msg(fabs(got - 1) < bound, "exponent %g, %g to %g cycles/m: %g times the density, bound %g",
                          r.exponent, lo, hi, got, bound);
        }
    }
}
END_TEST

/* Nothing above 1/shortest, up to the 2/shortest that knots can tell, but the leak of the block's window: below 1e-9 of
   the density at the cut-off. */
START_TEST(nothing_beyond_the_shortest)
{
    static double power[SEGMENT / 2];
    struct roughness r = usual;
    double dk = 1 / (SEGMENT * r.shortest / 4), k1 = 1 / r.shortest, edge = roughness_density(&r, k1 * 0.999), most = 0;
    welch(&r, "beyond", power);
    for (int k = 0; k < SEGMENT / 2; k++)
        if (k * dk > 1.05 * k1) most = fmax(most, power[k]);
    printf("roughness: density beyond 1/shortest at most %.2g of that below it\n", most / edge);
    ck_assert_double_lt(most, 1e-9 * edge);
}
END_TEST

/* ------------------------------------------------------------------ reading */

/* Any place, any length, any order, after any other: the same bits as one long reading; blocks of 4096 and of 16 000
 * samples. */
START_TEST(any_order_same_bits)
{
    enum { REACH = 60000 };
    static double whole[2 * REACH], part[2 * REACH];
    struct roughness recipes[] = {usual, usual};
    recipes[1].longest = 10e-3;
    for (int i = 0; i < 2; i++) {
        struct arena *a = arena_open();
        struct profile *once = roughness_make(a, &recipes[i], noise_make(3, "order"));
        struct profile *often = roughness_make(a, &recipes[i], noise_make(3, "order"));
        once->read(once, -REACH, 2 * REACH, whole);
        srand48(1);
        for (int k = 0; k < 300; k++) {
            long first = (long)(drand48() * 2 * REACH), n = (long)(pow(drand48(), 4) * (double)(2 * REACH - first));
            often->read(often, first - REACH, n, part);
            ck_assert_msg(memcmp(part, whole + first, (size_t)n * sizeof *part) == 0, "%ld from %ld on", n,
                          first - REACH);
        }
        for (long k = 0; k < 2 * REACH; k += 1999) { /* one by one, backwards, across 0 */
            often->read(often, REACH - 1 - k, 1, part);
            ck_assert(part[0] == whole[2 * REACH - 1 - k]);
        }
        once->close(once);
        often->close(often);
        arena_close(a);
    }
}
END_TEST

/* As rough on the other side of 0 and astronomically far away; no two places alike. */
START_TEST(far_places)
{
    static const long places[] = {-1000000, -(1L << 40), 1L << 40, -(1L << 60), 1L << 60};
    for (int i = 0; i < 5; i++) {
        struct moments m = measure(&usual, "far", places[i], 256);
        double sigma = spread_of(&usual, 0, 1 / usual.shortest, m.count * usual.shortest / 4);
        ck_assert_double_eq_tol(m.sum[2] / m.count, 1, SIGMAS * sigma);
    }
}
END_TEST

/* Numbers per correlation length: the sum of squared correlations, in samples. */
static double reach_of(const struct roughness *r)
{
    double rms2 = r->rms * r->rms;
    return integral(r, 2, 0, 1 / r->shortest) / (2 * rms2 * rms2) / (r->shortest / 4);
}

/* The autocorrelation over 128 blocks beyond one block: each lag is normal with variance reach / (numbers multiplied),
   and 500 000 lags reach 5.2 deviations; 6.5 are allowed. */
START_TEST(nothing_repeats)
{
    enum { N = 128 * BLOCK, LAG = N - 8 * BLOCK };
    double *z = calloc(2 * N, sizeof *z);
    struct arena *a = arena_open();
    struct profile *p = roughness_make(a, &usual, noise_make(9, "repeat"));
    double reach = reach_of(&usual), zero;
    heights(p, 0, N, z);
    gsl_fft_real_radix2_transform(z, 1, 2 * N);
    z[0] *= z[0], z[N] *= z[N];
    for (int k = 1; k < N; k++) {
        z[k] = z[k] * z[k] + z[2 * N - k] * z[2 * N - k];
        z[2 * N - k] = 0;
    }
    gsl_fft_real_radix2_transform(z, 1, 2 * N); /* even and real: forwards is backwards, times 2 but for the constant */
    zero = z[0];
    ck_assert_double_gt(zero, 0);
    for (int lag = BLOCK; lag < LAG; lag++) {
        double correlation = z[lag] / zero * N / (N - lag);
        ck_assert_msg(fabs(correlation) < 6.5 * sqrt(reach / (N - lag)), "lag of %g blocks: %g", (double)lag / BLOCK,
                      correlation);
    }
    p->close(p);
    arena_close(a);
    free(z);
}
END_TEST

static double correlation(const double *x, const double *y, int n)
{
    double xx = 0, yy = 0, xy = 0;
    for (int i = 0; i < n; i++)
        xx += x[i] * x[i], yy += y[i] * y[i], xy += x[i] * y[i];
    return xy / sqrt(xx * yy);
}

/* No half block is another one over again, whole or in part: over all pairs i, j of 200 of them on both sides of 0 with
   one difference i - j or one sum i + j, the mean correlation is 0 within 6 of its standard deviations, sqrt(reach /
   (HALF pairs)); and no pair is alike: a half block holds 24 independent numbers, whose correlation exceeds 0.9 once in
   10^9 pairs. */
START_TEST(no_block_twice)
{
    enum { HALVES = 200 };
    static double z[HALVES][HALF], sums[2][2 * HALVES], pairs[2][2 * HALVES];
    struct arena *a = arena_open();
    struct profile *p = roughness_make(a, &usual, noise_make(9, "twice"));
    heights(p, -HALVES / 2 * HALF, HALVES * HALF, z[0]);
    for (int i = 0; i < HALVES; i++)
        for (int j = 0; j < i; j++) {
            double alike = correlation(z[i], z[j], HALF);
            if (fabs(alike) >= 0.9) ck_abort_msg("half blocks %d and %d are alike", i, j);
            sums[0][i - j] += alike, pairs[0][i - j]++;
            sums[1][i + j] += alike, pairs[1][i + j]++;
        }
    double each = sqrt(reach_of(&usual) / HALF);
    for (int how = 0; how < 2; how++)
        for (int k = 0; k < 2 * HALVES; k++)
            if (pairs[how][k] > 9) ck_assert_double_lt(fabs(sums[how][k]), 6 * each * sqrt(pairs[how][k]));
    p->close(p);
    arena_close(a);
}
END_TEST

START_TEST(streams_and_seeds_differ)
{
    enum { N = 1 << 18, KINDS = 4 };
    static double z[KINDS][N];
    struct noise streams[KINDS] = {noise_make(7, "roughness/a"), noise_make(7, "roughness/b"),
                                   noise_make(8, "roughness/a"), noise_make(7, "roughness/a")};
    struct arena *a = arena_open();
    for (int k = 0; k < KINDS; k++) {
        struct profile *p = roughness_make(a, &usual, streams[k]);
        heights(p, 0, N, z[k]);
        p->close(p);
    }
    arena_close(a);
    ck_assert_mem_eq(z[0], z[3], sizeof z[0]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++)
            ck_assert_double_lt(fabs(correlation(z[i], z[j], N)), SIGMAS * sqrt(reach_of(&usual) / N));
}
END_TEST

/* Twice the rms is twice the profile, to the bit; three times, to rounding. */
START_TEST(rms_is_a_factor)
{
    enum { N = 10000 };
    static double z[3][N];
    static const double factors[] = {1, 2, 3};
    struct arena *a = arena_open();
    for (int k = 0; k < 3; k++) {
        struct roughness r = usual;
        r.rms *= factors[k];
        struct profile *p = roughness_make(a, &r, noise_make(7, "factor"));
        p->read(p, -N / 2, N, z[k]);
        p->close(p);
    }
    for (int i = 0; i < N; i++) {
        ck_assert_double_eq(z[1][i], 2 * z[0][i]);
        ck_assert_double_eq_tol(z[2][i], 3 * z[0][i], 1e-14 * usual.rms);
    }
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ the stage */

extern const struct stage roughness_stage;

/* On a line the stage's part is the profile above, of the stream of the contact's name; in the plane, asked for by a
   grain, one that varies with y; with another height distribution not Gaussian. */
START_TEST(stage_adds_its_part)
{
    for (int kind = 0; kind < 3; kind++) {
        struct arena *a = arena_open();
        struct err e = {0};
        struct scene s = {.seed = 11};
        struct contact c = {.name = "pen"};
        struct roughness *r = params_edit(&c, roughness_stage.params, a);
        *r = usual;
        r->grain = kind == 1 ? 3 : 1;
        r->skewness = kind == 2 ? -1 : 0;
        r->kurtosis = kind == 2 ? 5 : 3;
        c.motion.path = PATH_LINE;
        struct relief relief = {.along = ALONG_AUTO};
        struct board board = {.relief = &relief};
        struct stage_run run = {.stage = &roughness_stage, .scene = &s, .contact = &c, .board = &board, .arena = a};
        ck_assert(stages_wanted(&roughness_stage, &c, &s));
        ck_assert_msg(roughness_stage.open(&run, &e), "%s", e.text);
        ck_assert_int_eq(relief.along, kind == 1 ? ALONG_PLANE : ALONG_PATH);
        struct relief_part *p = relief.first;
        ck_assert_ptr_nonnull(p);
        ck_assert_ptr_null(p->next);
        ck_assert_str_eq(p->name, "roughness");
        ck_assert(p->linear == (kind == 0));
        struct profile *want = roughness_make(a, &usual, noise_make(11, "roughness/pen"));
        double z;
        heights(want, 77, 1, &z);
        struct parts_point got = parts_at(p, 77 * want->pitch, 0, kind == 1);
        if (kind == 0)
            ck_assert_double_eq_tol(got.v[0], z, 1e-15);
        else
            ck_assert_double_gt(fabs(got.v[0] - z), 1e-9);
        if (kind == 1) ck_assert_double_gt(fabs(parts_at(p, 77 * want->pitch, 1e-3, true).v[0] - got.v[0]), 1e-9);
        parts_derivatives(p, 0.05, kind == 1);
        want->close(want);
        roughness_stage.close(&run);
        arena_close(a);
    }
}
END_TEST

START_TEST(refused)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct roughness bad = usual;
    struct roughness_plan p;
    bad.skewness = 2, bad.kurtosis = 5;
    ck_assert(roughness_plan(a, NULL, &bad, &p, &e));
    ck_assert(!roughness_part(a, &p, &bad, ALONG_PATH, noise_make(1, "x"), &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, "kurtosis can be from") != NULL, "%s", e.text);
    arena_close(a);
}
END_TEST

UNIT("roughness", density_integrates_to_the_square, density_is_a_power_law, mean_square_is_rms, heights_are_gaussian,
     spectrum_by_octaves, nothing_beyond_the_shortest, any_order_same_bits, far_places, nothing_repeats, no_block_twice,
     streams_and_seeds_differ, rms_is_a_factor, stage_adds_its_part, refused)
