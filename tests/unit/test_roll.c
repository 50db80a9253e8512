/* The force of a ball that rolls, piece by piece against closed forms: its law, the height of its centre, its
   penetration at rest; and what it shares with the scraping force. */
#include <complex.h>
#include <gsl/gsl_integration.h>

#include "force/roll.h"
#include "rig.h"
#include "surface/profile.h"
#include "trajectory/trajectory.h"

static const char *const head =
    "rasp: 1\nseed: 5\noutput: {diagnostics: {}, sample_rate: 48000}\nload: {approach: 0, release: 0}\n";

static struct scene made(const char *rest)
{
    return rig_scene(rig_arena(), arena_format(rig_arena(), "%s%s", head, rest));
}

static struct relief_part *flat_part(struct arena *a, const struct contact *c)
{
    double z[4] = {0};
    (void)c;
    return profile_part(a, profile_from_samples(a, z, 4, 1e-5, OFF_MAP_WRAP), "flat", 0);
}

static double mean_of(const double *x, long n)
{
    double sum = 0;
    for (long i = 0; i < n; i++)
        sum += x[i];
    return sum / (double)n;
}

/* ------------------------------------------------------------------ the law */

struct line {
    const struct roll_law *l;
    double a, b, dt;
};

static double line_force(double q, void *self)
{
    const struct line *s = self;
    double rho = s->a + (s->b - s->a) * q;
    return rho > 0 ? fmax(0, s->l->stiffness * pow(rho, 1.5) * (1 + s->l->mu * (s->b - s->a) / s->dt)) : 0;
}

/* Of both parts' sum. */
static double line_mean(const struct line *s)
{
    double rate = (s->b - s->a) / s->dt;
    struct roll_parts f = roll_law_force(s->l, &(struct roll_end){s->a, rate}, &(struct roll_end){s->b, rate},
                                         0.5 * (s->a + s->b), s->dt);
    return f.early + f.late;
}

/* Against adaptive quadrature: pressed all the time, leaving, arriving, clear of the surface; and so fast away that it
 * would pull. */
START_TEST(means_are_the_integral)
{
    static const double ends[][2] = {{1e-6, 3e-6}, {-1e-6, 3e-6}, {3e-6, -2e-6}, {-3e-6, -2e-6},
                                     {2e-6, 2e-6}, {0, 4e-6},     {5e-4, -5e-4}};
    struct roll_law l = {.stiffness = 2e6, .mu = 0.7};
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(2000);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        struct line s = {&l, ends[i][0], ends[i][1], 5e-6};
        double want, error, cross = -s.a / (s.b - s.a), points[3] = {0, cross > 0 && cross < 1 ? cross : 0.5, 1};
        gsl_integration_qagp(&(gsl_function){line_force, &s}, points, 3, 0, 1e-12, 2000, w, &want, &error);
        double got = line_mean(&s);
        ck_assert_double_eq_tol(got, want, 1e-11 * fabs(want) + 1e-30);
        double share = s.b == s.a || cross <= 0 || cross >= 1 ? s.a > 0 || s.b > 0 : s.b > s.a ? 1 - cross : cross;
        ck_assert_double_eq_tol(roll_law_contact(s.a, s.b), share, 1e-12);
    }
    gsl_integration_workspace_free(w);
}
END_TEST

/* rho = 5 um + 2 um sin(w t), pressed all the time: parts against Gauss's rule, and their order. The late part's is
   Simpson's, of order dt^4; that of the dissipative term, whose derivative it has, dt^3. */
START_TEST(parts_of_a_smooth_way)
{
    struct roll_law l = {.stiffness = 2e6, .mu = 0.7};
    double worst[2] = {0}, w = 2 * M_PI * 1500;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(20);
    for (int fine = 0; fine < 2; fine++)
        for (int i = 0; i < 40; i++) {
            double dt = fine ? 5e-6 : 1e-5, t = 17e-6 * i, want[2] = {0};
            struct roll_end at[2];
            for (int k = 0; k < 2; k++)
                at[k] = (struct roll_end){5e-6 + 2e-6 * sin(w * (t + k * dt)), 2e-6 * w * cos(w * (t + k * dt))};
            for (size_t k = 0; k < 20; k++) {
                double q, weight, rho, rate;
                gsl_integration_glfixed_point(0, 1, k, &q, &weight, rule);
                rho = 5e-6 + 2e-6 * sin(w * (t + q * dt));
                rate = 2e-6 * w * cos(w * (t + q * dt));
                double force = weight * l.stiffness * pow(rho, 1.5) * (1 + l.mu * rate);
                want[0] += (1 - q) * force;
                want[1] += q * force;
            }
            double mean = 0.5 * (at[0].rho + at[1].rho) + dt * (at[0].rate - at[1].rate) / 12;
            struct roll_parts got = roll_law_force(&l, &at[0], &at[1], mean, dt);
            worst[fine] = fmax(worst[fine], fmax(fabs(got.early / want[0] - 1), fabs(got.late / want[1] - 1)));
        }
    gsl_integration_glfixed_table_free(rule);
    printf("parts off by %.3g, at half the step %.3g\n", worst[0], worst[1]);
    ck_assert_double_lt(worst[0], 1e-4);
    ck_assert_double_gt(worst[0] / worst[1], 7.5);
}
END_TEST

/* Ends that are all but equal, where (b^2.5 - a^2.5) / (b - a) would keep no digit. */
START_TEST(means_keep_their_digits)
{
    for (double part = 1e-1; part > 1e-17; part /= 10) {
        double a = 1e-5, b = a * (1 + part), middle = 0.5 * (a + b), half = 0.5 * (b - a);
        double want =
            middle * sqrt(middle) * (1 + 1.0 / 8 * half * half / (middle * middle)); /* next: 3/640 (half/middle)^4 */
        double got = roll_law_power(a, b);
        ck_assert_double_eq_tol(got / want, 1, 1e-15 + 3.0 / 640 * pow(part / 2, 4) * 1.2);
    }
}
END_TEST

