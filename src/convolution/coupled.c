/* The parts of coupled.h that the integrators share: making, starting, running in the chosen integrator, rest,
   contacts, and the ledger

     H = m w'^2 / 2 + G w + sum (inertia p^2 + spring q^2) / 2 + (2/5) k max(0, xi)^2.5,
     residual = H - H(start) - surface work + contact loss + mode loss,

   w counted from the surface's height at the start. In continuous time dH = f (ds - sum dphi q) - (f - k xi^1.5) dxi -
   sum 2 sigma p^2 dt: equations 2 and 3 of papers/002 times the velocities. What an integrator adds per step is its own
   discrete form of the three terms; the sums keep what their rounding loses, so that the residual shows the method's
   balance and not the length of the sound. */
#include "convolution/coupled.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "convolution/coupled_parts.h"
#include "force/hertz.h"
#include "num/real.h"
#include "scene/scene.h"

/* A ball on rigid ground whose isolated impact is exact at any step: energy, restitution, and no force that pulls.

   Between the step's ends the ground moves straight, so that xi' = v = s' - w' and a = G/m, kappa = k/m give

       v' = a - F,   F = kappa xi^1.5 (1 + mu v),   V(xi) = (2/5) kappa xi^2.5

   The isolated impact (a = 0) hides a Hamiltonian. With eta = ln(1 + mu v)/mu,

       eta' = v'/(1 + mu v) = -V'(xi),   xi' = v = K'(eta),   K = (e^(mu eta) - 1)/mu^2 - eta/mu = (mu v - ln(1 + mu
                                                              v))/mu^2

   so V + K is kept, which is the relation between v and xi of Papetti, Avanzini and Rocchesso (2011) that papers/002
   builds on; where an impact begins and ends V = 0, so K(v_out) = K(v_in), whatever kappa. Gonzalez' discrete gradient
   on both halves keeps it in finite steps h:

       X := (xi+ - xi)/h = (K+ - K)/(eta+ - eta),   eta+ = eta - h D,   D := (V(xi+) - V(xi))/(xi+ - xi)

   With p = 1 + mu v and d = mu h D this says p+ = p e^-d and 1 + mu X = p (1 - e^-d)/d: the mean force is F = D (1 + mu
   X), never negative. The mean velocity and X differ by (p/mu) B(d), B = (1 + e^-d)/2 - (1 - e^-d)/d = d^2/12 - ...,
   which only the force brings about. With gravity in the contact it is brought about by D - a, which is what bends the
   velocity there:

       v+ = v + h (a - D (1 + mu X)),   X = (v + v+)/2 - y h (D - a),   y = p B(d)/d,   p = 1 + mu (v + h a/2)

   These are the equations solved. They are the exact impact when a = 0, the exact parabola out of contact (D = 0), and
   rest at D = a stays; order 2 in all else. Eliminated: 1 + mu X = p ((1 - e^-d)/d + mu h a B/d/(1 + d/2)), which is
   positive, so the clamp of equation 3 is met only for p <= 0 (parting faster than 1/mu): F = 0 then, and 0 is what the
   rest tends to for p -> 0.

   Energy. By the second and third equation, exactly,

       H+ - H = F (s+ - s) - L,   L = m h (y h (D - a)^2 + mu D (v + v+)/2 X) >= 0,   per unit mass H/m = w'^2/2 + a w +
                                  V

   (p <= 0: L = m (V - V+), as xi falls). Both terms together are a quadratic form in (D - a) and (v + v+)/2, not
   negative for p B <= 4; beyond (p > 8) L stays positive for mu h a < 1, tried on p to 1e4, d from 1e-4 to 600 and mu h
   a from 1e-8 to 1. A larger mu h a is refused: it means that 1/mu is a speed reached by falling for one step.

   Solving: xi+ = xi + h X(D(xi+)), X falling in D and D rising in xi+: one root, between the free flight's xi_f and xi
   + h X(D(xi_f)). Newton from xi_f, bisection when it leaves the bracket (the slope leaves out mu h a, about 1e-3).
   e^-d by num/real.h: the same bits everywhere.

   A kick of gravity before and after the exact impact would be simpler, and its energy would be off by order h^2 in a
   contact and by order h when a step holds an impact; here the balance is exact. Papetti, Avanzini, Rocchesso:
   "Numerical methods for a nonlinear impact model: a comparative study with closed-form corrections", IEEE Trans. Audio
   Speech Lang. Process. 19 (2011), 2146-2158. */

