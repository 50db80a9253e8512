/* rk4 against the textbook's method written down plainly, mode by mode and stage by stage; against the closed form of
   an impact (as far off as the method is known to be, no more), against its own polynomial R(z) on free modes, and
   against the discrete gradient in fine steps with modes and a moving place; and what it refuses. */
#include "unit.h"

#include <complex.h>

#include "balls.h"

enum { PHASES = 32, RK4 = INTEGRATOR_RK4 };

static double worst_bounce(double kappa, double mu, double v, double rate)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct coupled *c = ball_make(a, (struct ball_case){RK4, kappa, mu, 0, rate});
    double worst = 0, leaves = ball_leaves(mu, v);
    for (int i = 0; i < PHASES; i++) {
        struct ball_impact r = ball_impact(c, rate, v, (i + 0.5) / PHASES, &e);
        ck_assert_msg(r.made, "%s", e.text);
        ck_assert_double_eq_tol(r.momentum / BALL_MASS, v + r.leaves, 1e-12 * v);
        ck_assert_double_eq_tol(r.loss, 0.5 * BALL_MASS * (v * v - leaves * leaves), 4e-3 * BALL_MASS * v * v);
        worst = fmax(worst, fabs(r.leaves - leaves) / v);
    }
    arena_close(a);
    return worst;
}

/* Worst errors of 32 phases found beforehand with another program (two digits): the method is right when it is just as
 * wrong. */
START_TEST(impact_is_off_as_known)
{
    static const struct {
        double kappa, mu, v;
        int over;
        double off;
    } known[] = {{5e9, 1, 0.05, 1, 1.7e-5},  {5e9, 1, 0.05, 4, 1.8e-6},   {5e9, 1, 0.05, 16, 3e-8},
                 {5e11, 1, 0.05, 4, 1.7e-4}, {5e11, 1, 0.05, 16, 5.7e-6}, {5e11, 1, 0.05, 64, 1.4e-7}};
    for (int i = 0; i < 6; i++) {
        double off = worst_bounce(known[i].kappa, known[i].mu, known[i].v, BALL_RATE * known[i].over);
        printf("kappa %g mu %g v %g x%d: off by %.2g (known: %.2g)\n", known[i].kappa, known[i].mu, known[i].v,
               known[i].over, off, known[i].off);
        ck_assert_double_lt(off, 1.2 * known[i].off);
        ck_assert_double_gt(off, 0.5 * known[i].off);
    }
}
END_TEST

/* The bounds that the file's head gives, by steps per contact (6e-4, 2e-4, 4e-5), and up to a third for mu = 0 and 2.
 */
START_TEST(impact_by_steps_per_contact)
{
    static const double steps[] = {12.4, 18.6, 42}, most[] = {7e-4, 2.6e-4, 4e-5};
    for (int i = 0; i < 3; i++)
        for (double mu = 0; mu <= 2; mu += 1) {
            double v = 0.05, kappa = 1e10, rate = steps[i] / coupled_contact_time(1, kappa, v),
                   off = worst_bounce(kappa, mu, v, rate);
            printf("%.1f steps per contact, mu %g: off by %.2g\n", steps[i], mu, off);
            ck_assert_double_lt(off, most[i]);
        }
}
END_TEST

static struct coupled *plate(struct arena *a, int integrator, double rate, double kappa, int n, const double *f,
                             const double *decay)
{
    struct err e = {0};
    struct coupled *c = NULL;
    struct coupled_ask ask = {.integrator = integrator,
                              .step = 1 / rate,
                              .mass = BALL_MASS,
                              .weight = BALL_MASS * BALL_GRAVITY,
                              .stiffness = kappa * BALL_MASS,
                              .mu = 1,
                              .n = n,
                              .frequency = f,
                              .decay = decay};
    ck_assert_msg(coupled_make(a, &ask, &c, &e), "%s", e.text);
    return c;
}

/* A ball that stays in the air over modes that ring (bent as if it lay on them): each mode turns by R(s h) per step,
 * real and imaginary part of q - p/s*. */
