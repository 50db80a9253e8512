/* Curved paths: a circle against its closed form in long double; splines and rounded corners against GSL's splines,
   adaptive quadrature and root finding; scribbles against the sum of sines worked out from the noise stream in long
   double; derivatives of all against finite differences.

   Tolerances: 1e-12 m is what trajectory.h promises; beside that the rounding of a place of up to 1 m, 1.1e-16, and of
   the length so far. */
#include <gsl/gsl_spline.h>
#include <stddef.h>

#include "motions.h"
#include "num/noise.h"

#define PI_L 3.141592653589793238462643383279502884L

static struct motion any(int path, int law, double duration)
{
    return (struct motion){
        .path = path, .law = law, .duration = duration, .speed = NAN, .straight = 0.1, .turns = 1, .radius = 0.05};
}

/* ------------------------------------------------------------------ circle */

START_TEST(circle_is_closed_form)
{
    srand48(1);
    for (int i = 0; i < 1500; i++) {
        struct motion m = any(PATH_CIRCLE, SPEED_AUTO, between(0.1, 20));
        m.center[0] = between(-1, 1), m.center[1] = between(-1, 1), m.radius = pow(10, between(-3, 0));
        m.start_angle = between(-6, 6), m.turns = between(0.1, 30) * (i % 2 ? 1 : -1);
        struct trajectory tr = made(&m);
        double t = i % 50 == 0 ? m.duration : between(0, m.duration);
        struct state s = at(&tr, t);
        long double r = m.radius, way = m.turns < 0 ? -1 : 1, q = (long double)t / m.duration,
                    a = m.start_angle + 2 * PI_L * m.turns * q;
        long double length = 2 * PI_L * r * fabsl((long double)m.turns), v = length / m.duration;
        ck_assert_double_eq_tol(s.p[0], (double)(m.center[0] + r * cosl(a)), 1e-12);
        ck_assert_double_eq_tol(s.p[1], (double)(m.center[1] + r * sinl(a)), 1e-12);
        ck_assert_double_eq_tol(s.u, (double)(length * q), 5e-16 * (double)length + 1e-15);
        ck_assert_double_eq_tol(s.vel[0], (double)(-way * v * sinl(a)), 1e-12 * (double)v);
        ck_assert_double_eq_tol(s.vel[1], (double)(way * v * cosl(a)), 1e-12 * (double)v);
        ck_assert_double_eq_tol(s.acc[0], (double)(-v * v / r * cosl(a)), 1e-12 * (double)(v * v / r));
        ck_assert_double_eq_tol(s.acc[1], (double)(-v * v / r * sinl(a)), 1e-12 * (double)(v * v / r));
        ck_assert_double_eq_tol(tr.length, (double)length, 4e-16 * (double)length);
    }
}
END_TEST

START_TEST(circle_box)
{
    struct motion m = any(PATH_CIRCLE, SPEED_AUTO, 1);
    m.center[0] = 0.3, m.turns = 0.75; /* three quarters: from 3 o'clock over 12 and 9 to 6 */
    struct trajectory tr = made(&m);
    ck_assert(!tr.straight && !tr.starts_at_rest && !tr.ends_at_rest);
    ck_assert_double_eq_tol(tr.box[0][0], 0.25, 1e-15);
    ck_assert_double_eq_tol(tr.box[1][0], 0.35, 1e-15);
    ck_assert_double_eq_tol(tr.box[0][1], -0.05, 1e-15);
    ck_assert_double_eq_tol(tr.box[1][1], 0.05, 1e-15);
    m.turns = -0.3; /* clockwise past 6 o'clock: never above the centre, -108 degrees is its left end */
    tr = made(&m);
    ck_assert_double_eq_tol(tr.box[0][0], 0.3 + 0.05 * cos(0.6 * M_PI), 1e-15);
    ck_assert_double_eq_tol(tr.box[1][1], 0, 1e-15);
    ck_assert_double_eq_tol(tr.box[0][1], -0.05, 1e-15);
    m.turns = 250.4; /* many turns */
    tr = made(&m);
    ck_assert_double_eq_tol(tr.box[0][0], 0.25, 1e-13);
    m.turns = 0;
    refused(&m, ERR_SCENE, "motion.turns");
}
END_TEST

