/* Speed laws: strokes against closed forms, the pairs of papers/000 section 3.2, the two-thirds power law against the
   law itself and against quadrature, tables of speed against a plain reading of the same formulas in long double, and
   what is refused. */
#include <gsl/gsl_spline.h>
#include <stddef.h>
#include <unistd.h>

#include "motions.h"

static struct motion any(int path, int law, double duration)
{
    return (struct motion){.path = path,
                           .law = law,
                           .duration = duration,
                           .speed = NAN,
                           .straight = 0.1,
                           .turns = 1,
                           .radius = 0.05,
                           .strokes = 4};
}

/* A file of a test, gone at its end. */
static const char *file_of(const char *text)
{
    static char name[] = "/tmp/rasp_speed_XXXXXX";
    strcpy(name, "/tmp/rasp_speed_XXXXXX");
    int fd = mkstemp(name);
    ck_assert(fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text) && close(fd) == 0);
    return name;
}

/* ------------------------------------------------------------------ strokes */

/* Four strokes in one line: each with its quarter of way and time. */
START_TEST(four_in_line)
{
    struct motion m = any(PATH_FOUR_IN_LINE, SPEED_AUTO, 2);
    m.from[0] = 0.01, m.from[1] = 0.02, m.to[0] = 0.13, m.to[1] = -0.07; /* 0.15 m */
    for (int law = 0; law < 3; law++) {
        m.law = law == 0 ? SPEED_AUTO : law == 1 ? SPEED_MINIMUM_JERK : SPEED_CONSTANT; /* auto: harmonic */
        struct trajectory tr = made(&m);
        ck_assert(tr.straight && tr.starts_at_rest == (law < 2) && tr.ends_at_rest == (law < 2));
        for (int i = 0; i <= 4000; i++) {
            double t = i / 2000.0, q = fmod(t, 0.5) / 0.5, k = floor(t / 0.5);
            if (i == 4000) q = 1, k = 3;
            double p = law == 0   ? (1 - cos(M_PI * q)) / 2
                       : law == 1 ? q * q * q * (10 - 15 * q + 6 * q * q)
                                  : q,
                   u = 0.0375 * (k + p);
            struct state s = at(&tr, t);
            ck_assert_double_eq_tol(s.u, u, 1e-15);
            ck_assert_double_eq_tol(s.p[0], 0.01 + 0.8 * u, 1e-15);
            ck_assert_double_eq_tol(s.p[1], 0.02 - 0.6 * u, 1e-15);
            ck_assert_double_eq_tol(s.vel[1], -0.6 * s.v, 1e-15);
            ck_assert_double_eq_tol(s.acc[0], 0.8 * s.a, 1e-14);
        }
        ck_assert(isnan(trajectory_turning(&tr, 0.4, 0.6)));
        struct state end = at(&tr, 2), near = at(&tr, 2 - 1e-9); /* the limits from inside */
        ck_assert_double_eq_tol(end.a, near.a, 1e-6);
        ck_assert_double_eq_tol(end.v, near.v, 1e-6);
        ck_assert_double_eq_tol(end.u, 0.15, 1e-16);
    }
    m.speed = 0.3, m.duration = NAN;
    ck_assert_double_eq_tol(made(&m).duration, 0.5, 1e-15);
}
END_TEST

