/* The discrete gradient on modes: its steps against a slow plain reference, ring-down against exact poles, whole
   trajectories against GSL's Runge-Kutta of order 8, rest against statics. */
#include "unit.h"

#include <complex.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "convolution/coupled.h"
#include "scene/scene.h"

#define RATE 44100.0

static struct err error;

static void go(struct coupled *c, int steps, const double *surface, const double *phi, double *force)
{
    ck_assert_msg(coupled_run(c, steps, surface, phi, force, &error), "%s", error.text);
}

/* Modes that a plain reference steps in long double, straight from the formulas at the head of coupled_gradient.c. */
enum { N = 11 };
struct plain {
    long double h, m, weight, k, mu, w, u, s, xi;
    long double q[N], p[N], phi[N], damping[N], square[N], mass[N];
};

static long double potential(const struct plain *r, long double xi)
{
    return xi > 0 ? 0.4L * r->k * xi * xi * sqrtl(xi) : 0;
}

static long double plain_force(const struct plain *r, long double to)
{
    long double by = to - r->xi, rate = 1 + r->mu * by / r->h;
    long double gradient = fabsl(by) > 1e-12L * fabsl(r->xi) ? (potential(r, to) - potential(r, r->xi)) / by
                           : r->xi > 0                       ? r->k * r->xi * sqrtl(r->xi)
                                                             : 0;
    return rate > 0 ? gradient * rate : 0;
}

static long double plain_modes(const struct plain *r, const double *phi, long double force, long double *q,
                               long double *p)
{
    long double bent = 0;
    for (int i = 0; i < N; i++) {
        long double h = r->h, pull = (r->phi[i] + phi[i]) / 2 * force / r->mass[i];
        long double middle =
            (r->p[i] + h / 2 * (pull - r->square[i] * r->q[i])) / (1 + r->damping[i] * h + r->square[i] * h * h / 4);
        q[i] = r->q[i] + h * middle;
        p[i] = 2 * middle - r->p[i];
        bent += phi[i] * q[i];
    }
    return bent;
}

static double plain_step(struct plain *r, double surface, const double *phi)
{
    long double q[N], p[N], low = 0, high = 1e4L, force = 0, xi = 0, h = r->h;
    for (int i = 0; i < 200; i++) { /* halve the force: what it leads to asks for less as it grows */
        force = (low + high) / 2;
        long double w = r->w + h * r->u + h * h / (2 * r->m) * (force - r->weight);
        xi = surface - plain_modes(r, phi, force, q, p) - w;
        *(plain_force(r, xi) > force ? &low : &high) = force;
    }
    if (high < 1e-30L) {
        force = 0;
        xi = surface - plain_modes(r, phi, 0, q, p) - (r->w + h * r->u - h * h / (2 * r->m) * r->weight);
    }
    r->w += h * r->u + h * h / (2 * r->m) * (force - r->weight);
    r->u += h / r->m * (force - r->weight);
    r->xi = xi;
    for (int i = 0; i < N; i++) {
        r->q[i] = q[i];
        r->p[i] = p[i];
        r->phi[i] = phi[i];
    }
    return (double)force;
}

static const double frequencies[N] = {80, 151, 340, 700, 1234, 2999, 5000, 9000, 14000, 19000, 21500};
static double decays[N];

static struct coupled *on_modes(struct arena *a, int n, double kappa, double mu, double rate)
{
    for (int i = 0; i < N; i++)
        decays[i] = 3 + 0.01 * frequencies[i];
    struct coupled_ask ask = {
        INTEGRATOR_DISCRETE_GRADIENT, 1 / rate, 0.02, 0.02 * 9.81, kappa * 0.02, mu, n, frequencies, decays};
    struct coupled *c;
    error.kind = ERR_NONE;
    ck_assert_msg(coupled_make(a, &ask, &c, &error), "%s", error.text);
    return c;
}

static void plain_start(struct plain *r, const struct coupled *c, double kappa, double mu, const double *phi)
{
    const struct coupled_state *s = coupled_state(c);
    *r = (struct plain){.h = 1 / RATE,
                        .m = 0.02,
                        .weight = 0.02 * 9.81,
                        .k = kappa * 0.02,
                        .mu = mu,
                        .w = s->height,
                        .u = s->speed,
                        .xi = s->penetration};
    for (int i = 0; i < N; i++) {
        complex double pole = 2 * RATE * ctanh((-decays[i] + 2 * M_PI * frequencies[i] * I) / (2 * RATE));
        r->damping[i] = -creal(pole);
        r->square[i] = creal(pole) * creal(pole) + cimag(pole) * cimag(pole);
        r->mass[i] = (decays[i] * decays[i] + 4 * M_PI * M_PI * frequencies[i] * frequencies[i]) / r->square[i];
        r->phi[i] = phi[i];
    }
}