/* ------------------------------------------------------------------ spline through points */

struct chords {
    gsl_spline *axis[2];
    double end;
};

static double chord_speed(double w, void *self)
{
    struct chords *c = self;
    double x = gsl_spline_eval_deriv(c->axis[0], w, NULL), y = gsl_spline_eval_deriv(c->axis[1], w, NULL);
    return sqrt(x * x + y * y);
}

static struct chords chords_of(const double *points, int n, double *knots)
{
    struct chords c;
    double x[50], y[50];
    for (int i = 0; i < n; i++) {
        x[i] = points[2 * i];
        y[i] = points[2 * i + 1];
        knots[i] = i ? knots[i - 1] + hypot(x[i] - x[i - 1], y[i] - y[i - 1]) : 0;
    }
    for (int k = 0; k < 2; k++) {
        c.axis[k] = gsl_spline_alloc(gsl_interp_cspline, (size_t)n); /* natural ends */
        gsl_spline_init(c.axis[k], knots, k ? y : x, (size_t)n);
    }
    c.end = knots[n - 1];
    return c;
}

static void chords_free(struct chords *c)
{
    gsl_spline_free(c->axis[0]);
    gsl_spline_free(c->axis[1]);
}

/* Length up to w: knot by knot, so that what is integrated is smooth. */
static double chord_length(struct chords *c, const double *knots, int n, double w)
{
    double sum = 0;
    for (int i = 0; i + 1 < n && knots[i] < w; i++)
        sum += integral(chord_speed, c, knots[i], fmin(knots[i + 1], w));
    return sum;
}

START_TEST(spline_against_gsl)
{
    srand48(2);
    for (int k = 0; k < 12; k++) {
        double points[24], knots[12];
        int n = 3 + k % 10;
        for (int i = 0; i < 2 * n; i++)
            points[i] = between(-0.1, 0.1);
        if (k == 0) /* two points beside each other, and a far one */
            points[2] = points[0] + 1e-5, points[3] = points[1], points[4] = 1;
        struct motion m = any(PATH_SPLINE, SPEED_CONSTANT, 2);
        m.points = points, m.n_points = n;
        struct trajectory tr = made(&m);
        struct chords c = chords_of(points, n, knots);
        double whole = chord_length(&c, knots, n, c.end);
        ck_assert_double_eq_tol(tr.length, whole, 1e-13);
        for (int i = 0; i <= 20; i++) {
            double w = i == 20 ? c.end : c.end * drand48(), s = chord_length(&c, knots, n, w);
            struct state got = at(&tr, 2 * s / tr.length);
            double x = gsl_spline_eval(c.axis[0], w, NULL), y = gsl_spline_eval(c.axis[1], w, NULL),
                   dx = gsl_spline_eval_deriv(c.axis[0], w, NULL);
            double dy = gsl_spline_eval_deriv(c.axis[1], w, NULL), ddx = gsl_spline_eval_deriv2(c.axis[0], w, NULL);
            double ddy = gsl_spline_eval_deriv2(c.axis[1], w, NULL), speed = hypot(dx, dy), v = tr.length / 2,
                   kappa = (dx * ddy - dy * ddx) / (speed * speed * speed);
            ck_assert_double_eq_tol(got.p[0], x, 1e-12);
            ck_assert_double_eq_tol(got.p[1], y, 1e-12);
            ck_assert_double_eq_tol(got.vel[0], v * dx / speed, 1e-10 * v); /* direction turns by kappa 1e-12 */
            ck_assert_double_eq_tol(got.vel[1], v * dy / speed, 1e-10 * v);
            ck_assert_double_eq_tol(got.acc[0], -v * v * kappa * dy / speed, 1e-8 * v * v * (1 + fabs(kappa)));
            ck_assert_double_eq_tol(got.acc[1], v * v * kappa * dx / speed, 1e-8 * v * v * (1 + fabs(kappa)));
        }
        chords_free(&c);
    }
}
END_TEST

