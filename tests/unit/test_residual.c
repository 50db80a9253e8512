/* Transfer of residuals: what does not change when nothing does, and what a shift, a stretch and a level do, of drawn
 * sources. */
#include "unit.h"

#include "num/fft.h"
#include "num/real.h"
#include "num/stft.h"
#include "response/residual.h"

enum { RATE = 44100, N = 30000, SEEDS = 5 };

static double decibel(double power) { return 10.0 * real_log10(power); }

static double energy(const double *x, long n)
{
    double sum = 0.0;
    for (long i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sum;
}

/* Noise that decays, between two frequencies. */
static double *noise(struct arena *a, int seed, double decay, double low, double high)
{
    long n = 32768;
    double *x = ARENA_TAKE(a, double, n), *re = ARENA_TAKE(a, double, n), *im = ARENA_TAKE(a, double, n);
    struct fft *fft = fft_open((size_t)n);
    noise_normal(noise_make((uint64_t)seed, "residual"), 0, (size_t)n, x);
    fft_forward(fft, x, re, im);
    for (long k = 0; k <= n / 2; k++) {
        double f = (double)k * RATE / (double)n, part = f >= low && f <= high ? 1.0 / (double)n : 0.0;
        re[k] *= part;
        im[k] *= part;
    }
    fft_inverse(fft, re, im, x);
    fft_close(fft);
    for (long i = 0; i < n; i++)
        x[i] *= real_exp(-decay * (double)i / RATE);
    return x;
}

static struct residual_modes modes(struct arena *a, int n)
{
    return (struct residual_modes){n, ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n),
                                   NULL};
}

static struct residual_modes drawn(struct arena *a, int seed, int n)
{
    struct residual_modes m = modes(a, n);
    struct noise s = noise_make((uint64_t)seed, "modes");
    for (int i = 0; i < n; i++) {
        m.frequency[i] = 150.0 * real_exp(4.0 * noise_uniform(s, 0, (uint64_t)i));
        m.decay[i] = 3.0 * real_exp(2.5 * noise_uniform(s, 1, (uint64_t)i));
        m.gain[i] = real_exp(4.0 * noise_uniform(s, 2, (uint64_t)i));
    }
    return m;
}

static struct residual_modes one(struct arena *a, double frequency, double decay, double gain)
{
    struct residual_modes m = modes(a, 1);
    *m.frequency = frequency;
    *m.decay = decay;
    *m.gain = gain;
    return m;
}

static struct residual_transferred transfer(struct arena *a, const struct residual *source,
                                            const struct residual_modes *target, int inverse, int shift)
{
    struct residual_transferred t;
    struct err e = {0};
    struct residual_ask ask = {source, target, inverse, shift, noise_make(7, "transfer")};
    ck_assert_msg(residual_transfer(&ask, a, &t, &e), "%s", e.text);
    ck_assert_msg(t.written[0] == 1 && t.written[1] == 1, "bins were written %d to %d times", t.written[0],
                  t.written[1]);
    return t;
}

static double centroid(const double *x, long n)
{
    long size = (long)fft_good_size((size_t)n + (n & 1));
    struct arena *a = arena_open();
    double *padded = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, size), *im = ARENA_TAKE(a, double, size),
           sum = 0.0, all = 0.0;
    struct fft *fft = fft_open((size_t)size);
    memcpy(padded, x, (size_t)n * sizeof *x);
    fft_forward(fft, padded, re, im);
    fft_close(fft);
    for (long k = 0; k <= size / 2; k++) {
        double power = re[k] * re[k] + im[k] * im[k];
        sum += power * (double)k * RATE / (double)size;
        all += power;
    }
    arena_close(a);
    return sum / all;
}

/* 1/s of amplitude, by a line through the levels of blocks of 20 ms between 5 and 45 dB down. */
static double decay_of(const double *x, long n)
{
    const long block = RATE / 50;
    double first = energy(x, block), s[4] = {0}, weight = 0.0;
    for (long i = 0; (i + 1) * block <= n; i++) {
        double t = (double)(i * block) / RATE, power = energy(x + i * block, block), y = real_log(power);
        if (power > 0.3 * first || power < 3e-5 * first) continue;
        weight += 1.0;
        s[0] += t, s[1] += y, s[2] += t * t, s[3] += t * y;
    }
    return -0.5 * (weight * s[3] - s[0] * s[1]) / (weight * s[2] - s[0] * s[0]);
}