static void shapes(double at, double *phi)
{
    for (int i = 0; i < N; i++)
        phi[i] = 1.5 * sin((i + 1) * at);
}

/* Landings, lift-offs, resting and a place that moves (shapes change sign): step by step the plain reference's forces.
   Rounding differs, and each bounce multiplies that by up to 4 (after 15 of the stiffest case 1e-6 would be left of
   it): 1e-10 is for the first 600 steps. */
START_TEST(test_steps_are_the_plain_reference)
{
    enum { STEPS = 600, PIECE = 120 };
    const struct {
        double kappa, mu, bump;
    } cases[] = {{5e9, 1, 0}, {5e9, 0.1, 3e-6}, {5e11, 10, 1e-6}};
    for (int k = 0; k < 3; k++) {
        struct arena *a = arena_open();
        struct coupled *c = on_modes(a, N, cases[k].kappa, cases[k].mu, RATE);
        struct plain r;
        double phi[N], from[N], on[N], surface[PIECE], force[PIECE];
        shapes(0.9, phi);
        coupled_start(c, 2e-6, -0.01, 0, phi, false);
        plain_start(&r, c, cases[k].kappa, cases[k].mu, phi);
        double most = 0, worst = 0;
        for (int done = 0; done < STEPS; done += PIECE) {
            memcpy(from, phi, sizeof phi);
            shapes(0.9 + 0.4 * (done + PIECE) / STEPS, phi);
            for (int i = 0; i < PIECE; i++)
                surface[i] = cases[k].bump * sin(0.06 * (done + i + 1));
            go(c, PIECE, surface, phi, force);
            for (int i = 0; i < PIECE; i++) {
                for (int n = 0; n < N; n++)
                    on[n] = from[n] + (phi[n] - from[n]) * (i + 1) / PIECE;
                double plain = plain_step(&r, surface[i], on);
                most = fmax(most, plain);
                worst = fmax(worst, fabs(force[i] - plain));
            }
        }
        ck_assert_int_gt(coupled_state(c)->lift_offs, 2);
        ck_assert_double_le(worst, 1e-10 * most);
        arena_close(a);
    }
}
END_TEST

/* Bent by a weight and let go, the ball out of reach: q = q0 exp(-sigma t) (cos wt + b sin wt), b = sigma~ / w~ of the
 * step's pole; up to 0.4875 of the rate. */
START_TEST(test_modes_ring_down_with_their_own_poles)
{
    static const double flat[1000];
    static double force[1000];
    struct arena *a = arena_open();
    struct coupled *c = on_modes(a, N, 5e9, 1, RATE);
    double phi[N], q, p;
    shapes(0.9, phi);
    coupled_start(c, 1000, 0, 0, phi, true);
    for (int k = 1; k <= 40; k++) {
        go(c, 1000, flat, NULL, force);
        for (int i = 0; i < N; i++) {
            double t = 1000 * k / RATE,
                   bent = phi[i] * 0.02 * 9.81 /
                          (decays[i] * decays[i] + 4 * M_PI * M_PI * frequencies[i] * frequencies[i]);
            complex double pole = ctanh((-decays[i] + 2 * M_PI * frequencies[i] * I) / (2 * RATE));
            double turns = frequencies[i] * k * 1000 / RATE, angle = 2 * M_PI * (turns - floor(turns)),
                   b = -creal(pole) / cimag(pole);
            coupled_mode(c, i, &q, &p);
            ck_assert_msg(fabs(q - bent * exp(-decays[i] * t) * (cos(angle) + b * sin(angle))) <=
                              1e-10 * fabs(bent) * exp(-decays[i] * t),
                          "mode %d after %g s", i, t);
        }
    }
    ck_assert_int_eq(coupled_state(c)->contact_steps, 0);
    arena_close(a);
}
END_TEST

/* A surface of steps under a place that moves through the modes' nodal lines: the balance holds, the losses never fall,
 * and the force hands over the ball's momentum. */
