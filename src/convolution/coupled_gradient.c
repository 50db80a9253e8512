/* coupled.h by a discrete gradient: midpoint rule, Hunt-Crossley force from the change of the contact's potential V = (2/5) k xi^2.5 over the step h,

     f = DV max(0, 1 + mu (xi+ - xi) / h),   DV = (V(xi+) - V(xi)) / (xi+ - xi)
     w+ = w + h w' + h^2 (f - G) / 2m,       w'+ = w' + h (f - G) / m
     q+ = q + d,  d = h (p + p+) / 2,        p+ = p + h (-2 sigma~ d/h - W (q+ + q)/2 + phibar f / m~),   phibar = (phi + phi+)/2

   (Papetti, Avanzini and Rocchesso 2011 compare such forces; the form of a discrete gradient is Gonzalez's, 1996.) A mode's pole is that of the
   step: s~ = (2/h) tanh(s h / 2) = -sigma~ + ..., W = |s~|^2, so that exp(s h) is exact in frequency and decay; its mass m~ = |s|^2 / W keeps what it yields to a
   standing force. Multiplied out, H of coupled.c with inertia m~ and spring m~ W = |s|^2 changes in each step by exactly

     f (s+ - s) - f sum (phi+ - phi) (q + q+)/2  -  (f - DV)(xi+ - xi)  -  sum (2 sigma~ m~ / h) d^2:

   work of the surface and of the moving place, loss in the contact (never negative: f > DV when closing, f < DV when parting) and in the modes. So nothing
   gains energy, however large h is; of second order in h.

   The step's equation is solved in coupled_pinch.c.

   Modes: with swing P = h p / 2 a step is d = turn P - pull q + push phibar f, q += d, P = d - P. What a step's force does two steps on is known
   beforehand (`reply` below), so the sum that the next step needs runs while this one's force is looked for. */
#include <string.h>

#include "convolution/coupled_parts.h"
#include "convolution/coupled_pinch.h"
#include "num/real.h"

enum { SPELL = 256 }; /* steps between two closings of the ledger */

bool coupled_gradient_make(struct coupled *c, struct err *e)
{
    struct coupled_modes *m = &c->modes;
    double h = c->ask.step;
    for (int i = 0; i < m->n; i++) {
        double angle = m->frequency[i] * h, t = real_tanh(m->decay[i] * h / 2);
        if (angle >= 0.5)
            return err_set(e, ERR_SCENE, "mode %d (%g Hz) is at or above half the rate of the coupled steps (%g Hz): take more steps (accuracy.contact_steps) or leave it out",
                           i + 1, m->frequency[i], 0.5 / h);
        double cosine = real_cospi(angle), sine = real_sinpi(angle);
        double below = cosine * cosine + t * t * (sine * sine);
        double damping = t / below * (2 / h), square = (t * t * (cosine * cosine) + sine * sine) / below * (4 / (h * h));
        double mass = m->square[i] / square, all = 1 + damping * h + square * h * h / 4;
        m->inertia[i] = mass;
        m->spring[i] = m->square[i];
        m->turn[i] = 2 / all;
        m->pull[i] = square * h * h / (2 * all);
        m->push[i] = h * h / (2 * all * mass);
        m->drain[i] = 2 * damping * mass / h;
    }
    return true;
}

/* What the modes say in one step, summed over them. */
struct chorus {
    double next, later; /* sum phi q at the end of the step to come, and of the one after it, as if no force acted in either */
    double place;       /* sum slant q                                                                                      */
    double lost[LANES]; /* J, of the steps that have ended since begin                                                     */
};

static double added(const double *lane)
{
    double sum = 0;
    for (int l = 0; l < LANES; l++)
        sum += lane[l];
    return sum;
}

