/* readout by resonators: against the defining sum y[n] = sum_m h_{x(n)}[n - m] f[m] where every frame is a node, against readout.h's interpolation of
   responses where hops are longer. */
#include "convolution/readout_modes.h"

#include <complex.h>

#include "convolution/readout.h"
#include "unit.h"

enum { N = 3000, MODES = 9 };
#define RATE 8000.0

static double force[N + 4096], sound[N], judge[N];

static void make(void)
{
    unsigned long long seed = 11;
    memset(force, 0, sizeof force);
    for (int n = 40; n < N - 700; n++) {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        force[n] = (double)(seed >> 11) / 4503599627370496.0 - 1;
    }
}

struct body {
    int quantity;
    bool still, smooth; /* smooth: no mode fades */
};

/* Back and forth; a mode without decay, one that is silent for some of the way. */
static void point(void *self, double frame, const struct modes_point *p)
{
    const struct body *b = self;
    double x = b->still ? 0.3 : 0.5 - 0.5 * cos(2 * M_PI * frame / 1100);
    for (int i = 0; i < MODES; i++) {
        double turn = 0.3 * i + x, size = i == 2 && !b->smooth ? fmax(0, x - 0.4) : 1 - 0.7 * x + 0.1 * i;
        p->frequency[i] = 100 * pow(1.5, i) * (1 + 0.01 * x);
        p->decay[i] = i == 5 ? 0 : 30 + 10 * i + 20 * x;
        p->re[i] = size * cos(turn);
        p->im[i] = size * sin(turn);
    }
}

static double complex state_through(double complex gain, double frequency, double decay)
{
    return gain / (-decay + 2 * M_PI * I * frequency);
}

static void sum(const struct body *b, double *y)
{
    double at[4][MODES];
    struct modes_point p = {at[0], at[1], at[2], at[3]};
    memset(y, 0, N * sizeof *y);
    for (int n = 0; n < N; n++) {
        point((void *)b, n, &p);
        for (int i = 0; i < MODES; i++) {
            double complex gain = p.re[i] + I * p.im[i], pole = cexp((-p.decay[i] + 2 * M_PI * I * p.frequency[i]) / RATE), z = 0;
            for (int m = 0; m <= n; m++)
                z = pole * z + force[m];
            y[n] += (cimag(gain * z) - 0.5 * cimag(gain) * force[n]) / RATE;
            if (b->quantity == MODES_ACCELERATION)
                y[n] += cimag(state_through(gain, p.frequency[i], p.decay[i])) * force[n];
        }
    }
}

static void run(const struct body *b, const double *hop, int order, int cut)
{
    struct readout_modes_ask ask = {MODES, order, RATE, hop, 300, 10, b->quantity};
    struct readout_modes *r = readout_modes_open(&ask, point, (void *)b);
    memset(sound, 0, sizeof sound);
    for (int n = 0; n < N; n += cut)
        readout_modes_run(r, force + n, sound + n, n + cut < N ? cut : N - n);
    readout_modes_close(r);
}

static double apart(void)
{
    double wrong = 0, whole = 0;
    for (int n = 0; n < N; n++) {
        wrong += (sound[n] - judge[n]) * (sound[n] - judge[n]);
        whole += judge[n] * judge[n];
    }
    return sqrt(wrong / whole);
}

static void fill(double *hop, double value)
{
    for (int i = 0; i < MODES; i++)
        hop[i] = value;
}

START_TEST(test_sum)
{
    double hop[MODES];
    make();
    fill(hop, 1);
    for (int quantity = MODES_VELOCITY; quantity <= MODES_ACCELERATION; quantity++) {
        struct body b = {quantity, false, false};
        sum(&b, judge);
        for (int order = 1; order <= 4; order *= 2) {
            run(&b, hop, order, 700);
            ck_assert_msg(apart() < 1e-12, "order %d: %g", order, apart());
        }
    }
}
END_TEST

/* At rest, hops do not matter: all sizes at once. */
START_TEST(test_rest)
{
    static const double hop[MODES] = {1, 2, 7, 16, 100, 128, 512, 700, 3000};
    struct body b = {MODES_VELOCITY, true, false};
    make();
    sum(&b, judge);
    for (int order = 1; order <= 4; order *= 2) {
        run(&b, hop, order, 333);
        ck_assert_msg(apart() < 1e-12, "order %d: %g", order, apart());
    }
}
END_TEST

struct sampled {
    const struct body *body;
    int hop;
};

static void response(void *self, long k, double *h, size_t length)
{
    const struct sampled *s = self;
    double at[4][MODES];
    struct modes_point p = {at[0], at[1], at[2], at[3]};
    point((void *)s->body, (double)k * s->hop, &p);
    memset(h, 0, length * sizeof *h);
    for (int i = 0; i < MODES; i++) {
        double complex z = (p.re[i] + I * p.im[i]) / RATE, pole = cexp((-p.decay[i] + 2 * M_PI * I * p.frequency[i]) / RATE);
        for (size_t j = 0; j < length; j++, z *= pole)
            h[j] += (j ? 1 : 0.5) * cimag(z);
    }
}

/* One hop for all: the same interpolation as readout.c's, to rounding; and it converges on the sum, 12 and 24 dB a halving. */
START_TEST(test_hops)
{
    struct body b = {MODES_VELOCITY, false, true};
    double hop[MODES], error[2];
    static double exact[N];
    make();
    sum(&b, exact);
    for (int order = 1; order <= 4; order *= 2) {
        for (int size = 8; size >= 4; size /= 2) {
            struct sampled s = {&b, size};
            fill(hop, size);
            run(&b, hop, order, 41);
            memset(judge, 0, sizeof judge);
            struct readout *r = readout_open(N, order, size, response, &s);
            readout_run(r, force, judge, N);
            readout_close(r);
            ck_assert_msg(apart() < 1e-11, "order %d, hop %d: %g", order, size, apart());
            memcpy(judge, exact, sizeof judge);
            error[size == 4] = apart();
        }
        double step = 20 * log10(error[0] / error[1]);
        ck_assert_msg(fabs(step - 6.02 * order) < 2, "order %d: %g dB", order, step);
    }
}
END_TEST

/* How the sound is cut into calls changes not a bit. */
START_TEST(test_cuts)
{
    static const double hop[MODES] = {1, 2, 8, 16, 64, 128, 512, 4, 2048};
    static double whole[N];
    struct body b = {MODES_VELOCITY, false, false};
    make();
    run(&b, hop, 4, N);
    memcpy(whole, sound, sizeof whole);
    for (int cut = 1; cut < N; cut = 3 * cut + 4) {
        run(&b, hop, 4, cut);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
    }
}
END_TEST

UNIT("readout_modes", test_sum, test_rest, test_hops, test_cuts)
