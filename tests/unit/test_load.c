/* load: papers/000 equations 8 and 9, worked out here in long double from the motion's numbers, at the ends of the stroke; any direction;
   jamming; lift-off; the range that the stage finds, against a far finer grid and closed forms. */
#include "trajectory/load.h"

#include "stage.h"
#include "unit.h"

extern const struct stage load_stage;

#define PI_L 3.141592653589793238462643383279502884L

static double between(double lo, double hi)
{
    return lo + (hi - lo) * drand48();
}

/* A contact whose stroke runs along +x over `distance`, held by a hand on the side of the first end. */
static struct contact held(double distance, double rate, double angle, double friction)
{
    return (struct contact){.name = "rod",
                            .scraper = {.mass = 0.02},
                            .motion = {.path = PATH_BACK_AND_FORTH, .to = {distance, 0}, .rate = rate, .duration = 3, .speed = NAN},
                            .grip = {.given = true, .angle = angle, .friction = friction},
                            .load = {.constant = NAN},
                            .contact = {.gravity = 9.80665}};
}

static double normal_at(const struct contact *c, double t)
{
    struct trajectory tr = trajectory_make(&c->motion);
    struct load_law l;
    struct err e = {0};
    double a;
    ck_assert_msg(load_make(c, &tr, &l, &e), "%s", e.text);
    trajectory_at(&tr, 1, &t, NULL, NULL, &a);
    return load_at(&l, a);
}

/* Equation 8 (side = 1) or 9 (side = -1); L is the stroke's amplitude, half the distance. */
static long double paper(const struct contact *c, long double distance, int side)
{
    long double omega = 2 * PI_L * c->motion.rate, m = c->scraper.mass, t = tanl(c->grip.angle);
    return (m * c->contact.gravity + side * omega * omega * m * distance / 2 * t) / (1 - c->grip.friction * t);
}

/* The two terms of equation 9 cancel, so that it is held to 1e-12 of equation 8. The half period lies in the range in which
   its rounding moves the phase by less than 1e-15. */
START_TEST(ends_are_the_papers)
{
    srand48(1);
    for (int i = 0; i < 10000; i++) {
        double distance = between(0.001, 0.5), angle = between(0, 1.4), friction = between(0, 0.99) / fmax(tan(angle), 0.01);
        struct contact c = held(distance, pow(10, between(-0.7, 1)), angle, friction);
        double most = (double)paper(&c, distance, 1);
        if (friction * tan(angle) > 0.9) /* nearer to jamming, the denominator's rounding shows: 1e-16 / (1 - mu tan) */
            continue;
        ck_assert_double_eq_tol(normal_at(&c, 0) / most, 1, 1e-12);
        ck_assert_double_eq_tol((normal_at(&c, 0.5 / c.motion.rate) - (double)paper(&c, distance, -1)) / most, 0, 1e-12);
        double still = c.scraper.mass * c.contact.gravity / (1 - friction * tan(angle));
        ck_assert_double_eq_tol(normal_at(&c, 0.25 / c.motion.rate) / most, still / most, 1e-12);
    }
}
END_TEST

/* The paper's kind of numbers, worked out in Python: 20 g, 2 Hz over 4.5 cm, 30 degrees, mu = 0.3, far from lift-off. */
START_TEST(worked_example)
{
    struct contact c = held(0.045, 2, M_PI / 6, 0.3);
    ck_assert_double_eq_tol(normal_at(&c, 0), 0.28684280652451, 1e-14);
    ck_assert_double_eq_tol(normal_at(&c, 0.25), 0.18759890915403, 1e-14);
}
END_TEST

START_TEST(azimuths)
{
    double distance = 0.06;
    struct contact c = held(distance, 2, 0.5, 0.3);
    double most = (double)paper(&c, distance, 1), least = (double)paper(&c, distance, -1);
    c.grip.azimuth = M_PI; /* the torso is beyond the other end */
    ck_assert_double_eq_tol(normal_at(&c, 0), least, 1e-12 * most);
    ck_assert_double_eq_tol(normal_at(&c, 0.25), most, 1e-12 * most);
    c.grip.azimuth = M_PI / 2; /* the stroke is across: nothing varies */
    for (double t = 0; t < 1; t += 0.01)
        ck_assert_double_eq_tol(normal_at(&c, t), (most + least) / 2, 1e-12 * most);
    for (double azimuth = -6; azimuth < 6; azimuth += 0.1) { /* in between, the acceleration's component */
        c.grip.azimuth = azimuth;
        ck_assert_double_eq_tol(normal_at(&c, 0), (most + least) / 2 + (most - least) / 2 * cos(azimuth), 1e-12 * most);
    }
    c.grip.azimuth = 0.7; /* stroke and hand turned together: as before */
    c.motion.to[0] = distance * cos(0.7);
    c.motion.to[1] = distance * sin(0.7);
    ck_assert_double_eq_tol(normal_at(&c, 0), most, 1e-12 * most);
}
END_TEST

