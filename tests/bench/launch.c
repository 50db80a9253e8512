/* What a moving response costs: a scene of 50 modes (100 Hz to 15 kHz, T60 = 0.9 (f/100 Hz)^-0.3 s) whose frequencies
   move by 2 % or 10 %, decays by 30 %, gains by 10 dB in 2 s, under noise, by resonators at nodes (launch.h). One CSV
   row per movement and hop: the error that tests/unit/hop.h predicts, cycles (of the time stamp counter, in the
   thread's time) per sample, times real time at 44.1 kHz, resonators that ring on average, and a hash of the sound, the
   same on every instruction set. */
#include <math.h>
#include <stdio.h>

#include "../unit/hop.h"
#include "bench.h"
#include "convolution/launch.h"

enum { MODES = 50, SECONDS = 4, REPEATS = 3, PIECE = 4096 };
#define RATE 44100.0

struct mode {
    double frequency, decay, re, im;
    double tune, damp, swell; /* what is reached after 2 s, as factors' logarithms */
};

static struct mode modes[MODES];
static double force[PIECE], sound[PIECE];

static void make(double movement)
{
    uint64_t seed = 3;
    for (int i = 0; i < MODES; i++) {
        struct mode *m = &modes[i];
        m->frequency = 100 * pow(150, i / (MODES - 1.0));
        m->decay = log(1000) / (0.9 * pow(m->frequency / 100, -0.3));
        double gain = 1 + bench_draw(&seed) / 2, phase = 3 * bench_draw(&seed);
        m->re = gain * cos(phase);
        m->im = gain * sin(phase);
        m->tune = log(1 + movement * bench_draw(&seed));
        m->damp = log(1.3) * bench_draw(&seed);
        m->swell = log(pow(10, 0.5)) * bench_draw(&seed);
    }
    for (int n = 0; n < PIECE; n++)
        force[n] = bench_draw(&seed);
}

/* There and back again, 2 s each. */
static double along(double frame) { return fabs(fmod(frame / RATE + 4, 4.0) / 2 - 1); }

static void point(void *self, double frame, const struct modes_point *p)
{
    double x = along(frame);
    (void)self;
    for (int i = 0; i < MODES; i++) {
        const struct mode *m = &modes[i];
        double swell = exp(m->swell * x);
        p->frequency[i] = m->frequency * exp(m->tune * x);
        p->decay[i] = m->decay * exp(m->damp * x);
        p->re[i] = m->re * swell;
        p->im[i] = m->im * swell;
    }
}

/* The error in dB at the place where it is worst, from the speed of the poles. */
static double predict(int hop)
{
    double sum = 0;
    for (int i = 0; i < MODES; i++) {
        const struct mode *m = &modes[i];
        double most = fmax(1, exp(m->tune)) * m->frequency, least = fmin(1, exp(m->damp)) * m->decay,
               top = fmax(1, exp(m->damp)) * m->decay;
        double speed = hypot(2 * M_PI * most * m->tune, top * m->damp) / 2; /* rad/s^2 */
        sum += pow(hop_error(4, hop / RATE * speed / least), 2) / MODES;
    }
    return 10 * log10(sum);
}

struct figures {
    double cycles, times, active;
    uint64_t hash;
};

static struct figures run(int hop)
{
    struct figures best = {.times = 0};
    for (int k = 0; k < REPEATS; k++) {
        struct launch_ask ask = {.n = MODES, .rate = RATE, .hop = hop, .floor = 1e-7, .quantity = MODES_VELOCITY};
        struct launch *l = launch_open(&ask, point, NULL);
        struct figures own = {.hash = BENCH_HASH};
        long pieces = SECONDS * (long)RATE / PIECE;
        double seconds = 0;
        for (long i = 0; i < pieces; i++) {
            memset(sound, 0, sizeof sound);
            double start = bench_seconds();
            launch_run(l, force, sound, PIECE);
            seconds += bench_seconds() - start;
            own.active += (double)launch_active(l) / (double)pieces;
            own.hash = bench_hash(own.hash, sound, PIECE);
        }
        own.times = (double)(pieces * PIECE) / RATE / seconds;
        if (own.times > best.times) best = own;
        launch_close(l);
    }
    best.cycles = bench_cycles_per_second() / RATE / best.times;
    return best;
}

int main(void)
{
    static const double movements[] = {0, 0.02, 0.1};
    printf("movement,hop,predicted_dB,cycles_per_sample,times_real_time,resonators,hash\n");
    for (int i = 0; i < 3; i++)
        for (int hop = 16; hop <= 256; hop *= 2) {
            make(movements[i]);
            struct figures f = run(hop);
            printf("%g,%d,%.1f,%.0f,%.0f,%.0f,%016llx\n", movements[i], hop, predict(hop), f.cycles, f.times, f.active,
                   (unsigned long long)f.hash);
        }
    return 0;
}