START_TEST(spline_refusals)
{
    double same[] = {0, 0, 0.1, 0, 0.1, 0, 0.2, 0.1}, back[] = {0, 0, 0.1, 0, 0, 0};
    struct motion m = any(PATH_SPLINE, SPEED_AUTO, 1);
    m.points = same, m.n_points = 4;
    refused(&m, ERR_SCENE, "points 2 and 3 are in one place");
    m.points = back, m.n_points = 3; /* there and back on one line: the direction is not defined where it turns */
    refused(&m, ERR_SCENE, "cusp between points");
    m.n_points = 1;
    refused(&m, ERR_SCENE, "at least 2 points");
    m.n_points = 2, m.duration = NAN;
    refused(&m, ERR_SCENE, "motion.duration or motion.speed must be given");
    m.speed = 0.2;
    ck_assert_double_eq_tol(made(&m).duration, 0.5, 1e-15);
}
END_TEST

/* ------------------------------------------------------------------ polyline */

struct corner {
    double turn;
    int sine;
};

static double corner_heading(double z, void *self)
{
    const struct corner *c = self;
    double psi = c->turn * (z - sin(2 * M_PI * z) / (2 * M_PI));
    return c->sine ? sin(psi) : cos(psi);
}

/* One corner, of any angle: straight, rounded part, straight. The path's symmetry puts the middle of the rounded part
 * on the bisector. */
START_TEST(corner_is_as_its_formula)
{
    srand48(3);
    for (int i = 0; i < 300; i++) {
        double turn = between(0.02, 3) * (i % 2 ? 1 : -1), radius = pow(10, between(-4, -2)), heading = between(-3, 3);
        double side = 40 * radius * fmax(1, tan(fabs(turn) / 2)), points[] = {0.3, -0.2, 0, 0, 0, 0};
        for (int k = 0; k < 2; k++)
            for (int xy = 0; xy < 2; xy++)
                points[2 * k + 2 + xy] =
                    points[2 * k + xy] + side * (xy ? sin(heading + k * turn) : cos(heading + k * turn));
        struct motion m = any(PATH_POLYLINE, SPEED_CONSTANT, 1);
        m.points = points, m.n_points = 3, m.corner = radius;
        struct trajectory tr = made(&m);
        double length = 2 * fabs(turn) * radius, half[2];
        for (int k = 0; k < 2; k++)
            half[k] = length * integral(corner_heading, &(struct corner){turn, k}, 0, 0.5);
        double room = half[0] + half[1] * tan(turn / 2), first = side - room;
        ck_assert_double_eq_tol(tr.length, 2 * first + length, 1e-12);
        struct state end = at(&tr, 1);
        ck_assert_double_eq_tol(end.p[0], points[4], 1e-12);
        ck_assert_double_eq_tol(end.p[1], points[5], 1e-12);
        for (int j = 0; j < 20; j++) {
            double z = between(0, 1), v = tr.length, xy[2], psi = turn * (z - sin(2 * M_PI * z) / (2 * M_PI)) + heading;
            struct state s = at(&tr, (first + z * length) / tr.length);
            for (int k = 0; k < 2; k++)
                xy[k] = length * integral(corner_heading, &(struct corner){turn, k}, 0, z) + (k ? 0 : first);
            ck_assert_double_eq_tol(s.p[0], points[0] + xy[0] * cos(heading) - xy[1] * sin(heading), 2e-12);
            ck_assert_double_eq_tol(s.p[1], points[1] + xy[0] * sin(heading) + xy[1] * cos(heading), 2e-12);
            ck_assert_double_eq_tol(s.vel[0], v * cos(psi), 1e-9 * v); /* 1e-12 m of way over a radius of 1e-4 m */
            ck_assert_double_eq_tol(s.vel[1], v * sin(psi), 1e-9 * v);
            double kappa = turn / length * (1 - cos(2 * M_PI * z)),
                   cross = (s.vel[0] * s.acc[1] - s.vel[1] * s.acc[0]) / (v * v * v);
            ck_assert_double_eq_tol(cross, kappa, 1e-8 / radius);
            ck_assert_double_le(fabs(kappa), 1 / radius * (1 + 1e-12));
        }
        struct state straight = at(&tr, 0.9 * first / tr.length);
        ck_assert_double_eq_tol(straight.p[0], points[0] + 0.9 * first * cos(heading), 1e-13);
        ck_assert(straight.acc[0] == 0 && straight.acc[1] == 0);
    }
}
END_TEST

