/* Two judges, both sums over every pair of force sample and later frame, of responses in closed form: the definition,
   where every sample has the response of its own place (`brute`), and what cubic interpolation between nodes makes of
   it (`windowed`). Neither has anything in common with blocks, pools or clusters. */
#include "unit.h"

#include <complex.h>

#include "convolution/launch.h"
#include "convolution/resonators.h"
#include "hop.h"

enum { MAX = 16, N = 2048, TAIL = 2048, ALL = N + TAIL };
#define RATE 44100.0

/* Along x(n) = n/N poles move evenly, gains with a bend. */
struct body {
    int n, quantity, hop, asked;
    double frequency[MAX], decay[MAX], tune[MAX], damp[MAX]; /* Hz, 1/s; their changes over N frames */
    double complex gain[MAX], swell[MAX];
    double floor;
};

static double force[ALL], sound[ALL], judge[ALL];
static unsigned long long seed;

static double draw(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* Frequencies from 200 Hz to 16 kHz. shift: relative change of frequency and decay; swell: of gain. */
static struct body body_of(int n, double decay, double shift, double swell)
{
    struct body b = {.n = n, .quantity = MODES_VELOCITY, .hop = 256};
    seed = 11;
    for (int i = 0; i < n; i++) {
        b.frequency[i] = 200 * pow(80, n > 1 ? i / (n - 1.0) : 0);
        b.decay[i] = decay * (1 + draw());
        b.tune[i] = shift * b.frequency[i] * (2 * draw() - 1);
        b.damp[i] = shift * b.decay[i] * (2 * draw() - 1);
        b.gain[i] = cexp(I * 6 * draw());
        b.swell[i] = swell * cexp(I * 6 * draw());
    }
    memset(force, 0, sizeof force);
    for (int k = 0; k < N; k++)
        force[k] = 2 * draw() - 1;
    return b;
}

static double complex pole_at(const struct body *b, int i, double n)
{
    return -(b->decay[i] + b->damp[i] * n / N) + 2 * M_PI * I * (b->frequency[i] + b->tune[i] * n / N);
}

static double complex gain_at(const struct body *b, int i, double n)
{
    double x = n / N;
    return b->gain[i] + b->swell[i] * (x - x * x / 3);
}

static void point(void *self, double frame, const struct modes_point *p)
{
    struct body *b = self;
    b->asked++;
    for (int i = 0; i < b->n; i++) {
        p->frequency[i] = cimag(pole_at(b, i, frame)) / (2 * M_PI);
        p->decay[i] = -creal(pole_at(b, i, frame));
        p->re[i] = creal(gain_at(b, i, frame));
        p->im[i] = cimag(gain_at(b, i, frame));
    }
}

/* The response of f newtons at frame m, pole and gain those of frame `at`. */
static void one(const struct body *b, int i, double at, int m, double f)
{
    double complex s = pole_at(b, i, at), p = cexp(s / RATE), z = gain_at(b, i, at) / RATE * f;
    double direct = b->quantity == MODES_ACCELERATION ? cimag(gain_at(b, i, at) / s) : 0;
    judge[m] += direct * f - 0.5 * cimag(z);
    for (int n = m; n < ALL; n++) {
        judge[n] += cimag(z);
        z *= p;
    }
}

static void brute(const struct body *b)
{
    memset(judge, 0, sizeof judge);
    for (int i = 0; i < b->n; i++)
        for (int m = 0; m < N; m++)
            one(b, i, m, m, force[m]);
}

/* Of u = n/hop - k. */
static double window(double u)
{
    u = fabs(u);
    return u <= 1 ? (1 - u * u) * (2 - u) / 2 : u < 2 ? (1 - u) * (2 - u) * (3 - u) / 6 : 0;
}

static void windowed(const struct body *b)
{
    memset(judge, 0, sizeof judge);
    for (int i = 0; i < b->n; i++)
        for (long k = -1; (k - 2) * b->hop < N; k++)
            for (long m = k < 2 ? 0 : (k - 2) * b->hop; m < N && m < (k + 2) * b->hop; m++) {
                double w = window((double)m / b->hop - (double)k);
                if (w * force[m] != 0) one(b, i, (double)(k * b->hop), (int)m, w * force[m]);
            }
}

static struct launch *open_body(struct body *b)
{
    struct launch_ask ask = {.n = b->n, .rate = RATE, .hop = b->hop, .floor = b->floor, .quantity = b->quantity};
    b->asked = 0;
    return launch_open(&ask, point, b);
}

/* cut 0: pieces of changing length. */
static void run(struct body *b, int cut)
{
    struct launch *l = open_body(b);
    memset(sound, 0, sizeof sound);
    for (int at = 0, n = cut ? cut : 1; at < ALL; at += n, n = cut ? cut : n % 97 + 13)
        launch_run(l, force + at, sound + at, at + n < ALL ? n : ALL - at);
    launch_close(l);
}

/* Root-mean-square of the difference, relative to the judge. */
static double apart(void)
{
    double d = 0, s = 0;
    for (int i = 0; i < ALL; i++) {
        d += (sound[i] - judge[i]) * (sound[i] - judge[i]);
        s += judge[i] * judge[i];
    }
    return sqrt(d / s);
}

/* Clusters leave 1e-11 of a node at most, mostly much less; the judge's own products add up to 1e-12. Hops shorter than
   a block, of a few frames, of a prime number of them, and longer than the sound are among them. */
START_TEST(equals_the_windowed_sum)
{
    static const int hops[] = {1, 2, 5, 64, 97, 300, 1016, 1024, 8192};
    for (size_t k = 0; k < sizeof hops / sizeof hops[0]; k++) {
        struct body b = body_of(5, 60, hops[k] < 2000 ? 0.2 : 0.02, 0.9);
        b.quantity = k % 2 ? MODES_ACCELERATION : MODES_VELOCITY;
        b.hop = hops[k];
        windowed(&b);
        run(&b, 1000);
        printf("hop %d: %.1e\n", b.hop, apart());
        ck_assert_double_lt(apart(), 3e-12);
    }
}
END_TEST

/* A node at every frame: the definition itself. */
START_TEST(hop_of_one_frame_is_exact)
{
    struct body b = body_of(5, 60, 0.2, 0.9);
    brute(&b);
    b.hop = 1;
    run(&b, 1000);
    printf("%.1e\n", apart());
    ck_assert_double_lt(apart(), 3e-12);
}
END_TEST

/* ------------------------------------------------------------------ the error of hops */

/* Every pole moves by `turns` half bandwidths over the N frames, some up, some down, and nothing else does: rho = turns
   hop/N. Frequencies lie far enough apart for the modes' energies to add. */
static struct body evenly(double turns)
{
    struct body b = body_of(12, 250, 0, 0);
    for (int i = 0; i < b.n; i++) {
        b.frequency[i] = 1500 + 1600 * i;
        b.tune[i] = (i % 2 ? 1 : -1) * turns * b.decay[i] / (2 * M_PI);
    }
    return b;
}

enum { DRAWS = 4, HOPS = 5 };

/* Errors relative to the definition in dB, of hops 512, 256 .. 32, over several noises. */
static void measure(double turns, double db[HOPS])
{
    double error[HOPS] = {0};
    struct body b = evenly(turns);
    for (int d = 0; d < DRAWS; d++) {
        for (int k = 0; k < N; k++)
            force[k] = 2 * draw() - 1;
        brute(&b);
        for (int h = 0; h < HOPS; h++) {
            b.hop = 512 >> h;
            run(&b, 999);
            error[h] += apart() * apart() / DRAWS;
        }
    }
    for (int h = 0; h < HOPS; h++)
        db[h] = 10 * log10(error[h]);
}

/* 24.08 dB less per halving, and where hop.h says; the noises leave some tenths of a dB. */
START_TEST(error_is_as_predicted)
{
    double db[HOPS], turns = 1.4;
    measure(turns, db);
    for (int h = 0; h < HOPS; h++) {
        double rho = turns * (512 >> h) / N, predicted = 20 * log10(hop_error(4, rho)),
               step = h ? db[h - 1] - db[h] : 0;
        printf("hop %3d, rho %.3f: predicted %6.1f dB, measured %6.1f, %.2f from twice the hop\n", 512 >> h, rho,
               predicted, db[h], step);
        fflush(stdout);
        ck_assert_double_lt(fabs(db[h] - predicted), 2);
        if (h > 1) /* rho below 0.1 */
            ck_assert_double_eq_tol(step, 24.082, 1);
    }
}
END_TEST

/* What is dropped is below the floor: the error grows with it and stays under it. */
START_TEST(floor_bounds_what_is_dropped)
{
    for (int moves = 0; moves < 2; moves++) {
        struct body b = body_of(12, 600, 0.02 * moves, 0.5);
        b.floor = 0;
        run(&b, 999);
        memcpy(judge, sound, sizeof judge);
        for (int db = -120; db <= -40; db += 20) {
            b.floor = pow(10, db / 20.0);
            run(&b, 999);
            double error = 20 * log10(apart());
            printf("floor %d dB, poles %s: %.1f dB\n", db, moves ? "move" : "rest", error);
            ck_assert_double_lt(error, db);
            if (moves) ck_assert_double_gt(error, db - 80);
        }
    }
}
END_TEST

/* ------------------------------------------------------------------ poles at rest */

/* The bank of resonators of test_resonators.c, equal to rounding whatever the hops are. With modes near 0 Hz and near
   rate/2, without decay, at 0 Hz, of acceleration. */
START_TEST(poles_at_rest_equal_resonators)
{
    static const int hops[] = {1, 7, 64, 1000, 8192};
    for (int quantity = MODES_VELOCITY; quantity <= MODES_ACCELERATION; quantity++)
        for (int k = 0; k < 5; k++) {
            struct body b = body_of(11, 30, 0, 0);
            b.quantity = quantity;
            if (quantity == MODES_VELOCITY) {          /* of acceleration their direct terms drown all else */
                b.frequency[1] = 0, b.gain[1] = 2 * I; /* phase pi/2 */
                b.frequency[2] = 1e-3;
            }
            b.decay[3] = 0;
            b.frequency[4] = 0.4999 * RATE, b.decay[4] = 1;
            b.hop = hops[k];
            run(&b, 0);
            struct arena *a = arena_open();
            struct modes_point p = {ARENA_TAKE(a, double, b.n), ARENA_TAKE(a, double, b.n), ARENA_TAKE(a, double, b.n),
                                    ARENA_TAKE(a, double, b.n)};
            point(&b, 0, &p);
            struct resonators *r = resonators_make(a, &(struct resonators_ask){.n = b.n,
                                                                               .quantity = quantity,
                                                                               .rate = RATE,
                                                                               .frequency = p.frequency,
                                                                               .decay = p.decay,
                                                                               .ramp = 64});
            resonators_set(r, &p);
            memset(judge, 0, sizeof judge);
            resonators_run(r, force, judge, ALL, &p);
            printf("quantity %d, hop %d: %.1e\n", quantity, b.hop, apart());
            ck_assert_double_lt(apart(), 1e-12);
            arena_close(a);
        }
}
END_TEST

/* Without decay, moving, up to 0.49 rate: the error is hop.h's with sigma = rate/ALL, as if all died away within the
 * time of the sums. */
START_TEST(undamped_and_high_modes_move)
{
    struct body b = body_of(4, 0, 0.001, 0.9);
    b.frequency[2] = 0.487 * RATE, b.tune[2] = 0.003 * RATE;
    double rho = 0;
    b.hop = 8;
    for (int i = 0; i < b.n; i++)
        rho = fmax(rho, 2 * M_PI * fabs(b.tune[i]) * b.hop / N / (RATE / ALL));
    brute(&b);
    run(&b, 0);
    printf("rho %.2f: %.1f dB\n", rho, 20 * log10(apart()));
    ck_assert_double_lt(apart(), hop_error(4, rho));
}
END_TEST

/* ------------------------------------------------------------------ calls, silence */

START_TEST(cuts_do_not_matter)
{
    static double whole[ALL];
    static const int hops[] = {24, 64, 184, 256};
    for (int k = 0; k < 4; k++) {
        struct body b = body_of(9, 60, 0.05, 0.9);
        b.floor = 1e-3;
        b.hop = hops[k];
        memset(force + 300, 0, 900 * sizeof *force);
        run(&b, ALL);
        memcpy(whole, sound, sizeof whole);
        run(&b, 0);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
        run(&b, 1);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
        struct launch *l = open_body(&b); /* adds */
        launch_run(l, force, sound, ALL);
        for (int n = 0; n < ALL; n++)
            ck_assert(sound[n] == 2 * whole[n]);
        launch_close(l);
    }
}
END_TEST

START_TEST(silence)
{
    struct body b = body_of(9, 60, 0.05, 0.9);
    struct launch *l = open_body(&b);
    memset(sound, 0, sizeof sound);
    launch_run(l, sound, sound, ALL);
    ck_assert_int_eq(b.asked, 0);
    ck_assert_int_eq(launch_active(l), 0);
    launch_run(l, force, sound, ALL);
    ck_assert_int_gt(b.asked, 0);
    ck_assert_int_gt(launch_active(l), 50);
    memset(force, 0, sizeof force);
    int asked = b.asked, blocks = 0;
    for (; launch_active(l) > 0 && blocks < 400;
         blocks++) { /* 1e-200 after 460 nepers: 7.7 s at the latest, 165 blocks */
        memset(sound, 0, sizeof sound);
        launch_run(l, force, sound, ALL / 2);
    }
    printf("silent after %.1f s\n", blocks * (ALL / 2) / RATE);
    ck_assert_int_lt(blocks, 190);
    ck_assert_int_le(b.asked, asked + 1);
    memset(sound, 0, sizeof sound);
    launch_run(l, force, sound, ALL);
    for (int n = 0; n < ALL; n++)
        ck_assert(sound[n] == 0);
    launch_close(l);
}
END_TEST

START_TEST(no_components)
{
    struct body b = {.hop = 64};
    struct launch *l = open_body(&b);
    double f[3] = {1, 2, 3}, y[3] = {4, 5, 6};
    launch_run(l, f, y, 3);
    ck_assert(y[0] == 4 && y[2] == 6 && launch_active(l) == 0 && b.asked == 0);
    launch_close(l);
}
END_TEST

UNIT("launch", equals_the_windowed_sum, hop_of_one_frame_is_exact, error_is_as_predicted, floor_bounds_what_is_dropped,
     poles_at_rest_equal_resonators, undamped_and_high_modes_move, cuts_do_not_matter, silence, no_components)
