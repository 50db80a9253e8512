/* trajectory, straight motions: positions, velocities and accelerations against the closed forms in long double (64-bit
   mantissa), derivatives against finite differences of the level below, turning points against the sign of the
   velocity. Curved ones: test_path.c, test_speed.c, test_recorded.c.

   Tolerances. What is fed to sin and cos is 2 r t half turns, one product, rounded to 2^-53 of itself: after r t cycles
   the phase is off by at most 2 pi r t 2^-53 rad. Beside that come a few roundings: 1e-15 of the largest value. For
   rates that are powers of two the product is exact and hours are as good as milliseconds. */
#include "motions.h"
#include "stage.h"
#include "trajectory/motion.h"

#define PI_L 3.141592653589793238462643383279502884L

static struct motion harmonic_motion(double rate, double duration)
{
    return (struct motion){.path = PATH_BACK_AND_FORTH,
                           .from = {between(-1, 1), between(-1, 1)},
                           .to = {between(-1, 1), between(-1, 1)},
                           .rate = rate,
                           .duration = duration,
                           .speed = NAN};
}

static struct motion line_motion(int law, double distance, double duration)
{
    double angle = between(0, 6.28);
    return (struct motion){.path = PATH_LINE,
                           .law = law,
                           .to = {distance * cos(angle), distance * sin(angle)},
                           .duration = duration,
                           .speed = NAN,
                           .rate = NAN};
}

/* Largest differences from the closed form, as parts of the length, the top speed and the largest acceleration. */
static void check_harmonic(const struct trajectory *tr, double rate, double t, double tolerance)
{
    long double amplitude = tr->length / 2.0L, omega = 2 * PI_L * rate,
                phase = fmodl((long double)rate * t, 1) * 2 * PI_L;
    struct state s = at(tr, t);
    ck_assert_double_le((double)fabsl(s.u - amplitude * (1 - cosl(phase))), tolerance * tr->length);
    ck_assert_double_le((double)fabsl(s.v - amplitude * omega * sinl(phase)), tolerance * (double)(amplitude * omega));
    ck_assert_double_le((double)fabsl(s.a - amplitude * omega * omega * cosl(phase)),
                        tolerance * (double)(amplitude * omega * omega));
}

/* Up to 1400 cycles every figure is within 1e-12: of its largest value, and position within 1e-12 m. */
START_TEST(harmonic_is_closed_form)
{
    srand48(1);
    for (int i = 0; i < 20000; i++) {
        struct motion m = harmonic_motion(pow(10, between(-3, 2)), 36000);
        struct trajectory tr = made(&m);
        double t = between(0, fmin(36000, 1400 / m.rate)), bound = 1e-15 + 6.2832 * m.rate * t * 0x1p-53;
        ck_assert_double_le(bound, 1e-12);
        check_harmonic(&tr, m.rate, t, bound);
        double u;
        trajectory_at(&tr, 1, &t, (struct trajectory_out){.u = &u});
        long double want = tr.length / 2.0L * (1 - cosl(2 * PI_L * fmodl((long double)m.rate * t, 1)));
        ck_assert_double_le((double)fabsl(u - want), 1e-12);
    }
}
END_TEST

START_TEST(harmonic_after_hours)
{
    srand48(2);
    for (int i = 0; i < 20000; i++) {
        double rate = pow(10, between(-3, 2)), t = between(3600, 36000);
        struct motion any = harmonic_motion(rate, 36000), exact = harmonic_motion(exp2(floor(log2(rate))), 36000);
        struct trajectory tr = made(&any), dyadic = made(&exact);
        check_harmonic(&tr, any.rate, t, 1e-15 + 6.2832 * rate * t * 0x1p-53);
        check_harmonic(&dyadic, exact.rate, t, 1.5e-15);
    }
}
END_TEST