enum { ITERATIONS_MOST = 60, SERIES = 8 };

#define SMALL                                                                                                          \
    1e-12 /* of |xi| + |xi+| + |h v|: Newton's next move is rounding, and this one is far above the equation's */

struct rules {
    double kappa, mu, gravity, step;
};

struct waning {
    double mean, lag, slope; /* (1 - e^-d)/d; B(d)/d; derivative of mean */
};

struct impact {
    double xi, v;       /* before the step, then after it  */
    double force, loss; /* N/kg, J/kg: of the step         */
    int iterations;
};

/* z = d/2: mean = e^-z sinh(z)/z, B = e^-z (cosh z - sinh(z)/z), by their series for small z, where the plain forms
   cancel (z < 1/2: the ninth term is below 1e-19). */
static struct waning waning(double d)
{
    double z = 0.5 * d, term = 1, mean = 1, lag = 0;
    if (z >= 0.5) {
        double e = real_exp(-d);
        mean = (1 - e) / d;
        return (struct waning){mean, (0.5 * (1 + e) - mean) / d, (e - mean) / d};
    }
    if (z <= 0) return (struct waning){1, 0, -0.5};
    for (int j = 1; j <= SERIES; j++) {
        term *= z * z / (2 * j * (2 * j + 1));
        mean += term;
        lag += 2 * j * term;
    }
    double e = real_exp(-z);
    return (struct waning){e * mean, e * lag / d, 0.5 * e * (lag / z - mean)};
}

/* D for xi = a^2, xi+ = b^2 without differences of near numbers (those of V would cost ten digits), and its derivative
 * by xi+. */
static double gradient(double kappa, double from, double to, double *slope)
{
    double a = sqrt(fmax(from, 0)), b = sqrt(fmax(to, 0)), across = to - from;
    if (from > 0 && to > 0) {
        double sum = a + b;
        *slope = 0.2 * kappa * (((3 * b + 6 * a) * b + 4 * a * a) * b + 2 * a * a * a) / (sum * sum);
        return 0.4 * kappa * hertz_mean_quartic(a, b, from, to) / sum;
    }
    double mean = to > 0 ? 0.4 * kappa * to * to * b / across : from > 0 ? -0.4 * kappa * from * from * a / across : 0;
    *slope = to > 0 ? (kappa * to * b - mean) / across : from > 0 ? -mean / across : 0;
    return mean;
}

struct trial {
    double gradient, mean, lag; /* D; y; M = (1 + mu X)/p */
    double x, slope;            /* X, and its derivative by xi+ */
};

/* All that follows from an end xi+ of the step. */
static struct trial try_end(const struct rules *r, const struct impact *s, double end)
{
    double rise, free = s->v + 0.5 * r->step * r->gravity, p = 1 + r->mu * free;
    struct trial t = {.gradient = gradient(r->kappa, s->xi, end, &rise)};
    double d = r->mu * r->step * t.gradient;
    struct waning w = waning(d);
    t.lag = p * w.lag;
    t.mean = w.mean + r->mu * r->step * r->gravity * w.lag / (1 + 0.5 * d);
    t.x = (free - r->step * (0.5 * t.gradient + t.lag * (t.gradient - r->gravity))) / (1 + 0.5 * d);
    t.slope = r->step * p * w.slope * rise;
    return t;
}

/* xi+ and what follows from it, or NAN when it was not found. The last move is taken after all are small, so that what
   is left is rounding alone: a leftover of one sign, small as it is, adds up in 30000 steps. */
static double solve(const struct rules *r, struct impact *s, double free, struct trial *t)
{
    double end = free, low = -INFINITY, high = free, scale = fabs(s->xi) + r->step * fabs(s->v);
    for (s->iterations = 1; s->iterations < ITERATIONS_MOST; s->iterations++) {
        *t = try_end(r, s, end);
        double image = s->xi + r->step * t->x, off = end - image, next = end - off / (1 - r->step * t->slope);
        low = fmax(low, off > 0 ? image : end);
        high = fmin(high, off > 0 ? end : image);
        if (fabs(next - end) <= SMALL * (scale + fabs(end))) {
            *t = try_end(r, s, next);
            s->iterations++;
            return next;
        }
        end = next > low && next < high ? next : low + 0.5 * (high - low);
    }
    return NAN;
}

