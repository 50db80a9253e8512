/* distance: against closed forms, and band powers against a slow DFT with the frequency axis cut into a million pieces.
 */
#include <stdint.h>

#include "analysis/distance.h"
#include "unit.h"

static const double pi = 3.14159265358979323846;

static double noise(uint32_t *s) /* uniform in [-1, 1) */
{
    *s = *s * 1664525 + 1013904223;
    return *s / 2147483648.0 - 1;
}

START_TEST(snr_of_a_scaled_copy)
{
    enum { N = 5000 };
    static double x[2 * N], y[2 * N];
    uint32_t s = 1;
    for (int i = 0; i < 2 * N; i++) {
        x[i] = noise(&s);
        y[i] = x[i] * (1 + 1e-3); /* the error is 1e-3 of the signal: 60 dB */
    }
    struct wav a = {.rate = 48000, .channels = 2, .frames = N, .x = x}, b = a;
    struct distance_samples d;
    b.x = y;
    distance_samples(&a, &b, &d);
    ck_assert_double_eq_tol(d.snr_db, 60, 1e-9); /* rounding of y: 1e-16 / 1e-3 relative */
    ck_assert_uint_eq(d.frames, N);
    ck_assert_uint_eq(d.differing, 2 * N);
    for (int i = 0; i < 2 * N; i++)
        y[i] = x[i] + (i % 2 ? 0.01 : -0.01); /* error 1e-4; signal 1/3 */
    distance_samples(&a, &b, &d);
    ck_assert_double_eq_tol(d.snr_db, 10 * log10(1e4 / 3), 0.06); /* the signal's variance from 10^4 numbers: 0.9 % */
    ck_assert_double_eq_tol(d.largest, 0.01, 1e-15);
}
END_TEST

START_TEST(counts_and_places)
{
    double x[] = {0, 0.5, 0.25, -0.5, 0.125, 0}, y[] = {0, 0.5, 0.25, -0.5 + 3.0 / 32768, 0.125, -5.0 / 32768, 9, 9};
    struct wav a = {.rate = 100, .channels = 2, .frames = 3, .x = x, .bits = 16}, b = {100, 2, 4, y, 24};
    struct distance_samples d;
    distance_samples(&a, &b, &d);
    ck_assert_uint_eq(d.frames, 3);
    ck_assert_uint_eq(d.differing, 2);
    ck_assert(d.first.frame == 1 && d.first.channel == 1 && d.first.a == -0.5 && d.first.b == y[3]);
    ck_assert(d.worst.frame == 2 && d.worst.channel == 1 && d.worst.a == 0 && d.worst.b == y[5]);
    ck_assert_double_eq(d.largest / distance_step(&a, &b), 5); /* steps of the coarser, 16 bits */
    y[0] = 5.0 / 32768;                                        /* as far off: the first of them is told */
    distance_samples(&a, &b, &d);
    ck_assert(d.worst.frame == 0 && d.worst.channel == 0 && d.differing == 3);
    ck_assert_double_eq(distance_step(&b, &b), 1.0 / 8388608);
    b.bits = 0;
    ck_assert_double_eq(distance_step(&b, &a), 1.0 / 32768);
    ck_assert_double_eq(distance_step(&b, &b), 0);
}
END_TEST

START_TEST(equal_and_silent)
{
    double x[] = {0.5, 0.25}, zero[] = {0, -0.0}, nothing[] = {0, 0};
    struct wav a = {.rate = 100, .channels = 1, .frames = 2, .x = x},
               b = {.rate = 100, .channels = 1, .frames = 2, .x = zero}, c = b;
    struct distance_samples d;
    distance_samples(&a, &a, &d);
    ck_assert(d.differing == 0 && d.largest == 0 && d.snr_db == INFINITY);
    distance_samples(&b, &a, &d);
    ck_assert(d.differing == 2 && d.snr_db == -INFINITY);
    distance_samples(&a, &b, &d);
    ck_assert(d.snr_db == 0); /* the error is the signal */
    c.x = nothing;
    distance_samples(&b, &c, &d);
    ck_assert(d.differing == 0 && d.snr_db == INFINITY);
}
END_TEST

