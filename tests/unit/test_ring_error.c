/* The error of interpolation as it is predicted, against its definition summed over every frame of motions that are not at constant speed, against
   hop.h where one is, and hops chosen from it. */
#include "convolution/ring_error.h"

#include <complex.h>

#include "convolution/ring_hops.h"
#include "hop.h"
#include "num/real.h"
#include "unit.h"

enum { RATE = 8000 };

struct body { /* at x = 0 and x = 0.1 m; between them in the logarithm, like y */
    double f[2], d[2], g[2], phase[2];
};

static double body_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    const struct body *b = m->self;
    double u = (where->x + where->y) / 0.1, turn = b->phase[0] + u * (b->phase[1] - b->phase[0]), size = b->g[0] * pow(b->g[1] / b->g[0], u);
    p->frequency[0] = b->f[0] * pow(b->f[1] / b->f[0], u);
    p->decay[0] = b->d[0] * pow(b->d[1] / b->d[0], u);
    p->re[0] = size * cos(turn);
    p->im[0] = size * sin(turn);
    return 0;
}

/* The review's single modes that move but little. */
static const struct body bodies[] = {
    {{1000, 1000}, {50, 50}, {0.8, 0.88}, {0.2, 0.2}}, {{1000, 1000}, {50, 50}, {0.8, 2.4}, {0.2, 0.2}}, {{1000, 1000.7}, {50, 50}, {0.8, 0.8}, {0.2, 0.2}},
    {{1000, 1000}, {50, 50.5}, {0.8, 0.8}, {0.2, 0.2}}, {{1000, 1000}, {50, 50}, {0.8, 0.8}, {0.2, 0.9}}, {{1000, 1020}, {50, 60}, {0.8, 1.6}, {0.2, 0.5}},
};
static const struct motion motions[] = {
    {.path = PATH_BACK_AND_FORTH, .to = {0.1, 0}, .rate = 2, .speed = NAN, .duration = 1},
    {.path = PATH_BACK_AND_FORTH, .to = {0.1, 0}, .rate = 20, .speed = NAN, .duration = 1},
    {.path = PATH_LINE, .to = {0.1, 0}, .rate = NAN, .speed = NAN, .duration = 1, .law = SPEED_MINIMUM_JERK},
    {.path = PATH_CIRCLE, .center = {0.05, 0}, .radius = 0.04, .turns = 3, .rate = NAN, .speed = NAN, .duration = 1},
};

static struct ring_survey survey_of(const struct body *b, const struct motion *motion, struct arena *a, enum ring_error_kind kind)
{
    static double one[1] = {1};
    struct trajectory *tr = ARENA_TAKE(a, struct trajectory, 1);
    struct modes *m = ARENA_TAKE(a, struct modes, 1);
    struct err e = {0};
    struct ring_survey s;
    bool stays = kind == RING_ERROR_READOUT || kind == RING_ERROR_GLIDE;
    *m = (struct modes){.n = 1, .moves = true, .frequency = one, .decay = one, .slowest = one, .at = body_at, .self = b};
    ck_assert_msg(trajectory_make(motion, 1, a, tr, &e), "%s", e.text);
    ring_survey(&(struct ring_survey_ask){m, tr, false, stays, kind == RING_ERROR_GLIDE}, a, &s);
    return s;
}

static double complex exponent(const struct modes_point *p)
{
    return -p->decay[0] + 2 * M_PI * I * p->frequency[0];
}

/* Lagrange's weights of frame n over nodes at multiples of the hop; *first: the number of the first. */
static void lagrange(int order, int hop, int n, double *w, int *first)
{
    int node = order == 1 ? (int)floor((n + 0.5 * hop) / hop) : n / hop;
    double u = (double)n / hop - node;
    *first = order == 4 ? node - 1 : node;
    for (int j = 0; j < order; j++) {
        w[j] = 1;
        for (int i = 0; i < order; i++)
            w[j] *= i == j ? 1 : (u - (i + *first - node)) / (double)(j - i);
    }
}

