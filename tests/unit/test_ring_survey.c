/* ring_survey: a response that moves in a known way, against hop.h's formula and against the error of interpolation itself, measured on the
   impulse response. */
#include "convolution/ring_survey.h"

#include "convolution/hop.h"
#include "num/real.h"
#include "unit.h"

enum { RATE = 48000 };
#define SECONDS 2.0

struct glider {           /* one mode along x: f + slope x, gain e^(growth x) */
    double f, slope, sigma, growth;
};

static double glider_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    const struct glider *g = m->self;
    p->frequency[0] = g->f + g->slope * where->x;
    p->decay[0] = g->sigma;
    p->re[0] = real_exp(g->growth * where->x);
    p->im[0] = 0;
    return 0;
}

static struct ring_survey survey_of(const struct glider *g, struct arena *a)
{
    static const struct motion motion = {.path = PATH_LINE, .to = {1, 0}, .speed = NAN, .duration = SECONDS};
    struct trajectory tr;
    struct err e = {0};
    struct ring_survey s;
    double one[1] = {1};
    struct modes m = {.n = 1, .moves = true, .frequency = one, .decay = one, .slowest = one, .at = glider_at, .self = g};
    ck_assert(trajectory_make(&motion, 1, a, &tr, &e));
    ring_survey(&(struct ring_survey_ask){&m, false, false}, &tr, a, &s);
    return s;
}

/* Poles alone: the same as hop_error of the pole's way per hop over its half bandwidth. */
START_TEST(test_poles)
{
    struct arena *a = arena_open();
    const struct glider g = {1000, 20, 15, 0};
    struct ring_survey s = survey_of(&g, a);
    for (int order = 1; order <= 4; order *= 2)
        for (double hop = 1e-3; hop < 0.1; hop *= 3) {
            double rho = 2 * M_PI * g.slope / SECONDS * hop / g.sigma;
            ck_assert_double_eq_tol(ring_survey_error(&s, order, hop) / hop_error(order, rho), 1, 1e-6);
        }
    arena_close(a);
}
END_TEST

/* Relative rms error of order-p interpolation of A(t) e^(s(t) tau) between nodes at multiples of the hop, at instants inside one interval. */
static double measured(const struct glider *g, int order, double hop)
{
    static const int first[] = {[1] = 0, [2] = 0, [4] = -1};
    double sum = 0, whole = 0;
    for (int k = 0; k < 64; k++) {
        double u = (k + 0.5) / 64, start = order == 1 ? -0.5 : 0, middle = SECONDS / 2, t = middle + (start + u) * hop;
        double fraction = start + u;
        for (int n = 0; n < 8000; n++) {
            double tau = n * 16 / g->sigma / 8000, re = 0, im = 0;
            for (int j = 0; j < order; j++) {
                double w = 1, at = first[order] + j, x = (middle + at * hop) / SECONDS, f = g->f + g->slope * x;
                for (int i = 0; i < order; i++)
                    if (i != j)
                        w *= (fraction - first[order] - i) / (j - i);
                w *= exp(g->growth * x - g->sigma * tau);
                re += w * cos(2 * M_PI * f * tau);
                im += w * sin(2 * M_PI * f * tau);
            }
            double x = t / SECONDS, f = g->f + g->slope * x, size = exp(g->growth * x - g->sigma * tau);
            double dr = re - size * cos(2 * M_PI * f * tau), di = im - size * sin(2 * M_PI * f * tau);
            sum += dr * dr + di * di;
            whole += size * size;
        }
    }
    return sqrt(sum / whole);
}

/* Poles, gains, and both together, up to errors of -40 dB: to leading order the formula is exact but for the decay's share, so 10 % for what
   the next order brings. */
START_TEST(test_gains)
{
    struct arena *a = arena_open();
    const struct glider all[] = {{1000, 20, 15, 0}, {1000, 0, 15, 30}, {1000, 20, 15, 30}, {3000, 60, 30, 10}};
    for (int i = 0; i < 4; i++)
        for (int order = 1; order <= 4; order *= 2) {
            struct ring_survey s = survey_of(&all[i], a);
            double hop = order == 1 ? 4e-4 : 2e-3;
            ck_assert_double_eq_tol(ring_survey_error(&s, order, hop) / measured(&all[i], order, hop), 1, 0.1);
        }
    arena_close(a);
}
END_TEST

