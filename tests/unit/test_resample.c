/* Sample-rate conversion against closed forms at the other rate, and a hash that every CPU must reproduce. */
#include "unit.h"

#include <stdint.h>

#include "num/resample.h"

static const double pairs[][2] = {{44100, 48000},  {48000, 44100}, {96000, 44100},  {44100, 96000},
                                  {44100, 47999},  {48000, 44101}, {22050, 44100},  {44100, 22050},
                                  {192000, 44100}, {8000, 48000},  {44100, 192000}, {96000, 48000}};
enum { PAIRS = sizeof pairs / sizeof pairs[0] };

/* u^9 e^-u sin(2 pi f t), u = t/tau: a decaying sine whose start is so soft that 40 bandwidths from f nothing is left:
 * (1/40)^10 = -320 dB. */
static double soft(double t, double f)
{
    double u = t * 4000, turn = 2 * M_PI * fmod(f * t, 1);
    return t < 0 ? 0 : pow(u / 9, 9) * exp(9 - u) * sin(turn);
}

/* Gaussian around 0.1 s: a sine as long as a window of smooth edges allows. */
static double steady(double t, double f)
{
    double u = (t - 0.1) / 0.012;
    return exp(-0.5 * u * u) * sin(2 * M_PI * fmod(f * t, 1) + 0.3);
}

/* dB of the largest error, relative to the largest sample. */
static double error_of(const double rate[2], double (*signal)(double, double), double f)
{
    struct arena *a = arena_open();
    struct err e = {0};
    size_t n = (size_t)(0.2 * rate[0]), m;
    double *x = ARENA_TAKE(a, double, n), *y, most = 0, peak = 0;
    for (size_t i = 0; i < n; i++)
        x[i] = signal((double)i / rate[0], f);
    ck_assert_msg(resample(a, x, n, rate[0], rate[1], &y, &m, &e), "%s", e.text);
    ck_assert_uint_eq(m, (size_t)ceil((double)n * rate[1] / rate[0]));
    for (size_t i = 0; i < m; i++) {
        double want = signal((double)i / rate[1], f);
        most = fmax(most, fabs(y[i] - want));
        peak = fmax(peak, fabs(want));
    }
    arena_close(a);
    return 20 * log10(most / peak);
}

/* Up, down, small fractions and odd ones. Demanded: 168 dB, libsoxr's 28 bits; a sample of delay would give +6 dB, a
 * gain of 1e-7 -140 dB. */
START_TEST(closed_forms)
{
    for (int k = 0; k < PAIRS; k++) {
        double low = 0.5 * fmin(pairs[k][0], pairs[k][1]), worst = -999;
        static const double places[] = {0.02, 0.1, 0.31, 0.5, 0.77, 0.88};
        for (int i = 0; i < 6; i++) {
            double d = error_of(pairs[k], steady, places[i] * low);
            worst = fmax(worst, d);
        }
        double decaying = low > 20000 ? error_of(pairs[k], soft, 0.2 * low) : -999;
        printf("%g -> %g: sines %.1f dB, decaying %.1f dB\n", pairs[k][0], pairs[k][1], worst, decaying);
        ck_assert_double_lt(worst, -168);
        ck_assert_double_lt(decaying, -168);
    }
}
END_TEST

/* What lies above the new Nyquist frequency is gone. */
START_TEST(no_aliases)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double *x = ARENA_TAKE(a, double, 19200), *y;
    size_t m;
    for (int i = 0; i < 19200; i++)
        x[i] = steady(i / 96000.0, 27000);
    ck_assert(resample(a, x, 19200, 96000, 44100, &y, &m, &e));
    for (size_t i = 0; i < m; i++)
        ck_assert_double_lt(fabs(y[i]), 1e-8);
    arena_close(a);
}
END_TEST

/* At instants that both rates have, a doubled rate keeps the samples of a band-limited signal; an impulse stays where
 * it is, symmetric. */
START_TEST(no_delay_and_linear_phase)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double x[401] = {0}, *y;
    size_t m;
    x[200] = 1;
    ck_assert(resample(a, x, 401, 24000, 48000, &y, &m, &e));
    ck_assert_uint_eq(m, 802);
    for (int k = 0; k < 400; k++)
        ck_assert_double_eq_tol(y[400 - k], y[400 + k], 1e-9);
    double sum = 0;
    for (size_t k = 0; k < m; k++)
        sum += y[k];
    ck_assert_double_eq_tol(sum, 2, 1e-7); /* values per second stay: twice as many */
    for (int k = 0; k < 400; k++)
        ck_assert_double_le(y[k], y[400]);
    arena_close(a);
}
END_TEST

