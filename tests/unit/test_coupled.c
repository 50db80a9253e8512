/* The ball of coupled.h on rigid ground by its discrete gradient: single impacts against the closed form of Hunt and
 * Crossley's law; contacts counted; errors. */
#include "unit.h"

#include "convolution/coupled_parts.h"
#include "scene/scene.h"

#define RATE 44100.0

static struct err error;

/* Parameters per unit of mass: kappa = k / m. */
static struct coupled *ball(struct arena *a, double kappa, double mu, double gravity, double rate)
{
    struct coupled_ask ask = {
        INTEGRATOR_DISCRETE_GRADIENT, 1 / rate, 0.02, 0.02 * gravity, kappa * 0.02, mu, 0, NULL, NULL};
    struct coupled *c;
    error.kind = ERR_NONE;
    ck_assert_msg(coupled_make(a, &ask, &c, &error), "%s", error.text);
    return c;
}

static void go(struct coupled *c, int steps, const double *surface, const double *phi, double *force)
{
    ck_assert_msg(coupled_run(c, steps, surface, phi, force, &error), "%s", error.text);
}

/* Speed, downwards, after one impact at v without weight; the ball starts `phase` of a step's way above the surface. */
static double impact(double kappa, double mu, double v, double rate, double phase)
{
    static const double flat[64];
    double force[64];
    struct arena *a = arena_open();
    struct coupled *c = ball(a, kappa, mu, 0, rate);
    coupled_start(c, phase * v / rate, -v, 0, NULL, false);
    while (coupled_state(c)->lift_offs == 0 && coupled_state(c)->steps < 1 << 22) {
        go(c, 64, flat, NULL, force);
        for (int i = 0; i < 64; i++)
            ck_assert_msg(force[i] >= 0, "force %g", force[i]);
    }
    const struct coupled_state *s = coupled_state(c);
    ck_assert_int_eq(s->landings, 1);
    ck_assert_double_eq_tol(s->impact, v, 1e-14 * v);
    ck_assert_double_eq_tol(s->closing, -s->speed, 1e-9 * v); /* on its way up */
    double out = -s->speed;
    arena_close(a);
    return out;
}

/* The speed out, by halving -mu (v_out - v_in) + ln[(1 + mu v_out) / (1 + mu v_in)] = 0, v_out < 0 (Papetti et al.
 * 2011). */
static double closed_form(double mu, double v)
{
    if (mu == 0) return -v;
    double low = fmax(-1 / mu, -v), high = -1e-300;
    for (int i = 0; i < 200; i++) {
        double out = (low + high) / 2;
        *(-mu * (out - v) + log1p(mu * out) - log1p(mu * v) < 0 ? &low : &high) = out;
    }
    return low;
}

/* Greatest and least relative error over 32 phases. */
static void errors(double kappa, double mu, double v, double over, double *least, double *most)
{
    *least = INFINITY;
    *most = -INFINITY;
    for (int i = 0; i < 32; i++) {
        double off = (fabs(impact(kappa, mu, v, over * RATE, (i + 0.37) / 32)) - fabs(closed_form(mu, v))) / v;
        *least = fmin(*least, off);
        *most = fmax(*most, off);
    }
}

START_TEST(test_closed_form_is_known)
{
    ck_assert_double_eq_tol(-closed_form(1, 0.05) / 0.05, 0.967739, 1e-6);
    ck_assert_double_eq_tol(-closed_form(10, 1), 0.099982, 1e-6);
    ck_assert_double_eq_tol(-closed_form(0.3, 1), 0.8329, 1e-4);
}
END_TEST

/* Without dissipation the energy is kept by construction: only rounding is left, at any step. */
START_TEST(test_elastic_impact_keeps_its_speed)
{
    const double kappas[] = {5e7, 5e9, 5e11, 1e12}, overs[] = {1, 4, 64};
    for (int k = 0; k < 4; k++)
        for (int o = 0; o < 3; o++) {
            double least, most;
            errors(kappas[k], 0, 0.05, overs[o], &least, &most);
            ck_assert_msg(fmax(fabs(least), fabs(most)) <= 1e-12, "kappa %g over %g: %g %g", kappas[k], overs[o], least,
                          most);
        }
}
END_TEST

/* Order 2, and the same error whenever in a step the ball arrives, beyond `first` times RATE (10 steps a contact, more
 * where mu v = 10). */