/* The instants at which rounding could slip: ends, turns, smallest steps beside them. */
START_TEST(harmonic_at_extremes)
{
    struct motion m = {
        .path = PATH_BACK_AND_FORTH, .from = {0.03, 0.02}, .to = {0.075, 0.02}, .rate = 2, .duration = 10};
    struct trajectory tr = made(&m);
    double omega = 4 * M_PI, a0 = tr.length / 2 * omega * omega;
    for (int k = 0; k <= 40; k++) {
        double t = 0.25 * k, side = k % 2 ? 1 : -1;
        struct state s = at(&tr, t);
        ck_assert_double_eq(s.u, k % 2 ? tr.length : 0);
        ck_assert_double_eq(s.v, 0);
        ck_assert_double_eq_tol(s.a, -side * a0, 1e-15 * a0);
        check_harmonic(&tr, 2, nextafter(t, 0), 1e-15);
        check_harmonic(&tr, 2, nextafter(t, 10), 1e-15);
        check_harmonic(&tr, 2, fmin(t + 0x1p-1074, 10), 1e-15);
        check_harmonic(&tr, 2, fmin(t + 0.125, 10), 1e-15);
    }
}
END_TEST

/* The polynomial's terms reach 10 and 15 while it is 1: a few roundings of those, 4e-15. */
START_TEST(lines_are_closed_forms)
{
    srand48(3);
    for (int i = 0; i < 20000; i++) {
        double distance = pow(10, between(-5, 1.5)), duration = pow(10, between(-3, 4.55));
        double share = i % 4 == 0 ? pow(10, between(-12, 0)) : i % 4 == 1 ? 1 - pow(10, between(-12, 0)) : drand48();
        struct motion m = line_motion(SPEED_MINIMUM_JERK, distance, duration);
        struct trajectory jerk = made(&m);
        m.law = SPEED_CONSTANT;
        struct trajectory even = made(&m);
        double t = share * duration;
        long double d = jerk.length, q = (long double)t / duration, v = d / duration, r = 1 - q;
        struct state s = at(&jerk, t);
        ck_assert_double_eq_tol((double)(s.u - d * q * q * q * (10 - 15 * q + 6 * q * q)), 0,
                                fmin(1e-12, 4e-15 * (double)d));
        ck_assert_double_eq_tol((double)(s.v - 30 * v * q * q * r * r), 0, 1e-15 * jerk.top_speed);
        ck_assert_double_eq_tol((double)(s.a - 60 * v / duration * q * r * (1 - 2 * q)), 0,
                                1e-14 * (double)(v / duration));
        s = at(&even, t);
        ck_assert_double_eq_tol((double)(s.u - d * q), 0, fmin(1e-12, 5e-16 * (double)d));
        ck_assert_double_eq_tol((double)(s.v - v), 0, 5e-16 * (double)v);
        ck_assert_double_eq(s.a, 0);
    }
}
END_TEST

/* In the beginning of a minimum-jerk stroke u ~ 10 d q^3 and v ~ 30 d q^2 / T hold to the last digits, relatively. */
START_TEST(jerk_begins_softly)
{
    struct motion m = line_motion(SPEED_MINIMUM_JERK, 0.2, 0.7);
    struct trajectory tr = made(&m);
    for (double t = 1e-9; t < 0.6; t *= 3) {
        long double d = tr.length, q = (long double)t / 0.7, r = 1 - q;
        struct state s = at(&tr, t);
        ck_assert_double_eq_tol((double)(s.u / (d * q * q * q * (10 - 15 * q + 6 * q * q))), 1, 1e-14);
        ck_assert_double_eq_tol((double)(s.v / (30 * d / 0.7 * q * q * r * r)), 1, 1e-14);
    }
}
END_TEST

/* (4 D(h/2) - D(h)) / 3 of central differences D: the error is h^4 f^(5) / 480, and rounding 3e-16 f / h. */
static double slope_of(const struct trajectory *tr, double t, double h, int level)
{
    double d[2];
    for (int k = 0; k < 2; k++, h /= 2) {
        struct state hi = at(tr, t + h), lo = at(tr, t - h);
        d[k] = level == 0 ? (hi.u - lo.u) / (2 * h) : (hi.v - lo.v) / (2 * h);
    }
    return (4 * d[1] - d[0]) / 3;
}

