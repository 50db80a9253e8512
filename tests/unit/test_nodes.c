/* Shares against Lagrange's product in long double; nodes_needed against the error itself, summed up in time and place; and in full use, nodes
   and panned convolution with sampled modes, against the defining sum y[n] = sum_m h_{x(m)}[n - m] f[m]. */
#include "unit.h"

#include <complex.h>

#include "convolution/nodes.h"
#include "convolution/panned.h"

enum { PLACES = 61, MOST = 300 };

static long double product(const struct nodes *n, int first, int count, int k, double u)
{
    long double p = 1;
    for (int j = first; j < first + count; j++)
        if (j != k)
            p *= ((long double)u - nodes_place(n, j)) / ((long double)nodes_place(n, k) - nodes_place(n, j));
    return p;
}

/* Places everywhere, next to nodes and next to the ends. Rounding of a node's place (2^-53 of the length) moves shares by up to that times the
   slope of the polynomial, K^2: allowed 1e-15 K^2. */
START_TEST(shares)
{
    static const int counts[] = {2, 3, 4, 5, 16, 33, 128, 256};
    for (int c = 0; c < 8; c++) {
        struct arena *a = arena_open();
        int count = counts[c], m = 0;
        double breaks[2] = {-0.3, 1.7}, u[8 * MOST], w[8 * MOST], sum[8 * MOST] = {0}, worst = 0;
        struct nodes *n = nodes_make(a, 1, breaks, &count);
        ck_assert_int_eq(nodes_n(n), count);
        for (int k = 0; k < count; k++) {
            u[m++] = nodes_place(n, k) + (k + 1 < count ? 1e-9 : -1e-9);
            u[m++] = -0.3 + 2 * (k + 0.37) / count;
            u[m++] = k < count / 2 ? -0.3 + 1e-12 * k : 1.7 - 1e-12 * k;
            for (int ulp = 1; ulp <= 4; ulp *= 2) /* as near as it can be without being there */
                u[m++] = nodes_place(n, k) + (k + 1 < count ? ulp : -ulp) * 0x1p-53 * fmax(fabs(nodes_place(n, k)), 0x1p-53);
        }
        nodes_locate(n, m, u);
        for (int k = 0; k < count; k++) {
            nodes_share(n, k, w);
            for (int i = 0; i < m; i++) {
                sum[i] += w[i];
                worst = fmax(worst, (double)fabsl(w[i] - product(n, 0, count, k, u[i])));
            }
        }
        for (int i = 0; i < m; i++)
            ck_assert_double_eq_tol(sum[i], 1, 2e-15 * count);
        printf("%d nodes: shares to %.1e\n", count, worst);
        ck_assert_double_le(worst, 1e-15 * count * count);
        arena_close(a);
    }
}
END_TEST

/* To and fro over the nodes by cos, as strokes go, and landing on them: shares are finite and add up to 1. */
START_TEST(to_and_fro)
{
    for (int count = 2; count <= 65; count++) {
        struct arena *a = arena_open();
        double breaks[2] = {0, 0.1}, u[8 * MOST], w[8 * MOST], sum[8 * MOST] = {0};
        struct nodes *n = nodes_make(a, 1, breaks, &count);
        for (int i = 0; i < 8 * MOST; i++)
            u[i] = 0.05 * (1 - cos(2 * M_PI * i / (8 * (count - 1))));
        nodes_locate(n, 8 * MOST, u);
        for (int k = 0; k < count; k++) {
            nodes_share(n, k, w);
            for (int i = 0; i < 8 * MOST; i++)
                sum[i] += w[i];
        }
        for (int i = 0; i < 8 * MOST; i++)
            ck_assert_double_eq_tol(sum[i], 1, 2e-15 * count);
        arena_close(a);
    }
}
END_TEST

