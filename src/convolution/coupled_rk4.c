/* The classical Runge-Kutta method of order 4 on all of coupled.h's equations, as papers/002 section III integrates equations 2 and 3: ball and modes
   in one state y = (w, w', q, q'), with stages at 0, h/2, h/2 and h,

     y+ = y + h/6 (k1 + 2 k2 + 2 k3 + k4),   k_j = y'(t + c_j h, y + c_j h k_(j-1)),   c = 0, 1/2, 1/2, 1

   The surface and the shapes are known at the steps' ends and go straight between them; their rates s' and phi' are in xi'. The force over a step is
   the mean of the stages' forces with the same weights, so that it hands over exactly the momentum that the ball gets.

   Where we depart from the paper: the clamp max(0, 1 + mu xi') of coupled.h (without it a fast ball blows up sooner), and what we refuse.
   Where the method itself departs from the equations:
     - xi^1.5 is not smooth at 0, so that an impact converges with order 2.5 or so, not 4, and may gain energy: a part of 4e-5 of the speed at 42 steps
       per contact, 6e-4 at 12, 7e-3 at 5.5, and 0.45 at 1.6. Hence fewer than 12 steps per contact are refused, counted at each landing by
       coupled_contact_time at its closing speed.
     - the contact's dissipation is a decay of mu k xi^1.5 / m, stable up to 2.8 / h: beyond 1 / h it is refused.
     - a mode is damped of its own by about omega^6 h^5 / 144 (at 44.1 kHz: 37 1/s at 5 kHz, 2000 1/s at 10 kHz) and unstable beyond omega h = 2.83.
       Refused where this passes the decay that the mode was given. The sound is made from the force by exact poles; what is damped too much is the push back.
   No balance is kept: the residual of the ledger is the error of the method. Work and losses are integrated along with the state, by the same weights. */
#include <math.h>

#include "convolution/coupled_parts.h"
#include "num/real.h"

#define INLINE static inline __attribute__((always_inline))

enum { STAGES = 4, CONTACT_STEPS_LEAST = 12 };

static const double reach[STAGES] = {0, 0.5, 0.5, 1};
static const double share[STAGES] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};

struct drive {
    const double *to;    /* where phi goes; phi itself when it stays              */
    double part, step;   /* the part of the way to `to` that this step takes; s   */
    double push[STAGES]; /* N, force at the stages                                */
};

struct sums {
    double lean, fall, glide; /* sum phi q; sum phi p; sum (phi+ - phi) q         */
    double loss;              /* J/s/2: sum decay p^2 times the stages' shares    */
};

struct swing {
    double q, p;
};

struct mode {
    struct swing from, y, k, sum;        /* at the step's start; at a stage; its derivative; the derivatives' shares so far */
    double decay, square, phi, slant, loss;
};

INLINE void derive(struct mode *o, const struct drive *d, int stage)
{
    o->k.q = o->y.p;
    o->k.p = (o->phi + reach[stage] * o->slant) * d->push[stage] - 2 * o->decay * o->y.p - o->square * o->y.q;
    o->sum.q += share[stage] * o->k.q;
    o->sum.p += share[stage] * o->k.p;
    o->loss += share[stage] * o->decay * o->y.p * o->y.p;
}

INLINE void move(struct mode *o, const struct drive *d, int stage)
{
    derive(o, d, stage - 1);
    o->y.q = o->from.q + reach[stage] * d->step * o->k.q;
    o->y.p = o->from.p + reach[stage] * d->step * o->k.p;
}

/* Mode i at a stage, from the step's start and the forces of the stages before; nothing kept, as memory costs more. */
INLINE struct mode at_stage(const struct coupled_modes *m, const struct drive *d, int i, int stage)
{
    struct swing from = {m->q[i], m->p[i]};
    struct mode o = {.from = from, .y = from, .decay = m->decay[i], .square = m->square[i], .phi = m->phi[i], .slant = (d->to[i] - m->phi[i]) * d->part};
    if (stage >= 1)
        move(&o, d, 1);
    if (stage >= 2)
        move(&o, d, 2);
    if (stage >= 3)
        move(&o, d, 3);
    return o;
}