static void check_derivatives(const struct trajectory *tr, double most, double h)
{
    for (int i = 0; i < 5000; i++) {
        double t = between(h, tr->duration - h);
        struct state s = at(tr, t);
        ck_assert_double_eq_tol(slope_of(tr, t, h, 0), s.v, 2e-10 * tr->top_speed);
        ck_assert_double_eq_tol(slope_of(tr, t, h, 1), s.a, 2e-10 * most);
    }
}

START_TEST(derivatives_agree)
{
    srand48(4);
    struct motion m = harmonic_motion(2.3, 3);
    struct trajectory tr = made(&m);
    double omega = 2 * M_PI * 2.3;
    check_derivatives(&tr, tr.length / 2 * omega * omega, 1e-2 / omega);
    m = line_motion(SPEED_MINIMUM_JERK, 0.3, 1.7);
    tr = made(&m);
    check_derivatives(&tr, 10 / sqrt(3) * 0.3 / (1.7 * 1.7), 1e-3 * 1.7);
    m.law = SPEED_CONSTANT;
    tr = made(&m);
    check_derivatives(&tr, tr.top_speed, 1e-2 * 1.7);
}
END_TEST

START_TEST(ends_hold)
{
    struct motion motions[] = {harmonic_motion(1.3, 2.9), line_motion(SPEED_CONSTANT, 0.1, 0.6),
                               line_motion(SPEED_MINIMUM_JERK, 0.1, 0.6)};
    for (int i = 0; i < 3; i++) {
        struct trajectory tr = made(&motions[i]);
        struct state first = at(&tr, 0), last = at(&tr, tr.duration);
        double before[] = {-1e-300, -1, -1e9, -HUGE_VAL}, after[] = {nextafter(tr.duration, 9), 100, 1e9, HUGE_VAL};
        for (int k = 0; k < 4; k++) {
            struct state b = at(&tr, before[k]), e = at(&tr, after[k]);
            ck_assert(b.u == first.u && b.v == first.v && b.a == first.a);
            ck_assert(e.u == last.u && e.v == last.v && e.a == last.a);
        }
        ck_assert_double_eq(first.u, 0);
        if (i > 0) ck_assert_double_eq(last.u, tr.length);
    }
}
END_TEST

START_TEST(made_from_motion)
{
    struct motion m = {.path = PATH_LINE, .from = {0.03, -0.02}, .to = {0.06, -0.06}, .speed = 0.25, .duration = NAN};
    struct trajectory tr = made(&m);
    ck_assert_double_eq_tol(tr.length, 0.05, 1e-17);
    ck_assert_double_eq_tol(tr.duration, 0.2, 1e-16);
    ck_assert_double_eq_tol(tr.e[0], 0.6, 2e-16);
    ck_assert_double_eq_tol(tr.e[1], -0.8, 2e-16);
    ck_assert(tr.from[0] == 0.03 && tr.from[1] == -0.02);
    m.law = SPEED_MINIMUM_JERK; /* the speed given is the mean speed */
    tr = made(&m);
    ck_assert_double_eq_tol(at(&tr, 0.2).u, 0.05, 1e-17);
}
END_TEST

