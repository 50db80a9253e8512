/* surface_heights_band: heights made of cosines whose spectrum is known. */
#include "analysis/surface_heights.h"

#include <stdint.h>

#include "unit.h"

static const double pi = 3.14159265358979323846;

enum { N = 60000 };

static double z[N];
static uint64_t state;

/* A plain generator (Knuth's LCG), uniform in [0, 1). */
static double chance(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53;
}

static double gauss(void) { return sqrt(-2 * log(1 - chance())) * cos(2 * pi * chance()); }

/* Power law k^a between two frequencies (cycles a sample), random phases: 600 lines. */
static void fractal(double a, double from, double to, double rms)
{
    double sum = 0;
    state = 7;
    memset(z, 0, sizeof z);
    for (int j = 0; j < 600; j++) {
        double k = from * pow(to / from, (j + chance()) / 600), p = pow(k, a) * k,
               phase = 2 * pi * chance(); /* evenly in log k: a power of k P(k) each */
        sum += p;
        double c = cos(2 * pi * k), s = sin(2 * pi * k), x = sqrt(p) * cos(phase), y = sqrt(p) * sin(phase);
        for (int i = 0; i < N; i++) {
            z[i] += x;
            double t = x * c - y * s;
            y = x * s + y * c;
            x = t;
        }
    }
    for (int i = 0; i < N; i++)
        z[i] *= rms / sqrt(0.5 * sum);
}

static struct surface_heights_band of(struct heightfile h, bool down)
{
    struct surface_heights_band b;
    surface_heights_band(&h, down, &b);
    return b;
}

static const double pitch = 2e-6;

#define PROFILE ((struct heightfile){.columns = N, .rows = 1, .pitch_x = pitch, .pitch_y = NAN, .z = z})

/* The edge of the band within a twelfth of an octave and the window's half main lobe (4 of 8192 lines); the exponent
   within 0.2: three octaves of a spectrum of 600 lines. */
START_TEST(power_law)
{
    static const double exponents[] = {-1.5, -2.4, -3};
    for (int j = 0; j < 3; j++) {
        fractal(exponents[j], 0.001, 0.06, 3e-6);
        struct surface_heights_band b = of(PROFILE, false);
        ck_assert(b.segments >= 8 && !b.noise);
        ck_assert_double_eq(b.nyquist, 0.5 / pitch);
        ck_assert_double_eq_tol(b.limit * pitch / 0.06, 1, 0.07);
        ck_assert_double_eq_tol(b.exponent, exponents[j], 0.2);
        ck_assert_double_eq_tol(b.to / b.limit, 0.5, 1e-12);
        ck_assert(b.beyond < 0.01);
    }
}
END_TEST

/* With white noise: its density is 2 pitch sigma^2; the limit is where the power law is 6 dB above it, or the band's
 * edge. */
START_TEST(noise_floor)
{
    double sigma = 3e-8;
    fractal(-2.4, 0.001, 0.06, 3e-6);
    for (int i = 0; i < N; i++)
        z[i] += sigma * gauss();
    struct surface_heights_band b = of(PROFILE, false);
    ck_assert(b.noise);
    ck_assert_double_eq_tol(b.floor / (2 * pitch * sigma * sigma), 1, 0.1);
    ck_assert_double_eq_tol(b.limit * pitch / 0.06, 1, 0.07);
    ck_assert(b.beyond > 0.5);
}
END_TEST

START_TEST(no_limit)
{
    for (int i = 0; i < N; i++)
        z[i] = 1e-6 * gauss();
    struct surface_heights_band b = of(PROFILE, false);
    ck_assert(isnan(b.limit) && !b.noise && isnan(b.beyond));
    ck_assert_double_eq_tol(b.exponent, 0, 0.1);
    fractal(-1.8, 0.001, 0.5, 1e-6);
    b = of(PROFILE, false);
    ck_assert(isnan(b.limit) && !b.noise);
    ck_assert_double_eq_tol(b.exponent, -1.8, 0.2);
    memset(z, 0, sizeof z);
    b = of(PROFILE, false);
    ck_assert(b.segments == 0 && isnan(b.limit) && isnan(b.exponent));
}
END_TEST