/* Hertz's stiffness makes the force absurd (4/3 E* sqrt(R), E* = E / 2 (1 - nu^2)): 5 um under a glass ball of 1 cm
   press with some 50 N where its weight is 0.1 N, and the penetration as printed, R and more, with thousands of tons.
 */
START_TEST(the_printed_penetration_is_absurd)
{
    double radius = 0.01, k = 4.0 / 3 * 70e9 / (2 * (1 - 0.22 * 0.22)) * sqrt(radius),
           weight = 4.0 / 3 * M_PI * pow(radius, 3) * 2500 * 9.80665;
    struct roll_law l = {.stiffness = k};
    double force = line_mean(&(struct line){&l, 5e-6, 5e-6, 1e-5});
    ck_assert_double_gt(force, 30);
    ck_assert_double_lt(force, 80);
    ck_assert_double_gt(force, 300 * weight);
    rig_relief = flat_part;
    struct scene s = made(arena_format(rig_arena(),
                                       "surface: {roughness: {}}\nball: {radius: 1 cm, mass: 10 g}\n"
                                       "contact: {model: roll, roll: {penetration: paper, stiffness: %.17g}}\n"
                                       "motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}\n",
                                       k));
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 100, 1024);
    ck_assert_double_eq_tol(g->x[200] / (k * pow(radius, 1.5)), 1, 1e-12);
    ck_assert_double_gt(g->x[200], 4e6);
    rig_close(g);
}
END_TEST

/* ------------------------------------------------------------------ level ground */

static double theta_of(double x, double radius, double r)
{
    double theta = x / radius;
    for (double step = 1, i = 0; i < 100 && fabs(step) > 1e-15 * (1 + fabs(theta)); i++) {
        step = (radius * theta - r * sin(theta) - x) / (radius - r * cos(theta));
        theta -= step;
    }
    return theta;
}

enum { LEVEL_FRAMES = 12000 };

/* 0.25 s of a ball of 1 cm at 30 cm/s on level ground, its centre of mass r off, its rim an oval of so many m. */
static struct rig *level_ball(double r, double oval, const char *roll, int over)
{
    rig_relief = flat_part;
    struct scene s = made(
        arena_format(rig_arena(),
                     "surface: {roughness: {}}\nball: {radius: 1 cm, mass: 10 g, offset: %.17g, lobe_height: %.17g}\n"
                     "accuracy: {oversampling: %d}\ncontact: {model: roll, smoothing: 0, roll: %s}\n"
                     "motion: {path: line, to: [7.5 cm, 0], speed: 30 cm/s}\n",
                     r, oval, over, roll));
    return rig_record(&s, ITEM_SUBFORCE, LEVEL_FRAMES, 1024);
}

struct turn {
    double k, mu, r, oval;
    double shift, rest, normal; /* rho = shift + rest (N(t) / normal)^(2/3)     */
    bool printed;               /* rho = R - r cos(x/R) + oval cos(2 theta)      */
};

/* N at t, from theta by its closed-form derivatives. */
static double turn_normal(double t, double r, double oval)
{
    double theta = theta_of(0.3 * t, 0.01, r), lever = 0.01 - r * cos(theta), w = 0.3 / lever,
           ww = -r * sin(theta) * w * w / lever;
    return 0.01 * (9.80665 + r * (cos(theta) * w * w + sin(theta) * ww) -
                   2 * oval * (2 * cos(2 * theta) * w * w + sin(2 * theta) * ww));
}

static double turn_rho(double t, const struct turn *s)
{
    double theta = theta_of(0.3 * t, 0.01, s->r), pressed = fmax(turn_normal(t, s->r, s->oval), 0) / s->normal;
    return s->printed ? 0.01 - s->r * cos(0.3 * t / 0.01) + s->oval * cos(2 * theta)
                      : s->shift + s->rest * pow(pressed, 2.0 / 3);
}

static double turn_force(double t, void *self)
{
    const struct turn *s = self;
    double h = 1e-6, rho = turn_rho(t, s), rate = (turn_rho(t + h, s) - turn_rho(t - h, s)) / (2 * h);
    return rho > 0 && (s->printed || turn_normal(t, s->r, s->oval) >= 0)
               ? fmax(0, s->k * pow(rho, 1.5) * (1 + s->mu * rate))
               : 0;
}

/* An oval whose centre of mass is off, from theta on by closed forms: N, the penetration, its slow shift by small
   steps, then the force. Pressed all the time, and leaving the ground twice in each turn. */
START_TEST(an_offset_oval_on_level_ground)
{
    static const double ovals[2] = {3e-4, 4e-3};
    double r = 2e-3, weight = 0.0980665, dt = 1.0 / 192000;
    for (int k = 0; k < 2; k++) {
        struct rig *g = level_ball(r, ovals[k], "{stiffness: 1e6, mu: 4}", 4);
        const struct roll_report *report = &g->run.board.roll;
        struct turn turn = {
            .k = 1e6, .mu = 4, .r = r, .oval = ovals[k], .rest = pow(weight / 1e6, 2.0 / 3), .normal = weight};
        ck_assert_double_eq_tol(report->rest / turn.rest, 1, 1e-12);
        double worst = 0, most = 0;
        for (long i = 0; i < 4 * LEVEL_FRAMES; i++) {
            double t = (double)i * dt, normal = turn_normal(t, r, ovals[k]), force = turn_force(t, &turn);
            if (i > 4 && fabs(normal) > 0.02 * weight) /* where N passes through 0 its power has no derivative */
                worst = fmax(worst, fabs(g->x[i] - force));
            turn.shift -= 2 * M_PI * 2 * dt * turn.rest / (1.5 * weight) * (force - fmax(normal, 0));
            most = fmax(most, fabs(turn.shift));
        }
        printf("worst %.3g of the weight, %ld lift-offs, contact %.4g of %.4g s, shift %.3g of the rest\n",
               worst / weight, report->lift_offs, report->contact, report->time, most / turn.rest);
        ck_assert_double_lt(worst, 2e-3 * weight);
        ck_assert_double_eq_tol(report->time, 0.25, 1e-5);
        ck_assert((report->lift_offs > 0) == (k == 1));
        ck_assert(k == 0 ? report->contact > 0.2499 : report->contact < 0.2);
        rig_close(g);
    }
}
END_TEST