/* Without rounding: each straight one stroke from rest to rest, with its share of the time by length. */
START_TEST(polyline_strokes)
{
    double points[] = {0, 0, 0.3, 0, 0.3, 0.1, 0.1, 0.1, 0.15, 0.1}; /* 0.3, 0.1, 0.2, 0.05 m; the last turns back */
    double ends[] = {0, 0.3, 0.4, 0.6, 0.65};
    struct motion m = any(PATH_POLYLINE, SPEED_AUTO, 1.3);
    m.points = points, m.n_points = 5;
    for (int law = 0; law < 2; law++) {
        m.law = law ? SPEED_HARMONIC : SPEED_AUTO; /* auto: minimum jerk */
        struct trajectory tr = made(&m);
        ck_assert_double_eq_tol(tr.length, 0.65, 1e-15);
        ck_assert(tr.starts_at_rest && tr.ends_at_rest && !tr.straight);
        for (int i = 0; i < 4; i++)
            for (int j = 1; j < 40; j++) {
                double l = ends[i + 1] - ends[i], q = j / 40.0, t = 2 * (ends[i] + q * l);
                double p = law ? 0.5 * (1 - cos(M_PI * q)) : q * q * q * (10 - 15 * q + 6 * q * q);
                struct state s = at(&tr, t);
                ck_assert_double_eq_tol(s.u, ends[i] + l * p, 1e-14);
                for (int xy = 0; xy < 2; xy++)
                    ck_assert_double_eq_tol(
                        s.p[xy], points[2 * i + xy] + p * (points[2 * i + 2 + xy] - points[2 * i + xy]), 1e-14);
            }
        for (int i = 1; i < 4; i++) {
            ck_assert_double_le(fabs(at(&tr, 2 * ends[i]).v), 1e-13);
            double turn = trajectory_turning(&tr, 2 * ends[i] - 1e-3, 2 * ends[i] + 1e-3);
            if (i == 3)
                ck_assert_double_eq_tol(turn, 1.2, 1e-12);
            else
                ck_assert(isnan(turn)); /* 90 degrees are no turning back */
        }
    }
    m.corner = 0.01;
    refused(&m, ERR_SCENE, "turns back on itself");
    m.n_points = 4, m.corner = 0.2;
    refused(&m, ERR_SCENE, "rounding takes");
    m.corner = 0, m.law = SPEED_CONSTANT;
    refused(&m, ERR_SCENE, "rests at its corners");
    points[2] = points[0], points[3] = points[1];
    m.law = SPEED_AUTO;
    refused(&m, ERR_SCENE, "points 1 and 2 are in one place");
}
END_TEST

/* ------------------------------------------------------------------ scribble */

struct waves {
    long double f[2][4], a[2][4], phase[2][4];
};