static double total(const double *x)
{
    return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
}

INLINE void sums_at(const struct coupled_modes *m, const struct drive *d, int stage, struct sums *s)
{
    double lean[LANES] = {0}, fall[LANES] = {0}, glide[LANES] = {0};
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            struct mode o = at_stage(m, d, i + l, stage);
            double phi = o.phi + reach[stage] * o.slant;
            lean[l] += phi * o.y.q;
            fall[l] += phi * o.y.p;
            glide[l] += o.slant * o.y.q;
        }
    *s = (struct sums){total(lean), total(fall), total(glide), 0};
}

LANES_CLONES
static void modes_at(const struct coupled_modes *m, const struct drive *d, int stage, struct sums *s)
{
    switch (stage) {
    case 0: sums_at(m, d, 0, s); break;
    case 1: sums_at(m, d, 1, s); break;
    case 2: sums_at(m, d, 2, s); break;
    default: sums_at(m, d, 3, s); break;
    }
}

/* The modes' end of the step; phi goes on, and s is for that end (glide: at the speed of this step). */
LANES_CLONES
static void advance_modes(const struct coupled_modes *m, struct drive d, struct sums *s)
{
    double lean[LANES] = {0}, fall[LANES] = {0}, glide[LANES] = {0}, lost[LANES] = {0};
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            struct mode o = at_stage(m, &d, i + l, STAGES - 1);
            derive(&o, &d, STAGES - 1);
            double new_q = o.from.q + d.step * o.sum.q, new_p = o.from.p + d.step * o.sum.p, new_phi = o.phi + o.slant;
            m->q[i + l] = new_q;
            m->p[i + l] = new_p;
            m->phi[i + l] = new_phi;
            lean[l] += new_phi * new_q;
            fall[l] += new_phi * new_p;
            glide[l] += o.slant * new_q;
            lost[l] += o.loss;
        }
    *s = (struct sums){total(lean), total(fall), total(glide), total(lost)};
}

struct ball {
    double w, u;              /* at a stage: m from origin, m/s                   */
    double force, rise;       /* means over the step: N, m/s                      */
    double work, loss;        /* J: of the step                                   */
    double landing, stiffest; /* m/s: closing at the start; greatest mu k xi^1.5 / m, 1/s */
};

/* Force and its shares at a stage of the step to the surface height `to`. */
static double stage_force(const struct coupled *c, double to, int stage, const struct sums *s, struct ball *b)
{
    const struct coupled_ask *k = &c->ask;
    double across = to - c->surface, xi = c->surface + reach[stage] * across - s->lean - b->w;
    double closing = (across - s->glide) / k->step - s->fall - b->u;
    double spring = xi > 0 ? k->stiffness * xi * sqrt(xi) : 0, force = spring * fmax(0, 1 + k->mu * closing);
    if (stage == 0)
        b->landing = closing + 0.5 * k->step * k->weight / k->mass;
    b->force += share[stage] * force;
    b->rise += share[stage] * b->u;
    b->work += share[stage] * force * (across - s->glide);
    b->loss += share[stage] * k->step * (force - spring) * closing;
    b->stiffest = fmax(b->stiffest, k->mu * spring / k->mass);
    return force;
}

static struct ball ball_step(const struct coupled *c, double to, struct drive *d)
{
    struct ball b = {.w = c->height, .u = c->speed};
    double h = c->ask.step, rise = 0, gain = 0;
    for (int stage = 0; stage < STAGES; stage++) {
        struct sums s = {0};
        b.w = c->height + reach[stage] * h * rise;
        b.u = c->speed + reach[stage] * h * gain;
        if (c->modes.n > 0)
            modes_at(&c->modes, d, stage, &s);
        d->push[stage] = stage_force(c, to, stage, &s, &b);
        rise = b.u;
        gain = (d->push[stage] - c->ask.weight) / c->ask.mass;
    }
    return b;
}