/* By Newton's second law: an offset ball, one with lobes, and one with both press level ground by N(t), at each
 * instant. */
START_TEST(level_ground_bears_the_normal_force)
{
    static const double balls[][2] = {{4e-3, 0}, {0, 5e-4}, {2e-3, 2e-4}};
    for (int k = 0; k < 3; k++) {
        struct rig *g = level_ball(balls[k][0], balls[k][1], "{stiffness: 1e6, mu: 0}", 4);
        for (long i = 5; i < 4 * LEVEL_FRAMES; i += 97)
            ck_assert_double_eq_tol(g->x[i] / turn_normal((double)i / 192000, balls[k][0], balls[k][1]), 1,
                                    1e-6); /* rho is straight over 5 us */
        ck_assert_double_eq_tol(g->run.board.roll.rest / pow(0.0980665 / 1e6, 2.0 / 3), 1, 1e-12);
        rig_close(g);
    }
}
END_TEST

/* The force as printed: rho = R - r cos(x/R), and the lobes with it, lambda = mu k. */
START_TEST(penetration_as_printed)
{
    for (int k = 0; k < 2; k++) {
        double oval = k ? 5e-4 : 0;
        struct rig *g = level_ball(2e-3, oval, "{penetration: paper, stiffness: 500, lambda: 100}", 4);
        struct turn turn = {.k = 500, .mu = 100.0 / 500, .r = 2e-3, .oval = oval, .normal = 1, .printed = true};
        for (long i = 5; i < 4 * LEVEL_FRAMES; i += 97)
            ck_assert_double_eq_tol(g->x[i] / turn_force((double)i / 192000, &turn), 1, 1e-7);
        rig_close(g);
    }
}
END_TEST

/* Equation 16 by itself, in long double: rho = R - r cos(x/R) + S, x = u + R theta_0 - r sin(theta_0) by equation 18.
   On level ground, S = 0, and on ridges, where S is what the same ball presses in with nothing off its centre (without
   limiter, as that follows N(t)). Radii, offsets up to 0.95 of them, start angles, speeds, ways of many turns and
   backwards. 1e-12 of R, or of the place, whose own rounding is in it. */
START_TEST(rho_is_equation_16)
{
    srand48(16);
    for (int trial = 0; trial < 6; trial++) {
        double radius = 2e-3 * pow(20, drand48()), r = radius * (trial % 3 == 0 ? 0.1 : 0.95 * drand48());
        double turn = 12.56 * (drand48() - 0.5), speed = 0.2 + drand48();
        double from = trial % 2 ? 0.1 * speed : 0;
        bool ridges = trial % 6 >= 4;
        struct rig *g[2];
        for (int k = 0; k < 2; k++) {
            rig_relief = ridges ? NULL : flat_part;
            const char *ground = ridges ? "ridges: {spacing: 3 mm, height: 2 um}" : "roughness: {}";
            struct scene s = made(arena_format(
                rig_arena(),
                "surface: {%s}\nball: {radius: %.17g, mass: 10 g, offset: %.17g, start_angle: %.17g}\n"
                "contact: {model: roll, limiter: {curve: none}, roll: {penetration: paper, stiffness: 500}}\n"
                "motion: {path: line, from: [%.17g, 0], to: [%.17g, 0], duration: 0.1 s}\n",
                ground, radius, k ? 0 : r, turn, from, 0.1 * speed - from));
            g[k] = rig_record(&s, ITEM_ROLL, 4700, 1024);
        }
        for (long n = 0; n < 4700; n += 13) {
            long at = n * ROLL_VALUES + ROLL_PENETRATION;
            double rho = g[0]->x[at], round = g[1]->x[at];
            long double u = (long double)speed * n / 48000;
            long double x = u + (long double)radius * turn - (long double)r * sinl(turn);
            long double want = (ridges ? round : radius) - r * cosl(x / radius);
            ck_assert_double_eq_tol(rho, (double)want, 1e-12 * fmax(radius, 0.1 * speed));
        }
        rig_close(g[0]);
        rig_close(g[1]);
    }
    rig_relief = NULL;
}
END_TEST

/* The centre of mass, over where it is lowest: R theta - r sin(theta) = x, r (1 - cos theta). */
START_TEST(height_of_an_offset_ball)
{
    rig_relief = flat_part;
    struct scene s = made("surface: {roughness: {}}\nball: {radius: 1 cm, mass: 10 g, offset: 2 mm}\ncontact: {model: "
                          "roll, roll: {stiffness: 1e6}}\n"
                          "motion: {path: line, to: [7.5 cm, 0], speed: 30 cm/s}\n");
    struct rig *g = rig_record(&s, ITEM_ROLL, 11900, 1024);
    for (long n = 0; n < 11900; n += 7)
        ck_assert_double_eq_tol(g->x[n * ROLL_VALUES + ROLL_HEIGHT],
                                2e-3 * (1 - cos(theta_of(0.3 * (double)n / 48000, 0.01, 2e-3))), 1e-12);
    rig_close(g);
}
END_TEST

