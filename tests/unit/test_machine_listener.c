/* machine_listener: what it hears and what it does not, on tones under known envelopes. */
#include "analysis/machine_listener.h"

#include <math.h>
#include <string.h>

#include "num/noise.h"
#include "unit.h"

enum { RATE = 8000, FRAMES = 16000 };

/* Noise whose level goes as |sin| with so many half periods in 2 s, brighter where it is louder if `bright`. */
static struct machine_listener_sound sound(struct arena *a, int halves, double gain, bool bright, uint64_t seed,
                                           int channels)
{
    struct wav w = {RATE, channels, FRAMES, ARENA_TAKE(a, double, FRAMES *channels), 0};
    struct noise g = noise_make(seed, "listener");
    struct machine_listener_sound s = {0};
    struct err e = {0};
    double *x = ARENA_TAKE(a, double, FRAMES), last = 0;
    noise_normal(g, 0, FRAMES, x);
    for (int i = 0; i < FRAMES; i++) {
        double level = 0.02 + fabs(sin(acos(-1) * halves * i / FRAMES)), pole = bright ? 0.95 - 0.9 * level : 0.5;
        last = pole * last + (1 - fabs(pole)) * x[i];
        for (int c = 0; c < channels; c++)
            w.x[i * channels + c] = gain * level * last;
    }
    ck_assert(machine_listener_hear("x.wav", &w, a, &s, &e));
    return s;
}

START_TEST(test_distance)
{
    struct arena *a = arena_open();
    struct machine_listener_sound s = sound(a, 4, 1, false, 1, 1), quiet = sound(a, 4, 1e-3, false, 1, 1),
                                  both = sound(a, 4, 1, false, 1, 2), take = sound(a, 4, 1, false, 2, 1),
                                  other = sound(a, 7, 1, false, 2, 1), bright = sound(a, 4, 1, true, 1, 1);
    ck_assert_double_eq(machine_listener_distance(&s, &s), 0);
    ck_assert_double_eq_tol(machine_listener_distance(&s, &quiet), 0, 1e-12); /* level as such does not count */
    ck_assert_double_eq_tol(machine_listener_distance(&s, &both), 0, 1e-12);
    ck_assert_double_eq(machine_listener_distance(&s, &other), machine_listener_distance(&other, &s));
    ck_assert_double_lt(machine_listener_distance(&s, &take), 0.3 * machine_listener_distance(&s, &other));
    ck_assert_double_gt(machine_listener_distance(&s, &bright),
                        machine_listener_distance(&s, &take)); /* brightness does */
    /* a shorter sound goes on at the floor */
    struct machine_listener_sound half = s;
    half.n /= 2;
    ck_assert_double_gt(machine_listener_distance(&s, &half), 0.5);
    arena_close(a);
}
END_TEST

/* A tone that decays by `decay` 1/s. */
static struct machine_listener_sound struck(struct arena *a, double f, double decay)
{
    struct wav w = {RATE, 1, FRAMES, ARENA_TAKE(a, double, FRAMES), 0};
    struct machine_listener_sound s = {0};
    struct err e = {0};
    for (int i = 0; i < FRAMES; i++)
        w.x[i] = exp(-decay * i / RATE) * sin(2 * acos(-1) * f * i / RATE);
    ck_assert(machine_listener_hear("x.wav", &w, a, &s, &e));
    s.cue = MACHINE_LISTENER_MATERIAL;
    return s;
}

/* By material: twice as fast is an octave, twice as bright too. Hann's window spreads a tone over its side lobes. */
START_TEST(test_material)
{
    struct arena *a = arena_open();
    struct machine_listener_sound s = struck(a, 400, 8), fast = struck(a, 400, 16), bright = struck(a, 800, 8),
                                  held = struck(a, 400, 0);
    ck_assert_double_eq_tol(s.fade, log2(8 * 20 / log(10)), 1e-3);
    ck_assert_double_eq_tol(s.colour, log2(400), 0.01);
    ck_assert_double_eq_tol(machine_listener_distance(&s, &fast), 1, 1e-2);
    ck_assert_double_eq_tol(machine_listener_distance(&s, &bright), 1, 0.02);
    ck_assert_double_eq_tol(held.fade, 0, 1e-9); /* 1 dB/s at least */
    arena_close(a);
}
END_TEST

START_TEST(test_chooses)
{
    struct arena *a = arena_open();
    struct machine_listener_sound t[6], s = sound(a, 4, 1, false, 9, 1);
    double share[3], spread;
    for (int i = 0; i < 6; i++) {
        t[i] = sound(a, 2 + 2 * (i / 2), 1, false, (uint64_t)i, 1); /* 2, 4, 6 half periods, two takes of each */
        t[i].class = i / 2;
    }
    spread = machine_listener_spread(t, 6);
    ck_assert(spread > 0 && spread < 0.5);
    machine_listener_choose(&s, t, 6, -1, 3, spread, share);
    ck_assert_double_eq_tol(share[0] + share[1] + share[2], 1, 1e-15);
    ck_assert(share[1] > 0.8 && share[1] > share[0] && share[1] > share[2]);
    double d[2] = {fmin(machine_listener_distance(&s, &t[0]), machine_listener_distance(&s, &t[1])),
                   fmin(machine_listener_distance(&s, &t[2]), machine_listener_distance(&s, &t[3]))};
    ck_assert_double_eq_tol(share[0] / share[1], exp((d[1] - d[0]) / (2 * spread)), 1e-12);
    machine_listener_choose(&t[2], t, 6, -1, 3, spread, share);
    double itself = share[1];
    machine_listener_choose(&t[2], t, 6, 2, 3, spread, share); /* without itself it is less sure */
    ck_assert(share[1] < itself && share[1] > 0.5);
    ck_assert(isnan(machine_listener_spread(t, 5)));
    arena_close(a);
}
END_TEST

START_TEST(test_silence)
{
    struct arena *a = arena_open();
    struct wav w = {RATE, 1, FRAMES, ARENA_TAKE(a, double, FRAMES), 0};
    struct machine_listener_sound s;
    struct err e = {0};
    ck_assert(!machine_listener_hear("x.wav", &w, a, &s, &e) && e.kind == ERR_SCENE && strstr(e.text, "silent"));
    w.rate = 100;
    e = (struct err){0};
    ck_assert(!machine_listener_hear("x.wav", &w, a, &s, &e) && e.kind == ERR_SCENE);
    arena_close(a);
}
END_TEST

UNIT("machine_listener", test_distance, test_material, test_chooses, test_silence)
