/* What the integrators of coupled.h share: the ball, the modes, the ledger of the energy and the count of contacts.

   An integrator takes its steps from struct coupled as it stands, keeps the fields marked so up to date, and reports
   landings and lift-offs by coupled_crossing; coupled_run then closes the ledger and publishes struct coupled_state.

   Heights are counted from `origin`, the surface's height at the start, so that a ball on a high place loses no digits.
   Modes: q displacement (positive downwards), p velocity, unit modal mass. Their arrays are padded to whole LANES; the
   padding is zero. */
#ifndef CONVOLUTION_COUPLED_PARTS_H
#define CONVOLUTION_COUPLED_PARTS_H
#include <math.h>

#include "convolution/coupled.h"
#include "num/lanes.h"

/* A sum and what its rounding lost (Knuth's two-sum): good to about eps^2 per term. */
struct coupled_sum {
    double high, low;
};

struct coupled_modes {
    int n, padded;             /* padded: n rounded up to LANES; 0: rigid ground                            */
    double *q, *p;             /* [padded] kept by the integrator; true displacement and velocity between runs */
    double *phi;               /* [padded] at the end of the last step: the integrator moves it             */
    double *phi_to;            /* [padded] at the end of this run, if coupled_run was given another           */
    double *frequency, *decay; /* [padded] Hz (damped), 1/s; as asked                                       */
    double *square;            /* [padded] |s|^2 = decay^2 + (2 pi frequency)^2; 1 in the padding           */
    double *inertia, *spring;  /* [padded] energy of a mode is (inertia p^2 + spring q^2) / 2: 1 and |s|^2, unless the
                                  integrator has its own */
    /* The discrete gradient's own (coupled_gradient.c and coupled_gradient.c say what they are). */
    double *turn, *pull, *push, *drain; /* [padded] coefficients of a step                                          */
    double *stay, *carry;               /* [padded] the same of q two steps without a force: stay q + carry P       */
    double *thrust, *tilt;              /* [padded] push phi, push slope_phi */
    double *swing, *ahead, *slope_phi; /* [padded] half a step's way at the velocity; the next step's way without force;
                                      phi's change per step */
    /* rk4's own, which also uses slope_phi: at a stage; summed slopes of a step. */
    double *stage_q, *stage_p, *step_q, *step_p; /* [padded] */
};

struct coupled_contact {
    long begun_step, ended_step; /* steps since the start, whole; and the fraction of the next one             */
    double begun_fraction, ended_fraction;
};

struct coupled {
    struct coupled_ask ask; /* frequency and decay: those of modes                                       */
    struct coupled_modes modes;
    double origin; /* m: coupled_start's surface                                                */

    /* Kept by the integrator, at the end of the last step. */
    double height, speed, surface; /* m (from origin), m/s, m (from origin)                                     */
    double penetration, closing;   /* m, m/s                                                                    */
    double force, force_before;    /* N, means over the last step and the one before                           */
    double own[4];                 /* whatever else an integrator carries; 0 at the start                       */
    struct coupled_sum surface_work, contact_loss, mode_loss; /* J since the start                                    */

    /* Who watches (coupled_watch): after every so many steps of a run a state goes to seen[0], [1], ... */
    int every, seen_so_far;
    struct coupled_state *seen;

    /* Kept by coupled.c. */
    double energy_start; /* J */
    double flight_least; /* s: longer flights are counted */
    struct coupled_contact contact;
    struct coupled_state state; /* steps, contact_steps, iterations*: added to by the integrator, the rest published */
};

/* One run: `steps` steps, surface[i] as coupled_run has it (not from origin); phi_to NULL (phi stays) or modes.phi_to.
   At its end modes.phi is exactly phi_to, state.steps has grown by `steps`. False with ERR_NUMBERS or ERR_SCENE set. */
bool coupled_gradient_run(struct coupled *c, int steps, const double *surface, const double *phi_to, double *force,
                          struct err *e);

/* The modes' inertia, spring, turn, pull, push, drain. ERR_SCENE: a mode at or above half the rate of the steps. */
bool coupled_gradient_make(struct coupled *c, struct err *e);

/* Potential energy of the contact, J: (2/5) k xi^2.5. */
static inline double coupled_potential(double stiffness, double penetration)
{
    return penetration > 0 ? 0.4 * stiffness * penetration * penetration * sqrt(penetration) : 0;
}

static inline void coupled_sum_add(struct coupled_sum *s, double x)
{
    double high = s->high + x, part = high - s->high;
    double lost = (s->high - (high - part)) + (x - part);
    s->high = high;
    s->low += lost;
}

static inline double coupled_sum_of(const struct coupled_sum *s) { return s->high + s->low; }

/* A landing or a lift-off (penetrations of different sign before and after), by linear crossing, in the step after
   `step` whole ones since the start; closing: m/s, at which a landing would close without a force. */
void coupled_crossing(struct coupled *c, long step, double before, double after, double closing);

/* Every step's ends go through this: cheap when nothing changes. */
static inline void coupled_count_contact(struct coupled *c, long step, double before, double after, double closing)
{
    if ((before > 0) != (after > 0)) coupled_crossing(c, step, before, after, closing);
}

/* Every step's end goes through this too: how high the ball is over the surface in its flight. */
static inline void coupled_rise(struct coupled *c, double penetration)
{
    c->state.hop[0] = -penetration > c->state.hop[0] ? -penetration : c->state.hop[0];
}

/* Energy of the modes as of now, J. */
double coupled_modal(const struct coupled *c);

/* The next step, from `at` on, after which a state is to be seen (at itself, or a multiple of `every`); `to` if that
 * comes first or nobody watches. */
static inline int coupled_unseen(const struct coupled *c, int at, int to)
{
    long next = c->every > 0 ? ((long)at + c->every - 1) / c->every * c->every : to;
    return next < to ? (int)next : to;
}

/* What an integrator knows better than c in the midst of a run. */
struct coupled_account {
    double modal;                         /* J: energy of the modes                             */
    double work, contact_loss, mode_loss; /* J beyond surface_work, contact_loss and mode_loss  */
};

/* The ball, the ledger and the contacts as they are in c after `steps` steps since the start, to who watches. */
void coupled_seen(struct coupled *c, long steps, const struct coupled_account *more);

/* Energy, highest and residual as of now. ERR_NUMBERS: not finite; held: nor the residual within its bound (coupled_run
   asks at the end of each run; an integrator of long runs may ask between). */
bool coupled_balance(struct coupled *c, bool bounded, struct err *e);

#endif
