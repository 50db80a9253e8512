/* load: papers/000 equations 8 and 9, worked out here in long double from the motion's numbers, at the ends of the
   stroke; any direction and motion; jamming; lift-off; the range that the stage finds, against a far finer grid and
   closed forms; recorded forces; approach and release. */
#include "trajectory/load.h"

#include <unistd.h>

#include "motions.h"
#include "stage.h"

extern const struct stage load_stage;

#define PI_L 3.141592653589793238462643383279502884L

/* A contact whose stroke runs along +x over `distance`, held by a hand on the side of the first end. */
static struct contact held(double distance, double rate, double angle, double friction)
{
    return (struct contact){
        .name = "rod",
        .scraper = {.mass = 0.02},
        .motion = {.path = PATH_BACK_AND_FORTH, .to = {distance, 0}, .rate = rate, .duration = 3, .speed = NAN},
        .grip = {.given = true, .angle = angle, .friction = friction},
        .load = {.constant = NAN, .approach = NAN, .release = NAN},
        .contact = {.gravity = 9.80665}};
}

static struct load_law law_of(const struct contact *c, const struct trajectory *tr)
{
    struct load_law l;
    struct err e = {0};
    ck_assert_msg(load_make(c, tr, motions_arena(), &l, &e), "%s", e.text);
    return l;
}

static double normal_at(const struct contact *c, double t)
{
    struct trajectory tr = made(&c->motion);
    struct load_law l = law_of(c, &tr);
    return load_of(&l, &tr, t);
}

/* Equation 8 (side = 1) or 9 (side = -1); L is the stroke's amplitude, half the distance. */
static long double paper(const struct contact *c, long double distance, int side)
{
    long double omega = 2 * PI_L * c->motion.rate, m = c->scraper.mass, t = tanl(c->grip.angle);
    return (m * c->contact.gravity + side * omega * omega * m * distance / 2 * t) / (1 - c->grip.friction * t);
}

/* The two terms of equation 9 cancel, so that it is held to 1e-12 of equation 8. The half period lies in the range in
   which its rounding moves the phase by less than 1e-15. */
START_TEST(ends_are_the_papers)
{
    srand48(1);
    for (int i = 0; i < 10000; i++) {
        double distance = between(0.001, 0.5), angle = between(0, 1.4),
               friction = between(0, 0.99) / fmax(tan(angle), 0.01);
        struct contact c = held(distance, pow(10, between(-0.7, 1)), angle, friction);
        double most = (double)paper(&c, distance, 1);
        if (friction * tan(angle) > 0.9) /* nearer to jamming, the denominator's rounding shows: 1e-16 / (1 - mu tan) */
            continue;
        ck_assert_double_eq_tol(normal_at(&c, 0) / most, 1, 1e-12);
        ck_assert_double_eq_tol((normal_at(&c, 0.5 / c.motion.rate) - (double)paper(&c, distance, -1)) / most, 0,
                                1e-12);
        double still = c.scraper.mass * c.contact.gravity / (1 - friction * tan(angle));
        ck_assert_double_eq_tol(normal_at(&c, 0.25 / c.motion.rate) / most, still / most, 1e-12);
    }
}
END_TEST

/* The paper's kind of numbers, worked out in Python: 20 g, 2 Hz over 4.5 cm, 30 degrees, mu = 0.3, far from lift-off.
 */
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
    struct trajectory tr = made(&c.motion);
    struct load_law l;
    struct err e = {0};
    bool ok = load_make(&c, &tr, motions_arena(), &l, &e);
    ck_assert_int_eq(e.kind, ok ? ERR_NONE : ERR_SCENE);
    if (!ok)
        ck_assert_msg(strstr(e.text, "jams") && strstr(e.text, "rod") && strstr(e.text, "grip.angle"), "%s", e.text);
    return !ok;
}

START_TEST(jamming)
{
    ck_assert(jams(0.999, M_PI / 4)); /* however tan 45 degrees is rounded */
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
    struct trajectory tr = made(&c->motion);
    struct board board = {.trajectory = &tr};
    struct stage_run run = {.stage = &load_stage, .contact = c, .board = &board, .arena = motions_arena()};
    struct err e = {0};
    ck_assert_msg(load_stage.open(&run, &e), "%s", e.text);
    return *board.load;
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

/* Largest acceleration of a minimum-jerk stroke: 10 / sqrt(3) d / T^2 at q = (3 - sqrt 3) / 6; between instants of the
 * scan. */
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
        ck_assert_double_eq_tol(l.most, still + swing, 1e-14 * (still + swing));
        ck_assert_double_eq_tol(l.least, fmax(still - swing, 0), 1e-14 * (still + swing));
    }
}
END_TEST

