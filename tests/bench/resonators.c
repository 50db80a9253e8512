/* What a mode costs: cycles (of the time stamp counter, in the thread's time) per sample of banks of resonators in
   calls of 64 samples, gains ramped, poles fixed or ramped too (glide: e^(s/rate) of all poles once a call is in it);
   beside it a plain scalar loop over the same modes, and what prototypes took (Zen 5 at 3.6 GHz, AVX-512; fixed:
   rotation form, strict at 50 modes; glide: plus 5 % and the evaluation of poles). One CSV row per number of modes. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "bench.h"
#include "convolution/resonators.h"

enum { MODES = 1000, FRAMES = 64, CALLS = 200, REPEATS = 15 };
#define RATE 48000.0

static double frequency[2][MODES], decay[2][MODES], re[2][MODES], im[2][MODES], f[FRAMES], y[FRAMES];
static const struct modes_point points[2] = {{frequency[0], decay[0], re[0], im[0]},
                                             {frequency[1], decay[1], re[1], im[1]}};

/* Seconds per sample. */
static double bank(struct arena *a, int n, bool glides)
{
    struct resonators_ask ask = {.n = n,
                                 .quantity = MODES_VELOCITY,
                                 .rate = RATE,
                                 .frequency = frequency[0],
                                 .decay = decay[0],
                                 .glides = glides,
                                 .ramp = FRAMES};
    struct resonators *r = resonators_make(a, &ask);
    double best = HUGE_VAL;
    for (int k = 0; k < REPEATS; k++) {
        double start = bench_seconds();
        for (int c = 0; c < CALLS; c++)
            resonators_run(r, f, y, FRAMES, &points[c & 1]);
        best = fmin(best, bench_seconds() - start);
    }
    return best / ((double)CALLS * FRAMES);
}

/* A mode at a time, as one would write it down. */
static double scalar(int n)
{
    static double zr[MODES], zi[MODES];
    double best = HUGE_VAL;
    for (int k = 0; k < REPEATS; k++) {
        double start = bench_seconds();
        for (int c = 0; c < CALLS / 10; c++)
            for (int i = 0; i < n; i++) {
                double size = exp(-decay[0][i] / RATE), turn = 2 * M_PI * frequency[0][i] / RATE;
                double pr = size * cos(turn), pi = size * sin(turn);
                double gr = re[c & 1][i], gi = im[c & 1][i];
                double sr = (re[~c & 1][i] - gr) / FRAMES, si = (im[~c & 1][i] - gi) / FRAMES;
                for (int j = 0; j < FRAMES; j++) {
                    gr += sr, gi += si;
                    double next = pr * zr[i] - pi * zi[i] + gr * f[j];
                    zi[i] = pr * zi[i] + pi * zr[i] + gi * f[j];
                    zr[i] = next;
                    y[j] += zi[i] - 0.5 * gi * f[j];
                }
            }
        best = fmin(best, bench_seconds() - start);
    }
    return best / ((double)(CALLS / 10) * FRAMES);
}

int main(void)
{
    static const struct {
        int modes;
        const char *fixed, *glide;
    } rows[] = {{1, "", ""}, {8, "", ""}, {50, "25", "32"}, {200, "76", "104"}, {MODES, "374", "512"}};
    struct arena *a = arena_open();
    double cycles = bench_cycles_per_second();
    for (int i = 0; i < MODES; i++) {
        frequency[0][i] = 60.0 + 23.0 * i;
        frequency[1][i] = 61.0 + 23.0 * i;
        decay[0][i] = 3.0 + 0.1 * i;
        decay[1][i] = 3.1 + 0.1 * i;
        re[0][i] = im[1][i] = 1.0 + i % 7;
        re[1][i] = im[0][i] = 0.5 - i % 5;
    }
    for (int n = 0; n < FRAMES; n++)
        f[n] = n % 7 - 3;
    printf("modes,fixed_cycles,glide_cycles,scalar_cycles,times_faster,fixed_times_real_time,glide_times_real_time,"
           "prototype_fixed,prototype_glide\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double fixed = bank(a, rows[i].modes, false), glide = bank(a, rows[i].modes, true),
               plain = scalar(rows[i].modes);
        printf("%d,%.0f,%.0f,%.0f,%.1f,%.0f,%.0f,%s,%s\n", rows[i].modes, fixed * cycles, glide * cycles,
               plain * cycles, plain / fixed, 1 / (RATE * fixed), 1 / (RATE * glide), rows[i].fixed, rows[i].glide);
    }
    arena_close(a);
    return 0;
}