/* There and back under minimum jerk: each half period is one stroke. */
START_TEST(jerk_there_and_back)
{
    struct motion m = any(PATH_BACK_AND_FORTH, SPEED_MINIMUM_JERK, 3.3);
    m.to[0] = 0.04, m.rate = 1.25; /* 0.4 s a stroke */
    struct trajectory tr = made(&m);
    for (int i = 0; i <= 3300; i++) {
        double t = i / 1000.0, k = floor(t / 0.4 + 1e-12), q = t / 0.4 - k, p = q * q * q * (10 - 15 * q + 6 * q * q);
        struct state s = at(&tr, t);
        ck_assert_double_eq_tol(s.u, 0.04 * (fmod(k, 2) == 0 ? p : 1 - p), 1e-15);
        ck_assert_double_eq_tol(fabs(s.v), 0.1 * 30 * q * q * (1 - q) * (1 - q), 1e-14);
    }
    ck_assert_double_eq_tol(trajectory_turning(&tr, 0.3, 0.5), 0.4, 1e-15);
    ck_assert(tr.starts_at_rest && !tr.ends_at_rest);
    ck_assert_double_eq_tol(tr.mean_speed, (8 * 0.04 + at(&tr, 3.3).u) / 3.3, 1e-15);
    ck_assert_double_eq_tol(tr.top_speed, 0.1 * 1.875, 1e-16);
    ck_assert(tr.reach[0] == 0 && tr.reach[1] == 0.04);
}
END_TEST

/* Papers/000 section 3.2: "pairs which share a velocity profile, but differ spatially". */
START_TEST(pairs_share_their_speed)
{
    srand48(1);
    for (int i = 0; i < 200; i++) {
        double length = between(0.01, 0.2), rate = between(0.5, 4);
        for (int law = SPEED_AUTO; law <= SPEED_MINIMUM_JERK; law++) {
            struct motion there = any(PATH_BACK_AND_FORTH, law, 2 / rate), four = any(PATH_FOUR_IN_LINE, law, 2 / rate);
            struct motion circle = any(PATH_CIRCLE, law, 2 / rate), line = any(PATH_LINE, law, 2 / rate);
            there.to[0] = length, there.rate = rate, four.to[0] = 4 * length;
            circle.radius = length, line.to[1] = 2 * M_PI * length;
            if (law != SPEED_CONSTANT) {
                struct trajectory a = made(&there), b = made(&four);
                for (int j = 0; j <= 500; j++) {
                    double t = a.duration * j / 500;
                    ck_assert_double_eq_tol(fabs(at(&a, t).v), fabs(at(&b, t).v), 1e-12);
                }
            }
            struct trajectory a = made(&circle), b = made(&line);
            for (int j = 0; j <= 500; j++) {
                double t = a.duration * j / 500;
                ck_assert_double_eq_tol(hypot(at(&a, t).vel[0], at(&a, t).vel[1]), fabs(at(&b, t).v), 1e-12);
            }
        }
    }
}
END_TEST

/* ------------------------------------------------------------------ two thirds */

static const double bends[] = {0, 0, 0.05, 0.02, 0.06, -0.04, 0.0, -0.03, -0.02, 0.05};

/* v (kappa^2 + 1 / straight^2)^(1/6) is the same all along, to what the curvature read from the state is off by (1e-9),
   and the time is the integral of its inverse: so the constant is right. */
START_TEST(two_thirds_is_its_law)
{
    struct motion m[] = {any(PATH_SPLINE, SPEED_AUTO, 1.7), any(PATH_POLYLINE, SPEED_TWO_THIRDS, 1.7),
                         any(PATH_SCRIBBLE, SPEED_TWO_THIRDS, 1.7)};
    for (int k = 0; k < 3; k++) {
        m[k].points = bends, m[k].n_points = 5, m[k].corner = k == 1 ? 0.004 : 0;
        m[k].size[0] = 0.08, m[k].size[1] = 0.05, m[k].rate = 2, m[k].straight = k == 0 ? 0.02 : 0.1;
        struct trajectory tr = made(&m[k]);
        double first = NAN, least = HUGE_VAL, most = 0, far = 0;
        for (int i = 0; i <= 20000; i++) {
            struct state s = at(&tr, 1.7 * (i / 20000.0));
            double v = hypot(s.vel[0], s.vel[1]), kappa = (s.vel[0] * s.acc[1] - s.vel[1] * s.acc[0]) / (v * v * v);
            double k6 = v * pow(kappa * kappa + 1 / (m[k].straight * m[k].straight), 1.0 / 6);
            first = i == 0 ? k6 : first;
            ck_assert_double_eq_tol(k6 / first, 1, 1e-7);
            least = fmin(least, v), most = fmax(most, v);
            far += s.v * (i == 0 || i == 20000 ? 0.5 : 1) * 1.7 / 20000;
        }
        ck_assert_double_ge(most / least, 1.15); /* the law was at work */
        ck_assert_double_eq_tol(far, tr.length, 1e-6 * tr.length);
        ck_assert_double_eq_tol(at(&tr, 1.7).u, tr.length, 1e-13);
        ck_assert_double_ge(tr.top_speed, most * (1 - 1e-4));
        ck_assert(!tr.starts_at_rest && !tr.ends_at_rest);
    }
}
END_TEST

