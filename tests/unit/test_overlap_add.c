/* The judge is the defining sum y[n] = sum_m h_{x(m)}[n-m] f[m], O(N L), with the response of every sample's own place. */
#include "unit.h"

#include "convolution/overlap_add.h"

enum { N = 9000, LENGTH = 2500, MODES = 30, ROOM = 40000 };
#define RATE 48000.0

static double frequency[MODES], decay[MODES], size[MODES], phase[MODES];
static double force[N + ROOM], sound[N + ROOM], judge[N + ROOM];
static unsigned long long seed;

static double draw(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* Moving: gains sin(k pi x(n)) change sign; the poles too move with `shift`, so that h is launched, not read out. */
struct body {
    double shift, speed;
    int hop, asked;
    long last;
};

static void make(void)
{
    seed = 5;
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 100 * pow(200, i / (MODES - 1.0));
        decay[i] = 60 + 2000 * draw();
        size[i] = 2 * draw() - 1;
        phase[i] = 6 * draw() - 3;
    }
    memset(force, 0, sizeof force);
    memset(sound, 0, sizeof sound);
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

static void brute(const struct body *b, size_t length)
{
    double *h = calloc(length, sizeof *h);
    memset(judge, 0, sizeof judge);
    for (int m = 0; m < N; m++) {
        if (m == 0 || b->speed != 0)
            response(b, m, h, length);
        for (size_t k = 0; k < length; k++)
            judge[m + k] += h[k] * force[m];
    }
    free(h);
}

static void run(struct body *b, size_t length, int order, int hop, int cut)
{
    b->hop = hop;
    b->asked = 0;
    struct overlap_add *o = overlap_add_open(length, order, hop, at_node, b);
    long total = N + (long)length;
    ck_assert_int_le(total + overlap_add_ahead(o), N + ROOM);
    memset(sound, 0, sizeof sound);
    for (long at = 0, n = cut; at < total; at += n, n = cut > 0 ? cut : n % 700 + 37) {
        if (n <= 0)
            n = 1;
        overlap_add_run(o, force + at, sound + at, at + n < total ? n : total - at);
    }
    overlap_add_close(o);
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

/* Exact to the rounding of FFTs: -300 dB of the loudest; demanded: 1e-12 = -240 dB. */
START_TEST(at_rest_is_exact)
{
    static const size_t lengths[] = {1, 2, 1023, 1024, 1025, 2500, 5000};
    make();
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        struct body b = {.speed = 0};
        brute(&b, lengths[i]);
        run(&b, lengths[i], 0, 0, 777);
        printf("length %zu: %.0f dB\n", lengths[i], apart(lengths[i]));
        ck_assert_int_eq(b.asked, 1);
        ck_assert_double_lt(apart(lengths[i]), -240);
    }
}
END_TEST

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
    converges(1, 256, 3, 6.02);
}
END_TEST

START_TEST(order_2)
{
    converges(2, 256, 3, 12.04);
}
END_TEST

START_TEST(order_4)
{
    converges(4, 128, 3, 24.08);
}
END_TEST

/* A node at every sample is the defining sum itself; a response that does not move is exact at any order and hop. */
START_TEST(exact_cases)
{
    make();
    struct body moving = {.speed = 2 * M_PI / 1500, .shift = 0.01}, still = {.speed = 0};
    memset(force + 300, 0, (N - 300) * sizeof *force);
    brute(&moving, 400);
    for (int order = 1; order <= 4; order += order) {
        run(&moving, 400, order, 1, 64);
        ck_assert_double_lt(apart(400), -240);
    }
    make();
    brute(&still, LENGTH);
    for (int order = 1; order <= 4; order += order) {
        run(&still, LENGTH, order, 155, 64); /* odd: a half hop falls between samples */
        ck_assert_double_lt(apart(LENGTH), -240);
    }
}
END_TEST

START_TEST(cuts_do_not_matter)
{
    static double whole[N + ROOM];
    struct body b = {.speed = 2 * M_PI / 5000, .shift = 0.002};
    make();
    for (int order = 0; order <= 4; order += order ? order : 1) {
        run(&b, LENGTH, order, 100, N + LENGTH);
        memcpy(whole, sound, sizeof whole);
        run(&b, LENGTH, order, 100, 1);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
        run(&b, LENGTH, order, 100, 0);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
    }
}
END_TEST

/* No force, no node; and what was in y stays. */
START_TEST(silence_costs_nothing)
{
    struct body b = {.speed = 0};
    make();
    memset(force, 0, sizeof force);
    force[5000] = 1;
    run(&b, LENGTH, 4, 100, 512);
    ck_assert_int_le(b.asked, 4);
    for (int i = 0; i < 4000; i++)
        ck_assert(sound[i] == 0.0);
    struct overlap_add *o = overlap_add_open(10, 2, 8, at_node, &b);
    double f[64] = {0}, y[16];
    for (int i = 0; i < 16; i++)
        y[i] = i;
    overlap_add_run(o, f, y, 16);
    for (int i = 0; i < 16; i++)
        ck_assert(y[i] == i);
    overlap_add_close(o);
}
END_TEST

UNIT("overlap_add", at_rest_is_exact, order_1, order_2, order_4, exact_cases, cuts_do_not_matter, silence_costs_nothing)
