/* The classical Runge-Kutta method of order 4 on all of coupled.h's equations, as papers/002 section III integrates
   equations 2 and 3: ball and modes in one state y = (w, w', q, q'), with stages at 0, h/2, h/2 and h,

     y+ = y + h/6 (k1 + 2 k2 + 2 k3 + k4),   k_j = y'(t + c_j h, y + c_j h k_(j-1)),   c = 0, 1/2, 1/2, 1

   The surface and the shapes are known at the steps' ends and go straight between them; their rates s' and phi' are in
   xi'. The force over a step is the mean of the stages' forces with the same weights, so that it hands over exactly the
   momentum that the ball gets.

   Where we depart from the paper: the clamp max(0, 1 + mu xi') of coupled.h (without it a fast ball blows up sooner),
   and what we refuse. Where the method itself departs from the equations:
     - xi^1.5 is not smooth at 0, so that an impact converges with order 2.5 or so, not 4, and may gain energy: a part
       of 4e-5 of the speed at 42 steps
       per contact, 6e-4 at 12, 7e-3 at 5.5, and 0.45 at 1.6. Hence fewer than 12 steps per contact are refused, counted
         at each landing by
       coupled_contact_time at its closing speed.
     - the contact's dissipation is a decay of mu k xi^1.5 / m, stable up to 2.8 / h: beyond 1 / h it is refused.
     - a mode is damped of its own by about omega^6 h^5 / 144 (at 44.1 kHz: 37 1/s at 5 kHz, 2000 1/s at 10 kHz) and
       unstable beyond omega h = 2.83.
       Refused where this passes the decay that the mode was given. The sound is made from the force by exact poles;
         what is damped too much is the push back.
   No balance is kept: the residual of the ledger is the error of the method. Work and losses are integrated along with
   the state, by the same weights.

   Modes (coupled_stages.h): linear, so that one pass over them tells all four stages what they would do without a
   force, and it is one step behind the ball. In its units, g = f h^2/4 and h/2 times a velocity, the ball is one more
   mode, of mass m, with nothing that holds it. */
#include <math.h>

#include "convolution/coupled_stages.h"
#include "num/real.h"

#define INLINE static inline __attribute__((always_inline))

enum { CONTACT_STEPS_LEAST = 12, BATCH = 256 }; /* SPELL: steps between two entries in the ledger */

static const double reach[STAGES] = {0, 0.5, 0.5, 1}, twice[STAGES] = {0, 1, 1, 2};

/* What is under the ball: decided once a run. */
enum ground { RIGID, STANDS, MOVES };

/* The ball at the end of a step, and what has been summed up since the last entry in the ledger. */
struct rk4_ball {
    double height, travel, surface;          /* m from origin; h w'/2, m; m from origin             */
    double penetration, force, force_before; /* m; g, means over the last step and the one before   */
    double across;                           /* m: the surface's change in the last step            */
    double work, loss;                       /* g m: by surface and moving place; in the contact    */
};

struct rk4_run {
    struct coupled *c;
    double unit;                         /* N per g: 4/h^2                                            */
    double spring, rate;                 /* k per unit; mu/h                                          */
    double bare, fall;                   /* 1/m; m: what the weight takes off the way in half a step  */
    double sunk[STAGES], slowed[STAGES]; /* m: what it takes off height and way at the stages         */
    double stiff;                        /* g: the spring's force at which mu k xi^1.5 h / m is 1     */
    struct rk4_ball ball;
    struct coupled_push push; /* of the last step                                          */
    struct coupled_stages stages;
};

/* At the stages, first as if no force acted in the step. */
struct stages {
    double xi[STAGES];    /* m                                                          */
    double slip[STAGES];  /* m: h times what surface and place change in xi             */
    double close[STAGES]; /* m: h xi'                                                   */
    double answer[ANSWERS];
    double bent[STAGES]; /* g: the spring's force                                      */
    double g[STAGES];
};

