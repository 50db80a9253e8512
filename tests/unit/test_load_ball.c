/* The normal force under a ball that is heavier on one side or not round: against the second derivative of its centre's
   height, which is worked out here in long double from equation 18 by bisection; closed forms of its least and greatest
   value at constant speed; its mean; every motion's range; the stage. */
#include <stddef.h>

#include "motions.h"
#include "stage.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"

extern const struct stage load_stage;

static struct contact ball(double radius, double offset)
{
    struct contact c = {.name = "marble",
                        .ball = {.radius = radius, .mass = 0.1, .body = BODY_SOLID, .wall = NAN, .offset = offset},
                        .motion = {.path = PATH_LINE, .to = {1, 0}, .speed = 0.5, .duration = NAN, .straight = 0.1},
                        .load = {.constant = NAN, .approach = NAN, .release = NAN},
                        .contact = {.model = CONTACT_ROLL, .gravity = 9.80665}};
    contact_derive(&c, NULL);
    return c;
}

static struct load_law law_of(const struct contact *c, const struct trajectory *tr)
{
    struct load_law l;
    struct err e = {0};
    ck_assert_msg(load_make(c, tr, motions_arena(), &l, &e), "%s", e.text);
    return l;
}

/* ------------------------------------------------------------------ against the height of the centre of mass */

static long double height(const struct contact *c, const struct trajectory *tr, double t)
{
    long double R = c->ball.radius, r = c->ball.offset,
                x = at(tr, t).u + R * c->ball.start_angle - r * sinl(c->ball.start_angle);
    long double low = (x - r) / R, high = (x + r) / R;
    for (int i = 0; i < 90; i++) {
        long double middle = (low + high) / 2;
        if (R * middle - r * sinl(middle) > x)
            high = middle;
        else
            low = middle;
    }
    return -r * cosl(low) + c->ball.lobe_height * cosl(c->ball.lobes * low);
}

/* Central difference of order 8 of the second derivative; u is known to 1e-16 m, so that at 0.25 ms what is left is
   about 1e-8 m/s^2, and less of the force's own high derivatives, at turns of 90 rad/s. */
static double height_lift(const struct contact *c, const struct trajectory *tr, double t, double h)
{
    static const long double w[] = {-205.0L / 72, 8.0L / 5, -1.0L / 5, 8.0L / 315, -1.0L / 560};
    long double sum = w[0] * height(c, tr, t);
    for (int k = 1; k <= 4; k++)
        sum += w[k] * (height(c, tr, t + k * h) + height(c, tr, t - k * h));
    return (double)(sum / ((long double)h * h));
}

static struct contact on(int i)
{
    struct contact c = ball(0.02, i % 2 ? 0.003 : 0.008);
    struct motion *m = &c.motion;
    c.ball.start_angle = i - 3;
    if (i % 6 < 2) /* up and down, with friction */
        *m = (struct motion){.path = PATH_INCLINE,
                             .to = {3, 0},
                             .speed = NAN,
                             .duration = NAN,
                             .incline = 0.1,
                             .start_speed = 1.1,
                             .rolling_friction = 0.02};
    else if (i % 6 < 4)
        *m = (struct motion){.path = PATH_BACK_AND_FORTH, .to = {0.3, 0.1}, .rate = 0.7, .speed = NAN, .duration = 2};
    else
        *m = (struct motion){
            .path = PATH_CIRCLE, .radius = 0.1, .turns = -2, .speed = NAN, .duration = 1.5, .law = SPEED_MINIMUM_JERK};
    contact_derive(&c, NULL);
    return c;
}

START_TEST(newton)
{
    for (int i = 0; i < 12; i++) {
        struct contact c = on(i);
        c.ball.lobe_height = i % 4 == 1 ? 3e-4 : 0, c.ball.lobes = 3;
        c.ball.offset = i == 5 ? 0 : c.ball.offset;
        struct trajectory tr = made(&c.motion);
        struct load_law l = law_of(&c, &tr);
        double still = 0.1 * contact_gravity(&c), turn = trajectory_turning(&tr, 0, tr.duration);
        ck_assert_double_eq_tol(still, 0.1 * 9.80665 * (i % 6 < 2 ? cos(0.1) : 1), 1e-15);
        for (double t = 0.01; t < tr.duration - 0.01; t += 0.00317) {
            if (i % 6 < 2 && fabs(t - turn) < 0.005) /* u'' jumps there */
                continue;
            ck_assert_double_eq_tol(load_of(&l, &tr, t), still + 0.1 * height_lift(&c, &tr, t, 2.5e-4), 1e-7);
        }
    }
}
END_TEST

