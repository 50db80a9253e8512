/* tiles: long readings of a fixed seed against the spectrum asked for. Stated error of the field: 3 % of the density in
   bands of half an octave (the block's window, a spline's images), excess kurtosis 0.1. To that comes chance: a band of
   n lines in m independent segments has the relative deviation sqrt(2/(n m)) with a Hann window; bounds are 4.5 of it
   (several hundred bands are looked at). */
#include "surface/tiles.h"

#include <gsl/gsl_fft_real.h>

#include "num/real.h"
#include "parts.h"

enum { SEGMENT = 16384, SEGMENTS = 200 };

static struct relief_part *field(struct arena *a, double exponent, struct tiles_grain grain, const char *name)
{
    struct err e = {0};
    struct spectrum s = spectrum_power_law(a, exponent, 2e-3, 20e-6, 4e-6);
    struct relief_part *p = tiles_part(a, &s, &grain, noise_make(7, name), NULL, &e);
    ck_assert_msg(p != NULL, "%s", e.text);
    return p;
}

/* A straight line of n heights from (x0, y0) on. */
static void line(struct relief_part *p, const double from[2], const double step[2], size_t n, double *z)
{
    static double x[1 << 16], y[1 << 16];
    ck_assert(n <= 1 << 16);
    for (size_t i = 0; i < n; i++) {
        x[i] = from[0] + (double)i * step[0];
        y[i] = from[1] + (double)i * step[1];
        z[i] = 0;
    }
    p->add(p, &(struct relief_points){n, x, y}, &(struct relief_values){.z = z});
}

struct measured {
    double power[SEGMENT / 2], sum[5]; /* density at multiples of 1/(SEGMENT pitch); means of z^k */
};

static void measure(struct relief_part *p, double angle, double pitch, struct measured *m)
{
    static double z[SEGMENT];
    memset(m, 0, sizeof *m);
    for (int s = 0; s < SEGMENTS; s++) {
        line(p, (double[2]){1.2345 * s, -0.7 * s}, (double[2]){pitch * cos(angle), pitch * sin(angle)}, SEGMENT, z);
        for (int i = 0; i < SEGMENT; i++) {
            double v = z[i] / 4e-6, term = 1.0 / SEGMENT / SEGMENTS;
            for (int k = 1; k < 5; k++)
                m->sum[k] += term *= v;
            z[i] *= 0.5 - 0.5 * cos(2 * M_PI * (i + 0.5) / SEGMENT);
        }
        gsl_fft_real_radix2_transform(z, 1, SEGMENT);
        for (int k = 1; k < SEGMENT / 2; k++)
            m->power[k] += (z[k] * z[k] + z[SEGMENT - k] * z[SEGMENT - k]) * 2 * pitch / (SEGMENT * 0.375) / SEGMENTS;
    }
}

/* Half octaves down from the cut-off, `stretch` times lower than the recipe's. */
static void check_bands(const struct measured *m, double exponent, double pitch, double stretch, double angle)
{
    struct arena *a = arena_open();
    struct spectrum s = spectrum_power_law(a, exponent, 2e-3 * stretch, 20e-6 * stretch, 4e-6);
    double dk = 1 / (SEGMENT * pitch);
    for (double hi = spectrum_top(&s), lo; hi > 60 / stretch; hi = lo) {
        double got = 0, want = 0, lines = 0;
        lo = hi / sqrt(2);
        for (int k = 3; k < SEGMENT / 2; k++)
            if (k * dk >= lo && k * dk < hi) got += m->power[k], want += spectrum_at(&s, k * dk), lines++;
        if (lines < 4) break;
        double bound = 0.03 + 4.5 * sqrt(2 / lines / SEGMENTS);
        ck_assert_msg(fabs(got / want - 1) < bound,
                      "exponent %g, angle %g, %g to %g cycles/m: %g times the density, bound %g", exponent, angle, lo,
                      hi, got / want, bound);
    }
    arena_close(a);
}

