/* Free motion on a slope: closed forms of school mechanics in long double, the balance of energy with rotation, the
   equation of motion by small steps, times of stopping, reaching and coming back, the clean ends of u, turning round,
   and what is refused. */

#include <stddef.h>

#include "motions.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"
#include "trajectory/motion.h"

static struct motion slope(double degrees, double speed, double friction, double length)
{
    return (struct motion){.path = PATH_INCLINE,
                           .law = SPEED_AUTO,
                           .from = {0.01, -0.02},
                           .to = {0.01 + 0.6 * length, -0.02 + 0.8 * length},
                           .speed = NAN,
                           .duration = NAN,
                           .incline = degrees * M_PI / 180,
                           .start_speed = speed,
                           .rolling_friction = friction,
                           .gravity = 9.80665};
}

/* up_to: degrees and friction below these, speeds from 0.1 to 2 m/s. */
static struct motion any_slope(double up_to, double friction)
{
    double degrees = between(-up_to, up_to), speed = between(0.1, 2), c = between(0, friction),
           length = between(0.05, 2);
    return slope(degrees, speed, c, length);
}

/* The four bodies of ball.body: a wall of 1 mm in 20 mm for the hollow one, by the formula for a shell between two
 * spheres. */
static const struct {
    int body;
    double wall, inertia;
} bodies[] = {
    {BODY_SOLID, NAN, 0.4},
    {BODY_HOLLOW, NAN, 2.0 / 3},
    {BODY_HOLLOW, 1e-3, 0.4 * (1 - 0.95 * 0.95 * 0.95 * 0.95 * 0.95) / (1 - 0.95 * 0.95 * 0.95)},
    {BODY_HOOP, NAN, 1},
    {BODY_WHEEL, NAN, 0.5},
};

static struct contact rolling(int i, const struct motion *m)
{
    struct contact c = {.motion = *m,
                        .ball = {.radius = 0.02, .mass = 0.1, .body = bodies[i].body, .wall = bodies[i].wall}};
    c.contact.model = CONTACT_ROLL;
    c.contact.gravity = m->gravity;
    contact_derive(&c, NULL);
    ck_assert_double_eq_tol(c.motion.inertia, bodies[i].inertia, 1e-15);
    return c;
}

/* Up and down without friction: back at v = start speed after 2 v / a; energy kinetic + rotational + potential is the
 * same all the time. */
START_TEST(up_and_down)
{
    for (int i = 0; i < 5; i++) {
        struct motion m = slope(7, 0.8, 0, 2);
        struct contact c = rolling(i, &m);
        struct trajectory tr = made(&c.motion);
        long double a = 9.80665L * sinl(m.incline) / (1 + bodies[i].inertia), end = 2 * 0.8L / a,
                    total = 0.5L * (1 + bodies[i].inertia) * 0.64L;
        ck_assert(tr.straight && !tr.starts_at_rest && !tr.ends_at_rest);
        ck_assert_double_eq_tol(tr.duration, (double)end, 1e-15 * (double)end * 4);
        ck_assert_double_eq_tol(tr.reach[1], (double)(0.32L / a), 1e-15);
        ck_assert_double_eq(tr.reach[0], 0);
        ck_assert_double_eq_tol(tr.mean_speed, 0.4, 1e-14);
        ck_assert_double_eq_tol(tr.top_speed, 0.8, 1e-14);
        for (int k = 0; k <= 1000; k++) {
            double t = tr.duration * k / 1000;
            struct state s = at(&tr, t);
            ck_assert_double_eq_tol(s.u, (double)(0.8L * t - a * t * t / 2), 1e-15);
            ck_assert_double_eq_tol(s.v, (double)(0.8L - a * t), 2e-15);
            ck_assert_double_eq_tol(s.a, (double)-a, 1e-15);
            ck_assert_double_eq_tol(s.p[0], 0.01 + 0.6 * s.u, 1e-15);
            ck_assert_double_eq_tol(s.vel[1], 0.8 * s.v, 1e-15);
            long double energy = 0.5L * (1 + bodies[i].inertia) * s.v * s.v + 9.80665L * sinl(m.incline) * s.u;
            ck_assert_double_eq_tol((double)(energy / total), 1, 1e-14);
        }
        ck_assert_double_eq(at(&tr, 0).u, 0);
        ck_assert_double_eq_tol(at(&tr, tr.duration).v, -0.8, 2e-15);
        ck_assert_double_eq_tol(trajectory_turning(&tr, 0, tr.duration), (double)(0.8L / a), 1e-15 * (double)end);
        ck_assert(isnan(trajectory_turning(&tr, (double)(0.81L / a), tr.duration)));
    }
}
END_TEST