START_TEST(free_modes_turn_by_the_polynomial)
{
    enum { N = 400, MODES = 11 };
    struct arena *a = arena_open();
    struct err e = {0};
    double f[MODES], decay[MODES], phi[MODES], ground[N], force[N], h = 1 / BALL_RATE;
    for (int i = 0; i < MODES; i++) {
        f[i] = 150 + 270 * i;
        decay[i] = 5 + i;
        phi[i] = i % 2 ? -1 : 2;
    }
    for (int i = 0; i < N; i++)
        ground[i] = -1;
    struct coupled *c = plate(a, RK4, BALL_RATE, 5e9, MODES, f, decay);
    coupled_start(c, 0, 0, 0, phi, true);
    double q0[MODES], p;
    for (int i = 0; i < MODES; i++)
        coupled_mode(c, i, &q0[i], &p);
    coupled_start(c, 1, 0, 0, phi, true);
    ck_assert_msg(coupled_run(c, N, ground, NULL, force, &e), "%s", e.text);
    for (int i = 0; i < MODES; i++) {
        double complex s = -decay[i] + 2 * I * M_PI * f[i], z = s * h,
                       r = 1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)));
        double complex amplitude =
            (0 - conj(s) * q0[i]) / (s - conj(s)); /* q = 2 Re(amplitude e^(s t)) with q' = 0 at 0 */
        double q, want = 2 * creal(amplitude * cpow(r, N)), rate = 2 * creal(amplitude * s * cpow(r, N));
        coupled_mode(c, i, &q, &p);
        ck_assert_double_eq_tol(q, want, 1e-12 * q0[i] * (q0[i] > 0 ? 1 : -1));
        ck_assert_double_eq_tol(p, rate, 1e-12 * fabs(q0[i]) * cabs(s));
    }
    ck_assert_double_eq_tol(coupled_state(c)->height, 1 - 0.5 * BALL_GRAVITY * N * h * N * h, 1e-12);
    arena_close(a);
}
END_TEST

enum { ROLL = 1323, PLATE = 12 };

/* The ball's height every 1/BALL_RATE s over hills on a plate of 12 modes (below 2 kHz), its place moving over shapes
 * that change sign. Returns the residual, J. */
static double roll_on_plate(int integrator, int over, double kappa, double drop, double *w)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double f[PLATE], decay[PLATE], phi[PLATE], *surface = ARENA_TAKE(a, double, over),
                                               *force = ARENA_TAKE(a, double, over);
    for (int i = 0; i < PLATE; i++) {
        f[i] = 140 + 150 * i;
        decay[i] = 10 + 2 * i;
        phi[i] = 2 * sin(0.9 * (i + 1));
    }
    struct coupled *c = plate(a, integrator, BALL_RATE * over, kappa, PLATE, f, decay);
    coupled_start(c, coupled_rest(c, 0, phi) + drop, 0, 0, phi, drop <= 0);
    for (int i = 0; i < ROLL; i++) {
        for (int j = 0; j < over; j++)
            surface[j] = 5 * ball_hills((i + (j + 1.0) / over) / BALL_RATE);
        for (int j = 0; j < PLATE; j++)
            phi[j] = 2 * sin((j + 1) * (0.9 + 20 * (i + 1) / BALL_RATE));
        ck_assert_msg(coupled_run(c, over, surface, phi, force, &e), "%s", e.text);
        w[i] = coupled_state(c)->height;
    }
    printf("x%-3d lift-offs %ld, work of the surface %.3g J, lost %.3g and %.3g J, residual %.2g J\n", over,
           coupled_state(c)->lift_offs, coupled_state(c)->surface_work, coupled_state(c)->contact_loss,
           coupled_state(c)->mode_loss, coupled_state(c)->residual);
    double residual = fabs(coupled_state(c)->residual);
    arena_close(a);
    return residual;
}

/* First 30 ms. The reference: discrete gradient x128 and x256, extrapolated (order 2). Always in contact: the surface
   and the shapes, straight between steps, keep rk4 at order 2. Bouncing: order 2 or so. The work of the moving place
   counts in the residual. */