/* One step of the ball against ground that moves straight. False: not solved. */
static bool impact_step(const struct rules *r, struct impact *s)
{
    double h = r->step, free = s->v + 0.5 * h * r->gravity, end = s->xi + h * free, p = 1 + r->mu * free;
    struct trial t = {.gradient = 0};
    s->force = s->loss = 0;
    s->iterations = 0;
    if (p <= 0 || (s->xi <= 0 && end <= 0)) {
        s->loss = coupled_potential(r->kappa, s->xi) - coupled_potential(r->kappa, end);
        s->xi = end;
        s->v += h * r->gravity;
        return true;
    }
    end = solve(r, s, end, &t);
    if (isnan(end)) return false;
    s->force = t.gradient * p * t.mean;
    double change = h * (r->gravity - s->force), middle = s->v + 0.5 * change, bend = h * (t.gradient - r->gravity);
    s->loss = t.lag * bend * bend + h * r->mu * t.gradient * middle * t.x;
    s->v += change;
    s->xi = end;
    return true;
}

/* What the step has brought, into the shared state. */
static void take(struct coupled *c, const struct impact *s, double surface)
{
    struct coupled_state *state = &c->state;
    double push = c->ask.mass * s->force;
    coupled_sum_add(&c->surface_work, push * (surface - c->surface));
    coupled_sum_add(&c->contact_loss, c->ask.mass * s->loss);
    c->force_before = c->force;
    c->force = push;
    c->surface = surface;
    c->penetration = s->xi;
    c->closing = s->v;
    c->height = surface - s->xi;
    coupled_rise(c, s->xi);
    c->speed += c->ask.step * (s->force - c->ask.weight / c->ask.mass);
    state->contact_steps += push > 0;
    state->iterations += s->iterations;
    if (s->iterations > state->iterations_most) state->iterations_most = s->iterations;
}

static bool exact_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                      struct err *e)
{
    const struct coupled_ask *k = &c->ask;
    const struct rules r = {k->stiffness / k->mass, k->mu, k->weight / k->mass, k->step};
    (void)phi_to;
    if (!(k->mu * k->step * k->weight / k->mass < 1))
        return err_set(e, ERR_SCENE,
                       "contact.roll.integrator: exact_impact: a ball that falls for one step (%.3g s) is faster than "
                       "1/mu = %.3g m/s; raise accuracy.contact_steps, lower mu, or choose "
                       "contact.roll.integrator: discrete_gradient",
                       k->step, 1 / k->mu);
    for (int i = 0; i < steps; i++) {
        if (coupled_unseen(c, i, steps) == i)
            coupled_seen(c, c->state.steps + i, &(struct coupled_account){.modal = coupled_modal(c)});
        double to = surface[i] - c->origin, slope = (to - c->surface) / r.step, before = c->penetration;
        struct impact s = {.xi = before, .v = slope - c->speed};
        double landing = before > 0 ? s.v : sqrt(s.v * s.v - 2 * r.gravity * before);
        if (!impact_step(&r, &s))
            return err_set(
                e, ERR_NUMBERS,
                "exact_impact: step %ld (penetration %g m, closing at %g m/s) was not solved in %d iterations",
                c->state.steps + i, before, slope - c->speed, ITERATIONS_MOST);
        take(c, &s, to);
        coupled_count_contact(c, c->state.steps + i, before, s.xi, landing);
        force[i] = c->force;
    }
    c->state.steps += steps;
    return true;
}

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

static bool rk4_make(const struct coupled *c, struct err *e)
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

static bool rk4_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
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

static double *padded_copy(struct arena *a, int padded, const double *from, int n)
{
    double *to = ARENA_TAKE(a, double, padded);
    if (from) memcpy(to, from, (size_t)n * sizeof *to);
    return to;
}