/* What slides has no inertia of its own; a roller needs sqrt(1 + I / (m R^2)) times its time down the same slope. */
START_TEST(down_from_rest)
{
    struct motion m = slope(-10, 0, 0, 1.5);
    struct trajectory slid = made(&m);
    ck_assert_double_eq_tol(slid.duration, sqrt(2 * 1.5 / (9.80665 * sin(10 * M_PI / 180))), 1e-15);
    ck_assert(slid.starts_at_rest && !slid.ends_at_rest);
    ck_assert_double_eq_tol(at(&slid, slid.duration).u, 1.5, 1e-15);
    ck_assert(at(&slid, slid.duration).u <= slid.reach[1]);
    for (int i = 0; i < 5; i++) {
        struct contact c = rolling(i, &m);
        struct trajectory rolled = made(&c.motion);
        ck_assert_double_eq_tol(rolled.duration / slid.duration, sqrt(1 + bodies[i].inertia), 1e-15 * 2);
        ck_assert_double_eq_tol(rolled.top_speed,
                                sqrt(2 * 9.80665 * sin(10 * M_PI / 180) * 1.5 / (1 + bodies[i].inertia)), 1e-15 * 4);
    }
}
END_TEST

/* On the level without friction: constant speed. With it: v / (c g) s, v^2 / (2 c g) m, then rest for good, as long as
 * the duration says. */
START_TEST(level)
{
    struct motion m = slope(0, 0.3, 0, 2);
    struct trajectory tr = made(&m);
    ck_assert_double_eq_tol(tr.duration, 2 / 0.3, 1e-15 * 4);
    ck_assert(at(&tr, 3).v == 0.3 && at(&tr, 3).a == 0 && !signbit(at(&tr, 3).a));
    m.rolling_friction = 0.01;
    tr = made(&m);
    ck_assert_double_eq_tol(tr.duration, 0.3 / 0.0980665, 1e-15 * 4);
    ck_assert_double_eq_tol(tr.reach[1], 0.09 / (2 * 0.0980665), 1e-15);
    ck_assert(tr.ends_at_rest && !tr.starts_at_rest && at(&tr, tr.duration).v == 0);
    m.duration = 10;
    struct trajectory longer = made(&m);
    ck_assert(longer.duration == 10 && longer.ends_at_rest && longer.reach[1] == tr.reach[1]);
    ck_assert_double_eq_tol(longer.mean_speed, tr.reach[1] / 10, 1e-15);
    for (double t = tr.duration * (1 + 1e-12); t < 10; t += 0.01) {
        struct state s = at(&longer, t);
        ck_assert(s.u == tr.reach[1] && s.v == 0 && s.a == 0);
    }
    ck_assert(isnan(trajectory_turning(&longer, 0, 10)));
    ck_assert_double_eq_tol(at(&longer, 1).a, -0.0980665, 1e-16);
    m.duration = 1; /* still on its way */
    ck_assert(!made(&m).ends_at_rest);
}
END_TEST

/* u'' = -(slope + friction sgn u') / (1 + inertia), held where friction is stronger, in 2000 steps in long double, each
   with the sign of the speed at its start; the step in which the speed changes its sign is cut there, by bisection. */
struct mover {
    long double u, v;
};

static long double force(const struct motion *m, long double v)
{
    long double s = m->gravity * sinl(m->incline), c = m->gravity * m->rolling_friction * cosl(m->incline),
                sgn = v > 0   ? 1
                      : v < 0 ? -1
                              : 0;
    if (sgn == 0 && fabsl(s) <= c) return 0;
    return -(s + c * (sgn != 0 ? sgn : s > 0 ? -1 : 1)) / (1 + m->inertia);
}

static struct mover mover_within(const struct motion *m, struct mover x, long double h)
{
    long double a = force(m, x.v);
    return (struct mover){x.u + h * (x.v + h / 2 * a), x.v + h * a};
}