/* An oval on level ground: its centre goes up and down by cos(2 x / R), theta being x / R where nothing is off centre.
 */
START_TEST(an_oval_on_level_ground)
{
    rig_relief = flat_part;
    struct scene s = made("surface: {roughness: {}}\nball: {radius: 1 cm, mass: 10 g, lobe_height: 3 um}\ncontact: "
                          "{model: roll, roll: {stiffness: 1e6}}\n"
                          "motion: {path: line, to: [6.283185307179586 cm, 0], speed: 30 cm/s}\n"); /* one turn */
    struct rig *g = rig_record(&s, ITEM_ROLL, 10000, 1024);
    for (long n = 0; n < 10000; n++)
        ck_assert_double_eq_tol(g->x[n * ROLL_VALUES + ROLL_HEIGHT], 3e-6 * cos(2 * 30.0 * (double)n / 48000), 1e-15);
    rig_close(g);
}
END_TEST

/* Round, on level ground, the force is the weight whatever the stiffness: given, of 1 nm where nothing says more, and
 * as good as rigid. */
START_TEST(round_and_level)
{
    static const char *const rolls[] = {"{stiffness: 1e6}", "{}", "{stiffness: 1e18, damping_ratio: 0}",
                                        "{static_penetration: 2 um}"};
    const double rests[] = {pow(0.0980665 / 1e6, 2.0 / 3), 1e-9, pow(0.0980665 / 1e18, 2.0 / 3), 2e-6};
    for (int k = 0; k < 4; k++) {
        struct rig *g = level_ball(0, 0, rolls[k], 4);
        ck_assert_double_eq_tol(g->run.board.roll.rest / rests[k], 1, 1e-12);
        for (long i = 0; i < 4 * LEVEL_FRAMES; i++) /* half of the first hat is before the start */
            ck_assert_double_eq_tol(g->x[i], i > 0 ? 0.0980665 : 0.5 * 0.0980665, 1e-12 * 0.0980665);
        rig_close(g);
    }
}
END_TEST

/* r v^2 / R^2 = 5 g: clear of the surface for part of each turn, no force there; the mean is that of what of N(t)
 * presses. */
START_TEST(no_force_where_it_flies)
{
    rig_relief = flat_part;
    struct scene s = made("surface: {roughness: {}}\nball: {radius: 1 cm, mass: 10 g, offset: 5 mm}\ncontact: {model: "
                          "roll, smoothing: 0, roll: {stiffness: 1e6}}\n"
                          "motion: {path: line, to: [25 cm, 0], speed: 100 cm/s}\n");
    rig_probe.also = ITEM_BIT(ITEM_LOAD);
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, LEVEL_FRAMES, 1024);
    double flown = 0, pressed = 0;
    bool before = false;
    for (long i = 0; i < 4 * LEVEL_FRAMES; i++) {
        double t[2] = {(double)i / 192000, (double)(i + 1) / 192000}, load[2];
        for (int k = 0; k < 2; k++) {
            double h = 1e-5, theta[3], rise[3]; /* rise'' by differences, 1e-3 of g here */
            for (int j = 0; j < 3; j++)
                theta[j] = theta_of(t[k] + (j - 1) * h, 0.01, 5e-3), rise[j] = -5e-3 * cos(theta[j]);
            load[k] = 9.80665 + (rise[0] - 2 * rise[1] + rise[2]) / (h * h);
        }
        bool clear = load[0] + load[1] < -0.05;
        if (clear && before) ck_assert(g->x[i] == 0);
        before = clear;
        flown += load[0] + load[1] < 0 ? 1.0 / 192000 : 0;
        pressed += fmax(load[0] + load[1], 0) * 0.005 / (4 * LEVEL_FRAMES);
    }
    ck_assert_double_gt(flown, 0.05);
    ck_assert_double_eq_tol(g->run.board.lifted, flown, 1e-4);
    ck_assert_int_gt(g->run.board.roll.lift_offs, 2);
    ck_assert_double_gt(pressed, 0.15);
    ck_assert_double_eq_tol(mean_of(g->x, 4 * LEVEL_FRAMES) / pressed, 1, 2e-3); /* rise'' by differences */
    rig_probe.also = 0;
    rig_close(g);
}
END_TEST

/* ------------------------------------------------------------------ round a circle */

/* Height -r cos(theta) of the centre of mass at instants a step apart, theta' = v / (R - r cos theta) by Runge and
 * Kutta from the start's angle on. */
static void heights_by_turning(double start, double r, double dt, long n, double *height)
{
    double theta = start;
    for (long i = 0; i < n; i++) {
        height[i] = -r * cos(theta);
        double a = 0.3 / (0.01 - r * cos(theta)), b = 0.3 / (0.01 - r * cos(theta + 0.5 * dt * a)),
               c = 0.3 / (0.01 - r * cos(theta + 0.5 * dt * b));
        theta += dt / 6 * (a + 2 * b + 2 * c + 0.3 / (0.01 - r * cos(theta + dt * c)));
    }
}

/* By Newton's second law an offset ball that goes round a circle presses with m (g + h''), h'' by differences of order
   4 of a height that is integrated step by step: on level ground at each instant; over rough ridges, with an alpha that
   follows, in the mean over four whole turns of the ball (after each the centre of mass is as high, and moves as fast),
   which is m g. */