/* Any number of instants, any outputs left out, in place of the instants: as one by one. */
START_TEST(many_as_one)
{
    enum { N = 1000 };
    static double t[N], u[N + 1], v[N + 1], a[N + 1], only[N + 1];
    struct motion motions[] = {harmonic_motion(3.7, 2), line_motion(SPEED_CONSTANT, 0.1, 2),
                               line_motion(SPEED_MINIMUM_JERK, 0.1, 2)};
    srand48(5);
    for (int i = 0; i < N; i++)
        t[i] = between(-0.1, 2.1);
    for (int k = 0; k < 3; k++)
        for (int n = 0; n <= N; n += n < 3 || n > 250 ? 1 : 83) {
            struct trajectory tr = made(&motions[k]);
            u[n] = v[n] = a[n] = only[n] = 77;
            trajectory_at(&tr, (size_t)n, t, (struct trajectory_out){.u = u, .du = v, .ddu = a});
            for (int out = 0; out < 3; out++) {
                trajectory_at(&tr, (size_t)n, t,
                              (struct trajectory_out){.u = out == 0 ? only : NULL,
                                                      .du = out == 1 ? only : NULL,
                                                      .ddu = out == 2 ? only : NULL});
                ck_assert_mem_eq(only, out == 0 ? u : out == 1 ? v : a, (size_t)n * sizeof *u);
            }
            ck_assert(u[n] == 77 && v[n] == 77 && a[n] == 77 && only[n] == 77);
            for (int i = n > 3 ? n - 3 : 0; i < n; i++) {
                struct state s = at(&tr, t[i]);
                ck_assert(s.u == u[i] && s.v == v[i] && s.a == a[i]);
            }
            if (n == N) break;
        }
}
END_TEST

/* Intervals of a motion laid end to end find each turn once, where the velocity changes sign and no place else. */
START_TEST(turns_where_velocity_does)
{
    srand48(6);
    for (int i = 0; i < 300; i++) {
        double rate = pow(10, between(-1, 2)), duration = between(0.1, 20) / rate, step = between(0.001, 0.45) / rate;
        struct motion m = harmonic_motion(rate, duration);
        struct trajectory tr = made(&m);
        int found = 0;
        for (double t = 0; t < duration; t += step) {
            double end = fmin(t + step, duration), turn = trajectory_turning(&tr, t, end), before = at(&tr, t).v,
                   after = at(&tr, end).v;
            if (isnan(turn)) {
                ck_assert_double_ge(before * after, -1e-12 * tr.top_speed * tr.top_speed);
                continue;
            }
            found++;
            double beside = 1e-12 * duration + 1e-9 / rate;
            ck_assert(turn > t && turn < end);
            ck_assert_double_le(fabs(at(&tr, turn).v), 1e-12 * tr.top_speed);
            ck_assert_double_lt(at(&tr, turn - beside).v * at(&tr, turn + beside).v,
                                turn + beside < duration ? 0 : HUGE_VAL);
        }
        int turns = (int)ceil(2 * rate * duration) - 1;
        ck_assert_int_eq(found, turns);
    }
}
END_TEST

START_TEST(turn_on_a_border)
{
    struct motion m = {.path = PATH_BACK_AND_FORTH, .to = {0.1, 0}, .rate = 2, .duration = 1};
    struct trajectory tr = made(&m);
    ck_assert_double_eq(trajectory_turning(&tr, 0.2, 0.3), 0.25);
    ck_assert(isnan(trajectory_turning(&tr, 0.25, 0.3))); /* open interval: the two sides of a turn are two stretches */
    ck_assert(isnan(trajectory_turning(&tr, 0.2, 0.25)));
    ck_assert(isnan(trajectory_turning(&tr, 0.9, 1.0)));
    ck_assert(isnan(trajectory_turning(&tr, 0.9, 1.1))); /* the end is no turn: nothing moves after it */
    srand48(7);
    for (int k = 1; k < 2000; k++) { /* however 2 r t is rounded */
        m.rate = pow(10, between(-1, 2)), m.duration = 10000;
        tr = made(&m);
        double turn = k / (2 * m.rate);
        ck_assert(isnan(trajectory_turning(&tr, turn, turn + 0.1 / m.rate)));
        ck_assert(isnan(trajectory_turning(&tr, turn - 0.1 / m.rate, turn)));
        ck_assert_double_eq(trajectory_turning(&tr, turn - 0.1 / m.rate, turn + 0.1 / m.rate), turn);
    }
    m.path = PATH_LINE;
    tr = made(&m);
    ck_assert(isnan(trajectory_turning(&tr, 0, 1)));
}
END_TEST