static void take(struct coupled *c, double to, const struct ball *b, const struct sums *s)
{
    const struct coupled_ask *k = &c->ask;
    double across = to - c->surface;
    coupled_sum_add(&c->surface_work, b->work);
    coupled_sum_add(&c->contact_loss, b->loss);
    coupled_sum_add(&c->mode_loss, 2 * k->step * s->loss);
    c->height += k->step * b->rise;
    c->speed += k->step * ((b->force - k->weight) / k->mass);
    c->surface = to;
    c->penetration = to - s->lean - c->height;
    coupled_rise(c, c->penetration);
    c->closing = (across - s->glide) / k->step - s->fall - c->speed;
    c->force_before = c->force;
    c->force = b->force;
    c->state.contact_steps += b->force > 0;
    c->state.iterations += b->force > 0;
    if (b->force > 0)
        c->state.iterations_most = 1;
}

/* What an impact must not do: last too few steps, or be damped too fast for them. */
static bool resolved(const struct coupled *c, long step, double before, const struct ball *b, struct err *e)
{
    const struct coupled_ask *k = &c->ask;
    bool lands = before <= 0 && c->penetration > 0 && b->landing > 0;
    double lasts = lands ? coupled_contact_time(k->mass, k->stiffness, b->landing) : INFINITY;
    if (lasts < CONTACT_STEPS_LEAST * k->step)
        return err_set(e, ERR_SCENE, "contact.roll.integrator: rk4: an impact at %.3g m/s (step %ld) lasts %.1f steps of %.3g s, and rk4 needs %d of them: raise accuracy.contact_steps until a step takes "
                                     "at most %.3g s, or choose contact.roll.integrator: discrete_gradient",
                       b->landing, step + 1, lasts / k->step, k->step, CONTACT_STEPS_LEAST, lasts / CONTACT_STEPS_LEAST);
    return b->stiffest * k->step <= 1 ||
           err_set(e, ERR_SCENE, "contact.roll.integrator: rk4: mu k xi^1.5 / m times the step of %.3g s reaches %.3g at step %ld, and rk4 is not to be trusted beyond 1: raise accuracy.contact_steps until "
                                 "a step takes at most %.3g s, or choose contact.roll.integrator: discrete_gradient",
                   k->step, b->stiffest * k->step, step + 1, 1 / b->stiffest);
}

/* Decay per second that the method gives to the pole s = -decay + j omega: -ln |R(s h)| / h, R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24. */
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

static bool modes_hold(const struct coupled *c, struct err *e)
{
    const struct coupled_modes *m = &c->modes;
    for (int i = 0; i < m->n; i++) {
        double omega = 2 * REAL_PI * m->frequency[i], decay = decay_of(m->decay[i], omega, c->ask.step);
        if (!(fabs(decay - m->decay[i]) <= m->decay[i]))
            return err_set(e, ERR_SCENE, "contact.roll.integrator: rk4: steps of %.3g s give mode %d (%.6g Hz) a decay of %.3g 1/s instead of its own %.3g 1/s: raise accuracy.contact_steps until a step takes "
                                         "at most %.3g s, or choose contact.roll.integrator: discrete_gradient",
                           c->ask.step, i + 1, m->frequency[i], decay, m->decay[i], 0.95 * real_pow(144 * m->decay[i] / real_pow(omega, 6), 0.2));
    }
    return true;
}

bool coupled_rk4_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force, struct err *e)
{
    struct coupled_modes *m = &c->modes;
    if (c->state.steps == 0 && !modes_hold(c, e))
        return false;
    for (int i = 0; i < steps; i++) {
        if (coupled_unseen(c, i, steps) == i)
            coupled_seen(c, c->state.steps + i, &(struct coupled_account){.modal = coupled_modal(c)});
        struct drive d = {.to = phi_to ? phi_to : m->phi, .part = 1.0 / (steps - i), .step = c->ask.step};
        struct sums s = {0};
        double to = surface[i] - c->origin, before = c->penetration;
        struct ball b = ball_step(c, to, &d);
        if (m->n > 0)
            advance_modes(m, d, &s);
        take(c, to, &b, &s);
        coupled_touch(c, c->state.steps + i, before, c->penetration, b.landing);
        if (!resolved(c, c->state.steps + i, before, &b, e))
            return false;
        force[i] = c->force;
    }
    for (int i = 0; phi_to && i < m->padded; i++)
        m->phi[i] = phi_to[i];
    c->state.steps += steps;
    return true;
}
