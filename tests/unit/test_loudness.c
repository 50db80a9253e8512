/* True peaks beside those of one libebur128 meter that hears all: sounds whose level rises and falls, one to three
   channels, rates of four, two and one times as many samples, in pieces of any length. The same bits. */
#include <ebur128.h>

#include "num/noise.h"
#include "output/loudness.h"
#include "unit.h"

enum { MOST = 30000 };

/* Noise that is low-passed by a part drawn, times a level that swings by 60 dB. */
static void draw(double *x, int frames, int channels, int seed)
{
    struct noise of = noise_make((uint64_t)seed, "sound");
    double kept = noise_uniform(of, 1, 0), rate = 1e-4 * (1 + 30 * noise_uniform(of, 1, 1)), last[3] = {0};
    for (int i = 0; i < frames; i++)
        for (int k = 0; k < channels; k++) {
            last[k] = kept * last[k] + noise_uniform(of, 2, (uint64_t)(i * channels + k)) - 0.5;
            x[i * channels + k] = last[k] * exp(-3.5 * (1 + sin(rate * i + k)));
        }
}

static void compare(int seed)
{
    static const double rates[] = {8000, 44100, 48000, 95999, 96000, 192000};
    static double x[3 * MOST];
    int channels = 1 + seed / 6 % 3, frames = MOST - 37 * seed;
    double rate = rates[seed % 6], one, most = 0;
    struct noise of = noise_make((uint64_t)seed, "pieces");
    draw(x, frames, channels, seed);
    ebur128_state *all = ebur128_init((unsigned)channels, (unsigned long)rate, EBUR128_MODE_TRUE_PEAK);
    ebur128_add_frames_double(all, x, (size_t)frames);
    for (unsigned k = 0; k < (unsigned)channels; k++) {
        ebur128_true_peak(all, k, &one);
        most = fmax(most, one);
    }
    ebur128_destroy(&all);
    struct loudness *l = loudness_open(channels, rate, true);
    for (int at = 0, n; at < frames; at += n) {
        n = 1 + (int)(700 * pow(noise_uniform(of, 0, (uint64_t)at), 3));
        n = n < frames - at ? n : frames - at;
        loudness_add(l, x + at * channels, (size_t)n);
    }
    ck_assert_msg(loudness_true_peak(l) == most, "sound %d: %.17g, not %.17g", seed, loudness_true_peak(l), most);
    loudness_close(l);
}

START_TEST(true_peak_of_pieces)
{
    for (int seed = 0; seed < 36; seed++)
        compare(seed);
}
END_TEST

UNIT("loudness", true_peak_of_pieces)