START_TEST(traces_have_the_spectrum_in_every_direction)
{
    static const double exponents[] = {-2.4, 0, -1, -5}, angles[] = {0, 90, 30, 45};
    static struct measured m;
    for (int e = 0; e < 4; e++) {
        struct arena *a = arena_open();
        struct relief_part *p = field(a, exponents[e], (struct tiles_grain){1, 0, false}, "spectrum");
        for (int k = e ? e : 0; k < (e ? e + 1 : 4); k++) { /* all directions once */
            measure(p, angles[k] * M_PI / 180, 5e-6, &m);
            check_bands(&m, exponents[e], 5e-6, 1, angles[k]);
            /* 5 deviations: 200 segments of 82 mm, each about 40 longest waves */
            ck_assert_msg(fabs(m.sum[2] - 1) < 0.02, "exponent %g: mean square %g", exponents[e], m.sum[2]);
            ck_assert_msg(fabs(m.sum[3]) < 0.08, "exponent %g: third moment %g", exponents[e], m.sum[3]);
            ck_assert_msg(fabs(m.sum[4] / (m.sum[2] * m.sum[2]) - 3) < 0.1, "exponent %g: kurtosis %g", exponents[e],
                          m.sum[4] / (m.sum[2] * m.sum[2]));
        }
        arena_close(a);
    }
}
END_TEST

/* Eight times longer along the grain, which runs at 20 degrees: across it the trace is the recipe's, along it the
 * recipe's eight times coarser. */
START_TEST(grain_lengthens_one_way)
{
    static struct measured m;
    double along = 20 * M_PI / 180;
    struct arena *a = arena_open();
    struct relief_part *p = field(a, -2.4, (struct tiles_grain){8, along, false}, "grain");
    measure(p, along + M_PI / 2, 5e-6, &m);
    check_bands(&m, -2.4, 5e-6, 1, 110);
    measure(p, along, 40e-6, &m);
    check_bands(&m, -2.4, 40e-6, 8, 20);
    arena_close(a);
}
END_TEST

/* A takeover: traces of what has only radial frequencies above 0.7 of it. All the power of its rings, and nothing in
   directions' sum below: the field's own two-dimensional spectrum by the correlation of two parallel lines would say
   so; here, the rms. */
START_TEST(continuation_has_its_rings)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct spectrum s = spectrum_power_law(a, -2.4, 1e-4, 20e-6, 4e-6);
    static struct measured m;
    s.flat = false;
    s.takeover = 1e4 * sqrt(2);
    double want = 0, lost, step = 1.001, last = spectrum_beyond(&s, 1e4);
    for (double k = 1e4; k < spectrum_top(&s); k *= step) {
        double next = k * step < spectrum_top(&s) ? spectrum_beyond(&s, k * step) : 0;
        want += (last - next) * spectrum_takeover(&s, k * sqrt(step));
        last = next;
    }
    struct relief_part *p = tiles_part(a, &s, &(struct tiles_grain){1, 0, false}, noise_make(7, "takeover"), &lost, &e);
    ck_assert(p && lost == 0);
    measure(p, 0.4, 5e-6, &m);
    ck_assert_double_eq_tol(m.sum[2] * 16e-12 / want, 1, 0.02);
    arena_close(a);
}
END_TEST

START_TEST(derivatives_and_continuity)
{
    struct arena *a = arena_open();
    struct relief_part *round = field(a, -2.4, (struct tiles_grain){1, 0, false}, "c2"),
                       *grain = field(a, -1.5, (struct tiles_grain){5, 0.7, false}, "c2 grain");
    parts_derivatives(round, 0.05, true);
    parts_derivatives(grain, 0.05, true);
    /* second derivatives go through their whole range in some 2 pitches, which is 100 steps; block borders and patches
     * are crossed */
    parts_continuous(round, 100000, 0.01, 0, 0.2);
    parts_continuous(round, 100000, -0.01, 1.9, 0.2);
    parts_continuous(grain, 50000, -0.01, 0.4, 0.2);
    arena_close(a);
}
END_TEST