/* The definition in distance.h, packed and hashed by other programs (Python's struct and hashlib). */
START_TEST(hash_of_the_audio)
{
    static double x[] = {0, 0.5, -0.25, -0.0, 1.0 / 3, -1}, many[15000];
    char hex[HASH_TEXT], other[HASH_TEXT];
    uint32_t s = 1;
    struct wav w = {.rate = 48000, .channels = 2, .frames = 3, .x = x, .bits = 16},
               v = {.rate = 44100, .channels = 3, .frames = 5000, .x = many};
    for (int i = 0; i < 15000; i++)
        many[i] = noise(&s);
    distance_hash(&w, hex);
    ck_assert_str_eq(hex, "815c0e9b082018cb5982b696444918ebe357f2fd34293be68037bf437648954d");
    distance_hash(&v, other);
    ck_assert_str_eq(other, "acf7d8fa658296e8b88d2d357550b5062f8923e0a04bbc37aac7a835bc109fd9");
    w.bits = 24; /* how samples were stored is no matter, nor the sign of 0 */
    x[3] = 0;
    distance_hash(&w, other);
    ck_assert_str_eq(other, hex);
}
END_TEST

/* Same hash and "all samples equal" are one verdict: for each change of a sample, the rate, the shape. */
START_TEST(hash_agrees_with_exactness)
{
    double x[] = {0, 0.5, -0.25, 0, 0.75, -1}, y[6];
    char hex[HASH_TEXT], other[HASH_TEXT];
    struct wav a = {.rate = 48000, .channels = 1, .frames = 6, .x = x}, b;
    struct distance_samples d;
    distance_hash(&a, hex);
    for (int k = 0; k < 12; k++) {
        memcpy(y, x, sizeof y);
        b = a;
        b.x = y;
        y[k % 6] = k < 6 ? nextafter(y[k], 2) : y[k % 6] == 0 ? -0.0 : y[k % 6];
        distance_samples(&a, &b, &d);
        distance_hash(&b, other);
        ck_assert_int_eq(d.differing == 0, strcmp(hex, other) == 0);
        ck_assert_int_eq(d.differing == 0, k >= 6);
    }
    struct wav changed[] = {{48001, 1, 6, x, 0}, {48000, 2, 3, x, 0}, {48000, 3, 2, x, 0}, {48000, 1, 5, x, 0}};
    for (int k = 0; k < 4; k++) {
        distance_hash(&changed[k], other);
        ck_assert_str_ne(hex, other);
    }
}
END_TEST

START_TEST(centres)
{
    ck_assert_double_eq_tol(distance_band_centre(0), 25.1188643150958, 1e-11);
    ck_assert_double_eq_tol(distance_band_centre(DISTANCE_BAND_1000), 1000, 1e-10);
    ck_assert_double_eq_tol(distance_band_centre(29), 19952.6231496888, 1e-8);
    for (int i = 0; i < DISTANCE_BANDS; i++) /* nominal names are within 2 % of the exact centres */
        ck_assert_double_eq_tol(distance_band_nominal(i) / distance_band_centre(i), 1, 0.02);
}
END_TEST