/* Every third frame of the motion; over tau by the sum over pairs in long double. */
static double brute(const struct ring_survey *s, int order, int hop)
{
    struct arena *a = arena_open();
    struct modes_point p = modes_point_make(a, 1);
    long double wrong = 0, whole = 0;
    for (int n = 0; n < (int)(s->duration * RATE); n += 3) {
        double w[4];
        long double complex c[5], e[5];
        int first;
        lagrange(order, hop, n, w, &first);
        for (int j = 0; j <= order; j++) {
            ring_along_at(&s->along, (j < order ? (double)(first + j) * hop : n) / RATE, &p);
            c[j] = (j < order ? (long double)w[j] : -1) * ((long double)p.re[0] + I * (long double)p.im[0]);
            e[j] = exponent(&p);
        }
        for (int j = 0; j <= order; j++)
            for (int k = 0; k <= order; k++)
                wrong += creall(c[j] * conjl(c[k]) / -(e[j] + conjl(e[k])));
        whole += creall(c[order] * conjl(c[order]) / -(e[order] + conjl(e[order])));
    }
    arena_close(a);
    return (double)(10 * log10l(wrong / whole));
}

static double drawn(const struct ring_survey *s, enum ring_error_kind kind, int order, int hop)
{
    struct ring_error_ask ask = {.kind = kind, .order = order, .hop = hop, .rate = RATE, .until = HUGE_VAL, .end = HUGE_VAL};
    return 20 * log10(ring_error_all(s, &ask));
}

/* Hops from far below to far above the motion's period. 512 instants leave up to 1 dB; what lies below -150 dB long double's pairs do not tell. */
START_TEST(test_motions)
{
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 4; j++) {
            struct arena *a = arena_open();
            struct ring_survey s = survey_of(&bodies[i], &motions[j], a, RING_ERROR_LAUNCH);
            for (int order = 1; order <= 4; order *= 2)
                for (int hop = 4; hop <= 4096; hop *= 4) {
                    double judge = brute(&s, order, hop), own = drawn(&s, RING_ERROR_LAUNCH, order, hop);
                    if (judge > -150)
                        ck_assert_msg(fabs(own - judge) < 1, "body %d, motion %d, order %d, hop %d: %g dB, summed %g", i, j, order, hop, own, judge);
                }
            arena_close(a);
        }
}
END_TEST

/* As brute, but what is launched at frame n is heard until frame `last` only, summed up frame by frame. */
static double brute_until(const struct ring_survey *s, int order, int hop, int last)
{
    struct arena *a = arena_open();
    struct modes_point p = modes_point_make(a, 1);
    double wrong = 0, whole = 0;
    for (int n = 0; n < (int)(s->duration * RATE); n += 53) {
        double w[4];
        double complex c[5], q[5];
        int first;
        lagrange(order, hop, n, w, &first);
        for (int j = 0; j <= order; j++) {
            ring_along_at(&s->along, (j < order ? (double)(first + j) * hop : n) / RATE, &p);
            c[j] = (j < order ? w[j] : -1) * (p.re[0] + I * p.im[0]);
            q[j] = cexp(exponent(&p) / RATE);
        }
        for (int m = n; m < last; m++) {
            double complex sum = 0;
            for (int j = 0; j <= order; j++) {
                sum += c[j];
                c[j] *= q[j];
            }
            wrong += creal(sum * conj(sum));
            whole += creal(c[order] * conj(c[order]));
        }
    }
    arena_close(a);
    return 10 * log10(wrong / whole);
}

/* Modes that ring beyond the sound's end, which comes with the motion's or three times as late: the error that is heard. 512 instants leave up to 1 dB. */
START_TEST(test_ended)
{
    static const struct body slow[] = {{{1000, 1020}, {0.01, 0.01}, {1, 1}, {0, 0}}, {{1000, 1003}, {0.5, 1}, {0.8, 1.6}, {0.2, 0.5}}, {{1000, 1020}, {5, 6}, {1, 1}, {0, 0}}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j += 2)
            for (int late = 1; late <= 3; late += 2) {
                struct arena *a = arena_open();
                struct ring_survey s = survey_of(&slow[i], &motions[j], a, RING_ERROR_LAUNCH);
                for (int order = 1; order <= 4; order *= 2)
                    for (int hop = 8; hop <= 512; hop *= 8) {
                        struct ring_error_ask ask = {.kind = RING_ERROR_LAUNCH, .order = order, .hop = hop, .rate = RATE, .until = HUGE_VAL, .end = late};
                        double judge = brute_until(&s, order, hop, late * RATE), own = 20 * log10(ring_error_all(&s, &ask));
                        if (judge > -150)
                            ck_assert_msg(fabs(own - judge) < 1, "body %d, motion %d, order %d, hop %d, end %d s: %g dB, summed %g", i, j, order, hop, late, own, judge);
                    }
                arena_close(a);
            }
}
END_TEST