/* ------------------------------------------------------------------ constant speed */

/* N = m g + m v^2 r (R cos theta - r) / (R - r cos theta)^3: greatest at the lowest place, least at the highest, or,
   from r = R / 3 on, at cos theta = (3 r^2 - R^2) / (2 R r). (The derivative of that fraction by cos theta vanishes
   there.) */
static double at_angle(const struct contact *c, double cosine)
{
    double R = c->ball.radius, r = c->ball.offset, v = c->motion.speed, lever = R - r * cosine;
    return c->scraper.mass * (c->contact.gravity + v * v * r * (R * cosine - r) / (lever * lever * lever));
}

START_TEST(range)
{
    srand48(1);
    for (int i = 0; i < 300; i++) {
        double R = between(0.01, 0.05), share = i % 50 == 0   ? 0.995
                                                : i % 10 == 0 ? between(0.5, 0.97)
                                                              : between(0, 0.5);
        struct contact c = ball(R, share * R);
        c.motion.speed = between(0.1, 2) * pow(1 - share, 1.5), c.ball.start_angle = between(-6, 6);
        c.motion.to[0] = 2 * M_PI * R * (i % 50 == 0 ? 1.3 : between(1, 40));
        struct trajectory tr = made(&c.motion);
        struct load_law l = law_of(&c, &tr);
        double r = c.ball.offset,
               least = r < R / 3 ? at_angle(&c, -1) : at_angle(&c, (3 * r * r - R * R) / (2 * R * r)),
               most = at_angle(&c, 1);
        ck_assert_double_eq_tol(l.most / most, 1, 1e-12);
        ck_assert_double_eq_tol((l.least - fmax(least, 0)) / most, 0, 1e-12);
        ck_assert(l.still == c.scraper.mass * 9.80665);
    }
    struct contact oval = ball(0.02, 0); /* m g +- m h n^2 v^2 / R^2: 30 turns of a thousand lobes, and of two */
    for (int k = 0; k < 2; k++) {
        oval.ball.lobes = k ? 2 : 1000, oval.ball.lobe_height = k ? 1e-3 : 1e-8, oval.motion.to[0] = 3.77;
        struct trajectory tr = made(&oval.motion);
        struct load_law l = law_of(&oval, &tr);
        double swing = 0.1 * oval.ball.lobe_height * pow(oval.ball.lobes * 0.5 / 0.02, 2);
        ck_assert_double_gt(swing, 0.05);
        ck_assert_double_eq_tol(l.most, 0.980665 + swing, 1e-12);
        ck_assert_double_eq_tol(l.least, 0.980665 - swing, 1e-12);
    }
    struct contact c = ball(0.02, 0.005); /* less than a turn, from the highest place on: the lowest is not reached */
    c.ball.start_angle = M_PI, c.motion.to[0] = 0.03;
    struct trajectory tr = made(&c.motion);
    struct load_law l = law_of(&c, &tr);
    ck_assert_double_eq_tol(l.least, at_angle(&c, -1), 1e-14);
    ck_assert_double_eq_tol(l.most, load_of(&l, &tr, tr.duration), 1e-12);
    ck_assert(l.most < 0.9 * at_angle(&c, 1));
}
END_TEST

/* Over whole turns the ball's momentum is what it was: the mean of N over time is m g, whatever the offset; hollow
   balls too. The sum over even instants of what repeats itself is exact to rounding. */