static void make_modes(struct arena *a, const struct coupled_ask *ask, struct coupled_modes *m)
{
    m->n = ask->n;
    m->padded = (ask->n + LANES - 1) / LANES * LANES;
    m->frequency = padded_copy(a, m->padded, ask->frequency, ask->n);
    m->decay = padded_copy(a, m->padded, ask->decay, ask->n);
    double **const zeroed[] = {&m->q,       &m->p,       &m->phi,    &m->phi_to, &m->square, &m->inertia,
                               &m->spring,  &m->turn,    &m->pull,   &m->push,   &m->drain,  &m->stay,
                               &m->carry,   &m->thrust,  &m->tilt,   &m->swing,  &m->ahead,  &m->slope_phi,
                               &m->stage_q, &m->stage_p, &m->step_q, &m->step_p};
    for (size_t i = 0; i < sizeof zeroed / sizeof zeroed[0]; i++)
        *zeroed[i] = ARENA_TAKE(a, double, m->padded);
    for (int i = 0; i < m->padded; i++) {
        double turn = 2 * REAL_PI * m->frequency[i];
        m->square[i] = i < m->n ? m->decay[i] * m->decay[i] + turn * turn : 1;
        m->inertia[i] = i < m->n ? 1 : 0;
        m->spring[i] = i < m->n ? m->square[i] : 0;
    }
}

static bool sound(const struct coupled_ask *k, struct err *e)
{
    const struct {
        const char *name;
        double value;
        bool good;
    } of[] = {{"step", k->step, k->step > 0},
              {"mass", k->mass, k->mass > 0},
              {"weight", k->weight, true},
              {"stiffness", k->stiffness, k->stiffness > 0},
              {"dissipation mu", k->mu, k->mu >= 0}};
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        if (!of[i].good || !isfinite(of[i].value))
            return err_set(e, ERR_SCENE, "a coupled contact cannot have a %s of %g", of[i].name, of[i].value);
    for (int i = 0; i < k->n; i++)
        if (!(k->decay[i] >= 0) || !(k->frequency[i] >= 0) || !isfinite(k->decay[i] + k->frequency[i]) ||
            !(k->decay[i] + k->frequency[i] > 0))
            return err_set(e, ERR_SCENE,
                           "mode %d (%g Hz, decay %g 1/s) cannot carry a ball: it needs a frequency or a decay above "
                           "0, and neither below",
                           i + 1, k->frequency[i], k->decay[i]);
    return true;
}

bool coupled_make(struct arena *a, const struct coupled_ask *ask, struct coupled **made, struct err *e)
{
    if (!sound(ask, e)) return false;
    if (ask->integrator == INTEGRATOR_EXACT_IMPACT && ask->n > 0)
        return err_set(e, ERR_SCENE,
                       "contact.roll.integrator: exact_impact is for rigid ground; set contact.roll.ground to rigid, "
                       "or choose discrete_gradient");
    struct coupled *c = ARENA_TAKE(a, struct coupled, 1);
    c->ask = *ask;
    make_modes(a, ask, &c->modes);
    c->ask.frequency = c->modes.frequency;
    c->ask.decay = c->modes.decay;
    *made = c;
    if (ask->integrator == INTEGRATOR_RK4) return rk4_make(c, e);
    return ask->integrator != INTEGRATOR_DISCRETE_GRADIENT || coupled_gradient_make(c, e);
}

double coupled_rest(const struct coupled *c, double surface, const double *phi)
{
    double give = 0, load = c->ask.weight / c->ask.stiffness; /* k xi^1.5 = G */
    for (int i = 0; phi && i < c->modes.n; i++)
        give += phi[i] * phi[i] / c->modes.square[i];
    return surface - (give * c->ask.weight + (load > 0 ? real_pow(load, 2.0 / 3) : 0));
}

LANES_CLONES
double coupled_modal(const struct coupled *c)
{
    const struct coupled_modes *m = &c->modes;
    double lane[LANES] = {0};
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            lane[l] +=
                0.5 * (m->inertia[i + l] * m->p[i + l] * m->p[i + l] + m->spring[i + l] * m->q[i + l] * m->q[i + l]);
    return lanes_total(lane);
}

