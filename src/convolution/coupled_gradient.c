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

   Modes: what a step's force does two steps on is known beforehand (`reply`), so that the modes are
   one step behind the ball: a step's pass over them runs while the next step's force, a chain of about 150 cycles of
   latency, is looked for. */
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/coupled_parts.h"
#include "force/hertz.h"
#include "num/real.h"

/* The force of one step, with which the step ends where the force says:

     xi+ = A - B f(xi+),  f = DV max(0, 1 + mu (xi+ - xi) / h),  DV = (V(xi+) - V(xi)) / (xi+ - xi),  V = (2/5) k max(0,
       xi)^2.5,

   A the penetration without force, m; B > 0 what 1 N takes off it. V is convex, so f never falls as xi+ rises and there
   is one root. Only + - * / sqrt. */

struct coupled_contact_solve {
    double stiffness;   /* (2/5) k                                   */
    double rate;        /* mu / h                                    */
    double from, root;  /* xi and, if it is above 0, its square root; 0 */
    double to, to_root; /* xi+                                       */
    double gradient, force;
    int passes;
};

/* The same in pieces for steps in contact, so that who has other work can lay it between: each piece is a chain of 30
   to 60 cycles' latency. Where coupled_contact_solve_stays, x = coupled_contact_solve_first, then x =
   coupled_contact_solve_pass, then coupled_contact_solve_close, or, where that says no, coupled_contact_solve_on. */

/* Are both penetrations above 0? f(0) = (2/5) k xi^1.5 max(0, least). */
static inline bool coupled_contact_solve_stays(const struct coupled_contact_solve *k, double a, double b)
{
    double least = 1 - k->rate * k->from;
    return k->from > 0 && a > (least > 0 ? b * k->stiffness * k->from * k->root * least : 0);
}

static inline double coupled_contact_solve_first(const struct coupled_contact_solve *k, double guess)
{
    return guess > 0 ? sqrt(guess) : k->root;
}

/* The polynomial in b = sqrt(xi+) at x, by Halley's method (of third order): what x has to be lowered by; all of x
 * where the force would be cut off, so that x is 0, which settles nothing (NAN would trap where it is compared). */
static inline double coupled_contact_solve_pass(const struct coupled_contact_solve *k, double a, double b, double x)
{
    const double r = k->root, square = k->from, cube = square * r, kb = k->stiffness * b, rate = k->rate;
    double xx = x * x, s = x + r, factor = 1 + rate * (xx - square), n = xx * (xx + r * x + square) + cube * s;
    double n1 = x * (4 * xx + 3 * r * x + 2 * square) + cube, n2 = 12 * xx + 6 * r * x + 2 * square;
    double off = (xx - a) * s + kb * n * factor;
    double slope = 2 * x * s + (xx - a) + kb * (n1 * factor + 2 * rate * n * x);
    double bend = 2 * (s + 2 * x) + kb * (n2 * factor + 2 * rate * (2 * n1 * x + n)); /* off's second derivative */
    return factor > 0 ? off * slope / (slope * slope - 0.5 * off * bend) : x;
}

/* x: after the pass that lowered it by change. When that moved it by less than 2^-18 of itself the next one would be
 * below the rounding. False: not settled. */
static inline bool coupled_contact_solve_close(struct coupled_contact_solve *k, double x, double change)
{
    const double r = k->root, square = k->from, cube = square * r;
    if (!(x > 0) || !(fabs(change) <= 0x1p-18 * x)) return false;
    double xx = x * x, factor = 1 + k->rate * (xx - square);
    k->gradient = k->stiffness * (xx * (xx + r * x + square) + cube * (x + r)) / (x + r);
    k->force = k->gradient * factor;
    k->to = xx;
    k->to_root = x;
    return factor > 0;
}

/* Four cases:

     xi <= 0, A <= 0          free flight, f = 0;
     xi > 0, xi+ <= 0         lift-off: with y = xi - xi+ a quadratic, y^2 - (xi - A - B V mu / h) y = B V;
     xi > 0, xi+ > 0          with a = sqrt(xi), b = sqrt(xi+): DV is a polynomial over a + b (force/hertz.h);
                              times a + b a
                              polynomial in b, by Halley's method from the force's continuation by a parabola: one
                                division a pass, no root;
     else (landings; what that does not settle) Newton's method in xi+, kept between 0 and A by halving. */
enum { HALLEY = 8, PASSES = 60 }; /* most passes of Halley's method; of Newton's and halving */