START_TEST(mean)
{
    enum { N = 100000 };
    static double n[N];
    for (int i = 0; i < 6; i++) {
        struct contact c = ball(0.02, 0.02 * (0.02 + 0.15 * i));
        c.ball.mass = NAN, c.ball.body = BODY_HOLLOW, c.ball.wall = 2e-3, c.ball.response.object.density = 2500;
        c.ball.start_angle = 1;
        c.motion.to[0] = 3 * 2 * M_PI * 0.02;
        contact_derive(&c, NULL);
        ck_assert_double_eq_tol(c.scraper.mass, 4.0 / 3 * M_PI * 2500 * (8e-6 - 5.832e-6), 1e-16);
        struct trajectory tr = made(&c.motion);
        struct load_law l = law_of(&c, &tr);
        double sum = 0, weight = c.scraper.mass * 9.80665;
        for (int k = 0; k < N; k++)
            sum += n[k] = load_of(&l, &tr, tr.duration * k / N);
        ck_assert_double_eq_tol(sum / N / weight, 1, 1e-12);
        ck_assert(l.most > 1.001 * weight && l.least < 0.999 * weight);
    }
}
END_TEST

/* ------------------------------------------------------------------ as printed */

/* load.phase: falling. N = m (g - w |w| r sin theta), w = v / (R - r cos theta), theta by bisection: greatest where the
   centre of mass moves downwards, also of a ball that rolls backwards; over an even turn of a small offset the swing is
   that of Newton's law, a quarter of a turn earlier. */
START_TEST(falling)
{
    for (int i = 0; i < 12; i++) {
        struct contact c = on(i);
        c.load.phase = LOAD_FALLING;
        struct trajectory tr = made(&c.motion);
        struct load_law l = law_of(&c, &tr);
        double still = 0.1 * contact_gravity(&c), most = 0, fall = 0;
        for (double t = 0.01; t < tr.duration - 0.01; t += 0.00317) {
            double h = 1e-5, climb = (double)((height(&c, &tr, t + h) - height(&c, &tr, t - h)) / (2 * h));
            double r = c.ball.offset, lever = c.ball.radius + (double)height(&c, &tr, t), w = at(&tr, t).v / lever;
            double n = load_of(&l, &tr, t);
            ck_assert_double_eq_tol(n, still - 0.1 * fabs(w) * climb, 2e-5 * (1 + fabs(w) * fabs(w) * r));
            if (n > most) most = n, fall = climb;
        }
        ck_assert_double_lt(fall, 0);
        ck_assert_double_le(most, l.most + 1e-12);
    }
    struct contact c = ball(0.02, 2e-6);
    c.motion.to[0] = 1.2566370614359172; /* ten turns */
    for (int way = 0; way < 2; way++) {
        c.load.phase = LOAD_LOWEST;
        struct trajectory tr = made(&c.motion);
        struct load_law lowest = law_of(&c, &tr), printed;
        c.load.phase = LOAD_FALLING;
        printed = law_of(&c, &tr);
        double quarter = 0.5 * M_PI * 0.02 / 0.5, swing = 0.1 * 2e-6 * 625;
        for (double t = quarter; t < tr.duration - quarter; t += 0.0037)
            ck_assert_double_eq_tol(load_of(&printed, &tr, t - quarter), load_of(&lowest, &tr, t), 1e-3 * swing);
        ck_assert_double_eq_tol(printed.most - printed.least, 2 * swing, 1e-3 * swing);
        c.ball.start_angle = 1;
    }
}
END_TEST

/* ------------------------------------------------------------------ any motion */

START_TEST(range_of_any_motion)
{
    static const double bends[] = {0, 0, 0.3, 0.1, 0.2, -0.4, 0.0, -0.3};
    srand48(2);
    for (int i = 0; i < 15; i++) {
        struct contact c = on(i % 12);
        c.ball.offset = c.ball.radius * between(0.05, 0.6);
        if (i % 5 == 1) /* 500 turns, of which one is fastest */
            c.motion = (struct motion){
                .path = PATH_LINE, .law = SPEED_MINIMUM_JERK, .to = {500 * 0.1256, 0}, .speed = 0.5, .duration = NAN};
        if (i % 5 == 0)
            c.motion = (struct motion){
                .path = PATH_SPLINE, .points = bends, .n_points = 4, .straight = 0.1, .speed = 0.6, .duration = NAN};
        if (i % 5 == 2) /* lobes that are most of it */
            c.ball.lobe_height = 1e-4, c.ball.lobes = 101;
        contact_derive(&c, NULL);
        c.load.phase = i % 4 == 3 ? LOAD_FALLING : LOAD_LOWEST;
        struct trajectory tr = made(&c.motion);
        struct load_law l = law_of(&c, &tr);
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (int k = 0; k <= 200000; k++) {
            double n = load_of(&l, &tr, tr.duration * k / 200000);
            least = fmin(least, n), most = fmax(most, n);
        }
        ck_assert_double_le(l.least, fmax(least, 0) + 1e-12);
        ck_assert_double_ge(l.most, most - 1e-12);
        double slack = i % 5 == 2 ? 3e-2 : 1e-3; /* what lies between two instants of the grid, 1/200 of a fast turn */
        ck_assert_double_ge(l.least, fmax(least, 0) - slack * most);
        ck_assert_double_le(l.most, most * (1 + slack));
    }
}
END_TEST

