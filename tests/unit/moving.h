/* A body whose response moves, under noise, for the tests of overlap_add and readout: each holds its sound against the defining sum of its own reading,
   and both must converge alike. A test says before it includes this how long all is, enum {N, LENGTH, MODES, ROOM, TOP}: frames of force and of response,
   modes, frames to spare, and the highest frequency over the lowest; and it brings `brute`, its judge, and `run`, its engine. */
#ifndef TESTS_UNIT_MOVING_H
#define TESTS_UNIT_MOVING_H
#include "unit.h"

#define RATE 48000.0

static double frequency[MODES], decay[MODES], size[MODES], phase[MODES];
static double force[N + ROOM], sound[N + ROOM], judge[N + ROOM];
static unsigned long long seed;

/* Moving: gains sin(k pi x(n)) change sign; the poles too move with `shift`, so that it matters whether h is launched or read out. */
struct body {
    double shift, speed;
    int hop, asked;
    long last;
};

/* The defining sum, of so many frames of response, into judge. */
static void brute(const struct body *b, size_t length);

/* The engine, in calls of `cut` frames (0: uneven ones), into sound. */
static void run(struct body *b, size_t length, int order, int hop, int cut);

static double draw(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static void make(void)
{
    seed = 5;
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 100 * pow(TOP, i / (MODES - 1.0));
        decay[i] = 60 + 2000 * draw();
        size[i] = 2 * draw() - 1;
        phase[i] = 6 * draw() - 3;
    }
    memset(force, 0, sizeof force);
    for (int n = 0; n < N; n++)
        force[n] = 2 * draw() - 1;
}

static void response(const struct body *b, double n, double *h, size_t length)
{
    double x = 0.5 + 0.45 * sin(b->speed * n);
    memset(h, 0, length * sizeof *h);
    for (int i = 0; i < MODES; i++) {
        double turn = 2 * M_PI * frequency[i] * (1 + b->shift * x) / RATE, fall = exp(-decay[i] / RATE);
        double across = cos(turn), up = sin(turn);
        double a = size[i] * sin((i % 4 + 1) * M_PI * x) / RATE, re = a * cos(phase[i]), im = a * sin(phase[i]);
        for (size_t k = 0; k < length; k++) {
            h[k] += (k ? 1 : 0.5) * im;
            double next = fall * (re * across - im * up);
            im = fall * (re * up + im * across);
            re = next;
        }
    }
}

static void at_node(void *self, long k, double *h, size_t length)
{
    struct body *b = self;
    ck_assert(b->asked == 0 || k > b->last);
    b->last = k;
    b->asked++;
    response(b, (double)k * b->hop, h, length);
}

/* dB, root-mean-square of the difference to the judge. */
static double apart(size_t length)
{
    double d = 0, s = 0;
    for (size_t i = 0; i < N + length; i++) {
        d += (sound[i] - judge[i]) * (sound[i] - judge[i]);
        s += judge[i] * judge[i];
    }
    return 10 * log10(d / s + 1e-40);
}

/* Halving the hop brings so many dB, each time and on the whole. */
static void converges(int order, int hop, int halvings, double per_halving)
{
    struct body b = {.speed = 2 * M_PI / 5000, .shift = 0.002};
    double first = 0, last = 0;
    make();
    brute(&b, LENGTH);
    for (int i = 0; i <= halvings; i++, hop /= 2) {
        run(&b, LENGTH, order, hop, 1000);
        double d = apart(LENGTH);
        printf("order %d, hop %3d: %.1f dB, %d nodes\n", order, hop, d, b.asked);
        if (i)
            ck_assert_double_eq_tol(last - d, per_halving, 1.5);
        else
            first = d;
        last = d;
    }
    ck_assert_double_eq_tol((first - last) / halvings, per_halving, 1.0);
}

/* A node at every sample is the defining sum itself, at any order: -240 dB, 1e-12. */
static void exact_at_every_sample(void)
{
    struct body b = {.speed = 2 * M_PI / 1500, .shift = 0.01};
    make();
    memset(force + 300, 0, (N - 300) * sizeof *force);
    brute(&b, 400);
    for (int order = 1; order <= 4; order += order) {
        run(&b, 400, order, 1, 64);
        ck_assert_double_lt(apart(400), -240);
    }
}

/* A response that does not move is exact at any order and hop. */
static void exact_at_rest(size_t length)
{
    struct body b = {.speed = 0};
    make();
    brute(&b, length);
    for (int order = 1; order <= 4; order += order) {
        run(&b, length, order, 155, 64); /* odd: a half hop falls between samples */
        ck_assert_double_lt(apart(length), -240);
    }
}

/* In one call, a frame at a time, in uneven pieces: the same bits. */
static void cuts_alike(int order)
{
    static double whole[N + ROOM];
    struct body b = {.speed = 2 * M_PI / 5000, .shift = 0.002};
    make();
    run(&b, LENGTH, order, 100, N + LENGTH);
    memcpy(whole, sound, sizeof whole);
    run(&b, LENGTH, order, 100, 1);
    ck_assert(memcmp(whole, sound, sizeof whole) == 0);
    run(&b, LENGTH, order, 100, 0);
    ck_assert(memcmp(whole, sound, sizeof whole) == 0);
}

#endif