/* Force at xi+ and, in *slope, its derivative. Not both penetrations <= 0. */
static double force_at(struct coupled_contact_solve *k, double to, double *slope)
{
    double steep, b = to > 0 ? sqrt(to) : 0, a = k->root;
    if (k->from > 0 && to > 0) {
        double s = a + b;
        k->gradient = k->stiffness * hertz_mean_quartic(a, b, k->from, to) / s;
        steep = k->stiffness / 2 * (b * (b * (3 * b + 6 * a) + 4 * a * a) + 2 * a * a * a) / (s * s);
    } else if (to > 0) {
        k->gradient = k->stiffness * to * to * b / (to - k->from);
        steep = (2.5 * k->stiffness * to * b - k->gradient) / (to - k->from);
    } else {
        k->gradient = k->stiffness * k->from * k->from * a / (k->from - to);
        steep = k->gradient / (k->from - to);
    }
    double factor = 1 + k->rate * (to - k->from);
    k->to = to;
    k->to_root = b;
    if (!(factor > 0)) {
        *slope = 0;
        return k->force = 0;
    }
    *slope = steep * factor + k->gradient * k->rate;
    return k->force = k->gradient * factor;
}

/* The root between 0 and A, to the rounding of either side. The equation's left side is convex, so Newton's method
   comes down to it from A; should rounding turn it round, halving goes on: a step is taken as long as it stays between
   and at least halves the last one. */
static bool search(struct coupled_contact_solve *k, double a, double b)
{
    double low = 0, high = a, at = a, last = 2 * a, slope;
    double enough = 2 * DBL_EPSILON * (fabs(a) + fabs(k->from));
    for (int pass = 0; pass < PASSES; pass++) {
        k->passes++;
        double off = at - a + b * force_at(k, at, &slope);
        if (fabs(off) <= enough) return true;
        *(off > 0 ? &high : &low) = at;
        double step = off / (1 + b * slope), next = at - step;
        if (fabs(step) <= 8 * DBL_EPSILON * (at + fmax(k->from, 0))) return true;
        if (!(next > low && next < high && fabs(step) <= 0.5 * last)) next = low + 0.5 * (high - low);
        if (next == low || next == high) return true;
        last = fabs(next - at);
        at = next;
    }
    return false;
}

/* xi+ <= 0 < xi; f (xi - xi+) = V(xi) max(0, 1 - mu (xi - xi+) / h). */
static void part(struct coupled_contact_solve *k, double a, double b)
{
    double v = k->stiffness * k->from * k->from * k->root, half = (k->from - a - b * v * k->rate) / 2;
    double wide = sqrt(half * half + b * v), y = half > 0 ? half + wide : b * v / (wide - half), slope;
    if (1 - k->rate * y <= 0) y = k->from - a;
    force_at(k, fmin(k->from - y, 0), &slope);
    k->passes++;
}

/* From an x that is not settled after k->passes passes. */
static bool coupled_contact_solve_on(struct coupled_contact_solve *k, double a, double b, double x)
{
    while (x > 0 && k->passes < HALLEY) {
        double change = coupled_contact_solve_pass(k, a, b, x);
        x -= change;
        k->passes++;
        if (coupled_contact_solve_close(k, x, change)) return true;
    }
    return search(k, a, b);
}

/* Fills to, to_root, gradient (DV), force and passes; guess: of xi+, where both are in contact. False: no root found,
 * or a value is not finite. */
static bool coupled_contact_solve(struct coupled_contact_solve *k, double a, double b, double guess)
{
    k->passes = 0;
    if (coupled_contact_solve_stays(k, a, b))
        return coupled_contact_solve_on(k, a, b, coupled_contact_solve_first(k, guess));
    if (k->from > 0) {
        part(k, a, b);
        return true;
    }
    if (a > 0) return search(k, a, b);
    k->to = a;
    k->to_root = k->gradient = k->force = 0;
    return true;
}

/* What the modes under a ball say in a step, all of them together: loops over modes, eight lanes
   at a time, with the same bits on every CPU.

   With swing P = h p / 2 a step is d = turn P - pull q + push phibar f, q += d, P = d - P; so two steps without a force
   take q to stay q + carry P, stay = (1 - pull)^2 - turn pull, carry = turn (turn - pull). Places are counted in steps
   of a run, in which phi is straight: phi after `on` steps is phi + on slope_phi. */

struct coupled_modal_sum {
    double next,
        later; /* sum phi q at the end of the step to come, and of the one after it, as if no force acted in either */
    double place; /* sum slope_phi q */
    struct coupled_accumulators {
        _Alignas(64) double lost[LANES];                 /* J, of the steps that have ended since begin */
        double later[LANES], slope[LANES], place[LANES]; /* of the pieces that have been gone through   */
    } lanes;
};