START_TEST(equal_rates_copy)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double x[3] = {1, -2, 0.3}, *y;
    size_t m;
    ck_assert(resample(a, x, 3, 44100, 44100, &y, &m, &e));
    ck_assert_uint_eq(m, 3);
    ck_assert_mem_eq(x, y, sizeof x);
    ck_assert(!resample(a, x, 3, 1, 44100, &y, &m, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    arena_close(a);
}
END_TEST

/* One sample, a few, many: always ceil(n rate_out / rate_in). */
START_TEST(lengths)
{
    struct arena *a = arena_open();
    struct err e = {0};
    static double x[5000];
    x[0] = 1;
    for (int k = 0; k < PAIRS; k++)
        for (size_t n = 1; n <= 5000; n = 3 * n + 1) {
            double *y;
            size_t m;
            ck_assert_msg(resample(a, x, n, pairs[k][0], pairs[k][1], &y, &m, &e), "%s", e.text);
            ck_assert_uint_eq(m, (size_t)ceil((double)n * pairs[k][1] / pairs[k][0]));
        }
    arena_close(a);
}
END_TEST

/* What begins at full height keeps its sum over the rate, and its time of arrival: noise, a single sample, a jump, at
   the pairs above and at rates that have no small common measure. What rings after the end is in the zeros behind it.
   Demanded: a gain at 0 Hz of 1 within 1e-8 (libsoxr: -172 dB); a place within 1e-5 samples. */
START_TEST(sum_from_the_first_sample)
{
    static const double odd[][2] = {{12345.678, 48000}, {31415.926535, 44100}, {51200, 44100}, {1000, 192000}};
    srand48(5);
    for (int k = 0; k < PAIRS + 4; k++)
        for (int kind = 0; kind < 3; kind++) {
            const double *rate = k < PAIRS ? pairs[k] : odd[k - PAIRS];
            size_t n = 300 + (size_t)(2 * RESAMPLE_REACH * fmax(1, rate[0] / rate[1])), m;
            struct arena *a = arena_open();
            struct err e = {0};
            double *x = ARENA_TAKE(a, double, n), *y, in[2] = {0}, out[2] = {0}, size = 0;
            for (int i = 0; i < (kind == 0 ? 300 : kind == 1 ? 1 : 200); i++)
                x[i] = kind == 0 ? drand48() - 0.3 : 1;
            ck_assert_msg(resample(a, x, n, rate[0], rate[1], &y, &m, &e), "%s", e.text);
            for (size_t i = 0; i < n; i++) {
                in[0] += x[i] / rate[0];
                in[1] += x[i] * ((double)i / rate[0]) / rate[0];
                size += fabs(x[i]) / rate[0];
            }
            for (size_t i = 0; i < m; i++) {
                out[0] += y[i] / rate[1];
                out[1] += y[i] * ((double)i / rate[1]) / rate[1];
            }
            ck_assert_double_eq_tol(out[0], in[0], 1e-8 * size);
            ck_assert_double_eq_tol(out[1], in[1], 1e-5 * size / fmin(rate[0], rate[1]));
            arena_close(a);
        }
}
END_TEST

/* One hash of libsoxr 0.1.3 for every CPU, with and without FMA and AVX, whatever the environment holds. It fails when
   libsoxr has its filters from glibc's libm (GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2 shows it) or takes its AVX
   engine. */
START_TEST(bits)
{
    struct arena *a = arena_open();
    struct err e = {0};
    uint64_t state = 1, hash = 14695981039346656037ULL;
    static double x[30000];
    setenv("SOXR_USE_SIMD64", "1", 1);
    setenv("SOXR_COEF_INTERP", "2", 1);
    for (int i = 0; i < 30000; i++) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        x[i] = (double)(state >> 11) * 0x1p-53 - 0.5;
    }
    for (int k = 0; k < PAIRS; k++) {
        double *y;
        size_t m;
        ck_assert(resample(a, x, 30000, pairs[k][0], pairs[k][1], &y, &m, &e));
        for (size_t i = 0; i < m * sizeof *y; i++)
            hash = (hash ^ ((unsigned char *)y)[i]) * 1099511628211ULL;
    }
    printf("%016llx\n", (unsigned long long)hash);
    ck_assert_uint_eq(hash, 16994363734115478955ULL);
    arena_close(a);
}
END_TEST

UNIT("resample", closed_forms, no_aliases, no_delay_and_linear_phase, equal_rates_copy, lengths,
     sum_from_the_first_sample, bits)
