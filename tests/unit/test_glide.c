/* Resonators whose poles move (`glide`). Judges: the recursion that defines it, in long double with every sample's own
   pole and gain; the amplitude |z| that retuning must leave alone (where a direct-form biquad, here too, does not). */
#include "unit.h"

#include <complex.h>

#include "convolution/resonators.h"

enum { MAX = 64, N = 48000 };
#define RATE 48000.0

static unsigned long long seed = 1;

static double draw(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* What moves how: values at frame n. */
struct motion {
    int n;
    double frequency[MAX], decay[MAX], phase[MAX];
    double (*tune)(double n), (*damp)(double n); /* factors; NULL: 1 */
};

static double frequency_at(const struct motion *m, int i, double n)
{
    return m->frequency[i] * (m->tune ? m->tune(n) : 1);
}

static double decay_at(const struct motion *m, int i, double n) { return m->decay[i] * (m->damp ? m->damp(n) : 1); }

static void fill(const struct motion *m, double n, const struct modes_point *p)
{
    for (int i = 0; i < m->n; i++) {
        p->frequency[i] = frequency_at(m, i, n);
        p->decay[i] = decay_at(m, i, n);
        p->re[i] = RATE * cos(m->phase[i]);
        p->im[i] = RATE * sin(m->phase[i]);
    }
}

/* y[n] under f, poles given every `ramp` frames; those of the start by resonators_set alone. */
static void glide(const struct motion *m, const double *f, double *y, int n, int ramp)
{
    struct arena *a = arena_open();
    double room[4][MAX] = {{0}};
    struct modes_point p = {.frequency = room[0], .decay = room[1], .re = room[2], .im = room[3]};
    struct resonators_ask ask = {.n = m->n,
                                 .quantity = MODES_VELOCITY,
                                 .rate = RATE,
                                 .frequency = p.frequency,
                                 .decay = p.decay,
                                 .glides = true,
                                 .ramp = ramp};
    struct resonators *r = resonators_make(a, &ask);
    fill(m, -1, &p);
    resonators_set(r, &p);
    memset(y, 0, (size_t)n * sizeof *y);
    for (int at = 0; at < n; at += ramp) {
        int frames = n - at < ramp ? n - at : ramp;
        fill(m, at + frames - 1, &p);
        resonators_run(r, f + at, y + at, frames, &p);
    }
    arena_close(a);
}

static double apart(const double *x, const double *y, int n)
{
    double d = 0, s = 0;
    for (int i = 0; i < n; i++) {
        d += (x[i] - y[i]) * (x[i] - y[i]);
        s += y[i] * y[i];
    }
    return sqrt(d / s);
}

/* ------------------------------------------------------------------ the definition */

static double wander(double n) { return 1 + 0.03 * sin(2 * M_PI * 2 * n / RATE); }
static double breathe(double n) { return 1 + 0.2 * cos(2 * M_PI * 2 * n / RATE); }

/* 50 modes from 100 Hz to 15 kHz, frequencies +-3 % and decays +-20 % at 2 Hz. */
static struct motion scene(int n)
{
    struct motion m = {.n = n, .tune = wander, .damp = breathe};
    for (int i = 0; i < n; i++) {
        m.frequency[i] = 100 * pow(150, n > 1 ? i / (n - 1.0) : 0);
        m.decay[i] = log(1000) / 0.9 * pow(m.frequency[i] / 100, 0.3);
        m.phase[i] = 6 * draw();
    }
    return m;
}

/* Rounding alone. */
static void equals_recursion(const struct motion *m)
{
    enum { SHORT = 6000 };
    static double f[SHORT], y[SHORT], z[SHORT];
    for (int n = 0; n < SHORT; n++)
        f[n] = 2 * draw() - 1;
    memset(z, 0, sizeof z);
    for (int i = 0; i < m->n; i++) {
        long double complex state = 0, gain = cexpl((long double complex)I * m->phase[i]);
        for (int n = 0; n < SHORT; n++) {
            long double complex s = -decay_at(m, i, n) + 2 * acosl(-1) * frequency_at(m, i, n) * (long double complex)I;
            state = cexpl(s / RATE) * state + gain * f[n];
            z[n] += (double)(cimagl(state) - cimagl(gain) * f[n] / 2);
        }
    }
    glide(m, f, y, SHORT, 1);
    printf("poles and gains of every sample: %.1e\n", apart(y, z, SHORT));
    ck_assert_double_lt(apart(y, z, SHORT), 1e-12);
}

START_TEST(equals_the_recursion)
{
    struct motion m = scene(51);
    equals_recursion(&m);
}
END_TEST

static double halting(double n) { return wander(1000 * floor((n + 1) / 1000)); }
static double halting_later(double n) { return breathe(1000 * floor((n + 501) / 1000)); }

/* Poles that rest for a while are not found again: they must be when either frequency or decay has moved on. */
START_TEST(equals_the_recursion_where_poles_halt)
{
    struct motion m = scene(51);
    m.tune = halting;
    m.damp = halting_later;
    equals_recursion(&m);
}
END_TEST

/* Poles that are given again and again and do not move: the fixed bank. */
START_TEST(poles_at_rest_equal_fixed_ones)
{
    static double f[N], y[N], z[N];
    struct motion m = scene(51);
    double room[4][MAX];
    struct modes_point p = {.frequency = room[0], .decay = room[1], .re = room[2], .im = room[3]};
    m.tune = m.damp = NULL;
    m.frequency[3] = 0, m.phase[3] = M_PI / 2, m.decay[4] = 0, m.frequency[5] = 0.4999 * RATE;
    for (int n = 0; n < N; n++)
        f[n] = 2 * draw() - 1;
    glide(&m, f, y, N, 64);
    struct arena *a = arena_open();
    fill(&m, 0, &p);
    struct resonators *r = resonators_make(a, &(struct resonators_ask){.n = m.n,
                                                                       .quantity = MODES_VELOCITY,
                                                                       .rate = RATE,
                                                                       .frequency = p.frequency,
                                                                       .decay = p.decay,
                                                                       .ramp = 64});
    resonators_set(r, &p);
    resonators_run(r, f, z, N, &p);
    printf("against fixed poles: %.1e\n", apart(y, z, N));
    ck_assert_double_lt(apart(y, z, N), 1e-12);
    arena_close(a);
}
END_TEST

/* Error of order ramp^2: 71 dB at 64. (A prototype had 79 dB with other modes; what counts is how long the highest
 * ring.) */
START_TEST(ramped_poles_converge_at_order_2)
{
    static double f[N], y[N], z[N];
    struct motion m = scene(50);
    double last = 0;
    for (int n = 0; n < N; n++)
        f[n] = 2 * draw() - 1;
    glide(&m, f, z, N, 1);
    for (int ramp = 256; ramp >= 16; ramp /= 2) {
        glide(&m, f, y, N, ramp);
        double db = -20 * log10(apart(y, z, N));
        printf("ramp %3d: %.1f dB\n", ramp, db);
        if (last > 0) ck_assert_double_eq_tol(db - last, 12.04, 0.6);
        if (ramp == 64) ck_assert_double_eq_tol(db, 71, 2);
        last = db;
    }
}
END_TEST

/* ------------------------------------------------------------------ the amplitude */

static double jump(double n) { return n < 2000 ? 1 : 10; }
static double sweep(double n)
{
    return n < 1919 ? 1 : n < 2879 ? 1 + 9 * (n - 1919) / 960 : 10;
} /* 20 ms, from a call's end to a call's end */
static double shake(double n) { return 1 + 0.1 * sin(2 * M_PI * 400 * n / RATE); } /* 2 f0 */
static double vibrato(double n) { return 1 + 0.02 * sin(2 * M_PI * 20 * n / RATE); }

/* Amplitude of a mode of 200 Hz that rings while it is retuned, decay taken out: extremes over the time. Im z and Re z
   are the sounds of gains 1 and j. */
static void amplitude(double (*tune)(double), int ramp, double *least, double *most)
{
    static double f[N], y[N], z[N];
    struct motion m = {.n = 1, .frequency = {200}, .decay = {20}, .tune = tune};
    f[0] = 1;
    glide(&m, f, y, N, ramp);
    m.phase[0] = M_PI / 2;
    glide(&m, f, z, N, ramp);
    *least = HUGE_VAL, *most = 0;
    for (int n = 1; n < N / 4; n++) {
        double size = hypot(y[n], z[n]) * exp(20 * n / RATE);
        *least = fmin(*least, size);
        *most = fmax(*most, size);
    }
}

/* The same mode as a biquad in direct form whose coefficients move: what the normal form is for. */
static double biquad(double (*tune)(double))
{
    double v = 1, w = 0, most = 0;
    for (int n = 1; n < N / 4; n++) {
        double fall = exp(-20 / RATE), u = 2 * fall * cos(2 * M_PI * 200 * tune(n) / RATE) * v - fall * fall * w;
        w = v;
        v = u;
        if (n > 11000) most = fmax(most, fabs(v) * exp(20 * n / RATE));
    }
    return most * sin(2 * M_PI * 200 / RATE);
}

START_TEST(retuning_leaves_the_amplitude)
{
    static const struct {
        const char *name;
        double (*tune)(double);
        double disturbed; /* the biquad's, by at least this factor */
    } cases[] = {{"jump 200 -> 2000 Hz", jump, 1.05},
                 {"sweep in 20 ms", sweep, 1.05},
                 {"+-10 % at 2 f0", shake, 1e4},
                 {"+-2 % at 20 Hz", vibrato, 1.001}};
    for (int k = 0; k < 4; k++) {
        double least, most, direct = biquad(cases[k].tune);
        amplitude(cases[k].tune, 1, &least, &most);
        printf("%-20s %.10f to %.10f; direct form %.3g\n", cases[k].name, least, most, direct);
        ck_assert_double_lt(fabs(least - 1), 1e-9);
        ck_assert_double_lt(fabs(most - 1), 1e-9);
        ck_assert(fmax(direct, 1 / direct) > cases[k].disturbed);
    }
}
END_TEST

/* Linear ramps go along chords of the unit circle, which costs (dtheta)^2/12 (1 - 1/ramp^2) per sample, dtheta the turn
 * per call. Never a gain. */
START_TEST(ramps_damp_a_little)
{
    for (int ramp = 64; ramp >= 4; ramp /= 4) {
        double least, most, turn = 2 * M_PI * 1800 / RATE * ramp / 960,
                            lost = 960 * turn * turn / 12 * (1 - 1.0 / (ramp * ramp));
        amplitude(sweep, ramp, &least, &most);
        printf("sweep in 20 ms, ramp %2d: %.6f, expected %.6f\n", ramp, least, 1 - lost);
        ck_assert_double_eq_tol((1 - least) / lost, 1, 0.05);
        ck_assert_double_lt(most, 1 + 1e-9);
        amplitude(vibrato, ramp, &least, &most);
        printf("+-2 %% at 20 Hz, ramp %2d: %.6f after 0.25 s\n", ramp, least);
        ck_assert_double_lt(most, 1 + 1e-9);
        ck_assert_double_gt(least, 0.999);
    }
}
END_TEST

/* Any sequence of poles inside the circle, jumps from call to call, up to rate/2 and without decay: never a gain. */
START_TEST(nothing_grows)
{
    struct arena *a = arena_open();
    double frequency[2] = {100, 100}, decay[2] = {0, 0}, re[2] = {RATE, 0}, im[2] = {0, RATE}, f[97] = {1}, y[97];
    struct modes_point p = {.frequency = frequency, .decay = decay, .re = re, .im = im};
    struct resonators_ask ask = {.n = 2,
                                 .quantity = MODES_VELOCITY,
                                 .rate = RATE,
                                 .frequency = frequency,
                                 .decay = decay,
                                 .glides = true,
                                 .ramp = 97};
    struct resonators *r = resonators_make(a, &ask);
    double last = 2;
    resonators_set(r, &p);
    for (int k = 0; k < 3000; k++) {
        memset(y, 0, sizeof y);
        frequency[0] = frequency[1] = draw() * 0.49999 * RATE;
        decay[0] = decay[1] = k % 3 ? 0 : draw();
        resonators_run(r, f, y, k % 2 ? 1 : 1 + (int)(96 * draw()), &p);
        f[0] = 0;
        double most = 0;
        for (int n = 0; n < 97; n++)
            most = fmax(most, fabs(y[n]));
        ck_assert_double_le(most, last * (1 + 1e-12));
        if (resonators_silent(r)) break;
        last = 2; /* sum of Im z and Re z of two equal modes: sqrt 2 at most */
    }
    arena_close(a);
}
END_TEST

UNIT("glide", equals_the_recursion, equals_the_recursion_where_poles_halt, poles_at_rest_equal_fixed_ones,
     ramped_poles_converge_at_order_2, retuning_leaves_the_amplitude, ramps_damp_a_little, nothing_grows)
