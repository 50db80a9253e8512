/* The judge is the defining sum in long double, y[n] = (1/rate) sum_{m <= n} h_{x(m)}((n-m)/rate) f[m] with half of
   h(0+) at m = n, h in closed form: O(N^2) per mode, nothing in common with the recursion. */
#include "unit.h"

#include <complex.h>

#include "convolution/resonators.h"

enum { MAX = 64, N = 3000 };
#define RATE 48000.0

struct scene {
    int n, quantity;
    double frequency[MAX], decay[MAX], size[MAX], phase[MAX];
    double re[MAX], im[MAX];
};

static unsigned long long seed;

static double draw(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static struct scene scene_of(int n, double lowest, double highest)
{
    struct scene s = {.n = n, .quantity = MODES_VELOCITY};
    seed = 7;
    for (int i = 0; i < n; i++) {
        s.frequency[i] = lowest * pow(highest / lowest, n > 1 ? i / (n - 1.0) : 0.0);
        s.decay[i] = 2 + 80 * draw();
        s.size[i] = 2 * draw() - 1;
        s.phase[i] = 6 * draw() - 3;
    }
    return s;
}

static struct resonators *bank_of(struct arena *a, const struct scene *s, int ramp)
{
    struct resonators_ask ask = {
        .n = s->n, .quantity = s->quantity, .rate = RATE, .frequency = s->frequency, .decay = s->decay, .ramp = ramp};
    return resonators_make(a, &ask);
}

static struct modes_point point(struct scene *s)
{
    return (struct modes_point){.frequency = s->frequency, .decay = s->decay, .re = s->re, .im = s->im};
}

/* The mode shapes: sin((i + 1) pi x) changes its sign along the way x(n). */
static void gains(const struct scene *s, double n, double *re, double *im)
{
    double x = 0.5 + 0.45 * sin(2 * M_PI * n / 2500.0);
    for (int i = 0; i < s->n; i++) {
        double a = s->size[i] * sin((i % 4 + 1) * M_PI * x);
        re[i] = a * cos(s->phase[i]);
        im[i] = a * sin(s->phase[i]);
    }
}

static void force(double *f, int n)
{
    seed = 99;
    for (int i = 0; i < n; i++)
        f[i] = 2 * draw() - 1;
}

/* gain(n) as a function of the sample; direct: D of acceleration. */
static void brute(const struct scene *s, const double *f, double *y, int n)
{
    static double re[N][MAX], im[N][MAX];
    static long double er[N], ei[N];
    for (int k = 0; k < n; k++) {
        gains(s, k, re[k], im[k]);
        y[k] = 0;
    }
    for (int i = 0; i < s->n; i++) {
        long double complex pole = -s->decay[i] + 2 * acosl(-1.0L) * s->frequency[i] * (long double complex)I;
        for (int k = 0; k < n; k++) {
            long double complex v = cexpl(pole * k / (long double)RATE) / RATE;
            er[k] = creall(v);
            ei[k] = cimagl(v);
        }
        for (int k = 0; k < n; k++) {
            long double sum = im[k][i] * f[k] * er[0] / 2;
            for (int m = 0; m < k; m++)
                sum += (im[m][i] * er[k - m] + re[m][i] * ei[k - m]) * f[m];
            y[k] += (double)sum;
        }
    }
}

/* The bank with gains given every `ramp` samples. */
static void bank(struct scene *s, const double *f, double *y, int n, int ramp)
{
    struct arena *a = arena_open();
    struct resonators *r = bank_of(a, s, ramp);
    struct modes_point to = point(s);
    gains(s, -1, s->re, s->im);
    resonators_set(r, &to);
    memset(y, 0, (size_t)n * sizeof *y);
    for (int at = 0; at < n; at += ramp) {
        int frames = n - at < ramp ? n - at : ramp;
        gains(s, at + frames - 1, s->re, s->im);
        resonators_run(r, f + at, y + at, frames, &to);
    }
    arena_close(a);
}

/* Root-mean-square of the difference, relative to b. */
static double apart(const double *a, const double *b, int n)
{
    double d = 0, s = 0;
    for (int i = 0; i < n; i++) {
        d += (a[i] - b[i]) * (a[i] - b[i]);
        s += b[i] * b[i];
    }
    return sqrt(d / s);
}

static double against_brute(int modes, double lowest, double highest, int ramp)
{
    double faster =
        ramp > 1 ? 30 : 1; /* decays: the more independent the errors of single samples, the steadier their sum */
    static double f[N], y[N], z[N];
    struct scene s = scene_of(modes, lowest, highest);
    for (int i = 0; i < modes; i++)
        s.decay[i] *= faster;
    force(f, N);
    brute(&s, f, z, N);
    bank(&s, f, y, N, ramp);
    return apart(y, z, N);
}

/* Rounding alone: about 1e-16 a step over 3000 steps. */
START_TEST(equals_the_defining_sum)
{
    static const int counts[] = {1, 7, 8, 9, 19};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        double d = against_brute(counts[i], 90, 18000, 1);
        printf("%d modes, gains at every sample: %.2e\n", counts[i], d);
        ck_assert_double_lt(d, 1e-12);
    }
    double near_nyquist = against_brute(3, 0.49 * RATE, 0.4989 * RATE, 1);
    ck_assert_double_lt(near_nyquist, 1e-12);
}
END_TEST