START_TEST(an_offset_ball_on_a_circle)
{
    enum { EVERY = 48000 };
    double r = 4e-3, whole = 4 * 2 * M_PI * 0.01, dt = whole / 0.3 / EVERY;
    double *h = calloc(EVERY + 4, sizeof *h);
    heights_by_turning(0.5, r, dt, EVERY + 4, h);
    for (int k = 0; k < 2; k++) {
        rig_relief = k == 0 ? flat_part : NULL;
        struct scene s =
            made(arena_format(rig_arena(),
                              "surface: {along: x, roughness: {%s}}\nball: {radius: 1 cm, mass: 10 g, offset: 4 mm, "
                              "start_angle: 0.5 rad}\n"
                              "contact: {model: roll, smoothing: 0, roll: {stiffness: 1e6, mu: 0, scraping: 0}}\n"
                              "motion: {path: circle, radius: 2 cm, turns: 2, law: constant, duration: %.17g s}\n",
                              k == 0 ? "" : "rms: 2 um", whole / 0.3));
        struct rig *g = rig_record(&s, ITEM_SUBFORCE, (long)ceil(whole / 0.3 * 48000), 1024);
        double rate = 48000.0 * g->per_frame, sum = 0;
        for (long i = 3; k == 0 && i + 4 < EVERY; i += 97) {
            double t = ((double)i + 2) * dt;
            long at = (long)(t * rate);
            double part = t * rate - (double)at, next = g->x[at + 1];
            double is = g->x[at] + fabs(part) * (next - g->x[at]);
            double want =
                0.01 * (9.80665 + (16 * (h[i + 1] + h[i + 3]) - h[i] - h[i + 4] - 30 * h[i + 2]) / (12 * dt * dt));
            ck_assert_double_eq_tol(is / want, 1, 3e-6);
        }
        for (long i = 0; i < (long)(whole / 0.3 * rate); i++)
            sum += g->x[i];
        printf("mean %.9g of the weight\n", sum / (whole / 0.3 * rate) / (0.01 * 9.80665)), fflush(stdout);
        ck_assert_double_eq_tol(sum / (whole / 0.3 * rate) / (0.01 * 9.80665), 1, k ? 1e-3 : 1e-4);
        rig_close(g);
    }
    rig_relief = NULL;
    free(h);
}
END_TEST

/* ------------------------------------------------------------------ over a ground */

/* z = A sin(q x), gently: the centre's way is the ground's but for R q^2 A / 2 = 8e-4 of it, less what the Gaussian
   over the patch takes. Driven by z'' the two leaks pass (l / (1 + i q l))^2, after some ten times l. */
static double wave_height = 1e-6, wave_length = 5e-3;
static int wave_points = 1000;

static struct relief_part *wave_part(struct arena *a, const struct contact *c)
{
    double z[1000];
    (void)c;
    for (int i = 0; i < wave_points; i++)
        z[i] = wave_height * sin(2 * M_PI * i / wave_points);
    return profile_part(a, profile_from_samples(a, z, (size_t)wave_points, wave_length / wave_points, OFF_MAP_WRAP),
                        "wave", 0);
}

/* By the hat of a frame's width about frame n, of the narrow ones, `over` a frame. */
static double widest_hat(const double *x, long n, int over)
{
    double sum = 0;
    for (int k = 1 - over; k < over; k++)
        sum += x[n * over + k] * (over - abs(k)) / (over * over);
    return sum;
}

/* Errors fall by eight for each doubling of the sub-intervals, also where the ball leaves the surface (rho^1.5 there:
   by 5.7 at least); k is the same. Compared are the coarsest hats, of which finer ones' are sums. */
START_TEST(third_order_in_the_sub_intervals)
{
    struct rig *g[5];
    double off[4], height = wave_height;
    wave_height = 2e-4;
    rig_relief = wave_part;
    for (int k = 0; k < 5; k++) {
        struct scene s = made(
            arena_format(rig_arena(),
                         "surface: {roughness: {}}\nball: {radius: 1 mm, mass: 10 g}\naccuracy: {oversampling: %d}\n"
                         "contact: {model: roll, smoothing: 0, limiter: {curve: none}, roll: {static_penetration: 10 "
                         "um, mu: 10, scraping: 0}}\n"
                         "motion: {path: line, to: [7.5 cm, 0], speed: 30 cm/s}\n",
                         k == 4 ? 32 : 1 << k));
        g[k] = rig_record(&s, ITEM_SUBFORCE, LEVEL_FRAMES, 1024);
    }
    ck_assert_int_gt(g[4]->run.board.roll.lift_offs, 0);
    for (int k = 0; k < 4; k++) {
        off[k] = 0;
        for (long n = 1; n < LEVEL_FRAMES - 10; n++)
            off[k] += pow(widest_hat(g[k]->x, n, 1 << k) - widest_hat(g[4]->x, n, 32), 2) / LEVEL_FRAMES;
        off[k] = sqrt(off[k]);
        printf("oversampling %d: rms error %.3g N\n", 1 << k, off[k]), fflush(stdout);
        ck_assert(g[k]->run.board.roll.stiffness == g[4]->run.board.roll.stiffness &&
                  g[k]->run.board.roll.rest == g[4]->run.board.roll.rest);
    }
    for (int k = 0; k < 3; k++)
        ck_assert_double_gt(off[k] / off[k + 1], 5.5);
    for (int k = 0; k < 5; k++)
        rig_close(g[k]);
    wave_height = height;
}
END_TEST

/* The ball's height is the ground's less y, and rho is y more than at rest: y as of a wave of acceleration that one
   leak has passed, i q l / (1 + i q l), after some ten times l; in rho what holds the mean force takes out of it what
   is slower than 2 Hz. */