START_TEST(test_energy_balances_on_steps_and_moving)
{
    enum { PIECE = 100 };
    struct arena *a = arena_open();
    struct coupled *c = on_modes(a, N, 5e10, 0.5, RATE);
    double phi[N], surface[PIECE], force[PIECE], loss = 0, modal = 0, momentum = 0, work = 0, last = 0;
    shapes(0.5, phi);
    coupled_start(c, coupled_rest(c, 0, phi), 0, 0, phi, true);
    unsigned seed = 7;
    for (int k = 0; k < 2205; k++) {
        for (int i = 0; i < PIECE; i++) {
            seed = seed * 1664525u + 1013904223u;
            surface[i] = i % 20 ? last : 2e-6 * ((double)(seed >> 8) / 0x1p24 - 0.5);
            last = surface[i];
        }
        shapes(0.5 + 0.002 * k, phi);
        go(c, PIECE, surface, phi, force);
        const struct coupled_state *s = coupled_state(c);
        ck_assert(s->contact_loss >= loss && s->mode_loss >= modal);
        loss = s->contact_loss;
        modal = s->mode_loss;
        for (int i = 0; i < PIECE; i++)
            momentum += (force[i] - 0.02 * 9.81) / RATE;
        ck_assert_double_eq_tol(momentum, 0.02 * s->speed, 1e-12);
        ck_assert_double_le(fabs(s->residual), 1e-10 * s->highest);
        work = fmax(work, fabs(s->surface_work));
    }
    const struct coupled_state *s = coupled_state(c);
    ck_assert(work > 0 && loss > 0 && modal > 0 && s->lift_offs > 100);
    arena_close(a);
}
END_TEST

/* 1 mm onto rigid ground and onto modes: it comes to rest, carried by m g and pressed in by (m g / k)^(2/3). */
START_TEST(test_dropped_ball_comes_to_rest)
{
    enum { PIECE = 441 };
    static const double flat[PIECE];
    static double force[PIECE];
    for (int n = 0; n <= N; n += N) {
        struct arena *a = arena_open();
        struct coupled *c = on_modes(a, n, 5e9, 2, RATE);
        double phi[N], mean = 0, q, p;
        shapes(0.9, phi);
        coupled_start(c, 1e-3, 0, 0, phi, false);
        for (int k = 0; k < 1200; k++) {
            go(c, PIECE, flat, NULL, force);
            for (int i = 0; k >= 1100 && i < PIECE; i++)
                mean += force[i] / (100 * PIECE);
        }
        const struct coupled_state *s = coupled_state(c);
        double xi = pow(9.81 / 5e9, 2.0 / 3);
        ck_assert_double_eq_tol(s->penetration, xi, 1e-6 * xi);
        ck_assert_double_eq_tol(mean, 0.02 * 9.81, 1e-9);
        ck_assert_double_eq_tol(s->height, coupled_rest(c, 0, phi), 1e-6 * xi);
        ck_assert(s->flight == 0 && s->lift_offs >= 1 && s->landings == s->lift_offs + 1);
        for (int i = 0; i < n; i++) {
            double bent =
                phi[i] * 0.02 * 9.81 / (decays[i] * decays[i] + 4 * M_PI * M_PI * frequencies[i] * frequencies[i]);
            coupled_mode(c, i, &q, &p);
            ck_assert_double_eq_tol(q, bent, 1e-6 * fabs(bent));
        }
        arena_close(a);
    }
}
END_TEST

/* Settled at the height of rest, nothing rings: 60 s rigid, 10 s on modes. */
START_TEST(test_settled_ball_stays)
{
    enum { PIECE = 44100 };
    static double surface[PIECE], force[PIECE];
    for (int i = 0; i < PIECE; i++)
        surface[i] = 0.003;
    for (int n = 0; n <= N; n += N) {
        struct arena *a = arena_open();
        struct coupled *c = on_modes(a, n, 5e9, 1, RATE);
        double phi[N], worst = 0;
        shapes(0.9, phi);
        coupled_start(c, coupled_rest(c, 0.003, phi), 0, 0.003, phi, true);
        for (int k = 0; k < (n ? 10 : 60); k++) {
            go(c, PIECE, surface, NULL, force);
            for (int i = 0; i < PIECE; i++)
                worst = fmax(worst, fabs(force[i] / (0.02 * 9.81) - 1));
        }
        ck_assert_double_le(worst, 1e-11);
        ck_assert_int_eq(coupled_state(c)->lift_offs, 0);
        arena_close(a);
    }
}
END_TEST

/* The differential equations themselves, on 3 modes, the surface a sine and phi straight from one end to the other. */
enum { FEW = 3 };
struct motion_of {
    double from[FEW], slope[FEW];
};

static double continuous_force(double t, const double *y, const struct motion_of *m)
{
    double xi = 1.5e-7 * sin(900 * t) - y[0], speed = 1.5e-7 * 900 * cos(900 * t) - y[1];
    for (int i = 0; i < FEW; i++) {
        double phi = m->from[i] + m->slope[i] * t;
        xi -= phi * y[2 + 2 * i];
        speed -= phi * y[3 + 2 * i] + m->slope[i] * y[2 + 2 * i];
    }
    return xi > 0 ? 5e9 * 0.02 * pow(xi, 1.5) * fmax(0, 1 + 2 * speed) : 0;
}

