/* coupled.h by a discrete gradient: midpoint rule, Hunt-Crossley force from the change of the contact's potential V =
   (2/5) k xi^2.5 over the step h,

     f = DV max(0, 1 + mu (xi+ - xi) / h),   DV = (V(xi+) - V(xi)) / (xi+ - xi)
     w+ = w + h w' + h^2 (f - G) / 2m,       w'+ = w' + h (f - G) / m
     q+ = q + d,  d = h (p + p+) / 2,        p+ = p + h (-2 sigma~ d/h - W (q+ + q)/2 + phibar f / m~),   phibar = (phi
                                             + phi+)/2

   (Papetti, Avanzini and Rocchesso 2011 compare such forces; the form of a discrete gradient is Gonzalez's, 1996.) A
   mode's pole is that of the step: s~ = (2/h) tanh(s h / 2) = -sigma~ + ..., W = |s~|^2, so that exp(s h) is exact in
   frequency and decay; its mass m~ = |s|^2 / W keeps what it yields to a standing force. Multiplied out, H of coupled.c
   with inertia m~ and spring m~ W = |s|^2 changes in each step by exactly

     f (s+ - s) - f sum (phi+ - phi) (q + q+)/2  -  (f - DV)(xi+ - xi)  -  sum (2 sigma~ m~ / h) d^2:

   work of the surface and of the moving place, loss in the contact (never negative: f > DV when closing, f < DV when
   parting) and in the modes. So nothing gains energy, however large h is; of second order in h.

   The step's equation is solved in coupled_pinch.c.

   Modes (coupled_chorus.c): what a step's force does two steps on is known beforehand (`reply`), so that the modes are
   one step behind the ball: a step's pass over them runs while the next step's force, a chain of about 150 cycles of
   latency, is looked for. */
#include <string.h>

#include "convolution/coupled_chorus.h"
#include "convolution/coupled_pinch.h"
#include "num/real.h"

#define INLINE static inline __attribute__((always_inline))

enum { SPELL = 256 }; /* steps between two closings of the ledger */

bool coupled_gradient_make(struct coupled *c, struct err *e)
{
    struct coupled_modes *m = &c->modes;
    double h = c->ask.step;
    for (int i = 0; i < m->n; i++) {
        double angle = m->frequency[i] * h, t = real_tanh(m->decay[i] * h / 2);
        if (angle >= 0.5)
            return err_set(e, ERR_SCENE,
                           "mode %d (%g Hz) is at or above half the rate of the coupled steps (%g Hz): take more steps "
                           "(accuracy.contact_steps) or leave it out",
                           i + 1, m->frequency[i], 0.5 / h);
        double cosine = real_cospi(angle), sine = real_sinpi(angle);
        double below = cosine * cosine + t * t * (sine * sine);
        double damping = t / below * (2 / h),
               square = (t * t * (cosine * cosine) + sine * sine) / below * (4 / (h * h));
        double mass = m->square[i] / square, all = 1 + damping * h + square * h * h / 4;
        m->inertia[i] = mass;
        m->spring[i] = m->square[i];
        m->turn[i] = 2 / all;
        m->pull[i] = square * h * h / (2 * all);
        m->push[i] = h * h / (2 * all * mass);
        m->drain[i] = 2 * damping * mass / h;
        m->stay[i] = (1 - m->pull[i]) * (1 - m->pull[i]) - m->turn[i] * m->pull[i];
        m->carry[i] = m->turn[i] * (m->turn[i] - m->pull[i]);
    }
    return true;
}

/* A run: what stays the same in it, and what is summed up between two closings of the ledger. */
struct gradient_run {
    struct coupled *c;
    double own; /* h^2 / 2m                                                        */
    struct coupled_answers answers;
    struct coupled_chorus sum;
    struct coupled_pinch pinch;
    bool moves;              /* phi does                                                        */
    double wide;             /* xi+ - xi of the last step                                       */
    double work, loss;       /* J, by the surface and in the contact, in this spell             */
    double deepest, fastest; /* greatest xi and |w'| so far                                     */
};