START_TEST(spectra_and_back)
{
    static const double rates[] = {8000, 22050, 44100, 96000};
    for (int k = 0; k < 4; k++) {
        struct arena *a = arena_open();
        long n = 5000 + 777 * k;
        struct stft *s = stft_open(n, rates[k], 1 + k % 2, a);
        long pixels = (long)s->frames * s->bins;
        double *x = ARENA_TAKE(a, double, n), *y = ARENA_TAKE(a, double, n), *re = ARENA_TAKE(a, double, pixels),
               *im = ARENA_TAKE(a, double, pixels);
        noise_normal(noise_make((uint64_t)k, "x"), 0, (size_t)n, x);
        stft_forward(s, x, re, im);
        stft_inverse(s, re, im, y);
        for (long i = 0; i < n; i++)
            ck_assert_double_eq_tol(x[i], y[i], 1e-13);
        stft_close(s);
        arena_close(a);
    }
}
END_TEST

/* The target is the source: pairs are each with itself, and the sound is the source's. */
START_TEST(identity)
{
    for (int seed = 0; seed < SEEDS; seed++)
        for (int shift = 0; shift < 2; shift++) {
            struct arena *a = arena_open();
            struct residual source = {RATE, N, noise(a, seed, 20, 0, RATE), drawn(a, seed, 4 + 12 * seed), NULL};
            struct residual_transferred t = transfer(a, &source, &source.modes, RESIDUAL_PHASES, shift);
            ck_assert_int_eq(t.n, N);
            ck_assert_int_eq(t.pairs, source.modes.n < RESIDUAL_PAIRS ? source.modes.n : RESIDUAL_PAIRS);
            for (int k = 0; k < t.pairs; k++)
                ck_assert_int_eq(t.pair[k].source, t.pair[k].target);
            for (long i = 0; i < N; i++)
                source.x[i] -= t.x[i];
            ck_assert_double_le(decibel(energy(source.x, N) / energy(t.x, N)), -60.0);
            ck_assert_double_le(t.consistency, -60.0);
            arena_close(a);
        }
}
END_TEST

/* Pairs rise in both, and of moved modes, with some missing on both sides, they are the right ones; two neighbours that
 * both lack their own may make one more. */
START_TEST(pairs)
{
    for (int seed = 0; seed < 2 * SEEDS; seed++) {
        struct arena *a = arena_open();
        struct residual_modes all = drawn(a, seed, 14), s = modes(a, 14), g = modes(a, 14);
        struct residual_transferred t;
        int of_s[14], of_g[14];
        s.n = g.n = 0;
        for (int i = 0; i < 14; i++) {
            all.frequency[i] = 200.0 * (i + 1) * (1.0 + 0.06 * i); /* apart by more than they are moved */
            if (i % 6 != 5) {
                s.frequency[s.n] = all.frequency[i], s.decay[s.n] = all.decay[i], s.gain[s.n] = all.gain[i];
                of_s[s.n++] = i;
            }
            if (i % 5 != 4) {
                double off = 0.02 * (noise_uniform(noise_make((uint64_t)seed, "off"), 0, (uint64_t)i) - 0.5);
                g.frequency[g.n] = 1.7 * all.frequency[i] * (1.0 + off);
                g.decay[g.n] = 3.0 * all.decay[i], g.gain[g.n] = all.gain[i];
                of_g[g.n++] = i;
            }
        }
        int n = residual_transfer_pairs(&s, &g, &t), right = 0;
        for (int k = 0; k < n; k++) {
            right += of_s[t.pair[k].source] == of_g[t.pair[k].target];
            if (k == 0) continue;
            ck_assert_int_gt(t.pair[k].source, t.pair[k - 1].source);
            ck_assert_int_gt(t.pair[k].target, t.pair[k - 1].target);
        }
        ck_assert_msg(right >= 9 && n - right <= 2, "seed %d: %d of %d pairs are right", seed, right, n);
        arena_close(a);
    }
}
END_TEST

