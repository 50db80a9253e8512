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
#include <math.h>

#include "convolution/coupled_parts.h"
#include "force/hertz.h"
#include "num/real.h"

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

static bool ready(const struct coupled *c, struct err *e)
{
    const struct coupled_ask *k = &c->ask;
    double fall = k->mu * k->step * k->weight / k->mass;
    return fall < 1 || err_set(e, ERR_SCENE,
                               "contact.roll.integrator: exact_impact: a ball that falls for one step (%.3g s) is "
                               "faster than 1/mu = %.3g m/s; raise accuracy.contact_steps, "
                               "lower mu, or choose contact.roll.integrator: discrete_gradient",
                               k->step, 1 / k->mu);
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

bool coupled_exact_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                       struct err *e)
{
    const struct coupled_ask *k = &c->ask;
    const struct rules r = {k->stiffness / k->mass, k->mu, k->weight / k->mass, k->step};
    (void)phi_to;
    if (!ready(c, e)) return false;
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
