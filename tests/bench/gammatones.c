/* What a mode that begins softly costs: cycles per mode and sample of a bank of gammatones in calls of 64 samples with
   moving gains, and over what a plain resonator takes (gammatone_cost in convolution/gammatone.c). One CSV row per
   gamma. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <time.h>
#include <x86intrin.h>

#include "convolution/gammatone.h"
#include "convolution/resonators.h"

enum { MODES = 200, FRAMES = 64, CALLS = 200, REPEATS = 15 };
#define RATE 48000.0

static double frequency[MODES], decay[MODES], re[2][MODES], im[2][MODES], f[FRAMES], y[FRAMES];
static const struct modes_point points[2] = {{frequency, decay, re[0], im[0]}, {frequency, decay, re[1], im[1]}};

static double plain(struct arena *a)
{
    struct resonators_ask ask = {
        .n = MODES, .quantity = MODES_VELOCITY, .rate = RATE, .frequency = frequency, .decay = decay, .ramp = FRAMES};
    struct resonators *r = resonators_make(a, &ask);
    uint64_t best = UINT64_MAX;
    for (int k = 0; k < REPEATS; k++) {
        uint64_t start = __rdtsc();
        for (int c = 0; c < CALLS; c++)
            resonators_run(r, f, y, FRAMES, &points[c & 1]);
        uint64_t took = __rdtsc() - start;
        best = took < best ? took : best;
    }
    return (double)best / ((double)CALLS * FRAMES * MODES);
}

static double soft(struct arena *a, int gamma)
{
    struct gammatone_bank_ask ask = {.n = MODES, .gamma = gamma, .rate = RATE, .frequency = frequency, .decay = decay};
    struct gammatone_bank *g = gammatone_bank_make(a, &ask);
    uint64_t best = UINT64_MAX;
    for (int k = 0; k < REPEATS; k++) {
        uint64_t start = __rdtsc();
        for (int c = 0; c < CALLS; c++)
            gammatone_bank_run(g, f, y, FRAMES, &points[c & 1]);
        uint64_t took = __rdtsc() - start;
        best = took < best ? took : best;
    }
    return (double)best / ((double)CALLS * FRAMES * MODES);
}

int main(void)
{
    struct arena *a = arena_open();
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 50 + 90.0 * i, decay[i] = 5 + i;
        re[0][i] = im[1][i] = 1, re[1][i] = im[0][i] = -0.5;
    }
    for (int n = 0; n < FRAMES; n++)
        f[n] = sin(n * n);
    double one = plain(a);
    printf("gamma,cycles_per_mode_sample,over_plain\n1,%.3f,1\n", one);
    for (int gamma = 2; gamma <= 4; gamma++) {
        double c = soft(a, gamma);
        printf("%d,%.3f,%.2f\n", gamma, c, c / one);
    }
    arena_close(a);
    return 0;
}
