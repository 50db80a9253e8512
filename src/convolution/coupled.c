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
#include <string.h>

#include "convolution/coupled_parts.h"
#include "num/real.h"
#include "scene/scene.h"

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
    if (ask->integrator == INTEGRATOR_RK4) return coupled_rk4_make(c, e);
    return ask->integrator != INTEGRATOR_DISCRETE_GRADIENT || coupled_gradient_make(c, e);
}

/* How far the modes' places sink under the weight. */
static double sunk(const struct coupled *c, const double *phi)
{
    double sum = 0;
    for (int i = 0; phi && i < c->modes.n; i++)
        sum += phi[i] * phi[i] / c->modes.square[i];
    return sum * c->ask.weight;
}

/* k xi^1.5 = G */
static double pressed(const struct coupled *c)
{
    double load = c->ask.weight / c->ask.stiffness;
    return load > 0 ? real_pow(load, 2.0 / 3) : 0;
}

double coupled_rest(const struct coupled *c, double surface, const double *phi)
{
    return surface - (sunk(c, phi) + pressed(c));
}

static void start_modes(struct coupled *c, const double *phi, bool settled)
{
    struct coupled_modes *m = &c->modes;
    for (int i = 0; i < m->padded; i++) {
        m->phi[i] = phi && i < m->n ? phi[i] : 0;
        m->q[i] = settled ? m->phi[i] * c->ask.weight / m->square[i] : 0;
        m->p[i] = m->swing[i] = 0;
    }
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

static bool unbalanced(const struct coupled *c, double bound, const char *whose, struct err *e)
{
    const struct coupled_state *s = &c->state;
    return err_set(e, ERR_NUMBERS,
                   "the energy of the coupled contact is off balance by %.3g J at step %ld (allowed: %.3g J): energy "
                   "%.6g J, most of it in %s; work of the surface %.6g J, "
                   "lost in the contact %.6g J, in the modes %.6g J; at most %ld iterations a step: take more steps "
                   "(accuracy.contact_steps)",
                   s->residual, s->steps, bound, s->energy, whose, s->surface_work, s->contact_loss, s->mode_loss,
                   s->iterations_most);
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
    return !bounded || fabs(s->residual) <= bound || unbalanced(c, bound, whose, e);
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
    start_modes(c, phi, settled);
    double bent = 0;
    for (int i = 0; i < c->modes.n; i++)
        bent += c->modes.phi[i] * c->modes.q[i];
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
                                                 [INTEGRATOR_RK4] = coupled_rk4_run,
                                                 [INTEGRATOR_EXACT_IMPACT] = coupled_exact_run};
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