/* The modes' answers to 1 N as polynomials of the step's number (coupled_modal_sum_along). */
struct coupled_answers {
    double press[3]; /* sum push phi^2, push phi slope_phi, push slope_phi^2: sum phi+ q+ per N of the step */
    double reply[3]; /* the same of (1 + turn - pull) push: one step later                          */
};

/* sum push (phi + to slope_phi) (phi + middle slope_phi), and so on. */
static inline double coupled_modal_sum_along(const double *c, double to, double middle)
{
    return c[0] + (to + middle) * c[1] + to * middle * c[2];
}

/* What advance would end the step with, nothing being moved. */
struct coupled_look {
    double energy, lost, place; /* J of the modes; J in that step and those before it; sum slope_phi q */
};

static inline void coupled_modal_sum_open(struct coupled_modal_sum *sum)
{
    memset(sum->lanes.later, 0, sizeof sum->lanes.later);
    memset(sum->lanes.slope, 0, sizeof sum->lanes.slope);
    memset(sum->lanes.place, 0, sizeof sum->lanes.place);
}

/* lean: bar force. 11 multiplications and 10 additions a mode; for callers that are LANES_CLONES. The lanes go to
   memory as a whole: gcc takes those of a local struct apart, and putting them together again costs 30 cycles. */
static inline __attribute__((always_inline)) void coupled_modal_sum_some(const struct coupled_modes *m,
                                                                         const int some[2], double force, double lean,
                                                                         struct coupled_accumulators *to)
{
    double lost[LANES], later[LANES], slope[LANES], place[LANES];
    memcpy(lost, to->lost, sizeof lost);
    memcpy(later, to->later, sizeof later);
    memcpy(slope, to->slope, sizeof slope);
    memcpy(place, to->place, sizeof place);
    double *restrict q = m->q, *restrict swing = m->swing, *restrict ahead = m->ahead;
    const double *restrict phi = m->phi, *restrict slope_phi = m->slope_phi, *restrict turn = m->turn,
                           *restrict pull = m->pull;
    const double *restrict thrust = m->thrust, *restrict tilt = m->tilt, *restrict drain = m->drain,
                           *restrict stay = m->stay, *restrict carry = m->carry;
    for (int i = some[0]; i < some[1]; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double d = ahead[i + l] + (thrust[i + l] * force + tilt[i + l] * lean);
            double x = q[i + l] + d, s = d - swing[i + l], far = stay[i + l] * x + carry[i + l] * s;
            q[i + l] = x;
            swing[i + l] = s;
            ahead[i + l] = turn[i + l] * s - pull[i + l] * x;
            lost[l] += drain[i + l] * (d * d);
            place[l] += slope_phi[i + l] * x;
            later[l] += phi[i + l] * far;
            slope[l] += slope_phi[i + l] * far;
        }
    memcpy(to->lost, lost, sizeof lost);
    memcpy(to->later, later, sizeof later);
    memcpy(to->slope, slope, sizeof slope);
    memcpy(to->place, place, sizeof place);
}

static inline __attribute__((always_inline)) void coupled_modal_sum_close(struct coupled_modal_sum *sum, double on)
{
    const struct coupled_accumulators *v = &sum->lanes;
    double later[LANES];
#pragma omp simd
    for (int l = 0; l < LANES; l++)
        later[l] = v->later[l] + on * v->slope[l];
    sum->later = lanes_total(later);
    sum->place = lanes_total(v->place);
}

/* Bits do not depend on the instruction set: sums run over LANES accumulators and then in one
 * tree. */
/* Of the steps to phi_to (NULL: phi stays); sets slope_phi. */
LANES_CLONES
static void coupled_modal_sum_answers(const struct coupled_modes *m, int steps, const double *phi_to,
                                      struct coupled_answers *to)
{
    double press[3][LANES] = {{0}}, reply[3][LANES] = {{0}}, share = 1.0 / steps;
    double *restrict slopes = m->slope_phi, *restrict thrust = m->thrust, *restrict tilt = m->tilt;
    const double *end = phi_to ? phi_to : m->phi;
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double phi = m->phi[i + l], slope_phi = (end[i + l] - phi) * share, push = m->push[i + l];
            double later = (1 + m->turn[i + l] - m->pull[i + l]) * push;
            slopes[i + l] = slope_phi;
            thrust[i + l] = push * phi;
            tilt[i + l] = push * slope_phi;
            press[0][l] += push * (phi * phi);
            press[1][l] += push * (phi * slope_phi);
            press[2][l] += push * (slope_phi * slope_phi);
            reply[0][l] += later * (phi * phi);
            reply[1][l] += later * (phi * slope_phi);
            reply[2][l] += later * (slope_phi * slope_phi);
        }
    for (int k = 0; k < 3; k++) {
        to->press[k] = lanes_total(press[k]);
        to->reply[k] = lanes_total(reply[k]);
    }
}

