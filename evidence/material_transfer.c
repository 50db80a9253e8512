/* material_transfer: what the transfer of a residual does to drawn residuals whose transfer is known, as a table. Five
   draws of noise (44.1 kHz, 0.68 s) by each of both inverses; given is the draw that is farthest off. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "num/fft.h"
#include "num/noise.h"
#include "response/residual.h"

enum { RATE = 44100, N = 30000, LONG = 32768, SEEDS = 5, MODES = 12 };

static struct arena *a;
static int written[2] = {1000, 0}, transfers;

static double decibel(double power) { return 10.0 * log10(power); }

static double energy(const double *x, long n)
{
    double sum = 0.0;
    for (long i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sum;
}

/* Power by frequency of up to 2 LONG samples: centroid in Hz. */
static double centroid(const double *x, long n)
{
    double *y = ARENA_TAKE(a, double, 2 * LONG), *re = ARENA_TAKE(a, double, 2 * LONG),
           *im = ARENA_TAKE(a, double, 2 * LONG), sum = 0.0, all = 0.0;
    struct fft *fft = fft_open(2 * LONG);
    memcpy(y, x, (size_t)n * sizeof *y);
    fft_forward(fft, y, re, im);
    fft_close(fft);
    for (long k = 0; k <= LONG; k++) {
        double power = re[k] * re[k] + im[k] * im[k];
        sum += power * (double)k * RATE / (2.0 * LONG);
        all += power;
    }
    return sum / all;
}

/* Time of decay by 60 dB, s: a line through the levels of blocks of 20 ms between 5 and 45 dB down. */
static double t60(const double *x, long n)
{
    const long block = RATE / 50;
    double first = energy(x, block), s[5] = {0};
    for (long i = 0; (i + 1) * block <= n; i++) {
        double t = (double)(i * block) / RATE, level = decibel(energy(x + i * block, block) / first);
        if (level > -5.0 || level < -45.0) continue;
        s[0] += 1.0, s[1] += t, s[2] += level, s[3] += t * t, s[4] += t * level;
    }
    return -60.0 * (s[0] * s[3] - s[1] * s[1]) / (s[0] * s[4] - s[1] * s[2]);
}

/* Noise that decays, between two frequencies. */
static double *noise(int seed, double decay, double low, double high)
{
    double *x = ARENA_TAKE(a, double, LONG), *re = ARENA_TAKE(a, double, LONG), *im = ARENA_TAKE(a, double, LONG);
    struct fft *fft = fft_open(LONG);
    noise_normal(noise_make((uint64_t)seed, "transfers"), 0, LONG, x);
    fft_forward(fft, x, re, im);
    for (long k = 0; k <= LONG / 2; k++) {
        double f = (double)k * RATE / LONG;
        if (f >= low && f <= high) continue;
        re[k] = im[k] = 0.0;
    }
    fft_inverse(fft, re, im, x);
    fft_close(fft);
    for (long i = 0; i < LONG; i++)
        x[i] *= exp(-decay * (double)i / RATE);
    return x;
}

static struct residual_modes modes(int n)
{
    return (struct residual_modes){n, ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n),
                                   NULL};
}

static struct residual_modes one(double frequency, double decay)
{
    struct residual_modes m = modes(1);
    *m.frequency = frequency;
    *m.decay = decay;
    *m.gain = 1.0;
    return m;
}

static struct residual_modes many(int seed, double louder)
{
    struct residual_modes m = modes(MODES);
    struct noise s = noise_make((uint64_t)seed, "modes");
    for (int i = 0; i < MODES; i++) {
        m.frequency[i] = 150.0 * exp(4.0 * noise_uniform(s, 0, (uint64_t)i));
        m.decay[i] = 3.0 * exp(2.5 * noise_uniform(s, 1, (uint64_t)i));
        m.gain[i] = exp(4.0 * noise_uniform(s, 2, (uint64_t)i)) * pow(10.0, louder / 20.0);
    }
    return m;
}