START_TEST(sine_is_its_rms_in_its_band)
{
    enum { N = 48000 };
    static double x[N];
    static const struct {
        double hz, amplitude;
        int band;
    } cases[] = {{1000, 1, 16}, {25, 0.5, 0}, {440, 0.1, 12}, {19000, 0.25, 29}, {890, 1e-4, 15}, {892, 1e-4, 16}};
    struct arena *arena = arena_open();
    struct wav w = {.rate = 48000, .channels = 1, .frames = N, .x = x};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        double level[DISTANCE_BANDS];
        for (int i = 0; i < N; i++)
            x[i] = cases[c].amplitude * sin(2 * pi * fmod(cases[c].hz * i / 48000, 1));
        distance_band_levels(&w, arena, level);
        for (int b = 0; b < DISTANCE_BANDS; b++)
            if (b == cases[c].band)
                ck_assert_double_eq_tol(level[b], 20 * log10(cases[c].amplitude / sqrt(2)),
                                        1e-9); /* whole periods: one bin */
            else
                ck_assert_double_lt(level[b], -230); /* rounding */
    }
    arena_close(arena);
}
END_TEST

START_TEST(bin_on_an_edge_is_shared)
{
    /* One bin is 100 Hz wide; 900 Hz stands for 850 .. 950 Hz, and the edge at 891.25 Hz splits it. */
    double x[480], level[DISTANCE_BANDS], edge = 1000 * pow(10, -0.05);
    struct arena *arena = arena_open();
    struct wav w = {.rate = 48000, .channels = 1, .frames = 480, .x = x};
    for (int i = 0; i < 480; i++)
        x[i] = sqrt(2) * cos(2 * pi * 9 * i / 480);
    distance_band_levels(&w, arena, level);
    ck_assert_double_eq_tol(pow(10, level[15] / 10), (edge - 850) / 100, 1e-12);
    ck_assert_double_eq_tol(pow(10, level[16] / 10), (950 - edge) / 100, 1e-12);
    arena_close(arena);
}
END_TEST

START_TEST(white_rises_a_decibel_per_band)
{
    enum { N = 1 << 19 };
    static double x[N];
    double level[DISTANCE_BANDS];
    struct arena *arena = arena_open();
    struct wav w = {.rate = 48000, .channels = 1, .frames = N, .x = x};
    x[12345] = 1; /* an impulse is exactly white: band share = bandwidth / Nyquist */
    distance_band_levels(&w, arena, level);
    for (int b = 0; b < DISTANCE_BANDS; b++) {
        double width = distance_band_centre(b) * (pow(10, 0.05) - pow(10, -0.05));
        ck_assert_double_eq_tol(level[b], 10 * log10(width / 24000 / N), 1e-9);
        ck_assert(b == 0 || fabs(level[b] - level[b - 1] - 1) < 1e-9);
    }
    uint32_t s = 7;
    for (int i = 0; i < N; i++)
        x[i] = noise(&s) + noise(&s) + noise(&s); /* variance 1 */
    distance_band_levels(&w, arena, level);
    for (int b = 0; b < DISTANCE_BANDS;
         b++) { /* relative deviation of a band's power: 1 / sqrt(bandwidth * duration) */
        double width = distance_band_centre(b) * (pow(10, 0.05) - pow(10, -0.05)),
               sigma = 4.343 / sqrt(width * N / 48000);
        ck_assert_double_eq_tol(level[b], 10 * log10(width / 24000), 4 * sigma);
    }
    arena_close(arena);
}
END_TEST

/* Power density of a signal by the definition of the DFT, integrated over a band in steps of a millionth of the Nyquist
 * frequency. */
static double slow_band(const double *x, int n, double rate, const double edge[2])
{
    enum { STEPS = 1000000 };
    double sum = 0, *p = calloc((size_t)n / 2 + 1, sizeof *p);
    for (int k = 0; k <= n / 2; k++) {
        double re = 0, im = 0;
        for (int i = 0; i < n; i++) {
            re += x[i] * cos(2 * pi * k * i / n);
            im -= x[i] * sin(2 * pi * k * i / n);
        }
        double bins = k == 0 || k == n / 2 ? 0.5 : 1;
        p[k] = (k == 0 || k == n / 2 ? 1 : 2) * (re * re + im * im) / ((double)n * n) / bins; /* per bin width */
    }
    for (int j = 0; j < STEPS; j++) {
        double f = (j + 0.5) / STEPS * rate / 2;
        if (f >= edge[0] && f < edge[1]) sum += p[(int)(f / rate * n + 0.5)] * (n / 2.0) / STEPS;
    }
    free(p);
    return sum;
}