/* From step `on - 1` of the run, whose ends are known. */
LANES_CLONES
static void coupled_modal_sum_begin(const struct coupled_modes *m, double on, struct coupled_modal_sum *sum)
{
    double next[LANES] = {0}, later[LANES] = {0}, place[LANES] = {0};
    double *restrict ahead = m->ahead;
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double x = m->q[i + l], v = m->swing[i + l], phi = m->phi[i + l], slope_phi = m->slope_phi[i + l];
            double free = m->turn[i + l] * v - m->pull[i + l] * x, far = m->stay[i + l] * x + m->carry[i + l] * v;
            place[l] += slope_phi * x;
            ahead[i + l] = free;
            next[l] += (phi + on * slope_phi) * (x + free);
            later[l] += (phi + (on + 1) * slope_phi) * far;
        }
    *sum =
        (struct coupled_modal_sum){.next = lanes_total(next), .later = lanes_total(later), .place = lanes_total(place)};
}

/* Ends a step whose force is known (bar: its middle) and goes ahead by two (on: the end of the second): that is
   coupled_modal_sum_open, _some from 0 to padded, in pieces of whole LANES, and _close. */
LANES_CLONES
static void coupled_modal_sum_advance(const struct coupled_modes *m, double bar, double on, double force,
                                      struct coupled_modal_sum *sum)
{
    coupled_modal_sum_open(sum);
    coupled_modal_sum_some(m, (int[]){0, m->padded}, force, bar * force, &sum->lanes);
    coupled_modal_sum_close(sum, on);
}

/* step: s */
LANES_CLONES
static struct coupled_look coupled_modal_sum_look(const struct coupled_modes *m, double bar, double force, double step,
                                                  const struct coupled_modal_sum *sum)
{
    double energy[LANES] = {0}, place[LANES] = {0}, lost[LANES], rate = 2 / step;
    memcpy(lost, sum->lanes.lost, sizeof lost);
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double d = m->ahead[i + l] + (m->thrust[i + l] * force + m->tilt[i + l] * (bar * force)),
                   x = m->q[i + l] + d, p = (d - m->swing[i + l]) * rate;
            lost[l] += m->drain[i + l] * (d * d);
            place[l] += m->slope_phi[i + l] * x;
            energy[l] += 0.5 * (m->inertia[i + l] * p * p + m->spring[i + l] * x * x);
        }
    return (struct coupled_look){lanes_total(energy), lanes_total(lost), lanes_total(place)};
}

#define INLINE static inline __attribute__((always_inline))

enum { BATCH = 256 }; /* steps between two closings of the ledger */

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
    struct coupled_modal_sum sum;
    struct coupled_contact_solve contact;
    bool moves;              /* phi does                                                        */
    double wide;             /* xi+ - xi of the last step                                       */
    double work, loss;       /* J, by the surface and in the contact, in this spell             */
    double deepest, fastest; /* greatest xi and |w'| so far                                     */
};

