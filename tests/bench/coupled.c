/* What the coupled rolling ball costs (coupled_gradient.c): 20 g, 5e9 N/m^1.5 per kg, mu = 1 s/m, on rigid ground and
   on 50 and 200 modes (100 Hz to 15 kHz, 1 kg), the place standing or moving, over bumps at 300 Hz so low that the ball
   never leaves the ground, or so high that it bounces. One CSV row per case: cycles (of the time stamp counter, in the
   thread's time) per step and per step in contact, its share, passes of Newton's method in it, mean force over weight,
   residual over the highest energy, and a hash of the force, the same on every instruction set. The last column is a
   prototype's cycles (another CPU, always in contact, 50 modes that stand), which kept no ledger. */
#include <math.h>
#include <stdio.h>

#include "bench.h"
#include "convolution/coupled.h"
#include "scene/scene.h"

enum { MODES = 200, STEPS = 1 << 18, REPEATS = 3, PIECE = 1024 };
#define RATE 44100.0
#define MASS 0.02

static double frequency[MODES], decay[MODES], phi[MODES], surface[PIECE], force[PIECE];

struct figures {
    double seconds, weight;
    uint64_t hash;
    struct coupled_state end;
};

static void place(int n, double turn)
{
    for (int i = 0; i < n; i++)
        phi[i] = 1.4 * sin((i + 1) * (0.7 + turn));
}

static bool run(int n, bool moving, double bump, struct figures *f)
{
    struct err e = {.kind = ERR_NONE};
    struct arena *a = arena_open();
    struct coupled *c;
    struct coupled_ask ask = {
        INTEGRATOR_DISCRETE_GRADIENT, 1 / RATE, MASS, MASS * 9.81, 5e9 * MASS, 1, n, frequency, decay};
    *f = (struct figures){.hash = BENCH_HASH};
    place(n, 0);
    if (!coupled_make(a, &ask, &c, &e)) return fprintf(stderr, "%s\n", e.text), false;
    coupled_start(c, coupled_rest(c, 0, phi), 0, 0, phi, true);
    for (long done = 0; done < STEPS; done += PIECE) {
        for (int i = 0; i < PIECE; i++)
            surface[i] = bump * sin(2 * M_PI * 300 * (double)(done + i + 1) / RATE) *
                         sin(2 * M_PI * 7 * (double)(done + i + 1) / RATE);
        if (moving) place(n, 0.2 * (double)(done + PIECE) / RATE);
        double start = bench_seconds();
        if (!coupled_run(c, PIECE, surface, moving ? phi : NULL, force, &e))
            return fprintf(stderr, "%s\n", e.text), false;
        f->seconds += bench_seconds() - start;
        for (int i = 0; i < PIECE; i++)
            f->weight += force[i] / (MASS * 9.81 * STEPS);
        f->hash = bench_hash(f->hash, force, PIECE);
    }
    f->end = *coupled_state(c);
    arena_close(a);
    return true;
}

int main(void)
{
    const int modes[] = {0, 50, 200};
    const double bumps[] = {0, 1e-7, 1e-5};
    double clock = bench_cycles_per_second();
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 100 * pow(150, i % 50 / 49.0) * (1 + 0.003 * (i / 50));
        decay[i] = log(1000) / (0.9 * pow(frequency[i] / 100, -0.3));
    }
    puts("modes,place,bumps_m,cycles_per_step,contact_share,passes,passes_most,mean_force,residual,hash,prototype_"
         "cycles");
    for (int k = 0; k < 18; k++) {
        int n = modes[k / 6];
        bool moving = k % 2;
        struct figures best = {.seconds = 1e9}, f;
        if (n == 0 && moving) continue;
        for (int repeat = 0; repeat < REPEATS; repeat++) {
            if (!run(n, moving, bumps[k % 6 / 2], &f)) return 1;
            if (f.seconds < best.seconds) best = f;
        }
        printf("%d,%s,%g,%.0f,%.3f,%.2f,%ld,%.5f,%.1e,%016llx,%s\n", n, moving ? "moving" : "standing",
               bumps[k % 6 / 2], best.seconds * clock / STEPS, (double)best.end.contact_steps / STEPS,
               (double)best.end.iterations / fmax(1, (double)best.end.contact_steps), best.end.iterations_most,
               best.weight, best.end.residual / best.end.highest, (unsigned long long)best.hash,
               n == 50 && !moving ? "253" : "");
    }
    return 0;
}