/* One scratch of 1 mm does not show in the median. A weak line far up is an artefact, and is found in the curvature. */
START_TEST(scratch_and_line)
{
    fractal(-2, 0.001, 0.06, 3e-6);
    z[N / 2] += 1e-3;
    struct surface_heights_band b = of(PROFILE, false);
    ck_assert_double_eq_tol(b.limit * pitch / 0.06, 1, 0.07);
    z[N / 2] -= 1e-3;
    for (int i = 0; i < N; i++)
        z[i] += 3e-9 * cos(2 * pi * 0.1 * i);
    b = of(PROFILE, false);
    ck_assert_double_eq_tol(b.limit * pitch / 0.06, 1, 0.07);
    for (int i = 0; i < N; i++)
        z[i] += 3e-7 * cos(2 * pi * 0.3 * i);
    b = of(PROFILE, false);
    ck_assert_double_eq_tol(b.limit * pitch / 0.06, 1, 0.07);
    ck_assert(b.beyond > 0.5);
}
END_TEST

/* Ridges: the harmonics count, the gaps between them do not. */
START_TEST(ridges)
{
    for (int i = 0; i < N; i++) {
        double t = fmod(i, 500) / 500 - 0.5;
        z[i] = 20e-6 * exp(-t * t / (2 * 0.02 * 0.02)); /* harmonic n falls as exp(-2 (pi 0.02 n)^2): 80 dB down at n =
                                                           34, and 8 dB less where a node holds gaps as well */
    }
    struct surface_heights_band b = of(PROFILE, false);
    ck_assert_double_eq_tol(b.limit * pitch * 500, 33, 2);
    for (int i = 0; i < N; i++) { /* lines far apart: five harmonics, each half the one before */
        z[i] = 0;
        for (int n = 1; n <= 5; n++)
            z[i] += pow(0.5, n) * 20e-6 * cos(2 * pi * n * i / 50);
    }
    b = of(PROFILE, false);
    ck_assert_double_eq_tol(b.limit * pitch * 50, 5.2, 0.2);
}
END_TEST

/* A map: each direction its own; rows with a hole are left out; too short is unknown. */
START_TEST(map)
{
    enum { W = 300, H = 200 };
    struct heightfile h = {.columns = W, .rows = H, .pitch_x = 1e-6, .pitch_y = 5e-6, .z = z};
    state = 3;
    memset(z, 0, sizeof z);
    for (int j = 0; j < 200; j++) {
        double kx = 0.2 * (chance() - 0.5) * 2, ky = 0.1 * (chance() - 0.5) * 2, phase = 2 * pi * chance();
        for (int k = 0; k < W * H; k++)
            z[k] += 1e-7 * cos(2 * pi * (kx * (k % W) + ky * (k / W)) + phase);
    }
    z[100] = z[300 * 17 + 4] = NAN;
    struct surface_heights_band x = of(h, false), y = of(h, true);
    ck_assert(x.segments > 100 && y.segments > 100 && x.segment == 256 && y.segment == 128);
    ck_assert_double_eq_tol(x.limit * 1e-6 / 0.2, 1, 0.15); /* half the window's main lobe is 4 of 256 lines: 0.016 */
    ck_assert_double_eq_tol(y.limit * 5e-6 / 0.1, 1, 0.4);
    for (int j = 0; j < H; j++)
        z[j * W + 128] = NAN;
    x = of(h, false);
    ck_assert(x.segments == 0 && isnan(x.limit));
    h.columns = 31;
    ck_assert(of(h, false).segments == 0);
}
END_TEST

UNIT("surface_heights_band", power_law, noise_floor, no_limit, scratch_and_line, ridges, map)