/* The greatest part of H and, added in a fixed order, H itself. */
static double energy_of(const struct coupled *c, double modal, double *greatest, const char **whose)
{
    const struct {
        const char *name;
        double value;
    } part[] = {{"the ball's velocity", 0.5 * c->ask.mass * c->speed * c->speed},
                {"the ball's height", c->ask.weight * c->height},
                {"the modes", modal},
                {"the contact", coupled_potential(c->ask.stiffness, c->penetration)}};
    double sum = 0;
    *greatest = 0;
    *whose = part[0].name;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        sum += part[i].value;
        if (!(fabs(part[i].value) <= *greatest)) {
            *greatest = fabs(part[i].value);
            *whose = part[i].name;
        }
    }
    return sum;
}

static double with(struct coupled_sum sum, double more)
{
    coupled_sum_add(&sum, more);
    return coupled_sum_of(&sum);
}

static void account(const struct coupled *c, const struct coupled_account *more, struct coupled_state *s)
{
    s->surface_work = with(c->surface_work, more->work);
    s->contact_loss = with(c->contact_loss, more->contact_loss);
    s->mode_loss = with(c->mode_loss, more->mode_loss);
    s->residual = ((s->energy - c->energy_start) - s->surface_work) + (s->contact_loss + s->mode_loss);
}

bool coupled_balance(struct coupled *c, bool bounded, struct err *e)
{
    struct coupled_state *s = &c->state;
    double greatest;
    const char *whose;
    s->energy = energy_of(c, coupled_modal(c), &greatest, &whose);
    if (!isfinite(s->energy) || !isfinite(c->force))
        return err_set(e, ERR_NUMBERS,
                       "the coupled contact is no longer finite at step %ld (force %g N, penetration %g m, %g J in "
                       "%s): take more steps (accuracy.contact_steps)",
                       s->steps, c->force, c->penetration, greatest, whose);
    s->highest = fmax(s->highest, fmax(greatest, fabs(s->energy)));
    account(c, &(struct coupled_account){0}, s);
    double bound = (1e-10 + 4 * DBL_EPSILON * (double)s->steps) * s->highest;
    return !bounded || fabs(s->residual) <= bound ||
           err_set(e, ERR_NUMBERS,
                   "the energy of the coupled contact is off balance by %.3g J at step %ld (allowed: %.3g J): energy "
                   "%.6g J, most of it in %s; work of the surface %.6g J, lost in the contact %.6g J, in the modes "
                   "%.6g J; at most %ld iterations a step: take more steps (accuracy.contact_steps)",
                   s->residual, s->steps, bound, s->energy, whose, s->surface_work, s->contact_loss, s->mode_loss,
                   s->iterations_most);
}

/* Steps and fractions apart: hours of steps leave a fraction few digits. */
static double since(const struct coupled *c, long step, double fraction, long now, double now_fraction)
{
    return ((double)(now - step) + (now_fraction - fraction)) * c->ask.step;
}

void coupled_crossing(struct coupled *c, long step, double before, double after, double closing)
{
    struct coupled_contact *k = &c->contact;
    struct coupled_state *s = &c->state;
    double fraction = before / (before - after);
    if (after > 0) {
        k->begun_step = step;
        k->begun_fraction = fraction;
        s->hop[1] = s->lift_offs > 0 ? s->hop[0] : 0;
        s->hop[0] = 0;
        s->flights += s->lift_offs > 0 && since(c, k->ended_step, k->ended_fraction, step, fraction) > c->flight_least;
        s->landings++;
        s->impact = closing;
        s->impact_most = fmax(s->impact_most, closing);
        return;
    }
    double lasted = since(c, k->begun_step, k->begun_fraction, step, fraction);
    k->ended_step = step;
    k->ended_fraction = fraction;
    s->contact_least = s->lift_offs > 0 ? fmin(s->contact_least, lasted) : lasted;
    s->contact_sum += lasted;
    s->lift_offs++;
}

static void fill(const struct coupled *c, struct coupled_state *s)
{
    const struct coupled_contact *k = &c->contact;
    bool touching = c->penetration > 0;
    s->height = c->height + c->origin;
    s->speed = c->speed;
    s->surface = c->surface + c->origin;
    s->penetration = c->penetration;
    s->closing = c->closing;
    s->force = c->force;
    s->contact_time = s->contact_sum + (touching ? since(c, k->begun_step, k->begun_fraction, s->steps, 0) : 0);
    s->flight = touching ? 0 : since(c, k->ended_step, k->ended_fraction, s->steps, 0);
}