/* The step after n of the run, which goes `across` up. */
INLINE void foresee(const struct rk4_run *r, enum ground ground, double n, double across, struct stages *o)
{
    const double *x = r->stages.now, *y = r->stages.now + LANES, height = r->ball.height, travel = r->ball.travel,
                 surface = r->ball.surface;
    if (ground == MOVES)
#pragma omp simd
        for (int k = 0; k < ANSWERS; k++)
            o->answer[k] = r->stages.answer[0][k] + n * (r->stages.answer[1][k] + n * r->stages.answer[2][k]);
#pragma omp simd
    for (int j = 0; j < STAGES; j++) {
        double lean = ground == RIGID ? 0 : x[SUM_Q] + twice[j] * x[j], fall = ground == RIGID ? 0 : x[SUM_V + j],
               glide = 0;
        if (ground == MOVES) {
            double on = n + reach[j];
            glide = y[SUM_Q] + twice[j] * y[j];
            lean += on * glide;
            fall += on * y[SUM_V + j];
        }
        o->slip[j] = across - glide;
        o->xi[j] = ((surface + reach[j] * across) - lean) - (height + (twice[j] * travel - r->sunk[j]));
        o->close[j] = (across - glide) - 2 * (fall + (travel - r->slowed[j]));
    }
}

INLINE void press(const struct rk4_run *r, struct stages *o, int stage)
{
    double xi = o->xi[stage], factor = 1 + r->rate * o->close[stage];
    o->bent[stage] = xi > 0 ? r->spring * xi * sqrt(xi) : 0;
    o->g[stage] = o->bent[stage] * (factor > 0 ? factor : 0);
}

INLINE void slide(struct stages *o, int stage, double by)
{
    o->slip[stage] -= by;
    o->close[stage] -= by;
}

/* The four forces, and among them the modes' end of the step before (behind: there is one): each fills the other's
 * latencies. */
INLINE void press_all(struct rk4_run *r, enum ground ground, bool behind, struct stages *o)
{
    const double *a = ground == MOVES ? o->answer : r->stages.answer[0], *g = o->g;
    press(r, o, 0);
    o->close[1] -= 2 * (a[A1_SELF] * g[0]);
    o->xi[2] -= a[A1_SELF] * g[0];
    if (ground == MOVES) slide(o, 2, a[GLIDE2] * g[0]);
    if (ground != RIGID && behind) coupled_stages_pass(&r->c->modes, &r->push, ground == MOVES, &r->stages);
    press(r, o, 1);
    o->close[2] -= 2 * (a[A2_OLDER] * g[0] + a[A2_SELF] * g[1]);
    o->xi[3] -= 2 * (a[A3_OLDER] * g[0] + a[A3_SELF] * g[1]);
    if (ground == MOVES) slide(o, 3, 2 * (a[GLIDE3_OLDER] * g[0] + a[GLIDE3_SELF] * g[1]));
    press(r, o, 2);
    o->close[3] -= 4 * ((a[A3_OLDEST] * g[0] + a[A3_MIDDLE] * g[1]) + a[A3_SELF] * g[2]);
    press(r, o, 3);
}

/* By the stages' shares, 1 2 2 1 over 6. */
INLINE double mean(const double *x) { return (1.0 / 6) * ((x[0] + x[3]) + 2 * (x[1] + x[2])); }

/* Ball and ledger at the step's end, on a surface of that height. */
INLINE void take(struct rk4_run *r, double surface, const struct stages *o)
{
    struct rk4_ball *b = &r->ball;
    double net = mean(o->g);
    b->work += mean((double[]){o->g[0] * o->slip[0], o->g[1] * o->slip[1], o->g[2] * o->slip[2], o->g[3] * o->slip[3]});
    b->loss += mean((double[]){(o->g[0] - o->bent[0]) * o->close[0], (o->g[1] - o->bent[1]) * o->close[1],
                               (o->g[2] - o->bent[2]) * o->close[2], (o->g[3] - o->bent[3]) * o->close[3]});
    b->height += 2 * b->travel + ((2.0 / 3) * ((o->g[0] + (o->g[1] + o->g[2])) * r->bare) - 2 * r->fall);
    b->travel += 2 * (net * r->bare - r->fall);
    b->across = surface - b->surface;
    b->surface = surface;
    b->force_before = b->force;
    b->force = net;
}

static bool too_short(const struct coupled *c, long step, double landing, double lasts, struct err *e)
{
    double h = c->ask.step;
    return err_set(e, ERR_SCENE,
                   "contact.roll.integrator: rk4: an impact at %.3g m/s (step %ld) lasts %.1f steps of %.3g s, and rk4 "
                   "needs %d of them: raise accuracy.contact_steps until a step takes "
                   "at most %.3g s, or choose contact.roll.integrator: discrete_gradient",
                   landing, step + 1, lasts / h, h, CONTACT_STEPS_LEAST, lasts / CONTACT_STEPS_LEAST);
}