/* Motions of any kind and length, against 2^18 instants: never narrower, and wider only by what lies between two of
 * them. */
START_TEST(range_of_any_motion)
{
    static const double bends[] = {0, 0, 0.05, 0.02, 0.06, -0.04, 0.0, -0.03, -0.02, 0.05};
    srand48(4);
    for (int i = 0; i < 36; i++) {
        struct contact c = held(between(0.01, 0.1), 2, 0.6, 0.3);
        c.motion.duration = between(0.5, 1.1) * (i % 6 == 0 ? 0.5 : 2);
        c.motion.path = (int[]){PATH_BACK_AND_FORTH, PATH_CIRCLE,   PATH_SCRIBBLE,
                                PATH_SPLINE,         PATH_POLYLINE, PATH_FOUR_IN_LINE}[i % 6];
        c.motion.radius = 0.04, c.motion.turns = between(-3, 3), c.motion.size[0] = 0.06, c.motion.size[1] = 0.04,
        c.motion.strokes = 4;
        c.motion.points = bends, c.motion.n_points = 5, c.motion.straight = 0.1,
        c.motion.corner = i % 12 == 4 ? 0.006 : 0;
        c.grip.azimuth = between(0, 6.28);
        struct load_law l = opened(&c);
        struct trajectory tr = made(&c.motion);
        double least = HUGE_VAL, most = -HUGE_VAL, before = NAN, leap = 0;
        for (int k = 0; k <= 1 << 18; k++) {
            double n = load_of(&l, &tr, c.motion.duration * k / (1 << 18));
            if (k > 0 && fabs(n - before) > leap && fabs(n - before) < 0.01 * (most - least)) leap = fabs(n - before);
            least = fmin(least, n), most = fmax(most, n), before = n;
        }
        ck_assert_double_le(l.least, fmax(least, 0) + 1e-14);
        ck_assert_double_ge(l.most, fmax(most, 0) - 1e-14);
        ck_assert_double_ge(l.least, fmax(least - leap, 0));
        ck_assert_double_le(l.most, fmax(most, 0) + leap);
    }
}
END_TEST

/* Round a circle at constant speed v: N = (m g + m tan theta v^2 / r cos(angle from the outward direction + 180
 * degrees)) / (1 - mu tan theta). */
START_TEST(on_a_circle)
{
    struct contact c = held(0, NAN, 0.5, 0.3);
    c.motion.path = PATH_CIRCLE, c.motion.radius = 0.05, c.motion.turns = 3, c.motion.duration = 2;
    c.grip.azimuth = 0.9;
    double v = 3 * 2 * M_PI * 0.05 / 2, slip = 1 - 0.3 * tan(0.5), still = 0.02 * 9.80665 / slip,
           swing = 0.02 * tan(0.5) * v * v / 0.05 / slip;
    for (int i = 0; i <= 500; i++) {
        double t = 2 * (i / 500.0);
        ck_assert_double_eq_tol(normal_at(&c, t), still - swing * cos(3 * M_PI * t - 0.9), 1e-12 * still);
    }
    struct load_law l = opened(&c);
    ck_assert_double_eq_tol(l.most, still + swing, 1e-13);
    ck_assert_double_eq_tol(l.least, still - swing, 1e-13);
    ck_assert_double_ge(swing, 0.05); /* it does vary */
}
END_TEST

START_TEST(without_grip)
{
    struct contact c = held(0.05, 2, 0.5, 0.3);
    struct trajectory tr = made(&c.motion);
    c.grip.given = false;
    ck_assert(!load_varies(&c));
    struct load_law l = law_of(&c, &tr);
    double ax = 123, ay = -7, n;
    load_at(&l, 1, NULL, &ax, &ay, &n);
    ck_assert_double_eq(n, 0.02 * 9.80665);
    ck_assert(l.least == l.still && l.most == l.still);
    c.load.constant = 1.5;
    l = law_of(&c, &tr);
    load_at(&l, 1, NULL, NULL, NULL, &n);
    ck_assert_double_eq(n, 1.5);
    ck_assert(l.least == 1.5 && l.most == 1.5);
}
END_TEST

/* ------------------------------------------------------------------ recorded forces */

static const char *file_of(const char *text)
{
    static char name[40];
    strcpy(name, "/tmp/rasp_load_XXXXXX");
    int fd = mkstemp(name);
    ck_assert(fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text) && close(fd) == 0);
    return name;
}

