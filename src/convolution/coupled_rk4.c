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

   The modes' stages are computed for all modes at once, eight in the lanes of a vector; sums over them run over LANES
   accumulators and then in one tree, so that bits do not depend on the instruction set. */
#include <math.h>

#include "convolution/coupled_parts.h"
#include "num/real.h"

enum { STAGES = 4, CONTACT_STEPS_LEAST = 12 };

static const double reach[STAGES] = {0, 0.5, 0.5, 1}, share[STAGES] = {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0};

/* What the modes take off the penetration, m, and off its rate, m/s: by their velocities, and by the place that moves
   over them. */
struct felt {
    double bent, fall, glide;
};

/* Of the modes at a stage, `on` steps after the run's start. */
LANES_CLONES
static struct felt feel(const struct coupled_modes *m, double on, double step)
{
    double bent[LANES] = {0}, fall[LANES] = {0}, glide[LANES] = {0};
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double phi = m->phi[i + l] + on * m->slope_phi[i + l], q = m->stage_q[i + l];
            bent[l] += phi * q;
            fall[l] += phi * m->stage_p[i + l];
            glide[l] += m->slope_phi[i + l] * q;
        }
    return (struct felt){lanes_total(bent), lanes_total(fall), lanes_total(glide) / step};
}

/* The slopes k at a stage whose force is known go into the step's sums; the modes go on along them, from where the step
   began, by `ahead` s to the next stage. Returns what damping takes at the stage, W. */
LANES_CLONES
static double yield(const struct coupled_modes *m, double on, double force, double weight, double ahead)
{
    double lost[LANES] = {0};
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double phi = m->phi[i + l] + on * m->slope_phi[i + l], p = m->stage_p[i + l],
                   drag = 2 * m->decay[i + l] * p;
            double pull = (phi * force - m->square[i + l] * m->stage_q[i + l]) - drag;
            lost[l] += drag * p;
            m->step_q[i + l] += weight * p;
            m->step_p[i + l] += weight * pull;
            m->stage_q[i + l] = m->q[i + l] + ahead * p;
            m->stage_p[i + l] = m->p[i + l] + ahead * pull;
        }
    return lanes_total(lost);
}

/* The end of a step, which is the first stage of the next. */
static void arrive(const struct coupled_modes *m, double step)
{
    for (int i = 0; i < m->padded; i++) {
        m->stage_q[i] = m->q[i] += step * m->step_q[i];
        m->stage_p[i] = m->p[i] += step * m->step_p[i];
        m->step_q[i] = m->step_p[i] = 0;
    }
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

static bool too_stiff(const struct coupled *c, long step, double by, struct err *e)
{
    double h = c->ask.step;
    return err_set(e, ERR_SCENE,
                   "contact.roll.integrator: rk4: mu k xi^1.5 / m times the step of %.3g s reaches %.3g at step %ld, "
                   "and rk4 is not to be trusted beyond 1: raise accuracy.contact_steps until "
                   "a step takes at most %.3g s, or choose contact.roll.integrator: discrete_gradient",
                   h, by, step + 1, h / by);
}

/* What an impact must not do: last too few steps, or be damped too fast for them. spring: N, its greatest force in the
   step; landing: m/s, at which the penetration grows at its start. */
static bool resolved(struct coupled *c, double before, double spring, double landing, struct err *e)
{
    const struct coupled_ask *k = &c->ask;
    double after = c->penetration, by = k->mu * spring * k->step / k->mass;
    long step = c->state.steps;
    coupled_count_contact(c, step, before, after, landing);
    if (before <= 0 && after > 0 && landing > 0) {
        double lasts = coupled_contact_time(k->mass, k->stiffness, landing);
        if (lasts < CONTACT_STEPS_LEAST * k->step) return too_short(c, step, landing, lasts, e);
    }
    return !(by > 1) || too_stiff(c, step, by, e);
}

/* The step after n of the run, to a surface of that height; felt: of the modes, at its start and then at its end. */
static bool rk4_step(struct coupled *c, int n, double next, struct felt *felt, struct err *e)
{
    const struct coupled_ask *k = &c->ask;
    double h = k->step, rise = (next - c->surface) / h, before = c->penetration, height = c->height, speed = c->speed,
           landing = 0, most = 0, force = 0, climb = 0, work = 0, loss = 0, lost = 0;
    for (int j = 0; j < STAGES; j++) {
        if (j > 0) *felt = feel(&c->modes, n + reach[j], h);
        double xi = (c->surface + reach[j] * h * rise - felt->bent) - height, slip = rise - felt->glide,
               closing = (slip - felt->fall) - speed, factor = 1 + k->mu * closing;
        double spring = xi > 0 ? k->stiffness * xi * sqrt(xi) : 0, push = factor > 0 ? spring * factor : 0,
               ahead = j + 1 < STAGES ? reach[j + 1] * h : 0;
        if (j == 0) landing = closing + h * k->weight / (2 * k->mass);
        most = spring > most ? spring : most;
        force += share[j] * push;
        climb += share[j] * speed;
        work += share[j] * push * slip;
        loss += share[j] * (push - spring) * closing;
        lost += share[j] * yield(&c->modes, n + reach[j], push, share[j], ahead);
        height = c->height + ahead * speed;
        speed = c->speed + ahead * (push - k->weight) / k->mass;
    }
    arrive(&c->modes, h);
    *felt = feel(&c->modes, n + 1, h);
    c->height += h * climb;
    c->speed += h * (force - k->weight) / k->mass;
    c->surface = next;
    c->penetration = (next - felt->bent) - c->height;
    c->closing = ((rise - felt->glide) - felt->fall) - c->speed;
    c->force_before = c->force;
    c->force = force;
    coupled_sum_add(&c->surface_work, h * work);
    coupled_sum_add(&c->contact_loss, h * loss);
    coupled_sum_add(&c->mode_loss, h * lost);
    coupled_rise(c, c->penetration);
    c->state.contact_steps += force > 0;
    c->state.iterations += force > 0;
    if (force > 0) c->state.iterations_most = 1;
    return resolved(c, before, most, landing, e);
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

bool coupled_rk4_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                     struct err *e)
{
    struct coupled_modes *m = &c->modes;
    for (int i = 0; i < m->padded; i++)
        m->slope_phi[i] = phi_to ? (phi_to[i] - m->phi[i]) / steps : 0;
    arrive(m, 0);
    struct felt felt = feel(m, 0, c->ask.step);
    for (int i = 0; i < steps; i++) {
        if (coupled_unseen(c, i, steps) == i)
            coupled_seen(c, c->state.steps, &(struct coupled_account){.modal = coupled_modal(c)});
        if (!rk4_step(c, i, surface[i] - c->origin, &felt, e)) return false;
        c->state.steps++;
        force[i] = c->force;
    }
    for (int i = 0; phi_to && i < m->padded; i++)
        m->phi[i] = phi_to[i];
    return true;
}