static bool too_stiff(const struct rk4_run *r, long step, double bent, struct err *e)
{
    double h = r->c->ask.step, by = bent / r->stiff;
    return err_set(e, ERR_SCENE,
                   "contact.roll.integrator: rk4: mu k xi^1.5 / m times the step of %.3g s reaches %.3g at step %ld, "
                   "and rk4 is not to be trusted beyond 1: raise accuracy.contact_steps until "
                   "a step takes at most %.3g s, or choose contact.roll.integrator: discrete_gradient",
                   h, by, step + 1, h / by);
}

INLINE double greater(double a, double b) { return a > b ? a : b; }

/* What an impact must not do: last too few steps, or be damped too fast for them. */
INLINE bool resolved(const struct rk4_run *r, long step, double before, const struct stages *o, struct err *e)
{
    struct coupled *c = r->c;
    double after = r->ball.penetration,
           most = greater(greater(o->bent[0], o->bent[1]), greater(o->bent[2], o->bent[3]));
    if ((before > 0) != (after > 0)) {
        double landing = (o->close[0] + 2 * r->fall) / c->ask.step;
        double lasts =
            after > 0 && landing > 0 ? coupled_contact_time(c->ask.mass, c->ask.stiffness, landing) : INFINITY;
        coupled_crossing(c, step, before, after, landing);
        if (lasts < CONTACT_STEPS_LEAST * c->ask.step) return too_short(c, step, landing, lasts, e);
    }
    return !(most > r->stiff) || too_stiff(r, step, most, e);
}

/* Steps at[0] + 1 to at[1] of the run. */
INLINE bool go(struct rk4_run *r, enum ground ground, const int at[2], const double *surface, double *restrict force,
               struct err *e)
{
    struct coupled *c = r->c;
    const double *now = r->stages.now;
    long touched = 0;
    bool good = true;
    for (int i = at[0]; i < at[1] && good; i++) {
        struct stages o;
        const double n = i, next = surface[i] - c->origin, across = next - r->ball.surface,
                     before = r->ball.penetration;
        foresee(r, ground, n, across, &o);
        press_all(r, ground, i > 0, &o);
        r->push = (struct coupled_push){{o.g[0], o.g[1], o.g[2], o.g[3]}, n};
        if (ground != RIGID) coupled_stages_next(&r->stages, &r->push, ground == MOVES);
        take(r, next, &o);
        r->ball.penetration = next -
                              (ground == RIGID   ? 0
                               : ground == MOVES ? now[SUM_Q] + (n + 1) * now[LANES + SUM_Q]
                                                 : now[SUM_Q]) -
                              r->ball.height;
        coupled_rise(c, r->ball.penetration);
        touched += r->ball.force > 0;
        good = resolved(r, c->state.steps + i, before, &o, e);
        force[i] = r->ball.force * r->unit;
    }
    c->state.contact_steps += touched;
    c->state.iterations += touched;
    if (touched > 0) c->state.iterations_most = 1;
    return good;
}

LANES_CLONES
static bool on_modes(struct rk4_run *r, const int at[2], const double *surface, double *force, struct err *e)
{
    return r->stages.moves ? go(r, MOVES, at, surface, force, e) : go(r, STANDS, at, surface, force, e);
}

/* No lanes: there is nothing for them, and four stages in a wide register cost more than one by one. */
static bool on_rigid(struct rk4_run *r, const int at[2], const double *surface, double *force, struct err *e)
{
    return go(r, RIGID, at, surface, force, e);
}

/* Decay per second that the method gives to the pole s = -decay + j omega: -ln |R(s h)| / h, R(z) = 1 + z + z^2/2 +
 * z^3/6 + z^4/24. */
static double decay_of(double decay, double omega, double step)
{
    double x = -decay * step, y = omega * step, real = 1, imaginary = 0;
    for (int j = 4; j >= 1; j--) { /* Horner: R = 1 + z (1 + z/2 (1 + z/3 (1 + z/4))) */
        double r = (x * real - y * imaginary) / j;
        imaginary = (x * imaginary + y * real) / j;
        real = 1 + r;
    }
    return -0.5 * real_log(real * real + imaginary * imaginary) / step;
}