/* A natural cubic spline through four evenly spaced points, by hand: second derivatives 0, b1, b2, 0 with 4 b1 + b2 = 6
   (y0 - 2 y1 + y2) / h^2 and b1 + 4 b2 = 6 (y1 - 2 y2 + y3) / h^2. */
START_TEST(recorded_by_hand)
{
    double y[] = {1, 3, -2, 0.5}, h = 1, r1 = 6 * (1 - 6 - 2), r2 = 6 * (3 + 4 + 0.5),
           b[4] = {0, (4 * r1 - r2) / 15, (4 * r2 - r1) / 15, 0};
    struct contact c = held(0.05, 2, 0.5, 0.3);
    c.grip.given = false;
    c.load.recorded = file_of("time_s,normal_force_n\n-0.5,1\n0.5,3\n1.5,-2\n2.5,0.5\n");
    c.motion.duration = 2.25;
    ck_assert(load_varies(&c));
    struct load_law l = opened(&c);
    unlink(c.load.recorded);
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int i = 0; i <= 225000; i++) {
        double t = i / 100000.0, x = t + 0.5, n;
        int k = x < 1 ? 0 : x < 2 ? 1 : 2;
        double q = x - k,
               want = y[k] * (1 - q) + y[k + 1] * q +
                      h * h / 6 * (((1 - q) * (1 - q) * (1 - q) - (1 - q)) * b[k] + (q * q * q - q) * b[k + 1]);
        load_at(&l, 1, &t, NULL, NULL, &n);
        ck_assert_double_eq_tol(n, want, 1e-14);
        least = fmin(least, n), most = fmax(most, n);
    }
    ck_assert_double_eq_tol(l.most, most, 1e-9);
    ck_assert(least < -2 && l.least == 0); /* lifted off */
    double beyond[2] = {-0.75, 2.75}, n[2];
    load_at(&l, 2, beyond, NULL, NULL, n);
    ck_assert(n[0] == 1 && n[1] == 0.5);
}
END_TEST