/* Linear between exact gains: error of order ramp^2, 12.04 dB per halving. The noise makes a single step uncertain. */
START_TEST(ramped_gains_converge_at_order_2)
{
    double last = 0, first = 0;
    for (int ramp = 64; ramp >= 4; ramp /= 2) {
        double d = 20 * log10(against_brute(13, 90, 20000, ramp));
        printf("ramp %2d: %.1f dB\n", ramp, d);
        if (ramp == 64)
            first = d;
        else
            ck_assert_double_eq_tol(last - d, 12.04, 1.5);
        last = d;
    }
    ck_assert_double_eq_tol((first - last) / 4, 12.04, 0.5);
}
END_TEST

/* While gains rest, the same samples to the bit, however they are cut; and y is added to. */
START_TEST(cuts_do_not_matter)
{
    static double f[N], y[N], z[N];
    struct scene s = scene_of(51, 60, 20000);
    force(f, N / 8);
    memset(f + N / 8, 0, (N - N / 8) * sizeof *f); /* here modes go to rest */
    for (int i = 0; i < 51; i++)
        s.decay[i] = 200 * (1 + i);
    for (int i = 0; i < N; i++)
        y[i] = z[i] = 0;
    struct arena *a = arena_open();
    struct resonators *p = bank_of(a, &s, 64), *q = bank_of(a, &s, 4096);
    struct modes_point to = point(&s);
    gains(&s, 100, s.re, s.im);
    resonators_set(p, &to);
    resonators_set(q, &to);
    resonators_run(p, f, y, N, &to);
    for (int at = 0, n = 1; at < N; at += n, n = n % 97 + 13)
        resonators_run(q, f + at, z + at, at + n < N ? n : N - at, &to);
    ck_assert(memcmp(y, z, sizeof y) == 0);
    ck_assert_int_lt(resonators_awake(p), 4); /* of 7 groups */
    resonators_run(p, f, y, 0, &to);
    arena_close(a);
}
END_TEST

