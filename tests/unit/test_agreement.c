/* Until when a sound follows another: differences that grow as exp(t), whose instant is known; what is no divergence.
 */
#include "analysis/distance.h"
#include "unit.h"

enum { RATE = 8000, N = 16000, CHANNELS = 2 };

static double a_x[N * CHANNELS], b_x[N * CHANNELS];

static struct wav a_of(double *x, size_t frames)
{
    return (struct wav){.rate = RATE, .channels = CHANNELS, .frames = frames, .x = x};
}

static double run(void)
{
    struct wav a = a_of(a_x, N), b = a_of(b_x, N);
    return (double)distance_agreement(&a, &b) / RATE;
}

/* A tone of rms 1, and one of the same power at another frequency, by which it differs. */
static void make(double (*size)(double t))
{
    for (int i = 0; i < N; i++)
        for (int c = 0; c < CHANNELS; c++) {
            double t = (double)i / RATE;
            a_x[i * CHANNELS + c] = sqrt(2) * sin(2 * acos(-1) * 400 * t);
            b_x[i * CHANNELS + c] = a_x[i * CHANNELS + c] + size(t) * sqrt(2) * sin(2 * acos(-1) * 300 * t + c);
        }
}

static double growing(double t) { return fmin(1e-9 * exp(20 * t), 1.4); /* reaches 1/2 at log(0.5e9)/20 = 1.0015 s */ }

static double glitch(double t) { return t > 0.5 && t < 0.52 ? 3 : 1e-5; }

static double nothing(double t)
{
    (void)t;
    return 0;
}

static double always(double t)
{
    (void)t;
    return 0.6;
}

START_TEST(instants)
{
    make(growing);
    ck_assert_double_eq_tol(run(), log(0.5e9) / 20, AGREEMENT_WINDOW);
    make(nothing);
    ck_assert_double_eq(run(), (double)N / RATE);
    make(glitch);
    ck_assert_double_eq(run(), (double)N / RATE);
    make(always);
    ck_assert_double_eq(run(), 0);
}
END_TEST

/* Where the sound has a gap the difference may be the larger. */
START_TEST(gaps)
{
    make(nothing);
    for (int i = 0; i < N * CHANNELS; i++) {
        if (i > N && i < N + 400) a_x[i] = 0;
        b_x[i] = a_x[i] + 1e-3;
    }
    ck_assert_double_eq(run(), (double)N / RATE);
}
END_TEST

START_TEST(lengths)
{
    struct wav a = a_of(a_x, N), b = a_of(b_x, N / 2 + 3);
    make(nothing);
    ck_assert_uint_eq(distance_agreement(&a, &b), N / 2 + 3);
}
END_TEST

UNIT("agreement", instants, gaps, lengths)