START_TEST(shifted)
{
    for (int seed = 0; seed < SEEDS; seed++)
        for (int shift = 0; shift < 2; shift++) {
            struct arena *a = arena_open();
            struct residual source = {RATE, N, noise(a, seed, 8, 950, 1050), one(a, 1000, 8, 1), NULL};
            struct residual_modes target = one(a, 1100, 8, 1);
            struct residual_transferred t = transfer(a, &source, &target, RESIDUAL_PHASES, shift);
            double was = centroid(source.x, N), moved = centroid(t.x, t.n);
            ck_assert_double_eq_tol(shift ? moved / was : moved - was, shift ? 1.1 : 100.0, shift ? 0.005 : 2.0);
            ck_assert_double_eq_tol(decibel(energy(t.x, t.n) / energy(source.x, N)), 0.0, shift ? 1.2 : 0.4);
            ck_assert_double_le(t.consistency, -15.0);
            arena_close(a);
        }
}
END_TEST

START_TEST(stretched)
{
    for (int seed = 0; seed < SEEDS; seed++)
        for (int inverse = 0; inverse < 2; inverse++) {
            struct arena *a = arena_open();
            struct residual source = {RATE, N, noise(a, seed, 20, 0, RATE), one(a, 700, 20, 1), NULL};
            struct residual_modes target = one(a, 700, 10, 1);
            struct residual_transferred t = transfer(a, &source, &target, inverse, 0);
            ck_assert_int_eq(t.n, 2 * N);
            ck_assert_double_eq_tol(decay_of(source.x, N) / decay_of(t.x, t.n), 2.0, 0.06);
            arena_close(a);
        }
}
END_TEST

/* 6 dB louder modes, and units that are a million times larger. */
START_TEST(louder)
{
    static const double by[] = {6.0, -6.0, 120.0};
    for (int seed = 0; seed < SEEDS; seed++)
        for (int inverse = 0; inverse < 2; inverse++)
            for (int k = 0; k < 3; k++) {
                struct arena *a = arena_open();
                struct residual source = {RATE, N, noise(a, seed, 20, 0, RATE), drawn(a, seed, 12), NULL};
                struct residual_modes target = drawn(a, seed, 12);
                double was = energy(transfer(a, &source, &target, inverse, 0).x, N);
                for (int i = 0; i < target.n; i++)
                    target.gain[i] *= real_exp10(by[k] / 20.0);
                double is = energy(transfer(a, &source, &target, inverse, 0).x, N);
                ck_assert_double_eq_tol(decibel(is / was), by[k], 0.1);
                ck_assert_double_eq_tol(decibel(was / energy(source.x, N)), 0.0, 0.5);
                arena_close(a);
            }
}
END_TEST

/* Noise beside three modes alike, `apart` Hz from each other, and a target of the same. */
static void three_modes(struct arena *a, int seed, double apart, struct residual *source, struct residual_modes *target)
{
    *source = (struct residual){RATE, N, noise(a, seed, 6, 0, RATE), modes(a, 3), NULL};
    *target = modes(a, 3);
    for (int i = 0; i < 3; i++) {
        source->modes.frequency[i] = target->frequency[i] = 1000.0 + apart * i;
        source->modes.decay[i] = target->decay[i] = 6.0;
        source->modes.gain[i] = target->gain[i] = 1.0;
    }
}

/* One mode alone 12 dB louder: the residual around it, and nowhere else. */
START_TEST(louder_mode)
{
    struct arena *a = arena_open();
    struct residual source;
    struct residual_modes target;
    three_modes(a, 1, 2000.0, &source, &target);
    target.gain[1] = 4.0;
    struct residual_transferred t = transfer(a, &source, &target, RESIDUAL_PHASES, 0);
    for (int i = 0; i < 3; i++) {
        struct stft *s = stft_open(N, RATE, 1, a);
        long pixels = (long)s->frames * s->bins;
        double *re = ARENA_TAKE(a, double, pixels), *im = ARENA_TAKE(a, double, pixels), power[2] = {0};
        for (int k = 0; k < 2; k++) {
            stft_forward(s, k ? t.x : source.x, re, im);
            long bin = (long)rint(source.modes.frequency[i] * s->size / RATE);
            for (int m = STFT_ONSET; m < s->frames; m++)
                power[k] +=
                    re[m * s->bins + bin] * re[m * s->bins + bin] + im[m * s->bins + bin] * im[m * s->bins + bin];
        }
        stft_close(s);
        ck_assert_double_eq_tol(decibel(power[1] / power[0]), i == 1 ? 12.0 : 0.0, 1.5);
    }
    arena_close(a);
}
END_TEST