void coupled_seen(struct coupled *c, long steps, const struct coupled_account *more)
{
    double greatest;
    const char *whose;
    struct coupled_state *s = &c->seen[c->seen_so_far++];
    *s = c->state;
    s->steps = steps;
    s->energy = energy_of(c, more->modal, &greatest, &whose);
    account(c, more, s);
    fill(c, s);
}

void coupled_watch(struct coupled *c, int every, struct coupled_state *seen)
{
    c->every = every;
    c->seen = seen;
}

void coupled_flights(struct coupled *c, double least) { c->flight_least = least; }

void coupled_start(struct coupled *c, double height, double speed, double surface, const double *phi, bool settled)
{
    struct coupled fresh = {.ask = c->ask,
                            .modes = c->modes,
                            .flight_least = c->flight_least,
                            .every = c->every,
                            .seen = c->seen,
                            .origin = surface,
                            .height = height - surface,
                            .speed = speed,
                            .closing = -speed};
    *c = fresh;
    struct coupled_modes *m = &c->modes;
    double bent = 0;
    for (int i = 0; i < m->padded; i++) {
        m->phi[i] = phi && i < m->n ? phi[i] : 0;
        m->q[i] = settled ? m->phi[i] * c->ask.weight / m->square[i] : 0;
        m->p[i] = m->swing[i] = 0;
        bent += m->phi[i] * m->q[i];
    }
    c->penetration = -bent - c->height;
    double greatest;
    const char *whose;
    c->energy_start = c->state.energy = energy_of(c, coupled_modal(c), &greatest, &whose);
    c->state.highest = fmax(greatest, fabs(c->energy_start));
    fill(c, &c->state);
}

static bool given(const struct coupled *c, int steps, const double *surface, const double *phi_to, struct err *e)
{
    for (int i = 0; i < steps; i++)
        if (!isfinite(surface[i]))
            return err_set(e, ERR_NUMBERS, "the height of the surface under the ball is not finite (%g m) at step %ld",
                           surface[i], c->state.steps + i + 1);
    for (int i = 0; phi_to && i < c->modes.n; i++)
        if (!isfinite(phi_to[i]))
            return err_set(e, ERR_NUMBERS, "the shape of mode %d under the ball is not finite (%g) at step %ld", i + 1,
                           phi_to[i], c->state.steps + steps);
    return true;
}

bool coupled_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                 struct err *e)
{
    static bool (*const runs[])(struct coupled *, int, const double *, const double *, double *,
                                struct err *) = {[INTEGRATOR_DISCRETE_GRADIENT] = coupled_gradient_run,
                                                 [INTEGRATOR_RK4] = rk4_run,
                                                 [INTEGRATOR_EXACT_IMPACT] = exact_run};
    if (steps < 1) return true;
    c->seen_so_far = 0;
    if (!given(c, steps, surface, phi_to, e)) return false;
    bool moves = phi_to && c->modes.n > 0 && memcmp(phi_to, c->modes.phi, (size_t)c->modes.n * sizeof *phi_to) != 0;
    if (moves) memcpy(c->modes.phi_to, phi_to, (size_t)c->modes.n * sizeof *phi_to);
    if (!runs[c->ask.integrator](c, steps, surface, moves ? c->modes.phi_to : NULL, force, e) ||
        !coupled_balance(c, c->ask.integrator != INTEGRATOR_RK4, e))
        return false;
    fill(c, &c->state);
    return true;
}

const struct coupled_state *coupled_state(const struct coupled *c) { return &c->state; }

void coupled_mode(const struct coupled *c, int i, double *displacement, double *velocity)
{
    *displacement = c->modes.q[i];
    *velocity = c->modes.p[i];
}

/* Twice the integral of dx / sqrt(1 - x^2.5) over 0 to 1, which is 0.8 B(2/5, 1/2), by 30 digits of Gamma(0.4)
 * Gamma(0.5) / Gamma(0.9). */
double coupled_contact_time(double mass, double stiffness, double speed)
{
    return 2.94327518432470482 * real_pow(1.25 * mass / stiffness, 0.4) / real_pow(speed, 0.2);
}