/* A pole that moves evenly: hop.h. */
START_TEST(test_even)
{
    static const struct motion line = {.path = PATH_LINE, .to = {0.1, 0}, .rate = NAN, .speed = NAN, .duration = 20};
    const struct body b = {{1000, 1002}, {15, 15}, {1, 1}, {0, 0}};
    struct arena *a = arena_open();
    struct ring_survey s = survey_of(&b, &line, a, RING_ERROR_LAUNCH), t = survey_of(&b, &line, a, RING_ERROR_READOUT);
    for (int order = 1; order <= 4; order *= 2)
        for (int hop = 16; hop <= 256; hop *= 4) {
            double rho = 2 * M_PI * 2 / 20 * hop / RATE / 15, judge = 20 * log10(hop_error(order, rho));
            if (judge < -200) /* rounding of the poles */
                continue;
            ck_assert_double_eq_tol(drawn(&s, RING_ERROR_LAUNCH, order, hop), judge, 0.5);
            if (order < 4) /* which the stop at the end disturbs */
                ck_assert_double_eq_tol(drawn(&t, RING_ERROR_READOUT, order, hop), judge, 0.5);
        }
    arena_close(a);
}
END_TEST

/* The sum over taus of a ramp's discrete poles, as resonators.c runs them, for a force at every frame: energies of error and sound. */
static double glide_brute(const struct ring_survey *s, int ramp)
{
    enum { MOST = 9000 };
    static double complex pole[MOST], gain[MOST], own_pole[MOST], own_gain[MOST];
    struct arena *a = arena_open();
    struct modes_point p = modes_point_make(a, 1);
    int frames = (int)(s->duration * RATE);
    double wrong = 0, whole = 0;
    for (int n = 0; n < frames + 800; n++) {
        int node = (n + 1) / ramp;
        double u = (double)((n + 1) % ramp) / ramp;
        double complex e[3], g[3];
        for (int j = 0; j < 3; j++) {
            ring_along_at(&s->along, (j < 2 ? (double)(node + j) * ramp - 1 : n) / RATE, &p);
            e[j] = cexp(exponent(&p) / RATE);
            g[j] = p.re[0] + I * p.im[0];
        }
        pole[n] = (1 - u) * e[0] + u * e[1];
        gain[n] = (1 - u) * g[0] + u * g[1];
        own_pole[n] = e[2];
        own_gain[n] = g[2];
    }
    for (int m = 0, stands; m < frames; m += stands) {
        double complex z = gain[m], y = own_gain[m];
        stands = m < 128 ? 1 : 29;
        for (int n = m; n < m + 800; n++) {
            wrong += stands * creal((z - y) * conj(z - y));
            whole += stands * creal(y * conj(y));
            z *= pole[n + 1 < frames + 800 ? n + 1 : n];
            y *= own_pole[n + 1 < frames + 800 ? n + 1 : n];
        }
    }
    arena_close(a);
    return 10 * log10(wrong / whole);
}

/* To leading order in the ramp: 1.5 dB down from a tenth of the motion's period (of 20 Hz: 16 frames are 1/25 of it). */
START_TEST(test_glide)
{
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 4; j++)
            for (int ramp = 4; ramp <= 64; ramp *= 4) {
                struct arena *a = arena_open();
                struct ring_survey s = survey_of(&bodies[i], &motions[j], a, RING_ERROR_GLIDE);
                double judge = glide_brute(&s, ramp), own = drawn(&s, RING_ERROR_GLIDE, 2, ramp);
                if ((j != 1 || ramp < 64) && judge > -200)
                    ck_assert_msg(fabs(own - judge) < 1.5, "body %d, motion %d, ramp %d: %g dB, summed %g", i, j, ramp, own, judge);
                arena_close(a);
            }
}
END_TEST

