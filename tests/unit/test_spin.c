/* How a ball turns: equation 18 of papers/000 held in long double, whole turns, derivatives against differences of high
   order of the positions, hours of rolling, backwards, grouping, and the limit of no offset. */
#include "trajectory/spin.h"

#include <stddef.h>

#include "unit.h"

#define PI_L 3.141592653589793238462643383279502884L

static double between(double lo, double hi) { return lo + (hi - lo) * drand48(); }

static struct spin ball(double offset)
{
    return (struct spin){.radius = 0.03, .offset = offset, .start = 0, .lobe_height = 2e-5, .lobes = 3};
}

static double theta_at(const struct spin *s, double u)
{
    double theta;
    spin_at(s, 1, &u, NULL, NULL, &(struct spin_out){.theta = &theta});
    return theta;
}

/* u + x(start) = R theta - r sin theta to 1e-15 of the largest of R, x and x(start), for any offset below R. */
START_TEST(equation_18)
{
    static const double shares[] = {0, 1e-9, 0.001, 0.05, 0.3, 0.9, 0.99, 0.999999};
    srand48(1);
    for (size_t k = 0; k < sizeof shares / sizeof shares[0]; k++)
        for (int i = 0; i < 20000; i++) {
            struct spin s = ball(0.03 * shares[k]);
            s.start = between(-6.28, 6.28);
            double u = i < 10000 ? between(-0.5, 0.5) : between(-3, 3) * pow(10, between(-12, 5)),
                   theta = theta_at(&s, u);
            long double x0 = (long double)s.radius * s.start - (long double)s.offset * sinl(s.start), x = u + x0;
            long double got = (long double)s.radius * theta - (long double)s.offset * sinl(theta),
                        scale = fmaxl(fmaxl(fabsl(x), fabsl(x0)), s.radius);
            ck_assert_msg(fabsl(got - x) <= 1e-15L * scale, "r/R %g u %g: %Lg of %Lg", shares[k], u, got - x, scale);
        }
}
END_TEST

/* A turn is 2 pi R, whatever the offset; theta(0) is the start; theta rises and falls with u. */
START_TEST(turns)
{
    srand48(2);
    for (int i = 0; i < 2000; i++) {
        struct spin s = ball(between(0, 0.029));
        s.start = between(-6.28, 6.28);
        double u = between(-1, 1), turn = 2 * M_PI * s.radius;
        ck_assert_double_eq_tol(theta_at(&s, 0), s.start, 1e-14 / (1 - s.offset / s.radius));
        ck_assert_double_eq_tol(theta_at(&s, u + turn) - theta_at(&s, u), 2 * M_PI, 1e-13 / (1 - s.offset / s.radius));
        double last = theta_at(&s, u);
        for (int k = 1; k < 50; k++) {
            double next = theta_at(&s, u - k * 0.007);
            ck_assert(next < last);
            last = next;
        }
    }
    struct spin s = ball(0.02); /* the centre of mass is lowest at whole turns, highest half way between */
    double u[3] = {0, 2 * M_PI * 0.03, M_PI * 0.03}, rise[3];
    spin_at(&s, 3, u, NULL, NULL, &(struct spin_out){.rise = rise});
    ck_assert(rise[0] == -0.02);
    ck_assert_double_eq_tol(rise[1], -0.02, 1e-17);
    ck_assert_double_eq_tol(rise[2], 0.02, 1e-17);
}
END_TEST

/* An hour at 30 m/s: 570 000 turns and more. cos(theta) and cos(lobes theta) stay within the rounding of u itself, by
 * the equation in long double. */
START_TEST(hours)
{
    struct spin s = ball(0.004);
    srand48(3);
    for (int i = 0; i < 20000; i++) {
        double u = between(0.9, 1.1) * 3600 * 30, rise, rim;
        spin_at(&s, 1, &u, NULL, NULL, &(struct spin_out){.rise = &rise, .rim = &rim});
        long double y = (long double)u / s.radius, phi = y - 2 * PI_L * rintl(y / (2 * PI_L)), e = phi,
                    q = (long double)s.offset / s.radius;
        for (int k = 0; k < 100; k++)
            e -= (e - q * sinl(e) - phi) / (1 - q * cosl(e));
        double rounding = 2 * u * 1.2e-16 / s.radius; /* rad */
        ck_assert_double_eq_tol(rise, (double)(-s.offset * cosl(e)), s.offset * rounding);
        ck_assert_double_eq_tol(rim, (double)(s.lobe_height * cosl(s.lobes * e)), s.lobe_height * s.lobes * rounding);
    }
}
END_TEST

/* ------------------------------------------------------------------ derivatives */

/* A motion with every derivative: u = 0.3 t + 0.1 sin 5 t, of changing sign of speed where a is large. */
static void motion(double a, double t, double out[3])
{
    out[0] = 0.3 * t + a * sin(5 * t);
    out[1] = 0.3 + 5 * a * cos(5 * t);
    out[2] = -25 * a * sin(5 * t);
}