/* Exactly 1 and 0 at every node; each node is asked where it has nothing to say; beyond the breaks the end counts. */
START_TEST(at_nodes_and_pieces)
{
    struct arena *a = arena_open();
    static const double breaks[] = {-1, 0.25, 0.3, 7};
    static const int count[] = {5, 2, 12};
    struct nodes *n = nodes_make(a, 3, breaks, count);
    double w[32], u[32];
    ck_assert_int_eq(nodes_n(n), 17);
    ck_assert(nodes_place(n, 0) == -1 && nodes_place(n, 4) == 0.25 && nodes_place(n, 5) == 0.3 && nodes_place(n, 16) == 7);
    for (int k = 0; k < 17; k++) {
        u[k] = nodes_place(n, k);
        ck_assert(k == 0 || u[k] > u[k - 1]);
    }
    nodes_locate(n, 17, u);
    for (int k = 0; k < 17; k++) {
        ck_assert(nodes_share(n, k, w));
        for (int i = 0; i < 17; i++)
            ck_assert(w[i] == (i == k));
    }
    double inside[] = {0.26, 0.28, 3, -0.5, 8, -2};
    nodes_locate(n, 6, inside);
    for (int k = 0; k < 17; k++) {
        nodes_share(n, k, w);
        ck_assert((w[0] != 0) == (k == 4 || k == 5));
        ck_assert((w[2] != 0) == (k >= 5));
        ck_assert((w[3] != 0) == (k <= 4));
        ck_assert(w[4] == (k == 16) && w[5] == (k == 0));
        ck_assert_double_eq_tol(w[2], k < 5 ? 0 : (double)product(n, 5, 12, k, 3), 1e-14);
    }
    nodes_locate(n, 2, inside);
    for (int k = 0; k < 17; k++)
        ck_assert_int_eq(nodes_share(n, k, w), k == 4 || k == 5);
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ how many */

/* One mode: log gain and log decay linear in x, frequency linear; half ranges c nepers, d nepers, a in units of the decay. */
struct mode {
    double a, c, d;
};

static double complex mode_at(const struct mode *m, double x, double tau)
{
    return cexp(m->c * x + I * m->a * tau * x - tau * exp(m->d * x));
}

static double error_of(const struct mode *m, int count)
{
    static double w[MOST][PLACES];
    static double complex h[MOST];
    struct arena *a = arena_open();
    double breaks[2] = {-1, 1}, u[PLACES], wrong = 0, all = 0;
    struct nodes *n = nodes_make(a, 1, breaks, &count);
    for (int i = 0; i < PLACES; i++)
        u[i] = -1 + (2 * i + 1.0) / PLACES;
    nodes_locate(n, PLACES, u);
    for (int k = 0; k < count; k++)
        nodes_share(n, k, w[k]);
    for (double tau = 0.01; tau < 14; tau += 0.02) {
        for (int k = 0; k < count; k++)
            h[k] = mode_at(m, nodes_place(n, k), tau);
        for (int i = 0; i < PLACES; i++) {
            double complex want = mode_at(m, u[i], tau), y = 0;
            for (int k = 0; k < count; k++)
                y += w[k][i] * h[k];
            wrong += pow(cabs(y - want), 2);
            all += pow(cabs(want), 2);
        }
    }
    arena_close(a);
    return sqrt(wrong / all);
}

/* Heard to its end; swing in units of the decay. */
static int count_for(double phase, double change, double error)
{
    return nodes_needed(&(struct nodes_ask){phase, {1, 1}, 1e3, change}, error);
}

/* The error that was asked for is kept (decays that move by 30 % included), and where only the frequency moves not by more than 13 dB plus what one
   node makes. */
START_TEST(needed)
{
    static const double phases[] = {0, 0.1, 0.5, 1.4, 5, 10}, changes[] = {0, 1, 2.3, 6}, errors[] = {1e-2, 1e-3, 1e-4};
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 3; k++) {
                struct mode plain = {phases[i], changes[j] / 2, 0}, decays = {phases[i], changes[j] / 2, 0.3};
                int count = count_for(plain.a, changes[j], errors[k]);
                double made = error_of(&plain, count);
                printf("phase %g change %g error %g: %d nodes, %.1e\n", plain.a, changes[j], errors[k], count, made);
                ck_assert_double_le(made, errors[k]);
                if (j == 0 && i >= 3)
                    ck_assert_double_ge(error_of(&plain, count - 1), errors[k] / 4.5);
                count = nodes_needed(&(struct nodes_ask){plain.a, {exp(-0.3), exp(0.3)}, 1e3, changes[j]}, errors[k]);
                ck_assert_double_le(error_of(&decays, count), errors[k]);
            }
    ck_assert_int_eq(count_for(0, 0, 1e-9), 2);
    ck_assert_int_eq(count_for(1e6, 0, 1e-9), NODES_MOST);
    ck_assert_int_eq(count_for(HUGE_VAL, 0, 1e-9), NODES_MOST);
    ck_assert_int_eq(count_for(1, 1e3, 1e-9), NODES_MOST);
    ck_assert_int_ge(count_for(3, 60, 1e-3), 20);
}
END_TEST

/* ------------------------------------------------------------------ sounds that end */