struct thirds {
    gsl_spline *axis[2];
    double straight;
};

static double thirds_slowness(double w, void *self)
{
    const struct thirds *t = self;
    double d[2], dd[2];
    for (int k = 0; k < 2; k++) {
        d[k] = gsl_spline_eval_deriv(t->axis[k], w, NULL);
        dd[k] = gsl_spline_eval_deriv2(t->axis[k], w, NULL);
    }
    double speed = hypot(d[0], d[1]), kappa = (d[0] * dd[1] - d[1] * dd[0]) / (speed * speed * speed);
    return speed * pow(kappa * kappa + 1 / (t->straight * t->straight), 1.0 / 6);
}

/* When a spline's point w is reached: the share of the integral of (kappa^2 + 1 / straight^2)^(1/6) ds, by GSL. The
   place at that time is the spline's: 1e-12 m. */
START_TEST(two_thirds_in_time)
{
    double knots[5] = {0};
    struct thirds ref = {.straight = 0.05};
    struct motion m = any(PATH_SPLINE, SPEED_TWO_THIRDS, 2.5);
    m.points = bends, m.n_points = 5, m.straight = 0.05;
    struct trajectory tr = made(&m);
    for (int i = 1; i < 5; i++)
        knots[i] = knots[i - 1] + hypot(bends[2 * i] - bends[2 * i - 2], bends[2 * i + 1] - bends[2 * i - 1]);
    for (int k = 0; k < 2; k++) {
        double y[5];
        for (int i = 0; i < 5; i++)
            y[i] = bends[2 * i + k];
        ref.axis[k] = gsl_spline_alloc(gsl_interp_cspline, 5);
        gsl_spline_init(ref.axis[k], knots, y, 5);
    }
    double whole = 0;
    for (int i = 0; i < 4; i++)
        whole += integral(thirds_slowness, &ref, knots[i], knots[i + 1]);
    srand48(2);
    for (int j = 0; j < 200; j++) {
        double w = between(0, knots[4]), part = 0;
        for (int i = 0; i < 4 && knots[i] < w; i++)
            part += integral(thirds_slowness, &ref, knots[i], fmin(knots[i + 1], w));
        struct state s = at(&tr, 2.5 * part / whole);
        for (int k = 0; k < 2; k++)
            ck_assert_double_eq_tol(s.p[k], gsl_spline_eval(ref.axis[k], w, NULL), 1e-12);
        ck_assert_double_eq_tol(hypot(s.vel[0], s.vel[1]), s.v, 1e-15);
    }
    gsl_spline_free(ref.axis[0]);
    gsl_spline_free(ref.axis[1]);
}
END_TEST

/* An ellipse drawn by two sines obeys the law by itself: K = (a b)^(1/3) omega. So under the law, without its bound, it
 * takes its own times. */