/* From step `on - 1` of the run, whose ends are known. */
LANES_CLONES
static void begin(const struct coupled_modes *m, double on, struct chorus *sum)
{
    double next[LANES] = {0}, later[LANES] = {0}, place[LANES] = {0};
    double *restrict ahead = m->ahead;
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double x = m->q[i + l], v = m->swing[i + l], phi = m->phi[i + l], slant = m->slant[i + l];
            double free = m->turn[i + l] * v - m->pull[i + l] * x;
            place[l] += slant * x;
            ahead[i + l] = free;
            x += free;
            v = free - v;
            next[l] += (phi + on * slant) * x;
            later[l] += (phi + (on + 1) * slant) * (x + (m->turn[i + l] * v - m->pull[i + l] * x));
        }
    *sum = (struct chorus){.next = added(next), .later = added(later), .place = added(place)};
}

/* Ends a step whose force is known (bar: its middle) and goes ahead by two (on: the end of the second), in steps of the run, in which phi is straight. */
LANES_CLONES
static void advance(const struct coupled_modes *m, double bar, double on, double force, struct chorus *sum)
{
    double later[LANES] = {0}, place[LANES] = {0}, lost[LANES];
    memcpy(lost, sum->lost, sizeof lost);
    double *restrict q = m->q, *restrict swing = m->swing, *restrict ahead = m->ahead;
    const double *restrict phi = m->phi, *restrict slant = m->slant, *restrict turn = m->turn, *restrict pull = m->pull;
    const double *restrict push = m->push, *restrict drain = m->drain;
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double d = ahead[i + l] + push[i + l] * ((phi[i + l] + bar * slant[i + l]) * force);
            double x = q[i + l] + d, v = d - swing[i + l];
            lost[l] += drain[i + l] * (d * d);
            place[l] += slant[i + l] * x;
            q[i + l] = x;
            swing[i + l] = v;
            double free = turn[i + l] * v - pull[i + l] * x;
            ahead[i + l] = free;
            x += free;
            v = free - v;
            later[l] += (phi[i + l] + on * slant[i + l]) * (x + (turn[i + l] * v - pull[i + l] * x));
        }
    memcpy(sum->lost, lost, sizeof lost);
    sum->later = added(later);
    sum->place = added(place);
}

/* A run: what stays the same in it, and the modes' answers to a force as polynomials of the step's number, for phi is straight. */
struct gradient_run {
    struct coupled *c;
    double own;                           /* h^2 / 2m                                                    */
    double press[3];                      /* sum push phi^2, push phi slant, push slant^2: sum phi+ q+ per N */
    double reply[3];                      /* the same of (1 + turn - pull) push: one step later              */
    struct chorus sum;
    struct coupled_pinch pinch;
    bool moves;                           /* phi does                                                    */
    double deepest, fastest;              /* greatest xi and |w'| so far                                 */
};

static double along(const double *c, double to, double middle)
{
    return c[0] + (to + middle) * c[1] + to * middle * c[2];
}

static void prepare(struct gradient_run *r, int steps, const double *phi_to)
{
    struct coupled *c = r->c;
    const struct coupled_modes *m = &c->modes;
    for (int i = 0; i < m->padded; i++) {
        double phi = m->phi[i], slant = phi_to ? (phi_to[i] - phi) / steps : 0, later = (1 + m->turn[i] - m->pull[i]) * m->push[i];
        m->slant[i] = slant;
        const double product[3] = {phi * phi, phi * slant, slant * slant};
        for (int k = 0; k < 3; k++) {
            r->press[k] += m->push[i] * product[k];
            r->reply[k] += later * product[k];
        }
    }
    r->own = c->ask.step * c->ask.step / (2 * c->ask.mass);
    r->pinch = (struct coupled_pinch){.stiffness = 0.4 * c->ask.stiffness, .rate = c->ask.mu / c->ask.step, .from = c->penetration,
                              .root = c->penetration > 0 ? sqrt(c->penetration) : 0};
}

static bool stuck(const struct gradient_run *r, long step, double free, double yield, struct err *e)
{
    return err_set(e, ERR_NUMBERS, "step %ld of the coupled contact has no solution after %d passes (penetration %g m, %g m without a force, %g m/N; the place moves too far in one step, "
                   "or a value is not finite)", step, r->pinch.passes, r->pinch.from, free, yield);
}