START_TEST(test_dissipative_impact_is_of_second_order)
{
    const struct {
        double kappa, mu, v, first;
    } cases[] = {{5e9, 1, 0.05, 1}, {5e11, 1, 0.05, 2}, {5e11, 1, 1, 2}, {5e11, 10, 1, 8}};
    for (int k = 0; k < 4; k++) {
        double before = 0;
        for (double over = 1; over <= 64; over *= 2) {
            double least, most;
            errors(cases[k].kappa, cases[k].mu, cases[k].v, over, &least, &most);
            double order = log2(before / most);
            ck_assert_double_ge(least, 0); /* too little is lost, never too much */
            ck_assert(over <= cases[k].first || most - least <= 1e-6);
            ck_assert_msg(over <= cases[k].first || fabs(order - 2) <= 0.1, "kappa %g mu %g v %g over %g: order %g",
                          cases[k].kappa, cases[k].mu, cases[k].v, over, order);
            before = most;
        }
    }
}
END_TEST

/* 10 g at 1 m/s, mu = 0.3 s/m, stiffness up to contacts of a third of a step: never out of [exact, 1], and near the
   exact 0.8329 from 5 steps a contact on. (SDT 2.3's impact loses nothing from 2.5 steps a contact down, and 1e-3 of
   its loss at 12.) */
START_TEST(test_stiffness_up_to_contacts_below_a_step)
{
    double exact = -closed_form(0.3, 1);
    for (double k = 1e6; k <= 1e12; k *= 10)
        for (double rate = 44100; rate <= 176400; rate *= 2) {
            double e = -impact(k / 0.01, 0.3, 1, rate, 0.4), contact = coupled_contact_time(0.01, k, 1) * rate;
            ck_assert_double_ge(e, exact - 1e-12);
            ck_assert_double_le(e, 1);
            if (contact >= 5) ck_assert_double_eq_tol(e, exact, 0.5 / (contact * contact));
        }
}
END_TEST

/* kappa 1e12, mu 10, 1 m/s with 2 steps a contact, bouncing under weight: finite, no pull, and the energy never rises.
 */
START_TEST(test_stiffest_ball_gains_nothing)
{
    struct arena *a = arena_open();
    struct coupled *c = ball(a, 1e12, 10, 9.81, RATE);
    coupled_start(c, 1e-5, -1, 0, NULL, false);
    double energy = coupled_state(c)->energy, force;
    const double highest = energy, flat = 0;
    for (long i = 0; i < 200000; i++) {
        go(c, 1, &flat, NULL, &force);
        ck_assert(force >= 0 && isfinite(force));
        ck_assert_double_le(coupled_state(c)->energy, energy + 4e-16 * highest);
        energy = coupled_state(c)->energy;
    }
    ck_assert_int_gt(coupled_state(c)->lift_offs, 5);
    ck_assert_int_le(coupled_state(c)->iterations_most, 12); /* Newton's method, not halving */
    arena_close(a);
}
END_TEST

START_TEST(test_contact_is_counted)
{
    static const double flat[4000];
    static double force[4000];
    struct arena *a = arena_open();
    struct coupled *c = ball(a, 5e9, 0, 9.81, 64 * RATE);
    coupled_start(c, 1e-6, -0.05, 0, NULL, false);
    go(c, 4000, flat, NULL, force);
    const struct coupled_state *s = coupled_state(c);
    ck_assert_int_eq(s->landings, 1);
    ck_assert_int_eq(s->lift_offs, 1);
    /* the closed form knows no weight, which lengthens the contact by about G / mean force = 3e-3 */
    double exact = coupled_contact_time(0.02, 5e9 * 0.02, 0.05);
    ck_assert_double_eq_tol(exact, 0.773e-3, 1e-6);
    ck_assert_double_eq_tol(s->contact_sum, exact, 2e-2 * exact);
    ck_assert_double_eq(s->contact_least, s->contact_sum);
    ck_assert_double_eq_tol(s->flight + s->contact_time + 1e-6 / 0.05, 4000 / (64 * RATE), 1e-7);
    ck_assert_double_eq_tol((double)s->contact_steps, exact * 64 * RATE, 50);
    c = ball(a, 5e9, 0, 0, 1024 * RATE); /* and without weight, to the crossings' rounding */
    coupled_start(c, 1e-9, -0.05, 0, NULL, false);
    while (coupled_state(c)->lift_offs == 0)
        go(c, 4000, flat, NULL, force);
    ck_assert_double_eq_tol(coupled_state(c)->contact_sum, exact, 1e-6 * exact);
    arena_close(a);
}
END_TEST

