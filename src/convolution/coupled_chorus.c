/* See coupled_chorus.h. Bits do not depend on the instruction set: sums run over LANES accumulators and then in one
 * tree. */
#include "convolution/coupled_chorus.h"

#include <string.h>

LANES_CLONES
void coupled_chorus_answers(const struct coupled_modes *m, int steps, const double *phi_to, struct coupled_answers *to)
{
    double press[3][LANES] = {{0}}, reply[3][LANES] = {{0}}, share = 1.0 / steps;
    double *restrict slants = m->slant, *restrict thrust = m->thrust, *restrict tilt = m->tilt;
    const double *end = phi_to ? phi_to : m->phi;
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double phi = m->phi[i + l], slant = (end[i + l] - phi) * share, push = m->push[i + l];
            double later = (1 + m->turn[i + l] - m->pull[i + l]) * push;
            slants[i + l] = slant;
            thrust[i + l] = push * phi;
            tilt[i + l] = push * slant;
            press[0][l] += push * (phi * phi);
            press[1][l] += push * (phi * slant);
            press[2][l] += push * (slant * slant);
            reply[0][l] += later * (phi * phi);
            reply[1][l] += later * (phi * slant);
            reply[2][l] += later * (slant * slant);
        }
    for (int k = 0; k < 3; k++) {
        to->press[k] = coupled_chorus_sum(press[k]);
        to->reply[k] = coupled_chorus_sum(reply[k]);
    }
}

LANES_CLONES
void coupled_chorus_begin(const struct coupled_modes *m, double on, struct coupled_chorus *sum)
{
    double next[LANES] = {0}, later[LANES] = {0}, place[LANES] = {0};
    double *restrict ahead = m->ahead;
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double x = m->q[i + l], v = m->swing[i + l], phi = m->phi[i + l], slant = m->slant[i + l];
            double free = m->turn[i + l] * v - m->pull[i + l] * x, far = m->stay[i + l] * x + m->carry[i + l] * v;
            place[l] += slant * x;
            ahead[i + l] = free;
            next[l] += (phi + on * slant) * (x + free);
            later[l] += (phi + (on + 1) * slant) * far;
        }
    *sum = (struct coupled_chorus){
        .next = coupled_chorus_sum(next), .later = coupled_chorus_sum(later), .place = coupled_chorus_sum(place)};
}

LANES_CLONES
void coupled_chorus_advance(const struct coupled_modes *m, double bar, double on, double force,
                            struct coupled_chorus *sum)
{
    coupled_chorus_open(sum);
    coupled_chorus_some(m, (int[]){0, m->padded}, force, bar * force, &sum->lanes);
    coupled_chorus_close(sum, on);
}

LANES_CLONES
struct coupled_look coupled_chorus_look(const struct coupled_modes *m, double bar, double force, double step,
                                        const struct coupled_chorus *sum)
{
    double energy[LANES] = {0}, place[LANES] = {0}, lost[LANES], rate = 2 / step;
    memcpy(lost, sum->lanes.lost, sizeof lost);
    for (int i = 0; i < m->padded; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double d = m->ahead[i + l] + (m->thrust[i + l] * force + m->tilt[i + l] * (bar * force)),
                   x = m->q[i + l] + d, p = (d - m->swing[i + l]) * rate;
            lost[l] += m->drain[i + l] * (d * d);
            place[l] += m->slant[i + l] * x;
            energy[l] += 0.5 * (m->inertia[i + l] * p * p + m->spring[i + l] * x * x);
        }
    return (struct coupled_look){coupled_chorus_sum(energy), coupled_chorus_sum(lost), coupled_chorus_sum(place)};
}