START_TEST(rolls_like_the_discrete_gradient)
{
    static double fine[ROLL], finer[ROLL], w[ROLL];
    static const struct {
        double drop, scale, residual;
    } scenes[] = {{0, 5e-6, 1e-20}, {20e-6, 2e-5, 2e-14}};
    for (int i = 0; i < 2; i++) {
        double off[3], residual = 0;
        roll_on_plate(INTEGRATOR_DISCRETE_GRADIENT, 128, 1e9, scenes[i].drop, fine);
        roll_on_plate(INTEGRATOR_DISCRETE_GRADIENT, 256, 1e9, scenes[i].drop, finer);
        for (int k = 0; k < ROLL; k++)
            finer[k] += (finer[k] - fine[k]) / 3;
        for (int k = 0; k < 3; k++) {
            residual = roll_on_plate(RK4, 1 << 2 * k, 1e9, scenes[i].drop, w);
            off[k] = ball_distance(ROLL, w, finer);
        }
        printf("drop of %g m: rk4 x1, x4, x16 off by %.2g %.2g %.2g m (discrete gradient x128: %.2g m)\n",
               scenes[i].drop, off[0], off[1], off[2], ball_distance(ROLL, fine, finer));
        ck_assert_double_lt(off[0], 1e-2 * scenes[i].scale);
        ck_assert_double_lt(off[1], off[0] / 8);
        ck_assert_double_lt(off[2], off[1] / 8);
        ck_assert_double_lt(residual, scenes[i].residual);
    }
}
END_TEST

/* Flat ground, settled but lifted a little, never out of contact: smooth, so of order 4, and the residual with it. */
START_TEST(order_four_in_contact)
{
    double height[4], residual[4];
    double f[2] = {200, 700}, decay[2] = {20, 40}, phi[2] = {1, -2};
    for (int k = 0; k < 4; k++) {
        struct arena *a = arena_open();
        struct err e = {0};
        double ground = 0, force;
        struct coupled *c = plate(a, RK4, BALL_RATE / 4 * (1 << k), 1e9, 2, f, decay);
        coupled_start(c, coupled_rest(c, 0, phi) + 2e-6, 0, 0, phi, true);
        for (int i = 0; i < 100 << k; i++)
            ck_assert_msg(coupled_run(c, 1, &ground, phi, &force, &e), "%s", e.text);
        ck_assert_int_eq(coupled_state(c)->lift_offs, 0);
        height[k] = coupled_state(c)->height;
        residual[k] = coupled_state(c)->residual;
        arena_close(a);
    }
    double order = log2((height[1] - height[2]) / (height[2] - height[3])), balance = log2(residual[1] / residual[2]);
    printf("order %.2f; of the residual %.2f\n", order, balance);
    ck_assert_double_eq_tol(order, 4, 0.3);
    ck_assert_double_gt(balance, 3.7);
}
END_TEST

/* The method as coupled_rk4.c's head has it, nothing carried over from step to step but the state: y = (w, q...), y' =
 * (w', q'...), and the ledger. */
enum { PLAIN = 13, LEGS = 5 };

struct plain {
    double w, u, q[PLAIN], p[PLAIN], work, contact_loss, mode_loss;
};

struct plain_step {
    double h, s, s_to, phi[PLAIN], phi_to[PLAIN], force;
};

/* The rates of y at part c of the step. */
static struct plain plain_rates(const struct coupled_ask *k, const struct plain *y, const struct plain_step *o,
                                double c, double *force)
{
    struct plain r = {.w = y->u};
    double across = o->s_to - o->s, xi = o->s + c * across - y->w, closing = across / o->h - y->u,
           moved = across / o->h;
    for (int i = 0; i < PLAIN; i++) {
        double slant = o->phi_to[i] - o->phi[i], phi = o->phi[i] + c * slant;
        xi -= phi * y->q[i];
        closing -= phi * y->p[i] + slant / o->h * y->q[i];
        moved -= slant / o->h * y->q[i];
    }
    double spring = xi > 0 ? k->stiffness * pow(xi, 1.5) : 0, f = spring * fmax(0, 1 + k->mu * closing);
    for (int i = 0; i < PLAIN; i++) {
        double phi = o->phi[i] + c * (o->phi_to[i] - o->phi[i]), turn = 2 * M_PI * k->frequency[i];
        r.q[i] = y->p[i];
        r.p[i] = phi * f - 2 * k->decay[i] * y->p[i] - (turn * turn + k->decay[i] * k->decay[i]) * y->q[i];
        r.mode_loss += 2 * k->decay[i] * y->p[i] * y->p[i];
    }
    r.u = (f - k->weight) / k->mass;
    r.work = f * moved;
    r.contact_loss = (f - spring) * closing;
    *force = f;
    return r;
}