START_TEST(bands_as_a_slow_transform_has_them)
{
    enum { N = 300 }; /* 2^2 3 5^2: not padded */
    double x[2 * N], level[2 * DISTANCE_BANDS];
    uint32_t s = 3;
    struct arena *arena = arena_open();
    struct wav w = {.rate = 8000, .channels = 2, .frames = N, .x = x};
    for (int i = 0; i < 2 * N; i++)
        x[i] = noise(&s) * exp(-i / 200.0);
    distance_band_levels(&w, arena, level);
    for (int c = 0; c < 2; c++) {
        double one[N];
        for (int i = 0; i < N; i++)
            one[i] = x[2 * i + c];
        for (int b = 1; b < DISTANCE_BANDS; b += 3) { /* among them the one that the Nyquist frequency cuts */
            double edge[2] = {distance_band_centre(b) * pow(10, -0.05), distance_band_centre(b) * pow(10, 0.05)};
            double want = slow_band(one, N, 8000, edge);
            if (edge[0] >= 4000)
                ck_assert(level[c * DISTANCE_BANDS + b] == -INFINITY);
            else /* the slow sum misses up to a step of 4 mHz at each edge: 8 mHz / 5.8 Hz */
                ck_assert_double_eq_tol(pow(10, level[c * DISTANCE_BANDS + b] / 10) / want, 1, 2e-3);
        }
    }
    arena_close(arena);
}
END_TEST

START_TEST(padded_and_cut_sounds_keep_their_level)
{
    enum { LONG = (1 << 20) + 77777 };
    static const int lengths[] = {7001, 65537, LONG}; /* primes, padded; longer than a piece */
    static double x[LONG];
    struct arena *arena = arena_open();
    for (int i = 0; i < LONG; i++)
        x[i] = sin(2 * pi * fmod(1000.0 * i / 48000, 1));
    for (int k = 0; k < 3; k++) {
        double level[DISTANCE_BANDS];
        struct wav w = {.rate = 48000, .channels = 1, .frames = (size_t)lengths[k], .x = x};
        distance_band_levels(&w, arena, level);
        /* The skirts of a cut sine outside its band (109 Hz away at least): 1 / (pi^2 T 109 Hz) of the power on each
         * side. */
        double lost = 2 * 48000.0 / lengths[k] / (pi * pi * 109);
        ck_assert_double_le(level[16], 20 * log10(1 / sqrt(2)) + 0.01);
        ck_assert_double_ge(level[16], 20 * log10(1 / sqrt(2)) + 10 * log10(1 - lost) - 0.01);
    }
    arena_close(arena);
}
END_TEST

START_TEST(bin_at_zero_is_half_as_wide)
{
    double x[100], level[DISTANCE_BANDS]; /* bins are 80 Hz wide: 0 .. 40, 40 .. 120 */
    struct arena *arena = arena_open();
    struct wav w = {.rate = 8000, .channels = 1, .frames = 100, .x = x};
    for (int i = 0; i < 100; i++)
        x[i] = 1;
    distance_band_levels(&w, arena, level);
    ck_assert_double_eq_tol(pow(10, level[0] / 10), distance_band_centre(0) * (pow(10, 0.05) - pow(10, -0.05)) / 40,
                            1e-12);
    arena_close(arena);
}
END_TEST

START_TEST(last_frame_of_a_cut_sound_counts)
{
    enum { N = (1 << 20) + 1 }; /* a piece and a frame */
    static double x[N];
    double level[DISTANCE_BANDS];
    struct arena *arena = arena_open();
    struct wav w = {.rate = 48000, .channels = 1, .frames = N, .x = x};
    x[N - 1] = 1;
    distance_band_levels(&w, arena, level);
    for (int b = 0; b < DISTANCE_BANDS; b++) {
        double width = distance_band_centre(b) * (pow(10, 0.05) - pow(10, -0.05));
        ck_assert_double_eq_tol(level[b], 10 * log10(width / 24000 / N), 1e-9);
    }
    arena_close(arena);
}
END_TEST