/* Pole measured from the sound: y[n+1] + c1 y[n] + c2 y[n-1] = 0 solved by least squares. */
START_TEST(frequency_and_decay_are_the_tables)
{
    static double y[N];
    static const double frequency[] = {20, 440, 5000, 0.49 * RATE}, decay[] = {0.5, 6.9, 300, 12};
    for (int k = 0; k < 4; k++) {
        struct scene s = {.n = 1,
                          .quantity = MODES_VELOCITY,
                          .frequency = {frequency[k]},
                          .decay = {decay[k]},
                          .re = {0.3},
                          .im = {0.4}};
        struct arena *a = arena_open();
        struct resonators *r = bank_of(a, &s, 64);
        struct modes_point to = point(&s);
        double f[N] = {1};
        long double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
        resonators_set(r, &to);
        memset(y, 0, sizeof y);
        resonators_run(r, f, y, N, &to);
        for (int n = 2; n < N - 1; n++) {
            long double u = y[n], v = y[n - 1], w = y[n + 1];
            aa += u * u, ab += u * v, bb += v * v, ac += u * w, bc += v * w;
        }
        long double det = aa * bb - ab * ab, c1 = (ac * bb - bc * ab) / det, c2 = (bc * aa - ac * ab) / det;
        double radius = sqrt((double)-c2), found = acos((double)(c1 / 2) / radius) / (2 * M_PI) * RATE,
               rate = -log(radius) * RATE;
        printf("f %.9g -> %.12g, decay %.9g -> %.12g\n", frequency[k], found, decay[k], rate);
        ck_assert_double_lt(fabs(found / frequency[k] - 1), 1e-8);
        ck_assert_double_lt(fabs(rate / decay[k] - 1),
                            1e-6); /* T60 = ln(1000)/decay; the fit, not the bank, is the limit */
        arena_close(a);
    }
}
END_TEST

START_TEST(silence)
{
    static double f[N], y[N];
    struct scene s = scene_of(51, 60, 20000);
    struct arena *a = arena_open();
    for (int i = 0; i < 51; i++)
        s.decay[i] = 8 + i; /* 1e-200 after 58 s at the latest */
    struct resonators *r = bank_of(a, &s, 64);
    struct modes_point to = point(&s);
    ck_assert(resonators_silent(r));
    force(f, N);
    resonators_set(r, &to);
    resonators_run(r, f, y, N, &to); /* gains of zero make no sound */
    for (int i = 0; i < N; i++)
        ck_assert(y[i] == 0.0);
    ck_assert(resonators_silent(r));
    gains(&s, 100, s.re, s.im);
    resonators_set(r, &to);
    resonators_run(r, f, y, N, &to);
    ck_assert(!resonators_silent(r));
    memset(f, 0, sizeof f);
    for (int block = 0; block < 60 * (int)RATE / N; block++) {
        memset(y, 0, sizeof y);
        for (int at = 0; at < N; at += 60)
            resonators_run(r, f + at, y + at, 60, &to);
    }
    for (int i = 0; i < N; i++)
        ck_assert(y[i] == 0.0);
    ck_assert(resonators_silent(r));
    arena_close(a);
}
END_TEST

/* A blow, then no force: groups go to rest one after another, each when its slowest mode has fallen to 1e-22 of the
   loudest and not before, and what is left out is below 1e-20 of the loudest sound: 64 modes, 1e-22 each. The judge is
   the closed form. Modes without gain never wake. */
START_TEST(tails_go_to_rest)
{
    enum { BLOCK = 256 };
    struct scene s = scene_of(64, 100, 20000);
    struct arena *a = arena_open();
    double y[BLOCK], f[BLOCK] = {RATE};
    int fewest = 8;
    for (int i = 0; i < 64; i++) {
        s.decay[i] = 20 * (1 + i / 8); /* 1/s, of each group its own */
        s.re[i] = 0;
        s.im[i] = i / 8 == 6 ? 0 : 1; /* one group has no gain */
    }
    struct resonators *r = bank_of(a, &s, BLOCK);
    struct modes_point to = point(&s);
    resonators_set(r, &to);
    for (int n = 0; n < 3 * (int)RATE; n += BLOCK) {
        memset(y, 0, sizeof y);
        resonators_run(r, f, y, BLOCK, &to);
        f[0] = 0;
        double sum = 0, seconds = (n + BLOCK - 1) / RATE;
        for (int i = 0; i < 64; i++)
            sum += s.im[i] * exp(-s.decay[i] * seconds) * cos(2 * M_PI * s.frequency[i] * seconds);
        ck_assert_double_le(fabs(y[BLOCK - 1] - sum),
                            1e-9 * fabs(exp(-20 * seconds)) + 1e-20); /* phases of the judge are good to 1e-9 */
        int early = 0,
            late = 0; /* half a neper of 50.7: the state's parts, and the loudest is taken at the first block's end */
        for (int k = 0; k < 8; k++) {
            early += k != 6 && 20 * (1 + k) * seconds < log(1e22) - 0.5;
            late += k != 6 && 20 * (1 + k) * (seconds - BLOCK / RATE) < log(1e22) + 0.5;
        }
        ck_assert_int_ge(resonators_awake(r), early);
        ck_assert_int_le(resonators_awake(r), late);
        fewest = resonators_awake(r) < fewest ? resonators_awake(r) : fewest;
    }
    ck_assert_int_eq(fewest, 0);
    arena_close(a);
}
END_TEST