/* Thrown hard enough the ball leaves the ground at its highest place: v^2 r / (R + r)^2 = g. */
START_TEST(lifts_off)
{
    for (int k = 0; k < 2; k++) {
        struct contact c = ball(0.02, 0.004);
        c.motion.speed = sqrt(9.80665 / 0.004) * 0.024 * (k ? 1 + 1e-9 : 1 - 1e-9);
        struct trajectory tr = made(&c.motion);
        struct load_law l = law_of(&c, &tr);
        double highest = M_PI * 0.02 / c.motion.speed;
        ck_assert((load_of(&l, &tr, highest) < 0) == k && (l.least == 0) == k);
    }
}
END_TEST

/* ------------------------------------------------------------------ which contacts, and the stage */

START_TEST(varies)
{
    struct contact c = ball(0.02, 0.004);
    ck_assert(load_varies(&c) && load_stage.wanted(&c, NULL));
    c.contact.model = CONTACT_ROLL_COUPLED;
    ck_assert(!load_varies(&c));
    c.contact.model = CONTACT_SCRAPE;
    ck_assert(!load_varies(&c));
    c = ball(0.02, 0);
    ck_assert(!load_varies(&c));
    c.ball.lobe_height = 1e-6, c.ball.lobes = 2;
    ck_assert(load_varies(&c));
    c.load.no_lobes = true; /* there they are in rho */
    ck_assert(!load_varies(&c));
    c.ball.offset = 0.004;
    struct trajectory level = made(&c.motion);
    ck_assert(law_of(&c, &level).spin.lobe_height == 0 && law_of(&c, &level).turned > 0);
    c = ball(0.02, 0);
    c.motion.path = PATH_INCLINE, c.motion.incline = -0.3;
    contact_derive(&c, NULL);
    struct trajectory tr = made(&c.motion);
    struct load_law l = law_of(&c, &tr);
    ck_assert_double_eq_tol(l.still, 0.1 * 9.80665 * cos(0.3), 3e-16);
    ck_assert(l.least == l.still && l.most == l.still && l.turned == 0 && load_of(&l, &tr, 0.1) == l.still);
}
END_TEST

START_TEST(stage)
{
    enum { FRAMES = 500, OVER = 3 };
    static double u[FRAMES * OVER], v[FRAMES * OVER], a[FRAMES * OVER], n[FRAMES * OVER];
    struct contact c = on(0);
    struct trajectory tr = made(&c.motion);
    struct board b = {.trajectory = &tr, .over = OVER, .rate = 100};
    double *const items[] = {u, v, a, n};
    for (int k = 0; k < 4; k++)
        b.signals[k == 3 ? ITEM_LOAD : ITEM_POSITION + k] =
            (struct signal){.per_frame = OVER, .capacity = FRAMES, .x = items[k]};
    struct stage_run run = {.stage = &load_stage, .contact = &c, .board = &b, .arena = motions_arena()};
    struct err e = {0};
    for (int i = 0; i < FRAMES * OVER; i++) {
        struct state s = at(&tr, i / 300.0);
        u[i] = s.u, v[i] = s.v, a[i] = s.a;
    }
    ck_assert_uint_eq(load_stage.asks(&c, NULL),
                      ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_ACCELERATION));
    ck_assert(load_stage.open(&run, &e) && load_stage.run(&run, 0, 123, &e) && load_stage.run(&run, 123, FRAMES, &e));
    ck_assert(FRAMES / 100.0 > tr.duration);
    for (int i = 0; i < FRAMES * OVER; i++)
        ck_assert_double_eq(n[i], load_of(b.load, &tr, i / 300.0));
}
END_TEST

UNIT("load_ball", newton, falling, range, mean, range_of_any_motion, lifts_off, varies, stage)