static struct waves waves_of(const struct motion *m)
{
    struct noise n = noise_make(1, "scribble");
    struct waves w;
    for (int xy = 0; xy < 2; xy++) {
        long double sum = 0;
        for (unsigned k = 0; k < 4; k++) {
            w.f[xy][k] = m->rate * powl(2, 0.7L * (2 * (long double)noise_uniform(n, (uint64_t)(3 * xy), k) - 1));
            w.a[xy][k] = 0.5L + 0.5L * noise_uniform(n, (uint64_t)(3 * xy + 1), k);
            w.phase[xy][k] = 2 * PI_L * noise_uniform(n, (uint64_t)(3 * xy + 2), k);
            sum += w.a[xy][k];
        }
        for (int k = 0; k < 4; k++)
            w.a[xy][k] *= m->size[xy] / 2 / sum;
    }
    return w;
}

static double waves_speed(double t, void *self)
{
    const struct waves *w = self;
    long double v[2] = {0, 0};
    for (int xy = 0; xy < 2; xy++)
        for (int k = 0; k < 4; k++)
            v[xy] += 2 * PI_L * w->f[xy][k] * w->a[xy][k] * cosl(2 * PI_L * w->f[xy][k] * t + w->phase[xy][k]);
    return (double)sqrtl(v[0] * v[0] + v[1] * v[1]);
}

static struct motion scribble(int law, double rate, double duration)
{
    struct motion m = any(PATH_SCRIBBLE, law, duration);
    m.center[0] = 0.2, m.center[1] = -0.1, m.size[0] = 0.08, m.size[1] = 0.05, m.rate = rate;
    return m;
}

/* In units of the speed and acceleration that the fastest sine alone could have. The frequencies' own rounding (2^x to
   1 ulp) is a phase of 2 pi f t 3e-16. */
START_TEST(scribble_is_its_sines)
{
    struct motion m = scribble(SPEED_AUTO, 2.5, 20);
    struct trajectory tr = made(&m);
    struct waves w = waves_of(&m);
    srand48(4);
    for (int i = 0; i < 3000; i++) {
        double t = between(0, 20);
        struct state s = at(&tr, t);
        for (int xy = 0; xy < 2; xy++) {
            long double p = m.center[xy], v = 0, a = 0;
            for (int k = 0; k < 4; k++) {
                long double omega = 2 * PI_L * w.f[xy][k], phase = omega * t + w.phase[xy][k];
                p += w.a[xy][k] * sinl(phase), v += omega * w.a[xy][k] * cosl(phase),
                    a -= omega * omega * w.a[xy][k] * sinl(phase);
            }
            ck_assert_double_eq_tol(s.p[xy], (double)p, 1e-14);
            ck_assert_double_eq_tol(s.vel[xy], (double)v, 1e-12);
            ck_assert_double_eq_tol(s.acc[xy], (double)a, 1e-10);
            ck_assert_double_le(fabs(s.p[xy] - m.center[xy]), m.size[xy] / 2 * (1 + 1e-15));
        }
        ck_assert_double_eq_tol(s.v, hypot(s.vel[0], s.vel[1]), 1e-15);
        ck_assert_double_eq_tol(s.a * s.v, s.vel[0] * s.acc[0] + s.vel[1] * s.acc[1], 1e-13);
    }
    ck_assert_double_ge(tr.box[1][0] - tr.box[0][0],
                        0.6 * m.size[0]); /* it is a scribble in that box, not a dot in it */
    ck_assert_double_ge(tr.box[1][1] - tr.box[0][1], 0.6 * m.size[1]);
    ck_assert(!tr.starts_at_rest && !tr.straight);
}
END_TEST

/* The way travelled, against adaptive quadrature over a loop's tenths; and that it does not depend on how long the
 * scribble goes on. */