static void plain_step(const struct coupled_ask *k, struct plain *y, struct plain_step *o)
{
    static const double reach[4] = {0, 0.5, 0.5, 1}, share[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    enum { N = sizeof(struct plain) / sizeof(double) };
    struct plain at = *y, rates = {0}, sum = {0};
    o->force = 0;
    for (int j = 0; j < 4; j++) {
        double f, *to = (double *)&at;
        for (int i = 0; i < N; i++)
            to[i] = ((const double *)y)[i] + reach[j] * o->h * ((const double *)&rates)[i];
        rates = plain_rates(k, &at, o, reach[j], &f);
        for (int i = 0; i < N; i++)
            ((double *)&sum)[i] += share[j] * ((const double *)&rates)[i];
        o->force += share[j] * f;
    }
    for (int i = 0; i < N; i++)
        ((double *)y)[i] += o->h * ((const double *)&sum)[i];
}

/* Runs of one step to more than the ledger is closed in, the place moving or not, in contact and in flight. Tolerances:
   only the order of additions and where products are taken differ, of a few thousand steps that each round to 1e-16 of
   what ball and modes have; measured 8e-15. */
START_TEST(is_the_plain_method)
{
    static const int legs[LEGS] = {1, 7, 300, 1000, 600};
    static double surface[1000], force[1000];
    double f[PLAIN], decay[PLAIN], phi[PLAIN], h = 1 / (4 * BALL_RATE), off[4] = {0};
    for (int i = 0; i < PLAIN; i++) {
        f[i] = 140 + 230 * i;
        decay[i] = 10 + 6 * i;
        phi[i] = 2 * sin(0.9 * (i + 1));
    }
    for (int dropped = 0; dropped < 2; dropped++) {
        struct arena *a = arena_open();
        struct err e = {0};
        struct coupled *c = plate(a, RK4, 1 / h, 1e9, PLAIN, f, decay);
        struct coupled_ask ask = {.mass = BALL_MASS,
                                  .weight = BALL_MASS * BALL_GRAVITY,
                                  .stiffness = 1e9 * BALL_MASS,
                                  .mu = 1,
                                  .frequency = f,
                                  .decay = decay};
        coupled_start(c, coupled_rest(c, 0, phi) + dropped * 20e-6, 0, 0, phi, true);
        struct plain y = {.w = coupled_state(c)->height};
        struct plain_step o = {.h = h};
        for (int i = 0; i < PLAIN; i++)
            coupled_mode(c, i, &y.q[i], &y.p[i]);
        long done = 0, pressed = 0;
        double most = 0, high = 0, deep = 0;
        for (int leg = 0; leg < LEGS; leg++) {
            double from[PLAIN];
            memcpy(from, phi, sizeof phi);
            for (int i = 0; i < PLAIN && leg != 3; i++)
                phi[i] = 2 * sin((i + 1) * (0.9 + 0.01 * leg));
            for (int i = 0; i < legs[leg]; i++)
                surface[i] = 5 * ball_hills((double)(done + i + 1) * h);
            ck_assert_msg(coupled_run(c, legs[leg], surface, leg == 3 ? NULL : phi, force, &e), "%s", e.text);
            for (int j = 0; j < legs[leg]; j++) {
                for (int i = 0; i < PLAIN; i++) {
                    o.phi[i] = from[i] + (phi[i] - from[i]) * j / legs[leg];
                    o.phi_to[i] = from[i] + (phi[i] - from[i]) * (j + 1) / legs[leg];
                }
                o.s_to = surface[j];
                plain_step(&ask, &y, &o);
                o.s = o.s_to;
                off[0] = fmax(off[0], fabs(force[j] - o.force));
                most = fmax(most, o.force);
                pressed += o.force > 0;
            }
            done += legs[leg];
            const struct coupled_state *s = coupled_state(c);
            high = fmax(high, fabs(y.w));
            off[1] = fmax(off[1], fabs(s->height - y.w));
            for (int i = 0; i < PLAIN; i++) {
                double q, p;
                coupled_mode(c, i, &q, &p);
                deep = fmax(deep, fabs(y.q[i]));
                off[2] = fmax(off[2], fmax(fabs(q - y.q[i]), fabs(p - y.p[i]) / (2 * M_PI * f[i])));
            }
            off[3] = fmax(off[3], fmax(fabs(s->surface_work - y.work),
                                       fmax(fabs(s->contact_loss - y.contact_loss), fabs(s->mode_loss - y.mode_loss))) /
                                      s->highest);
            ck_assert_int_eq(s->contact_steps, pressed);
        }
        printf("%s: force off by %.2g of its greatest, height by %.2g, modes by %.2g, ledger by %.2g; in contact %ld "
               "of %ld steps, %ld lift-offs\n",
               dropped ? "dropped" : "lying", off[0] / most, off[1] / high, off[2] / deep, off[3], pressed, done,
               coupled_state(c)->lift_offs);
        ck_assert_int_eq(coupled_state(c)->lift_offs > 0, dropped);
        ck_assert_double_lt(off[0], 1e-13 * most);
        ck_assert_double_lt(off[1], 1e-13 * high);
        ck_assert_double_lt(off[2], 1e-13 * deep);
        ck_assert_double_lt(off[3], 1e-13);
        arena_close(a);
    }
}
END_TEST

static struct err refusal(struct ball_case b, double v, bool *made)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct coupled *c = ball_make(a, b);
    *made = ball_impact(c, b.rate, v, 0.3, &e).made;
    arena_close(a);
    return e;
}