enum { SLOW = 2000, FRAMES = 2 * SLOW, MANY = 1200 };

/* One mode of 400 Hz on a line of `moves` frames at even speed, of `all` frames of sound: every force sample launches its own. */
struct launched {
    double decay, spread, skew; /* 1/s, ends of the line: share of the frequency; ends of the decay: e^(+- skew) */
    int moves, all;
    const double *force;
};

static double complex pole_at(const struct launched *l, double x)
{
    return cexp((-l->decay * exp(l->skew * x) + 2 * M_PI * 400 * (1 + 0.5 * l->spread * x) * I) / SLOW);
}

static double even_place(const struct launched *l, int m)
{
    return -1 + 2.0 * m / (l->moves - 1);
}

static void every_sample(const struct launched *l, double *y)
{
    memset(y, 0, (size_t)l->all * sizeof *y);
    for (int m = 0; m < l->moves; m++) {
        double complex p = pole_at(l, even_place(l, m)), z = l->force[m];
        for (int n = m; n < l->all; n++, z *= p)
            y[n] += cimag(z);
    }
}

/* Each node rings by itself, the force shared among them. */
static double nodes_error(const struct launched *l, const double *judge, int count)
{
    static double y[FRAMES], w[FRAMES], u[FRAMES];
    struct arena *a = arena_open();
    double breaks[2] = {-1, 1}, wrong = 0, whole = 0;
    struct nodes *n = nodes_make(a, 1, breaks, &count);
    for (int m = 0; m < l->moves; m++)
        u[m] = even_place(l, m);
    nodes_locate(n, l->moves, u);
    memset(y, 0, sizeof y);
    for (int k = 0; k < count; k++) {
        double complex p = pole_at(l, nodes_place(n, k)), z = 0;
        nodes_share(n, k, w);
        for (int m = 0; m < l->all; m++) {
            z = z * p + (m < l->moves ? w[m] * l->force[m] : 0);
            y[m] += cimag(z);
        }
    }
    for (int m = 0; m < l->all; m++) {
        wrong += (y[m] - judge[m]) * (y[m] - judge[m]);
        whole += judge[m] * judge[m];
    }
    arena_close(a);
    return sqrt(wrong / whole);
}

static int launched_needs(const struct launched *l, double error)
{
    return nodes_needed(&(struct nodes_ask){2 * M_PI * 400 * 0.5 * l->spread, {l->decay * exp(-l->skew), l->decay * exp(l->skew)}, (double)l->all / SLOW, 0}, error);
}

/* The least number that keeps the error: it falls with the number of nodes. */
static int least_number(const struct launched *l, const double *judge, double error, int most)
{
    int low = 1, high = most;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        *(nodes_error(l, judge, middle) <= error ? &high : &low) = middle;
    }
    return high;
}

static void draw_force(double *f)
{
    unsigned long long seed = 5;
    for (int n = 0; n < FRAMES; n++) {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        f[n] = (double)(seed >> 11) * 0x1p-52 - 1;
    }
}

/* Modes that ring long after the sound has ended, some, and none, against every force sample's own launch, which takes its place's pole exactly: the
   error asked for is kept. Not more nodes than 1.5 times the least number that does, and five more. */
START_TEST(sounds_end)
{
    static const double decays[] = {0, 0.01, 0.05, 0.2, 2, 20}, spreads[] = {0.01, 0.03}, lengths[][2] = {{0.5, 0.5}, {0.5, 2}, {2, 2}};
    static double f[FRAMES], y[FRAMES];
    draw_force(f);
    for (int c = 0; c < 6 * 3 * 2 * 2; c++) {
        const double *t = lengths[c / 2 % 3];
        struct launched l = {decays[c / 12], spreads[c / 6 % 2], c % 2 ? 0.3 : 0, (int)(t[0] * SLOW), (int)(t[1] * SLOW), f};
        every_sample(&l, y);
        for (int db = 40; db <= 100; db += 30) {
            double asked = pow(10, -db / 20.0);
            int count = launched_needs(&l, asked);
            ck_assert_int_lt(count, MANY);
            double made = nodes_error(&l, y, count);
            int least = least_number(&l, y, asked, count);
            printf("decay %g (%g), %g%%, %g of %g s, -%d dB: %d nodes, %.1f dB; %d would do\n", l.decay, l.skew, 100 * l.spread, t[0], t[1], db, count, 20 * log10(made), least);
            ck_assert_double_le(made, asked);
            ck_assert_double_le(count, 1.5 * least + 5);
        }
    }
}
END_TEST