struct moved {
    double theta, turning, rise, climb, lift, rim, swell, heave;
};

static struct moved moved(const struct spin *s, double a, double t)
{
    struct moved m;
    double x[3];
    motion(a, t, x);
    spin_at(s, 1, &x[0], &x[1], &x[2],
            &(struct spin_out){&m.theta, &m.turning, &m.rise, &m.climb, &m.lift, &m.rim, &m.swell, &m.heave, NULL});
    return m;
}

/* Central differences of order 8 over 8 neighbours. */
static double difference(const struct spin *s, double a, double t, double h, size_t member)
{
    static const double w[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double sum = 0;
    for (int k = 1; k <= 4; k++) {
        struct moved hi = moved(s, a, t + k * h), lo = moved(s, a, t - k * h);
        sum += w[k - 1] * (*(double *)((char *)&hi + member) - *(double *)((char *)&lo + member));
    }
    return sum / h;
}

START_TEST(derivatives)
{
    static const struct {
        size_t of, is;
    } pairs[] = {{offsetof(struct moved, theta), offsetof(struct moved, turning)},
                 {offsetof(struct moved, rise), offsetof(struct moved, climb)},
                 {offsetof(struct moved, climb), offsetof(struct moved, lift)},
                 {offsetof(struct moved, rim), offsetof(struct moved, swell)},
                 {offsetof(struct moved, swell), offsetof(struct moved, heave)}};
    srand48(4);
    for (int i = 0; i < 2000; i++) {
        struct spin s = ball(between(0, 0.012));
        double a = i % 2 ? 0.1 : 0.03, t = between(0, 5), scale[5] = {30, 0.4, 15, 0.01, 1};
        s.start = between(-3, 3);
        struct moved m = moved(&s, a, t);
        for (int k = 0; k < 5;
             k++) /* 1e-10: what order 8 leaves at 1 ms of a motion that turns 30 rad/s, and rounding over h */
            ck_assert_double_eq_tol(difference(&s, a, t, 5e-4, pairs[k].of) / scale[k],
                                    *(double *)((char *)&m + pairs[k].is) / scale[k], 2e-10);
    }
}
END_TEST

/* Each value by itself, asked for alone or with others, in any group: the same bits. */
START_TEST(groups)
{
    enum { N = 700 };
    struct spin s = ball(0.011);
    static double u[N], v[N], a[N], lift[N], rise[N], again[N];
    for (int i = 0; i < N; i++) {
        double x[3];
        motion(0.1, i * 0.003, x);
        u[i] = x[0], v[i] = x[1], a[i] = x[2];
    }
    spin_at(&s, N, u, v, a, &(struct spin_out){.lift = lift, .rise = rise});
    for (size_t from = 0, some = 1; from < N; from += some, some = some * 3 % 101 + 1) {
        some = some < N - from ? some : N - from;
        spin_at(&s, some, u + from, v + from, a + from, &(struct spin_out){.lift = again + from});
    }
    ck_assert(memcmp(lift, again, sizeof lift) == 0);
    for (int i = 0; i < N; i++) {
        spin_at(&s, 1, u + i, NULL, NULL, &(struct spin_out){.rise = again});
        ck_assert(again[0] == rise[i]);
    }
}
END_TEST

/* Without an offset theta is u / R and nothing rises. */
START_TEST(round_ball)
{
    struct spin s = ball(0);
    s.start = 0.7;
    double u = 0.1, v = 2, a = -3;
    struct moved m;
    spin_at(&s, 1, &u, &v, &a,
            &(struct spin_out){&m.theta, &m.turning, &m.rise, &m.climb, &m.lift, &m.rim, &m.swell, &m.heave, NULL});
    ck_assert_double_eq_tol(m.theta, 0.7 + 0.1 / 0.03, 1e-15 * 4);
    ck_assert_double_eq_tol(m.turning, 2 / 0.03, 1e-13);
    ck_assert(m.rise == 0 && m.climb == 0 && m.lift == 0);
    ck_assert_double_eq_tol(m.rim, 2e-5 * cos(3 * (0.7 + 0.1 / 0.03)), 1e-19);
    double x = 3 * (0.7 + 0.1 / 0.03), w = 2 / 0.03, ww = -3 / 0.03;
    ck_assert_double_eq_tol(m.swell, -2e-5 * 3 * sin(x) * w, 1e-16);
    ck_assert_double_eq_tol(m.heave, -2e-5 * 3 * (3 * cos(x) * w * w + sin(x) * ww), 1e-13);
    struct contact c = {.ball = {.radius = 1, .offset = 0.5, .start_angle = 3, .lobe_height = 1e-3, .lobes = 4}};
    s = spin_make(&c);
    ck_assert(s.radius == 1 && s.offset == 0.5 && s.start == 3 && s.lobe_height == 1e-3 && s.lobes == 4);
}
END_TEST

UNIT("spin", equation_18, turns, hours, derivatives, groups, round_ball)