START_TEST(scribble_length)
{
    struct motion m = scribble(SPEED_AUTO, 3, 10), longer = scribble(SPEED_AUTO, 3, 40);
    struct trajectory tr = made(&m), more = made(&longer);
    struct waves w = waves_of(&m);
    double sum = 0, top = 0;
    for (int i = 0; i < 300; i++) {
        double t0 = i / 30.0, t1 = (i + 1) / 30.0, t = between(t0, t1);
        ck_assert_double_eq_tol(at(&tr, t).u, sum + integral(waves_speed, &w, t0, t), 1e-12);
        ck_assert_double_eq_tol(at(&more, t).u, at(&tr, t).u, 1e-13);
        ck_assert(at(&more, t).p[0] == at(&tr, t).p[0]);
        sum += integral(waves_speed, &w, t0, t1);
    }
    ck_assert_double_eq_tol(tr.length, sum, 1e-12);
    ck_assert_double_eq_tol(tr.mean_speed, sum / 10, 1e-13);
    for (int i = 0; i < 100000; i++)
        top = fmax(top, waves_speed(i * 1e-4, &w));
    ck_assert_double_ge(tr.top_speed, top * (1 - 1e-14));
    ck_assert_double_le(tr.top_speed, top * (1 + 1e-5));
}
END_TEST

/* The same curve under a law: place at a way of u is the place where the scribble's own time has gone that far. */
START_TEST(scribble_under_a_law)
{
    struct motion own = scribble(SPEED_AUTO, 3, 4), even = scribble(SPEED_CONSTANT, 3, 4),
                  jerk = scribble(SPEED_MINIMUM_JERK, 3, 4);
    struct trajectory tr = made(&own), along = made(&even), rest = made(&jerk);
    ck_assert_double_eq_tol(along.length, tr.length, 1e-12);
    ck_assert_double_eq_tol(rest.length, tr.length, 1e-12);
    ck_assert(rest.starts_at_rest && rest.ends_at_rest);
    for (int i = 0; i <= 2000; i++) {
        double t = 4 * (i / 2000.0);
        struct state a = at(&tr, t), b = at(&along, 4 * a.u / along.length);
        for (int xy = 0; xy < 2; xy++)
            ck_assert_double_eq_tol(a.p[xy], b.p[xy], 1e-12);
        ck_assert_double_eq_tol(b.v, along.length / 4, 1e-15);
        ck_assert_double_eq_tol(hypot(b.vel[0], b.vel[1]), b.v, 1e-15);
    }
}
END_TEST

/* Another seed is another scribble. */
START_TEST(scribble_by_seed)
{
    struct motion m = scribble(SPEED_AUTO, 2, 1);
    struct trajectory a, b;
    struct err e = {0};
    ck_assert(trajectory_make(&m, 1, motions_arena(), &a, &e) && trajectory_make(&m, 2, motions_arena(), &b, &e));
    ck_assert_double_ge(fabs(at(&a, 0.3).p[0] - at(&b, 0.3).p[0]), 1e-4);
    m.duration = NAN;
    refused(&m, ERR_SCENE, "motion.duration must be given");
    struct scene s = {.seed = 1};
    struct contact one = {.name = "one"}, two = {.name = "two"};
    ck_assert(trajectory_seed(&s, &one) != trajectory_seed(&s, &two));
    s.seed = 2;
    uint64_t other = trajectory_seed(&s, &one);
    s.seed = 1;
    ck_assert(trajectory_seed(&s, &one) != other &&
              trajectory_seed(&s, &one) == trajectory_seed(&s, &(struct contact){.name = "one"}));
}
END_TEST

/* ------------------------------------------------------------------ all of them */

static const double bends[] = {0, 0, 0.05, 0.02, 0.06, -0.04, 0.0, -0.03, -0.02, 0.05};

/* Velocity and acceleration are the derivatives of the position. h is small against the shortest bend; at the borders
   of pieces the fifth derivative jumps, which costs the difference one order. */
