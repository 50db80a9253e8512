/* A response that moves, under noise: either reading against its defining sum, O(N L): each sample launches the
   response of its own place, or is heard through the response of the present one. */
#include "unit.h"

#include "convolution/overlap_add.h"

enum { N = 6000, LENGTH = 1600, MODES = 12, ROOM = 20000, TOP = 150 };

#define RATE 48000.0

static double frequency[MODES], decay[MODES], size[MODES], phase[MODES];
static double force[N + ROOM], sound[N + ROOM], judge[N + ROOM];
static unsigned long long seed;

/* Moving: gains sin(k pi x(n)) change sign; the poles too move with `shift`, so that it matters whether h is launched
 * or read out. */
struct body {
    double shift, speed;
    int hop, asked;
    long last;
};

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

static void brute(enum overlap_add_reading reading, const struct body *b, size_t length)
{
    double *h = calloc(length, sizeof *h);
    bool readout = reading == OVERLAP_ADD_READOUT;
    memset(judge, 0, sizeof judge);
    for (size_t n = 0; n < (readout ? N + length : N); n++) {
        if (n == 0 || b->speed != 0) response(b, (double)n, h, length);
        for (size_t k = 0; k < length && (!readout || k <= n); k++)
            judge[readout ? n : n + k] += h[k] * force[readout ? n - k : n];
    }
    free(h);
}

/* In calls of `cut` frames (0: uneven ones), into sound. */
static void run(enum overlap_add_reading reading, struct body *b, size_t length, int hop, int cut)
{
    b->hop = hop;
    b->asked = 0;
    struct overlap_add_moving *o = overlap_add_moving_open(length, hop, reading, at_node, b);
    long total = N + (long)length;
    ck_assert_int_eq(overlap_add_moving_ahead(o), 4 * hop - 1);
    memset(sound, 0, sizeof sound);
    for (long at = 0, n = cut ? cut : 1; at < total; at += n, n = cut ? cut : n % 700 + 37)
        overlap_add_moving_run(o, force + at, sound + at, at + n < total ? n : total - at);
    overlap_add_moving_close(o);
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

/* Halving the hop brings 24 dB, each time and on the whole. */
START_TEST(order)
{
    for (int reading = OVERLAP_ADD_LAUNCH; reading <= OVERLAP_ADD_READOUT; reading++) {
        struct body b = {.speed = 2 * M_PI / 5000, .shift = 0.002};
        double first = 0, last = 0;
        make();
        brute(reading, &b, LENGTH);
        for (int i = 0, hop = reading == OVERLAP_ADD_LAUNCH ? 128 : 64; i <= 3; i++, hop /= 2) {
            run(reading, &b, LENGTH, hop, 1000);
            double d = apart(LENGTH);
            printf("reading %d, hop %3d: %.1f dB, %d nodes\n", reading, hop, d, b.asked);
            if (i)
                ck_assert_double_eq_tol(last - d, 24.08, 1.5);
            else
                first = d;
            last = d;
        }
        ck_assert_double_eq_tol((first - last) / 3, 24.08, 1.0);
    }
}
END_TEST

/* A node at every sample is the defining sum itself: -240 dB, 1e-12. */
START_TEST(exact_at_every_sample)
{
    for (int reading = OVERLAP_ADD_LAUNCH; reading <= OVERLAP_ADD_READOUT; reading++) {
        struct body b = {.speed = 2 * M_PI / 1500, .shift = 0.01};
        make();
        memset(force + 300, 0, (N - 300) * sizeof *force);
        brute(reading, &b, 400);
        run(reading, &b, 400, 1, 64);
        ck_assert_double_lt(apart(400), -240);
    }
}
END_TEST

/* A response that does not move is exact at any hop. */
START_TEST(exact_at_rest)
{
    static const size_t lengths[] = {1, 2, 3, LENGTH};
    for (int reading = OVERLAP_ADD_LAUNCH; reading <= OVERLAP_ADD_READOUT; reading++)
        for (int i = 0; i < 4; i++) {
            struct body b = {.speed = 0};
            make();
            brute(reading, &b, lengths[i]);
            run(reading, &b, lengths[i], 155, 64);
            ck_assert_double_lt(apart(lengths[i]), -240);
        }
}
END_TEST

/* In one call, a frame at a time, in uneven pieces: the same bits. */
START_TEST(cuts_do_not_matter)
{
    static double whole[N + ROOM];
    for (int reading = OVERLAP_ADD_LAUNCH; reading <= OVERLAP_ADD_READOUT; reading++) {
        struct body b = {.speed = 2 * M_PI / 5000, .shift = 0.002};
        make();
        run(reading, &b, LENGTH, 100, N + LENGTH);
        memcpy(whole, sound, sizeof whole);
        run(reading, &b, LENGTH, 100, 1);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
        run(reading, &b, LENGTH, 100, 0);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
    }
}
END_TEST

/* Nodes that no force reaches are not asked for; and what was in y stays. */
START_TEST(silence_costs_nothing)
{
    static const int most[] = {4, LENGTH / 100 + 5};
    for (int reading = OVERLAP_ADD_LAUNCH; reading <= OVERLAP_ADD_READOUT; reading++) {
        struct body b = {.speed = 0};
        make();
        memset(force, 0, sizeof force);
        force[3500] = 1;
        run(reading, &b, LENGTH, 100, 512);
        ck_assert_int_le(b.asked, most[reading]);
        for (int i = 0; i < 3000; i++)
            ck_assert(sound[i] == 0.0);
        double f[64] = {0}, y[16];
        struct overlap_add_moving *o = overlap_add_moving_open(10, 8, reading, at_node, &b);
        for (int i = 0; i < 16; i++)
            y[i] = i;
        overlap_add_moving_run(o, f, y, 16);
        for (int i = 0; i < 16; i++)
            ck_assert(y[i] == i);
        overlap_add_moving_close(o);
    }
}
END_TEST

UNIT("overlap_add_moving", order, exact_at_every_sample, exact_at_rest, cuts_do_not_matter, silence_costs_nothing)