START_TEST(height_over_a_wave)
{
    rig_relief = wave_part;
    struct scene s = made("surface: {roughness: {}}\nball: {radius: 1 mm, mass: 10 g}\ncontact: {model: roll, limiter: "
                          "{curve: none}, roll: {static_penetration: 40 um, mu: 0}}\n"
                          "motion: {path: line, to: [5 cm, 0], speed: 20 cm/s}\n");
    struct rig *g = rig_record(&s, ITEM_ROLL, 12000, 1024);
    double q = 2 * M_PI / wave_length, w = q * 0.2, w0 = sqrt(1.5 * 9.80665 / 40e-6),
           high = wave_height * exp(-0.5 * pow(q * 20e-6, 2)), worst[2] = {0}, level = 0;
    double complex leaked = I * q * 2e-3 / (1 + I * q * 2e-3),
                   y = -high * w * w * leaked / (w0 * w0 - w * w + I * w * 2 * 0.3 * w0);
    ck_assert_double_eq_tol(g->run.board.roll.resonance, w0 / (2 * M_PI), 1e-9);
    for (long n = 7200; n < 12000; n++) /* four waves */
        level += g->x[n * ROLL_VALUES + ROLL_HEIGHT] / 4800;
    for (long n = 7200; n < 12000; n++) {
        double phase = w * (double)n / 48000, lag = cimag(y * cexp(I * phase)),
               held = cimag(y * I * w / (I * w + 2 * M_PI * 2) * cexp(I * phase));
        worst[0] = fmax(worst[0], fabs(g->x[n * ROLL_VALUES + ROLL_HEIGHT] - level - high * sin(phase) + lag));
        worst[1] = fmax(worst[1], fabs(g->x[n * ROLL_VALUES + ROLL_PENETRATION] - 40e-6 - held));
        ck_assert(g->x[n * ROLL_VALUES + ROLL_CONTACT] == 1 && g->x[n * ROLL_VALUES + ROLL_LIFT_OFFS] == 0);
    }
    printf("y %.3g m; height: worst %.3g, penetration: worst %.3g of it\n", cabs(y), worst[0] / cabs(y),
           worst[1] / cabs(y));
    ck_assert_double_lt(fmax(worst[0], worst[1]),
                        1e-2 * cabs(y)); /* R q^2 A / 2 of the wave is 8e-4, and y^1.5 bends */
    rig_close(g);
}
END_TEST

static const char
    *const rough = "surface: {roughness: {rms: 5 um}}\n",
           *const line = "motion: {path: line, from: [1 cm, 0], to: [9 cm, 0], speed: 30 cm/s}\n",
           *const reversing =
               "motion: {path: back_and_forth, from: [1 cm, 0], to: [1.4 cm, 0], rate: 30 Hz, duration: 0.05 s}\n";

/* The height S is integrated exactly over each piece but for what T varies by: pieces of 5 um and of 0.2 um give the
   same, with the usual leak l and with one of 16 pieces, where every term in h / l counts. */
START_TEST(height_does_not_depend_on_the_pieces)
{
    static const int over[2] = {1, 32};
    static const char *const leak[2] = {"2 mm", "80 um"};
    static const double within[2] = {1e-7, 2e-5};
    rig_relief = NULL;
    for (int j = 0; j < 2; j++) {
        struct rig *g[2];
        double worst = 0, mean = 0, square = 0;
        for (int k = 0; k < 2; k++) {
            struct scene s =
                made(arena_format(rig_arena(),
                                  "%s%sball: {radius: 1 cm, mass: 10 g}\naccuracy: {oversampling: %d}\n"
                                  "contact: {model: roll, leak: %s, roll: {penetration: paper, stiffness: 500}}\n",
                                  rough, line, over[k], leak[j]));
            g[k] = rig_record(&s, ITEM_ROLL, 4000, 1024);
        }
        for (long n = 0; n < 4000; n++) {
            mean += g[1]->x[n * ROLL_VALUES] / 4000;
            worst = fmax(worst, fabs(g[0]->x[n * ROLL_VALUES] - g[1]->x[n * ROLL_VALUES]));
        }
        for (long n = 0; n < 4000; n++)
            square += pow(g[1]->x[n * ROLL_VALUES] - mean, 2) / 4000;
        printf("leak %s: worst %.3g of rms %.3g m\n", leak[j], worst, sqrt(square));
        ck_assert_double_lt(worst, within[j] * sqrt(square));
        rig_close(g[0]);
        rig_close(g[1]);
    }
}
END_TEST

/* An offset ball on ground that is smooth for it presses it most where N(t) is greatest, also where alpha follows N(t)
 * and the limited trajectory with it: means over 2 ms correlate. */
START_TEST(the_force_follows_the_normal_force)
{
    enum { BIN = 4 * 96, BINS = 130 };
    rig_relief = NULL;
    struct scene s =
        made(arena_format(rig_arena(),
                          "surface: {roughness: {rms: 5 um}}\n%sball: {radius: 1 cm, mass: 10 g, offset: 4 mm}\n"
                          "contact: {model: roll, smoothing: 0, roll: {scraping: 0, static_penetration: 100 um}}\n",
                          line));
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 12800, 1024);
    double sums[5] = {0};
    for (long i = 0; i < BINS; i++) {
        double f = mean_of(g->x + i * BIN, BIN), n = turn_normal(((double)i + 0.5) * BIN / 192000, 4e-3, 0);
        sums[0] += f / BINS, sums[1] += n / BINS, sums[2] += f * f / BINS, sums[3] += n * n / BINS,
            sums[4] += f * n / BINS;
    }
    double together =
        (sums[4] - sums[0] * sums[1]) / sqrt((sums[2] - sums[0] * sums[0]) * (sums[3] - sums[1] * sums[1]));
    printf("correlation %.4f\n", together), fflush(stdout);
    ck_assert_double_gt(together, 0.97);
    rig_close(g);
}
END_TEST

/* Without weight there is no rolling term, and what is left is, to the bit, the force of a scraper with such a tip:
   directional and as printed, there and back. */