/* A mode that the strike hardly moved, whose gain is 20 dB off, does not set the level: far from all modes it is what it
 * was (0.3 dB), where modes that count alike make it 6.7 dB louder. */
START_TEST(level_by_the_strike)
{
    for (int struck = 0; struck < 2; struck++) {
        struct arena *a = arena_open();
        double energy_of[3] = {1.0, struck ? 1.0 : 1e-9, 1.0}, power[2] = {0};
        struct residual source;
        struct residual_modes target;
        three_modes(a, 2, 1000.0, &source, &target);
        source.modes.energy = energy_of;
        target.gain[1] = 10.0;
        struct residual_transferred t = transfer(a, &source, &target, RESIDUAL_PHASES, 0);
        struct stft *s = stft_open(N, RATE, 1, a);
        long pixels = (long)s->frames * s->bins;
        double *re = ARENA_TAKE(a, double, pixels), *im = ARENA_TAKE(a, double, pixels);
        for (int k = 0; k < 2; k++) {
            stft_forward(s, k ? t.x : source.x, re, im);
            for (int m = STFT_ONSET; m < s->frames; m++)
                for (long i = m * s->bins + s->bins / 2; i < (m + 1) * s->bins; i++)
                    power[k] += re[i] * re[i] + im[i] * im[i];
        }
        ck_assert_double_eq_tol(decibel(power[1] / power[0]), struck ? 20.0 / 3.0 : 0.0, 0.3);
        stft_close(s);
        arena_close(a);
    }
}
END_TEST

/* By noise: third octaves, and the first milliseconds as they were. */
START_TEST(by_noise)
{
    for (int seed = 0; seed < SEEDS; seed++) {
        struct arena *a = arena_open();
        struct residual source = {RATE, N, noise(a, seed, 10, 200, 8000), drawn(a, seed, 8), NULL};
        struct residual_transferred t = transfer(a, &source, &source.modes, RESIDUAL_NOISE, 0);
        double gain = t.x[100] / source.x[100];
        ck_assert_double_eq_tol(gain, 1.0, 0.01);
        for (long i = 0; i < 600; i++)
            ck_assert_double_eq_tol(t.x[i], gain * source.x[i], 1e-9);
        ck_assert_double_gt(fabs(t.x[2000] - source.x[2000]), 1e-4);
        ck_assert_double_eq_tol(decibel(energy(t.x + 1000, N - 1000) / energy(source.x + 1000, N - 1000)), 0.0, 0.5);
        ck_assert_double_eq_tol(decay_of(source.x, N) / decay_of(t.x, t.n), 1.0, 0.05);
        arena_close(a);
    }
}
END_TEST

START_TEST(no_pair)
{
    struct arena *a = arena_open();
    struct residual source = {RATE, N, noise(a, 1, 20, 0, RATE), one(a, 200, 20, 1), NULL};
    struct residual_modes far = one(a, 2000, 20, 1), silent = one(a, 200, 20, 0);
    for (int k = 0; k < 2; k++) {
        struct residual_transferred t;
        struct err e = {0};
        struct residual_ask ask = {&source, k ? &silent : &far, 0, 0, noise_make(1, "")};
        ck_assert(!residual_transfer(&ask, a, &t, &e));
        ck_assert_int_eq(e.kind, ERR_SCENE);
    }
    arena_close(a);
}
END_TEST

START_TEST(same_bytes)
{
    for (int inverse = 0; inverse < 2; inverse++) {
        struct arena *a = arena_open();
        struct residual source = {RATE, N, noise(a, 3, 15, 0, RATE), drawn(a, 3, 20), NULL};
        struct residual_modes target = drawn(a, 4, 25);
        struct residual_transferred t = transfer(a, &source, &target, inverse, 1),
                                    u = transfer(a, &source, &target, inverse, 1);
        ck_assert_int_eq(t.n, u.n);
        ck_assert_int_eq(memcmp(t.x, u.x, (size_t)t.n * sizeof *t.x), 0);
        arena_close(a);
    }
}
END_TEST

UNIT("test_residual", spectra_and_back, identity, pairs, shifted, stretched, louder, louder_mode, level_by_the_strike,
     by_noise, no_pair, same_bytes)
