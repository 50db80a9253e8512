/* What a mode costs: cycles (of the time stamp counter) per mode and sample of the bank with gains ramped in calls of 64 samples, and
   the ratio to a plain scalar loop over the same modes timed in the same run. Prints one CSV row per number of modes. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <x86intrin.h>

#include "convolution/resonators.h"
#include "response/ir.h"

enum { MODES = 1000, FRAMES = 64, CALLS = 200, REPEATS = 15, LENGTH = 48000 };

static double frequency[MODES], decay[MODES], gain_re[2][MODES], gain_im[2][MODES], f[FRAMES], y[FRAMES], h[LENGTH];

static uint64_t least(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

static double bank(struct arena *a, const struct modes *m)
{
    struct resonators *r = resonators_make(a, m, 48000.0, FRAMES);
    uint64_t best = UINT64_MAX;
    for (int k = 0; k < REPEATS; k++) {
        uint64_t start = __rdtsc();
        for (int c = 0; c < CALLS; c++)
            resonators_run(r, f, y, FRAMES, gain_re[c & 1], gain_im[c & 1]);
        best = least(best, __rdtsc() - start);
    }
    return (double)best / ((double)CALLS * FRAMES * m->n);
}

/* A mode at a time, as one would write it down. */
static double scalar(const struct modes *m)
{
    static double zr[MODES], zi[MODES];
    uint64_t best = UINT64_MAX;
    for (int k = 0; k < REPEATS; k++) {
        uint64_t start = __rdtsc();
        for (int c = 0; c < CALLS / 10; c++)
            for (int i = 0; i < m->n; i++) {
                double size = exp(-m->decay[i] / 48000.0), turn = 2 * M_PI * m->frequency[i] / 48000.0;
                double pr = size * cos(turn), pi = size * sin(turn);
                double gr = gain_re[c & 1][i], gi = gain_im[c & 1][i];
                double sr = (gain_re[~c & 1][i] - gr) / FRAMES, si = (gain_im[~c & 1][i] - gi) / FRAMES;
                for (int n = 0; n < FRAMES; n++) {
                    gr += sr, gi += si;
                    double re = pr * zr[i] - pi * zi[i] + gr * f[n];
                    zi[i] = pr * zi[i] + pi * zr[i] + gi * f[n];
                    zr[i] = re;
                    y[n] += zi[i] - 0.5 * gi * f[n];
                }
            }
        best = least(best, __rdtsc() - start);
    }
    return (double)best / ((double)(CALLS / 10) * FRAMES * m->n);
}

static double sampled(struct arena *a, const struct modes *m)
{
    struct ir_sampler *s = ir_sampler_make(a, m, 48000.0);
    uint64_t best = UINT64_MAX;
    for (int k = 0; k < REPEATS; k++) {
        uint64_t start = __rdtsc();
        ir_sample(s, gain_re[0], gain_im[0], h, LENGTH);
        best = least(best, __rdtsc() - start);
    }
    return (double)best / ((double)LENGTH * m->n);
}

int main(void)
{
    static const int counts[] = {1, 8, 50, 200, MODES};
    struct arena *a = arena_open();
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 60.0 + 23.0 * i;
        decay[i] = 3.0 + 0.1 * i;
        gain_re[0][i] = gain_im[1][i] = 1.0 + i % 7;
        gain_re[1][i] = gain_im[0][i] = 0.5 - i % 5;
    }
    for (int n = 0; n < FRAMES; n++)
        f[n] = n % 7 - 3;
    printf("modes,bank_cycles_per_mode_sample,scalar_cycles_per_mode_sample,times_faster,response_cycles_per_mode_sample\n");
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        struct modes m = {.n = counts[i], .places = 1, .quantity = MODES_VELOCITY, .frequency = frequency, .decay = decay};
        double ours = bank(a, &m), plain = scalar(&m);
        printf("%d,%.3f,%.3f,%.1f,%.3f\n", counts[i], ours, plain, plain / ours, sampled(a, &m));
    }
    arena_close(a);
    return 0;
}