START_TEST(any_order)
{
    struct arena *a = arena_open();
    parts_any_order(field(a, -2.4, (struct tiles_grain){1, 0, false}, "order"),
                    field(a, -2.4, (struct tiles_grain){1, 0, false}, "order"), 3e-6);
    parts_any_order(field(a, -2, (struct tiles_grain){3, 1, false}, "order"),
                    field(a, -2, (struct tiles_grain){3, 1, false}, "order"), 40e-6);
    parts_asked_alone(field(a, -2, (struct tiles_grain){3, 1, false}, "order"));
    arena_close(a);
}
END_TEST

/* 30 m of straight path, a minute at 0.5 m/s: heights and, for the fine detail, second derivatives every 25 um.
   Autocorrelations beyond 0.3 m (some 16 blocks of the longest waves) are normal with the variance (sum of squared
   correlations)/n; of a million lags the largest reaches 4.9 deviations, 6.5 are allowed. */
START_TEST(nothing_repeats_in_a_minute)
{
    enum { N = 1 << 20, NEAR = 12000 };
    double *z = calloc(2 * N, sizeof *z), *x = calloc(N, sizeof *x), *y = calloc(N, sizeof *y);
    struct arena *a = arena_open();
    struct relief_part *p = field(a, -2.4, (struct tiles_grain){1, 0, false}, "repeat");
    for (int i = 0; i < N; i++)
        x[i] = 28e-6 * i, y[i] = 0.13;
    for (int bend = 0; bend < 2; bend++) {
        memset(z, 0, 2 * N * sizeof *z);
        p->add(p, &(struct relief_points){N, x, y},
               &(struct relief_values){.z = bend ? NULL : z, .xx = bend ? z : NULL});
        gsl_fft_real_radix2_transform(z, 1, 2 * N);
        z[0] *= z[0], z[N] *= z[N];
        for (int k = 1; k < N; k++) {
            z[k] = z[k] * z[k] + z[2 * N - k] * z[2 * N - k];
            z[2 * N - k] = 0;
        }
        gsl_fft_real_radix2_transform(z, 1, 2 * N);
        double reach = 0, worst = 0;
        for (int lag = 0; lag < NEAR; lag++)
            reach += (lag ? 2 : 1) * pow(z[lag] / z[0] * N / (N - lag), 2);
        for (int lag = NEAR; lag < N - NEAR; lag++)
            worst = fmax(worst, fabs(z[lag] / z[0]) * N / sqrt(reach * (N - lag)));
        ck_assert_double_lt(worst, 6.5);
        ck_assert_double_gt(worst, 3);
    }
    arena_close(a);
    free(z);
    free(x);
    free(y);
}
END_TEST

static double alike(struct relief_part *p, struct relief_part *q, double far)
{
    static double z[2][1 << 16];
    double sum[3] = {0};
    line(p, (double[2]){0, 0}, (double[2]){20e-6, 3e-6}, 1 << 16, z[0]);
    line(q, (double[2]){far, 0}, (double[2]){20e-6, 3e-6}, 1 << 16, z[1]);
    for (int i = 0; i < 1 << 16; i++)
        sum[0] += z[0][i] * z[1][i], sum[1] += z[0][i] * z[0][i], sum[2] += z[1][i] * z[1][i];
    return sum[0] / sqrt(sum[1] * sum[2]);
}

/* 1.3 m hold some 2000 independent heights: 5 deviations of their correlation. */
START_TEST(streams_and_far_places_differ)
{
    struct arena *a = arena_open();
    struct relief_part *p = field(a, -2.4, (struct tiles_grain){1, 0, false}, "a"),
                       *q = field(a, -2.4, (struct tiles_grain){1, 0, false}, "b");
    ck_assert_double_eq_tol(alike(p, p, 0), 1, 1e-12);
    ck_assert_double_lt(fabs(alike(p, q, 0)), 0.11);
    static const double far[] = {0.016, 1, 100, -50, 4194.304};
    for (int i = 0; i < 5; i++)
        ck_assert_double_lt(fabs(alike(p, p, far[i])), 0.11);
    arena_close(a);
}
END_TEST