/* A kink in slope, interpolated from nodes one hop apart: the integral of the square of the error, on the average over where the kink falls. */
static double kink_error(int order)
{
    double sum = 0;
    for (int t = 0; t < 100; t++)
        for (int i = -3000; i < 4000; i++) {
            double theta = (t + 0.5) / 100, x = (i + 0.5) / 1000, u = x - floor(x), y = 0;
            for (int j = 0; j < order; j++) {
                int first = order == 2 ? 0 : -1;
                double w = 1;
                for (int k = 0; k < order; k++)
                    w *= k == j ? 1 : (u - first - k) / (j - k);
                y += w * fmax(floor(x) + first + j - theta, 0);
            }
            sum += (y - fmax(x - theta, 0)) * (y - fmax(x - theta, 0)) / 1000 / 100;
        }
    return sum;
}

static int one_kink(const struct modes *m, const double from[2], const double to[2], double *u, int most)
{
    (void)m, (void)from, (void)to, (void)most;
    u[0] = 0.5;
    return 1;
}

static double bent_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    const struct glider *g = m->self;
    p->frequency[0] = g->f + g->slope * fmax(where->x - 0.50037, 0);
    p->decay[0] = g->sigma;
    p->re[0] = 1;
    p->im[0] = 0;
    return 0;
}

/* The pole stands still for one second, then moves for one: the kink's share of the error is c H^3 J^2 2/(2 sigma)^2 over 2 s. */
START_TEST(test_kinks)
{
    static const struct motion motion = {.path = PATH_LINE, .to = {1, 0}, .speed = NAN, .duration = SECONDS};
    const struct glider g = {1000, 20, 15, 0};
    struct arena *a = arena_open();
    struct trajectory tr;
    struct err e = {0};
    double one[1] = {1};
    struct modes m = {.n = 1, .moves = true, .frequency = one, .decay = one, .slowest = one, .at = bent_at, .kinks = one_kink, .self = &g};
    ck_assert(trajectory_make(&motion, 1, a, &tr, &e));
    for (int order = 2; order <= 4; order += 2) {
        struct ring_survey bent, straight;
        double hop = 2e-3, jump = 2 * M_PI * g.slope / SECONDS, c = kink_error(order);
        ck_assert_double_eq_tol(c, order == 2 ? 1.0 / 90 : 0.00615, 2e-5);
        ring_survey(&(struct ring_survey_ask){&m, false, false}, &tr, a, &bent);
        m.kinks = NULL;
        ring_survey(&(struct ring_survey_ask){&m, false, false}, &tr, a, &straight);
        m.kinks = one_kink;
        double with = ring_survey_error(&bent, order, hop), without = ring_survey_error(&straight, order, hop);
        double kink = c * hop * hop * hop * jump * jump / (2 * g.sigma * g.sigma) / SECONDS;
        ck_assert_double_eq_tol((with * with - without * without) / kink, 1, 0.02);
    }
    arena_close(a);
}
END_TEST

START_TEST(test_hops)
{
    struct arena *a = arena_open();
    const struct glider g = {1000, 20, 15, 0};
    struct ring_survey s = survey_of(&g, a);
    for (int order = 1; order <= 4; order *= 2) {
        double hop = ring_survey_hop(&s, order, 1e-3, 1), own;
        ck_assert_double_eq_tol(ring_survey_error(&s, order, hop) / 1e-3, 1, 1e-9);
        ring_survey_hops(&s, order, 1e-3, 1, &own);
        ck_assert_double_eq_tol(own / hop, 1, 1e-5); /* one mode at one speed */
        ck_assert_double_eq(ring_survey_hop(&s, order, 1e-3, hop / 2), hop / 2);
    }
    arena_close(a);
}
END_TEST

UNIT("ring_survey", test_poles, test_gains, test_kinks, test_hops)