static int slopes(double t, const double y[], double dy[], void *self)
{
    const struct motion_of *m = self;
    double f = continuous_force(t, y, m);
    dy[0] = y[1];
    dy[1] = f / 0.02 - 9.81;
    for (int i = 0; i < FEW; i++) {
        double square = decays[i] * decays[i] + 4 * M_PI * M_PI * frequencies[i] * frequencies[i];
        dy[2 + 2 * i] = y[3 + 2 * i];
        dy[3 + 2 * i] = (m->from[i] + m->slope[i] * t) * f - 2 * decays[i] * y[3 + 2 * i] - square * y[2 + 2 * i];
    }
    return GSL_SUCCESS;
}

/* Height and modes after 20 ms; how far from GSL's, relative to the ball's own movement. */
static double far_off(double over, const double *exact, const struct motion_of *m)
{
    enum { STEPS = 882 };
    int steps = (int)(STEPS * over);
    struct arena *a = arena_open();
    struct coupled *c = on_modes(a, FEW, 5e9, 2, over * RATE);
    double *surface = ARENA_TAKE(a, double, steps), *force = ARENA_TAKE(a, double, steps), to[FEW], q, p;
    for (int i = 0; i < steps; i++)
        surface[i] = 1.5e-7 * sin(900 * (i + 1) / (over * RATE));
    for (int i = 0; i < FEW; i++)
        to[i] = m->from[i] + m->slope[i] * STEPS / RATE;
    coupled_start(c, coupled_rest(c, 0, m->from), 0, 0, m->from, true);
    go(c, steps, surface, to, force);
    double off = fabs(coupled_state(c)->height - exact[0]) / 1e-6;
    for (int i = 0; i < FEW; i++) {
        coupled_mode(c, i, &q, &p);
        off = fmax(off, fabs(q - exact[2 + 2 * i]) / 1e-6);
    }
    ck_assert_int_eq(coupled_state(c)->lift_offs, 0);
    arena_close(a);
    return off;
}

START_TEST(test_trajectory_is_that_of_the_equations)
{
    struct motion_of m = {{1.2, -0.7, 0.4}, {-80, 40, 30}};
    gsl_odeiv2_system system = {slopes, NULL, 2 + 2 * FEW, &m};
    gsl_odeiv2_driver *d = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-6, 1e-16, 1e-12);
    double y[2 + 2 * FEW] = {0}, t = 0;
    for (int i = 0; i < FEW; i++)
        decays[i] = 3 + 0.01 * frequencies[i];
    y[0] = -pow(9.81 / 5e9, 2.0 / 3);
    for (int i = 0; i < FEW; i++) {
        y[2 + 2 * i] =
            m.from[i] * 0.02 * 9.81 / (decays[i] * decays[i] + 4 * M_PI * M_PI * frequencies[i] * frequencies[i]);
        y[0] -= m.from[i] * y[2 + 2 * i];
    }
    ck_assert_int_eq(gsl_odeiv2_driver_apply(d, &t, 882 / RATE, y), GSL_SUCCESS);
    gsl_odeiv2_driver_free(d);
    double before = 0;
    for (double over = 1; over <= 64; over *= 4) {
        double off = far_off(over, y, &m);
        ck_assert(over < 4 || fabs(log2(before / off) / 2 - 2) <= 0.1);
        before = off;
    }
    ck_assert_double_le(before, 1e-6);
}
END_TEST

/* How a sound is cut into runs changes nothing: bit by bit without modes, to the rounding with them. */
START_TEST(test_runs_may_be_cut_anywhere)
{
    enum { STEPS = 3000 };
    static double surface[STEPS], whole[STEPS], cut[STEPS];
    for (int i = 0; i < STEPS; i++)
        surface[i] = 1e-7 * sin(0.05 * i);
    for (int n = 0; n <= N; n += N) {
        struct arena *a = arena_open();
        struct coupled *one = on_modes(a, n, 5e9, 1, RATE), *two = on_modes(a, n, 5e9, 1, RATE);
        double phi[N];
        shapes(0.9, phi);
        coupled_start(one, coupled_rest(one, 0, phi), 0, 0, phi, true);
        coupled_start(two, coupled_rest(one, 0, phi), 0, 0, phi, true);
        go(one, STEPS, surface, NULL, whole);
        for (int i = 0, more; i < STEPS; i += more) {
            more = i % 7 + 1 < STEPS - i ? i % 7 + 1 : STEPS - i;
            go(two, more, surface + i, phi, cut + i);
        }
        for (int i = 0; i < STEPS; i++)
            ck_assert(fabs(whole[i] - cut[i]) <= (n ? 1e-12 : 0));
        arena_close(a);
    }
}
END_TEST

UNIT("coupled_gradient", test_steps_are_the_plain_reference, test_modes_ring_down_with_their_own_poles,
     test_energy_balances_on_steps_and_moving, test_dropped_ball_comes_to_rest, test_settled_ball_stays,
     test_trajectory_is_that_of_the_equations, test_runs_may_be_cut_anywhere)