START_TEST(derivatives_agree)
{
    struct motion m[] = {
        any(PATH_CIRCLE, SPEED_MINIMUM_JERK, 2), any(PATH_SPLINE, SPEED_HARMONIC, 2), any(PATH_SPLINE, SPEED_AUTO, 2),
        any(PATH_POLYLINE, SPEED_CONSTANT, 2),   scribble(SPEED_AUTO, 2, 2),          scribble(SPEED_TWO_THIRDS, 2, 2),
        any(PATH_POLYLINE, SPEED_TWO_THIRDS, 2), scribble(SPEED_CONSTANT, 2, 2)};
    srand48(5);
    for (int k = 0; k < 8; k++) {
        m[k].points = bends, m[k].n_points = 5, m[k].corner = m[k].path == PATH_POLYLINE ? 0.005 : 0;
        struct trajectory tr = made(&m[k]);
        double most = 0, worst[4] = {0, 0, 0, 0};
        for (int i = 0; i <= 2000; i++)
            most = fmax(most, hypot(at(&tr, i / 1000.0).acc[0], at(&tr, i / 1000.0).acc[1]));
        for (int i = 0; i < 3000; i++) {
            double h = 2e-5, t = between(h, 2 - h);
            struct state s = at(&tr, t);
            for (int xy = 0; xy < 2; xy++) {
                worst[0] =
                    fmax(worst[0], fabs(slope_by(&tr, t, h, offsetof(struct state, p) + 8 * (size_t)xy) - s.vel[xy]) /
                                       tr.top_speed);
                worst[1] =
                    fmax(worst[1],
                         fabs(slope_by(&tr, t, h, offsetof(struct state, vel) + 8 * (size_t)xy) - s.acc[xy]) / most);
            }
            worst[2] = fmax(worst[2], fabs(slope_by(&tr, t, h, offsetof(struct state, u)) - s.v) / tr.top_speed);
            worst[3] = fmax(worst[3], fabs(slope_by(&tr, t, h, offsetof(struct state, v)) - s.a) / most);
        }
        if (getenv("SHOW")) printf("%d: v %.2g a %.2g along %.2g %.2g\n", k, worst[0], worst[1], worst[2], worst[3]);
        ck_assert_double_le(worst[0], 5e-9);
        ck_assert_double_le(worst[2], 5e-9);
        ck_assert_double_le(worst[1], 1e-7);
        ck_assert_double_le(worst[3], 1e-7);
    }
}
END_TEST

/* Any outputs left out, in batches of any length, in any order: as one by one; and before the start and after the end
 * the ends hold. */
START_TEST(many_as_one)
{
    enum { N = 700 };
    static double t[N], out[9][N], one[N];
    struct motion m[] = {
        any(PATH_CIRCLE, SPEED_AUTO, 2),   any(PATH_SPLINE, SPEED_AUTO, 2), any(PATH_POLYLINE, SPEED_CONSTANT, 2),
        any(PATH_POLYLINE, SPEED_AUTO, 2), scribble(SPEED_AUTO, 2, 2),      scribble(SPEED_CONSTANT, 2, 2)};
    srand48(6);
    for (int k = 0; k < 6; k++) {
        m[k].points = bends, m[k].n_points = 5, m[k].corner = m[k].law == SPEED_CONSTANT ? 0.005 : 0;
        struct trajectory tr = made(&m[k]);
        for (int i = 0; i < N; i++)
            t[i] = k % 2 ? between(-0.1, 2.1) : 2.2 * i / N - 0.1;
        trajectory_at(&tr, N, t,
                      (struct trajectory_out){out[0], out[1], out[2], out[3], out[4], out[5], out[6], out[7], out[8]});
        for (int i = 0; i < N; i++) {
            struct state s = at(&tr, t[i]);
            const double want[9] = {s.u, s.v, s.a, s.p[0], s.p[1], s.vel[0], s.vel[1], s.acc[0], s.acc[1]};
            for (int c = 0; c < 9; c++)
                ck_assert(want[c] == out[c][i]);
        }
        for (int c = 0; c < 9; c++) {
            double *only[9] = {NULL};
            only[c] = one;
            trajectory_at(&tr, N, t,
                          (struct trajectory_out){only[0], only[1], only[2], only[3], only[4], only[5], only[6],
                                                  only[7], only[8]});
            ck_assert_mem_eq(one, out[c], sizeof one);
        }
        struct state first = at(&tr, 0), last = at(&tr, 2), before = at(&tr, -HUGE_VAL), after = at(&tr, HUGE_VAL);
        ck_assert(first.u == 0 && before.u == 0 && before.p[0] == first.p[0] && before.acc[1] == first.acc[1]);
        ck_assert(after.u == last.u && after.p[1] == last.p[1] && after.vel[0] == last.vel[0] &&
                  after.acc[0] == last.acc[0]);
        ck_assert_double_eq_tol(last.u, tr.length, 1e-13);
        ck_assert(tr.reach[0] == 0 && fabs(tr.reach[1] - tr.length) < 1e-13);
        for (int xy = 0; xy < 2; xy++)
            ck_assert_double_eq(tr.from[xy], first.p[xy]);
        ck_assert_double_eq_tol(hypot(tr.e[0], tr.e[1]), 1, 1e-14);
    }
}
END_TEST