/* Readout, by its definition: at every frame n what all force before it makes of the error of h at n, each frame's force of the same power. */
static double readout_brute(const struct ring_survey *s, int order, int hop)
{
    struct arena *a = arena_open();
    struct modes_point p = modes_point_make(a, 1);
    double wrong = 0, whole = 0;
    for (int n = 0; n < (int)(s->duration * RATE) + order * hop; n += 11) {
        double w[4];
        double complex c[5], q[5];
        int first, since = n - (int)(s->duration * RATE);
        lagrange(order, hop, n, w, &first);
        for (int j = 0; j <= order; j++) {
            ring_along_at(&s->along, (j < order ? (double)(first + j) * hop : n) / RATE, &p);
            q[j] = cexp(exponent(&p) / RATE);
            c[j] = (j < order ? w[j] : -1) * (p.re[0] + I * p.im[0]);
        }
        for (int tau = 0; tau <= n && tau < 1200; tau++) {
            double complex sum = 0;
            if (tau > since) {
                for (int j = 0; j <= order; j++)
                    sum += c[j];
                wrong += creal(sum * conj(sum));
                whole += creal(c[order] * conj(c[order]));
            }
            for (int j = 0; j <= order; j++)
                c[j] *= q[j];
        }
    }
    arena_close(a);
    return 10 * log10(wrong / whole);
}

START_TEST(test_readout)
{
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 4; j++) {
            struct arena *a = arena_open();
            struct ring_survey s = survey_of(&bodies[i], &motions[j], a, RING_ERROR_READOUT);
            for (int order = 1; order <= 4; order *= 2)
                for (int hop = 16; hop <= 256; hop *= 4) {
                    double judge = readout_brute(&s, order, hop), own = drawn(&s, RING_ERROR_READOUT, order, hop);
                    if (judge > -200)
                        ck_assert_msg(fabs(own - judge) < 1, "body %d, motion %d, order %d, hop %d: %g dB, summed %g", i, j, order, hop, own, judge);
                }
            arena_close(a);
        }
}
END_TEST

/* A hop keeps its error and is not much shorter than it need be; each mode's own is a power of two, and twice it would not do. At one frame there is no
   error, whatever is asked. */
START_TEST(test_hops)
{
    for (int i = 0; i < 6; i++)
        for (double db = -40; db > -140; db -= 30) {
            struct arena *a = arena_open();
            struct ring_survey s = survey_of(&bodies[i], &motions[1], a, RING_ERROR_LAUNCH);
            struct ring_error_ask ask = {.kind = RING_ERROR_LAUNCH, .order = 4, .hop = RATE, .rate = RATE, .until = HUGE_VAL, .end = HUGE_VAL};
            double reached, error = pow(10, db / 20), own;
            int hop = ring_hops_one(&s, &ask, error, &reached);
            ck_assert(reached <= error && brute(&s, 4, hop) < db - 3);
            ck_assert_msg(hop == RATE || brute(&s, 4, (int)(1.25 * hop) + 1) > db - 7, "body %d, %g dB: hop %d, %g; %g", i, db, hop, brute(&s, 4, hop), brute(&s, 4, (int)(1.25 * hop) + 1));
            double all = ring_hops_each(&s, &ask, error, &own);
            ck_assert(all <= error && own == exp2(rint(log2(own))) && brute(&s, 4, (int)own) < db - 3 && (2 * own > RATE || brute(&s, 4, 2 * (int)own) > db - 7));
            ask.order = 2;
            ask.hop = 7;
            ck_assert_int_le(ring_hops_power(&s, &ask, error, &reached), 4);
            ck_assert_int_eq(ring_hops_one(&s, &ask, 1e-300, &reached), 1);
            ck_assert(reached == 0);
            arena_close(a);
        }
}
END_TEST

UNIT("ring_error", test_motions, test_ended, test_even, test_glide, test_readout, test_hops)