START_TEST(worst_band)
{
    enum { N = 9600 };
    static double x[2 * N], y[2 * N];
    struct distance_bands d;
    struct arena *arena = arena_open();
    for (int i = 0; i < N; i++) {
        double one = sin(2 * pi * (i % 48) / 48), quiet = sin(2 * pi * (i % 12) / 12);
        x[2 * i] = y[2 * i] = one + 1e-2 * quiet; /* 1000 Hz and, 40 dB below, 4000 Hz */
        x[2 * i + 1] = one + 1e-2 * quiet + 1e-4 * sin(2 * pi * (i % 4) / 4);
        y[2 * i + 1] = one + 2e-2 * quiet + 5e-4 * sin(2 * pi * (i % 4) / 4);
    }
    struct wav a = {.rate = 48000, .channels = 2, .frames = N, .x = x}, b = a;
    b.x = y;
    distance_bands(&a, &b, 60, arena, &d);
    ck_assert(d.compared == 4 && d.channel == 1 && distance_band_nominal(d.band) == 4000);
    ck_assert_double_eq_tol(d.worst_db, 20 * log10(2), 1e-9);
    ck_assert_double_eq_tol(d.b_db - d.a_db, 20 * log10(2), 1e-9);
    distance_bands(&a, &b, 70, arena, &d); /* now the 12 kHz, 66 dB below in b, count too */
    ck_assert(d.compared == 5 && distance_band_nominal(d.band) == 12500);
    ck_assert_double_eq_tol(d.worst_db, 20 * log10(5), 1e-6);
    distance_bands(&a, &a, 60, arena, &d);
    ck_assert(d.worst_db == 0 && d.compared == 4);
    memset(y, 0, sizeof y);
    distance_bands(&a, &b, 60, arena, &d); /* against silence */
    ck_assert(d.worst_db == INFINITY && d.b_db == -INFINITY);
    distance_bands(&b, &b, 60, arena, &d);
    ck_assert(d.compared == 0 && d.worst_db == 0);
    arena_close(arena);
}
END_TEST

START_TEST(bands_across_rates)
{
    enum { N = 48000 };
    static double x[N], y[N];
    struct distance_bands d;
    struct arena *arena = arena_open();
    struct wav a = {.rate = 48000, .channels = 1, .frames = 48000, .x = x},
               b = {.rate = 16000, .channels = 1, .frames = 16000, .x = y};
    for (int i = 0; i < N;
         i++) { /* the 7700 Hz lie in the band at 8 kHz, which goes on above the Nyquist frequency of b */
        x[i] = sin(2 * pi * fmod(1000.0 * i / 48000, 1)) + sin(2 * pi * fmod(7700.0 * i / 48000, 1));
        y[i] = sin(2 * pi * fmod(1000.0 * i / 16000, 1));
    }
    distance_bands(&a, &b, 60, arena, &d);
    ck_assert_int_eq(d.compared, 1);
    ck_assert_double_lt(d.worst_db, 1e-9);
    arena_close(arena);
}
END_TEST

UNIT("distance", snr_of_a_scaled_copy, counts_and_places, equal_and_silent, hash_of_the_audio,
     hash_agrees_with_exactness, centres, sine_is_its_rms_in_its_band, bin_on_an_edge_is_shared,
     white_rises_a_decibel_per_band, bands_as_a_slow_transform_has_them, padded_and_cut_sounds_keep_their_level,
     bin_at_zero_is_half_as_wide, last_frame_of_a_cut_sound_counts, worst_band, bands_across_rates)