START_TEST(top_speed_is_the_top)
{
    struct motion motions[] = {harmonic_motion(1.25, 2), line_motion(SPEED_CONSTANT, 0.1, 2),
                               line_motion(SPEED_MINIMUM_JERK, 0.1, 2)};
    for (int k = 0; k < 3; k++) {
        struct trajectory tr = made(&motions[k]);
        double top = 0;
        for (int i = 0; i <= 40000; i++)
            top = fmax(top, fabs(at(&tr, i / 20000.0).v));
        ck_assert_double_eq_tol(top, tr.top_speed, 1e-15 * top);
    }
}
END_TEST

/* Inside it is the motion; outside the same formula goes on: a cosine, a straight line, a fifth-order polynomial (long
 * double). */
START_TEST(test_continued)
{
    struct motion m = {.path = PATH_BACK_AND_FORTH, .to = {0.06, 0}, .rate = 3, .duration = 0.4, .speed = NAN};
    for (int k = 0; k < 3; k++) {
        m.path = k == 0 ? PATH_BACK_AND_FORTH : PATH_LINE;
        m.law = k == 2 ? SPEED_MINIMUM_JERK : SPEED_AUTO;
        struct trajectory tr = made(&m);
        for (int i = -50; i <= 150; i++) {
            double t = 0.004 * i, u;
            long double q = (long double)t / 0.4L,
                        want = k == 0   ? 0.03L * (1 - cosl(2 * 3.14159265358979323846264L * 3 * t))
                               : k == 1 ? 0.06L * q
                                        : 0.06L * q * q * q * (10 + q * (-15 + 6 * q));
            double place[2];
            trajectory_continued(&tr, t, place);
            ck_assert_double_eq_tol(place[0], (double)want, 1e-13);
            ck_assert_double_eq(place[1], 0);
            trajectory_at(&tr, 1, &t, (struct trajectory_out){.u = &u});
            if (i >= 0 && i <= 100) ck_assert_double_eq_tol(place[0], u, 1e-15);
        }
    }
}
END_TEST

/* One place, at rest, for as long as is asked; any instant, also before and after; the rules and the figures of the
 * whole say so. */
START_TEST(still_stays)
{
    struct motion m = {
        .path = PATH_STILL, .at = {0.12, -0.037}, .to = {NAN, NAN}, .rate = NAN, .speed = NAN, .duration = 2.5};
    struct trajectory tr = made(&m);
    for (double t = -1; t < 4; t += 0.01) {
        struct state s = at(&tr, t);
        double place[2];
        trajectory_continued(&tr, t, place);
        for (int xy = 0; xy < 2; xy++) {
            ck_assert(s.p[xy] == m.at[xy] && place[xy] == m.at[xy] && s.vel[xy] == 0 && s.acc[xy] == 0);
            ck_assert(tr.box[0][xy] == m.at[xy] && tr.box[1][xy] == m.at[xy] && tr.reach[xy] == 0);
        }
        ck_assert(s.u == 0 && s.v == 0 && s.a == 0);
        ck_assert(isnan(trajectory_turning(&tr, t, t + 0.02)));
    }
    ck_assert(tr.straight && tr.starts_at_rest && tr.ends_at_rest && tr.e[0] == 1 && tr.e[1] == 0);
    ck_assert(tr.length == 0 && tr.duration == 2.5 && tr.cycle == 2.5 && tr.top_speed == 0 && tr.mean_speed == 0 &&
              tr.detail > 0);
    ck_assert_int_eq(trajectory_frames(&tr, 48000), 120001);
    ck_assert(motion_straight(&m) && motion_rests(&m, false) && motion_rests(&m, true) && motion_speed(&m) == 0);
    m.duration = NAN;
    refused(&m, ERR_SCENE, "motion.duration must be given");
    m.duration = 1;
    for (m.law = SPEED_HARMONIC; m.law <= SPEED_TWO_THIRDS; m.law++)
        refused(&m, ERR_SCENE, "motion.law does not fit");
}
END_TEST