static bool jams(double friction, double angle)
{
    struct contact c = held(0.05, 2, angle, friction);
    struct trajectory tr = trajectory_make(&c.motion);
    struct load_law l;
    struct err e = {0};
    bool ok = load_make(&c, &tr, &l, &e);
    ck_assert_int_eq(e.kind, ok ? ERR_NONE : ERR_SCENE);
    if (!ok)
        ck_assert_msg(strstr(e.text, "jams") && strstr(e.text, "rod") && strstr(e.text, "grip.angle"), "%s", e.text);
    return !ok;
}

START_TEST(jamming)
{
    ck_assert(jams(0.999, M_PI / 4));  /* however tan 45 degrees is rounded */
    ck_assert(!jams(0.998, M_PI / 4));
    for (double angle = 0.01; angle < 1.57; angle += 0.01) {
        ck_assert(jams(0.999 / tan(angle), angle));
        ck_assert(jams(1 / tan(angle), angle));
        ck_assert(jams(5 / tan(angle), angle));
        ck_assert(!jams(0.998 / tan(angle), angle));
        ck_assert(!jams(0.99899999 / tan(angle), angle));
    }
    ck_assert(!jams(10, 0));
    ck_assert(!jams(0, 1.57));
}
END_TEST

/* Omega^2 L tan theta = g, whatever m and mu: on one side of it the hand lifts the scraper off at the far end. */
START_TEST(lift_off)
{
    srand48(2);
    for (int i = 0; i < 1000; i++) {
        double distance = between(0.01, 0.5), angle = between(0.1, 1), g = 9.80665;
        double rate = sqrt(g / (distance / 2 * tan(angle))) / (2 * M_PI);
        struct contact below = held(distance, rate * (1 - 1e-9), angle, between(0, 0.3)), above = below;
        above.motion.rate = rate * (1 + 1e-9);
        below.scraper.mass = above.scraper.mass = pow(10, between(-4, 1));
        ck_assert_double_gt(normal_at(&below, 0.5 / below.motion.rate), 0);
        ck_assert_double_lt(normal_at(&above, 0.5 / above.motion.rate), 0);
    }
}
END_TEST

/* The law as the stage makes it, with its range. */
static struct load_law opened(const struct contact *c)
{
    struct trajectory tr = trajectory_make(&c->motion);
    struct board board = {.trajectory = &tr};
    struct stage_run run = {.stage = &load_stage, .contact = c, .board = &board, .arena = arena_open()};
    struct err e = {0};
    ck_assert_msg(load_stage.open(&run, &e), "%s", e.text);
    struct load_law l = *board.load;
    arena_close(run.arena);
    return l;
}

/* Harmonic over a cycle or more: the range is equations 9 and 8, and never below 0. */
START_TEST(range_of_harmonic)
{
    double distance = 0.045;
    struct contact c = held(distance, 2, M_PI / 6, 0.3);
    struct load_law l = opened(&c);
    ck_assert_double_eq_tol(l.most, (double)paper(&c, distance, 1), 1e-12);
    ck_assert_double_eq_tol(l.least, (double)paper(&c, distance, -1), 1e-12);
    ck_assert_double_gt(l.least, 0);
    c.motion.duration = 0.2; /* less than half a period: the far end is not reached */
    l = opened(&c);
    ck_assert_double_eq_tol(l.least, normal_at(&c, 0.2), 1e-12);
    c.motion.duration = 3, c.motion.rate = 6; /* lifts off */
    l = opened(&c);
    ck_assert_double_lt((double)paper(&c, distance, -1), 0);
    ck_assert_double_eq(l.least, 0);
    ck_assert_double_eq_tol(l.most, (double)paper(&c, distance, 1), 1e-12);
}
END_TEST