static struct mover mover_step(const struct motion *m, struct mover x, long double h)
{
    struct mover next = mover_within(m, x, h);
    long double low = 0, high = h;
    if (!(x.v * next.v < 0)) return next;
    for (int i = 0; i < 80; i++) {
        long double middle = (low + high) / 2;
        if (mover_within(m, x, middle).v * x.v > 0)
            low = middle;
        else
            high = middle;
    }
    next = mover_within(m, x, low);
    next.v = 0;
    return mover_within(m, next, h - low);
}

START_TEST(against_small_steps)
{
    srand48(1);
    int seen[3] = {0, 0, 0};
    for (int i = 0; i < 60; i++) {
        struct motion m = any_slope(20, i % 4 ? 0.2 : 0);
        m.inertia = bodies[i % 5].inertia;
        struct incline c = motion_incline(&m);
        struct trajectory tr = made(&m);
        struct mover x = {0, m.start_speed};
        int steps = 2000;
        long double h = tr.duration / (long double)steps;
        for (int k = 0; k < steps; k++, x = mover_step(&m, x, h)) {
            struct state s = at(&tr, (double)(h * k));
            ck_assert_double_eq_tol(s.u, (double)x.u, 1e-13);
            ck_assert_double_eq_tol(s.v, (double)x.v, 1e-13);
            ck_assert(s.u >= 0 && s.u <= tr.reach[1] && tr.reach[1] <= c.length);
        }
        seen[c.over]++;
        double far = c.over == INCLINE_AT_TO ? c.length : c.over == INCLINE_AT_FROM ? 0 : tr.reach[1];
        ck_assert_double_eq_tol((double)x.u, far, 1e-13);
    }
    ck_assert(seen[0] > 5 && seen[1] > 5 && seen[2] > 5);
}
END_TEST

/* Up with friction and down again: a lower speed, v^2 (sin - c cos) / (sin + c cos) of its square. u and its speed are
 * continuous; its acceleration jumps. */
START_TEST(back_with_friction)
{
    struct motion m = slope(5, 1, 0.04, 3);
    m.inertia = 0.4;
    struct trajectory tr = made(&m);
    double s = sin(m.incline), c = 0.04 * cos(m.incline), turn = 1.4 / (9.80665 * (s + c));
    ck_assert_double_eq_tol(trajectory_turning(&tr, turn - 0.001, turn + 0.001), turn, 1e-14);
    ck_assert_double_eq_tol(tr.duration, turn * (1 + sqrt((s + c) / (s - c))), 1e-14);
    struct state end = at(&tr, tr.duration), before = at(&tr, turn - 1e-9), after = at(&tr, turn + 1e-9);
    ck_assert_double_eq_tol(end.v * end.v, (s - c) / (s + c), 1e-14);
    ck_assert_double_eq_tol(end.u, 0, 1e-15);
    ck_assert_double_eq_tol(before.a, -9.80665 * (s + c) / 1.4, 1e-14);
    ck_assert_double_eq_tol(after.a, -9.80665 * (s - c) / 1.4, 1e-14);
    ck_assert_double_eq_tol(before.u, after.u, 1e-15);
    ck_assert(before.v > 0 && after.v < 0 && before.v < 2e-9 && after.v > -2e-9);
    ck_assert_double_eq_tol(slope_by(&tr, 0.3 * turn, 1e-3, offsetof(struct state, u)), at(&tr, 0.3 * turn).v, 1e-12);
    ck_assert_double_eq_tol(slope_by(&tr, 1.3 * turn, 1e-3, offsetof(struct state, v)), at(&tr, 1.3 * turn).a, 1e-12);
}
END_TEST

/* Duration given: anywhere before the end; a rounded figure of the end itself; not beyond it. */
START_TEST(durations)
{
    struct motion m = slope(7, 0.8, 0, 2);
    double end = made(&m).duration;
    m.duration = 0.7 * end;
    struct trajectory tr = made(&m);
    ck_assert(tr.duration == 0.7 * end && at(&tr, 0.7 * end).v < 0);
    m.duration = end * (1 + 5e-10);
    ck_assert_double_eq(made(&m).duration, end);
    m.duration = end * 1.001;
    refused(&m, ERR_SCENE, "is back at motion.from after 1.33877 s");
    m.to[0] = m.from[0] + 0.1, m.to[1] = m.from[1];
    refused(&m, ERR_SCENE, "reaches motion.to after");
    refused(&m, ERR_SCENE, "lower it or leave it out");
}
END_TEST