/* Broken off, a motion is as it was until then, bit for bit, and stays there; its surface is that of the whole. */
START_TEST(breaks_off)
{
    struct motion kinds[] = {
        harmonic_motion(2, 3),
        line_motion(SPEED_MINIMUM_JERK, 0.3, 3),
        {.path = PATH_CIRCLE, .radius = 0.1, .turns = 2, .duration = 3, .speed = NAN, .rate = NAN}};
    for (int i = 0; i < 3; i++) {
        struct motion part = kinds[i];
        part.until = 1.3;
        struct trajectory whole = made(&kinds[i]), cut = made(&part);
        ck_assert_double_eq(cut.duration, 1.3);
        ck_assert(!cut.ends_at_rest && !motion_rests(&part, true));
        ck_assert_double_eq(motion_lasts(&part), 1.3);
        ck_assert_mem_eq(cut.box, whole.box, sizeof cut.box);
        for (int k = 0; k < 100; k++) {
            struct state a = at(&whole, fmin(0.02 * k, 1.3)), b = at(&cut, 0.02 * k);
            ck_assert_mem_eq(&a, &b, sizeof a);
        }
        part.until = 10;
        ck_assert_double_eq(made(&part).duration, 3);
    }
}
END_TEST

extern const struct stage trajectory_stage;

/* Only what the board has is laid on it, at the sub-samples' instants, however the frames are cut. */
START_TEST(stage_lays_out_the_board)
{
    enum { FRAMES = 700, OVER = 3, ITEMS = 9 };
    static const enum item items[ITEMS] = {ITEM_POSITION, ITEM_VELOCITY, ITEM_ACCELERATION, ITEM_X, ITEM_Y,
                                           ITEM_VX,       ITEM_VY,       ITEM_AX,           ITEM_AY};
    static double x[ITEMS][FRAMES * OVER + 1];
    struct scene s = {.seed = 1};
    struct contact c = {.name = "rod",
                        .motion = {.path = PATH_CIRCLE, .radius = 0.05, .turns = 2, .duration = 0.6, .speed = NAN}};
    for (int left_out = 0; left_out < ITEMS; left_out++) {
        struct board b = {.over = OVER, .rate = 1000};
        for (int k = 0; k < ITEMS; k++)
            if (k != left_out) b.signals[items[k]] = (struct signal){.per_frame = OVER, .capacity = FRAMES, .x = x[k]};
        struct stage_run run = {
            .stage = &trajectory_stage, .contact = &c, .board = &b, .arena = motions_arena(), .scene = &s};
        struct err e = {0};
        memset(x, 0, sizeof x);
        ck_assert(trajectory_stage.open(&run, &e));
        ck_assert_int_eq(b.moving, 601);
        ck_assert(trajectory_stage.run(&run, 0, 1, &e) && trajectory_stage.run(&run, 1, 400, &e) &&
                  trajectory_stage.run(&run, 400, FRAMES, &e));
        for (int i = 0; i < FRAMES * OVER; i++) {
            struct state w = at(b.trajectory, (double)i / (1000 * OVER));
            const double want[ITEMS] = {w.u, w.v, w.a, w.p[0], w.p[1], w.vel[0], w.vel[1], w.acc[0], w.acc[1]};
            for (int k = 0; k < ITEMS; k++)
                ck_assert_double_eq(x[k][i], k == left_out ? 0 : want[k]);
        }
    }
    struct board b = {.over = OVER, .rate = 1000};
    struct stage_run run = {
        .stage = &trajectory_stage, .contact = &c, .board = &b, .arena = motions_arena(), .scene = &s};
    struct err e = {0};
    c.motion.turns = 0;
    ck_assert(!trajectory_stage.open(&run, &e) && strstr(e.text, "contact 'rod': motion.turns"));
}
END_TEST

UNIT("trajectory", still_stays, breaks_off, stage_lays_out_the_board, test_continued, harmonic_is_closed_form,
     harmonic_after_hours, harmonic_at_extremes, lines_are_closed_forms, jerk_begins_softly, derivatives_agree,
     ends_hold, made_from_motion, many_as_one, turns_where_velocity_does, turn_on_a_border, top_speed_is_the_top)