START_TEST(two_thirds_of_an_ellipse)
{
    enum { N = 2001 };
    static double points[2 * N];
    for (int i = 0; i < N; i++) {
        points[2 * i] = 0.06 * cos(2 * M_PI * i / (N - 1));
        points[2 * i + 1] = 0.02 * sin(2 * M_PI * i / (N - 1));
    }
    struct motion m = any(PATH_SPLINE, SPEED_TWO_THIRDS, 1);
    m.points = points, m.n_points = N, m.straight = 100;
    struct trajectory tr = made(&m);
    for (int i = 100; i <= 900; i++) { /* away from the ends, where a natural spline has no curvature */
        double t = i / 1000.0, want[2] = {0.06 * cos(2 * M_PI * t), 0.02 * sin(2 * M_PI * t)};
        for (int k = 0; k < 2; k++)
            ck_assert_double_eq_tol(at(&tr, t).p[k], want[k], 2e-5);
    }
}
END_TEST

/* ------------------------------------------------------------------ given */

/* The same interpolation, written out in long double in its textbook form (weights alpha = (1 + h1 / (h0 + h1)) / 3,
 * Fritsch and Butland). */
static long double pchip_slope(const double *t, const double *v, int n, int i)
{
    if (n == 2) return ((long double)v[1] - v[0]) / (t[1] - t[0]);
    if (i == 0 || i == n - 1) {
        int a = i ? n - 1 : 0, b = i ? n - 2 : 1, c = i ? n - 3 : 2;
        long double h0 = fabsl((long double)t[b] - t[a]), h1 = fabsl((long double)t[c] - t[b]);
        long double m0 = ((long double)v[b] - v[a]) / (t[b] - t[a]), m1 = ((long double)v[c] - v[b]) / (t[c] - t[b]);
        long double d = ((2 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
        if (d * m0 <= 0) return 0;
        return m0 * m1 <= 0 && fabsl(d) > fabsl(3 * m0) ? 3 * m0 : d;
    }
    long double h0 = (long double)t[i] - t[i - 1], h1 = (long double)t[i + 1] - t[i],
                m0 = (v[i] - (long double)v[i - 1]) / h0;
    long double m1 = (v[i + 1] - (long double)v[i]) / h1, alpha = (1 + h1 / (h0 + h1)) / 3;
    return m0 * m1 <= 0 ? 0 : m0 * m1 / (alpha * m1 + (1 - alpha) * m0);
}

/* Speed at x, and the way from the start to there: the cubic's integral is Simpson's rule. */
static long double pchip_at(const double *t, const double *v, int n, int i, long double x)
{
    long double h = (long double)t[i + 1] - t[i], q = (x - t[i]) / h, d0 = pchip_slope(t, v, n, i),
                d1 = pchip_slope(t, v, n, i + 1);
    return v[i] * (1 + 2 * q) * (1 - q) * (1 - q) + v[i + 1] * q * q * (3 - 2 * q) +
           h * (d0 * q * (1 - q) * (1 - q) - d1 * q * q * (1 - q));
}

static long double pchip_way(const double *t, const double *v, int n, long double x)
{
    long double sum = 0;
    for (int i = 0; i + 1 < n && t[i] < x; i++) {
        long double b = x < t[i + 1] ? x : t[i + 1], h = b - t[i];
        sum += h / 6 * (pchip_at(t, v, n, i, t[i]) + 4 * pchip_at(t, v, n, i, t[i] + h / 2) + pchip_at(t, v, n, i, b));
    }
    return sum;
}

START_TEST(given_is_pchip)
{
    srand48(3);
    for (int k = 0; k < 60; k++) {
        enum { MOST = 40 };
        double t[MOST], v[MOST];
        int n = k < 3 ? 2 + k : 2 + (int)between(0, MOST - 2);
        char *text = arena_take(motions_arena(), 4000, 1);
        strcpy(text, "time_s,speed_m_per_s\n");
        for (int i = 0; i < n; i++) {
            t[i] = i ? t[i - 1] + between(0.001, 0.3) : 12.5;
            v[i] = i % 5 == 4 ? 0 : i % 7 == 6 ? v[i - 1] : between(0, 0.5);
            sprintf(text + strlen(text), "%.17g,%.17g\n", t[i], v[i]);
        }
        struct motion m = any(PATH_LINE, SPEED_GIVEN, NAN);
        m.to[0] = 50, m.profile = file_of(text);
        struct trajectory tr = made(&m);
        unlink(m.profile);
        double top = 0, whole = (double)pchip_way(t, v, n, t[n - 1]);
        ck_assert_double_eq_tol(tr.duration, t[n - 1] - t[0], 1e-14);
        ck_assert_double_eq_tol(tr.reach[1], whole, 1e-13);
        ck_assert_double_eq_tol(tr.mean_speed, whole / tr.duration, 1e-13);
        for (int i = 0; i < n; i++)
            top = fmax(top, v[i]);
        ck_assert_double_eq(tr.top_speed, top);
        for (int j = 0; j <= 300; j++) {
            double x = j == 300 ? tr.duration : between(0, tr.duration);
            int i = 0;
            while (i + 2 < n && t[i + 1] - t[0] <= x)
                i++;
            struct state s = at(&tr, x);
            ck_assert_double_eq_tol(s.v, (double)pchip_at(t, v, n, i, (long double)x + t[0]), 1e-13);
            ck_assert_double_eq_tol(s.u, (double)pchip_way(t, v, n, (long double)x + t[0]), 1e-13);
            ck_assert(s.v >= 0 && s.v <= top * (1 + 1e-15)); /* never below 0, never above the rows */
            ck_assert_double_eq(s.p[0], s.u);
        }
        for (int j = 0; j < 50; j++) { /* speed is C1: its slope has no jumps */
            double h = 1e-7, x = between(h, tr.duration - h);
            ck_assert_double_eq_tol(slope_by(&tr, x, h, offsetof(struct state, v)), at(&tr, x).a,
                                    1e-5 * (1 + fabs(at(&tr, x).a)) + 3e-3);
        }
    }
}
END_TEST

/* There and back: the way of a line, folded at the ends; the turns are where it passes whole strokes. */
START_TEST(given_is_folded)
{
    const char *table = file_of("time_s,speed_m_per_s\n0,0\n0.2,0.3\n0.7,0.1\n1,0.4\n1.6,0.4\n2,0\n");
    struct motion fold = any(PATH_BACK_AND_FORTH, SPEED_GIVEN, NAN), line = any(PATH_LINE, SPEED_GIVEN, NAN),
                  circle = any(PATH_CIRCLE, SPEED_GIVEN, NAN);
    fold.profile = line.profile = circle.profile = table;
    fold.to[1] = 0.07, line.to[1] = 1, circle.radius = 0.01;
    struct trajectory tr = made(&fold), way = made(&line), round = made(&circle);
    int turns = 0;
    for (int i = 0; i < 2000; i++) {
        double t = i / 1000.0, far = at(&way, t).u, k = floor(far / 0.07), rest = far - k * 0.07;
        ck_assert_double_eq_tol(at(&tr, t).u, fmod(k, 2) == 0 ? rest : 0.07 - rest, 1e-14);
        ck_assert_double_eq(at(&tr, t).v, at(&way, t).v * (fmod(k, 2) == 0 ? 1 : -1));
        ck_assert_double_eq(at(&tr, t).p[1], at(&tr, t).u);
        ck_assert_double_eq_tol(hypot(at(&round, t).vel[0], at(&round, t).vel[1]), at(&way, t).v, 1e-15);
        ck_assert_double_eq_tol(atan2(sin(far / 0.01), cos(far / 0.01)), atan2(at(&round, t).p[1], at(&round, t).p[0]),
                                1e-11);
        double turn = trajectory_turning(&tr, t, (i + 1) / 1000.0);
        if (isnan(turn)) continue;
        turns++;
        ck_assert_double_eq_tol(at(&way, turn).u, 0.07 * turns, 1e-15);
        ck_assert(at(&tr, turn - 1e-9).v * at(&tr, turn + 1e-9).v < 0);
        ck_assert(isnan(trajectory_turning(&tr, turn, turn + 1e-3)) &&
                  isnan(trajectory_turning(&tr, turn - 1e-3, turn)));
    }
    ck_assert_int_eq(turns, (int)(way.reach[1] / 0.07));
    ck_assert(tr.starts_at_rest && tr.ends_at_rest && tr.reach[1] == 0.07);
    ck_assert_double_eq_tol(tr.mean_speed, way.mean_speed, 1e-16);
    unlink(table);
}
END_TEST

START_TEST(given_on_open_paths)
{
    const char *table = file_of("time_s,speed_m_per_s\n3,0.1\n5,0.1\n"); /* 0.2 m in 2 s */
    struct motion m = any(PATH_LINE, SPEED_GIVEN, NAN);
    m.profile = table, m.to[0] = 0.2 * (1 - 0.9e-6); /* a little too short counts as rounding */
    struct trajectory tr = made(&m);
    ck_assert_double_eq(at(&tr, 2).u, m.to[0]);
    ck_assert_double_eq_tol(at(&tr, 1).u, 0.1, 1e-16);
    m.to[0] = 0.2 * (1 - 1.1e-6);
    refused(&m, ERR_SCENE, "leads 0.2 m far, but the path is 0.19999978 m long");
    m.to[0] = 0.3; /* the motion ends when the table does */
    tr = made(&m);
    ck_assert(tr.duration == 2 && !tr.starts_at_rest);
    ck_assert_double_eq_tol(tr.box[1][0], 0.2, 1e-16);
    m.path = PATH_SCRIBBLE, m.size[0] = m.size[1] = 0.01, m.rate = 0.1; /* has no end, however slow its own time is */
    tr = made(&m);
    ck_assert_double_eq_tol(at(&tr, 2).u, 0.2, 1e-16);
    ck_assert_double_eq_tol(hypot(at(&tr, 1.9).vel[0], at(&tr, 1.9).vel[1]), 0.1, 1e-15);
    m.path = PATH_LINE, m.duration = 1;
    refused(&m, ERR_SCENE, "motion.duration: the table");
    m.duration = NAN, m.profile = NULL;
    refused(&m, ERR_SCENE, "motion.profile must be given");
    unlink(table);
}
END_TEST

START_TEST(tables_refused)
{
    static const struct {
        const char *text, *says;
    } bad[] = {
        {"time_s,speed\n0,1\n1,1\n", "no column 'speed_m_per_s'"},
        {"t,speed_m_per_s\n0,1\n1,1\n", "no column 'time_s'"},
        {"time_s,speed_m_per_s\n0,1\n", "1 row; at least 2"},
        {"time_s,speed_m_per_s\n0,1\n1,-0.1\n", ":3: column 'speed_m_per_s': -0.1 is negative"},
        {"time_s,speed_m_per_s\n0,1\n1,x\n", ":3: column 'speed_m_per_s': 'x' is not a number"},
        {"time_s,speed_m_per_s\n0,1\n1,1\n1,2\n", ":4: column 'time_s': 1 s comes after 1 s"},
        {"time_s,speed_m_per_s\n0,1\n1e-10,1\n1,2\n",
         ":3: column 'time_s': 1e-10 s comes 1e-10 s after the row before"},
        {"time_s,speed_m_per_s\n0,0\n1,0\n", "all speeds are 0"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct motion m = any(PATH_LINE, SPEED_GIVEN, NAN);
        m.to[0] = 1, m.profile = file_of(bad[i].text);
        refused(&m, ERR_SCENE, bad[i].says);
        unlink(m.profile);
    }
    struct motion m = any(PATH_LINE, SPEED_GIVEN, NAN);
    m.to[0] = 1, m.profile = "/tmp/rasp_there_is_no_such_file";
    refused(&m, ERR_INPUT, "no_such_file");
}
END_TEST

UNIT("speed", four_in_line, jerk_there_and_back, pairs_share_their_speed, two_thirds_is_its_law, two_thirds_in_time,
     two_thirds_of_an_ellipse, given_is_pchip, given_is_folded, given_on_open_paths, tables_refused)
