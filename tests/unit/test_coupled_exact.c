/* exact_impact against the closed form of an isolated impact (all of it: end, path, loss), against the discrete
   gradient in fine steps for what the closed form does not know (gravity in the contact, a ground that moves), and
   against its own balance of energy. */
#include "unit.h"

#include "balls.h"

static const double kappas[] = {5e7, 5e9, 5e11, 1e12}, mus[] = {0, 0.1, 1, 10}, speeds[] = {0.001, 0.05, 1};

enum { PHASES = 32, EXACT = INTEGRATOR_EXACT_IMPACT };

/* Worst error of the 32 phases, part of v: speed, momentum and loss. */
static double worst_of(struct arena *a, struct ball_case b, double v)
{
    struct err e = {0};
    struct coupled *c = ball_make(a, b);
    double leaves = ball_leaves(b.mu, v), worst = 0, whole = 0.5 * BALL_MASS * v * v;
    for (int i = 0; i < PHASES; i++) {
        struct ball_impact r = ball_impact(c, b.rate, v, (i + 0.5) / PHASES, &e);
        ck_assert_msg(r.made, "%s", e.text);
        worst = fmax(worst, fabs(r.leaves - leaves) / v);
        worst = fmax(worst, fabs(r.momentum / BALL_MASS - v - leaves) / v);
        worst = fmax(worst, fabs(r.loss - 0.5 * BALL_MASS * (v * v - leaves * leaves)) / whole);
        ck_assert_double_ge(r.least, 0);
    }
    return worst;
}

/* 1e-11 is the promise; rounding, in up to 30000 steps, leaves 4e-14 of it. */
START_TEST(restitution_is_exact)
{
    double worst = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 3; k++)
                for (int over = 1; over <= (i == j ? 64 : 4); over *= 4) {
                    struct arena *a = arena_open();
                    double of =
                        worst_of(a, (struct ball_case){EXACT, kappas[i], mus[j], 0, BALL_RATE * over}, speeds[k]);
                    ck_assert_msg(of <= 1e-11, "kappa %g mu %g v %g x%d: %g", kappas[i], mus[j], speeds[k], over, of);
                    worst = fmax(worst, of);
                    arena_close(a);
                }
    printf("worst of speed, momentum and loss: %.2g\n", worst);
}
END_TEST

/* Inside the impact too, xi and v lie on xi^2.5 = 5 / (2 kappa mu^2) (mu (v_in - v) + ln((1 + mu v)/(1 + mu v_in))). */
START_TEST(path_is_the_closed_form)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double kappa = 5e9, mu = 2, v_in = 0.4, ground = 0, force;
    struct coupled *c = ball_make(a, (struct ball_case){EXACT, kappa, mu, 0, BALL_RATE});
    coupled_start(c, 0, -v_in, 0, NULL, false);
    int steps = 0;
    for (; coupled_state(c)->lift_offs == 0 && steps < 1000; steps++) {
        ck_assert(coupled_run(c, 1, &ground, NULL, &force, &e));
        double v = coupled_state(c)->closing, xi = fmax(0, coupled_state(c)->penetration);
        double right = 2.5 / (kappa * mu * mu) * (mu * (v_in - v) + log((1 + mu * v) / (1 + mu * v_in)));
        ck_assert_double_eq_tol(pow(xi, 2.5), right, 1e-11 * v_in * v_in / kappa);
    }
    ck_assert_int_gt(steps, 10);
    arena_close(a);
}
END_TEST

/* Against the discrete gradient in steps 256 times finer (its error is printed first): settled on hills it follows, and
 * bouncing. */
START_TEST(rolls_like_the_discrete_gradient)
{
    enum { N = 1323 };
    static double fine[N], finer[N], w[N];
    static const struct {
        double height, drop;
    } scenes[] = {{1, 0}, {20, 0}, {5, 2e-6}};
    for (int i = 0; i < 3; i++) {
        struct ball_case b = {INTEGRATOR_DISCRETE_GRADIENT, 5e9, 1, BALL_GRAVITY, 0};
        double height = scenes[i].height, drop = scenes[i].drop, off[4];
        ball_roll(b, 128, height, drop, N, fine);
        ball_roll(b, 256, height, drop, N, finer);
        for (int k = 0; k < N; k++)
            finer[k] += (finer[k] - fine[k]) / 3;
        b.integrator = EXACT;
        for (int k = 0; k < 4; k++) {
            ball_roll(b, 2 << k, height, drop, N, w);
            off[k] = ball_distance(N, w, finer);
        }
        printf("hills of %g um: discrete gradient x128 off by %.2g m; exact_impact x2, x4, x8, x16: %.2g %.2g %.2g "
               "%.2g (order %.2f)\n",
               height, ball_distance(N, fine, finer), off[0], off[1], off[2], off[3], log2(off[2] / off[3]));
        ck_assert_double_lt(off[3], 1e-2 * 1e-6 * height);
        ck_assert_double_eq_tol(log2(off[2] / off[3]), 2, 0.2);
    }
}
END_TEST

/* Dropped from 1 cm: parabolas to rounding, each flight 2 v / g long (to the step), each landing at the speed of the
   lift-off before it, bouncing off with the closed form's speed, but for gravity in the contact, whose work is lost at
   a rate of mu g (mu g t_c: 1e-3 here). */