START_TEST(refused_where_negative)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct spectrum s = spectrum_power_law(a, 1.5, 2e-3, 20e-6, 4e-6);
    double lost = 0;
    ck_assert_ptr_null(tiles_part(a, &s, &(struct tiles_grain){1, 0, false}, noise_make(1, "x"), NULL, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_ptr_nonnull(strstr(e.text, "lower the exponent"));
    ck_assert_ptr_nonnull(tiles_part(a, &s, &(struct tiles_grain){1, 0, false}, noise_make(1, "x"), &lost, &e));
    ck_assert_double_gt(lost, 0.01);
    arena_close(a);
}
END_TEST

/* What lies beyond 1/shortest, relative to the density just below: images of lower octaves and, next to the edge, the
   leak of the block's window (4.4e-5; with a corner at its ends 1.7e-4). Bounds are twice what tiles.c states. The
   estimate's own window has side lobes of -92 dB (Blackman and Harris, four terms). */
START_TEST(little_beyond_the_shortest)
{
    static const double exponents[] = {0, -2.4, -5}, bounds[] = {1.2e-4, 2.4e-4, 2e-3};
    static double z[SEGMENT], power[SEGMENT / 2];
    double pitch = 2.5e-6, dk = 1 / (SEGMENT * pitch);
    for (int e = 0; e < 3; e++) {
        struct arena *a = arena_open();
        struct relief_part *p = field(a, exponents[e], (struct tiles_grain){1, 0, false}, "beyond");
        double edge = 0, lines = 0, most = 0, next = 0;
        memset(power, 0, sizeof power);
        for (int s = 0; s < 60; s++) {
            line(p, (double[2]){1.3 * s, -0.6 * s}, (double[2]){pitch * cos(0.4), pitch * sin(0.4)}, SEGMENT, z);
            for (int i = 0; i < SEGMENT; i++) {
                double u = 2 * M_PI * (i + 0.5) / SEGMENT;
                z[i] *= 0.35875 - 0.48829 * cos(u) + 0.14128 * cos(2 * u) - 0.01168 * cos(3 * u);
            }
            gsl_fft_real_radix2_transform(z, 1, SEGMENT);
            for (int k = 1; k < SEGMENT / 2; k++)
                power[k] += z[k] * z[k] + z[SEGMENT - k] * z[SEGMENT - k];
        }
        for (int k = 1; k < SEGMENT / 2; k++) {
            double at = k * dk * 20e-6;
            if (at > 0.8 && at < 0.96) edge += power[k], lines++;
            if (at > 1.1 && at < 2.8) most = fmax(most, power[k]);
            if (at > 1.1 && at < 1.2) next = fmax(next, power[k]);
        }
        ck_assert_msg(most < bounds[e] * edge / lines, "exponent %g: %g of the edge", exponents[e],
                      most * lines / edge);
        if (e == 0) ck_assert_msg(next < 9e-5 * edge / lines, "next to the edge: %g", next * lines / edge);
        arena_close(a);
    }
}
END_TEST

/* ------------------------------------------------------------------ the plain form: each band for itself, block by
 * block */

static double spline(double x)
{
    double d = fabs(x), left = 2 - d;
    return d >= 2 ? 0 : d >= 1 ? left * left * left / 6 : 2.0 / 3 - d * d * (1 - d / 2);
}

static double spline_bend(double x)
{
    double d = fabs(x);
    return d >= 2 ? 0 : d >= 1 ? 2 - d : 3 * d - 2;
}

static double block_window(long i)
{
    double across = sin(M_PI * ((double)i + 0.5) / TILE_SIDE);
    return i < 0 || i >= TILE_SIDE ? 0 : sin(M_PI / 2 * across * across);
}

static double coefficient(const double *tile, struct noise own, long i, long j)
{
    long half = TILE_SIDE / 2, mask = TILE_SIDE - 1, bi = (i - (i & (half - 1))) / half,
         bj = (j - (j & (half - 1))) / half;
    double sum = 0;
    for (long by = bj - 1; by <= bj; by++)
        for (long bx = bi - 1; bx <= bi; bx++) {
            uint64_t bits[2];
            noise_bits(own, (uint64_t)by, (uint64_t)bx, bits);
            long x = i - bx * half, y = j - by * half, row = (y + (long)(bits[0] / TILE_SIDE % TILE_SIDE)) & mask,
                 column = (x + (long)(bits[0] % TILE_SIDE)) & mask;
            sum += (bits[1] & 1 ? 1 : -1) * block_window(x) * block_window(y) * tile[row * TILE_ROW + column];
        }
    return sum;
}

/* Adds height and second derivatives of one band. */
static void band_plainly(const double *tile, struct noise own, double pitch, double x, double y, double v[4])
{
    double p = x / pitch, q = y / pitch;
    for (long j = (long)floor(q) - 1; j <= (long)floor(q) + 2; j++)
        for (long i = (long)floor(p) - 1; i <= (long)floor(p) + 2; i++) {
            double c = coefficient(tile, own, i, j), f = p - (double)i, g = q - (double)j, step = 1e-4;
            v[0] += c * spline(f) * spline(g);
            v[1] += c * spline_bend(f) * spline(g) / (pitch * pitch);
            v[2] += c * (spline(f + step) - spline(f - step)) * (spline(g + step) - spline(g - step)) /
                    (4 * step * step * pitch * pitch);
            v[3] += c * spline(f) * spline_bend(g) / (pitch * pitch);
        }
}

/* Bands that are refined into one another and read as one, against their sum; along a path, and in places far apart,
   that patches jump between. xy by differences: to 1e-8. */
START_TEST(the_sum_of_its_bands)
{
    struct arena *a = arena_open();
    struct spectrum s = spectrum_power_law(a, -2.4, 2e-3, 20e-6, 4e-6);
    struct relief_part *p = field(a, -2.4, (struct tiles_grain){1, 0, false}, "bands");
    struct fft_plane *fft = fft_plane_open(TILE_SIDE);
    double(*power)[TILE_LINES] = (double(*)[TILE_LINES])ARENA_TAKE(a, double, TILE_BANDS *TILE_LINES),
    *tiles[TILE_BANDS];
    struct noise own[TILE_BANDS];
    int bands = tiles_rings(&s, power);
    tiles_mend(bands, power);
    for (int b = 0; b < bands; b++) {
        uint64_t key[2];
        noise_bits(noise_make(7, "bands"), (uint64_t)b, UINT64_MAX, key);
        own[b] = (struct noise){key[0]};
        tiles[b] = ARENA_TAKE(a, double, TILE_SIDE *TILE_ROW);
        tiles_tile(power[b], own[b], fft, tiles[b]);
    }
    ck_assert_int_ge(bands, 6);
    srand48(3);
    for (int n = 0; n < 6000; n++) {
        double x = n < 3000 ? 0.1 - 2.3e-6 * n : 2 * drand48() - 1,
               y = n < 3000 ? -0.02 + 1.1e-6 * n : 2 * drand48() - 1, got[4] = {0}, want[4] = {0}, size = 4e-6;
        p->add(p, &(struct relief_points){1, &x, &y},
               &(struct relief_values){.z = &got[0], .xx = &got[1], .xy = &got[2], .yy = &got[3]});
        for (int b = 0; b < bands; b++)
            band_plainly(tiles[b], own[b], 5e-6 * (1 << b), x, y, want);
        for (int k = 0; k < 4; k++, size = 1e5)
            ck_assert_double_eq_tol(got[k] / size, want[k] / size, k == 0 ? 1e-11 : 2e-7);
    }
    fft_plane_close(fft);
    arena_close(a);
}
END_TEST

UNIT("tiles", the_sum_of_its_bands, UNIT_LONG(traces_have_the_spectrum_in_every_direction),
     UNIT_LONG(grain_lengthens_one_way), continuation_has_its_rings, derivatives_and_continuity, any_order,
     nothing_repeats_in_a_minute, little_beyond_the_shortest, streams_and_far_places_differ, refused_where_negative)