/* No curve but a stop at a sharp corner turns back. */
START_TEST(curves_do_not_turn)
{
    struct motion m[] = {any(PATH_CIRCLE, SPEED_AUTO, 2), any(PATH_SPLINE, SPEED_AUTO, 2), scribble(SPEED_AUTO, 2, 2),
                         scribble(SPEED_HARMONIC, 2, 2)};
    for (int k = 0; k < 4; k++) {
        m[k].points = bends, m[k].n_points = 5;
        struct trajectory tr = made(&m[k]);
        for (int i = 0; i < 4000; i++)
            ck_assert(isnan(trajectory_turning(&tr, i * 5e-4, (i + 1) * 5e-4)));
        for (int i = 0; i < 180 && k < 2; i++) /* nor where the direction has turned round by and by */
            ck_assert(isnan(trajectory_turning(&tr, i * 0.01, i * 0.01 + 0.2)));
    }
}
END_TEST

/* Beyond the ends the place goes on without a jump in place or velocity (the third difference of a smooth way is
 * small). */
START_TEST(goes_on_beyond_the_ends)
{
    struct motion m[] = {any(PATH_CIRCLE, SPEED_AUTO, 2), any(PATH_SPLINE, SPEED_AUTO, 2), scribble(SPEED_AUTO, 2, 2),
                         any(PATH_POLYLINE, SPEED_CONSTANT, 2), any(PATH_SPLINE, SPEED_CONSTANT, 2)};
    for (int k = 0; k < 5; k++) {
        m[k].points = bends, m[k].n_points = 5, m[k].corner = m[k].path == PATH_POLYLINE ? 0.005 : 0;
        struct trajectory tr = made(&m[k]);
        for (int end = 0; end < 2; end++) {
            double h = 1e-4, p[4][2], t = end ? 2 : 0;
            for (int i = 0; i < 4; i++)
                trajectory_continued(&tr, t + (i - 1.5) * h, p[i]);
            for (int xy = 0; xy < 2; xy++)
                ck_assert_double_le(fabs(p[3][xy] - 3 * p[2][xy] + 3 * p[1][xy] - p[0][xy]), 30 * h * h * tr.top_speed);
            double far[2];
            trajectory_continued(&tr, end ? 2.05 : -0.05, far);
            ck_assert_double_le(hypot(far[0] - at(&tr, t).p[0], far[1] - at(&tr, t).p[1]),
                                0.05 * tr.top_speed * 1.0000001);
            ck_assert_double_ge(hypot(far[0] - at(&tr, t).p[0], far[1] - at(&tr, t).p[1]), 0.01 * at(&tr, t).v);
        }
        double inside[2];
        trajectory_continued(&tr, 0.7, inside);
        ck_assert(inside[0] == at(&tr, 0.7).p[0] && inside[1] == at(&tr, 0.7).p[1]);
    }
}
END_TEST

UNIT("path", circle_is_closed_form, circle_box, spline_against_gsl, spline_refusals, corner_is_as_its_formula,
     polyline_strokes, scribble_is_its_sines, scribble_length, scribble_under_a_law, scribble_by_seed,
     derivatives_agree, many_as_one, curves_do_not_turn, goes_on_beyond_the_ends)