/* Frequencies stay, decays change by a factor of 7 or 20 along the line, in the logarithm. */
START_TEST(decays_alone)
{
    static const double decays[] = {0.01, 0.05, 0.2, 2}, skews[] = {1, 1.5}, lengths[][2] = {{0.5, 0.5}, {0.5, 2}};
    static double f[FRAMES], y[FRAMES];
    draw_force(f);
    for (int c = 0; c < 4 * 2 * 2; c++) {
        struct launched l = {decays[c / 4], 0, skews[c / 2 % 2], (int)(lengths[c % 2][0] * SLOW), (int)(lengths[c % 2][1] * SLOW), f};
        every_sample(&l, y);
        for (int db = 40; db <= 100; db += 30) {
            int count = launched_needs(&l, pow(10, -db / 20.0));
            double made = 20 * log10(nodes_error(&l, y, count));
            ck_assert_msg(made <= -db && count <= 25, "decay %g (%g), %d frames, -%d dB: %d nodes, %.1f dB", l.decay, l.skew, l.all, db, count, made);
        }
    }
}
END_TEST

/* ------------------------------------------------------------------ in full use */

enum { N = 6000, LENGTH = 2400, MODES = 8, ROOM = N + LENGTH + PANNED_BLOCK };
#define RATE 48000.0

static double force[ROOM], sound[ROOM], judge[ROOM], place[ROOM];

/* Poles and gains along u in [0, 1], a bend at 0.4. */
static void response_at(double u, double *h, size_t length)
{
    double x = u < 0.4 ? u : 0.4 - 0.7 * (u - 0.4);
    memset(h, 0, length * sizeof *h);
    for (int i = 0; i < MODES; i++) {
        double f = 300 * pow(1.8, i) * (1 + (i % 2 ? -0.02 : 0.02) * x), sigma = (60 + 25 * i) * exp((i % 3 - 1) * 0.5 * x);
        double complex p = cexp((-sigma + 2 * M_PI * f * I) / RATE), z = exp((i % 4 - 1.5) * x) * cexp(0.7 * i * I) / RATE;
        for (size_t n = 0; n < length; n++, z *= p)
            h[n] += (n ? 1 : 0.5) * cimag(z);
    }
}

static void response(void *self, int k, double *h, size_t length)
{
    response_at(nodes_place(self, k), h, length);
}

static int share(void *self, long first, int n, int k, double *w)
{
    nodes_locate(self, n, place + first);
    return nodes_share(self, k, w);
}

static double apart(const int *count)
{
    static const double breaks[] = {0, 0.4, 1};
    struct arena *a = arena_open();
    struct nodes *n = nodes_make(a, 2, breaks, count);
    struct panned *p = panned_open(&(struct panned_source){nodes_n(n), LENGTH, share, response, n});
    double wrong = 0, all = 0;
    memset(sound, 0, sizeof sound);
    panned_run(p, force, sound, N + LENGTH);
    for (int i = 0; i < N + LENGTH; i++) {
        wrong += (sound[i] - judge[i]) * (sound[i] - judge[i]);
        all += judge[i] * judge[i];
    }
    panned_close(p);
    arena_close(a);
    return 10 * log10(wrong / all + 1e-40);
}

/* To and fro over both pieces. Each node more wins a fixed number of dB, down to rounding: spectral convergence. Measured: 35 dB or more for 8. */
START_TEST(convergence)
{
    static double h[LENGTH];
    static const int counts[][2] = {{8, 8}, {16, 16}, {24, 24}, {32, 32}, {40, 40}, {48, 48}};
    unsigned long long seed = 3;
    for (int n = 0; n < ROOM; n++) {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        force[n] = n < N ? (double)(seed >> 11) * 0x1p-52 - 1 : 0;
        place[n] = 0.5 - 0.5 * cos(2 * M_PI * n / 4100.0);
    }
    for (int m = 0; m < N; m++) {
        response_at(place[m], h, LENGTH);
        for (int i = 0; i < LENGTH; i++)
            judge[m + i] += h[i] * force[m];
    }
    double last = 0;
    for (int c = 0; c < 6; c++) {
        double d = apart(counts[c]);
        printf("%d + %d nodes: %.1f dB\n", counts[c][0], counts[c][1], d);
        ck_assert_double_le(d, fmax(last - 30, -240));
        last = d;
    }
    ck_assert_double_le(last, -200);
}
END_TEST

UNIT("nodes", shares, to_and_fro, at_nodes_and_pieces, needed, sounds_end, decays_alone, convergence)