START_TEST(what_slips_is_what_scrapes)
{
    static const char *const forces[] = {"force: directional", "force: paper, smoothing: 0", "beta2: 1.5"};
    rig_relief = NULL;
    for (int k = 0; k < 3; k++) {
        struct arena *a = rig_arena();
        struct scene one =
            made(arena_format(a, "%s%sscraper: {radius: 3 mm, mass: 10 g}\ncontact: {model: scrape, gravity: 0, %s}\n",
                              rough, reversing, forces[k]));
        struct scene other =
            made(arena_format(a, "%s%sball: {radius: 3 mm, mass: 10 g}\ncontact: {model: roll, gravity: 0, %s}\n",
                              rough, reversing, forces[k]));
        struct rig *scrape = rig_record(&one, ITEM_SUBFORCE, 2400, 1024),
                   *roll = rig_record(&other, ITEM_SUBFORCE, 2400, 1024);
        ck_assert_int_eq(memcmp(scrape->x, roll->x, 2400 * 4 * sizeof *roll->x), 0);
        ck_assert_double_gt(fabs(mean_of(roll->x + 100, 50)), 0);
        rig_close(scrape);
        rig_close(roll);
    }
}
END_TEST

/* The two terms add up, and the printed scraping terms with the same rolling term. */
START_TEST(terms_add_up)
{
    static const char *const settings[] = {
        "force: directional, roll: {scraping: 0}", "force: directional",       "force: paper",
        "force: paper, roll: {scraping: 0}",       "force: paper, gravity: 0", "force: directional, gravity: 0"};
    struct rig *g[6];
    rig_relief = NULL;
    for (int k = 0; k < 6; k++) {
        struct scene s = made(arena_format(rig_arena(),
                                           "%s%sball: {radius: 1 cm, mass: 10 g}\n"
                                           "contact: {model: roll, smoothing: 0, %s}\n",
                                           rough, line, settings[k]));
        g[k] = rig_record(&s, ITEM_SUBFORCE, 6000, 1024);
    }
    for (long i = 0; i < 24000; i++) {
        ck_assert(g[3]->x[i] == g[0]->x[i]);
        ck_assert_double_eq_tol(g[1]->x[i], g[0]->x[i] + g[5]->x[i], 1e-14);
        ck_assert_double_eq_tol(g[2]->x[i], g[0]->x[i] + g[4]->x[i], 1e-14);
    }
    for (int k = 0; k < 6; k++)
        rig_close(g[k]);
}
END_TEST

/* Up a slope and down again, turning on the way: finite, and the mean force is m g cos(incline) and what the centre of
   mass gained of vertical momentum, m r sin(theta) theta', over the time. A solid ball is slowed by 5/7 g sin(incline).
 */
START_TEST(up_and_down_a_slope)
{
    rig_relief = NULL;
    struct scene s = made(arena_format(
        rig_arena(),
        "%sball: {radius: 1 cm, mass: 10 g, offset: 20 um}\ncontact: {model: roll, smoothing: 0, roll: {scraping: 0}}\n"
        "motion: {path: incline, from: [1 cm, 0], to: [9 cm, 0], incline: 10 deg, start_speed: 20 cm/s, duration: 0.25 "
        "s}\n",
        rough));
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 12000, 1024);
    ck_assert(!isnan(trajectory_turning(g->run.board.trajectory, 0.16, 0.18)));
    double slow = 5.0 / 7 * 9.80665 * sin(10 * M_PI / 180),
           theta = theta_of(0.2 * 0.25 - 0.5 * slow * 0.0625, 0.01, 2e-5);
    double climb = 2e-5 * sin(theta) * (0.2 - slow * 0.25) / (0.01 - 2e-5 * cos(theta));
    ck_assert_double_eq_tol(mean_of(g->x, 48000), 0.0980665 * cos(10 * M_PI / 180) + 0.01 * climb / 0.25,
                            1e-2 * 0.0980665);
    rig_close(g);
}
END_TEST

/* alpha at each instant is equation 7's for the normal force there: least where the ball presses most. */
START_TEST(alpha_follows_the_turning)
{
    rig_relief = NULL;
    struct scene s = made(arena_format(
        rig_arena(), "%s%sball: {radius: 1 cm, mass: 10 g, offset: 2 mm}\ncontact: {model: roll}\n", rough, line));
    rig_probe.also = ITEM_BIT(ITEM_SUBFORCE);
    struct rig *g = rig_record(&s, ITEM_ALPHA, 12800, 1024);
    double least = 1, most = 0, at = 0;
    for (long i = 0; i < 4 * 12800; i++) {
        at = g->x[i] < least ? (double)i / 192000 : at;
        least = fmin(least, g->x[i]), most = fmax(most, g->x[i]);
    }
    double theta = theta_of(0.3 * at, 0.01, 2e-3) / (2 * M_PI);
    ck_assert_double_eq_tol(least, 0.01, 1e-6);
    ck_assert_double_eq_tol(most, 0.05, 1e-4); /* zeta 0.95: steep there */
    ck_assert_double_eq_tol(theta, rint(theta), 0.01);
    rig_probe.also = 0;
    rig_close(g);
}
END_TEST

/* The same bytes however frames are cut into blocks, also beyond the motion's end at 2400; of the ball's own table as
 * well. */
START_TEST(blocks_do_not_matter)
{
    static const enum item items[] = {ITEM_SUBFORCE, ITEM_ROLL};
    rig_relief = NULL;
    for (int k = 0; k < 2; k++) {
        struct scene s = made(arena_format(rig_arena(),
                                           "%s%sball: {radius: 1 cm, mass: 10 g, offset: 20 um}\naccuracy: "
                                           "{oversampling: 3}\ncontact: {model: roll}\n",
                                           rough, reversing));
        struct rig *one = rig_record(&s, items[k], 3000, 1024), *other = rig_record(&s, items[k], 3000, 77);
        ck_assert_int_eq(memcmp(one->x, other->x, (size_t)(3000 * one->per_frame) * sizeof *one->x), 0);
        rig_close(one);
        rig_close(other);
    }
}
END_TEST