START_TEST(refuses_hard_impacts)
{
    bool made;
    double v = 0.05, kappa = 1e10, rate = 1 / coupled_contact_time(1, kappa, v);
    refusal((struct ball_case){RK4, kappa, 1, 0, 12.05 * rate}, v, &made);
    ck_assert(made);
    struct err e = refusal((struct ball_case){RK4, kappa, 1, 0, 11.95 * rate}, v, &made);
    ck_assert(!made);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_ptr_nonnull(strstr(e.text, "lasts 11.9 steps"));
    /* mu v = 50 at 13 steps per contact: mu kappa xi^1.5 h passes 1 */
    rate = 13 / coupled_contact_time(1, kappa, 1);
    e = refusal((struct ball_case){RK4, kappa, 50, 0, rate}, 1, &made);
    ck_assert(!made);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_ptr_nonnull(strstr(e.text, "mu k xi^1.5"));
    refusal((struct ball_case){RK4, kappa, 50, 0, 6 * rate}, 1, &made);
    ck_assert(made);
}
END_TEST

/* 44.1 kHz: 5 kHz gets 37.5 1/s of the method's own, 20 kHz grows. */
START_TEST(refuses_modes_it_spoils)
{
    static const struct {
        double f, decay;
        bool good;
    } of[] = {{5000, 39, true}, {5000, 36, false}, {500, 1, true}, {10000, 100, false}, {20000, 1000, false}};
    for (int i = 0; i < 5; i++) {
        struct arena *a = arena_open();
        struct err e = {0};
        struct coupled_ask ask = {.integrator = RK4,
                                  .step = 1 / BALL_RATE,
                                  .mass = 0.01,
                                  .weight = 0.1,
                                  .stiffness = 1e9,
                                  .n = 1,
                                  .frequency = &of[i].f,
                                  .decay = &of[i].decay};
        struct coupled *c;
        bool made = coupled_make(a, &ask, &c, &e);
        ck_assert_msg(made == of[i].good, "%g Hz, %g 1/s: %s", of[i].f, of[i].decay, e.text);
        ck_assert_int_eq(e.kind, of[i].good ? ERR_NONE : ERR_SCENE);
        if (!made) { /* the cure in the message cures */
            ask.step = strtod(strstr(e.text, "at most ") + 8, NULL);
            e = (struct err){0};
            ck_assert_msg(coupled_make(a, &ask, &c, &e), "%s", e.text);
        }
        arena_close(a);
    }
}
END_TEST

UNIT("coupled_rk4", impact_is_off_as_known, impact_by_steps_per_contact, free_modes_turn_by_the_polynomial,
     rolls_like_the_discrete_gradient, order_four_in_contact, is_the_plain_method, refuses_hard_impacts,
     refuses_modes_it_spoils)