static bool stuck(const struct gradient_run *r, long step, double free, double yield, struct err *e)
{
    return err_set(e, ERR_NUMBERS,
                   "step %ld of the coupled contact has no solution after %d passes (penetration %g m, %g m without a "
                   "force, %g m/N; the place moves too far in one step, "
                   "or a value is not finite)",
                   step, r->pinch.passes, r->pinch.from, free, yield);
}

/* The ball and the ledger, from a force that is found. work: by the surface, per N. */
INLINE void take(struct gradient_run *r, long step, double free, double work)
{
    struct coupled *c = r->c;
    struct coupled_pinch *k = &r->pinch;
    double h = c->ask.step, net = k->force - c->ask.weight, wide = k->to - k->from;
    c->height += h * c->speed + r->own * net;
    c->speed += h / c->ask.mass * net;
    if (k->from > 0 || k->to > 0) {
        double factor = k->rate * wide;
        r->work += k->force * work;
        r->loss += k->gradient * (factor > -1 ? factor : -1) * wide;
        c->state.iterations += k->passes;
        c->state.iterations_most = k->passes > c->state.iterations_most ? k->passes : c->state.iterations_most;
        c->state.contact_steps++;
        coupled_touch(c, step, k->from, k->to, (free - k->from) / h);
    }
    coupled_rise(c, k->to);
    r->wide = wide;
    c->own[0] = c->force_before;
    c->force_before = c->force;
    c->force = k->force;
    k->from = k->to;
    k->root = k->to_root;
    r->deepest = k->to > r->deepest ? k->to : r->deepest;
    r->fastest = fabs(c->speed) > r->fastest ? fabs(c->speed) : r->fastest;
}

/* The moving place's work on the modes in a step, from both its ends. */
INLINE void lean(struct gradient_run *r, double force, double before, double after)
{
    if (r->moves) r->work -= force * (0.5 * (before + after));
}

/* The ball's fields that change with every step but are read between spells only. */
static void settle(struct gradient_run *r)
{
    r->c->penetration = r->pinch.from;
    r->c->closing = r->wide / r->c->ask.step;
}

/* The modes' true displacements and velocities, and what they have lost. */
static void finish(struct gradient_run *r, int to)
{
    struct coupled_modes *m = &r->c->modes;
    double before = r->sum.place;
    coupled_chorus_advance(m, to - 0.5, to + 2.0, r->c->force, &r->sum);
    lean(r, r->c->force, before, r->sum.place);
    coupled_sum_add(&r->c->mode_loss, coupled_chorus_sum(r->sum.lanes.lost));
    for (int i = 0; i < m->padded; i++)
        m->p[i] = m->swing[i] * (2 / r->c->ask.step);
}

/* A step's force, and the modes' end of the step before (on: as coupled_chorus_advance has it), whose force is known.
   Each fills the other's latencies, which is why they are laid between each other in pieces: 50 modes take 230 cycles a
   step so (AVX-512), 390 one after the other, whichever is first, as no CPU looks far enough ahead. */
INLINE bool press(struct gradient_run *r, double free, double yield, double on)
{
    const struct coupled *c = r->c;
    struct coupled_pinch *k = &r->pinch;
    const struct coupled_modes *m = &c->modes;
    const int end = m->padded, half = end / (2 * LANES) * LANES;
    const double last = c->force, lean = (on - 2.5) * last,
                 guess = free - yield * (3 * (last - c->force_before) + c->own[0]);
    const bool stays = coupled_pinch_stays(k, free, yield);
    struct coupled_chorus *sum = &r->sum;
    double x = 0, change = 0;
    if (on == 0) return coupled_pinch(k, free, yield, guess);
    if (stays) x = coupled_pinch_first(k, guess);
    coupled_chorus_open(sum);
    coupled_chorus_some(m, (int[]){0, half}, last, lean, &sum->lanes);
    if (stays) {
        change = coupled_pinch_pass(k, free, yield, x);
        x -= change;
        k->passes = 1;
    }
    coupled_chorus_some(m, (int[]){half, end}, last, lean, &sum->lanes);
    coupled_chorus_close(sum, on);
    return stays ? coupled_pinch_close(k, x, change) || coupled_pinch_on(k, free, yield, x)
                 : coupled_pinch(k, free, yield, guess);
}