/* No modes at all: no sound. */
START_TEST(no_modes)
{
    struct scene s = {.quantity = MODES_VELOCITY};
    struct arena *a = arena_open();
    struct resonators *r = bank_of(a, &s, 64);
    struct modes_point to = point(&s);
    double f[3] = {1, 2, 3}, y[3] = {4, 5, 6};
    resonators_run(r, f, y, 3, &to);
    ck_assert(y[0] == 4 && y[2] == 6 && resonators_silent(r));
    arena_close(a);
}
END_TEST

/* Acceleration is the derivative of velocity: under a steady force a free-standing mode ends at rest, so the sum of h_a
   and the direct term vanish together. Without the term it is the whole of D f. The trapezium rule leaves
   (omega/rate)^2/12 = 1e-4 of it. */
START_TEST(acceleration_has_its_direct_term)
{
    enum { LONG = 48000 };
    static double f[LONG], y[LONG];
    struct scene s = {.n = 1, .quantity = MODES_ACCELERATION, .frequency = {250}, .decay = {30}};
    struct arena *a = arena_open();
    double omega = 2 * M_PI * 250, velocity = 3.0;
    double complex gain =
        velocity * I * (-30 + I * omega); /* h_v = velocity cos(omega t) e^(-30 t) = Im(velocity j e^(s t)) */
    s.re[0] = creal(gain), s.im[0] = cimag(gain);
    struct modes_point to = point(&s);
    struct resonators *r = bank_of(a, &s, 64);
    ck_assert_double_eq_tol(modes_direct(MODES_ACCELERATION, 1, s.frequency, s.decay, &to), velocity, 1e-12);
    for (int i = 0; i < LONG; i++)
        f[i] = 1;
    resonators_set(r, &to);
    resonators_run(r, f, y, LONG, &to);
    ck_assert_double_lt(fabs(y[LONG - 1]), 2e-4 * velocity);
    ck_assert_double_gt(fabs(y[0]), 0.9 * velocity);
    arena_close(a);
}
END_TEST

/* 0 Hz with phase pi/2: h = e^(-decay t), and without decay the force's integral. */
START_TEST(zero_hertz)
{
    static double f[N], y[N];
    struct scene s = {.n = 2, .quantity = MODES_VELOCITY, .decay = {0, 40}, .im = {1, 0}};
    for (int k = 0; k < 2; k++) {
        struct arena *a = arena_open();
        struct modes_point to = point(&s);
        struct resonators *r = bank_of(a, &s, 64);
        long double sum = 0, fall = expl(-s.decay[k] / (long double)RATE);
        s.im[k] = 1, s.im[1 - k] = 0;
        force(f, N);
        memset(y, 0, sizeof y);
        resonators_set(r, &to);
        resonators_run(r, f, y, N, &to);
        for (int n = 0; n < N; n++) {
            sum = sum * fall + f[n] / RATE;
            ck_assert_double_lt(fabs(y[n] - (double)(sum - f[n] / (2 * RATE))), 1e-15);
        }
        arena_close(a);
    }
}
END_TEST

UNIT("resonators", equals_the_defining_sum, ramped_gains_converge_at_order_2, cuts_do_not_matter,
     frequency_and_decay_are_the_tables, silence, tails_go_to_rest, no_modes, acceleration_has_its_direct_term,
     zero_hertz)