START_TEST(bounces)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double mu = 0.2, g = BALL_GRAVITY, h = 1 / BALL_RATE, ground = 3, force, fell = 0.01, before = sqrt(2 * g * fell),
           flight = 0;
    struct coupled *c = ball_make(a, (struct ball_case){EXACT, 5e9, mu, g, BALL_RATE});
    const struct coupled_state *s = coupled_state(c);
    coupled_start(c, ground + fell, 0, ground, NULL, false);
    for (int i = 0; s->landings < 8 && i < 1000000; i++) {
        long landed = s->landings;
        double up = s->height - ground, airborne = s->flight;
        ck_assert_msg(coupled_run(c, 1, &ground, NULL, &force, &e), "%s", e.text);
        if (s->landings == 0)
            ck_assert_double_eq_tol(s->height - ground, fell - 0.5 * g * pow((double)s->steps * h, 2), 1e-13);
        else if (s->landings > landed)
            flight = airborne + up / s->impact;
        if (s->landings == landed) continue;
        ck_assert_double_eq_tol(s->impact, before, 1e-3 * before);
        if (landed > 0) ck_assert_double_eq_tol(flight, 2 * s->impact / g, h);
        before = ball_leaves(mu, s->impact);
    }
    ck_assert_int_eq(s->landings, 8);
    arena_close(a);
}
END_TEST

/* White heights at every step, 50 um: the ground falls away faster than 1/mu, hits at metres per second. Forces never
   pull, losses never fall, the balance holds a hundred times better than asked, and momentum is handed over exactly. */
START_TEST(keeps_its_balance)
{
    enum { N = 441000, AT_ONCE = 100 };
    static const double of[] = {0, 1, 10};
    for (int j = 0; j < 3; j++) {
        struct arena *a = arena_open();
        struct err e = {0};
        struct coupled *c = ball_make(a, (struct ball_case){EXACT, 5e10, of[j], BALL_GRAVITY, BALL_RATE});
        const struct coupled_state *s = coupled_state(c);
        double surface[AT_ONCE], force[AT_ONCE], lost = 0, momentum = 0;
        unsigned long long seed = 1;
        coupled_start(c, coupled_rest(c, 0, NULL), 0, 0, NULL, true);
        for (int i = 0; i < N; i += AT_ONCE) {
            for (int k = 0; k < AT_ONCE; k++)
                surface[k] =
                    50e-6 *
                    ((double)((seed = seed * 6364136223846793005ULL + 1442695040888963407ULL) >> 40) / 16777216 - 0.5);
            ck_assert_msg(coupled_run(c, AT_ONCE, surface, NULL, force, &e), "%s", e.text);
            for (int k = 0; k < AT_ONCE; k++) {
                ck_assert_double_ge(force[k], 0);
                momentum += (force[k] - BALL_MASS * BALL_GRAVITY) / BALL_RATE;
            }
            ck_assert_double_ge(s->contact_loss, lost);
            lost = s->contact_loss;
        }
        printf("mu %g: %ld landings, at most %.2g m/s, %ld iterations at most (mean %.2f), residual %.2g of %.2g J\n",
               of[j], s->landings, s->impact_most, s->iterations_most, (double)s->iterations / (double)s->contact_steps,
               s->residual, s->highest);
        ck_assert_double_lt(fabs(s->residual), 1e-12 * s->highest);
        ck_assert_double_eq_tol(momentum / BALL_MASS, s->speed, 1e-10);
        ck_assert_int_gt(s->landings, 50);
        ck_assert_int_le(s->iterations_most, 60);
        arena_close(a);
    }
}
END_TEST

START_TEST(rests)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct coupled *c = ball_make(a, (struct ball_case){EXACT, 5e9, 1, BALL_GRAVITY, BALL_RATE});
    double ground[100], force[100], weight = BALL_MASS * BALL_GRAVITY;
    for (int i = 0; i < 100; i++)
        ground[i] = 0;
    coupled_start(c, coupled_rest(c, 0, NULL), 0, 0, NULL, true);
    double from = coupled_state(c)->penetration;
    for (int i = 0; i < 10000; i++)
        ck_assert(coupled_run(c, 100, ground, NULL, force, &e));
    ck_assert_double_eq_tol(force[99], weight, 1e-12 * weight);
    ck_assert_double_eq_tol(coupled_state(c)->penetration, from, 1e-12 * from);
    ck_assert_int_eq(coupled_state(c)->lift_offs, 0);
    arena_close(a);
}
END_TEST

START_TEST(refuses)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double one = 100, ground = 0, force;
    struct coupled_ask ask = {.integrator = EXACT,
                              .step = 1e-4,
                              .mass = 1,
                              .weight = 9.81,
                              .stiffness = 1e9,
                              .mu = 1,
                              .n = 1,
                              .frequency = &one,
                              .decay = &one};
    struct coupled *c;
    ck_assert(!coupled_make(a, &ask, &c, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    e = (struct err){0};
    ask.n = 0;
    ask.mu = 1.01 / (9.81 * ask.step);
    ck_assert(coupled_make(a, &ask, &c, &e));
    coupled_start(c, 0, 0, 0, NULL, false);
    ck_assert(!coupled_run(c, 1, &ground, NULL, &force, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_ptr_nonnull(strstr(e.text, "1/mu"));
    arena_close(a);
}
END_TEST

UNIT("coupled_exact", restitution_is_exact, path_is_the_closed_form, rolls_like_the_discrete_gradient, bounces,
     keeps_its_balance, rests, refuses)