START_TEST(test_errors_name_the_cause)
{
    struct arena *a = arena_open();
    enum { N = 11 };
    double frequencies[N], decays[N], phi[N] = {0}, surface[3] = {0, 0, NAN}, force[3];
    for (int i = 0; i < N; i++) {
        frequencies[i] = 2000 * i + 1500;
        decays[i] = 10;
    }
    struct coupled_ask ask = {INTEGRATOR_DISCRETE_GRADIENT, 1 / RATE, 0.02, 0.2, 1e8, 1, N, frequencies, decays};
    struct coupled *c;
    error.kind = ERR_NONE;
    ck_assert(coupled_make(a, &ask, &c, &error));
    coupled_start(c, 1e-3, 0, 0, phi, false);
    ck_assert(!coupled_run(c, 3, surface, phi, force, &error) && error.kind == ERR_NUMBERS &&
              strstr(error.text, "surface") && strstr(error.text, "step 3"));
    error.kind = ERR_NONE;
    phi[4] = INFINITY;
    ck_assert(!coupled_run(c, 2, surface, phi, force, &error) && error.kind == ERR_NUMBERS &&
              strstr(error.text, "mode 5"));
    error.kind = ERR_NONE;
    coupled_start(c, 1e200, 1e200, 0, NULL, false);
    ck_assert(!coupled_run(c, 2, surface, NULL, force, &error) && error.kind == ERR_NUMBERS &&
              strstr(error.text, "finite") && strstr(error.text, "velocity"));
    ask.step = 1 / 40000.0;
    error.kind = ERR_NONE;
    ck_assert(!coupled_make(a, &ask, &c, &error) && error.kind == ERR_SCENE && strstr(error.text, "mode 11"));
    error.kind = ERR_NONE;
    ask.integrator = INTEGRATOR_EXACT_IMPACT;
    ck_assert(!coupled_make(a, &ask, &c, &error) && error.kind == ERR_SCENE && strstr(error.text, "exact_impact"));
    error.kind = ERR_NONE;
    ask.mu = -1;
    ck_assert(!coupled_make(a, &ask, &c, &error) && error.kind == ERR_SCENE && strstr(error.text, "mu"));
    arena_close(a);
}
END_TEST

/* A ledger that is wrong by 0.9 and by 1.1 of what is allowed, either way, with each part of the energy the largest in
   turn: only the latter is refused, as an error of numbers that names the part. */
START_TEST(test_a_ledger_out_of_balance_is_refused)
{
    static const char *const parts[] = {"the ball's velocity", "the ball's height", "the modes", "the contact"};
    struct arena *a = arena_open();
    double frequency = 1000, decay = 10, phi = 1, flat[100] = {0}, force[100];
    struct coupled_ask ask = {.integrator = INTEGRATOR_DISCRETE_GRADIENT,
                              .step = 1 / RATE,
                              .mass = 0.02,
                              .weight = 0.2,
                              .stiffness = 1e8,
                              .mu = 1,
                              .n = 1,
                              .frequency = &frequency,
                              .decay = &decay};
    struct coupled *c;
    error.kind = ERR_NONE;
    ck_assert(coupled_make(a, &ask, &c, &error));
    for (int i = 0; i < 16; i++) {
        int part = i / 4, wrong = i % 2, sign = i % 4 < 2 ? 1 : -1;
        coupled_start(c, 1, 0, 0, &phi, false);
        go(c, 100, flat, NULL, force);
        c->speed = part == 0 ? 100 : 0;
        c->height = part == 1 ? 100 : 0;
        c->modes.p[0] = part == 2 ? 100 : 0;
        c->penetration = part == 3 ? 0.1 : -1;
        ck_assert(coupled_balance(c, false, &error));
        const struct coupled_state *s = coupled_state(c);
        c->energy_start += s->residual; /* whatever it was: now it balances, to rounding */
        double bound = (1e-10 + 4 * 0x1p-52 * 100) * s->energy;
        ck_assert_msg(coupled_balance(c, true, &error) && fabs(s->residual) < 1e-3 * bound, "%s", error.text);
        ck_assert_double_eq_tol(s->highest, s->energy, 1e-12 * s->energy);
        coupled_sum_add(i % 3 ? &c->contact_loss : &c->mode_loss, sign * (wrong ? 1.1 : 0.9) * bound);
        ck_assert_msg(coupled_balance(c, true, &error) == !wrong, "%d: %g, %g", i, s->residual, bound);
        ck_assert(!wrong || (error.kind == ERR_NUMBERS && strstr(error.text, "off balance by") &&
                             strstr(error.text, arena_format(a, "most of it in %s", parts[part]))));
        ck_assert(coupled_balance(c, false, &error)); /* rk4 has none to hold */
        error.kind = ERR_NONE;
    }
    arena_close(a);
}
END_TEST

