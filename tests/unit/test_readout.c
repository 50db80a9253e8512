/* The judge is the defining sum y[n] = sum_m h_{x(n)}[n - m] f[m], O(N L), with the response of every sound sample's own place. */
#include "unit.h"

#include "convolution/readout.h"

enum { N = 6000, LENGTH = 1600, MODES = 12, ROOM = 20000 };
#define RATE 48000.0

static double frequency[MODES], decay[MODES], size[MODES], phase[MODES];
static double force[N + ROOM], sound[N + ROOM], judge[N + ROOM];
static unsigned long long seed;

static double draw(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 9007199254740992.0;
}

struct body {
    double shift, speed;
    int hop, asked;
    long last;
};

static void make(void)
{
    seed = 5;
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 100 * pow(150, i / (MODES - 1.0));
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

static void brute(const struct body *b, int length)
{
    double *h = calloc((size_t)length, sizeof *h);
    memset(judge, 0, sizeof judge);
    for (int n = 0; n < N + length; n++) {
        if (n == 0 || b->speed != 0)
            response(b, n, h, (size_t)length);
        for (int k = 0; k < length && k <= n; k++)
            judge[n] += h[k] * force[n - k];
    }
    free(h);
}

static void run(struct body *b, size_t length, int order, int hop, int cut)
{
    b->hop = hop;
    b->asked = 0;
    struct readout *r = readout_open(length, order, hop, at_node, b);
    long total = N + (long)length;
    ck_assert_int_eq(readout_ahead(r), order * hop - 1);
    memset(sound, 0, sizeof sound);
    for (long at = 0, n = cut; at < total; at += n, n = cut > 0 ? cut : n % 700 + 37)
        readout_run(r, force + at, sound + at, at + n < total ? n : total - at);
    readout_close(r);
}

static double apart(size_t length)
{
    double d = 0, s = 0;
    for (size_t i = 0; i < N + length; i++) {
        d += (sound[i] - judge[i]) * (sound[i] - judge[i]);
        s += judge[i] * judge[i];
    }
    return 10 * log10(d / s + 1e-40);
}

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

START_TEST(order_1)
{
    converges(1, 128, 3, 6.02);
}
END_TEST

START_TEST(order_2)
{
    converges(2, 128, 3, 12.04);
}
END_TEST

START_TEST(order_4)
{
    converges(4, 64, 3, 24.08);
}
END_TEST

/* A node at every sample is the defining sum itself; a response that does not move is exact at any order and hop: -240 dB, 1e-12. */
START_TEST(exact_cases)
{
    struct body moving = {.speed = 2 * M_PI / 1500, .shift = 0.01}, still = {.speed = 0};
    make();
    memset(force + 300, 0, (N - 300) * sizeof *force);
    brute(&moving, 400);
    for (int order = 1; order <= 4; order += order) {
        run(&moving, 400, order, 1, 64);
        ck_assert_double_lt(apart(400), -240);
    }
    static const size_t lengths[] = {1, 2, 3, LENGTH};
    make();
    for (int i = 0; i < 4; i++) {
        brute(&still, (int)lengths[i]);
        for (int order = 1; order <= 4; order += order) {
            run(&still, lengths[i], order, 155, 64); /* odd: a half hop falls between samples */
            ck_assert_double_lt(apart(lengths[i]), -240);
        }
    }
}
END_TEST

/* overlap_add at rest and a readout whose response does not move are the same convolution. */
START_TEST(as_overlap_add_at_rest)
{
    struct body b = {.speed = 0};
    make();
    struct overlap_add *o = overlap_add_open(LENGTH, 0, 0, at_node, &b);
    memset(judge, 0, sizeof judge);
    overlap_add_run(o, force, judge, N + LENGTH);
    overlap_add_close(o);
    for (int order = 1; order <= 4; order += order) {
        run(&b, LENGTH, order, 300, 1000);
        ck_assert_double_lt(apart(LENGTH), -240);
    }
}
END_TEST

START_TEST(cuts_do_not_matter)
{
    static double whole[N + ROOM];
    struct body b = {.speed = 2 * M_PI / 5000, .shift = 0.002};
    make();
    for (int order = 1; order <= 4; order += order) {
        run(&b, LENGTH, order, 100, N + LENGTH);
        memcpy(whole, sound, sizeof whole);
        run(&b, LENGTH, order, 100, 1);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
        run(&b, LENGTH, order, 100, 0);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
    }
}
END_TEST

/* Nodes that no force reaches are not asked for; and what was in y stays. */
START_TEST(silence_costs_nothing)
{
    struct body b = {.speed = 0};
    make();
    memset(force, 0, sizeof force);
    force[3500] = 1;
    run(&b, LENGTH, 4, 100, 512);
    ck_assert_int_le(b.asked, LENGTH / 100 + 5);
    ck_assert_int_ge(b.asked, LENGTH / 100);
    for (int i = 0; i < 3000; i++)
        ck_assert(sound[i] == 0.0);
    double f[64] = {0}, y[16];
    struct readout *r = readout_open(10, 2, 8, at_node, &b);
    for (int i = 0; i < 16; i++)
        y[i] = i;
    readout_run(r, f, y, 16);
    for (int i = 0; i < 16; i++)
        ck_assert(y[i] == i);
    readout_close(r);
}
END_TEST

UNIT("readout", order_1, order_2, order_4, exact_cases, as_overlap_add_at_rest, cuts_do_not_matter, silence_costs_nothing)
