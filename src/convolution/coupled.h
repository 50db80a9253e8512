/* A ball on a surface that has a shape and may give way: contact, gravity and modes solved together, papers/002
   equations 2 and 3 (Rath and Rocchesso), and equation 1 (Stoelinga and Chaigne) with a plate's modes.

     m w'' = f - G                                     w   height of the ball, m; G = m g cos(incline), N
     q_i'' + 2 sigma_i q_i' + |s_i|^2 q_i = phi_i f    q_i modal displacements, positive DOWNWARDS; phi_i (1/sqrt(kg))
                                                       at the contact's place, signed
     xi = s(t) - sum phi_i q_i - w                     penetration, m; s the rolling curve under the ball
     f = k xi^1.5 max(0, 1 + mu xi'), xi > 0; else 0

   Integrators: coupled_gradient.c (default); rk4 and exact_impact in coupled.c. Each says its formula, order and
   cost. */
#ifndef CONVOLUTION_COUPLED_H
#define CONVOLUTION_COUPLED_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

enum integrator { INTEGRATOR_DISCRETE_GRADIENT, INTEGRATOR_RK4, INTEGRATOR_EXACT_IMPACT };

struct coupled_ask {
    int integrator;                  /* enum integrator                                   */
    double step;                     /* s                                                 */
    double mass, weight;             /* kg; N, G                                          */
    double stiffness, mu;            /* N/m^1.5; s/m                                      */
    int n;                           /* modes; 0: rigid ground                            */
    const double *frequency, *decay; /* [n] Hz, 1/s                                       */
};

struct coupled_state {           /* at the end of the last step                       */
    double height, speed;        /* m, m/s: w, w'                                     */
    double surface;              /* m: s                                              */
    double penetration, closing; /* m, m/s: xi, xi' (by discrete_gradient the mean over the last step) */
    double force;                /* N, mean over the last step                        */
    double energy,
        highest;         /* J; the greatest so far of |H| and of each of its parts: what the residual is measured by */
    double surface_work; /* J since the start: by s(t) and the moving place   */
    double contact_loss, mode_loss; /* J since the start, each never falling             */
    double residual;                /* J: H - H(start) - surface_work + contact_loss + mode_loss */
    long steps, contact_steps;      /* in all; in contact                                */
    long lift_offs, landings;       /* contacts ended and begun; one at the start is no landing */
    long flights; /* flights from a lift-off to a landing, longer than coupled_flights says; a fall at the start is none
                   */
    double hop[2];       /* m, greatest height over the surface in this flight, and in the one before if it began with a
                            lift-off */
    double contact_time; /* s, fractions of steps by linear crossing of xi    */
    double impact;       /* m/s, closing speed at the last landing            */
    double impact_most;  /* greatest closing speed of a landing               */
    double flight;       /* s, since the last lift-off; 0 in contact          */
    double contact_least, contact_sum; /* s: shortest contact that has ended, sum of those; their number is lift_offs */
    long iterations, iterations_most;  /* of all steps in contact; of one                   */
};

struct coupled;

/* ERR_SCENE: exact_impact with modes. Nothing moves and nothing touches until coupled_start. */
bool coupled_make(struct arena *a, const struct coupled_ask *ask, struct coupled **c, struct err *e);

/* Height w, speed w', and the surface and shapes [n] (NULL: rigid) under it at the start; modes at rest, or (settled)
 * bent as the weight bends them. */
void coupled_start(struct coupled *c, double height, double speed, double surface, const double *phi, bool settled);

/* Before coupled_start: which flights are counted, those longer than `least` s; without it, all. */
void coupled_flights(struct coupled *c, double least);

/* Height at which the ball rests on a surface of that height under its weight (modes bent too, where there are any). */
double coupled_rest(const struct coupled *c, double surface, const double *phi);

/* In each run from now on, the states before its first step and after every `every` steps but the last go to seen[0],
   [1], ...; 0: no more. It changes no bit of what is computed. The residual is watched in them, but refused only at a
   run's end. */
void coupled_watch(struct coupled *c, int every, struct coupled_state *seen);

/* `steps` steps: surface[i] m at the end of step i; phi_to [n] at the end of the last one (between, straight from what
   it was; NULL: as it was); force[i] N, the mean over step i, which hands over exactly the momentum that the ball gets.
   ERR_NUMBERS with what went wrong: not finite, or the energy's balance is off by more than (1e-10 + 4 eps steps) of
   state->highest (discrete_gradient and exact_impact; rk4 keeps no balance, which its residual shows); of rk4,
   ERR_SCENE for an impact of less than 12 steps or with mu k xi^1.5 step / m > 1 (unstable). */
bool coupled_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                 struct err *e);

const struct coupled_state *coupled_state(const struct coupled *c);

/* Modal displacement and velocity of mode i, scaled to unit modal mass (sqrt(kg) m, sqrt(kg) m/s). */
void coupled_mode(const struct coupled *c, int i, double *displacement, double *velocity);

/* Duration of an impact at speed v (m/s) of the mass on rigid ground without dissipation, s: 2.943 (5 m / (4 k))^(2/5)
 * v^(-1/5). */
double coupled_contact_time(double mass, double stiffness, double speed);

#endif