/* The ball and the ledger, from a force that is found. work: by the surface, per N. */
static inline void take(struct gradient_run *r, long step, double free, double work)
{
    struct coupled *c = r->c;
    struct coupled_pinch *k = &r->pinch;
    double h = c->ask.step, net = k->force - c->ask.weight, wide = k->to - k->from;
    if (k->from > 0 || k->to > 0) {
        double factor = k->rate * wide;
        coupled_sum_add(&c->surface_work, k->force * work);
        coupled_sum_add(&c->contact_loss, k->gradient * (factor > -1 ? factor : -1) * wide);
        c->state.iterations += k->passes;
        c->state.iterations_most = k->passes > c->state.iterations_most ? k->passes : c->state.iterations_most;
        c->state.contact_steps++;
        coupled_touch(c, step, k->from, k->to, (free - k->from) / h);
    }
    c->height += h * c->speed + r->own * net;
    c->speed += h / c->ask.mass * net;
    c->closing = wide / h;
    c->own[0] = c->force_before;
    c->force_before = c->force;
    c->force = k->force;
    k->from = k->to;
    k->root = k->to_root;
    r->deepest = k->to > r->deepest ? k->to : r->deepest;
    r->fastest = fabs(c->speed) > r->fastest ? fabs(c->speed) : r->fastest;
}

/* The moving place's work on the modes in a step that has ended, from both its ends. */
static inline void lean(struct gradient_run *r, double before)
{
    if (r->moves)
        coupled_sum_add(&r->c->surface_work, -r->c->force * (0.5 * (before + r->sum.place)));
}

/* The modes' true displacements and velocities, and what they have lost. */
static void finish(struct gradient_run *r, int to)
{
    struct coupled_modes *m = &r->c->modes;
    double before = r->sum.place;
    advance(m, to - 0.5, to + 2.0, r->c->force, &r->sum);
    lean(r, before);
    coupled_sum_add(&r->c->mode_loss, added(r->sum.lost));
    for (int i = 0; i < m->padded; i++)
        m->p[i] = m->swing[i] * (2 / r->c->ask.step);
}

/* Steps from + 1 to `to` of the run. */
static bool spell(struct gradient_run *r, int from, int to, const double *surface, double *force, struct err *e)
{
    struct coupled *c = r->c;
    const bool modes = c->modes.padded > 0;
    const double h = c->ask.step, drop = r->own * c->ask.weight;
    if (modes)
        begin(&c->modes, from + 1, &r->sum);
    for (int j = from + 1; j <= to; j++) {
        double bent = r->sum.next, place = r->sum.place, next = surface[j - 1] - c->origin;
        if (modes && j > from + 1) {
            bent = r->sum.later + c->force * along(r->reply, j, j - 1.5);
            advance(&c->modes, j - 1.5, j + 1.0, c->force, &r->sum);
            lean(r, place);
        }
        double free = (next - bent) - (c->height + (h * c->speed - drop)), yield = r->own + along(r->press, j, j - 0.5);
        if (!(yield > 0) || !coupled_pinch(&r->pinch, free, yield, free - yield * (3 * (c->force - c->force_before) + c->own[0])))
            return stuck(r, c->state.steps + j - from, free, yield, e);
        take(r, c->state.steps + j - from - 1, free, next - c->surface);
        c->surface = next;
        force[j - 1] = r->pinch.force;
    }
    if (modes)
        finish(r, to);
    c->penetration = r->pinch.from;
    c->state.highest = fmax(c->state.highest, fmax(coupled_potential(c->ask.stiffness, r->deepest), 0.5 * c->ask.mass * r->fastest * r->fastest));
    c->state.steps += to - from;
    return true;
}

bool coupled_gradient_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force, struct err *e)
{
    struct gradient_run r = {.c = c, .moves = phi_to != NULL};
    prepare(&r, steps, phi_to);
    for (int from = 0; from < steps; from += SPELL) {
        int to = from + SPELL < steps ? from + SPELL : steps;
        if (!spell(&r, from, to, surface, force, e) || !coupled_balance(c, true, e))
            return false;
    }
    if (phi_to)
        memcpy(c->modes.phi, phi_to, (size_t)c->modes.padded * sizeof *phi_to);
    return true;
}