/* Steps first + 1 to `to` of the run, in a spell that began after step `from`. */
LANES_CLONES
static bool steps_on(struct gradient_run *r, const int spell[3], const double *surface, double *force, struct err *e)
{
    struct coupled *c = r->c;
    const int from = spell[0], first = spell[1], to = spell[2];
    const double h = c->ask.step, drop = r->own * c->ask.weight;
    for (int j = first + 1; j <= to; j++) {
        const bool behind = c->modes.padded > 0 && j > from + 1;
        const double last = c->force, place = r->sum.place, next = surface[j - 1] - c->origin;
        double bent = behind ? r->sum.later + last * coupled_chorus_along(r->answers.reply, j, j - 1.5) : r->sum.next;
        double free = (next - bent) - (c->height + (h * c->speed - drop)),
               yield = r->own + coupled_chorus_along(r->answers.press, j, j - 0.5);
        if (!(yield > 0) || !press(r, free, yield, behind ? j + 1 : 0))
            return stuck(r, c->state.steps + j - from, free, yield, e);
        if (behind) lean(r, last, place, r->sum.place);
        take(r, c->state.steps + j - from - 1, free, next - c->surface);
        c->surface = next;
        force[j - 1] = r->pinch.force;
    }
    return true;
}

/* What is seen after step `at`, where the modes are one step behind. */
static void watch(struct gradient_run *r, int from, int at)
{
    struct coupled *c = r->c;
    struct coupled_look look = {coupled_modal(c), 0, 0};
    double work = r->work;
    if (c->modes.padded > 0 && at > from) {
        look = coupled_chorus_look(&c->modes, at - 0.5, c->force, c->ask.step, &r->sum);
        work -= r->moves ? c->force * (0.5 * (r->sum.place + look.place)) : 0;
    }
    settle(r);
    coupled_seen(c, c->state.steps + at - from, &(struct coupled_account){look.energy, work, r->loss, look.lost});
}

/* Steps from + 1 to `to` of the run. */
static bool spell(struct gradient_run *r, int from, int to, const double *surface, double *force, struct err *e)
{
    struct coupled *c = r->c;
    if (c->modes.padded > 0) coupled_chorus_begin(&c->modes, from + 1, &r->sum);
    for (int at = from; at < to;) {
        int end = coupled_unseen(c, at, to);
        if (end == at) watch(r, from, at);
        end = coupled_unseen(c, at + 1, to);
        if (!steps_on(r, (int[]){from, at, end}, surface, force, e)) return false;
        at = end;
    }
    if (c->modes.padded > 0) finish(r, to);
    settle(r);
    coupled_sum_add(&c->surface_work, r->work);
    coupled_sum_add(&c->contact_loss, r->loss);
    r->work = r->loss = 0;
    c->state.highest = fmax(c->state.highest, fmax(coupled_potential(c->ask.stiffness, r->deepest),
                                                   0.5 * c->ask.mass * r->fastest * r->fastest));
    c->state.steps += to - from;
    return true;
}

bool coupled_gradient_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                          struct err *e)
{
    struct gradient_run r = {.c = c, .own = c->ask.step * c->ask.step / (2 * c->ask.mass), .moves = phi_to != NULL};
    coupled_chorus_answers(&c->modes, steps, phi_to, &r.answers);
    r.pinch = (struct coupled_pinch){.stiffness = 0.4 * c->ask.stiffness,
                                     .rate = c->ask.mu / c->ask.step,
                                     .from = c->penetration,
                                     .root = c->penetration > 0 ? sqrt(c->penetration) : 0};
    for (int from = 0; from < steps; from += SPELL) {
        int to = from + SPELL < steps ? from + SPELL : steps;
        if (!spell(&r, from, to, surface, force, e) || !coupled_balance(c, true, e)) return false;
    }
    if (phi_to) memcpy(c->modes.phi, phi_to, (size_t)c->modes.padded * sizeof *phi_to);
    return true;
}