/* Lift-offs, landings and flights of a ball that keeps its energy: each impact of sqrt(2 g h) sends it up for 2 sqrt(2
 * h / g) again. */
START_TEST(test_flights_are_counted)
{
    struct arena *a = arena_open();
    double flat[64] = {0}, force[64], flight = 2 * sqrt(2 * 1e-3 / 9.81);
    for (int i = 0; i < 3; i++) {
        struct coupled *c = ball(a, 5e9, 0, 9.81, RATE);
        coupled_flights(c, flight * (const double[]){0, 0.99, 1.01}[i]);
        coupled_start(c, 1e-3, 0, 0, NULL, false);
        while (coupled_state(c)->landings < 6)
            go(c, 64, flat, NULL, force);
        ck_assert_int_ge(coupled_state(c)->lift_offs, 5);
        ck_assert_int_eq(coupled_state(c)->flights, i < 2 ? 5 : 0); /* the fall is none */
    }
    arena_close(a);
}
END_TEST

/* What is seen in the midst of runs is what a ball says that runs so far and no further: bit by bit but for modes,
   where the cut rounds otherwise. Watching changes no bit of the forces, nor of the account at the end. By each
   integrator, bouncing, and over a place that moves. */
START_TEST(test_watching_changes_nothing)
{
    enum { STEPS = 700, EVERY = 7, MODES = 9 };
    static double surface[STEPS], force[STEPS], watched[STEPS], cut[STEPS];
    static struct coupled_state seen[STEPS / EVERY + 1];
    double frequency[MODES], decay[MODES], phi[MODES], to[MODES], on[MODES];
    for (int i = 0; i < STEPS; i++)
        surface[i] = 2e-6 * sin(0.02 * i);
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 300 + 400 * i;
        decay[i] = 30;
        phi[i] = cos(i);
        to[i] = cos(i + 0.1);
    }
    for (int integrator = 0; integrator < 3; integrator++) {
        struct arena *a = arena_open();
        struct coupled *c[3];
        int n = integrator == INTEGRATOR_EXACT_IMPACT ? 0 : MODES;
        for (int k = 0; k < 3; k++) {
            ck_assert(coupled_make(a, &(struct coupled_ask){integrator, 1e-5, 0.02, 0.2, 1e8, 1, n, frequency, decay},
                                   &c[k], &error));
            coupled_start(c[k], 1e-6, -0.01, 0, phi, false);
        }
        ck_assert(coupled_run(c[0], STEPS, surface, to, force, &error));
        coupled_watch(c[1], EVERY, seen);
        ck_assert(coupled_run(c[1], STEPS, surface, to, watched, &error));
        ck_assert(!memcmp(force, watched, sizeof force) &&
                  !memcmp(coupled_state(c[0]), coupled_state(c[1]), sizeof *seen));
        ck_assert_int_gt(coupled_state(c[0])->lift_offs, 1);
        for (int i = 0; i < STEPS; i += EVERY) {
            const struct coupled_state *x = &seen[i / EVERY], *y = coupled_state(c[2]);
            double least = 1e-9 * y->highest;
            ck_assert(x->steps == y->steps && x->lift_offs == y->lift_offs && x->landings == y->landings &&
                      x->flights == y->flights);
            ck_assert_double_eq_tol(x->height, y->height, 1e-13);
            ck_assert_double_eq_tol(x->penetration, y->penetration, 1e-13);
            ck_assert_double_eq_tol(x->contact_time, y->contact_time, 1e-10);
            ck_assert(fabs(x->energy - y->energy) < least && fabs(x->surface_work - y->surface_work) < least &&
                      fabs(x->mode_loss - y->mode_loss) < least);
            ck_assert(fabs(x->contact_loss - y->contact_loss) < least &&
                      (integrator == INTEGRATOR_RK4 || fabs(x->residual) < 1e-12 * y->highest));
            for (int k = 0; k < MODES; k++)
                on[k] = phi[k] + (to[k] - phi[k]) * (i + EVERY) / STEPS;
            ck_assert(coupled_run(c[2], EVERY, surface + i, on, cut + i, &error));
        }
        arena_close(a);
    }
}
END_TEST

UNIT("coupled", test_a_ledger_out_of_balance_is_refused, test_flights_are_counted, test_watching_changes_nothing,
     test_closed_form_is_known, test_elastic_impact_keeps_its_speed, test_dissipative_impact_is_of_second_order,
     test_stiffness_up_to_contacts_below_a_step, test_stiffest_ball_gains_nothing, test_contact_is_counted,
     test_errors_name_the_cause)