/* The ball and the ledger, from a force that is found. work: by the surface, per N. */
INLINE void take(struct gradient_run *r, long step, double free, double work)
{
    struct coupled *c = r->c;
    struct coupled_contact_solve *k = &r->contact;
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
        coupled_count_contact(c, step, k->from, k->to, (free - k->from) / h);
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
static void store_ball(struct gradient_run *r)
{
    r->c->penetration = r->contact.from;
    r->c->closing = r->wide / r->c->ask.step;
}

/* A step's force, and the modes' end of the step before (on: as coupled_modal_sum_advance has it), whose force is
   known.
   Each fills the other's latencies, which is why they are laid between each other in pieces: 50 modes take 230 cycles a
   step so (AVX-512), 390 one after the other, whichever is first, as no CPU looks far enough ahead. */
INLINE bool press(struct gradient_run *r, double free, double yield, double on)
{
    const struct coupled *c = r->c;
    struct coupled_contact_solve *k = &r->contact;
    const struct coupled_modes *m = &c->modes;
    const int end = m->padded, half = end / (2 * LANES) * LANES;
    const double last = c->force, lean = (on - 2.5) * last,
                 guess = free - yield * (3 * (last - c->force_before) + c->own[0]);
    const bool stays = coupled_contact_solve_stays(k, free, yield);
    struct coupled_modal_sum *sum = &r->sum;
    double x = 0, change = 0;
    if (on == 0) return coupled_contact_solve(k, free, yield, guess);
    if (stays) x = coupled_contact_solve_first(k, guess);
    coupled_modal_sum_open(sum);
    coupled_modal_sum_some(m, (int[]){0, half}, last, lean, &sum->lanes);
    if (stays) {
        change = coupled_contact_solve_pass(k, free, yield, x);
        x -= change;
        k->passes = 1;
    }
    coupled_modal_sum_some(m, (int[]){half, end}, last, lean, &sum->lanes);
    coupled_modal_sum_close(sum, on);
    return stays ? coupled_contact_solve_close(k, x, change) || coupled_contact_solve_on(k, free, yield, x)
                 : coupled_contact_solve(k, free, yield, guess);
}

/* Steps first + 1 to `to` of the run, in a spell that began after step `from`. */
LANES_CLONES
static bool steps_on(struct gradient_run *r, const int batch[3], const double *surface, double *force, struct err *e)
{
    struct coupled *c = r->c;
    const int from = batch[0], first = batch[1], to = batch[2];
    const double h = c->ask.step, drop = r->own * c->ask.weight;
    for (int j = first + 1; j <= to; j++) {
        const bool behind = c->modes.padded > 0 && j > from + 1;
        const double last = c->force, place = r->sum.place, next = surface[j - 1] - c->origin;
        double bent =
            behind ? r->sum.later + last * coupled_modal_sum_along(r->answers.reply, j, j - 1.5) : r->sum.next;
        double free = (next - bent) - (c->height + (h * c->speed - drop)),
               yield = r->own + coupled_modal_sum_along(r->answers.press, j, j - 0.5);
        if (!(yield > 0) || !press(r, free, yield, behind ? j + 1 : 0))
            return err_set(e, ERR_NUMBERS,
                           "step %ld of the coupled contact has no solution after %d passes (penetration %g m, %g m "
                           "without a force, %g m/N; the place moves too far in one step, or a value is not finite)",
                           c->state.steps + j - from, r->contact.passes, r->contact.from, free, yield);
        if (behind) lean(r, last, place, r->sum.place);
        take(r, c->state.steps + j - from - 1, free, next - c->surface);
        c->surface = next;
        force[j - 1] = r->contact.force;
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
        look = coupled_modal_sum_look(&c->modes, at - 0.5, c->force, c->ask.step, &r->sum);
        work -= r->moves ? c->force * (0.5 * (r->sum.place + look.place)) : 0;
    }
    store_ball(r);
    coupled_seen(c, c->state.steps + at - from, &(struct coupled_account){look.energy, work, r->loss, look.lost});
}

/* Steps from + 1 to `to` of the run. */
static bool batch(struct gradient_run *r, int from, int to, const double *surface, double *force, struct err *e)
{
    struct coupled *c = r->c;
    if (c->modes.padded > 0) coupled_modal_sum_begin(&c->modes, from + 1, &r->sum);
    for (int at = from; at < to;) {
        int end = coupled_unseen(c, at, to);
        if (end == at) watch(r, from, at);
        end = coupled_unseen(c, at + 1, to);
        if (!steps_on(r, (int[]){from, at, end}, surface, force, e)) return false;
        at = end;
    }
    if (c->modes.padded > 0) {
        double before = r->sum.place;
        coupled_modal_sum_advance(&c->modes, to - 0.5, to + 2.0, c->force, &r->sum);
        lean(r, c->force, before, r->sum.place);
        coupled_sum_add(&c->mode_loss, lanes_total(r->sum.lanes.lost));
        for (int i = 0; i < c->modes.padded; i++)
            c->modes.p[i] = c->modes.swing[i] * (2 / c->ask.step);
    }
    store_ball(r);
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
    coupled_modal_sum_answers(&c->modes, steps, phi_to, &r.answers);
    r.contact = (struct coupled_contact_solve){.stiffness = 0.4 * c->ask.stiffness,
                                               .rate = c->ask.mu / c->ask.step,
                                               .from = c->penetration,
                                               .root = c->penetration > 0 ? sqrt(c->penetration) : 0};
    for (int from = 0; from < steps; from += BATCH) {
        int to = from + BATCH < steps ? from + BATCH : steps;
        if (!batch(&r, from, to, surface, force, e) || !coupled_balance(c, true, e)) return false;
    }
    if (phi_to) memcpy(c->modes.phi, phi_to, (size_t)c->modes.padded * sizeof *phi_to);
    return true;
}