/* The times of a recorded force are those of the recorded motion; of any other motion they begin with the contact. */
START_TEST(recorded_clock)
{
    const char *file = file_of("time_s,x_m,y_m,normal_force_n\n10,0,0,1\n11,0.1,0,2\n12,0.2,0.1,3\n13,0.2,0.2,4\n");
    struct contact c = held(0.05, 2, 0.5, 0.3);
    c.grip.given = false;
    c.load.recorded = file;
    c.motion.duration = NAN, c.motion.path = PATH_RECORDED, c.motion.file = file, c.motion.cutoff = 0;
    ck_assert_double_eq_tol(normal_at(&c, 0.5), 1.5, 1e-15);
    struct load_law l = opened(&c);
    ck_assert(l.least == 1 && l.most == 4);
    struct trajectory tr;
    struct err e = {0};
    c.motion = held(0.05, 2, 0.5, 0.3).motion;
    ck_assert(trajectory_make(&c.motion, 1, motions_arena(), &tr, &e));
    ck_assert(!load_make(&c, &tr, motions_arena(), &l, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, "from 10 s to 13 s, but the motion lasts from 0 s to 3 s; it must cover the motion") !=
                      NULL,
                  "%s", e.text);
    unlink(file);
    e = (struct err){0};
    ck_assert(!load_make(&c, &tr, motions_arena(), &l, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
}
END_TEST

/* ------------------------------------------------------------------ approach and release */

/* Auto: 5 ms where the motion is at speed, none at rest; what the scene says otherwise. The rules say no less than what
 * it comes to. */
START_TEST(approaches)
{
    static const struct {
        int path, law;
        double rate, duration, approach, release, want[2];
    } all[] = {
        {PATH_LINE, SPEED_CONSTANT, 1, 1, NAN, NAN, {5e-3, 5e-3}},
        {PATH_LINE, SPEED_MINIMUM_JERK, 1, 1, NAN, NAN, {0, 0}},
        {PATH_LINE, SPEED_MINIMUM_JERK, 1, 1, 0.02, 0.1, {0.02, 0.1}},
        {PATH_LINE, SPEED_CONSTANT, 1, 1, 0, NAN, {0, 5e-3}},
        {PATH_BACK_AND_FORTH, SPEED_AUTO, 2, 1.5, NAN, NAN, {0, 0}},
        {PATH_BACK_AND_FORTH, SPEED_AUTO, 2, 1.6, NAN, NAN, {0, 5e-3}},
        {PATH_BACK_AND_FORTH, SPEED_AUTO, 3, 1.0 / 6, NAN, NAN, {0, 0}},
        {PATH_CIRCLE, SPEED_HARMONIC, 2, 1.6, NAN, NAN, {0, 0}},
        {PATH_CIRCLE, SPEED_AUTO, 2, 1.6, NAN, 1e-3, {5e-3, 1e-3}},
        {PATH_SCRIBBLE, SPEED_AUTO, 2, 1.6, NAN, NAN, {5e-3, 5e-3}},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        struct contact c = held(0.05, all[i].rate, 0.5, 0.3);
        c.motion.path = all[i].path, c.motion.law = all[i].law, c.motion.duration = all[i].duration;
        c.motion.radius = 0.1, c.motion.turns = 1, c.motion.size[0] = c.motion.size[1] = 0.1;
        c.load.approach = all[i].approach, c.load.release = all[i].release;
        struct load_law l = opened(&c);
        ck_assert_msg(l.approach == all[i].want[0] && l.release == all[i].want[1], "%zu: %g %g", i, l.approach,
                      l.release);
        ck_assert(load_approach(&c, false) >= l.approach && load_approach(&c, true) >= l.release);
    }
    struct contact c = held(0.05, 1, 0.5, 0.3); /* a table of speed that begins at rest: the rules cannot know */
    c.motion.path = PATH_LINE, c.motion.law = SPEED_GIVEN, c.motion.duration = NAN;
    c.motion.profile = file_of("time_s,speed_m_per_s\n0,0\n1,0.01\n");
    struct load_law l = opened(&c);
    ck_assert(l.approach == 0 && l.release == 5e-3 && load_approach(&c, false) == 5e-3);
    unlink(c.motion.profile);
}
END_TEST

START_TEST(lowered_is_a_jerk_step)
{
    struct contact c = held(0.05, NAN, 0.5, 0.3);
    c.motion.path = PATH_LINE, c.motion.law = SPEED_CONSTANT, c.motion.duration = 1, c.load.approach = 0.1,
    c.load.release = 0.25;
    struct load_law l = opened(&c);
    for (int i = -20; i <= 120; i++) {
        double t = i / 100.0, q = t < 0.1 ? t / 0.1 : t > 0.75 ? (1 - t) / 0.25 : 1;
        q = q < 0 ? 0 : q;
        ck_assert_double_eq_tol(load_lowered(&l, t), q * q * q * (10 - 15 * q + 6 * q * q), 1e-13);
    }
    c.load.release = 0.95;
    struct trajectory tr = made(&c.motion);
    struct err e = {0};
    ck_assert(!load_make(&c, &tr, motions_arena(), &l, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(
        strstr(e.text, "load.approach, 0.1 s, and load.release, 0.95 s, do not fit into the motion, which lasts 1 s"),
        "%s", e.text);
    c.load.approach = c.load.release = NAN, c.motion.duration = 9e-3;
    tr = made(&c.motion);
    e = (struct err){0};
    ck_assert(!load_make(&c, &tr, motions_arena(), &l, &e) && strstr(e.text, "0.005 s (auto), do not fit"));
    c.load.release = 4e-3;
    ck_assert(load_make(&c, &tr, motions_arena(), &l, &(struct err){0}));
}
END_TEST

/* ------------------------------------------------------------------ stages */

/* The stage fills its item with the law of the acceleration, lift-off (negative) kept, and touches nothing beside. */
START_TEST(stage_follows_the_acceleration)
{
    enum { FRAMES = 5, OVER = 3 };
    struct contact c = held(0.3, 5, 0.5, 0.3);
    struct trajectory tr = made(&c.motion);
    double a[FRAMES * OVER], n[FRAMES * OVER];
    struct board b = {.trajectory = &tr, .over = OVER, .rate = 100};
    b.signals[ITEM_ACCELERATION] = (struct signal){.per_frame = OVER, .first = 2, .capacity = FRAMES, .x = a};
    b.signals[ITEM_LOAD] = (struct signal){.per_frame = OVER, .first = 2, .capacity = FRAMES, .x = n};
    struct stage_run run = {.stage = &load_stage, .contact = &c, .board = &b, .arena = motions_arena()};
    struct err e = {0};
    for (int i = 0; i < FRAMES * OVER; i++)
        a[i] = 100 - 20 * i, n[i] = 77;
    ck_assert(load_stage.wanted(&c, NULL));
    ck_assert_uint_eq(load_stage.asks(&c, NULL), ITEM_BIT(ITEM_ACCELERATION));
    ck_assert(load_stage.open(&run, &e));
    ck_assert(load_stage.run(&run, 3, 6, &e));
    for (int i = 0; i < FRAMES * OVER; i++)
        ck_assert_double_eq_tol(
            n[i], i < OVER || i >= 4 * OVER ? 77 : b.load->still + b.load->per_acceleration[0] * a[i], 1e-15);
    ck_assert_double_lt(n[4 * OVER - 1], 0);
    c.grip.given = false;
    ck_assert(!load_stage.wanted(&c, NULL));
}
END_TEST

/* On a curve from both accelerations, which the motion laid there. */
START_TEST(stage_on_a_curve)
{
    enum { FRAMES = 600, OVER = 2 };
    static double x[FRAMES * OVER + 1], y[FRAMES * OVER + 1], n[FRAMES * OVER + 1];
    struct contact c = held(0, NAN, 0.5, 0.3);
    c.motion.path = PATH_CIRCLE, c.motion.radius = 0.05, c.motion.turns = 3, c.motion.duration = 0.5;
    struct trajectory tr = made(&c.motion);
    struct board b = {.trajectory = &tr, .over = OVER, .rate = 1000};
    b.signals[ITEM_AX] = (struct signal){.per_frame = OVER, .capacity = FRAMES, .x = x};
    b.signals[ITEM_AY] = (struct signal){.per_frame = OVER, .capacity = FRAMES, .x = y};
    b.signals[ITEM_LOAD] = (struct signal){.per_frame = OVER, .capacity = FRAMES, .x = n};
    struct stage_run run = {.stage = &load_stage, .contact = &c, .board = &b, .arena = motions_arena()};
    struct err e = {0};
    for (int i = 0; i < FRAMES * OVER; i++)
        x[i] = at(&tr, i / 2000.0).acc[0], y[i] = at(&tr, i / 2000.0).acc[1];
    ck_assert_uint_eq(load_stage.asks(&c, NULL), ITEM_BIT(ITEM_AX) | ITEM_BIT(ITEM_AY));
    ck_assert(load_stage.open(&run, &e) && load_stage.run(&run, 0, 400, &e) && load_stage.run(&run, 400, FRAMES, &e));
    for (int i = 0; i < FRAMES * OVER; i++)
        ck_assert_double_eq(n[i], load_of(b.load, &tr, i / 2000.0));
}
END_TEST

extern const struct stage approach_stage;

/* Each sub-interval's force times the share at its middle; blocks between approach and release are left alone. */
START_TEST(approach_scales_the_force)
{
    enum { FRAMES = 300, OVER = 4 };
    static double f[FRAMES * OVER], want[FRAMES * OVER];
    struct contact c = held(0.05, NAN, 0.5, 0.3);
    struct scene s = {.seed = 0};
    c.motion.path = PATH_LINE, c.motion.law = SPEED_CONSTANT, c.motion.duration = 0.25;
    c.load.approach = 0.05, c.load.release = 0.08;
    struct trajectory tr = made(&c.motion);
    struct board b = {.trajectory = &tr, .over = OVER, .rate = 1000};
    b.signals[ITEM_SUBFORCE] = (struct signal){.per_frame = OVER, .capacity = FRAMES, .x = f};
    struct stage_run run = {
        .stage = &approach_stage, .contact = &c, .board = &b, .arena = motions_arena(), .scene = &s};
    struct err e = {0};
    for (int i = 0; i < FRAMES * OVER; i++) {
        double t = (i + 0.5) / 4000, q = t < 0.05 ? t / 0.05 : t > 0.17 ? fmax((0.25 - t) / 0.08, 0) : 1;
        f[i] = 1 + i;
        want[i] = f[i] * (q * q * q * (10 - 15 * q + 6 * q * q));
    }
    ck_assert(approach_stage.wanted(&c, &s));
    ck_assert(approach_stage.open(&run, &e));
    for (int from = 0; from < FRAMES; from += 20)
        ck_assert(approach_stage.run(&run, from, from + 20, &e));
    for (int i = 0; i < FRAMES * OVER; i++)
        ck_assert_double_eq_tol(f[i], want[i], 1e-12 * (1 + i));
    c.load.approach = c.load.release = 0;
    ck_assert(!approach_stage.wanted(&c, &s));
    c.load.approach = c.load.release = NAN, c.motion.law = SPEED_MINIMUM_JERK;
    ck_assert(!approach_stage.wanted(&c, &s));
    c.motion.law = SPEED_CONSTANT;
    ck_assert(approach_stage.wanted(&c, &s));
}
END_TEST

UNIT("load", ends_are_the_papers, worked_example, azimuths, jamming, lift_off, range_of_harmonic, range_of_minimum_jerk,
     range_of_any_motion, on_a_circle, without_grip, recorded_by_hand, recorded_clock, approaches,
     lowered_is_a_jerk_step, stage_follows_the_acceleration, stage_on_a_curve, approach_scales_the_force)
