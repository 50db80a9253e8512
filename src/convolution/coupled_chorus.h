/* What the modes under a ball say in a step of coupled_gradient.c, all of them together: loops over modes, eight lanes
   at a time, with the same bits on every CPU.

   With swing P = h p / 2 a step is d = turn P - pull q + push phibar f, q += d, P = d - P; so two steps without a force
   take q to stay q + carry P, stay = (1 - pull)^2 - turn pull, carry = turn (turn - pull). Places are counted in steps
   of a run, in which phi is straight: phi after `on` steps is phi + on slant. */
#ifndef CONVOLUTION_COUPLED_CHORUS_H
#define CONVOLUTION_COUPLED_CHORUS_H
#include "convolution/coupled_parts.h"

struct coupled_chorus {
    double next,
        later; /* sum phi q at the end of the step to come, and of the one after it, as if no force acted in either */
    double place; /* sum slant q */
    struct coupled_voices {
        _Alignas(64) double lost[LANES];                 /* J, of the steps that have ended since begin */
        double later[LANES], slope[LANES], place[LANES]; /* of the pieces that have been gone through   */
    } lanes;
};

/* The modes' answers to 1 N as polynomials of the step's number (coupled_chorus_along). */
struct coupled_answers {
    double press[3]; /* sum push phi^2, push phi slant, push slant^2: sum phi+ q+ per N of the step */
    double reply[3]; /* the same of (1 + turn - pull) push: one step later                          */
};

/* Of the steps to phi_to (NULL: phi stays); sets slant. */
void coupled_chorus_answers(const struct coupled_modes *m, int steps, const double *phi_to, struct coupled_answers *to);

/* sum push (phi + to slant) (phi + middle slant), and so on. */
static inline double coupled_chorus_along(const double *c, double to, double middle)
{
    return c[0] + (to + middle) * c[1] + to * middle * c[2];
}

/* From step `on - 1` of the run, whose ends are known. */
void coupled_chorus_begin(const struct coupled_modes *m, double on, struct coupled_chorus *sum);

/* Ends a step whose force is known (bar: its middle) and goes ahead by two (on: the end of the second): that is
   coupled_chorus_open, _some from 0 to padded, in pieces of whole LANES, and _close. */
void coupled_chorus_advance(const struct coupled_modes *m, double bar, double on, double force,
                            struct coupled_chorus *sum);

/* What advance would end the step with, nothing being moved. */
struct coupled_look {
    double energy, lost, place; /* J of the modes; J in that step and those before it; sum slant q */
};

/* step: s */
struct coupled_look coupled_chorus_look(const struct coupled_modes *m, double bar, double force, double step,
                                        const struct coupled_chorus *sum);

/* Added in pairs: a tree is three additions deep, a row seven. */
static inline double coupled_chorus_sum(const double *s)
{
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

static inline void coupled_chorus_open(struct coupled_chorus *sum)
{
    memset(sum->lanes.later, 0, sizeof sum->lanes.later);
    memset(sum->lanes.slope, 0, sizeof sum->lanes.slope);
    memset(sum->lanes.place, 0, sizeof sum->lanes.place);
}

/* lean: bar force. 11 multiplications and 10 additions a mode; for callers that are LANES_CLONES. The lanes go to
   memory as a whole: gcc takes those of a local struct apart, and putting them together again costs 30 cycles. */
static inline __attribute__((always_inline)) void coupled_chorus_some(const struct coupled_modes *m, const int some[2],
                                                                      double force, double lean,
                                                                      struct coupled_voices *to)
{
    double lost[LANES], later[LANES], slope[LANES], place[LANES];
    memcpy(lost, to->lost, sizeof lost);
    memcpy(later, to->later, sizeof later);
    memcpy(slope, to->slope, sizeof slope);
    memcpy(place, to->place, sizeof place);
    double *restrict q = m->q, *restrict swing = m->swing, *restrict ahead = m->ahead;
    const double *restrict phi = m->phi, *restrict slant = m->slant, *restrict turn = m->turn, *restrict pull = m->pull;
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
            place[l] += slant[i + l] * x;
            later[l] += phi[i + l] * far;
            slope[l] += slant[i + l] * far;
        }
    memcpy(to->lost, lost, sizeof lost);
    memcpy(to->later, later, sizeof later);
    memcpy(to->slope, slope, sizeof slope);
    memcpy(to->place, place, sizeof place);
}

static inline __attribute__((always_inline)) void coupled_chorus_close(struct coupled_chorus *sum, double on)
{
    const struct coupled_voices *v = &sum->lanes;
    double later[LANES];
#pragma omp simd
    for (int l = 0; l < LANES; l++)
        later[l] = v->later[l] + on * v->slope[l];
    sum->later = coupled_chorus_sum(later);
    sum->place = coupled_chorus_sum(v->place);
}

#endif