bool coupled_rk4_make(const struct coupled *c, struct err *e)
{
    const struct coupled_modes *m = &c->modes;
    for (int i = 0; i < m->n; i++) {
        double omega = 2 * REAL_PI * m->frequency[i], decay = decay_of(m->decay[i], omega, c->ask.step);
        if (!(fabs(decay - m->decay[i]) <= m->decay[i]))
            return err_set(e, ERR_SCENE,
                           "contact.roll.integrator: rk4: steps of %.3g s give mode %d (%.6g Hz) a decay of %.3g 1/s "
                           "instead of its own %.3g 1/s: raise accuracy.contact_steps until a step takes "
                           "at most %.3g s, or choose contact.roll.integrator: discrete_gradient",
                           c->ask.step, i + 1, m->frequency[i], decay, m->decay[i],
                           0.95 * real_pow(144 * m->decay[i] / real_pow(omega, 6), 0.2));
    }
    return true;
}

/* The ball's fields of c, after n steps of the run. */
static void store_ball(struct rk4_run *r, double n)
{
    struct coupled *c = r->c;
    const struct rk4_ball *b = &r->ball;
    const double *x = r->stages.now, *y = x + LANES, h = c->ask.step;
    c->height = b->height;
    c->speed = b->travel * (2 / h);
    c->surface = b->surface;
    c->penetration = b->penetration;
    c->closing = ((b->across - y[SUM_Q]) - 2 * (x[SUM_V] + n * y[SUM_V])) / h - c->speed;
    c->force = b->force * r->unit;
    c->force_before = b->force_before * r->unit;
}

/* What is seen after step `at`, where the modes are one step behind. */
static void watch(struct rk4_run *r, int at)
{
    struct coupled *c = r->c;
    struct coupled_account more = {.modal = coupled_modal(c)};
    if (at > 0) {
        store_ball(r, at);
        coupled_stages_look(c, &r->push, &r->stages, &more);
        more.work = r->ball.work * r->unit;
        more.contact_loss = r->ball.loss * r->unit;
    }
    coupled_seen(c, c->state.steps + at, &more);
}

/* Into the ledger. */
static void enter(struct rk4_run *r)
{
    coupled_sum_add(&r->c->surface_work, r->ball.work * r->unit);
    coupled_sum_add(&r->c->contact_loss, r->ball.loss * r->unit);
    coupled_sum_add(&r->c->mode_loss, coupled_stages_sum(r->stages.lost));
    r->ball.work = r->ball.loss = 0;
    memset(r->stages.lost, 0, sizeof r->stages.lost);
}

static void open_run(struct rk4_run *r, struct coupled *c, int steps, const double *phi_to)
{
    const struct coupled_ask *k = &c->ask;
    const double square = k->step * k->step / 4;
    *r = (struct rk4_run){.c = c,
                          .unit = 1 / square,
                          .spring = k->stiffness * square,
                          .rate = k->mu / k->step,
                          .bare = 1 / k->mass,
                          .fall = k->weight * square / k->mass,
                          .stiff = k->mu > 0 ? k->mass / (k->mu * k->step) * square : INFINITY};
    r->ball = (struct rk4_ball){.height = c->height,
                                .travel = c->speed * (k->step / 2),
                                .surface = c->surface,
                                .penetration = c->penetration,
                                .force = c->force * square,
                                .force_before = c->force_before * square};
    for (int j = 0; j < STAGES; j++) {
        r->sunk[j] = (j < 2 ? 0 : j - 1) * r->fall;
        r->slowed[j] = twice[j] * r->fall;
    }
    coupled_stages_open(c, steps, phi_to, &r->stages);
    r->stages.answer[0][A1_SELF] += r->bare;
    r->stages.answer[0][A2_SELF] += r->bare;
    r->stages.answer[0][A3_SELF] += r->bare;
}

bool coupled_rk4_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                     struct err *e)
{
    struct rk4_run r;
    open_run(&r, c, steps, phi_to);
    for (int at = 0; at < steps;) {
        if (coupled_unseen(c, at, steps) == at) watch(&r, at);
        int batch = at / BATCH * BATCH + BATCH, end = coupled_unseen(c, at + 1, steps < batch ? steps : batch);
        if (!(c->modes.n > 0 ? on_modes : on_rigid)(&r, (int[]){at, end}, surface, force, e)) return false;
        if (end == batch) enter(&r);
        at = end;
    }
    store_ball(&r, steps);
    coupled_stages_finish(c, &r.push, &r.stages);
    enter(&r);
    for (int i = 0; phi_to && i < c->modes.padded; i++)
        c->modes.phi[i] = phi_to[i];
    c->state.steps += steps;
    return true;
}