START_TEST(refusals)
{
    struct motion m = slope(7, 0, 0, 1);
    refused(&m, ERR_SCENE, "leads upwards");
    m = slope(0, 0, 0, 1);
    refused(&m, ERR_SCENE, "level");
    m.duration = 1; /* nothing would happen all that time */
    refused(&m, ERR_SCENE, "level");
    m = slope(-3, 0, 0.06, 1);
    refused(&m, ERR_SCENE, "holds it");
    m.rolling_friction = 0.05; /* tan 3 degrees is 0.0524 */
    ck_assert(made(&m).starts_at_rest);
    m.gravity = 0;
    refused(&m, ERR_SCENE, "contact.gravity");
    m = slope(0, 1e-5, 0, 1);
    refused(&m, ERR_SCENE, "give motion.duration");
    m.duration = 30;
    struct trajectory slow = made(&m);
    ck_assert_double_eq_tol(at(&slow, 30).u, 3e-4, 1e-18);
    m = slope(-3, 1, 0, 1);
    m.law = SPEED_CONSTANT;
    refused(&m, ERR_SCENE, "motion.law");
    m.law = SPEED_AUTO, m.to[0] = m.from[0], m.to[1] = m.from[1];
    refused(&m, ERR_SCENE, "motion.to must differ");
}
END_TEST

/* A stop in the last places before `to`, and arriving there all but at rest: no NAN, no u beyond the way. */
START_TEST(just_so)
{
    srand48(2);
    for (int i = 0; i < 20000; i++) {
        double length = between(0.1, 3), degrees = between(0.5, 20);
        struct motion m = slope(degrees, 1, 0, length);
        double x = m.to[0] - m.from[0], y = m.to[1] - m.from[1];
        m.start_speed = sqrt(2 * 9.80665 * sin(m.incline) * sqrt(x * x + y * y)) * (1 + (i % 9 - 4) * 1.2e-16);
        struct trajectory tr = made(&m);
        struct state end = at(&tr, tr.duration), stop = at(&tr, m.start_speed / (9.80665 * sin(m.incline)));
        ck_assert_double_eq_tol(stop.u, length, 1e-14);
        ck_assert_double_eq_tol(stop.v, 0, 2e-7);
        ck_assert(end.u >= 0 && end.u <= tr.reach[1] && tr.reach[1] <= tr.length);
    }
}
END_TEST

/* What the rules say beforehand is what the motion then does. */
START_TEST(rules_agree)
{
    srand48(3);
    for (int i = 0; i < 500; i++) {
        struct motion m = any_slope(20, i % 4 ? 0.2 : 0);
        m.start_speed *= i % 3 != 0;
        struct incline c = motion_incline(&m);
        if (c.over == INCLINE_STUCK) continue;
        if (i % 5 == 0) m.duration = c.over == INCLINE_RESTS ? between(0.5, 2) * c.end : between(0.1, 1) * c.end;
        struct trajectory tr = made(&m);
        ck_assert(motion_rests(&m, false) == tr.starts_at_rest && motion_rests(&m, true) == tr.ends_at_rest);
        ck_assert_double_eq_tol(motion_speed(&m) / tr.mean_speed, 1, 1e-12);
        ck_assert(motion_straight(&m) && motion_law(&m) == SPEED_AUTO);
    }
    struct contact c = {.motion = slope(-3, 0, 0, 1),
                        .load = {.constant = NAN, .approach = NAN, .release = NAN},
                        .scraper = {.mass = 0.5}};
    c.contact.gravity = 10;
    static const int models[] = {CONTACT_SCRAPE, CONTACT_ROLL, CONTACT_ROLL_COUPLED, CONTACT_STRIKE};
    for (int i = 0; i < 4; i++) {
        c.contact.model = models[i];
        for (int drop = 0; drop < 2; drop++) { /* a ball presses where it is at rest too, unless it is dropped */
            c.load.falls = drop;
            ck_assert(load_approach(&c, false) == (i == 1 || (i == 2 && !drop) ? 5e-3 : 0));
            ck_assert(load_approach(&c, true) == (i < 3 ? 5e-3 : 0));
        }
    }
    ck_assert_double_eq_tol(load_constant(&c), 5 * cos(M_PI / 60), 1e-15);
    c.load.constant = 7;
    ck_assert(load_constant(&c) == 7);
}
END_TEST

UNIT("incline", up_and_down, down_from_rest, level, against_small_steps, back_with_friction, durations, refusals,
     just_so, rules_agree)
