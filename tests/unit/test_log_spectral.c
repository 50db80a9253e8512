/* The log-spectral distance against a plain sum with a slow Fourier transform, and where its value is known. */
#include "analysis/spectral_distance.h"
#include "unit.h"

enum { RATE = 8000, N = 1200 };

static double noise(unsigned *seed)
{
    double sum = 0;
    for (int k = 0; k < 6; k++)
        sum += (double)((*seed = *seed * 1103515245u + 12345u) >> 16 & 32767) / 32768 - 0.5;
    return sum;
}

static struct wav wav_of(double *x, int channels)
{
    return (struct wav){.rate = RATE, .channels = channels, .frames = (size_t)(N / channels), .x = x};
}

static double slow_power(const struct wav *w, int channel, long from, long size, long k)
{
    double re = 0, im = 0, pi = acos(-1);
    for (long i = 0; i < size; i++) {
        long at = from + i;
        double x = at >= 0 && at < (long)w->frames ? w->x[at * w->channels + channel] : 0,
               hann = 0.5 - 0.5 * cos(2 * pi * ((double)i + 0.5) / (double)size);
        re += hann * x * cos(2 * pi * (double)(i * k) / (double)size);
        im += hann * x * sin(2 * pi * (double)(i * k) / (double)size);
    }
    return re * re + im * im;
}

/* Windows of 32, 128 and 512 samples at 8 kHz: the powers of two nearest to 40, 160 and 640. */
static double slow(const struct wav *a, const struct wav *b)
{
    double mean = 0;
    for (long size = 32; size <= 512; size *= 4) {
        double most = 0, sum = 0, count = 0;
        for (int pass = 0; pass < 2; pass++)
            for (int c = 0; c < a->channels; c++)
                for (long from = -size / 2; from < (long)a->frames; from += size / 2)
                    for (long k = 0; k <= size / 2; k++) {
                        double p = slow_power(a, c, from, size, k), q = pass ? slow_power(b, c, from, size, k) : 0,
                               floor = 1e-6 * most;
                        if (!pass)
                            most = fmax(most, p);
                        else if (p > floor || q > floor) {
                            double d = 10 * log10(fmax(p, floor) / fmax(q, floor));
                            sum += d * d;
                            count++;
                        }
                    }
        mean += sqrt(sum / count) / 3;
    }
    return mean;
}

START_TEST(as_a_plain_sum)
{
    double x[N], y[N];
    unsigned seed = 3;
    for (int i = 0; i < N; i++) {
        x[i] = sin(0.3 * i) * exp(-i / 300.0) + 1e-4 * noise(&seed);
        y[i] = x[i] + 3e-3 * noise(&seed);
    }
    for (int channels = 1; channels <= 2; channels++) {
        struct wav a = wav_of(x, channels), b = wav_of(y, channels);
        double expected = slow(&a, &b);
        ck_assert_double_gt(expected, 0.5);
        ck_assert_double_eq_tol(spectral_distance_sounds(&a, &b), expected,
                                1e-6); /* bins at the floor's edge may round to either side */
    }
}
END_TEST

START_TEST(known_values)
{
    double x[N], y[N], still[N] = {0};
    unsigned seed = 5;
    for (int i = 0; i < N; i++) {
        x[i] = noise(&seed);
        y[i] = 0.5 * x[i];
    }
    struct wav a = wav_of(x, 1), half = wav_of(y, 1), silence = wav_of(still, 1);
    ck_assert_double_eq(spectral_distance_sounds(&a, &a), 0);
    ck_assert_double_eq_tol(spectral_distance_sounds(&a, &half), 20 * log10(2),
                            0.01); /* the few bins between floor and 6 dB above it count less */
    ck_assert_double_eq(spectral_distance_sounds(&silence, &a), 0);
    half.frames = N / 2; /* what both have */
    ck_assert_double_eq_tol(spectral_distance_sounds(&a, &half), 20 * log10(2), 0.01);
}
END_TEST

UNIT("log_spectral", as_a_plain_sum, known_values)
