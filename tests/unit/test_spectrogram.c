/* Spectrograms against closed forms: levels of sines on and between bins, a chirp's ridge, Parseval's theorem on noise,
 * mean power. */
#include "output/spectrogram.h"
#include "unit.h"

#define PI 3.14159265358979323846

enum { RATE = 48000, WINDOW = 960 }; /* 20 ms: a good size already */

static struct arena *a;

static struct spectrogram make(const double *x, size_t n, double from, double to, int columns)
{
    struct spectrogram g;
    spectrogram_make(&(struct spectrogram_of){x, n, RATE, from, to, columns}, a, &g);
    ck_assert_int_eq(g.columns, columns);
    ck_assert_uint_eq(g.window, WINDOW);
    ck_assert_int_eq(g.bins, WINDOW / 2 + 1);
    ck_assert_double_eq(g.bin_hz, 50);
    return g;
}

static double at(const struct spectrogram *g, int bin, int column) { return g->db[bin * g->columns + column]; }

static int loudest(const struct spectrogram *g, int column)
{
    int best = 0;
    for (int k = 1; k < g->bins; k++)
        best = at(g, k, column) > at(g, best, column) ? k : best;
    return best;
}

static double *sine(size_t n, double amplitude, double hz)
{
    double *x = ARENA_TAKE(a, double, n);
    for (size_t i = 0; i < n; i++)
        x[i] = amplitude * sin(2 * PI * hz * (double)i / RATE + 0.7);
    return x;
}

/* Repeats, so that tests repeat: xorshift, uniform in [-1, 1). */
static double *noise(size_t n)
{
    unsigned long long s = 88172645463325252ull;
    double *x = ARENA_TAKE(a, double, n);
    for (size_t i = 0; i < n; i++) {
        s ^= s << 13;
        s ^= s >> 7;
        s ^= s << 17;
        x[i] = (double)(s >> 11) / 4503599627370496.0 - 1;
    }
    return x;
}

/* On bin k the periodic Hann window leaves the amplitude in k, half of it in k - 1 and k + 1, and nothing elsewhere.
   Tolerance: rounding of the sine's argument, 1e-10 dB. */
START_TEST(sine_on_a_bin)
{
    a = arena_open();
    struct spectrogram g = make(sine(RATE, 1, 1000), RATE, 0.2, 0.8, 7),
                       h = make(sine(RATE, 0.01, 1000), RATE, 0.2, 0.8, 1);
    for (int c = 0; c < 7; c++) {
        ck_assert_int_eq(loudest(&g, c), 20);
        ck_assert_double_eq_tol(at(&g, 20, c), 0, 1e-10);
        ck_assert_double_eq_tol(at(&g, 19, c), 20 * log10(0.5), 1e-10);
        ck_assert_double_eq_tol(at(&g, 21, c), 20 * log10(0.5), 1e-10);
        ck_assert_double_lt(at(&g, 25, c), -230);
    }
    ck_assert_double_eq_tol(at(&h, 20, 0), -40, 1e-10);
    arena_close(a);
}
END_TEST

/* Half-way between bins the Hann window's transform is 8/(3 pi) of its maximum. The mirror image at -f, 80 bins away,
   falls with the third power: less than 1e-5, 1e-4 dB. */
START_TEST(sine_between_bins)
{
    a = arena_open();
    struct spectrogram g = make(sine(RATE, 1, 2025), RATE, 0.2, 0.8, 3);
    for (int c = 0; c < 3; c++) {
        ck_assert_double_eq_tol(at(&g, 40, c), 20 * log10(8 / (3 * PI)), 1e-4);
        ck_assert_double_eq_tol(at(&g, 41, c), 20 * log10(8 / (3 * PI)), 1e-4);
    }
    arena_close(a);
}
END_TEST

/* f(t) = 500 Hz + 9000 Hz/s t over 2 s, 100 columns: each column's loudest bin is the frequency at its middle, within
 * one bin. */
START_TEST(chirp)
{
    size_t n = 2 * RATE;
    a = arena_open();
    double *x = ARENA_TAKE(a, double, n);
    for (size_t i = 0; i < n; i++) {
        double t = (double)i / RATE;
        x[i] = sin(2 * PI * (500 + 4500 * t) * t);
    }
    struct spectrogram g = make(x, n, 0, 2, 100);
    for (int c = 1; c < 99; c++)
        ck_assert_double_le(fabs(loudest(&g, c) * g.bin_hz - (500 + 9000 * (c + 0.5) * 0.02)), g.bin_hz);
    arena_close(a);
}
END_TEST

/* One window around frame 4800: sum over the bins, both signs of frequency, of |X_k|^2 is n times the energy of w x,
   where A_k = 2 |X_k| / W and W = n / 2. Tolerance: rounding. */
START_TEST(parseval)
{
    a = arena_open();
    double *x = noise(RATE), sum = 0, energy = 0, half = WINDOW / 4.0;
    double width = 100.0 / RATE; /* narrower than half a window */
    struct spectrogram g = make(x, RATE, 0.1 - width / 2, 0.1 + width / 2, 1);
    for (int k = 0; k < g.bins; k++)
        sum += (k == 0 || k == g.bins - 1 ? 1 : 2) * pow(10, at(&g, k, 0) / 10) * half * half;
    for (int i = 0; i < WINDOW; i++) {
        double w = 0.5 * (1 - cos(2 * PI * i / WINDOW)) * x[4800 - WINDOW / 2 + i];
        energy += w * w;
    }
    ck_assert_double_eq_tol(sum / (WINDOW * energy), 1, 1e-12);
    arena_close(a);
}
END_TEST

/* A wide column is the mean power of its windows. 1 s of sine in 4 s, one column: 1/4 but for the edges. With windows
   every h samples each weighs h/(4 s), and those that the sine's two ends cut each add less than one window: 2 h/(1 s)
   relative, 0.09 dB at h = 480. And a click of one sample is seen wherever it falls: at worst half-way between two
   windows, where each weighs 1/2: -3.01 dB. */
START_TEST(wide_columns)
{
    size_t n = 4 * RATE;
    a = arena_open();
    double *x = sine(n, 1, 1000);
    for (size_t i = 0; i < n; i++)
        x[i] = i < RATE || i >= 2 * RATE ? 0 : x[i];
    struct spectrogram g = make(x, n, 0, 4, 1);
    ck_assert_double_eq_tol(at(&g, 20, 0), 10 * log10(0.25), 0.09);
    for (size_t where = 100; where < n; where += 19997) {
        memset(x, 0, n * sizeof *x);
        x[where] = 1;
        g = make(x, n, 0, 4, 1);
        ck_assert_double_gt(at(&g, 200, 0), 20 * log10(2.0 / (WINDOW / 2)) - 10 * log10((double)n / 480) - 3.02);
    }
    arena_close(a);
}
END_TEST

/* Nothing is minus infinity, and columns beyond the sound are nothing. */
START_TEST(silence)
{
    a = arena_open();
    struct spectrogram g = make(sine(RATE, 1, 1000), RATE, 1.1, 1.2, 2);
    for (int k = 0; k < g.bins; k++)
        ck_assert(at(&g, k, 0) == -HUGE_VAL && at(&g, k, 1) == -HUGE_VAL);
    arena_close(a);
}
END_TEST

UNIT("spectrogram", sine_on_a_bin, sine_between_bins, chirp, parseval, wide_columns, silence)