/* Largest acceleration of a minimum-jerk stroke: 10 / sqrt(3) d / T^2 at q = (3 - sqrt 3) / 6. */
START_TEST(range_of_minimum_jerk)
{
    srand48(3);
    for (int i = 0; i < 200; i++) {
        double distance = between(0.01, 0.3), duration = between(0.5, 3), angle = between(0.05, 0.4);
        struct contact c = held(distance, NAN, angle, between(0, 1));
        c.motion.path = PATH_LINE, c.motion.law = SPEED_MINIMUM_JERK, c.motion.duration = duration;
        struct load_law l = opened(&c);
        double slip = 1 - c.grip.friction * tan(angle), still = 0.02 * 9.80665 / slip;
        double swing = 0.02 * 10 / sqrt(3) * distance / (duration * duration) * tan(angle) / slip;
        ck_assert_double_le(l.most, (still + swing) * (1 + 1e-14));
        ck_assert_double_ge(l.most, still + swing - 1e-6 * 2 * swing);
        ck_assert_double_ge(l.least, fmax(still - swing, 0) - 1e-14 * still);
        ck_assert_double_le(l.least, fmax(still - swing + 1e-6 * 2 * swing, 0));
    }
}
END_TEST

/* Motions of any length, against 2^18 instants: within 1e-6 of the range, and never outside it. */
START_TEST(range_of_any_length)
{
    srand48(4);
    for (int i = 0; i < 30; i++) {
        struct contact c = held(between(0.01, 0.1), 2, 0.6, 0.3);
        c.motion.duration = between(0.01, 1.1) / 2;
        c.grip.azimuth = between(0, 6.28);
        struct load_law l = opened(&c);
        struct trajectory tr = trajectory_make(&c.motion);
        double least = HUGE_VAL, most = 0, a;
        for (int k = 0; k <= 1 << 18; k++) {
            double t = c.motion.duration * k / (1 << 18);
            trajectory_at(&tr, 1, &t, NULL, NULL, &a);
            least = fmin(least, fmax(load_at(&l, a), 0));
            most = fmax(most, fmax(load_at(&l, a), 0));
        }
        ck_assert_double_eq_tol(l.least, least, 1e-6 * (most - least) + 1e-15);
        ck_assert_double_eq_tol(l.most, most, 1e-6 * (most - least) + 1e-15);
    }
}
END_TEST

START_TEST(without_grip)
{
    struct contact c = held(0.05, 2, 0.5, 0.3);
    struct trajectory tr = trajectory_make(&c.motion);
    struct load_law l;
    struct err e = {0};
    c.grip.given = false;
    ck_assert(load_make(&c, &tr, &l, &e));
    ck_assert_double_eq(load_at(&l, 123), 0.02 * 9.80665);
    ck_assert(l.least == l.still && l.most == l.still);
    c.load.constant = 1.5;
    ck_assert(load_make(&c, &tr, &l, &e));
    ck_assert_double_eq(load_at(&l, -123), 1.5);
    ck_assert(l.least == 1.5 && l.most == 1.5);
}
END_TEST

/* The stage fills its item with the law of the acceleration, lift-off (negative) kept. */
START_TEST(stage_follows_the_acceleration)
{
    enum { FRAMES = 5, OVER = 3 };
    struct contact c = held(0.3, 5, 0.5, 0.3);
    struct trajectory tr = trajectory_make(&c.motion);
    double a[FRAMES * OVER], n[FRAMES * OVER];
    struct board b = {.trajectory = &tr, .over = OVER};
    b.signals[ITEM_ACCELERATION] = (struct signal){.per_frame = OVER, .first = 2, .capacity = FRAMES, .x = a};
    b.signals[ITEM_LOAD] = (struct signal){.per_frame = OVER, .first = 2, .capacity = FRAMES, .x = n};
    struct stage_run run = {.stage = &load_stage, .contact = &c, .board = &b, .arena = arena_open()};
    struct err e = {0};
    for (int i = 0; i < FRAMES * OVER; i++)
        a[i] = 100 - 20 * i, n[i] = 77;
    ck_assert(load_stage.wanted(&c, NULL));
    ck_assert(load_stage.open(&run, &e));
    ck_assert(load_stage.run(&run, 3, 6, &e));
    for (int i = 0; i < FRAMES * OVER; i++)
        ck_assert_double_eq(n[i], i < OVER || i >= 4 * OVER ? 77 : load_at(b.load, a[i]));
    ck_assert_double_lt(n[4 * OVER - 1], 0);
    arena_close(run.arena);
    c.grip.given = false;
    ck_assert(!load_stage.wanted(&c, NULL));
}
END_TEST

UNIT("load", ends_are_the_papers, worked_example, azimuths, jamming, lift_off, range_of_harmonic, range_of_minimum_jerk,
     range_of_any_length, without_grip, stage_follows_the_acceleration)
