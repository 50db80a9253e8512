/* gammatone_bank: the recursion against the gammatone's own formula in long double, sample by sample, and against the
 * defining sum under gains that move. */
#include "unit.h"

#include "convolution/gammatone.h"

enum { MODES = 11, N = 6000, FORCE = 700 };
#define RATE 48000.0

static double frequency[MODES], decay[MODES], size[MODES], phase[MODES];

static void modes(void)
{
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 55 * pow(1.7, i);
        decay[i] = 20 + 31.0 * i;
        size[i] = (i % 3 - 1.2) * (1 + 0.1 * i);
        phase[i] = 0.7 * i - 2;
    }
}

/* (t/t_p)^(gamma-1) e^((gamma-1) - t/tau) |A| sin(2 pi f t + phase) */
static long double tone(int i, int gamma, long double t)
{
    long double tau = 1 / (long double)decay[i], peak = (gamma - 1) * tau;
    return powl(t / peak, gamma - 1) * expl((gamma - 1) - t / tau) * size[i] *
           sinl(2 * M_PIl * frequency[i] * t + phase[i]);
}

static struct modes_point gains(double share, double *re, double *im, int gamma)
{
    struct modes_point p = {.re = re, .im = im};
    for (int i = 0; i < MODES; i++) {
        re[i] = share * size[i] * cos(phase[i]);
        im[i] = share * size[i] * sin(phase[i]);
    }
    gammatone_gains(gamma, MODES, decay, &p);
    return p;
}

static struct gammatone_bank *bank_of(struct arena *a, int gamma)
{
    struct gammatone_bank_ask ask = {.n = MODES, .gamma = gamma, .rate = RATE, .frequency = frequency, .decay = decay};
    return gammatone_bank_make(a, &ask);
}

/* 1e-11 of the sum of |A|: rounding of p alone makes 1e-16 a sample of what rings. */
START_TEST(impulse_response)
{
    static double f[N] = {1}, y[N];
    modes();
    for (int gamma = 2; gamma <= GAMMATONE_MOST; gamma++) {
        struct arena *a = arena_open();
        double re[MODES], im[MODES], worst = 0, whole = 0, most = 0;
        struct modes_point p = gains(1, re, im, gamma);
        struct gammatone_bank *g = bank_of(a, gamma);
        gammatone_bank_set(g, &p);
        memset(y, 0, sizeof y);
        for (int at = 0; at < N; at += 100)
            gammatone_bank_run(g, f + at, y + at, 100, &p);
        for (int i = 0; i < MODES; i++)
            whole += fabs(size[i]);
        for (int n = 0; n < N; n++) {
            long double want = 0;
            for (int i = 0; i < MODES; i++)
                want += tone(i, gamma, n / (long double)RATE);
            worst = fmax(worst, fabs(y[n] * RATE - (double)want));
            most = fmax(most, fabs((double)want));
        }
        printf("gamma %d: off by %.2e of the sum of gains\n", gamma, worst / whole);
        ck_assert_double_le(worst, 1e-11 * whole);
        ck_assert_double_gt(most, 0.1 * whole);
        arena_close(a);
    }
}
END_TEST

/* Each mode alone rises to |A|: at most it, and, its sine being fast, nearly. */
START_TEST(greatest_value)
{
    modes();
    for (int gamma = 2; gamma <= GAMMATONE_MOST; gamma++)
        for (int i = 4; i < MODES; i++) {
            double most = 0;
            for (int n = 0; n < N; n++)
                most = fmax(most, fabs((double)tone(i, gamma, n / (long double)RATE)));
            ck_assert_double_le(most, fabs(size[i]) * (1 + 1e-12));
            ck_assert_double_ge(most, fabs(size[i]) * 0.9);
        }
}
END_TEST

/* Gains that change sign on the way go in with the force: y(n) = (1/rate) sum_m share(m) f(m) h(n - m), straight lines
 * between calls. */
START_TEST(gains_that_move)
{
    static double f[N], y[N];
    enum { RAMP = 50, LAST = 1500 };
    modes();
    srand48(3);
    for (int n = 0; n < FORCE; n++)
        f[n] = 2 * drand48() - 1;
    for (int gamma = 2; gamma <= GAMMATONE_MOST; gamma++) {
        struct arena *a = arena_open();
        double re[MODES], im[MODES], worst = 0, most = 0;
        struct modes_point p = gains(cos(0.004 * -1), re, im, gamma);
        struct gammatone_bank *g = bank_of(a, gamma);
        gammatone_bank_set(g, &p);
        memset(y, 0, sizeof y);
        for (int at = 0; at < LAST; at += RAMP) {
            gains(cos(0.004 * (at + RAMP - 1)), re, im, gamma);
            gammatone_bank_run(g, f + at, y + at, RAMP, &p);
        }
        for (int n = 0; n < LAST; n += 7) {
            long double want = 0;
            for (int m = 0; m <= n && m < FORCE; m++) {
                int at = m / RAMP * RAMP;
                double part = (m - at + 1.0) / RAMP,
                       share = (1 - part) * cos(0.004 * (at - 1)) + part * cos(0.004 * (at + RAMP - 1));
                for (int i = 0; i < MODES; i++)
                    want += share * f[m] * tone(i, gamma, (n - m) / (long double)RATE);
            }
            worst = fmax(worst, fabs(y[n] * RATE - (double)want));
            most = fmax(most, fabs((double)want));
        }
        printf("gamma %d, gains that move: off by %.2e\n", gamma, worst / most);
        ck_assert_double_le(worst, 1e-11 * most);
        arena_close(a);
    }
}
END_TEST

/* The time to fall, and back; of the slope's tail. */
START_TEST(falls)
{
    for (int gamma = 1; gamma <= GAMMATONE_MOST; gamma++)
        for (double db = 1; db < 400; db *= 3) {
            double x = gammatone_decibel(gamma, db) * log(10) / 20, m = gamma - 1,
                   level = gamma > 1 ? m * log(x / m) + m - x : -x;
            ck_assert_double_eq_tol(20 / log(10) * level, -db, 1e-9 * db);
            ck_assert_double_ge(x, m);
            ck_assert_double_eq_tol(gammatone_fallen(gamma, gammatone_decibel(gamma, db)), db, 1e-9 * db);
        }
}
END_TEST

/* Nothing subnormal, and silence in the end. */
START_TEST(falls_silent)
{
    static double f[N] = {1}, y[N];
    struct arena *a = arena_open();
    double re[MODES], im[MODES];
    modes();
    struct modes_point p = gains(1, re, im, 4);
    struct gammatone_bank *g = bank_of(a, 4);
    gammatone_bank_set(g, &p);
    ck_assert(gammatone_bank_silent(g));
    gammatone_bank_run(g, f, y, N, &p);
    ck_assert(!gammatone_bank_silent(g));
    memset(f, 0, sizeof f);
    int calls = 0;
    for (; calls < 1000 && !gammatone_bank_silent(g); calls++)
        gammatone_bank_run(g, f, y, N, &p);
    ck_assert_int_lt(calls, 400); /* 460 nepers at 20/s, 48 000 samples a second */
    arena_close(a);
}
END_TEST

UNIT("gammatone_bank", impulse_response, greatest_value, gains_that_move, falls, falls_silent)