static struct residual_transferred moved(const struct residual *source, struct residual_modes target, int inverse,
                                         int shift)
{
    struct residual_transferred t;
    struct err e = {0};
    struct residual_ask ask = {source, &target, inverse, shift, noise_make(7, "transfer")};
    if (!residual_transfer(&ask, a, &t, &e)) {
        fprintf(stderr, "%s\n", e.text);
        exit(1);
    }
    written[0] = t.written[0] < written[0] ? t.written[0] : written[0];
    written[1] = t.written[1] > written[1] ? t.written[1] : written[1];
    transfers++;
    return t;
}

/* The value farthest from what is wanted, of all draws. */
static void farthest(double *worst, int draw, double value, double wanted)
{
    if (draw == 0 || fabs(value - wanted) > fabs(*worst - wanted)) *worst = value;
}

int main(void)
{
    static const char *const shifts[] = {"difference", "ratio"}, *const inverses[] = {"phases", "noise"};
    a = arena_open();
    printf("| transfer | wanted | farthest of %d draws |\n|---|---|---|\n", SEEDS);
    for (int shift = 0; shift < 2; shift++) {
        double same = 0.0, line = 0.0;
        for (int seed = 0; seed < SEEDS; seed++) {
            struct residual s = {RATE, N, noise(seed, 20, 0, RATE), many(seed, 0), NULL};
            struct residual_transferred t = moved(&s, s.modes, RESIDUAL_PHASES, shift);
            double *off = ARENA_TAKE(a, double, N);
            for (long i = 0; i < N; i++)
                off[i] = t.x[i] - s.x[i];
            farthest(&same, seed, decibel(energy(off, N) / energy(s.x, N)), -400.0);
            struct residual narrow = {RATE, N, noise(seed, 8, 950, 1050), one(1000, 8), NULL};
            t = moved(&narrow, one(1100, 8), RESIDUAL_PHASES, shift);
            double was = centroid(narrow.x, N), is = centroid(t.x, t.n);
            farthest(&line, seed, shift ? is / was : is - was, shift ? 1.1 : 100.0);
        }
        printf("| the object itself, by %s: what differs, beside the residual | at most -60 dB | %.0f dB |\n",
               shifts[shift], same);
        if (shift)
            printf("| a mode from 1000 to 1100 Hz, noise of 950 to 1050 Hz, by ratio: its centroid moves | times 1.1 | "
                   "times %.4f |\n",
                   line);
        else
            printf("| a mode from 1000 to 1100 Hz, noise of 950 to 1050 Hz, by difference: its centroid moves | 100 +- "
                   "2 Hz | %.1f Hz |\n",
                   line);
    }
    for (int inverse = 0; inverse < 2; inverse++) {
        double longer = 0.0, louder = 0.0;
        for (int seed = 0; seed < SEEDS; seed++) {
            struct residual s = {RATE, N, noise(seed, 20, 0, RATE), one(700, 20), NULL};
            struct residual_transferred t = moved(&s, one(700, 10), inverse, RESIDUAL_DIFFERENCE);
            farthest(&longer, seed, t60(t.x, t.n) / t60(s.x, N), 2.0);
            struct residual all = {RATE, N, s.x, many(seed, 0), NULL};
            double was = energy(moved(&all, many(seed, 0), inverse, RESIDUAL_DIFFERENCE).x, N);
            farthest(&louder, seed,
                     decibel(energy(moved(&all, many(seed, 6), inverse, RESIDUAL_DIFFERENCE).x, N) / was), 6.0);
        }
        printf("| a decay of 20 to one of 10 1/s, by %s: T60 | times 2 +- 3 %% | times %.3f |\n", inverses[inverse],
               longer);
        printf("| modes 6 dB louder, by %s: the residual is louder | 6.0 +- 0.1 dB | %.3f dB |\n", inverses[inverse],
               louder);
    }
    printf("| every bin of the spectrogram is written, in all %d transfers | once | %d to %d times |\n", transfers,
           written[0], written[1]);
    arena_close(a);
    return 0;
}