/* Nothing presses: no rolling force, and nothing is said of stiffness and contact. */
START_TEST(without_weight_nothing_rolls)
{
    rig_relief = NULL;
    struct scene s = made(arena_format(
        rig_arena(), "%s%sball: {radius: 1 cm, mass: 10 g}\ncontact: {model: roll, gravity: 0}\n", rough, line));
    struct rig *g = rig_record(&s, ITEM_ROLL, 2000, 1024);
    ck_assert(!g->run.board.rolls && g->run.board.roll.lift_offs == 0 && g->run.board.n_warnings == 1);
    for (long n = 0; n < 2000; n++)
        ck_assert(g->x[n * ROLL_VALUES + ROLL_PENETRATION] == 0 && g->x[n * ROLL_VALUES + ROLL_CONTACT] == 0);
    rig_close(g);
}
END_TEST

/* (N/k)^(2/3) of a tenth of the radius and more is told. */
START_TEST(too_soft_a_ball_is_told)
{
    for (int k = 0; k < 2; k++) {
        struct rig *g = level_ball(0, 0, k ? "{stiffness: 3e3}" : "{stiffness: 3.2e3}",
                                   4); /* 0.098 N: 1.022 and 0.979 mm of 10 mm */
        ck_assert_int_eq(g->run.board.n_warnings, k);
        rig_close(g);
    }
}
END_TEST

/* Lobes are no part of the ground: the stiffness is the same to the bit. Only the force that they make differs. */
START_TEST(lobes_are_no_roughness)
{
    struct rig *g[2];
    rig_relief = NULL;
    for (int k = 0; k < 2; k++) {
        struct scene s =
            made(arena_format(rig_arena(),
                              "%s%sball: {radius: 1 cm, mass: 10 g, lobe_height: %s}\n"
                              "contact: {model: roll, smoothing: 0, limiter: {curve: none}, roll: {scraping: 0}}\n",
                              rough, line, k ? "100 um" : "0 um"));
        g[k] = rig_record(&s, ITEM_SUBFORCE, 12800, 1024);
    }
    ck_assert(g[1]->run.board.roll.stiffness == g[0]->run.board.roll.stiffness);
    double most = 0;
    for (long i = 0; i < 4 * 12800;
         i++) { /* f' = 1.5 k rho^0.5, at most some 1.6 of that at rest: N(t) - N times as much, 3.6 % of N */
        double swing = turn_normal((double)i / 192000, 0, 100e-6) - 0.0980665;
        most = fmax(most, fabs(g[1]->x[i] - g[0]->x[i] - swing));
        ck_assert(fabs(swing) < 0.04 * 0.0980665);
    }
    printf("worst %.3g of the weight\n", most / 0.0980665);
    ck_assert_double_lt(most, 0.04 * 0.0980665);
    rig_close(g[0]);
    rig_close(g[1]);
}
END_TEST

/* What the model does not hold for, or hardly: one remark each, at the place where it begins. */
START_TEST(what_is_beyond_the_model_is_told)
{
    static const struct {
        const char *ball, *contact, *told;
    } of[] = {{"", "", NULL},
              {", lobe_height: 1 mm", "", NULL},
              {", lobe_height: 1 um", "limiter: {force_range: [0 N, 1 N]},", NULL},
              {", lobe_height: 1 um", "", "by it; give contact.limiter.force_range"},
              {", lobe_height: 1 um", "roll: {stiffness: 1e6},", "by it; give contact.limiter.force_range"},
              {", lobe_height: 1 um, lobes: 40", "limiter: {curve: none},", "cannot follow"},
              {", offset: 1 mm", "gravity: 0,", "gravity is 0"},
              {", lobe_height: 1 mm", "gravity: 0,", "gravity is 0"}};
    rig_relief = NULL;
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        struct scene s =
            made(arena_format(rig_arena(), "%s%sball: {radius: 1 cm, mass: 10 g%s}\ncontact: {%s model: roll}\n", rough,
                              line, of[i].ball, of[i].contact));
        struct rig *g = rig_record(&s, ITEM_SUBFORCE, 100, 100);
        const struct board *b = &g->run.board;
        ck_assert_msg(b->n_warnings == (of[i].told != NULL), "%zu: %d, %s", i, b->n_warnings,
                      b->n_warnings ? b->warnings[0] : "");
        ck_assert_msg(!of[i].told || strstr(b->warnings[0], of[i].told) != NULL, "%s", b->warnings[0]);
        rig_close(g);
    }
}
END_TEST

UNIT("roll", means_are_the_integral, parts_of_a_smooth_way, means_keep_their_digits, the_printed_penetration_is_absurd,
     UNIT_LONG(an_offset_oval_on_level_ground), level_ground_bears_the_normal_force, third_order_in_the_sub_intervals,
     penetration_as_printed, rho_is_equation_16, height_of_an_offset_ball, an_oval_on_level_ground, round_and_level,
     no_force_where_it_flies, height_over_a_wave, height_does_not_depend_on_the_pieces,
     the_force_follows_the_normal_force, lobes_are_no_roughness, an_offset_ball_on_a_circle,
     what_is_beyond_the_model_is_told, what_slips_is_what_scrapes, terms_add_up, up_and_down_a_slope,
     alpha_follows_the_turning, blocks_do_not_matter, without_weight_nothing_rolls, too_soft_a_ball_is_told)
